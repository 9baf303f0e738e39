"""Loop time of LIGGGHTS in dense flow under each normal model, as a ratio to stock Hertz.

A chute flow (periodic in x and y, rough floor) is prepared once with stock Hertz; then every model runs the same
steps from the same positions and velocities, several times, interleaved. Prints for each model the median ratio of
loop times with its spread, pair-force time, particle-steps per second, and
the error of the force that the loop computes. Standard library only.

    ninja benchmark_liggghts          (or: loop.py [--repeats 5] [--steps 1500] [--spheres 3000])
"""
import argparse
import os
import pathlib
import random
import re
import statistics
import subprocess
import tempfile

LAUNCHER, HERTZ, LAW_MAKER = (os.environ[k] for k in ("GRANULAW_LAUNCHER", "GRANULAW_HERTZ", "GRANULAW_LAW_MAKER"))
RADIUS, DENSITY, NU, E = 2e-3, 1500.0, 0.3, 9.1e7  # soft, so that the bed packs in seconds; the loop does the same work
GRAVITY, ANGLE, DT = 9.81, (0.3907, 0.9205), 6e-6  # sine and cosine of 23 degrees; 0.15 of the Rayleigh time
WARM_UP = 500  # steps before the clock starts
ONSETS = {"mpm": 6.4e-4, "mpm_soft": 6.4e-6}  # E*/Y = 100; and one tenth of that yield stress


def properties(youngs_modulus, yield_stress):
    return (f"fix p1 all property/global youngsModulus peratomtype {youngs_modulus}\n"
            f"fix p2 all property/global poissonsRatio peratomtype {NU}\n"
            f"fix p3 all property/global yieldStress peratomtype {yield_stress}\n"
            "fix p4 all property/global coefficientFriction peratomtypepair 1 0.5\n"
            "fix p5 all property/global coefficientRestitution peratomtypepair 1 0.5\n")


def head(box=None, data=None):
    text = ("units si\nhard_particles yes\natom_style granular\natom_modify map array\nboundary p p f\nnewton off\n"
            "communicate single vel yes\n")
    if data:
        text += f"read_data {data}\n"
    return text + ("neighbor 0.0008 bin\n"
                   "neigh_modify delay 0 contact_distance_factor 1.01\n")  # stock Hertz too forgets what parted


def flow(model, words=""):
    return (f"pair_style gran model {model} tangential history {words}\npair_coeff * *\n"
            f"fix w all wall/gran model {model} tangential history primitive type 1 zplane 0.0\n"
            f"fix g all gravity {GRAVITY} vector {ANGLE[0]} 0.0 {-ANGLE[1]}\nfix i all nve/sphere\ntimestep {DT}\n"
            "thermo 1000000\ncompute n all contact/atom\ncompute z all reduce ave c_n\n"
            "thermo_style custom step c_z\n")


def write_data(path, atoms, box, ):
    text = "flow\n\n%d atoms\n1 atom types\n\n" % len(atoms)
    for c, size in zip("xyz", box):
        text += f"0 {size!r} {c}lo {c}hi\n"
    text += "\nAtoms\n\n" + "".join(f"{k + 1} 1 {2 * RADIUS!r} {DENSITY} {a[0]} {a[1]} {a[2]}\n"
                                    for k, a in enumerate(atoms))
    text += "\nVelocities\n\n" + "".join(f"{k + 1} {a[3]} {a[4]} {a[5]} {a[6]} {a[7]} {a[8]}\n"
                                         for k, a in enumerate(atoms))
    path.write_text(text)


def run(folder, deck, preload=None):
    path = folder / "in.deck"
    path.write_text(deck)
    environment = dict(os.environ, **({"LD_PRELOAD": preload} if preload else {}))
    done = subprocess.run([LAUNCHER, "-in", str(path), "-log", "none"], capture_output=True, text=True,
                          errors="replace", cwd=folder, env=environment)
    if done.returncode:
        raise SystemExit(f"loop.py: LIGGGHTS stopped:\n{done.stdout[-1500:]}{done.stderr[-1500:]}")
    return done.stdout


def read_dump(path):
    lines = path.read_text().splitlines()
    start = max(k for k, line in enumerate(lines) if line.startswith("ITEM: ATOMS")) + 1
    rows = sorted((line.split() for line in lines[start:]), key=lambda r: int(r[0]))
    return [row[1:] for row in rows]


def prepare(folder, spheres):
    """A dense layer that flows slowly, from a jittered lattice."""
    rng = random.Random(3)
    step, columns, rows = 2.06 * RADIUS, 15, 10
    box = (columns * step, rows * step, 3.0 * step * spheres / (columns * rows))
    atoms = []
    for k in range(spheres):
        cell = (k % columns, k // columns % rows, k // (columns * rows))
        x = [(c + 0.5) * step + rng.uniform(-0.02, 0.02) * RADIUS for c in cell]
        v = [rng.uniform(-0.3, 0.3) + (0.6 if axis == 0 else 0.0) for axis in range(3)]
        atoms.append([repr(w) for w in x + v] + ["0", "0", "0"])
    write_data(folder / "start.data", atoms, box)
    text = run(folder, head(data="start.data") + properties(E, 1e30) + flow("hertz") + "run 40000\n"
               "dump d all custom 1 flow.dump id xu yu z vx vy vz omegax omegay omegaz\n"
               'dump_modify d format "%d %.12g %.12g %.12g %.9g %.9g %.9g %.9g %.9g %.9g"\nrun 0\n')
    flowing = read_dump(folder / "flow.dump")
    for row in flowing:
        for axis in (0, 1):
            row[axis] = repr(float(row[axis]) % box[axis])
    write_data(folder / "flow.data", flowing, box)
    return contacts(text)


def contacts(text):
    """Mean number of contacts of a sphere in the last line of thermo output."""
    rows = re.findall(r"^\s*\d+ +(\S+) *$", text, re.M)
    return float(rows[-1])


def loop(folder, name, steps):
    # yield stress for thornton: onset at the same overlap as the law's, delta_y/R = (1.6 pi Y/(2E*))^2
    e_star = E / (1 - NU * NU)
    yield_stress = {o: 2 * e_star / 3.14159265 / 1.6 * x**0.5 for o, x in ONSETS.items()}
    model, words, preload, y = name, "", None, yield_stress["mpm"]
    if name.startswith("mpm"):
        model, words = "mpm", f"law {name}.h5 materials powder beyondRange continue elasticDamping 0.001"
    elif name.startswith("thornton"):
        model, words, y = "thornton", "elasticDamping 0.001", yield_stress[name.replace("thornton", "mpm")]
    elif name == "hertz_granulaw":
        preload = HERTZ
    text = run(folder, head(data="flow.data") + properties(E, y) + flow(model, words) +
               f"run {WARM_UP}\nrun {steps}\n", preload)
    seconds = float(re.findall(r"^Loop time of (\S+)", text, re.M)[-1])
    pair = float(re.findall(r"^Pair  time \(%\) = (\S+)", text, re.M)[-1])
    return seconds, pair, contacts(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--steps", type=int, default=1500)
    parser.add_argument("--spheres", type=int, default=3000)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="granulaw-loop-") as name:
        folder = pathlib.Path(name)
        error = {law: subprocess.run([LAW_MAKER, str(folder / f"{law}.h5"), str(onset)], check=True,
                                     capture_output=True, text=True).stdout.strip() for law, onset in ONSETS.items()}
        coordination = prepare(folder, options.spheres)
        models = ("hertz", "hertz_granulaw", "mpm", "mpm_soft", "thornton", "thornton_soft")
        times = {m: [] for m in models}
        for _ in range(options.repeats):
            for m in models:
                times[m].append(loop(folder, m, options.steps))
        print(f"chute flow, {options.spheres} spheres, {options.steps} steps, {options.repeats} interleaved runs, "
              f"{coordination:.2f} contacts a sphere at the start; "
              "ratio of loop times to stock hertz, round by round: median [lowest, highest]; of the fastest runs")
        for m in models:
            ratios = [t[0] / h[0] for t, h in zip(times[m], times["hertz"])]
            seconds = statistics.median(t[0] for t in times[m])
            pair = statistics.median(t[1] for t in times[m]) / statistics.median(t[1] for t in times["hertz"])
            best = min(t[0] for t in times[m]) / min(t[0] for t in times["hertz"])  # what a busy machine disturbs least
            print(f"{m:15s} loop ratio {statistics.median(ratios):.3f} [{min(ratios):.3f}, {max(ratios):.3f}]  "
                  f"fastest {best:.3f}  "
                  f"pair-time ratio {pair:.3f}  {options.spheres * options.steps / seconds / 1e6:.2f} M particle-steps/s  "
                  f"{statistics.median(t[2] for t in times[m]):.2f} contacts a sphere  "
                  f"force error {error.get(m, 'none (closed form)')}")


if __name__ == "__main__":
    main()
