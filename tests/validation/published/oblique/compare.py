#!/usr/bin/python3
"""Oblique elastic impacts of a sphere by two models of the tangential force, beside measured ones (kharaz_2001.csv).

    compare.py -o docs/evidence/published        writes oblique.csv and oblique.png
    compare.py --check docs/evidence/published/oblique.csv

spring    one displacement s for the whole contact: T = 8 G* a s, cut at mu F (LIGGGHTS's `tangential history`,
          docs/evidence/oblique.md)
resolved  each part of the contact area has a displacement and a friction limit of its own: area that arrives late
          is not yet strained, area that leaves gives up its strain, the edge slips first (Mindlin and Deresiewicz 1953).
          Computed by Popov's reduction to one dimension (Contact Mechanics and Friction, 2010, chapter 18): independent
          springs E* dx and 4 G* dx under the profile x^2/R, exact for Hertz's normal force and for Mindlin's stiffness

The normal force is Hertz's; on the way back it is e_n^2 of it, with the measured e_n = 0.98.
"""
import argparse
import csv
import math
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
E_STAR, G_STAR, RADIUS, DENSITY, FRICTION, SPEED, E_N = 63e9, 13.5e9, 2.5e-3, 4000.0, 0.092, 3.9, 0.98
MASS = DENSITY * 4 / 3 * math.pi * RADIUS**3
INERTIA = 0.4 * MASS * RADIUS**2

class Spring:
    def __init__(self, widest, parts):
        self.stretch = 0.0

    def forces(self, overlap, slide):
        stiffness, normal = 8 * G_STAR * math.sqrt(RADIUS * overlap), 4 / 3 * E_STAR * math.sqrt(RADIUS) * overlap**1.5
        self.stretch = max(-FRICTION * normal / stiffness, min(FRICTION * normal / stiffness, self.stretch + slide))
        return normal, stiffness * self.stretch

class Resolved:
    def __init__(self, widest, parts):
        self.width = widest / parts
        self.gap = ((np.arange(parts) + 0.5) * self.width)**2 / RADIUS
        self.stretch = np.zeros(parts)

    def forces(self, overlap, slide):
        normal = 2 * E_STAR * self.width * np.maximum(0, overlap - self.gap)  # both sides of the axis
        stiffness = 2 * 4 * G_STAR * self.width
        most = FRICTION * normal / stiffness  # 0 outside the contact: area that leaves gives up its strain
        self.stretch = np.clip(self.stretch + slide, -most, most)
        return normal.sum(), stiffness * self.stretch.sum()

MODELS = {"spring": Spring, "resolved": Resolved}

def impact(model, angle, steps=4000, parts=400):
    """e_t and spin after an impact at `angle` degrees from the normal."""
    fall, along, spin, overlap = SPEED * math.cos(math.radians(angle)), SPEED * math.sin(math.radians(angle)), 0.0, 0.0
    before, approach = along, fall
    deepest = (15 / 16 * MASS * fall**2 / (E_STAR * math.sqrt(RADIUS)))**0.4
    contact = MODELS[model](1.02 * math.sqrt(RADIUS * deepest), parts)
    dt = 2.87 * (MASS**2 / (RADIUS * E_STAR**2 * approach))**0.2 / steps  # of Hertz's contact time
    while True:
        overlap += fall * dt
        if overlap <= 0:
            return along / before, spin
        normal, tangential = contact.forces(overlap, (along - RADIUS * spin) * dt)
        fall -= (normal if fall > 0 else E_N**2 * normal) / MASS * dt
        along -= tangential / MASS * dt
        spin += tangential * RADIUS / INERTIA * dt

def rows():
    with open(HERE / "kharaz_2001.csv") as file:
        for r in csv.DictReader(line for line in file if not line.startswith("#")):
            found = {m: impact(m, float(r["angle_deg"]))[r["quantity"] == "spin"] for m in MODELS}
            yield {"quantity": r["quantity"], "digitisation": r["digitisation"], "angle_deg": r["angle_deg"], "measured": r["value"],
                   **{m: f"{v:.5g}" for m, v in found.items()}}

def draw(path, table):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.6), constrained_layout=True)
    angles = np.linspace(1.5, 85, 60)
    for axis, quantity, k in ((axes[0], "e_t", 0), (axes[1], "spin", 1)):
        for mark, which in (("o", "A"), ("s", "B")):
            some = [r for r in table if r["quantity"] == quantity and r["digitisation"] == which]
            axis.plot([float(r["angle_deg"]) for r in some], [float(r["measured"]) for r in some], mark, ms=4, mfc="w", color="k", label=f"measured, digitisation {which}")
        for model, colour in (("spring", "0.35"), ("resolved", "tab:blue")):
            axis.plot(angles, [impact(model, a)[k] for a in angles], color=colour, label=model)
        axis.set(xlabel="angle from the normal, degrees", ylabel={"e_t": "tangential velocity after/before", "spin": "spin after, rad/s"}[quantity])
    axes[0].legend(fontsize=7)
    figure.savefig(path, dpi=100)
    plt.close(figure)

def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path)
    parser.add_argument("--check", type=Path, metavar="CSV", help="compare with these stored rows")
    words = parser.parse_args()
    table = list(rows())
    if words.check:
        with open(words.check) as file:
            stored = list(csv.DictReader(file))
        # one code, one step: rounding alone may differ
        wrong = [f"{a} is stored as {b}" for a, b in zip(table, stored)
                 if any(not math.isclose(float(a[k]), float(b[k]), rel_tol=1e-3) for k in ("angle_deg", "measured", *MODELS))]
        print("\n".join(wrong) or f"{len(table)} rows as stored")
        sys.exit(1 if wrong or len(table) != len(stored) else 0)
    if not words.output:
        parser.error("-o or --check is needed")
    with (words.output / "oblique.csv").open("w") as file:
        writer = csv.DictWriter(file, list(table[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(table)
    draw(words.output / "oblique.png", table)
    for r in table:
        print("  ".join(r.values()))

if __name__ == "__main__":
    main()
