#!/usr/bin/python3
"""Beds of a sticky powder, pressed and relieved: their tensile strength against the pressing pressure, and the slope at which they flow.

    run.py [-o out/sticking] [--seeds 3] [--quick] [--tests pull tilt]

Each under a law that yields and an elastic one of the same modulus. A seed is a random cloud, the same for both laws.
Writes report.md, sticking.csv and sticking.png."""
import argparse
import json
import math
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common"))
import one_sentence  # noqa: E402, F401
import numpy as np  # noqa: E402
import clouds, pictures, readings, sweep  # noqa: E401, E402
from spread import write_tables  # noqa: E402

RADIUS, DENSITY, E_STAR = 50e-6, 920.0, 91e6 / (1 - 0.3**2)  # m, kg/m3, Pa: the wax of ../hopper/materials.toml
WEIGHT = DENSITY * 4 / 3 * math.pi * RADIUS**3 * 9.81
GRID = 2.04 * RADIUS  # m, between glued spheres
LAWS = ("elastic", "yielding")
PRESSURES = (1e3, 3e3, 1e4, 3e4)  # Pa, before a pull
BONDS = (0, 1, 10, 25, 50)            # pull-off force of two undented spheres over their weight
STICKIEST, TILTED = 50, 1e4       # Bond number of pulls; Pa, before a tilt
FILL, STEP = 0.2, 1.5e-7          # m/s, of the plate on its way; s
FULL = {"across": 5, "spheres": 200, "steps": {"pull": 50000, "tilt": 300000}, "pressures": PRESSURES, "bonds": BONDS}
QUICK = {"across": 3, "spheres": 60, "steps": {"pull": 20000, "tilt": 40000}, "pressures": (TILTED,), "bonds": (25,)}
LIFT = {"pull": 0.005, "tilt": 0.02}
pictures.COLOURS.update(elastic="0.35", yielding="tab:blue")


def options(argv):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("-o", "--out", default="out/sticking", metavar="DIR", help="default: out/sticking")
    parser.add_argument("--seeds", type=int, default=3, help="runs of each law, default 3")
    parser.add_argument("--tests", nargs="+", choices=("pull", "tilt"), default=("pull", "tilt"))
    parser.add_argument("--quick", action="store_true", help="the small version that the tests run")
    parser.set_defaults(law=None, models=["mpm"], ranks=1, stretch=1, energy=False, tangential="history")
    return parser.parse_args(argv)


def law_files(args):
    """{law: path}: wax, and wax without its yield stress."""
    elastic = pathlib.Path(args.out) / "elastic.toml"
    elastic.parent.mkdir(parents=True, exist_ok=True)
    elastic.write_text("".join(line for line in sweep.WAX.read_text().splitlines(True) if not line.startswith("yield_stress")))
    return {law: sweep.make_law(args, file, ("--pair", "wax:wax"), f"{law}.h5") for law, file in (("elastic", elastic), ("yielding", sweep.WAX))}


def work_of(bond):
    """J/m2, at this Bond number: 1.5 pi w R* over the weight."""
    return bond * WEIGHT / (1.5 * math.pi * RADIUS / 2)


def range_of(work):
    """m: the longest with a Tabor number of 1, less 2 %. No force depends on it."""
    return 0.98 * (work**2 * RADIUS / 2 / (E_STAR / 2)**2)**(1 / 3) if work else 1e-9


def write_bed(folder, across, spheres, seed):
    """A cloud between two glued layers. Side and upper end of the cloud, m."""
    folder.mkdir(parents=True, exist_ok=True)
    side, low = across * GRID, 2.1 * RADIUS
    top = low + 1.02**3 * spheres * 4 / 3 * math.pi * RADIUS**3 / (0.29 * side**2)
    layer = lambda z: np.array([((i + 0.5) * GRID, (j + 0.5) * GRID, z) for i in range(across) for j in range(across)])
    cloud = clouds.random_cloud(spheres, RADIUS, (0, 0, low), (side, side, top), np.random.default_rng(seed), (True, True, False))
    clouds.write_data(folder / "bed.data", np.vstack([layer(0.0), cloud, layer(top + 2.1 * RADIUS)]), RADIUS, DENSITY, (0, 0, -4 * RADIUS),
                      (side, side, top + 40 * RADIUS), types=[1] * (across**2 + spheres) + [2] * across**2)
    return side, top


def run(args, size, test, law, file, seed, bond, pressure):
    place, work = pathlib.Path(args.out) / f"{test}-bed-{seed}", work_of(bond)
    side, top = write_bed(place, size["across"], size["spheres"], seed)
    loose = size["spheres"] * 4 / 3 * math.pi * RADIUS**3 / side**2 / 0.5  # m, height at which it begins to press
    return sweep.run(args, HERE / "in.bed", "mpm", pathlib.Path(args.out) / f"{test}-{law}-{bond}-{pressure:g}-{seed}", [place / "bed.data"], file,
                     {"scene": place, "test": test, "glued": size["across"]**2, "w": work, "wplate": work if test == "pull" else 0.0,
                      "range": range_of(work), "pressure": pressure, "area": side**2, "weight": WEIGHT, "fill": FILL, "dt": STEP,
                      "lift": LIFT[test], "fall": round((top - loose) / FILL / STEP), "steps": size["steps"][test]})


def pull_offs(file, work):
    """Overlaps (m) and pull-off forces (N) of dents, by `mpm law` at some speeds."""
    found = [json.loads(subprocess.run([sweep.program("mpm"), "law", file, "--pair", "wax:wax", "--radius", str(RADIUS), "--velocity", str(v),
                                        "--work-of-adhesion", str(work), "--adhesion-range", str(range_of(work)), "--json"],
                                       check=True, capture_output=True, text=True).stdout) for v in (0.2, 0.5, 1, 2, 4)]
    return [0.0, *(one["delta_max_m"] for one in found)], [1.5 * math.pi * work * RADIUS / 2, *(one["pull_off_N"] for one in found)]


def contacts(folder):
    """Overlap and largest overlap, m, of the contacts of the pressed bed."""
    lines = (folder / "contacts.txt").read_text().splitlines()
    rows = np.array([line.split() for line in lines[lines.index(next(x for x in lines if x.startswith("ITEM: ENTRIES"))) + 1:]], float)
    return rows[rows[:, 2] > 0, 2:].T


def measure_pull(folder, side, spheres, dents):
    """The largest pull on the plate, and Rumpf's estimate (1970): density x coordination x mean pull-off force/(4 pi R^2)."""
    s, largest = readings.series(folder), contacts(folder)[1]
    pressed = int(np.argmax(s["stress"]))
    density = spheres * 4 / 3 * math.pi * RADIUS**3 / (side**2 * (s["plate"][pressed] - 2 * RADIUS))
    force = np.mean(np.interp(largest, *dents)) if dents else 1.5 * math.pi * work_of(STICKIEST) * RADIUS / 2
    return {"pressure, Pa": s["stress"][pressed], "strength, Pa": -np.min(s["stress"][pressed:]), "solid volume": density,
            "coordination number": s["coordination"][pressed],
            "largest overlap/R": np.max(largest) / RADIUS,
            "Rumpf's estimate, Pa": density * s["coordination"][pressed] * force / (4 * math.pi * RADIUS**2)}


def measure_tilt(folder):
    """Slope, degrees, at which the centre of mass has moved by R; 180 where it stays."""
    s = readings.series(folder)
    start = np.flatnonzero(s["slope"] > 0)[0]
    moved = np.hypot(s["x"] - s["x"][start], s["z"] - s["z"][start])[start:] > RADIUS
    return float(s["slope"][start:][np.argmax(moved)]) if moved.any() else 180.0


def main(argv=None):
    args = options(argv)
    size, out, tables = QUICK if args.quick else FULL, pathlib.Path(args.out), {law: [{} for _ in range(args.seeds)] for law in LAWS}
    for law, file in law_files(args).items():
        dents = pull_offs(file, work_of(STICKIEST)) if law == "yielding" else None
        for seed in range(1, args.seeds + 1):
            found = tables[law][seed - 1]
            for pressure in size["pressures"] if "pull" in args.tests else ():
                folder = run(args, size, "pull", law, file, seed, STICKIEST, pressure)
                measured = measure_pull(folder, size["across"] * GRID, size["spheres"], dents)
                found.update({f"pressed by {pressure:g} Pa: {name}": float(value) for name, value in measured.items()})
            for bond in size["bonds"] if "tilt" in args.tests else ():
                folder = run(args, size, "tilt", law, file, seed, bond, TILTED)
                found[f"Bond number {bond}: slope at which it flows, degrees"] = measure_tilt(folder)
    samples = write_tables(out, "Sticking", f"Wax, R = {1e6 * RADIUS:g} um, {args.seeds} seeds.", tables, "elastic")
    draw(out / "sticking.png", samples, size, args.tests)
    return samples


def draw(path, samples, size, tests):
    figure, axes = pictures.panels(len(tests))
    for axis, test in zip(axes, tests):
        keys, name, values = {"pull": ("pressed by {:g} Pa: strength, Pa", "pressing pressure, Pa", size["pressures"]),
                              "tilt": ("Bond number {}: slope at which it flows, degrees", "Bond number of undented spheres", size["bonds"])}[test]
        for law in LAWS:
            pictures.band(axis, values, np.array([samples[law][keys.format(v)].values for v in values]).T, law)
        axis.set(xlabel=name, ylabel=keys.split(": ")[1])
        axis.set_xscale("log" if test == "pull" else "symlog")
        axis.legend(fontsize=8)
    axes[0].set_yscale("log" if tests[0] == "pull" else "linear")
    pictures.save(figure, path)


if __name__ == "__main__":
    main()
