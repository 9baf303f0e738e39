#!/usr/bin/python3
"""A hopper of clumps of three spheres under stock Hertz, Thornton and the computed law, beside spheres of the same volume.

    run.py [-o out/clumps] [--ranks 2] [--count 160] [--fill 80000] [--flow 200000]

Writes report.md: spheres at the end (none may be lost), discharge rate, loop time over stock Hertz's. A run that is done is not made again."""
import argparse
import csv
import math
import os
import pathlib
import re
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
RADIUS, DENSITY = 2.2e-3, 920.0  # of the spheres of a clump; kg/m^3 as in ../hopper/materials.toml
MODELS, SHAPES = ("hertz", "thornton", "mpm"), ("clumps", "spheres")


def clump_template():
    """Three spheres that touch, with the mass and inertia of solid spheres: LIGGGHTS's Monte Carlo is some per cent off."""
    side = 2.0002 * RADIUS
    centres = [(side / math.sqrt(3) * math.cos(a), side / math.sqrt(3) * math.sin(a), 0.0) for a in (0, 2 * math.pi / 3, 4 * math.pi / 3)]
    mass = 4 / 3 * math.pi * RADIUS**3 * DENSITY
    def moment(a, b):
        return sum(mass * ((0.4 * RADIUS**2 + sum(x * x for x in c)) * (a == b) - c[a] * c[b]) for c in centres)
    tensor = " ".join(f"{moment(a, b):.9g}" for a, b in ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)))
    spheres = "  ".join(" ".join(f"{x:.9g}" for x in c) + f" {RADIUS}" for c in centres)
    return (f"fix shape all particletemplate/multisphere 15485863 atom_type 1 density constant {DENSITY} nspheres 3 ntry 100000 "
            f"spheres {spheres} type 1 mass {3 * mass:.9g} inertia_tensor {tensor} use_density\nfix move all multisphere\n")


def sphere_template():
    return (f"fix shape all particletemplate/sphere 15485863 atom_type 1 density constant {DENSITY} radius constant "
            f"{RADIUS * 3 ** (1 / 3):.9g}\nfix move all nve/sphere\n")


def program(name):
    built = ROOT / "build/release" / {"mpm": "tools/mpm/mpm", "liggghts-mpm": "liggghts_plugin/liggghts-mpm"}[name]
    return str(built) if built.exists() else name


def run(args, model, shape):
    """The log of a run of this model; made where it is not there yet."""
    out = args.out / f"{model}-{shape}"
    log = out / "log.liggghts"
    if log.exists() and log.read_text().count("Loop time") == 2:
        return out
    out.mkdir(parents=True, exist_ok=True)
    words = ["-in", str(HERE / "in.clumps"), "-log", str(log)]
    for name, value in (("model", model), ("shape", shape), ("scene", args.out), ("out", out), ("law", args.out / "wax.h5"),
                        ("count", args.count), ("fill", args.fill), ("flow", args.flow)):
        words += ["-var", name, str(value)]
    print(f"{model}, {shape}", flush=True)
    mpi = ["mpirun", "--oversubscribe", "-np", str(args.ranks)] if args.ranks > 1 else []
    subprocess.run(mpi + ["liggghts" if model == "hertz" else program("liggghts-mpm"), *words], check=True, stdin=subprocess.DEVNULL,
                   stdout=subprocess.DEVNULL, env={**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
                                                   "OMP_NUM_THREADS": "1"})
    return out


def measured(out, shape):
    """Spheres at the end, of them passed, discharge of particles a second between 10 and 70 % passed, loop time."""
    rows = [[float(x) for x in row] for row in list(csv.reader((out / "series.csv").open()))[1:]]
    total = rows[-1][1]
    def when(share):
        return next((t for t, _, passed in rows if passed >= share * total), math.nan)
    each = 3 if shape == "clumps" else 1
    rate = 0.6 * total / each / (when(0.7) - when(0.1))
    loop = sum(float(t) for t in re.findall(r"Loop time of (\S+)", (out / "log.liggghts").read_text()))
    return total, rows[-1][2], rate, loop


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("-o", "--out", type=pathlib.Path, default=pathlib.Path("out/clumps"))
    for name, value in (("ranks", 2), ("count", 160), ("fill", 80000), ("flow", 200000)):
        parser.add_argument(f"--{name}", type=int, default=value)
    args = parser.parse_args()
    args.out = args.out.resolve()
    args.out.mkdir(parents=True, exist_ok=True)
    subprocess.run([sys.executable, str(HERE.parent / "hopper/make_scene.py"), "-o", str(args.out), "--particles", "200", "--radius", "3e-3",
                    "--orifice", "0.017", "--cylinder", "0.034", "--drop", "0.05"], check=True)
    (args.out / "clumps.template").write_text(clump_template())
    (args.out / "spheres.template").write_text(sphere_template())
    if not (args.out / "wax.h5").exists():
        subprocess.run([program("mpm"), "table", str(HERE.parent / "hopper/materials.toml"), "-o", str(args.out / "wax.h5")], check=True)
    rows = {(model, shape): measured(run(args, model, shape), shape) for shape in SHAPES for model in MODELS}
    text = ["| model | shape | spheres at the end | of them passed | particles a second | loop time over hertz's |", "|---|---|---|---|---|---|"]
    for (model, shape), (total, passed, rate, loop) in rows.items():
        if total != args.count * (3 if shape == "clumps" else 1):
            sys.exit(f"{model}, {shape}: {total:.0f} spheres at the end")
        text.append(f"| {model} | {shape} | {total:.0f} | {passed:.0f} | {rate:.0f} | {loop / rows['hertz', shape][3]:.2f} |")
    (args.out / "report.md").write_text("\n".join(text) + "\n")
    print("\n".join(text))


if __name__ == "__main__":
    main()
