"""Loop time of LIGGGHTS under each normal model, as a ratio to stock Hertz in the same scene.

    dense   a chute flow (periodic in x and y, rough floor), prepared once with stock Hertz
    types   the same flow with four types of particles: ten pairs, each with a law of its own under mpm, none under mpm_rule
            (the pair rule); mpm_waves: those of unlike types are composed and radiate (three contacts of four);
            mpm_sizes: and each has laws at four ratios of radii; mpm_waves_off, mpm_sizes_off: with `waves off`
    sparse  spheres on their way down, as in an insertion phase: near neighbours, hardly a contact

Every model runs the same steps from the same positions and velocities, several times, interleaved. Prints for each
the median ratio to --base of loop times and of CPU times of the whole process with its spread, pair-force time, also over the contacts (flows under different laws
drift apart), particle-steps per second, and the error of the force that the loop computes. hertz_granulaw is stock Hertz compiled with the plug-in's flags, hertz_loop the same in the
plug-in's loop over pairs. Standard library only.

    ninja benchmark_liggghts          (or: loop.py [--repeats 5] [--steps 1500] [--spheres 3000] [--base hertz])
"""
import argparse
import os
import pathlib
import random
import re
import resource
import statistics
import subprocess
import tempfile

LAUNCHER, HERTZ, LAW_MAKER = (os.environ[k] for k in ("GRANULAW_LAUNCHER", "GRANULAW_HERTZ", "GRANULAW_LAW_MAKER"))
RADIUS, DENSITY, NU, E = 2e-3, 1500.0, 0.3, 9.1e7  # soft, so that the bed packs in seconds; the loop does the same work
GRAVITY, ANGLE, DT = 9.81, (0.3907, 0.9205), 6e-6  # sine and cosine of 23 degrees; 0.15 of the Rayleigh time
WARM_UP = 500  # steps before the clock starts
ONSETS = {"mpm": 6.4e-4, "mpm_soft": 6.4e-6}  # E*/Y = 100; and one tenth of that yield stress


def properties(youngs_modulus, yield_stress, types=1):
    """Properties that any of the models requires; thornton_ning and hooke/hysteresis yield near the others' onset."""
    def each(name, value):
        return f"fix {name} all property/global {name} peratomtype" + types * f" {value}" + "\n"

    def pairs(name, value):
        return f"fix {name} all property/global {name} peratomtypepair {types}" + types * types * f" {value}" + "\n"

    return (each("youngsModulus", youngs_modulus) + each("poissonsRatio", NU) + each("yieldStress", yield_stress) +
            each("coefficientYieldRatio", 0.025) + pairs("surfaceEnergy", 0.0) +
            "fix characteristicVelocity all property/global characteristicVelocity scalar 0.5\n" +
            pairs("coefficientFriction", 0.5) + pairs("coefficientRestitution", 0.5) +
            pairs("coefficientMaxElasticStiffness", 3.0) + pairs("coefficientAdhesionStiffness", 0.0) +
            pairs("coefficientPlasticityDepth", 0.05))


def head(box=None, data=None):
    text = ("units si\nhard_particles yes\natom_style granular\natom_modify map array\nboundary p p f\nnewton off\n"
            "communicate single vel yes\n")
    if data:
        text += f"read_data {data}\n"
    return text + "neighbor 0.0008 bin\nneigh_modify delay 0\n"


def flow(model, words=""):
    return (f"pair_style gran model {model} tangential history {words}\npair_coeff * *\n"
            f"fix w all wall/gran model {model} tangential history primitive type 1 zplane 0.0\n"
            f"fix g all gravity {GRAVITY} vector {ANGLE[0]} 0.0 {-ANGLE[1]}\nfix i all nve/sphere\ntimestep {DT}\n"
            "thermo 1000000\ncompute n all contact/atom\ncompute z all reduce ave c_n\n"
            "thermo_style custom step c_z\n")


def write_data(path, atoms, box, types=1):
    text = f"flow\n\n{len(atoms)} atoms\n{types} atom types\n\n"
    for c, size in zip("xyz", box):
        text += f"0 {size!r} {c}lo {c}hi\n"
    text += "\nAtoms\n\n" + "".join(f"{k + 1} {1 + k % types} {2 * RADIUS!r} {DENSITY} {a[0]} {a[1]} {a[2]}\n"
                                    for k, a in enumerate(atoms))
    text += "\nVelocities\n\n" + "".join(f"{k + 1} {a[3]} {a[4]} {a[5]} {a[6]} {a[7]} {a[8]}\n"
                                         for k, a in enumerate(atoms))
    path.write_text(text)


def run(folder, deck, preload=None):
    path = folder / "in.deck"
    path.write_text(deck)
    environment = dict(os.environ, **({"LD_PRELOAD": preload} if preload else {}))
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    done = subprocess.run([LAUNCHER, "-in", str(path), "-log", "none"], capture_output=True, text=True,
                          errors="replace", cwd=folder, env=environment)
    if done.returncode:
        raise SystemExit(f"loop.py: LIGGGHTS stopped:\n{done.stdout[-1500:]}{done.stderr[-1500:]}")
    return done.stdout, resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def read_dump(path):
    lines = path.read_text().splitlines()
    start = max(k for k, line in enumerate(lines) if line.startswith("ITEM: ATOMS")) + 1
    rows = sorted((line.split() for line in lines[start:]), key=lambda r: int(r[0]))
    return [row[1:] for row in rows]


COLUMNS, ROWS = 15, 10


def box_of(spheres, spacing):
    return (COLUMNS * spacing, ROWS * spacing, 3.0 * spacing * spheres / (COLUMNS * ROWS))


def lattice(spheres, spacing, speed, flow_speed):
    """Rows of data: position, velocity, no rotation."""
    rng = random.Random(3)
    atoms = []
    for k in range(spheres):
        cell = (k % COLUMNS, k // COLUMNS % ROWS, k // (COLUMNS * ROWS))
        x = [(c + 0.5) * spacing + rng.uniform(-0.02, 0.02) * RADIUS for c in cell]
        v = [rng.uniform(-speed, speed) + (flow_speed if axis == 0 else 0.0) for axis in range(3)]
        atoms.append([repr(w) for w in x + v] + ["0", "0", "0"])
    return atoms


def prepare(folder, spheres):
    """dense.data and types.data: a layer that flows slowly, from a jittered lattice; sparse.data."""
    box = box_of(spheres, 2.06 * RADIUS)
    write_data(folder / "start.data", lattice(spheres, 2.06 * RADIUS, 0.3, 0.6), box)
    run(folder, head(data="start.data") + properties(E, 1e30) + flow("hertz") + "run 40000\n"
        "dump d all custom 1 flow.dump id xu yu z vx vy vz omegax omegay omegaz\n"
        'dump_modify d format "%d %.12g %.12g %.12g %.9g %.9g %.9g %.9g %.9g %.9g"\nrun 0\n')
    flowing = read_dump(folder / "flow.dump")
    for row in flowing:
        for axis in (0, 1):
            row[axis] = repr(float(row[axis]) % box[axis])
    write_data(folder / "dense.data", flowing, box)
    write_data(folder / "types.data", flowing, box, types=4)
    # 1.15 diameters apart: all are in each other's lists, and meet now and then
    write_data(folder / "sparse.data", lattice(spheres, 2.3 * RADIUS, 0.5, 0.0), box_of(spheres, 2.3 * RADIUS))


def contacts(text):
    """Mean number of contacts of a sphere in the last line of thermo output."""
    rows = re.findall(r"^\s*\d+ +(\S+) *$", text, re.M)
    return float(rows[-1])


MODELS = {"dense": ("hertz", "hertz_granulaw", "hertz_loop", "mpm", "mpm_soft", "mpm_axis", "thornton", "thornton_soft",
                    "thornton_ning", "hooke_hysteresis"),
          "types": ("hertz", "mpm_rule", "mpm", "mpm_waves", "mpm_waves_off", "mpm_sizes", "mpm_sizes_off", "thornton"),
          "sparse": ("hertz", "mpm", "thornton")}
RADIATING = ("mpm_waves", "mpm_sizes")


def loop(folder, scene, name, steps):
    # yield stress for thornton: onset at the same overlap as the law's, delta_y/R = (1.6 pi Y/(2E*))^2
    e_star = E / (1 - NU * NU)
    yield_stress = {o: 2 * e_star / 3.14159265 / 1.6 * x**0.5 for o, x in ONSETS.items()}
    model, words, preload, y = name.replace("_hysteresis", "/hysteresis"), "", None, yield_stress["mpm"]
    types = 4 if scene == "types" else 1
    if name.startswith("mpm"):
        law = f"law four_{name.removesuffix('_off')}.h5 materials a b c d" if types == 4 else f"law {name}.h5 materials powder"
        law += " waves off" if name.endswith("_off") else ""
        model, words = "mpm", f"{law} beyondRange continue elasticDamping 0.001"
    elif name.startswith("thornton") and name != "thornton_ning":
        model, words, y = "thornton", "elasticDamping 0.001", yield_stress[name.replace("thornton", "mpm")]
    elif name in ("hertz_granulaw", "hertz_loop"):
        preload = HERTZ
    text, cpu = run(folder, head(data=f"{scene}.data") + properties(E, y, types) + flow(model, words) +
               f"run {WARM_UP}\nrun {steps}\n", preload)
    seconds = float(re.findall(r"^Loop time of (\S+)", text, re.M)[-1])
    pair = float(re.findall(r"^Pair  time \(%\) = (\S+)", text, re.M)[-1])
    if name in RADIATING and "taken by waves" not in text:
        raise SystemExit(f"loop.py: no waves under {name}")
    return seconds, pair, contacts(text), cpu


def compare(folder, scene, options, error):
    models = [m for m in MODELS[scene] if not options.models or m in options.models]
    times = {m: [] for m in models}
    for _ in range(options.repeats):
        for m in models:
            times[m].append(loop(folder, scene, m, options.steps))
    print(f"{scene}: {options.spheres} spheres, {options.steps} steps, {options.repeats} interleaved runs; ratios to {options.base}, "
          "round by round: median [lowest, highest]; of the fastest runs")
    base = times[options.base]

    def ratio(of, k):
        ratios = [t[k] / h[k] for t, h in zip(of, base)]
        return f"{statistics.median(ratios):.3f} [{min(ratios):.3f}, {max(ratios):.3f}]"

    for m in models:
        seconds = statistics.median(t[0] for t in times[m])
        pair = statistics.median(t[1] for t in times[m]) / statistics.median(t[1] for t in base)
        # half the coordination number: a contact has two spheres; includes the search among near neighbours
        per_contact = min(t[1] / (0.5 * t[2]) for t in times[m]) / (options.steps * options.spheres) * 1e9
        best = min(t[0] for t in times[m]) / min(t[0] for t in base)  # what a busy machine disturbs least
        print(f"{m:16s} loop ratio {ratio(times[m], 0)}  fastest {best:.3f}  CPU ratio {ratio(times[m], 3)}  "
              f"pair-time ratio {pair:.3f}  {per_contact:.1f} ns a contact  {options.spheres * options.steps / seconds / 1e6:.2f} M particle-steps/s  "
              f"{statistics.median(t[2] for t in times[m]):.2f} contacts a sphere  "
              f"force error {error.get((scene, m.removesuffix('_off')), 'none (closed form)')}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--steps", type=int, default=1500)
    parser.add_argument("--spheres", type=int, default=3000)
    parser.add_argument("--scenes", nargs="+", choices=MODELS, default=list(MODELS))
    parser.add_argument("--models", nargs="+", help="the base and these only")
    parser.add_argument("--base", default="hertz", help="model that the others' times are divided by")
    options = parser.parse_args()
    if options.models:
        options.models.append(options.base)
    with tempfile.TemporaryDirectory(prefix="granulaw-loop-") as name:
        folder = pathlib.Path(name)

        def law(*words):
            return subprocess.run([LAW_MAKER, *map(str, words)], check=True, capture_output=True, text=True).stdout.strip()

        error = {("dense", name): law("one", folder / f"{name}.h5", onset) for name, onset in ONSETS.items()}
        error["sparse", "mpm"] = error["dense", "mpm"]
        error["dense", "mpm_axis"] = law("axis", folder / "mpm_axis.h5")
        error["types", "mpm_rule"] = law("rule", folder / "four_mpm_rule.h5")
        for name, ratios in (("mpm", ()), ("mpm_waves", (1,)), ("mpm_sizes", (0.25, 1, 4, 16))):
            error["types", name] = law("four", folder / f"four_{name}.h5", *ratios)
        prepare(folder, options.spheres)
        for scene in options.scenes:
            compare(folder, scene, options, error)


if __name__ == "__main__":
    main()
