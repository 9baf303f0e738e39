#!/usr/bin/python3
"""Draws a pair's law: plot_pair.py PICTURE, curves as JSON on stdin (pair_curves.hpp). Called by `mpm plot --pair`.

Left, force against overlap with unloading branches; right, e against approach speed."""
import json
import pathlib
import sys
import textwrap

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2] / "examples/common"))  # in the sources; else it lies beside
import one_sentence  # noqa: E402, F401
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

STYLES = {"law": dict(color="C0", lw=1.8), "still": dict(color="C0", lw=1.2, ls=":"), "rule": dict(color="C1", lw=1.3, ls="--"),
          "other": dict(color="C0", lw=0.5, alpha=0.5), "formula": dict(color="k", lw=1, ls="-.")}


class Axis:
    """One label for all lines of a name."""

    def __init__(self, axis):
        self.axis, self.named = axis, set()

    def line(self, x, y, of):
        self.axis.plot(x, y, label=None if of["name"] in self.named else of["name"], **STYLES[of["role"]])
        self.named.add(of["name"])


def draw_forces(axis, lines):
    top = 0.0
    for of in lines:
        for branch in (of, *of["unloading"]):
            axis.line([1e6 * d for d in branch["overlap_m"]], branch["force_N"], of)
        if of["role"] != "formula":
            top = max(top, *of["force_N"])
    axis.axis.set(xlabel="overlap, µm", ylabel="force, N", xlim=(0, None), ylim=(0, 1.15 * top))  # Hertz leaves the picture


def draw_restitutions(axis, lines):
    for of in lines:
        axis.line(of["velocity_m_per_s"], of["e"], of)
    axis.axis.set(xscale="log", ylim=(None, 1.02), xlabel="approach speed, m/s", ylabel="coefficient of restitution e")


def main(picture):
    curves = json.load(sys.stdin)
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4.2))
    draw_forces(Axis(left), curves["force"])
    draw_restitutions(Axis(right), curves["restitution"])
    left.set_title("Force: loading and unloading", fontsize=10)
    right.set_title("Restitution", fontsize=10)
    for axis in (left, right):
        axis.grid(alpha=0.3)
        axis.legend(fontsize=8)
    figure.suptitle(textwrap.fill(curves["title"], 120), fontsize=10)
    figure.tight_layout()
    figure.savefig(picture, dpi=150)


if __name__ == "__main__":
    main(sys.argv[1])
