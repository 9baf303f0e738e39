#!/usr/bin/env python3
"""Contacts of a sphere by CalculiX (Debian: apt-get install calculix-ccx), an implicit finite-element program, beside mpm.

    decks.py CASE... -o FOLDER [--cells 24 48]      writes decks and runs ccx; prints and appends a line for each to FOLDER/runs.csv
    decks.py --list                                 the cases
    decks.py --compare runs.csv --mpm MPM -o FOLDER runs `mpm press`, writes FOLDER/calculix.csv, prints the table of docs/evidence/calculix.md

Axisymmetric 4-node elements, contact of face to face by a penalty, J2 plasticity at finite strains. ccx compares the Cauchy
stress with the yield stress (incplas.f multiplies the yield stress by J before it is compared with Kirchhoff's), as mpm does;
its elasticity is that of Simo, where mpm has Hencky's. Units of a deck: R = E* = rho = 1.
"""
import argparse
import csv
import json
import math
import os
import re
import subprocess
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

PENALTY = 20000.0  # E*/R: surfaces overlap by pressure/PENALTY, 3 Y/PENALTY = 1.5e-6 R at E*/Y = 100
WEDGE = 180.0  # ccx computes a wedge of 2 degrees


@dataclass(frozen=True)
class Case:
    name: str
    e_over_y: float  # E*/Y; 0: elastic
    depth: float = 0  # of a press by the equator's plane, R
    block: float = 0.3  # side of the uniform block of cells at the pole, R
    residual: float = 0  # residual overlap/depth, roughly: unloading ends a little below
    nu: float = 0.3
    hardening: float = 0  # H/E, H per plastic strain
    core: tuple = ()  # radius, E over the shell's, E*/Y of the core with the shell's E*
    flat: tuple = ()  # E over the sphere's, nu: an elastic flat instead of the rigid plane


CASES = {c.name: c for c in (
    Case("elastic", 0, 0.01, 0.14, 0.02),
    Case("EY100_d0.02", 100, 0.02, 0.28, 0.61),
    Case("EY100_d0.1", 100, 0.1, 0.62, 0.85),
    Case("EY50_d0.05", 50, 0.05, 0.42, 0.6),
    Case("EY1000_d0.02", 1000, 0.02, 0.3, 0.93),
    Case("hardening_EY100_d0.1", 100, 0.1, 0.6, 0.78, hardening=0.1),
    Case("core_EY100_d0.05", 100, 0.05, 0.45, 0.7, core=(0.7, 3.0, 30.0)),
    # case 1 of Ghaednia and others: E = 200 GPa of both, nu = 0.33, Y = 0.5 GPa, H = 8.333 GPa
    Case("flat_ghaednia1_d0.05", 200 / 0.5 / (1 - 0.33**2), 0.05, 0.38, 0.8, nu=0.33, hardening=8.33333 / 200, flat=(1.0, 0.33)),
    Case("rigid_ghaednia1_d0.05", 200 / 0.5 / (1 - 0.33**2), 0.05, 0.38, 0.8, nu=0.33, hardening=8.33333 / 200),
)}


class Mesh:
    """4-node quadrilaterals on lattices of points, joined where points coincide."""

    def __init__(self):
        self.points, self.index, self.elements = [], {}, []

    def node(self, r, z):
        key = (round(r, 9), round(z, 9))
        if key not in self.index:
            self.index[key] = len(self.points) + 1
            self.points.append((max(r, 0.0), z))
        return self.index[key]

    def lattice(self, x):
        """Elements between points x[i][j] = (r, z); their numbers."""
        ids = [[self.node(*p) for p in row] for row in x]
        begin = len(self.elements)
        for i in range(len(x) - 1):
            for j in range(len(x[0]) - 1):
                corners = [ids[i][j], ids[i + 1][j], ids[i + 1][j + 1], ids[i][j + 1]]
                p = [self.points[c - 1] for c in corners]
                area = sum(p[k][0] * p[(k + 1) % 4][1] - p[(k + 1) % 4][0] * p[k][1] for k in range(4))
                self.elements.append(corners if area > 0 else corners[::-1])
        return list(range(begin + 1, len(self.elements) + 1))

    def where(self, test):
        return [n for n, p in enumerate(self.points, 1) if test(*p)]

    def faces(self, elements, nodes):
        """(element, face) whose two nodes are among `nodes`."""
        nodes = set(nodes)
        return [(e, f + 1) for e in elements for f in range(4)
                if self.elements[e - 1][f] in nodes and self.elements[e - 1][(f + 1) % 4] in nodes]


def geometric(n, first):
    """n + 1 points from 0 to 1 whose first step is `first`, each longer than the last in one ratio."""
    if first * n >= 1:
        return np.linspace(0, 1, n + 1)
    low, high = 1.0 + 1e-9, 20.0
    for _ in range(200):
        q = (low + high) / 2
        low, high = (q, high) if (q**n - 1) / (q - 1) * first < 1 else (low, q)
    return (q**np.arange(n + 1) - 1) / (q**n - 1)


def rings(first, total, growth):
    """Number of steps to `total`, each longer than the last by `growth`."""
    return max(4, math.ceil(math.log(1 + total / first * growth) / math.log(1 + growth)))


def patch(bottom, top, left, right, u, v):
    """Points between four curves of [0, 1]; bottom and top run along u, left and right along v."""
    at = lambda curve, t: np.array(curve(t))  # noqa: E731
    return [[tuple((1 - b) * at(bottom, a) + b * at(top, a) + (1 - a) * at(left, b) + a * at(right, b)
                   - (1 - a) * (1 - b) * at(bottom, 0) - a * (1 - b) * at(bottom, 1) - (1 - a) * b * at(top, 0) - a * b * at(top, 1))
             for b in v] for a in u]


def line(p, q):
    return lambda t: (p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]))


def arc(a, b, radius=1.0):
    """Part of a circle, from polar angle a to b, measured from the lower pole."""
    return lambda t: (radius * math.sin(a + t * (b - a)), -radius * math.cos(a + t * (b - a)))


def joined(first, second):
    return lambda t: first(2 * t) if t <= 0.5 else second(2 * t - 1)


def ball(mesh, block, n):
    """The sphere's lower half: n x n equal cells at the pole (0, -1), rings that grow to the equator."""
    edge, inner, axis = (math.sin(block), -math.cos(block)), (0.92 * math.sin(block), -1 + block), (0.0, -1 + block)
    even, along = np.linspace(0, 1, n + 1), np.linspace(0, 1, 2 * n + 1)
    mesh.lattice(patch(arc(0, block), line(axis, inner), line((0.0, -1.0), axis), line(edge, inner), even, even))
    first = block / n / (1 - block)
    out = geometric(rings(first, 1, 4 / n), first)
    mesh.lattice(patch(joined(line(edge, inner), line(inner, axis)), line((1.0, 0.0), (0.0, 0.0)), arc(block, math.pi / 2),
                       line(axis, (0.0, 0.0)), along, out))


def layered(mesh, block, n, radius):
    """A core of that radius in a shell, lower half; the core's elements."""
    first = block / n / (math.pi / 4 - block)
    fine = np.concatenate([np.linspace(0, block, n + 1)[:-1], block + (math.pi / 4 - block) * geometric(rings(first, 1, 6 / n), first)])
    rest = np.linspace(0, 1, 2 + round((math.pi / 4) / (fine[-1] - fine[-2])))
    angles = np.concatenate([fine, math.pi / 4 * (1 + rest[1:])])
    inward = geometric(rings(block / n / (1 - radius), 1, 2 / n), block / n / (1 - radius))
    mesh.lattice([[((1 - (1 - radius) * s) * math.sin(a), -(1 - (1 - radius) * s) * math.cos(a)) for s in inward] for a in angles])
    return mesh.lattice(patch(arc(0, math.pi / 4, radius), line((0.0, 0.0), (radius, 0.0)), line((0.0, -radius), (0.0, 0.0)),
                              arc(math.pi / 4, math.pi / 2, radius), fine / (math.pi / 4), rest))


def material(name, e, nu, yield_stress=0.0, hardening=0.0):
    """Without a yield stress it is 1e6 E: ccx then takes the elasticity that it has for plastic bodies, and not that of Saint Venant
    and Kirchhoff, which softens under pressure (5 % of F at 0.01 R)."""
    y = yield_stress or 1e6 * e
    return [f"*MATERIAL, NAME={name}", "*ELASTIC", f"{e:.12g}, {nu:.12g}", "*DENSITY", "1.0",
            "*PLASTIC", f"{y:.12g}, 0", f"{y + 10 * hardening:.12g}, 10"]


def members(kind, name, ids):
    return [f"*{kind}, {kind}={name}"] + [", ".join(map(str, ids[k:k + 12])) + "," for k in range(0, len(ids), 12)]


def deck(case, n, steps):
    """Text of the deck and the mesh."""
    mesh = Mesh()
    core = layered(mesh, case.block, n, case.core[0]) if case.core else ball(mesh, case.block, n) or []
    sphere = sorted(set(range(1, len(mesh.elements) + 1)) - set(core))
    of_ball = len(mesh.points)
    surface = mesh.where(lambda r, z: abs(math.hypot(r, z) - 1) < 1e-7 and z < -0.3)
    equator = mesh.where(lambda r, z: abs(z) < 1e-9)

    gap, needle = 1e-7, 0.02 * case.block / n  # ccx finds no contact on a face with an edge on the axis: a hole of that radius
    if case.flat:
        reach, h = 40.0, case.block / n
        grow = np.concatenate([np.linspace(0, case.block, n + 1)[:-1],
                               case.block + (reach - case.block) * geometric(rings(h, reach - case.block, 8 / n), h / (reach - case.block))])
        flat = mesh.lattice([[(a, -1 - gap - b) for b in grow] for a in grow])
        held = [k for k in mesh.where(lambda r, z: z < -reach) if k > of_ball]
    else:
        flat = mesh.lattice([[(1.5 * a, -1 - gap - 0.2 * b) for b in (0, 1)] for a in np.linspace(0, 1, 16)])
        held = list(range(of_ball + 1, len(mesh.points) + 1))
    plane = [k for k in mesh.where(lambda r, z: abs(z + 1 + gap) < 1e-9 and r < 2.5) if k > of_ball]
    axis = mesh.where(lambda r, z: r < 1e-9)

    out = ["*HEADING", f"{case.name}, {n} cells", "*NODE, NSET=ALL"]
    out += [f"{k}, {max(r, needle):.14g}, {z:.14g}, 0" for k, (r, z) in enumerate(mesh.points, 1)]
    parts = [("SHELL", sphere), ("CORE", core), ("PLATE", flat)]
    for name, ids in parts:
        if ids:
            out.append(f"*ELEMENT, TYPE=CAX4, ELSET={name}")
            out += [f"{e}, " + ", ".join(map(str, mesh.elements[e - 1])) for e in ids]
    for name, ids in (("EQUATOR", equator), ("AXIS", axis), ("HELD", held)):
        out += members("NSET", name, ids)
    e = 1 - case.nu**2
    y = 1 / case.e_over_y if case.e_over_y else 0
    out += material("SHELL", e, case.nu, y, case.hardening * e)
    if case.core:
        out += material("CORE", case.core[1] * e, case.nu, 1 / case.core[2])
    out += material("PLATE", *((case.flat[0] * e, case.flat[1]) if case.flat else (1.0, 0.3)))
    out += [f"*SOLID SECTION, ELSET={name}, MATERIAL={name}" for name, ids in parts if ids]
    for name, ids, nodes in (("OFSPHERE", sphere, surface), ("OFFLAT", flat, plane)):
        out += [f"*SURFACE, NAME={name}, TYPE=ELEMENT"] + [f"{e}, S{f}" for e, f in mesh.faces(ids, nodes)]
    out += ["*SURFACE INTERACTION, NAME=HARD", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", f"{PENALTY:g}",
            "*CONTACT PAIR, INTERACTION=HARD, TYPE=SURFACE TO SURFACE", "OFSPHERE, OFFLAT", "*BOUNDARY", "AXIS, 1", "HELD, 1, 2"]
    prints = ["*NODE PRINT, NSET=HELD, TOTALS=ONLY", "RF"]
    for end in (-case.depth, -0.97 * case.residual * case.depth):
        out += [f"*STEP, NLGEOM, INC={100 * steps}", "*STATIC", f"{1 / steps:.12g}, 1, 1e-6, {1 / steps:.12g}",
                "*BOUNDARY", f"EQUATOR, 2, 2, {end:.12g}", *prints, "*END STEP"]
    return "\n".join(out) + "\n", mesh


def forces(path):
    """(time, force) that `path` has, force in E* R^2 of the whole circle."""
    number = r"total force \(fx,fy,fz\) for set HELD and time\s+(\S+)\s*\n\s*\n\s*\S+\s+(\S+)"
    found = re.findall(number, path.read_text())
    return np.array([(float(t), abs(float(f)) * WEDGE) for t, f in found])


def press_of(case, rows):
    """F at the depth (a fit, as the edge of the contact goes from node to node), rms of the fit, e and residual overlap/depth."""
    load, back = rows[rows[:, 0] <= 1 + 1e-9], rows[rows[:, 0] >= 1 - 1e-9]
    x = load[:, 0] * case.depth
    some = load[:, 0] > 0.25
    fit = np.polyfit(np.sqrt(x[some] / case.depth), load[some, 1] / x[some], 3)
    smooth = lambda u: np.polyval(fit, np.sqrt(u / case.depth)) * u  # noqa: E731
    rms = float(np.sqrt(np.mean((load[some, 1] / smooth(x[some]) - 1)**2)))
    force = float(smooth(case.depth))
    work = np.trapezoid if hasattr(np, "trapezoid") else np.trapz
    first = x <= x[some][0]
    # to the first fitted point F ~ delta^1.25 between points is close to a straight line; beyond it the fit
    grid = np.linspace(x[some][0], case.depth, 400)
    loading = work(np.r_[0, load[first, 1]], np.r_[0, x[first]]) + work(smooth(grid), grid)
    end = 0.97 * case.residual
    u = case.depth * (1 - (back[:, 0] - 1) * (1 - end))
    # the unloading curve starts at the run's own force, the work is scaled to the fit's: one contact area on both
    unloading = -work(back[:, 1], u) * force / back[0, 1]
    touching = np.flatnonzero(back[:, 1] > 1e-3 * back[0, 1])
    a, b = touching[-2], touching[-1]
    fa, fb = back[a, 1]**(2 / 3), back[b, 1]**(2 / 3)
    residual = u[b] - fb * (u[a] - u[b]) / (fa - fb)
    return {"force": force, "ripple": rms, "e": math.sqrt(unloading / loading), "residual": float(residual / case.depth)}


def run(case, n, steps, folder):
    text, mesh = deck(case, n, steps)
    folder.mkdir(parents=True, exist_ok=True)
    name = folder / f"{case.name}_{n}_{steps}"
    Path(f"{name}.inp").write_text(text)
    began = time.time()
    done = subprocess.run(["ccx", name.name], cwd=folder, capture_output=True, text=True, env={**os.environ, "OMP_NUM_THREADS": "1"})
    row = {"case": case.name, "cells": n, "steps": steps, "elements": len(mesh.elements), "wall_s": round(time.time() - began)}
    if "Job finished" not in done.stdout:
        raise SystemExit(f"{name}: ccx did not finish: {done.stdout[-400:]}")
    rows = forces(Path(f"{name}.dat"))
    row |= press_of(case, rows)
    row["force"] *= case.e_over_y or 1
    return row


def extrapolated(runs):
    """{quantity: (value, uncertainty)} of a case's runs, to no cell size and no step.

    Cells: from 24 and the finest, as the error falls like the cell size; the uncertainty is at least the change if the two finest
    are taken instead. Steps: by the change of 24 cells from 40 steps to more,
    as 1/steps; where there is none, no correction but an uncertainty as large as the largest that was found (STEPS). The
    uncertainty of either is at least half of the correction; both are added."""
    plain = sorted((r for r in runs if int(r["steps"]) == 40 and int(r["cells"]) >= 24), key=lambda r: int(r["cells"]))
    coarse, near, fine = plain[0], plain[-2], plain[-1]
    more = [r for r in runs if int(r["steps"]) > 40 and r["cells"] == coarse["cells"]]
    out = {}
    for q in ("force", "e", "residual"):
        to_none = lambda first: (float(fine[q]) - float(first[q])) * int(first["cells"]) / (int(fine["cells"]) - int(first["cells"]))  # noqa: E731
        by_cells = to_none(coarse)
        doubt_of_cells = max(abs(by_cells) / 2, abs(to_none(near) - by_cells))
        by_steps, doubt = 0.0, STEPS[q] * (float(fine[q]) if q == "force" else 1)
        if more:
            by_steps = (float(more[0][q]) - float(coarse[q])) / (1 - 40 / int(more[0]["steps"]))
            doubt = abs(by_steps) / 2
        out[q] = float(fine[q]) + by_cells + by_steps, doubt_of_cells + doubt
    return out


STEPS = {"force": 0.0064, "e": 0.0007, "residual": 0.0005}  # of F relative; EY100_d0.1 and EY1000_d0.02, 24 cells, 40 steps to infinitely many


def by_mpm(case, mpm, folder):
    """The same press by mpm: E* of 1 GPa, R of 1 mm."""
    e = 1e9 * (1 - case.nu**2)
    lines = ["[material.shell]", "density = 1000", f"youngs_modulus = {e}", f"poisson_ratio = {case.nu}"]
    if case.e_over_y:
        lines.append(f"yield_stress = {1e9 / case.e_over_y}")
    if case.hardening:
        lines.append(f'hardening = {{law = "linear", modulus = {case.hardening * e}}}')
    if case.core:
        radius, ratio, e_over_y = case.core
        lines += ["[material.core]", "density = 1000", f"youngs_modulus = {ratio * e}", f"poisson_ratio = {case.nu}", f"yield_stress = {1e9 / e_over_y}",
                  "[particle.p]", "radius = 1e-3", 'material = "core"', f'layers = [{{material = "shell", thickness = {(1 - radius) * 1e-3}}}]']
    else:
        lines += ["[particle.p]", "radius = 1e-3", 'material = "shell"']
    path = folder / f"{case.name}.toml"
    path.write_text("\n".join(lines) + "\n")
    found = json.loads(subprocess.run([mpm, "press", path, "--particle", "p", "--depth", str(case.depth), "--support", "midplane", "--json"],
                                      check=True, capture_output=True, text=True).stdout)
    return {"force": found["force_max_N"] * (case.e_over_y or 1) / 1e3, "e": found["e"], "residual": found["delta_residual_m"] / (case.depth * 1e-3),
            "estimate": found["error_estimate"]}


def compare(path, mpm, folder):
    with path.open() as file:
        runs = list(csv.DictReader(file))
    rows = []
    for name in dict.fromkeys(r["case"] for r in runs):
        case = CASES[name]
        theirs = extrapolated([r for r in runs if r["case"] == name])
        ours = None if case.flat else by_mpm(case, mpm, folder)
        row = {"case": name}
        for q, (value, doubt) in theirs.items():
            row |= {q: f"{value:.4f}", f"{q}_uncertainty": f"{doubt:.4f}", f"{q}_mpm": f"{ours[q]:.4f}" if ours else ""}
        row["mpm_estimate"] = f"{ours['estimate']:.4f}" if ours else ""
        rows.append(row)
        cell = lambda q: f"{row[q]} ± {row[q + '_uncertainty']} | {row[q + '_mpm']}"  # noqa: E731
        print(f"| `{name}` | {cell('force')} | {cell('e')} | {cell('residual')} |", flush=True)
    with (folder / "calculix.csv").open("w") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cases", nargs="*", metavar="CASE")
    parser.add_argument("-o", "--output", type=Path)
    parser.add_argument("--cells", type=int, nargs="+", default=[24, 48])
    parser.add_argument("--steps", type=int, default=40)
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--compare", type=Path, metavar="RUNS")
    parser.add_argument("--mpm")
    words = parser.parse_args()
    if words.list:
        print("\n".join(CASES))
        return
    if words.compare and words.mpm and words.output:
        compare(words.compare, words.mpm, words.output)
        return
    if not words.cases or not words.output:
        parser.error("CASE and -o are needed")
    for name in words.cases:
        for n in words.cells:
            row = run(CASES[name], n, words.steps, words.output)
            path = words.output / "runs.csv"
            new = not path.exists()
            with path.open("a") as file:
                writer = csv.DictWriter(file, list(row), lineterminator="\n")
                if new:
                    writer.writeheader()
                writer.writerow(row)
            print(row, flush=True)


if __name__ == "__main__":
    main()
