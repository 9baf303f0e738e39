#!/usr/bin/python3
"""Pull-off forces of dents by the solver, for docs/evidence/adhesion.md: a line for each press with attraction, as in tests/unit/contact/cohesive_presses.csv.

    tests/validation/cohesive_presses.py [--resolution 40] [--mpm mpm] STIFFNESS HARDENING DEPTH CHI S [CHI S ...]

R = 1 m, E* = 1 Pa; chi = w E*/(p_m^2 a), S = sigma_0/p_m with p_m and a of the same press without attraction.
"""
import argparse
import csv
import json
import math
import pathlib
import subprocess
import tempfile


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--mpm", default="mpm")
    parser.add_argument("--resolution", default="40")
    parser.add_argument("numbers", nargs="+", type=float)
    asked = parser.parse_args()
    stiffness, hardening, depth, *cases = asked.numbers
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        unit, radius = 1e9, 1e-3  # E* in Pa and R in m: the numbers below are in these units
        young = unit * (1 - 0.3**2)
        more = f'hardening = {{law = "linear", modulus = {hardening * young}}}\n' if hardening else ""
        (folder / "m.toml").write_text(f"[material.m]\ndensity = 1000\nyoungs_modulus = {young}\npoisson_ratio = 0.3\nyield_stress = {unit / stiffness}\n{more}"
                                       f'[particle.p]\nradius = {radius}\nmaterial = "m"\n')

        def press(*words):
            command = [asked.mpm, "press", folder / "m.toml", "--particle", "p", "--depth", str(depth), "--support", "midplane", "--resolution", asked.resolution,
                       "--shifted-grids", "1", "--no-estimate", "-o", folder / "t.csv", "--json", *words]
            done = subprocess.run([str(w) for w in command], capture_output=True, text=True, check=False)
            if done.returncode:
                raise SystemExit(done.stderr)
            with (folder / "t.csv").open() as file:
                rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
            return json.loads(done.stdout), rows

        free, rows = press()
        radius_of = max(float(v) for r in rows for k, v in r.items() if k.startswith("contact_radius")) / radius
        force = free["force_max_N"] / (unit * radius**2)
        pressure = force / (math.pi * radius_of**2)
        for chi, strength in zip(cases[::2], cases[1::2]):
            work = chi * pressure**2 * radius_of
            found, _ = press("--work-of-adhesion", repr(work * unit * radius), "--adhesion-range", repr(2 * work / (strength * pressure) * radius))
            print(f"{stiffness:g},{hardening:g},{depth:g},{work:.4g},{chi:g},{found['pull_off_N'] / free['force_max_N']:.5g}  # S {strength:g}, {found['cpu_s']:.0f} CPU s, energy {found['energy_error']:.1e}",
                  flush=True)


main()
