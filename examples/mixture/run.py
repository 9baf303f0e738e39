#!/usr/bin/python3
"""A blend of two materials and two sizes on a vibrating steel floor: under the pair rule, and under composed pair laws.

    run.py [-o out/mixture] [--seeds 12] [--quick]

A seed is a random cloud, the same for both laws. Writes report.md, mixture.csv and mixture.png."""
import argparse
import pathlib
import shutil
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common"))
import one_sentence  # noqa: E402, F401
import h5py  # noqa: E402
import numpy as np  # noqa: E402
import clouds, pictures, readings, sweep  # noqa: E401, E402
from spread import write_tables  # noqa: E402

RADIUS = {"lactose": 1e-3, "mcc": 2e-3}      # m
DENSITY = {"lactose": 1540.0, "mcc": 1460.0}  # kg/m^3, as materials.toml
LAWS = ("rule", "composed")
FULL = {"lactose": 240, "mcc": 60, "half": 0.02, "time": 3.0, "settled": 0.6}   # m, half the box; s, of the run and before the means
QUICK = {"lactose": 40, "mcc": 10, "half": 0.01, "time": 0.4, "settled": 0.2}
AMPLITUDE, PERIOD = 0.004, 0.04  # m, s, of the floor: up to 0.63 m/s
STRETCH = 8  # contacts last this much longer, at the same e
STEP = 2.5e-7  # s, without stretch
pictures.COLOURS.update(rule="tab:orange", composed="tab:blue")

def options(argv):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("-o", "--out", default="out/mixture", metavar="DIR", help="default: out/mixture")
    parser.add_argument("--seeds", type=int, default=12, help="runs of each law, default 12")
    parser.add_argument("--ranks", type=int, default=1, help="MPI ranks")
    parser.add_argument("--stretch", type=float, default=STRETCH, help=f"contacts this much longer, default {STRETCH}")
    parser.add_argument("--quick", action="store_true", help="the small version that the tests run")
    parser.add_argument("--laws", nargs="+", choices=LAWS, default=list(LAWS))
    sweep.tangential_options(parser)
    parser.set_defaults(law=None, models=["mpm"])
    return parser.parse_args(argv)

def law_files(args):
    """{"composed": path, "rule": path}: the second lacks the pairs' own laws, so that every pair follows the pair rule."""
    composed = pathlib.Path(sweep.make_law(args, HERE / "materials.toml", ("--radius-ratio", "2", "--thick-walls"), "composed.h5"))
    rule = composed.with_name("rule.h5")
    shutil.copyfile(composed, rule)
    with h5py.File(rule, "r+") as file:
        del file.attrs["checksum"]  # of the whole file; one of minor version 0 has none
        file.attrs.modify("version_minor", np.int32(0))
        del file["pair_laws"]
    return {"rule": rule, "composed": composed}

def write_floor(path, half):
    """A square of twice the box's width at z = 0."""
    a = 2 * half
    corners = ((-a, -a, 0), (a, -a, 0), (a, a, 0), (-a, a, 0))
    text = "solid floor\n"
    for face in ((0, 1, 2), (0, 2, 3)):
        text += "facet normal 0 0 1\nouter loop\n" + "".join("vertex {} {} {}\n".format(*corners[k]) for k in face) + "endloop\nendfacet\n"
    path.write_text(text + "endsolid floor\n")

def write_scene(folder, scene, seed):
    """A cloud of both kinds, mixed at random, over the floor."""
    folder.mkdir(parents=True, exist_ok=True)
    half, largest = scene["half"], max(RADIUS.values())
    kinds = np.array(["lactose"] * scene["lactose"] + ["mcc"] * scene["mcc"])
    rng = np.random.default_rng(seed)
    rng.shuffle(kinds)
    inside, low = half - 1.1 * largest, AMPLITUDE + 1.1 * largest
    high = low + kinds.size * 4 / 3 * np.pi * (1.02 * largest)**3 / (0.2 * (2 * inside)**2)
    centres = clouds.random_cloud(kinds.size, largest, (-inside, -inside, low), (inside, inside, high), rng)
    clouds.write_data(folder / "cloud.data", centres, [RADIUS[k] for k in kinds], [DENSITY[k] for k in kinds],
                      (-half - largest, -half - largest, -2 * AMPLITUDE), (half + largest, half + largest, 0.5),
                      types=[1 + list(RADIUS).index(k) for k in kinds])
    write_floor(folder / "floor.stl", half)

def temperature(s, kind, count):
    """J, 2/3 of the kinetic energy of a sphere less that of the kind's common rise and fall; over time."""
    mass = DENSITY[kind] * 4 / 3 * np.pi * RADIUS[kind]**3
    return 2 / 3 * (s[f"ke_{kind}"] / count - 0.5 * mass * s[f"vz_{kind}"]**2)

def measure(folder, scene):
    s = readings.series(folder)
    if readings.lost(folder):
        raise SystemExit(f"{folder}: particles were lost")
    later = s["time"] > scene["settled"]
    found = {}
    for kind in RADIUS:
        found[f"granular temperature of {kind}, nJ"] = 1e9 * np.mean(temperature(s, kind, scene[kind])[later])
        found[f"mean height of {kind}, mm"] = 1e3 * np.mean(s[f"z_{kind}"][later])
    found["height of mcc over that of lactose"] = found["mean height of mcc, mm"] / found["mean height of lactose, mm"]
    seconds = np.ptp(s["time"][later])
    found["dissipated in normal contacts, mW"] = 1e3 * np.ptp(s["plastic"][later]) / seconds
    found["taken by waves, mW"] = 1e3 * np.ptp(s["waves"][later]) / seconds
    return {**found, **dissipation_by_pair(folder, s["time"][-1])}

def dissipation_by_pair(folder, seconds):
    """{"dissipated between a and b, mW": mean over the whole run}, waves left out."""
    return {"dissipated between {} and {}, mW".format(*pair["materials"]): 1e3 * pair["normal_dissipation_J"] / seconds
            for pair in readings.stats(folder)["pairs"]}

def main(argv=None):
    args = options(argv)
    scene = QUICK if args.quick else FULL
    dt = STEP * args.stretch
    out, laws, tables = pathlib.Path(args.out), law_files(args), {}
    for seed in range(1, args.seeds + 1):
        place = out / f"scene-{seed}"
        write_scene(place, scene, seed)
        for name in args.laws:
            folder = sweep.run(args, HERE / "in.mixture", "mpm", out / f"{name}-{seed}", [place / "cloud.data"], laws[name],
                               {"scene": place, "dt": dt, "steps": round(scene["time"] / dt), "every": round(1e-3 / dt), "half": scene["half"],
                                "amplitude": AMPLITUDE, "period": PERIOD})
            tables.setdefault(name, []).append(measure(folder, scene))
    samples = write_tables(out, "Mixture", f"{scene['lactose']} spheres of lactose and {scene['mcc']} of mcc, {args.seeds} seeds.", tables, "rule")
    if len(samples) == len(LAWS):
        draw(out / "mixture.png", samples)
    return samples

def changes(samples):
    """{quantity: (per cent, two standard errors)} from the rule to the composed laws, where the rule's value is not 0."""
    found = {}
    for quantity, rule in samples["rule"].items():
        composed = samples["composed"][quantity]
        if rule.mean:
            errors = [(sample.error or 0) / sample.mean for sample in (rule, composed)]
            found[quantity.split(",")[0]] = 100 * (composed.mean / rule.mean - 1), 200 * composed.mean / rule.mean * float(np.hypot(*errors))
    return found

def draw(path, samples):
    """Quantities that change with the law."""
    figure, (axis,) = pictures.panels(1, width=6.4, height=3.6)
    found = changes(samples)
    place = -np.arange(len(found))
    axis.errorbar([change for change, _ in found.values()], place, xerr=[error for _, error in found.values()], fmt="o", ms=4, capsize=2)
    axis.axvline(0, color="0.6", lw=0.8)
    axis.set_yticks(place, list(found), fontsize=8)
    axis.set(xlabel="composed laws over pair rule, % (two standard errors)")
    pictures.save(figure, path)

if __name__ == "__main__":
    main()
