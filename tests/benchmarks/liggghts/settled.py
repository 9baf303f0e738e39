"""User CPU and loop time of LIGGGHTS under each normal model where everything touches, as a ratio to stock Hertz.

    rest        1728 spheres on a floor, periodic in x and y, 60,000 steps after they were let fall; each model from its own restart file
    frozen      their positions under Hertz read anew, with a time step of 2e-9 s: every contact is new, half of them grow at every step
    frozen_off  the same with `tangential off`
    frozen_all  the same with `tangential history cohesion sjkr rolling_friction epsd2`
    hopper      the hopper of tools/demo with 1500 spheres and mesh walls, filled under each model, then open
    chute       loop.py's dense flow, 3000 spheres
    two         2016 spheres of two materials (E*/Y = 100 and 1000) and two sizes (radii 1.5 : 1) at rest; laws of `mpm table --radius-ratio 1.5`
    two_flow    the same on an incline of 23 degrees; Hertz has e = 0.1. Model mpm_nowaves: mpm with `waves off`
    pressed     810 spheres in a periodic box, pressed from all sides to a density of 0.94 at 0.001 c*/R; a law of `mpm table` at E*/Y = 100

`--models plastic` is model mpm with `tangential plastic`.

The law yields early (E*/Y = 1000), so that every contact has a dent: the worst case for both models; `--stiffness 100` takes the law of
`mpm table` at that E*/Y. Every model and plug-in runs the same
deck in turn, --rounds times; each round's numbers are divided by those of stock Hertz in the same round. User CPU is that of all processes
without what `run 0` takes. On one line with them stand the error of the force that the loop computes (against the functions the law was
sampled from) and, with --before FOLDER, the largest relative difference that kinetic and rotational energy have at the end from those of
the plug-in in FOLDER, which runs in turn with this one. Standard library only, but for the hopper, whose scene needs numpy.

    ninja benchmark_settled          (or: settled.py [--rounds 10] [--scenes two two_flow --models hertz mpm mpm_nowaves] [--before FOLDER])
"""
import argparse
import itertools
import math
import os
import pathlib
import random
import re
import resource
import statistics
import subprocess
import tempfile

import loop

PACKING = pathlib.Path(__file__).resolve().parents[3] / "examples" / "benchmark" / "bed_30.txt"
HOPPER = pathlib.Path(__file__).resolve().parents[3] / "examples" / "hopper"
R, DENSITY, MODULUS = loop.RADIUS, loop.DENSITY, loop.E
YIELD_STRESS = 2 * MODULUS / (1 - loop.NU**2) / math.pi / 1.6 * loop.ONSETS["mpm_soft"]**0.5  # thornton's onset is the law's


class Program:
    """A plug-in and its launcher, in one folder."""

    def __init__(self, folder, label):
        self.launcher, self.label = pathlib.Path(folder).resolve() / "liggghts-mpm", label

    def run(self, folder, deck):
        """Text and user CPU of a run."""
        path = folder / f"in.{self.label}"
        path.write_text(deck)
        command = [str(self.launcher), "-in", str(path), "-log", "none"]
        environment = dict(os.environ, LD_LIBRARY_PATH=str(self.launcher.parent))
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        done = subprocess.run(command, capture_output=True, text=True, errors="replace", cwd=folder, env=environment)
        if done.returncode:
            raise SystemExit(f"settled.py: LIGGGHTS stopped:\n{done.stdout[-1500:]}{done.stderr[-1500:]}")
        return done.stdout, resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def model_words(name, tangential="history"):
    """LIGGGHTS's own words of a model, and ours, which stand last."""
    stock = f"model mpm tangential {tangential.replace('history', 'plastic')}" if name == "plastic" else f"model {name} tangential {tangential}"
    return stock, "law mpm.h5 materials powder beyondRange continue" if name in ("mpm", "plastic") else ""


MPM = os.environ.get("GRANULAW_MPM", "mpm")


class Scene:
    """A deck for each model. `prepare` writes the files that it reads."""
    one_law = True  # mpm.h5, whose force error is printed

    def __init__(self, name, steps):
        self.name, self.steps = name, steps

    def prepare(self, folder, program, model):
        pass

    def deck(self, program, model, steps):
        raise NotImplementedError

    def end(self, steps):
        return ("compute end_ke all ke\ncompute end_spin all erotate/sphere\nvariable end_ke equal c_end_ke\n"
                "variable end_spin equal c_end_spin\nthermo_style custom step c_end_ke c_end_spin\nthermo 1000000\n"
                f"thermo_modify norm no lost ignore\nrun {steps}\n"
                'print "ENERGY $(v_end_ke) $(v_end_spin)"\n')


def properties(model):
    """Restitution follows from our laws: the deck of stock Hertz alone states one."""
    lines = loop.properties(MODULUS, YIELD_STRESS).splitlines(True)
    return "".join(line for line in lines if model == "hertz" or "coefficientRestitution" not in line)


def bed(model, tangential="history", dt=loop.DT):
    stock, ours = model_words(model, tangential)
    pieces = ("fix pc all property/global cohesionEnergyDensity peratomtypepair 1 1000.0\n"
              "fix pr all property/global coefficientRollingFriction peratomtypepair 1 0.1\n" if "cohesion" in tangential else "")
    return (properties(model) + pieces + f"pair_style gran {stock} {ours}\npair_coeff * *\n"
            f"fix w all wall/gran {stock} primitive type 1 zplane 0.0\n"
            f"fix g all gravity {loop.GRAVITY} vector 0.0 0.0 -1.0\nfix i all nve/sphere\ntimestep {dt}\n")


class Bed(Scene):
    side = 12

    def head(self, read):
        return ("units si\nhard_particles yes\natom_style granular\natom_modify map array\nboundary p p f\nnewton off\n"
                f"communicate single vel yes\n{read}neighbor 0.0008 bin\nneigh_modify delay 0\n")

    def fall(self, folder, program, model, after):
        """The bed at rest under the model."""
        spacing = 2.06 * R
        atoms = []
        rng = random.Random(5)
        for k in range(self.side**3):
            cell = (k % self.side, k // self.side % self.side, k // self.side**2)
            x = [(c + 0.5) * spacing + rng.uniform(-0.02, 0.02) * R for c in cell]
            atoms.append([repr(w) for w in x] + [repr(rng.uniform(-0.2, 0.2)) for _ in range(3)] + ["0"] * 3)
        box = (self.side * spacing, self.side * spacing, 1.5 * self.side * spacing)
        loop.write_data(folder / "bed.data", atoms, box)
        program.run(folder, self.head("read_data bed.data\n") + bed(model) + f"thermo 1000000\nrun {60000}\n" + after)


class Rest(Bed):
    def prepare(self, folder, program, model):
        if not (folder / f"rest.{program.label}.{model}").exists():
            self.fall(folder, program, model, f"write_restart rest.{program.label}.{model}\n")

    def deck(self, program, model, steps):
        return self.head(f"read_restart rest.{program.label}.{model}\n") + bed(model) + self.end(steps)


class Two(Bed):
    """Two materials and two sizes, mixed at random, from the model's own restart file."""
    spheres, small, yields, one_law = (12, 12, 14), R / 1.5, (1e6, 1e5), False

    def __init__(self, name, steps, gravity):
        super().__init__(name, steps)
        self.gravity = gravity

    def prepare(self, folder, program, model):
        if not (folder / "two.h5").exists():
            (folder / "two.toml").write_text("".join(f"[material.{n}]\ndensity = 1500\nyoungs_modulus = {MODULUS}\npoisson_ratio = {loop.NU}\nyield_stress = {y}\n"
                                                     for n, y in zip("ab", self.yields)))
            subprocess.run([MPM, "table", "two.toml", "--radius-ratio", "1.5", "-o", "two.h5"], cwd=folder, check=True, capture_output=True)
        if not (folder / "two.data").exists():
            rng, spacing, rows, speeds = random.Random(5), 2.06 * R, "", ""
            nx, ny, nz = self.spheres
            for k in range(nx * ny * nz):
                at = [(c + 0.5) * spacing + rng.uniform(-0.02, 0.02) * R for c in (k % nx, k // nx % ny, k // (nx * ny))]
                rows += f"{k + 1} {rng.choice((1, 2))} {2 * rng.choice((R, self.small))!r} 1500 {' '.join(map(repr, at))}\n"
                speeds += f"{k + 1} {' '.join(repr(rng.uniform(-0.2, 0.2)) for _ in range(3))} 0 0 0\n"
            (folder / "two.data").write_text(f"two\n\n{nx * ny * nz} atoms\n2 atom types\n\n0 {nx * spacing} xlo xhi\n0 {ny * spacing} ylo yhi\n"
                                             f"0 {1.5 * nz * spacing} zlo zhi\n\nAtoms\n\n{rows}\nVelocities\n\n{speeds}")
        if not (folder / self.restart(program, model)).exists():
            program.run(folder, self.head("read_data two.data\n") + self.two(model) + f"thermo 1000000\nrun 60000\nwrite_restart {self.restart(program, model)}\n")

    def restart(self, program, model):
        return f"{self.name}.{program.label}.{model}"

    def two(self, model):
        def pairs(name, value):
            return f"fix {name} all property/global {name} peratomtypepair 2" + 4 * f" {value}" + "\n"

        words = f"model {model.removesuffix('_nowaves')} tangential history"
        law = "law two.h5 materials a b beyondRange continue" + (" waves off" if model.endswith("_nowaves") else "") if model != "hertz" else ""
        return (f"fix E all property/global youngsModulus peratomtype {MODULUS} {MODULUS}\nfix nu all property/global poissonsRatio peratomtype {loop.NU} {loop.NU}\n" +
                pairs("coefficientFriction", 0.5) + (pairs("coefficientRestitution", 0.1) if model == "hertz" else "") +
                f"pair_style gran {words} {law}\npair_coeff * *\nfix w all wall/gran {words} primitive type 1 zplane 0.0\n"
                f"fix g all gravity {loop.GRAVITY} vector {self.gravity}\nfix i all nve/sphere\ntimestep 3e-6\n")

    def deck(self, program, model, steps):
        return self.head(f"read_restart {self.restart(program, model)}\n") + self.two(model) + self.end(steps)


class Frozen(Bed):
    def __init__(self, name, steps, tangential):
        super().__init__(name, steps)
        self.tangential = tangential

    def prepare(self, folder, program, model):
        if model == "hertz" and not (folder / "frozen.data").exists():
            self.fall(folder, program, model,
                      "dump d all custom 1 frozen.dump id xu yu z vx vy vz omegax omegay omegaz\n"
                      'dump_modify d format "%d %.15g %.15g %.15g %.9g %.9g %.9g %.9g %.9g %.9g"\nrun 0\n')
            rows = loop.read_dump(folder / "frozen.dump")
            spacing = 2.06 * R
            for row in rows:
                for axis in (0, 1):
                    row[axis] = repr(float(row[axis]) % (self.side * spacing))
            loop.write_data(folder / "frozen.data", rows, (self.side * spacing, self.side * spacing, 1.5 * self.side * spacing))

    def deck(self, program, model, steps):
        return self.head("read_data frozen.data\n") + bed(model, self.tangential, 2e-9) + self.end(steps)


class Chute(Scene):
    def prepare(self, folder, program, model):
        if model == "hertz" and not (folder / "dense.data").exists():
            loop.prepare(folder, 3000)

    def deck(self, program, model, steps):
        stock, words = model_words(model)
        text = loop.head(data="dense.data") + properties(model) + loop.flow(model, words).replace(f"model {model} tangential history", stock)
        return text[:text.index("thermo 1000000")] + self.end(steps)


class Pressed(Scene):
    """The packing of tests/liggghts/test_plastic_shear.py, 27 times."""
    one_law, density = False, (0.58, 0.94)

    def __init__(self, name):
        self.points = [[float(x) for x in line.split()] for line in PACKING.read_text().splitlines()]
        self.side = (len(self.points) * 4 * math.pi / 3 / self.density[0]) ** (1 / 3)  # of an image, over R
        sound = math.sqrt(MODULUS / (1 - loop.NU**2) / DENSITY)
        self.rate, self.dt = 0.001 * sound / R, 0.01 * R / sound
        super().__init__(name, round((1 - (self.density[0] / self.density[1]) ** (1 / 3)) / self.rate / self.dt))

    def prepare(self, folder, program, model):
        if (folder / "pressed.h5").exists():
            return
        box = 3 * self.side * R
        places = [[(x % self.side + k * self.side) * R for x, k in zip(point, image)]
                  for point in self.points for image in itertools.product(range(3), repeat=3)]
        rows = [[repr(x) for x in at] + [repr(self.rate * (box / 2 - x)) for x in at] + ["0"] * 3 for at in places]
        loop.write_data(folder / "pressed.data", rows, (box,) * 3)
        (folder / "pressed.toml").write_text(f"[material.powder]\ndensity = {DENSITY}\nyoungs_modulus = {MODULUS}\npoisson_ratio = {loop.NU}\n"
                                             f"yield_stress = {MODULUS / (1 - loop.NU**2) / 100}\n")
        subprocess.run([MPM, "table", "pressed.toml", "--depth", "0.5", "-o", "pressed.h5"], cwd=folder, check=True, capture_output=True)

    def deck(self, program, model, steps):
        words = " ".join(model_words(model)).replace("mpm.h5", "pressed.h5")
        return ("units si\nhard_particles yes\natom_style granular\natom_modify map array\nboundary p p p\nnewton off\n"
                f"communicate single vel yes\nread_data pressed.data\nneighbor {0.4 * R} bin\nneigh_modify delay 0\n" + properties(model) +
                f"pair_style gran {words}\npair_coeff * *\nfix i all nve/sphere\nfix d all deform 1 " +
                " ".join(f"{a} erate {-self.rate!r}" for a in "xyz") + f" remap v units box\ntimestep {self.dt!r}\n" + self.end(steps))


class Hopper(Scene):
    def command(self, program, model, **more):
        text = ""
        for key, value in {"model": model, "scene": "scene", "out": f"hopper.{program.label}.{model}", "law": "mpm.h5",
                           "material": "powder", **more}.items():
            text += f"variable {key} index {value}\n"
        text += (HOPPER / "in.hopper").read_text()
        if model == "plastic":
            text = text.replace("index plastic", "index mpm", 1).replace("tangential history", "tangential plastic")
        return text

    def prepare(self, folder, program, model):
        if not (folder / "scene").exists():
            subprocess.run(["/usr/bin/python3", str(HOPPER / "make_scene.py"), "-o", str(folder / "scene"), "--particles", "1500"], check=True,
                           capture_output=True)
        if (folder / f"hopper.{program.label}.{model}" / "filled.restart").exists():
            return
        (folder / f"hopper.{program.label}.{model}").mkdir(exist_ok=True)
        program.run(folder, self.command(program, model, fill=50000, flow=0, every=1000000000, pictures=1000000000))

    def deck(self, program, model, steps):
        return self.command(program, model, refill=0, flow=steps, every=1000000000, pictures=1000000000) + self.end(0)


def scene_run(folder, scene, program, model, steps):
    """User CPU, loop time, time of pairs (s) and the energies at the end."""
    text, cpu = program.run(folder, scene.deck(program, model, steps))
    seconds = max([float(w) for w in re.findall(r"^Loop time of (\S+)", text, re.M)] or [0.0])
    pair = max([float(w) for w in re.findall(r"^Pair  time \(%\) = (\S+)", text, re.M)] or [0.0])
    energies = [float(w) for w in re.findall(r"^ENERGY (\S+) (\S+)", text, re.M)[-1]]
    return cpu, seconds, pair, energies


def measure(folder, scene, programs, models, rounds, error):
    """Runs one scene and prints its lines; the last program's Hertz is the base."""
    base = (programs[-1], "hertz")
    runs = [base] + [(p, m) for m in models if m != "hertz" for p in programs]
    for run in runs:
        scene.prepare(folder, *run)
    start = {run: min(scene_run(folder, scene, *run, 0)[0] for _ in range(2)) for run in runs}
    found = {run: [] for run in runs}
    for _ in range(rounds):
        for run in runs:
            cpu, *rest = scene_run(folder, scene, *run, scene.steps)
            found[run].append((cpu - start[run], *rest))

    def ratio(run, k):
        ratios = [a[k] / b[k] for a, b in zip(found[run], found[base])]
        return f"{statistics.median(ratios):.3f} [{min(ratios):.3f}, {max(ratios):.3f}]"

    for run in runs:
        program, model = run
        motion = ""
        if program is programs[-1] and len(programs) > 1 and model != "hertz":
            pairs = zip(found[run][0][3], found[programs[0], model][0][3])
            motion = f"  motion {max(abs(a / b - 1) if b else abs(a) for a, b in pairs):.2g} from {programs[0].label}"
        print(f"{scene.name:20s} {model:9s} {program.label:7s} CPU ratio {ratio(run, 0)}  loop ratio {ratio(run, 1)}  "
              f"pair-time ratio {ratio(run, 2)}  {statistics.median(a[0] for a in found[run]):.2f} s  "
              f"force error {error.get(model.replace('plastic', 'mpm'), 'none (closed form)') if scene.one_law else 'as mpm table states'}{motion}", flush=True)


def scenes(options):
    found = {"rest": Rest("rest", 2000), "frozen": Frozen("frozen", 2000, "history"), "frozen_off": Frozen("frozen_off", 2000, "off"),
             "frozen_all": Frozen("frozen_all", 2000, "history cohesion sjkr rolling_friction epsd2"),
             "hopper": Hopper("hopper", 2000), "chute": Chute("chute", 1000), "pressed": Pressed("pressed"), "two": Two("two", 2000, "0 0 -1"),
             "two_flow": Two("two_flow", 2000, f"{loop.ANGLE[0]} 0 {-loop.ANGLE[1]}")}
    for name in options.scenes:
        yield found[name]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=10)
    parser.add_argument("--scenes", nargs="*", default=["rest", "frozen", "frozen_off", "frozen_all", "hopper", "chute"])
    parser.add_argument("--models", nargs="+", default=["hertz", "mpm", "thornton"])
    parser.add_argument("--before", action="append", default=[], help="folder of another plug-in and its launcher")
    parser.add_argument("--stiffness", type=float, help="E*/Y of a law of `mpm table`; default: the benchmark's law")
    parser.add_argument("--folder", help="where scenes are kept; default: a folder that is removed")
    options = parser.parse_args()
    programs = [Program(folder, pathlib.Path(folder).name) for folder in options.before] + [
        Program(pathlib.Path(loop.LAUNCHER).parent, "now")]
    with tempfile.TemporaryDirectory(prefix="granulaw-settled-") as name:
        folder = pathlib.Path(options.folder or name)
        folder.mkdir(exist_ok=True)
        if options.stiffness:
            (folder / "mpm.toml").write_text(f"[material.powder]\ndensity = {DENSITY}\nyoungs_modulus = {MODULUS}\npoisson_ratio = {loop.NU}\n"
                                             f"yield_stress = {MODULUS / (1 - loop.NU**2) / options.stiffness}\n")
            subprocess.run([MPM, "table", "mpm.toml", "-o", "mpm.h5"], cwd=folder, check=True, capture_output=True)
            error = {"mpm": "as mpm table states"}
        else:
            error = {"mpm": subprocess.run([loop.LAW_MAKER, "one", str(folder / "mpm.h5"), str(loop.ONSETS["mpm_soft"])], check=True,
                                           capture_output=True, text=True).stdout.strip()}
        for scene in scenes(options):
            measure(folder, scene, programs, options.models, options.rounds, error)


if __name__ == "__main__":
    main()
