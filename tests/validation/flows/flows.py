#!/usr/bin/python3
"""Flows of model mpm under `tangential history` and `tangential plastic`: the table of docs/evidence/flows.md.

    flows.py OUT [--decks heap hopper drum mixture chute] [--seeds 10] [--table]     # --table: of what is finished, no runs

Heap, hopper and mixture are those of examples/, drum and chute lie beside this file. A seed is another cloud, the same for both laws. Seeds
are in turn over the decks; finished runs are kept. The observables were written down before the runs."""
import argparse
import importlib.util
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
EXAMPLES = HERE.parents[2] / "examples"
sys.path.insert(0, str(EXAMPLES / "common"))
import one_sentence  # noqa: E402, F401
import numpy as np  # noqa: E402
import clouds, readings, spread, sweep  # noqa: E401, E402

LAWS = ("history", "plastic")
RADIUS, DENSITY, DT = 3e-3, 920.0, 6e-6  # wax, as hopper/materials.toml
# (observable, factor to its unit here); energies of all contacts, over the whole run, are in every deck
OBSERVED = {
    "heap": (("angle, degrees", 1), ("height, m", 1e3, "height, mm"), ("radius that holds 90 %, m", 1e3, "radius that holds 90 %, mm")),
    "hopper": (("discharge rate, kg/s", 1e3, "discharge rate, g/s"), ("bulk density, kg/m3", 1)),
    "mixture": (("height of mcc over that of lactose", 1), ("granular temperature of lactose, nJ", 1)),
    "drum": (("angle of the bed, degrees", 1), ("rotational over kinetic energy", 1)),
    "chute": (("velocity, m/s", 1e3, "velocity, mm/s"), ("rotational over kinetic energy", 1)),
}
ENERGIES = {"normal contacts": "normal_dissipation_J", "shear and turning": "shear_dissipation_J", "friction, rolling, damping": "other_work_J"}
LATER = 0.5  # the means of drum and chute are over the last half of the run


def example(name):
    spec = importlib.util.spec_from_file_location(f"{name}_run", EXAMPLES / name / "run.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def energies(folder):
    """{"dissipated in ..., mJ"}, from the statistics of pairs and walls."""
    counts = readings.stats(folder)
    return {f"{name}, mJ": 1e3 * sum(counts[side].get(key) or 0.0 for side in ("pair", "wall")) for name, key in ENERGIES.items()}


class Example:
    """A deck of examples/."""

    def __init__(self, name, prefix="mpm", words=("--models", "mpm")):
        self.name, self.prefix, self.words = name, prefix, words

    def run(self, out, law, seeds):
        words = ["-o", str(out / law / self.name), "--tangential", law, "--energy", "--seeds", str(seeds), *self.words]
        return example(self.name).main(words)

    def measured(self, out, law):
        """One dict a finished seed."""
        place = out / law / self.name
        path = place / f"{self.name}.csv"
        if not path.exists():
            return []
        samples = spread.read(path)[self.prefix]
        count = max(s.values.size for s in samples.values())
        return [{**{q: s.values[k] for q, s in samples.items() if s.values.size == count}, **energies(place / f"{self.prefix}-{k + 1}")}
                for k in range(count)]


class Own:
    """A deck beside this file; `series` is its time series."""

    def __init__(self, name, seconds, scene, observe):
        self.name, self.seconds, self.scene, self.observe = name, seconds, scene, observe

    def run(self, out, law, seeds):
        args = argparse.Namespace(out=out, law=None, models=["mpm"], ranks=1, stretch=1.0, tangential=law, energy=True)
        file = sweep.make_law(args)
        for seed in range(1, seeds + 1):
            variables = {"steps": round(self.seconds / DT), **self.scene(out / f"{self.name}-scene-{seed}", seed)}
            sweep.run(args, HERE / f"in.{self.name}", "mpm", out / law / self.name / f"{seed}", list(out.glob(f"{self.name}-scene-{seed}/*")), file, variables)

    def measured(self, out, law):
        folders = sorted(f.parent for f in (out / law / self.name).glob("*/done"))
        return [{**self.observe(readings.series(f)), **energies(f)} for f in folders]


def late(values):
    return values[int(LATER * len(values)):]


def drum_scene(folder, seed):
    return {"seed": example("heap").prime_after(100003 * seed)}


def drum(s):
    """The direction from the axis to the bed's centre of mass, from the vertical."""
    return {"angle of the bed, degrees": float(np.mean(np.degrees(np.arctan2(np.abs(late(s["x"])), -late(s["y"]))))),
            "rotational over kinetic energy": float(np.mean(late(s["rotational"])) / np.mean(late(s["kinetic"])))}


def chute_scene(folder, seed, along=8, across=5, count=200):
    """Spheres over a square lattice of glued ones, with heights at random by a fifth of a radius."""
    pitch, rng = 2.1 * RADIUS, np.random.default_rng(seed)
    size = np.array([along * pitch, across * pitch])
    floor = [((i + 0.5) * pitch, (j + 0.5) * pitch, -0.2 * RADIUS * rng.random()) for i in range(along) for j in range(across)]
    top = 3 * RADIUS + count * 4 / 3 * np.pi * RADIUS**3 / (0.22 * np.prod(size))
    cloud = clouds.random_cloud(count, RADIUS, (0, 0, 2.2 * RADIUS), (*size, top), rng, (True, True, False))
    folder.mkdir(parents=True, exist_ok=True)
    clouds.write_data(folder / "chute.data", [*floor, *cloud], RADIUS, DENSITY, (0, 0, -2 * RADIUS), (*size, 2 * top))
    return {"scene": folder}


def chute(s):
    return {"velocity, m/s": float(np.mean(late(s["velocity"]))),
            "rotational over kinetic energy": float(np.mean(late(s["rotational"])) / np.mean(late(s["kinetic"])))}


DECKS = {d.name: d for d in (Example("heap"), Example("hopper"), Own("drum", 0.9, drum_scene, drum),
                             Example("mixture", "composed", ("--laws", "composed")), Own("chute", 1.2, chute_scene, chute))}


def cell(history, plastic):
    """Change and t, or the margin below which it is not resolved (two one-sided tests, each at 5 %)."""
    error = np.hypot(history.error or 0, plastic.error or 0)
    if not error:
        return ""
    t = abs(plastic.mean - history.mean) / error
    if not history.mean:
        return f"(t = {t:.0f})"
    if spread.welch(plastic, history) < 0.05:
        return f"{100 * (plastic.mean / history.mean - 1):+.1f} % (t = {t:.1f})"
    return f"not resolved: below {100 * spread.resolved(plastic, history):.1f} %"


def table(out, decks):
    lines = ["| deck (seeds) | observable | `history` | `plastic` | change |", "|---|---|---|---|---|"]
    for name in decks:
        found = [DECKS[name].measured(out, law) for law in LAWS]
        count = min(map(len, found))
        if count < 2:
            continue
        observed = [*OBSERVED[name], *((f"{e}, mJ", 1, f"dissipated: {e}, mJ") for e in ENERGIES)]
        for key, factor, *title in observed:
            a, b = (spread.Sample(factor * row[key] for row in rows[:count]) for rows in found)
            lines.append(f"| {name} ({count}) | {title[0] if title else key} | {a if a.mean else 0} | {b} | {cell(a, b)} |")
    return "\n".join(lines)


def main(argv=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--decks", nargs="+", choices=list(DECKS), default=list(DECKS))
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--table", action="store_true", help="only print the table of what is finished")
    args = parser.parse_args(argv)
    args.out.mkdir(parents=True, exist_ok=True)
    for seeds in range(1, 1 + args.seeds * (not args.table)):
        for name in args.decks:
            for law in LAWS:
                DECKS[name].run(args.out, law, seeds)
    print(table(args.out, args.decks))


if __name__ == "__main__":
    main()
