#!/usr/bin/python3
"""Draws data, fit and its 95 % band: plot_fit.py RESULT.json PICTURE. Called by `mpm calibrate --plot`."""
import json
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2] / "examples/common"))  # in the sources; else it lies beside
import one_sentence  # noqa: E402, F401
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

AXES = {
    "restitution": ("impact speed, m/s", "coefficient of restitution"),
    "platens": ("displacement, m", "force, N"),
    "flat": ("displacement, m", "force, N"),
    "sphere": ("displacement, m", "force, N"),
    "contact radius": ("impact speed, m/s", "contact radius, m"),
    "residual displacement": ("impact speed, m/s", "residual displacement, m"),
    "contact time": ("impact speed, m/s", "contact time, s"),
    "hardness": ("", "hardness, Pa"),
    "onset force": ("", "force at the onset of yield, N"),
}


def draw(axis, m):
    x, y, sd, fit, band = (np.array(m[k]) for k in ("x", "measured", "sd", "fit", "fit_sd"))
    curve = m["kind"] in ("platens", "flat", "sphere")
    if m["kind"] in ("hardness", "onset force"):
        x = np.arange(len(y))
    order = np.arange(len(x)) if curve else np.argsort(x)
    axis.errorbar(x, y, yerr=1.96 * sd, fmt=".", ms=3 if curve else 6, lw=0.6, color="C0", label="measured, 95 %")
    axis.plot(x[order], fit[order], "C1", label="fit")
    axis.fill_between(x[order], (fit - 1.96 * band)[order], (fit + 1.96 * band)[order], color="C1", alpha=0.3, lw=0)
    axis.set_xlabel(AXES[m["kind"]][0])
    axis.set_ylabel(AXES[m["kind"]][1])
    if not curve and x.min() > 0 and x.max() > 5 * x.min():
        axis.set_xscale("log")
    axis.set_title(m["source"].rsplit("/", 1)[-1], fontsize=9)
    axis.legend(fontsize=8)


def main(result, picture):
    with open(result) as file:
        r = json.load(file)
    several = r["measurements"]
    figure, axes = plt.subplots(1, len(several), figsize=(5.5 * len(several), 4.2), squeeze=False)
    for axis, m in zip(axes[0], several):
        draw(axis, m)
    words = [f"{name} {p['value']:.3g} Pa ({p['low95']:.3g} to {p['high95']:.3g})" for name, p in r["parameters"].items()]
    figure.suptitle("; ".join(words), fontsize=9)
    figure.tight_layout()
    figure.savefig(picture, dpi=150)


if __name__ == "__main__":
    main(*sys.argv[1:])
