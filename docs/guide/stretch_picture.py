#!/usr/bin/python3
"""The picture of docs/guide/plan.md: what a stretch keeps and what it changes.

    PYTHONPATH=build/release/tools/python docs/guide/stretch_picture.py -o docs/guide/stretch.png

Wax of examples/hopper, R = 3 mm, on a rigid wall at 1 m/s, as it is and stretched by 3: F(d/S)/S. Two seconds.
"""
import argparse
import sys
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
sys.path.append(str(TOP / "examples/common"))
import one_sentence  # noqa: E402, F401
import granulaw
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

RADIUS, SPEED, STRETCH = 3e-3, 1.0, 3


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("-o", "--output", default="stretch.png")
    options = parser.parse_args()
    pair = granulaw.table(TOP / "examples/hopper/materials.toml", ["wax:wall"]).pair(radius=RADIUS)
    impact = pair.impact(SPEED)
    deepest = impact["delta_max_m"]
    overlap = np.linspace(0, deepest, 400)
    loading, back = pair.force(overlap, speed=SPEED), pair.force(overlap, np.full_like(overlap, deepest), speed=SPEED)

    figure, axis = plt.subplots(figsize=(7.2, 3.6), layout="constrained")
    for stretch, colour, name in ((1, "tab:blue", "the contact as it is"), (STRETCH, "tab:purple", f"stretched by {STRETCH}")):
        x = 1e6 * stretch * overlap
        axis.plot(np.r_[x, x[::-1]], np.r_[loading, back[::-1]] / stretch, color=colour, label=name)
        axis.fill_between(x, loading / stretch, back / stretch, color=colour, alpha=0.15, lw=0)
    axis.set_title(f"equal: both areas (work, loss) and e = {impact['e']:.3f}\nthree times the overlap, contact time and time step; a third of the force", fontsize=11, loc="left")
    axis.set(xlabel="overlap, µm", ylabel="force, N", xlim=0, ylim=0)
    axis.legend()
    figure.savefig(options.output, dpi=110)


if __name__ == "__main__":
    main()
