#!/usr/bin/python3
"""The map: where Hertz is enough, where a contact law pays, and where no law of one contact is right.

    PYTHONPATH=build/release/tools/python docs/map_picture.py -o docs/map.png

A sphere against a rigid wall (two equal spheres: twice the speed, since each takes half). Lines are the laws' own (granulaw.table, nu = 0.3, no
hardening): speed of first yield, speeds where e is 0.9, 0.7 and 0.5, and speed where the overlap is 0.1 R. All speeds are over c* = sqrt(E*/rho), so
the lines hold for every density and size. Bars: 0.1 to 5 m/s of materials in docs/guide/yield-stress.md#values-with-their-sources. Ten seconds.
"""
import argparse
import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1] / "examples/common"))
import one_sentence  # noqa: E402, F401
import granulaw
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

POISSON = 0.3
LARGEST_OVERLAP = 0.1  # over R: beyond, the other contacts of a particle matter (docs/guide/limits.md)
RESTITUTIONS = (0.9, 0.7, 0.5)
# E (Pa), nu, density (kg/m^3), Y (Pa): the middle of the ranges of docs/guide/yield-stress.md; wax is that of the examples
MATERIALS = {"polyethylene": (0.7e9, 0.4, 950, 25e6), "polypropylene": (1.15e9, 0.4, 900, 32e6), "sucrose": (35e9, 0.3, 1590, 500e6),
             "wax": (91e6, 0.3, 920, 1e6), "aluminium 6061-T6": (69e9, 0.33, 2700, 270e6), "steel A36": (200e9, 0.3, 7850, 250e6), "aluminium 1100": (69e9, 0.33, 2700, 34e6)}


def lines(ratio):
    """V/c* of first yield, of each e, and of the largest overlap, at this E*/Y."""
    youngs, density, radius = 1e9, 1000.0, 1e-3
    e_star = youngs / (1 - POISSON**2)
    material = granulaw.Material(density=density, youngs_modulus=youngs, poisson_ratio=POISSON, yield_stress=e_star / ratio)
    pair = granulaw.table({"m": material}, ["m:wall"], damage_number=0.09).pair(radius=radius)
    sound = (e_star / density) ** 0.5
    speeds = np.geomspace(1e-10 * sound, 0.999 * pair.fastest, 150)
    e = pair.restitution(speeds)
    found = [np.exp(np.interp(-wanted, -e, np.log(speeds), right=np.nan)) for wanted in (0.9999, *RESTITUTIONS)]
    low, high = 1e-6 * sound, pair.fastest
    if pair.impact(0.999 * high)["delta_max_m"] < LARGEST_OVERLAP * radius:
        low = np.nan  # beyond the law's largest speed
    else:
        for _ in range(40):
            middle = (low * high) ** 0.5
            low, high = (middle, high) if pair.impact(middle)["delta_max_m"] < LARGEST_OVERLAP * radius else (low, middle)
    return np.array(found + [low]) / sound


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("-o", "--output", default="map.png")
    options = parser.parse_args()
    ratios = np.geomspace(20, 5000, 25)
    onset, *equal_e, deepest = np.array([lines(r) for r in ratios]).T

    figure, axes = plt.subplots(figsize=(8.6, 5.4), layout="constrained")
    axes.fill_between(ratios, 1e-7, onset, color="0.90")
    axes.fill_between(ratios, onset, np.where(np.isnan(deepest), 1, deepest), color="tab:blue", alpha=0.13)
    axes.fill_between(ratios, deepest, 1, color="tab:red", alpha=0.13)
    axes.plot(ratios, onset, color="0.35", lw=2)
    axes.plot(ratios, deepest, color="tab:red", lw=2)
    for e, speed in zip(RESTITUTIONS, equal_e):
        axes.plot(ratios, speed, color="tab:blue", lw=1.2)
        axes.annotate(f"e = {e}", (500, np.interp(500, ratios, speed)), color="tab:blue", fontsize=10, xytext=(3, 2), textcoords="offset points")
    for name, (youngs, poisson, density, stress) in MATERIALS.items():
        e_star = youngs / (1 - poisson**2)
        sound = (e_star / density) ** 0.5
        axes.plot([e_star / stress] * 2, [0.1 / sound, 5 / sound], color="k", lw=3, solid_capstyle="butt", alpha=0.75)
        axes.plot(e_star / stress, 1 / sound, "o", color="w", mec="k", ms=5)
        axes.annotate(name, (e_star / stress, 5 / sound), rotation=90, fontsize=10, ha="center", va="bottom", xytext=(0, 4), textcoords="offset points")
    axes.text(22, 4e-7, "Hertz is enough:\nno yield, e = 1", fontsize=12, color="0.3", weight="bold")
    axes.text(170, 2.4e-3, "the computed\nlaw", fontsize=13, color="tab:blue", ha="center", weight="bold")
    axes.text(250, 1.2e-1, "overlap beyond 0.1 R: the law of one contact is not enough", fontsize=12, color="tab:red", ha="center", weight="bold")
    axes.set(xscale="log", yscale="log", xlim=(20, 4000), ylim=(1e-7, 0.5), xlabel="E*/Y: elastic modulus over yield stress", ylabel="speed of impact on a rigid wall, over c* = (E*/density)$^{1/2}$")
    figure.savefig(options.output, dpi=110)


if __name__ == "__main__":
    main()
