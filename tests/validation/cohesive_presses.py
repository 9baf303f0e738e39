#!/usr/bin/python3
"""Pull-off forces and impacts with attraction by the solver, for docs/evidence/adhesion.md: a line for each run.

    tests/validation/cohesive_presses.py [--resolution 40] [--grids 1] [--mpm mpm] dents STIFFNESS HARDENING DEPTH CHI S [CHI S ...]
    tests/validation/cohesive_presses.py [...] elastic DEPTH WORK TABOR [WORK TABOR ...]
    tests/validation/cohesive_presses.py [...] impacts STIFFNESS WORK S VELOCITY [VELOCITY ...]

R = 1 m, E* = 1 Pa, density 1 kg/m3; S = sigma_0/p_m, and chi = w E*/(p_m^2 a) of a dent with p_m and a of the same press without attraction
(impacts: of the impact), Tabor = (w^2 R/(E*^2 h_0^3))^(1/3). Lines of dents are those of tests/unit/contact/cohesive_presses.csv; of elastic
spheres the pull-off force over 1.5 pi w R; of impacts e by the solver and by the law.
"""
import argparse
import csv
import json
import math
import pathlib
import subprocess
import tempfile

UNIT, RADIUS, DENSITY = 1e9, 1e-3, 1e3  # E* in Pa, R in m, kg/m3: the numbers above are in these units
SPEED = math.sqrt(UNIT / DENSITY)


class Runs:
    def __init__(self, asked, folder, stiffness=math.inf, hardening=0.0):
        self.asked, self.folder = asked, folder
        young = UNIT * (1 - 0.3**2)
        text = f'[material.m]\ndensity = {DENSITY}\nyoungs_modulus = {young}\npoisson_ratio = 0.3\n'
        if math.isfinite(stiffness):
            text += f"yield_stress = {UNIT / stiffness}\n"
        if hardening:
            text += f'hardening = {{law = "linear", modulus = {hardening * young}}}\n'
        (folder / "m.toml").write_text(f'{text}[particle.p]\nradius = {RADIUS}\nmaterial = "m"\n')

    def mpm(self, *words):
        done = subprocess.run([str(w) for w in (self.asked.mpm, *words)], capture_output=True, text=True, check=False)
        if done.returncode:
            raise SystemExit(done.stderr)
        return done.stdout

    def solve(self, kind, *words):
        return json.loads(self.mpm(kind, self.folder / "m.toml", "--particle", "p", "--resolution", self.asked.resolution, "--shifted-grids", self.asked.grids, "--no-estimate", "-o", self.folder / "t.csv", "--json", *words))

    def press(self, depth, *words):
        return self.solve("press", "--depth", depth, "--support", "midplane", *words)

    def dent(self, found):
        """Mean pressure at the largest force, and contact radius, of the last run."""
        with (self.folder / "t.csv").open() as file:
            rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
        radius = max(float(v) for r in rows for k, v in r.items() if k.startswith("contact_radius")) / RADIUS
        return found["force_max_N"] / (UNIT * RADIUS**2) / (math.pi * radius**2), radius


def attraction(work, reach):
    return "--work-of-adhesion", repr(work * UNIT * RADIUS), "--adhesion-range", repr(reach * RADIUS)


def cost(found):
    return f"{found['cpu_s']:.0f} CPU s, energy {found['energy_error']:.1e}"


def dents(asked, folder):
    stiffness, hardening, depth, *cases = asked.numbers
    runs = Runs(asked, folder, stiffness, hardening)
    free = runs.press(depth)
    pressure, radius = runs.dent(free)
    for chi, strength in zip(cases[::2], cases[1::2]):
        work = chi * pressure**2 * radius
        reach = 2 * work / (strength * pressure)
        found = runs.press(depth, *attraction(work, reach))
        print(f"{stiffness:g},{hardening:g},{depth:g},{free['force_max_N'] / (UNIT * RADIUS**2):.5g},{work:.4g},{chi:g},{reach:.4g},{found['pull_off_N'] / free['force_max_N']:.5g},{asked.resolution}  # S {strength:g}, {cost(found)}", flush=True)


def elastic(asked, folder):
    depth, *cases = asked.numbers
    runs = Runs(asked, folder)
    for work, tabor in zip(cases[::2], cases[1::2]):
        found = runs.press(depth, *attraction(work, (work * work / tabor**3)**(1 / 3)))
        print(f"w {work:g}, Tabor {tabor:g}: {found['pull_off_N'] / (1.5 * math.pi * work * UNIT * RADIUS**2):.4f}  # {cost(found)}", flush=True)


def impacts(asked, folder):
    stiffness, work, strength, *velocities = asked.numbers
    runs = Runs(asked, folder, stiffness)
    runs.mpm("table", folder / "m.toml", "--pair", "m:wall", "-o", folder / "m.h5")
    for v in velocities:
        speed = ("--velocity", repr(v * SPEED))
        law = ("law", folder / "m.h5", "--pair", "m:wall", "--radius", RADIUS, *speed, "--json")
        plain = runs.solve("impact", *speed)
        pressure, radius = runs.dent(plain)
        sticky = attraction(work, 2 * work / (strength * pressure))
        free, by_law = json.loads(runs.mpm(*law)), json.loads(runs.mpm(*law, *sticky))
        found = runs.solve("impact", *speed, *sticky)
        print(f"{stiffness:g},{work:g},{v:g},{work / (pressure**2 * radius):.2g},{plain['e']:.4f},{free['e']:.4f},{found['e']:.4f},{by_law['e']:.4f},{by_law['e'] - found['e']:+.3f},{strength:g}  # {cost(found)}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--mpm", default="mpm")
    parser.add_argument("--resolution", default="40")
    parser.add_argument("--grids", default="1", help="shifted grids, whose mean is taken")
    parser.add_argument("kind", choices=("dents", "elastic", "impacts"))
    parser.add_argument("numbers", nargs="+", type=float)
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        {"dents": dents, "elastic": elastic, "impacts": impacts}[asked.kind](asked, pathlib.Path(name))


main()
