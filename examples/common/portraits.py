#!/usr/bin/python3
"""Pictures of the examples' README.md that no run draws: the particles of clumps and irregular, and the silo beside its rates. portraits.py (writes them into their folders)."""
import sys
from pathlib import Path

import one_sentence  # noqa: F401
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

EXAMPLES = Path(__file__).resolve().parents[1]


def ball(axis, centre, radius, colour):
    u, v = np.mgrid[0:2 * np.pi:40j, 0:np.pi:20j]
    axis.plot_surface(*(c + radius * w for c, w in zip(centre, (np.cos(u) * np.sin(v), np.sin(u) * np.sin(v), np.cos(v)))), color=colour, linewidth=0)


def solid(figure, place, title, reach):
    axis = figure.add_subplot(*place, projection="3d")
    axis.set(xlim=(-reach, reach), ylim=(-reach, reach), zlim=(-reach, reach), title=title)
    axis.set_box_aspect((1, 1, 1))
    axis.set_axis_off()
    return axis


def triangles(path):
    """Triangles of a binary STL file: 80 bytes, their number, then normal, three corners and two bytes each."""
    data = path.read_bytes()
    record = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    return np.frombuffer(data, record, count=int(np.frombuffer(data, "<u4", 1, 80)[0]), offset=84)["corners"]


def irregular():
    figure = plt.figure(figsize=(7, 3.4))
    grain = triangles(EXAMPLES / "irregular/grain.stl")
    normal = np.cross(grain[:, 1] - grain[:, 0], grain[:, 2] - grain[:, 0])
    light = 0.55 + 0.4 * (normal @ np.array([0.3, -0.5, 0.8])) / np.linalg.norm(normal, axis=1)
    axis = solid(figure, (1, 2, 1), "the grain: a mesh of 1280 triangles", 1.1)
    axis.add_collection3d(Poly3DCollection(grain, facecolors=plt.cm.cividis(np.clip(light, 0, 1)), linewidths=0))
    axis = solid(figure, (1, 2, 2), "the same as a clump of 12 spheres", 1.1)
    for k, row in enumerate(np.loadtxt(EXAMPLES / "irregular/grain.clump")):
        ball(axis, row[:3], row[3], plt.cm.tab20(k))
    figure.tight_layout()
    figure.savefig(EXAMPLES / "irregular/grain.png", dpi=90)


def clumps():
    sys.path[:0] = [str(EXAMPLES / "clumps"), str(EXAMPLES / "common")]
    import run
    words = run.three_spheres().split("spheres ", 2)[2].split()
    spheres = np.array(words[:12], dtype=float).reshape(3, 4) / run.RADIUS
    figure = plt.figure(figsize=(7, 3.4))
    axis = solid(figure, (1, 2, 1), "a clump of three spheres", 1.6)
    for k, row in enumerate(spheres):
        ball(axis, row[:3] - spheres[:, :3].mean(axis=0), row[3], plt.cm.tab20(2 * k))
    ball(solid(figure, (1, 2, 2), "a sphere of the same volume", 1.6), (0, 0, 0), (spheres[:, 3] ** 3).sum() ** (1 / 3), "tab:gray")
    figure.tight_layout()
    figure.savefig(EXAMPLES / "clumps/clump.png", dpi=90)


def silo():
    """Radii and cone of run.py, usual size; rates of README.md: mean and standard error of three seeds over Beverloo's 1.881 kg/s."""
    figure, (section, rates) = plt.subplots(1, 2, figsize=(7, 3.4))
    orifice, cylinder, height = 0.03, 0.06, 0.25
    cone = cylinder - orifice  # 45 degrees
    for side in (-1, 1):
        section.plot(side * np.array([orifice, cylinder, cylinder]), [0, cone, cone + height], "k", lw=2)
    section.annotate("", (-orifice, -0.01), (orifice, -0.01), arrowprops={"arrowstyle": "<->"})
    section.text(0, -0.03, "orifice 0.06 m", ha="center", fontsize=8)
    section.set(aspect="equal", xlim=(-0.1, 0.1), ylim=(-0.05, 0.3), title="the silo, usual size; m")
    for place, (model, mean, error) in enumerate((("hertz", 1.056, 0.002), ("thornton", 1.060, 0.001), ("mpm", 1.057, 0.001))):
        rates.errorbar(place, mean, error, marker="o", capsize=4)
        rates.text(place, mean + 0.004, f"{mean:.3f}", ha="center", fontsize=8)
    rates.set(xticks=range(3), xticklabels=("hertz", "thornton", "mpm"), xlim=(-0.5, 2.5), ylim=(1.0, 1.1), title="discharge rate / Beverloo", ylabel="3 seeds, ± standard error")
    figure.tight_layout()
    figure.savefig(EXAMPLES / "silo/silo.png", dpi=90)


if __name__ == "__main__":
    irregular()
    clumps()
    silo()
