#!/usr/bin/python3
"""Adhesion: measurements and formulas of others beside the law and the presses of this project, with nothing tuned.

    compare.py --mpm build/release/tools/mpm/mpm -o docs/evidence/published     seconds
    compare.py --mpm ... --check docs/evidence/published

Writes adhesion.csv, the measurements of experiments.csv beside the law of materials.toml, or what it is refused for; and
adhesion-formulas.csv, formulas beside the presses and impacts of docs/evidence/adhesion.csv and adhesion-restitution.csv:
Thornton and Ning     Powder Technol. 99 (1998) 154: the dent parts as a sphere of the radius with which it unloads, pull-off force
                      2 pi w E* a^3/F_m (eq. 20, 77); an impact loses its plastic and its adhesive energy one by one (eq. 57, 78)
Zunker and Kamrin     J. Mech. Phys. Solids 183 (2024) 105492, LAMMPS's mdr: the pressure of the dent is uniform, the profile an
                      ellipse (eq. 28), and the edge parts where the stretch is sqrt(2 pi w c/E*) (eq. 11)
Both were read in notes on these papers (github yonghoon7153-source/Yonghoon-DEM-DFT, litdb/papers).
"""
import argparse
import csv
import json
import math
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
EVIDENCE = HERE.parents[3] / "docs/evidence"
REFUSALS = {"Tabor": r"Tabor number ([\d.e+-]+)", "S": r"pressure is ([\d.e+-]+)|attraction is ([\d.e+-]+)", "chi": r"a\) is ([\d.e+-]+)"}

def rows_of(path):
    with open(path) as file:
        return list(csv.reader(line for line in file if not line.startswith("#")))

class Refused(Exception):
    pass

class Laws:
    def __init__(self, mpm, folder, pairs):
        self.mpm, self.file = mpm, str(Path(folder) / "law.h5")
        asked = [word for pair in sorted(pairs) for word in ("--pair", pair)]
        subprocess.run([mpm, "table", str(HERE / "materials.toml"), *asked, "-o", self.file], check=True, capture_output=True, cwd=folder)

    def __call__(self, case, speed):
        work = [word for name, word in (("w_J_m2", "--work-of-adhesion"), ("range_m", "--adhesion-range")) if case[name] for word in (word, case[name])]
        run = subprocess.run([self.mpm, "law", self.file, "--pair", case["pair"], "--radius", case["radius_m"], "--radius2", case["partner_m"],
                              "--velocity", str(speed), *work, "--json"], capture_output=True, text=True)
        if run.returncode:
            number = {name: next(filter(None, found.groups())) for name, text in REFUSALS.items() if (found := re.search(text, run.stderr))}
            raise Refused("refused: " + (", ".join(f"{k} = {v}" for k, v in number.items()) or run.stderr.strip()))
        return json.loads(run.stdout)

def between(low, high, is_below):
    """Where is_below() ends, by halving the ratio."""
    while high / low > 1.003:
        middle = math.sqrt(low * high)
        low, high = (middle, high) if is_below(middle) else (low, middle)
    return low

def answer(law, case):
    quantity, at = case["quantity"], case["at"] and float(case["at"])
    try:
        if quantity.startswith("sticking"):
            law(case, case["measured"])  # refused there
            return f"{between(1e-3, 20, lambda v: law(case, v)['sticks']):.3g}"
        if quantity.startswith("e at"):
            return f"{law(case, at)['e']:.3g}"
        if quantity.startswith("pull-off"):
            pressed = between(1e-4, 10, lambda v: law(case, v)["force_max_N"] < at)
            return f"{law(case, pressed)['pull_off_N'] / law(case, 1e-4)['pull_off_N']:.3g}"
        return f"{law(case, at)['pull_off_N']:.3g} N"
    except Refused as refusal:
        return str(refusal)

def measurements(mpm):
    head, *lines = rows_of(HERE / "experiments.csv")
    cases = [dict(zip(head, line)) for line in lines]
    with tempfile.TemporaryDirectory() as folder:
        law = Laws(mpm, folder, {c["pair"] for c in cases})
        return [["experiment", "quantity", "published", "law"], *([c["experiment"], c["quantity"], c["measured"], answer(law, c)] for c in cases)]

def thornton_ning(chi):
    """Pull-off force over F_m; chi = w E*/(p_m^2 a)."""
    return 2 / math.pi * chi

def zunker_kamrin(chi):
    t = np.linspace(0, math.pi / 2, 20001)  # sin t: the edge over a
    return -np.min(2 / math.pi * (t - np.sin(t) * np.cos(t)) - math.sqrt(8 * chi / math.pi) * np.sin(t)**1.5)

def formulas():
    table = [["what", "range", "runs", "law", "Zunker and Kamrin", "Thornton and Ning"]]
    presses = [(float(r[3]), float(r[4]), float(r[5])) for r in rows_of(EVIDENCE / "adhesion.csv")[1:]]
    for low, high in ((0, 0.005), (0.005, 0.02), (0.02, 0.05), (0.05, 0.2), (0.2, 1)):
        some = [p for p in presses if low < p[0] <= high]
        columns = [[p[2] for p in some], *([100 * (f(p[0]) / p[1] - 1) for p in some] for f in (zunker_kamrin, thornton_ning))]
        table.append(["pull-off force over the solver's, error in %", f"chi {min(p[0] for p in some):.2g} to {max(p[0] for p in some):.2g}", str(len(some)),
                      *(f"{min(c):+.0f} to {max(c):+.0f}" for c in columns)])
    for r in rows_of(EVIDENCE / "adhesion-restitution.csv")[1:]:
        w, v, bare, bare_law, e, e_law = (float(r[k]) for k in (1, 2, 4, 5, 6, 7))
        lost = bare**2 - e**2  # of the energy before the impact, by the solver
        table.append(["energy that adhesion takes, over the solver's", f"E*/Y {r[0]}; w/(E* R) {r[1]}; V {r[2]}", "1", f"{(bare_law**2 - e_law**2) / lost:.2f}", "",
                      f"{14.18 / (4 / 3 * math.pi) * w**(5 / 3) / v**2 / lost:.3f}"])
    return table

def same(new, old):
    """Numbers within 1 %: three times the step of between()."""
    try:
        return math.isclose(float(new), float(old), rel_tol=0.01)
    except ValueError:
        return new == old

def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--mpm", required=True)
    parser.add_argument("-o", "--output", type=Path)
    parser.add_argument("--check", type=Path, metavar="FOLDER", help="compare with the files stored there")
    words = parser.parse_args()
    if not (words.check or words.output):
        parser.error("-o or --check is needed")
    wrong = 0
    for name, table in (("adhesion.csv", measurements(words.mpm)), ("adhesion-formulas.csv", formulas())):
        if words.check:
            different = [f"{name}: {new} is stored as {old}" for new, old in zip(table, rows_of(words.check / name), strict=True)
                         if not all(map(same, new, old))]
            print("\n".join(different) or f"{name}: as stored")
            wrong += len(different)
        else:
            with (words.output / name).open("w") as file:
                csv.writer(file, lineterminator="\n").writerows(table)
            print("\n".join("  ".join(row) for row in table))
    sys.exit(wrong > 0)

if __name__ == "__main__":
    main()
