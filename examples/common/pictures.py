"""Pictures for the examples' reports."""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

COLOURS = {"hertz": "0.35", "thornton": "tab:orange", "mpm": "tab:blue"}


def colour(name):
    """Colour of a model, or of a variant of it, in the order in which they come."""
    return COLOURS.setdefault(name, f"C{2 + len(COLOURS)}")


def panels(count, width=4.2, height=3.2):
    figure, axes = plt.subplots(1, count, figsize=(width * count, height), constrained_layout=True, squeeze=False)
    return figure, axes[0]


def band(ax, x, curves, model, log=False, line="-"):
    """Mean of the seeds' curves (rows) with their range."""
    curves = np.asarray(curves)
    ax.plot(x, curves.mean(axis=0), color=colour(model), label=model, lw=1.3, ls=line)
    if len(curves) > 1:
        ax.fill_between(x, curves.min(axis=0), curves.max(axis=0), color=colour(model), alpha=0.2, lw=0)
    if log:
        ax.set_yscale("log")


def save(figure, path):
    figure.savefig(path, dpi=90)
    plt.close(figure)
