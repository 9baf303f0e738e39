#!/usr/bin/python3
"""Draws what the law of spheres is wrong by over a body's orientations: plot_shape.py PICTURE, the certificate
as JSON on stdin. Called by `mpm shape --plot` and `mpm plot --shape`.

Each impact direction is a dot on the whole sphere of directions (mirrored where the body is), in an equal-area
map: left the error of F_max, right that of e. Crosses: no sphere is like the contact."""
import itertools
import json
import pathlib
import sys
import textwrap

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2] / "examples/common"))  # in the sources; else it lies beside
import one_sentence  # noqa: E402, F401
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import MaxNLocator


def images(direction, mirrors):
    """The direction and its mirror images."""
    signs = [(1, -1) if mirrored else (1,) for mirrored in mirrors]
    return [np.multiply(direction, sign) for sign in itertools.product(*signs)]


def on_map(directions):
    x, y, z = np.transpose(directions)
    return np.arctan2(y, x), np.arcsin(np.clip(z, -1, 1))


def draw(axis, points, errors, unit, title):
    """`points`: directions of each check; `errors`: nan where there is no answer."""
    answered = np.isfinite(errors)
    limit = max(np.max(np.abs(errors[answered]), initial=0), 1e-9)
    places = [np.array(p) for p in points]
    for p in itertools.compress(places, ~answered):
        axis.plot(*on_map(p), "x", color="grey", ms=4)
    if answered.any():
        flat = [(q, e) for p, e in zip(places, errors) if np.isfinite(e) for q in p]
        colours = axis.scatter(*on_map([q for q, _ in flat]), c=[e for _, e in flat], cmap="RdBu_r", vmin=-limit, vmax=limit,
                               s=28, edgecolors="k", linewidths=0.3)
        axis.figure.colorbar(colours, ax=axis, orientation="horizontal", shrink=0.8, pad=0.08, label=unit, ticks=MaxNLocator(5))
    axis.set_title(title, fontsize=10)
    axis.set_xticklabels([])
    axis.set_yticklabels([])
    axis.grid(alpha=0.3)


def main(picture):
    told = json.load(sys.stdin)
    checks = told["directions"]
    points = [images(c["direction"], told["mirrors"]) for c in checks]
    force = np.array([np.nan if c["law_e"] is None else 100 * (c["law_force_max_N"] / c["force_max_N"] - 1) for c in checks])
    e = np.array([np.nan if c["law_e"] is None else c["law_e"] - c["e"] for c in checks])
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 3.4), subplot_kw={"projection": "mollweide"})
    draw(left, points, force, "law over solver, %", "largest force")
    draw(right, points, e, "law less solver", "coefficient of restitution e")
    figure.suptitle(textwrap.fill(f"{told['name']}: spheres' law at the local radius, {told['orientations']}", 120), fontsize=10, y=1.05)
    figure.savefig(picture, dpi=150, bbox_inches="tight")


if __name__ == "__main__":
    main(sys.argv[1])
