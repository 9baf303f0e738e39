#!/usr/bin/env python3
"""Fresh arrangements of planes: `mpm press --by law` against `--by solver` (docs/evidence/confined.md).

First the named arrangements, on which the elastic part was fitted. Then 50 cases of a seed fixed before: each has 4 to 12 planes in random directions that close a cell, unlike speeds, one in
five standing, an E*/Y of 30, 100 or 1000, a nu of 0.1 to 0.45, and in one of five hardening. It is pressed until its cell
has a density of 0.75 to 1, and unloaded. Runs stay in FOLDER: a second call goes on where the first stopped.

    tests/validation/confined_planes.py MPM FOLDER docs/evidence/confined.csv
"""
import argparse
import csv
import itertools
import math
import subprocess
from pathlib import Path

import numpy as np

SEED = 20291129
COUNT, RADIUS, MODULUS = 50, 1e-3, 1e8  # -, m, Pa: E*
CELLS = 6  # across the contact: at 8 the stress differs by 1 to 2 % and costs three times as much
RAMP = {30: 120, 100: 150, 1000: 250}  # R/c*, by E*/Y: rho V^2/Y of the planes is below 0.002, at 1000 and 0.4 R 0.006
DENSITIES = (0.65, 0.7, 0.75, 0.8, 0.85, 0.9, 0.95, 1.0)


def directions(chance, count):
    """Unit vectors at least as far apart as count allows, within 72 degrees of every direction."""
    apart = math.cos(0.75 * math.sqrt(4 * math.pi / count))
    probe = chance.normal(size=(2000, 3))
    probe /= np.linalg.norm(probe, axis=1)[:, None]
    while True:
        found = []
        for _ in range(2000):
            n = chance.normal(size=3)
            n /= np.linalg.norm(n)
            if all(n @ m < apart for m in found):
                found.append(n)
            if len(found) == count:
                break
        if len(found) == count and (probe @ np.array(found).T).max(axis=1).min() > 0.3:
            return np.array(found)


def rays(count=20000):
    """Directions that share the sphere evenly (Fibonacci's lattice)."""
    k = np.arange(count) + 0.5
    z, turn = 1 - 2 * k / count, math.pi * (1 + math.sqrt(5)) * k
    return np.stack([np.sqrt(1 - z * z) * np.cos(turn), np.sqrt(1 - z * z) * np.sin(turn), z], axis=1)


def density(case, depth, along):
    """Solid volume over that of the cell, at this way of planes of speed 1. `along`: rays() times the normals."""
    way = 1 - depth * case["speeds"]
    reach = np.where(along > 0.05, way / np.maximum(along, 0.05), np.inf).min(axis=1)
    return 1 / (reach**3).mean()


def cases():
    chance = np.random.default_rng(SEED)
    lattice = rays()
    number = 0
    while number < COUNT:
        count = int(chance.integers(4, 13))
        case = {"normals": directions(chance, count), "stiffness": float(chance.choice([30, 100, 1000])), "nu": float(chance.uniform(0.1, 0.45)),
                "hardening": float(chance.uniform(0.01, 0.1)) if number % 5 == 4 else 0.0}
        case["speeds"] = np.where(chance.random(count) < 0.2, 0.0, chance.uniform(0.3, 1.0, count))
        case["speeds"] /= max(case["speeds"].max(), 1e-9)
        along = lattice @ case["normals"].T
        wanted = chance.uniform(0.75, 1.0)
        low, high = 0.0, 0.6
        for _ in range(20):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if density(case, middle, along) < wanted else (low, middle)
        case["depth"] = low
        if low > 0.45 or case["speeds"].max() < 1:  # few planes that stand far off: not deep enough
            continue
        ways = np.linspace(0, low, 25)
        case["density"] = (ways, np.array([density(case, w, along) for w in ways]))
        case["number"] = number
        number += 1
        yield case


def named():
    """Arrangements of `mpm press` that the numbers of the elastic part were fitted to."""
    axes = np.array([[0, 0, 1], [0, 0, -1], [1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0]], dtype=float)
    corners = np.array([[i, j, k] for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)]) / math.sqrt(3)
    edges = np.array([np.roll([0, a, b], k) for k in range(3) for a in (-1, 1) for b in (-1, 1)]) / math.sqrt(2)
    shapes = {"pair": (axes[:2], 2), "cube": (axes, 6), "die": (axes, 2), "bcc": (corners, 8), "fcc": (edges, 12)}
    wanted = [("pair", 0.1, 100, 0.3, 0), ("cube", 0.1, 100, 0.3, 0), ("cube", 0.15, 100, 0.3, 0), ("cube", 0.19, 100, 0.3, 0), ("die", 0.15, 100, 0.3, 0), ("die", 0.3, 100, 0.3, 0),
              ("bcc", 0.1, 100, 0.3, 0), ("fcc", 0.08, 100, 0.3, 0), ("cube", 0.15, 30, 0.3, 0), ("die", 0.3, 30, 0.3, 0), ("cube", 0.15, 1000, 0.3, 0), ("die", 0.3, 1000, 0.3, 0),
              ("cube", 0.15, 100, 0.1, 0), ("die", 0.3, 100, 0.1, 0), ("cube", 0.15, 100, 0.45, 0), ("die", 0.3, 100, 0.45, 0), ("cube", 0.15, 100, 0.3, 0.1), ("die", 0.3, 100, 0.3, 0.1)]
    lattice = rays()
    for name, depth, stiffness, nu, hardening in wanted:
        normals, moving = shapes[name]
        case = {"number": f"{name} {depth} {stiffness} {nu} {hardening}".replace(" ", "_"), "normals": normals, "stiffness": stiffness, "nu": nu, "hardening": hardening, "depth": depth,
                "speeds": np.where(np.arange(len(normals)) < moving, 1.0, 0.0)}
        ways = np.linspace(0, depth, 25)
        case["density"] = (ways, np.array([density(case, w, lattice @ normals.T) for w in ways]))
        yield case


def run(mpm, folder, case, by):
    """Ways over R, forces over Y R^2 of every plane, loading or not."""
    stem = folder / f"{case['number']}_{by}"
    trace, planes, toml = Path(f"{stem}.csv"), folder / f"{case['number']}.planes", folder / f"{case['number']}.toml"
    e_star, nu = MODULUS, case["nu"]
    e, y = e_star * (1 - nu * nu), e_star / case["stiffness"]
    if by == "law" or not trace.exists():
        planes.write_text("".join(f"{n[0]:.9f} {n[1]:.9f} {n[2]:.9f} touch {s:.6f}\n" for n, s in zip(case["normals"], case["speeds"], strict=True)))
        hardening = f'hardening = {{law = "linear", modulus = {case["hardening"] * e}}}\n' if case["hardening"] else ""
        toml.write_text(f'[material.m]\ndensity = 1000.0\nyoungs_modulus = {e}\npoisson_ratio = {nu}\nyield_stress = {y}\n{hardening}[particle.p]\nradius = {RADIUS}\nmaterial = "m"\n')
        words = ["--resolution", str(CELLS), "--no-estimate", "--ramp", str(RAMP[int(case["stiffness"])])] if by == "solver" else ["--by", "law"]
        made = subprocess.run([mpm, "press", toml, "--particle", "p", "--planes", planes, "--depth", f"{case['depth']:.6f}", *words, "-o", f"{stem}.part.csv", "--json"],
                              capture_output=True, text=True)
        if made.returncode:
            trace.write_text("")
            print(case["number"], by, made.stderr.strip(), flush=True)
        else:
            Path(f"{stem}.json").write_text(made.stdout)
            Path(f"{stem}.part.csv").rename(trace)
    if not trace.read_text():
        return None
    with open(trace) as f:
        rows = list(csv.DictReader(f))
    forces = np.array([[float(r[f"force_{k + 1}_N"]) for k in range(len(case["speeds"]))] for r in rows]) / (y * RADIUS**2)
    return np.array([float(r["delta_m"]) for r in rows]) / RADIUS, forces, np.array([r["branch"] == "load" for r in rows])


def smooth(values, width=9):
    """The resolved forces have the ripple of the grid: a mean over 1 % of the way."""
    padded = np.pad(values, ((width // 2, width // 2), (0, 0)), mode="edge")
    return np.stack([np.convolve(padded[:, k], np.ones(width) / width, mode="valid") for k in range(values.shape[1])], axis=1)


def at(ways, values, where):
    return np.array([np.interp(where, ways, values[:, k]) for k in range(values.shape[1])])


def compare(case, law, solver):
    """One row for each density on the way in, and one for the way back."""
    head = {"case": case["number"], "planes": len(case["speeds"]), "stiffness": case["stiffness"], "nu": round(case["nu"], 3), "hardening": round(case["hardening"], 4),
            "depth": round(case["depth"], 4)}
    loads = [(w[load], f[load]) for w, f, load in (law, solver)]
    loads[1] = (loads[1][0], smooth(loads[1][1]))
    ways, densities = case["density"]
    top = np.interp(case["depth"], ways, densities)
    for d in [*[d for d in DENSITIES if densities[0] < d < top - 0.01], top]:
        where = np.interp(d, densities, ways) if d < top else case["depth"] * 0.99
        a, b = (at(w, f, where) for w, f in loads)
        p, q = ((f * (1 - where * case["speeds"])).sum() for f in (a, b))
        if q / (4 * math.pi) > 0.05:  # Y: below, the pair law acts
            yield head | {"branch": "load", "density": round(float(d), 3), "pressure": round(q / (4 * math.pi), 4), "stress_error": round(p / q - 1, 4),
                          "force_error": round(float(np.linalg.norm(a - b) / np.linalg.norm(b)), 4)}
    back = [(w[~load][::-1], f[~load][::-1]) for w, f, load in (law, solver)]  # ways ascend
    where = np.linspace(min(w[0] for w, _ in back), case["depth"], 200)
    on_the_way = [np.array([at(w, np.where(w[:, None] >= 0, f, 0), x) for x in where]) for w, f in back]
    a, b = ((f * (1 - where[:, None] * case["speeds"]))[:, case["speeds"] > 0].sum(axis=1) for f in on_the_way)
    worst = max(a - b, key=abs) / b[-1]
    peak = on_the_way[1][-1]
    standing = (case["speeds"] == 0) & (peak > 0.2 * peak.max())
    held = float(max((np.abs(on_the_way[0] - on_the_way[1]) / peak)[:, k].max() for k in np.flatnonzero(standing))) if standing.any() else ""
    yield head | {"branch": "unload", "density": round(float(top), 3), "pressure": round(float(b[-1]) / (4 * math.pi), 4), "stress_error": round(float(worst), 4),
                  "held_error": held and round(held, 4)}


def say(name, of):
    if not of:
        return
    stress = np.abs([r["stress_error"] for r in of])
    line = f"{name:32} {len(of):4} rows: stress median {100 * np.median(stress):.1f}, 95 % {100 * np.quantile(stress, 0.95):.1f}, worst {100 * stress.max():.1f} %"
    if "force_error" in of[0]:
        force = np.array([r["force_error"] for r in of])
        line += f"; forces median {100 * np.median(force):.1f}, 95 % {100 * np.quantile(force, 0.95):.1f}, worst {100 * force.max():.1f} %"
    if held := [r["held_error"] for r in of if r.get("held_error")]:
        line += f"; standing planes median {100 * np.median(held):.0f}, worst {100 * max(held):.0f} %"
    print(line)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("mpm")
    parser.add_argument("folder", type=Path)
    parser.add_argument("csv", type=Path)
    words = parser.parse_args()
    words.folder.mkdir(parents=True, exist_ok=True)
    rows = []
    for case in itertools.chain(named(), cases()):
        solver = run(words.mpm, words.folder, case, "solver")
        law = run(words.mpm, words.folder, case, "law")
        if solver and law:
            rows += compare(case, law, solver)
    with open(words.csv, "w", newline="") as f:
        table = csv.DictWriter(f, ["case", "planes", "stiffness", "nu", "hardening", "depth", "branch", "density", "pressure", "stress_error", "force_error", "held_error"])
        table.writeheader(), table.writerows(rows)
    for r in rows:
        if isinstance(r["case"], str) and (r["branch"] == "unload" or r["density"] > 0.99 * max(q["density"] for q in rows if q["case"] == r["case"])):
            print(*(f"{k} {v}" for k, v in r.items() if k in ("case", "branch", "pressure", "stress_error", "force_error", "held_error")))
    load, back = ([r for r in rows if r["branch"] == b and not isinstance(r["case"], str)] for b in ("load", "unload"))
    say("all, to density .9", [r for r in load if r["density"] <= 0.9])
    say("all, .9 to 1", [r for r in load if r["density"] > 0.9])
    for stiffness in (30, 100, 1000):
        for low, high in ((0, 0.9), (0.9, 2)):
            say(f"E*/Y {stiffness}, {low} to {high}", [r for r in load if r["stiffness"] == stiffness and low < r["density"] <= high and not r["hardening"]])
    say("hardening", [r for r in load if r["hardening"]])
    for low, high in ((4, 6), (7, 9), (10, 12)):
        say(f"{low} to {high} planes", [r for r in load if low <= r["planes"] <= high])
    say("unloading, of the peak", back)


if __name__ == "__main__":
    main()
