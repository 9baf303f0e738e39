"""The hopper of clumps/in.clumps: its scene, its law, one run, and what is measured of it."""
import csv
import math
import os
import pathlib
import re
import subprocess
import sys

EXAMPLES = pathlib.Path(__file__).resolve().parent.parent
ROOT = EXAMPLES.parent
DENSITY = 920.0  # kg/m^3, as in hopper/materials.toml
MODELS = ("hertz", "thornton", "mpm")


def program(name):
    built = ROOT / "build/release" / {"mpm": "tools/mpm/mpm", "liggghts-mpm": "liggghts_plugin/liggghts-mpm"}[name]
    return str(built) if built.exists() else name


def inertia_words(tensor):
    """Elements of a 3 x 3 matrix, in the order of fix particletemplate/multisphere."""
    return " ".join(f"{tensor[a][b]:.9g}" for a, b in ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)))


def clump_template(count, spheres, mass, tensor):
    """A clump's template with its mass (kg) and inertia tensor (kg m^2): LIGGGHTS's Monte Carlo is some per cent off."""
    return (f"fix shape all particletemplate/multisphere 15485863 atom_type 1 density constant {DENSITY} nspheres {count} ntry 100000 "
            f"spheres {spheres} type 1 mass {mass:.9g} inertia_tensor {inertia_words(tensor)} use_density\nfix move all multisphere\n")


def sphere_template(radius):
    return (f"fix shape all particletemplate/sphere 15485863 atom_type 1 density constant {DENSITY} radius constant "
            f"{radius:.9g}\nfix move all nve/sphere\n")


def make_scene(out):
    """The hopper's mesh, and the law where it is not there yet."""
    subprocess.run([sys.executable, str(EXAMPLES / "hopper/make_scene.py"), "-o", str(out), "--particles", "200", "--radius", "3e-3",
                    "--orifice", "0.017", "--cylinder", "0.034", "--drop", "0.05"], check=True)
    if not (out / "wax.h5").exists():
        subprocess.run([program("mpm"), "table", str(EXAMPLES / "hopper/materials.toml"), "-o", str(out / "wax.h5")], check=True)


def run(args, model, shape):
    """The folder of a run of this model; the run is made where its log is not complete."""
    out = args.out / f"{model}-{shape}"
    log = out / "log.liggghts"
    if log.exists() and log.read_text().count("Loop time") == 2:
        return out
    out.mkdir(parents=True, exist_ok=True)
    words = ["-in", str(EXAMPLES / "clumps/in.clumps"), "-log", str(log)]
    for name, value in (("model", model), ("shape", shape), ("scene", args.out), ("out", out), ("law", args.out / "wax.h5"),
                        ("count", args.count), ("fill", args.fill), ("flow", args.flow)):
        words += ["-var", name, str(value)]
    print(f"{model}, {shape}", flush=True)
    mpi = ["mpirun", "--oversubscribe", "-np", str(args.ranks)] if args.ranks > 1 else []
    subprocess.run(mpi + ["liggghts" if model == "hertz" else program("liggghts-mpm"), *words], check=True, stdin=subprocess.DEVNULL,
                   stdout=subprocess.DEVNULL, env={**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
                                                   "OMP_NUM_THREADS": "1"})
    return out


def measured(out, each):
    """Spheres at the end, of them passed, discharge of particles of `each` spheres a second between 10 and 70 % passed, loop time."""
    rows = [[float(x) for x in row] for row in list(csv.reader((out / "series.csv").open()))[1:]]
    total = rows[-1][1]
    def when(share):
        return next((t for t, _, passed in rows if passed >= share * total), math.nan)
    rate = 0.6 * total / each / (when(0.7) - when(0.1))
    loop = sum(float(t) for t in re.findall(r"Loop time of (\S+)", (out / "log.liggghts").read_text()))
    return total, rows[-1][2], rate, loop


def report(args, spheres_of):
    """Runs every model with every shape, whose number of spheres `spheres_of` says; writes report.md, and returns what it measured. No
    sphere may be lost."""
    rows = {(model, shape): measured(run(args, model, shape), each) for shape, each in spheres_of.items() for model in MODELS}
    text = ["| model | shape | spheres at the end | of them passed | particles a second | loop time over hertz's |", "|---|---|---|---|---|---|"]
    for (model, shape), (total, passed, rate, loop) in rows.items():
        if total != args.count * spheres_of[shape]:
            sys.exit(f"{model}, {shape}: {total:.0f} spheres at the end")
        text.append(f"| {model} | {shape} | {total:.0f} | {passed:.0f} | {rate:.0f} | {loop / rows['hertz', shape][3]:.2f} |")
    (args.out / "report.md").write_text("\n".join(text) + "\n")
    print("\n".join(text))
    return rows


def add_options(parser, out, count, fill, flow):
    parser.add_argument("-o", "--out", type=pathlib.Path, default=pathlib.Path(out))
    for name, value in (("ranks", 2), ("count", count), ("fill", fill), ("flow", flow)):
        parser.add_argument(f"--{name}", type=int, default=value)


def prepared(args):
    """The arguments with their folder made and its path absolute, the scene in it."""
    args.out = args.out.resolve()
    args.out.mkdir(parents=True, exist_ok=True)
    make_scene(args.out)
    return args
