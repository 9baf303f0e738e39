#!/usr/bin/python3
"""Draws a law: plot_law.py PICTURE, curves as JSON on stdin (plot_command.cpp). Called by `mpm plot`.

Left, force against overlap with unloading branches; right, e against approach speed. A material has a colour, a law of a pair its role's line."""
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
    """One label for all lines of a name; `bodies`: names that have colours of their own."""

    def __init__(self, axis, bodies):
        self.axis, self.bodies, self.named = axis, bodies, set()

    def line(self, x, y, of):
        style = STYLES.get(of["role"]) or dict(color=f"C{self.bodies.index(of['name'])}")
        self.axis.plot(x, y, label=None if of["name"] in self.named else of["name"], **style)
        self.named.add(of["name"])


def draw_forces(axis, lines, unit, labels):
    top = 0.0
    for of in lines:
        for branch in (of, *of["unloading"]):
            axis.line([x / unit for x in branch["x"]], branch["y"], of)
        if of["role"] != "formula":
            top = max(top, *of["y"])
    axis.axis.set(xlabel=labels[0], ylabel=labels[1], xlim=(0, None), ylim=(0, 1.15 * top))  # Hertz leaves the picture
    axis.axis.set_title("Force: loading and unloading", fontsize=10)


def draw_restitutions(axis, lines, label):
    for of in lines:
        axis.line(of["x"], of["y"], of)
    axis.axis.set(xscale="log", ylim=(None, 1.02), xlabel=label, ylabel="coefficient of restitution e")
    axis.axis.set_title("Restitution", fontsize=10)


def main(picture):
    told = json.load(sys.stdin)
    figure, axes = plt.subplots(1, 2, figsize=(10, 4.2))
    bodies = [of["name"] for of in told["force"] if of["role"] == "body"]
    left, right = (Axis(axis, bodies) for axis in axes)
    draw_forces(left, told["force"], told["overlap_unit"], told["labels"])
    draw_restitutions(right, told["restitution"], told["labels"][2])
    for axis in axes:
        axis.grid(alpha=0.3)
        axis.legend(fontsize=8)
    figure.suptitle(textwrap.fill(told["title"], 120), fontsize=10)
    figure.tight_layout()
    figure.savefig(picture, dpi=150)


if __name__ == "__main__":
    main(sys.argv[1])
