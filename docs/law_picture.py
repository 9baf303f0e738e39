#!/usr/bin/python3
"""The picture of README.md: what a computed contact law is, beside Hertz and Thornton.

    docs/law_picture.py --mpm build/release/tools/mpm/mpm --stats out/demo-quick/mpm/stats.json -o docs/law.png

Wax of examples/hopper, R = 3 mm. Left: one collision with a rigid wall at 1 m/s: the law (`mpm law`, `mpm export --speed 1`), the material point method itself
(`mpm impact`), Thornton's closed form, Hertz. Middle: e against the approach speed; the Hertz deck of the hopper says e = 0.55. Right: speed at first touch and
largest overlap of all contacts between particles of a hopper under the law (the `contact_map` of `fix granulaw/stats`), left out without --stats.
About a minute: the impacts.
"""
import argparse
import csv
import json
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1] / "examples/common"))
import one_sentence  # noqa: E402, F401
import matplotlib
from pictures import COLOURS

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

TOP = Path(__file__).resolve().parents[1]
MATERIALS = TOP / "examples/hopper/materials.toml"
RADIUS, DENSITY, E_STAR, YIELD = 3e-3, 920.0, 91e6 / (1 - 0.3**2), 1e6
MASS = 4 / 3 * np.pi * RADIUS**3 * DENSITY
SPEED = 1.0           # m/s, of the left picture
HERTZ_E = 0.55        # coefficientRestitution of the hopper's Hertz deck
PRESSURE = 1.6 * YIELD                                     # Thornton's yield pressure
ONSET = (np.pi * PRESSURE / (2 * E_STAR)) ** 2 * RADIUS    # overlap at which it is reached
YIELD_SPEED = (np.pi / (2 * E_STAR)) ** 2 * np.sqrt(2 / (5 * DENSITY)) * PRESSURE**2.5

def hertz(overlap):
    return 4 / 3 * E_STAR * np.sqrt(RADIUS) * overlap**1.5

def hertz_collision():
    """Loading and, without damping, the same way back."""
    largest = (15 * MASS * SPEED**2 / (16 * E_STAR * np.sqrt(RADIUS))) ** 0.4
    overlap = np.linspace(0, largest, 300)
    return overlap, hertz(overlap)

def thornton_collision():
    """Formulas: docs/reference/pair_gran_model_thornton.md."""
    overlap = np.linspace(0, 30 * ONSET + 2e-4, 20000)
    force_at_onset = hertz(ONSET)
    force = np.where(overlap < ONSET, hertz(overlap), force_at_onset + np.pi * PRESSURE * RADIUS * (overlap - ONSET))
    work = np.concatenate(([0], np.cumsum(0.5 * (force[1:] + force[:-1]) * np.diff(overlap))))
    end = np.searchsorted(work, MASS * SPEED**2 / 2)
    top = force[end]
    radius = 4 * E_STAR / (3 * top) * ((2 * top + force_at_onset) / (2 * np.pi * PRESSURE)) ** 1.5
    recovered = (top / (4 / 3 * E_STAR * np.sqrt(radius))) ** (2 / 3)
    back = np.linspace(recovered, 0, 200)
    return (np.concatenate((overlap[:end + 1], overlap[end] - recovered + back)),
            np.concatenate((force[:end + 1], 4 / 3 * E_STAR * np.sqrt(radius) * back**1.5)))

def thornton_restitution(speeds):
    x = np.minimum(YIELD_SPEED / speeds, 1.0)
    return np.where(x < 1, np.sqrt(6 * np.sqrt(3) / 5) * np.sqrt(1 - x**2 / 6) * (x / (x + 2 * np.sqrt(6 / 5 - x**2 / 5))) ** 0.25, 1.0)

class Tool:
    """mpm, and the files that it makes for the picture."""

    def __init__(self, program, folder):
        self.program, self.folder = str(program), Path(folder)
        self.law = self.folder / "wax.h5"
        self("table", MATERIALS, "-o", self.law)

    def __call__(self, *words):
        return subprocess.run([self.program, *map(str, words)], check=True, capture_output=True, text=True).stdout

    def replay(self, speed):
        return json.loads(self("law", self.law, "--pair", "wax:wall", "--radius", RADIUS, "--velocity", speed, "--json"))

    def impact(self, speed, trace):
        return json.loads(self("impact", MATERIALS, "--particle", "pellet", "--velocity", speed, "--no-estimate", "--json", "-o", trace))

    def collision(self):
        """Overlap and force of the law's own collision: loading to its largest overlap, unloading by phi(u)."""
        table = self.folder / "wax.csv"
        self("export", self.law, "-o", table, "--pair", "wax:wall", "--effective-radius", RADIUS, "--speed", SPEED)
        rows = list(csv.DictReader(line for line in table.open() if not line.startswith("#")))
        column = {name: np.array([float(row[name]) for row in rows]) for name in rows[0] if name != "pair"}
        largest = self.replay(SPEED)["delta_max_m"]

        def at(name, overlap):
            return np.interp(np.asarray(overlap) ** 0.25, column["overlap_m"] ** 0.25, column[name])

        loading = np.linspace(0, largest, 400)
        residual, n, share = (float(at(name, largest)) for name in ("residual_overlap_m", "exponent", "foot"))
        u = np.linspace(1, 0, 200)
        phi = share * u**1.5 + (5 - 2 * share - 2 * n) * u**2 + (share + 2 * n - 4) * u**2.5
        return (np.concatenate((loading, residual + u * (largest - residual))),
                np.concatenate((at("force_N", loading), float(at("force_N", largest)) * phi)))

def draw_collision(axis, tool):
    trace = tool.folder / "impact.csv"
    tool.impact(SPEED, trace)
    rows = list(csv.DictReader(line for line in trace.open() if not line.startswith("#")))
    keys = list(rows[0])
    overlap = next(k for k in keys if k.startswith("delta"))
    force = next(k for k in keys if k.startswith("force"))
    points = rows[::max(1, len(rows) // 45)]
    axis.plot(*(1e6 * hertz_collision()[0], hertz_collision()[1]), color=COLOURS["hertz"], label="Hertz")
    x, f = thornton_collision()
    axis.plot(1e6 * x, f, color=COLOURS["thornton"], label="Thornton")
    x, f = tool.collision()
    axis.plot(1e6 * x, f, color=COLOURS["mpm"], label="computed law")
    axis.plot([1e6 * float(r[overlap]) for r in points], [float(r[force]) for r in points], "k.", ms=4, label="computed in full")
    axis.set(xlabel="overlap, micrometres", ylabel="force, N", title=f"one collision at {SPEED:g} m/s", xlim=(0, None), ylim=(0, None))
    axis.legend(fontsize=8)

def draw_restitution(axis, tool):
    speeds = np.geomspace(3e-3, 5, 60)
    axis.axhline(HERTZ_E, color=COLOURS["hertz"], label="Hertz deck: one number")
    axis.plot(speeds, thornton_restitution(speeds), color=COLOURS["thornton"], label="Thornton")
    axis.plot(speeds, [tool.replay(v)["e"] for v in speeds], color=COLOURS["mpm"], label="computed law")
    own = (0.03, 0.1, 0.3, 1, 3)
    axis.plot(own, [tool.impact(v, tool.folder / "x.csv")["e"] for v in own], "ko", ms=4, label="computed in full")
    axis.set(xscale="log", xlabel="approach speed, m/s", ylabel="e", ylim=(0, 1.03), title="restitution")
    axis.legend(fontsize=8, loc="lower left")

def draw_contacts(axis, stats):
    found = json.loads(Path(stats).read_text())["pair"]["contact_map"]
    count = np.array(found["count"], dtype=float)
    image = axis.pcolormesh(found["speed_lower_edge"], found["overlap_lower_edge"], np.ma.masked_equal(count, 0).T, norm=matplotlib.colors.LogNorm(),
                            cmap="viridis", shading="nearest")
    axis.axvline(2 * YIELD_SPEED, color="k", lw=0.8, ls="--")
    axis.text(2.2 * YIELD_SPEED, axis.get_ylim()[0] * 2, "contacts\ndent", fontsize=8)
    axis.set(xscale="log", yscale="log", xlabel="approach speed, m/s", ylabel="largest overlap / R*", title="contacts of a hopper")
    axis.figure.colorbar(image, ax=axis, label="number of contacts")

def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--mpm", default=TOP / "build/release/tools/mpm/mpm")
    parser.add_argument("--stats", help="stats.json of a run with contactMap on, such as tools/demo's")
    parser.add_argument("-o", "--output", default=TOP / "docs/law.png")
    arguments = parser.parse_args()
    figure, axes = plt.subplots(1, 3 if arguments.stats else 2, figsize=(13.5 if arguments.stats else 9, 3.9))
    with tempfile.TemporaryDirectory() as folder:
        tool = Tool(arguments.mpm, folder)
        draw_collision(axes[0], tool)
        draw_restitution(axes[1], tool)
    if arguments.stats:
        draw_contacts(axes[2], arguments.stats)
    for axis in axes[:2]:
        axis.grid(alpha=0.2)
    figure.tight_layout()
    figure.savefig(arguments.output, dpi=95)

if __name__ == "__main__":
    main()
