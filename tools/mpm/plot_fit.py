#!/usr/bin/python3
"""Draws data, fit and its 95 % band: plot_fit.py PICTURE, the result as JSON on stdin. Called by `mpm calibrate --plot`."""
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
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullFormatter

# kind: name of the panel, quantities of both axes with their SI unit ("": a pure number)
PANELS = {
    "restitution": ("Drops", ("impact speed", "m/s"), ("coefficient of restitution", "")),
    "platens": ("Between two platens", ("displacement", "m"), ("force", "N")),
    "flat": ("On a flat", ("displacement", "m"), ("force", "N")),
    "sphere": ("Spherical indenter", ("displacement", "m"), ("force", "N")),
    "contact radius": ("Contact radius", ("impact speed", "m/s"), ("contact radius", "m")),
    "residual displacement": ("Residual displacement", ("impact speed", "m/s"), ("residual displacement", "m")),
    "contact time": ("Contact time", ("impact speed", "m/s"), ("contact time", "s")),
    "hardness": ("Hardness", ("number of the value", ""), ("hardness", "Pa")),
    "onset force": ("Onset of yield", ("number of the value", ""), ("force at the onset of yield", "N")),
}
PREFIXES = [(1e9, "G"), (1e6, "M"), (1e3, "k"), (1, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n")]


def prefix(size, unit):
    """Factor and name of the unit in which `size` is 1 to 1000; a length is in um up to 10 mm."""
    if unit in ("", "m/s"):
        return 1, unit
    if unit == "m" and 1e-6 <= size < 1e-2:
        return 1e-6, "µm"
    for factor, name in PREFIXES:
        if size >= factor:
            return factor, name + unit
    return PREFIXES[-1][0], PREFIXES[-1][1] + unit


def with_unit(value, unit):
    factor, name = prefix(abs(value), unit)
    return f"{value / factor:.3g} {name}".strip()


def sentence(name, p):
    unit = p["unit"]
    words = name.replace("_", " ")
    if p["identifiable"]:
        return f"{words} {with_unit(p['value'], unit)} (95 %: {with_unit(p['low95'], unit)} to {with_unit(p['high95'], unit)})"
    ends = "" if p["low95"] is None or p["high95"] is None else f" (95 %: {with_unit(p['low95'], unit)} to {with_unit(p['high95'], unit)})"
    return f"{words}: {p['told']}{ends}"


def label(quantity, unit):
    return f"{quantity}, {unit}" if unit else quantity


def draw(axis, m):
    panel, (x_name, x_unit), (y_name, y_unit) = PANELS[m["kind"]]
    x, y, sd, fit, low, high = (np.array(m[k]) for k in ("x", "measured", "sd", "fit", "fit_low95", "fit_high95"))
    curve = m["kind"] in ("platens", "flat", "sphere")
    single = m["kind"] in ("hardness", "onset force")
    if single:
        x = np.arange(1, len(y) + 1)
    x_factor, x_unit = prefix(np.abs(x).max(), x_unit)
    y_factor, y_unit = prefix(np.abs(y).max(), y_unit)
    x = x / x_factor
    y, sd, fit, low, high = (values / y_factor for values in (y, sd, fit, low, high))
    order = np.arange(len(x)) if curve else np.argsort(x)
    axis.errorbar(x, y, yerr=1.96 * sd, fmt=".", ms=3 if curve else 6, lw=0.6, color="C0", label="measured, 95 %")
    axis.plot(x[order], fit[order], "C1", label="fit")
    axis.fill_between(x[order], low[order], high[order], color="C1", alpha=0.3, lw=0, label="fit, 95 %")
    axis.set_xlabel(label(x_name, x_unit))
    axis.set_ylabel(label(y_name, y_unit))
    if single:
        axis.xaxis.set_major_locator(MaxNLocator(integer=True))
    elif not curve and x.min() > 0 and x.max() > 5 * x.min():
        axis.set_xscale("log")
        decades = np.log10(x.max() / x.min())
        axis.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5) if decades < 2.5 else (1,)))
        axis.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axis.xaxis.set_minor_formatter(NullFormatter())
    else:
        axis.xaxis.set_major_locator(MaxNLocator(6))
    name = m["source"].rsplit("/", 1)[-1]
    axis.set_title(panel + ": " + (name if len(name) <= 40 else name[:37] + "..."), fontsize=9)
    axis.legend(fontsize=8)


def main(picture):
    r = json.load(sys.stdin)
    several = r["measurements"]
    width = 5.5 * len(several)
    figure, axes = plt.subplots(1, len(several), figsize=(width, 4.4), squeeze=False, layout="constrained")
    for axis, m in zip(axes[0], several):
        draw(axis, m)
    # 15 letters of 9 points to an inch
    lines = [line for name, p in r["parameters"].items() for line in textwrap.wrap(sentence(name, p), int(15 * width))]
    figure.suptitle("\n".join(lines), fontsize=9)
    figure.savefig(picture, dpi=150)


if __name__ == "__main__":
    main(*sys.argv[1:])
