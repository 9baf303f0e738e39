#!/usr/bin/env python3
"""Laboratories of the solver's own midplane presses: how true the intervals of mpm calibrate are.

A hundred random materials (E*/Y 30 to 2000, nu 0 to 0.45, three of four with linear hardening H/E of 1e-3 to 0.1)
are pressed with `mpm press --support midplane`. 60 values of the loading and 29 of the unloading, with 1 % noise and
an unknown first touch, go to `mpm calibrate`. The presses stay in FOLDER: a second call goes on where the first
stopped, and fits other parameters to the same presses.

    tests/validation/press_laboratories.py MPM FOLDER youngs_modulus yield_stress
"""
import argparse
import csv
import json
import math
import random
import resource
import subprocess
import sys
from pathlib import Path

import numpy as np

RADIUS = 1e-3  # m
NOISE = 0.01
KEYS = {"youngs_modulus": "E", "yield_stress": "Y", "hardening_modulus": "H"}


def materials(count, seed):
    chance = random.Random(seed)

    def between(low, high):
        return low * (high / low) ** chance.random()

    for _ in range(count):
        nu, e, stiffness = chance.uniform(0, 0.45), between(1e8, 1e11), between(30, 2000)
        hardening = e * between(1e-3, 0.1) if chance.random() < 0.75 else 0.0
        onset = (math.pi * 1.295 * math.exp(0.736 * nu) / (2 * stiffness)) ** 2  # overlap/R
        depth = min(0.3, between(max(20 * onset, 0.01), max(25 * onset, 0.2)))
        yield {"nu": nu, "E": e, "Y": e / (1 - nu * nu) / stiffness, "H": hardening, "depth": depth}


def press(mpm, folder, number, material):
    """The press's numbers and trace, run if they are not there."""
    result, trace = folder / f"{number}.json", folder / f"{number}.csv"
    if not result.exists():
        toml = folder / f"{number}.toml"
        hardening = f'hardening = {{law = "linear", modulus = {material["H"]!r}}}\n' if material["H"] else ""
        toml.write_text(f'[material.m]\ndensity = 1500.0\nyoungs_modulus = {material["E"]!r}\n'
                        f'poisson_ratio = {material["nu"]!r}\nyield_stress = {material["Y"]!r}\n{hardening}'
                        f'[particle.p]\nradius = {RADIUS!r}\nmaterial = "m"\n')
        run = subprocess.run([mpm, "press", toml, "--particle", "p", "--depth", str(material["depth"]), "--support",
                              "midplane", "--resolution", "24", "-o", trace, "--json"],
                             capture_output=True, text=True, check=True)
        result.write_text(run.stdout)
    with open(trace) as f:
        rows = [(float(r["delta_m"]), float(r["force_N"]), r["branch"] == "load") for r in csv.DictReader(f)]
    return json.loads(result.read_text()), rows


def measured(numbers, rows, chance):
    """Displacement of one platen towards the other and force, as a testing machine gives them."""
    loading = np.array(sorted((x, f) for x, f, load in rows if load))
    unloading = np.array(sorted((x, f) for x, f, load in rows if not load))
    top, residual = loading[-1, 0], numbers["delta_residual_m"]
    overlaps = [(top * k / 60, loading) for k in range(1, 61)]
    overlaps += [(residual + k / 30 * (top - residual), unloading) for k in range(29, 0, -1)]
    offset = chance.uniform(-0.05, 0.05) * 2 * top
    for x, branch in overlaps:
        force = np.interp(x, branch[:, 0], branch[:, 1]) * (1 + NOISE * chance.normal())
        yield 2 * x + offset, max(0.0, force)


def calibrate(mpm, data, material, wanted):
    command = [mpm, "calibrate", data, "--radius", str(RADIUS), "--density", "1500", "--poisson-ratio",
               str(material["nu"]), "--json", "--fit", *wanted]
    for name, key in KEYS.items():
        if name not in wanted:
            command += ["--" + name.replace("_", "-"), str(material[key])]
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    run = subprocess.run(command, capture_output=True, text=True, check=True)
    return json.loads(run.stdout), resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mpm", type=Path)
    parser.add_argument("folder", type=Path)
    parser.add_argument("fit", nargs="+", choices=KEYS)
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--seed", type=int, default=26)
    chosen = parser.parse_args()
    chosen.folder.mkdir(parents=True, exist_ok=True)
    tally = {name: {"told": 0, "within": 0, "errors": []} for name in chosen.fit}
    misfits, seconds = 0, []
    for number, material in enumerate(materials(chosen.count, chosen.seed)):
        numbers, rows = press(chosen.mpm, chosen.folder, number, material)
        data = chosen.folder / "data.csv"
        with open(data, "w") as f:
            f.write("displacement_m,force_N\n")
            for x, force in measured(numbers, rows, np.random.default_rng(1000 + number)):
                f.write(f"{x:.9g},{force:.9g}\n")
        fit, cpu = calibrate(chosen.mpm, data, material, chosen.fit)
        seconds.append(cpu)
        misfits += bool(fit["misfits"])
        for name in chosen.fit:
            found, truth, counts = fit["parameters"][name], material[KEYS[name]], tally[name]
            counts["within"] += found["low95"] * (1 - 1e-9) <= truth <= found["high95"] * (1 + 1e-9)
            if found["identifiable"]:
                counts["told"] += 1
                if truth > 0:
                    counts["errors"].append(abs(found["value"] / truth - 1))
        if sys.stderr.isatty():
            print(f"\r{number + 1} of {chosen.count}", end="", file=sys.stderr)
    for name, counts in tally.items():
        error = f'{100 * np.median(counts["errors"]):.2f} %' if counts["errors"] else "none"
        print(f'{name:<18} told in {counts["told"]} of {chosen.count}; truth within 95 % in {counts["within"]}; '
              f"median error of those told {error}")
    print(f"misfits named in {misfits}; CPU s: median {np.median(seconds):.2f}, longest {max(seconds):.2f}")


if __name__ == "__main__":
    main()
