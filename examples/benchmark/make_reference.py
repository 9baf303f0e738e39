#!/usr/bin/python3
"""Writes reference.csv: runs of mpm's solver, and two published tables of it. Some three minutes of CPU.

    make_reference.py [-o out/benchmark-reference]

Uncertainties: one body of revolution, the run's own error estimate, 0.3 % or more. Six planes: difference of 12 and 8 cells, 2 % or more. Oblique impacts
(docs/evidence/oblique.csv, 8 cells): 0.5 % of e and tangential velocity, 1 % of spin, from 10 cells. Bed (docs/evidence/packings.md, 12 cells): 1 %; 3.3 % at the
density of 0.63, from 8 cells."""
import argparse
import csv
import json
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "common"))
import one_sentence  # noqa: E402, F401
import numpy as np  # noqa: E402
from run import DEPTHS, HERE, R, SPEEDS, program

OBLIQUE = {20: (0.510, 0.608, 0.343), 60: (0.456, 0.758, 1.022)}  # friction 0.3
BED = {0.63: (0.0794, 0.0026), 0.68: (0.1772, 0.0018), 0.73: (0.2909, 0.0029), 0.78: (0.4077, 0.0041)}


def solve(folder, name, kind, *words):
    """JSON of a run, and its trace (overlap, force, True where it unloads); made once."""
    answer, trace = folder / f"{name}.json", folder / f"{name}.csv"
    if not answer.exists():
        done = subprocess.run([program("mpm", "tools/mpm"), kind, HERE / "materials.toml", *map(str, words), "--json", "-o", trace], capture_output=True, text=True, check=True)
        answer.write_text(done.stdout)
    with open(trace, newline="", encoding="utf-8") as file:
        rows = [(float(r["delta_m"]), float(r.get("force_6_N", r["force_N"])), r["branch"] == "unload") for r in csv.DictReader(file)]
    return json.loads(answer.read_text()), rows


def force_at(rows, depth):
    loading = [(d, abs(f)) for d, f, back in rows if not back]
    return float(np.interp(depth * R, [d for d, _ in loading], [f for _, f in loading]))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--out", default="out/benchmark-reference")
    folder = pathlib.Path(parser.parse_args().out)
    folder.mkdir(parents=True, exist_ok=True)
    rows = []

    def add(case, quantity, at, value, uncertainty):
        rows.append((case, quantity, f"{at:g}", f"{value:.5g}", f"{uncertainty:.2g}"))

    impacts = [("head_on", v, ("--particle", "wax", "--velocity", v)) for v in SPEEDS] + [
        ("like_pair", 2, ("--particle", "wax", "--against", "wax", "--velocity", 2)), ("sizes", 1, ("--particle", "wax", "--against", "small", "--velocity", 1)),
        ("unlike_pair", 1, ("--particle", "wax", "--against", "resin", "--velocity", 1)), ("hardening", 1, ("--particle", "hard_wax", "--velocity", 1))]
    for case, at, words in impacts:
        found, _ = solve(folder, f"{case}_{at}", "impact", *words, *(() if case == "unlike_pair" else ("--tolerance", 0.003)))  # there it would take a quarter of an hour
        part = max(found["error_estimate"], 0.003)
        add(case, "e", at, found["e"], part * found["e"])
        add(case, "force_max", at, found["force_max_N"], part * found["force_max_N"])
    for angle, values in OBLIQUE.items():
        for quantity, value, part in zip(("e", "tangential_velocity_kept", "spin"), values, (0.005, 0.005, 0.01)):
            add(f"oblique_{angle}", quantity, angle, value, part * value)
    found, trace = solve(folder, "press", "press", "--particle", "wax", "--depth", 0.1)
    part = max(found["error_estimate"], 0.003)
    for depth in DEPTHS:
        force = force_at(trace, min(depth, 0.0999))
        add("press", "force", depth, force, part * force)
    add("press", "residual_overlap", 0.1, found["delta_residual_m"] / R, part * found["delta_residual_m"] / R)
    coarse, fine = (solve(folder, f"cube_{n}", "press", "--particle", "wax", "--planes", "cube", "--depth", 0.1, "--resolution", n)[1] for n in (8, 12))
    for depth in DEPTHS:
        force, other = (force_at(t, min(depth, 0.0999)) for t in (fine, coarse))
        add("six_planes", "force", depth, force, max(abs(force - other), 0.02 * force))
    for density, (value, uncertainty) in BED.items():
        add("bed", "stress_over_Y", density, value, uncertainty)
    with open(HERE / "reference.csv", "w", newline="", encoding="utf-8") as file:
        file.write("# Reference of the benchmark by make_reference.py: e, tangential velocity, spin, overlap/R and stress/Y without units, forces in N, uncertainty in that of the value\n")
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(("case", "quantity", "at", "value", "uncertainty"))
        writer.writerows(rows)


if __name__ == "__main__":
    main()
