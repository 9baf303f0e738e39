"""A bed of spheres under one law in LAMMPS and LIGGGHTS: energies step by step, ranks, restart, and user CPU of the loop over that of LAMMPS's own styles.

    . /etc/environment; PYTHONPATH=tests/support:tests/lammps /usr/bin/python3 tests/validation/lammps_bed.py --build build/release -o out/bed energy
    ... energy --ranks 2 | restart | loop --rounds 12

docs/reference/pair_granulaw.md has the numbers.
"""
import argparse
import os
import pathlib
import random
import resource
import statistics
import subprocess

from decks import Lammps, Liggghts, data_file

WAX = '[material.wax]\ndensity = 920\nyoungs_modulus = 91e6\npoisson_ratio = 0.3\nyield_stress = 1e6\n[particle.pellet]\nradius = 3e-3\nmaterial = "wax"\n'
RADIUS, DENSITY, YOUNG, NU, FRICTION, DT = 3e-3, 920.0, 91e6, 0.3, 0.3, 2e-6
SHEAR = 8.0 / (2 * 2 * (2 - NU) * (1 + NU) / YOUNG)  # 8 G* of wax on wax, which LIGGGHTS takes at a wall of wax's type, too
KN, KT = 2 * YOUNG / (3 * (1 - NU**2)), 2 * YOUNG / ((1 + NU) * (2 - NU))  # of gran/hertz/history: 4/3 E*, 8 G*


class Bed:
    def __init__(self, build, folder, count):
        self.build, self.folder, self.count = pathlib.Path(build).resolve(), pathlib.Path(folder).resolve(), count
        self.folder.mkdir(parents=True, exist_ok=True)
        (self.folder / "m.toml").write_text(WAX)
        self.law = self.folder / "wax.h5"
        subprocess.run([self.build / "tools/mpm/mpm", "table", "m.toml", "-o", "wax.h5"], cwd=self.folder, check=True, stdout=subprocess.DEVNULL)
        self.lmp, self.liggghts = self.build / "engines/lammps/lmp-granulaw", self.build / "liggghts_plugin/liggghts-mpm"

    def data(self, moved=0.0, pitch=2.3 * RADIUS):
        """Spheres over z = 0, sides periodic. moved: of sphere 1 along x, m."""
        chance, side = random.Random(1), max(4, round((self.count / 3)**(1 / 3)))
        atoms = [[1, RADIUS, DENSITY, *((n + 0.5 + chance.uniform(-0.06, 0.06) * (1.0 if pitch > 2.2 * RADIUS else 0.35)) * pitch for n in (k % side, k // side % side, k // side**2)), 0.0, 0.0, chance.uniform(-0.4, 0.0)] for k in range(self.count)]
        atoms[0][3] += moved
        return data_file(self.folder / f"bed{moved}-{pitch}.data", [tuple(a) for a in atoms], ((0.0, side * pitch), (0.0, side * pitch), (-1e-3, (self.count // side**2 + 3) * pitch)))

    def run(self, name, program, deck, ranks=1):
        """User CPU of the run, s, and what was printed."""
        (self.folder / f"in.{name}").write_text(deck)
        words = ["mpirun", "--oversubscribe", "-np", str(ranks)] if ranks > 1 else []
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        done = subprocess.run([*words, program, "-in", f"in.{name}", "-log", f"log.{name}"], cwd=self.folder, capture_output=True, text=True, check=False)
        if done.returncode:
            raise SystemExit(done.stdout[-2000:] + done.stderr[-2000:])
        return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before, done.stdout

    def law_deck(self, engine, read, damping=0.1, elastic_damping=0.001):
        text = engine.head(boundary="p p f") + f"{read}\n"
        text += engine.law(self.law, ["wax"], "", FRICTION, "history", damping, elastic_damping, **({} if engine is Lammps else {"moduli": [(YOUNG, NU)]}))
        return text + engine.floor(f"shear_stiffness {SHEAR!r}" if engine is Lammps else "") + engine.gravity + f"timestep {DT!r}\n"

    def energies(self, engine, steps, moved=0.0, every=200, ranks=1):
        deck = self.law_deck(engine, f"read_data {self.data(moved)}") + "compute K all ke\ncompute T all erotate/sphere\nvariable k equal c_K+c_T\n"
        if engine is Lammps:
            deck += "compute L all pair granulaw\nvariable l equal c_L[1]+f_floor[1]\nvariable m equal c_L[3]+f_floor[3]\n"
        deck += f"thermo_style custom step v_k{' v_l v_m' if engine is Lammps else ''}\nthermo_modify format float %.17g norm no\nthermo {every}\nrun {steps}\n"
        _, text = self.run(f"{engine.name}{moved}-{ranks}", self.lmp if engine is Lammps else self.liggghts, deck, ranks)
        rows, on = {}, False
        for line in text.splitlines():
            words = line.split()
            on = (words[:1] == ["Step"]) or (on and not line.startswith("Loop"))
            if on and words and words[0].isdigit():
                rows[int(words[0])] = [float(w) for w in words[1:]]
        return rows


def energy(bed, args):
    lammps, liggghts, moved = bed.energies(Lammps, args.steps, every=args.every), bed.energies(Liggghts, args.steps, every=args.every), bed.energies(Lammps, args.steps, 4e-19, every=args.every)
    others = {n: bed.energies(Lammps, args.steps, every=args.every, ranks=n) for n in args.ranks}
    peak = max(row[0] for row in lammps.values())
    print("kinetic energy over its peak, difference: steps up to, LIGGGHTS, a sphere moved by an ulp" + "".join(f", {n} ranks, their ledgers" for n in args.ranks))
    steps = sorted(lammps)
    for low, high in zip(steps[::max(1, len(steps) // 10)], steps[max(1, len(steps) // 10)::max(1, len(steps) // 10)]):
        part = [s for s in steps if low < s <= high]

        def off(other, column=0):
            return max(abs(other[s][column] - lammps[s][column]) for s in part) / (peak if column == 0 else max(lammps[steps[-1]][column], 1e-300))

        print(f"{high:8d} {off(liggghts):9.1e} {off(moved):9.1e}" + "".join(f" {off(o):9.1e} {max(off(o, 1), off(o, 2)):9.1e}" for o in others.values()))


def restart(bed, args):
    """Kinetic energy and plastic work of a run in two pieces against one whole; also LAMMPS's own style."""
    half = args.steps // 2
    say = 'compute K all ke\nvariable k equal c_K\nthermo_style custom step v_k\n'
    end = 'print "K $(v_k:%.17g)"\n'
    for name, damping in (("granulaw undamped", 0.0), ("granulaw", 0.1), ("gran/hertz/history", None)):
        def deck(read, steps, name=name, damping=damping):
            if damping is not None:
                return bed.law_deck(Lammps, read, damping, 0.0 if damping == 0 else 0.001) + say + f"run {steps}\n"
            return own(bed, "gran/hertz/history", read) + say + f"run {steps}\n"
        first = f"read_data {bed.data()}"
        whole = bed.run("whole", bed.lmp, deck(first, args.steps) + end)[1]
        bed.run("first", bed.lmp, deck(first, half) + "write_restart half.bin\n")
        for ranks in (1, 2):
            again = bed.run("second", bed.lmp, deck("read_restart half.bin", args.steps - half).replace("boundary p p f\n", "") + end, ranks)[1]
            a, b = (float(text.split("\nK ")[-1].split()[0]) for text in (whole, again))
            print(f"{name}, {ranks} ranks: {abs(b / a - 1):.1e}")


def own(bed, style, read):
    """A bed under one of LAMMPS's own styles."""
    text = Lammps.head(boundary="p p f") + f"{read}\n"
    if style == "gran/hertz/history":
        words = f"hertz/history {KN!r} {KT!r} 1e6 5e5 {FRICTION!r} 1"
        text += f"pair_style gran/{words}\npair_coeff * *\nfix floor all wall/gran {words} zplane 0.0 NULL\n"
    else:
        words = f"hertz/material {YOUNG!r} 0.5 {NU!r} tangential mindlin NULL 1.0 {FRICTION!r} damping tsuji"
        text += f"pair_style granular\npair_coeff * * {words}\nfix floor all wall/gran granular {words} zplane 0.0 NULL\n"
    return text + Lammps.gravity + f"timestep {DT!r}\n"


def loop(bed, args):
    """User CPU a step of a bed at rest, each under its own law; start-up (a run of no steps) taken off. Interleaved rounds, medians."""
    def decks(read):
        return {"gran/hertz/history": own(bed, "gran/hertz/history", read), "granular": own(bed, "granular", read), "granulaw": bed.law_deck(Lammps, read)}

    for name, deck in decks(f"read_data {bed.data(pitch=2.1 * RADIUS)}").items():
        deck += "fix drag all viscous 0.003\ntimestep 5e-6\ncompute n all contact/atom\ncompute s all reduce sum c_n\nvariable n equal c_s/2\nthermo_style custom step ke v_n\n"
        text = bed.run("settle", bed.lmp, deck + f"run {args.settle}\nwrite_restart {bed.folder}/{name.replace('/', '-')}.bin\nrun 0\nprint \"N $(v_n)\"\n")[1]
        print(f"{name}: {text.split(chr(10) + 'N ')[-1].split()[0]} contacts of spheres")
    times = {name: [] for name in decks("")}
    for _ in range(args.rounds):
        for name, deck in decks("read_restart FILE").items():
            deck = deck.replace("boundary p p f\n", "").replace("FILE", str(bed.folder / f"{name.replace('/', '-')}.bin"))
            spent = [bed.run("loop", bed.lmp, deck + f"run {steps}\n")[0] for steps in (0, args.steps)]
            times[name].append((spent[1] - spent[0]) / args.steps * 1e6)
    base = times["gran/hertz/history"]
    for name, spent in times.items():
        ratios = sorted(t / b for t, b in zip(spent, base))
        print(f"{name}: {statistics.median(spent):.0f} us a step, {statistics.median(ratios):.3f} of gran/hertz/history [{ratios[0]:.2f}, {ratios[-1]:.2f}]; least {min(spent):.0f} us, {min(spent) / min(base):.3f}")
    ratios = sorted(a / b for a, b in zip(times["granulaw"], times["granular"]))
    print(f"granulaw over granular: {statistics.median(ratios):.3f} [{ratios[0]:.2f}, {ratios[-1]:.2f}]; of the least {min(times['granulaw']) / min(times['granular']):.3f}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("energy", "restart", "loop"))
    parser.add_argument("--build", default="build/release")
    parser.add_argument("-o", "--out", default="out/lammps-bed")
    parser.add_argument("--count", type=int, default=2000)
    parser.add_argument("--steps", type=int, default=4000)
    parser.add_argument("--every", type=int, default=200)
    parser.add_argument("--ranks", type=int, nargs="*", default=[])
    parser.add_argument("--settle", type=int, default=60000)
    parser.add_argument("--rounds", type=int, default=5)
    words = parser.parse_args()
    os.environ.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMP_NUM_THREADS="1", OMPI_MCA_ess_singleton_isolated="1", OMPI_MCA_rmaps_base_oversubscribe="1")
    {"energy": energy, "restart": restart, "loop": loop}[words.what](Bed(words.build, words.out, words.count), words)
