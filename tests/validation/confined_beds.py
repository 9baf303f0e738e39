#!/usr/bin/python3
"""Tables of docs/guide/pressing.md and of docs/evidence/confined.md: LIGGGHTS against resolved spheres.

    confined_beds.py packing|die [--step 0.05] [--words "confinement on"] [--tangential history] [--ranks N]

packing: 30 spheres in a periodic box, pressed from all sides. die: 30 spheres between six walls, under a lid that comes down. Both at 0.001 c*/R, friction
0.3, E*/Y = 100; --step over R/c*. Prints differences in %. Takes `mpm` and `liggghts-mpm` of the PATH or of GRANULAW_MPM and GRANULAW_LAUNCHER; 10 to 60 CPU s.
"""
import argparse
import csv
import math
import os
import pathlib
import subprocess
import tempfile

TOP = pathlib.Path(__file__).resolve().parents[2]
R, E, NU, DENSITY, YIELD, RATE = 1e-3, 9.1e9, 0.3, 1500.0, 1e8, 0.001
UNIT = R / math.sqrt(E / (1 - NU**2) / DENSITY)  # s, R/c*
WIDTH, HEIGHT = 5.945, 7.729                      # of the die, over R

def rows(path):
    return list(csv.DictReader(line for line in path.read_text().splitlines() if not line.startswith("#")))

def points(path):
    return [[float(x) * R for x in line.split()] for line in path.read_text().splitlines()]

def head(options, boundary, box, types):
    each = " ".join(["{}"] * types)
    return ("units si\nhard_particles yes\natom_style granular\natom_modify map array\n"
            f"boundary {boundary}\nnewton off\ncommunicate single vel yes\nregion box block {box} units box\ncreate_box {types} box\n"
            f"neighbor {0.1 * R} bin\nneigh_modify delay 0\nfix E all property/global youngsModulus peratomtype {each.format(*[E] * types)}\n"
            f"fix nu all property/global poissonsRatio peratomtype {each.format(*[NU] * types)}\n"
            f"fix mu all property/global coefficientFriction peratomtypepair {types}{' 0.3' * types**2}\n"
            f"pair_style gran model mpm tangential {options.tangential} law law.h5 materials{' powder' * types} beyondRange continue {options.words}\npair_coeff * *\n")

def spheres(places):
    return ("".join(f"create_atoms 1 single {x!r} {y!r} {z!r} units box\n" for x, y, z in places) +
            f"set group all diameter {2 * R!r} density {DENSITY}\nfix i all nve/sphere\n")

def packing(options):
    """Deck, and what is compared: name, column of its output, unit, column of the resolved rows."""
    places = points(TOP / "examples/benchmark/bed_30.txt")
    volume = len(places) * 4 * math.pi / 3 * R**3
    side = (volume / 0.58) ** (1 / 3)
    steps = round((1 - (0.58 / 0.985) ** (1 / 3)) / RATE / options.step)
    box = " ".join(f"0 {side!r}" for _ in "xyz")
    return (head(options, "p p p", box, 1) + spheres([[x % side for x in p] for p in places]) +
            "fix d all deform 1 " + " ".join(f"{a} vel {-side * RATE / UNIT!r}" for a in "xyz") + " remap x units box\ncompute p all pressure thermo_temp virial\n"
            f"thermo_style custom step c_p\nvariable d equal {volume!r}/vol\n"
            f'timestep {options.step * UNIT!r}\nfix out all print 5 "$(v_d) $(c_p)" file out.txt screen no title ""\nrun {steps}\n',
            rows(TOP / "tests/liggghts/packing_30_resolved.csv"), {"stress": ([1], YIELD, ["stress"])})

def die(options):
    places = points(TOP / "tests/validation/die_30.txt")
    volume, speed = len(places) * 4 * math.pi / 3 * R**3, HEIGHT * RATE * R / UNIT
    wide = [(-R, -R), ((WIDTH + 1) * R, -R), ((WIDTH + 1) * R, (WIDTH + 1) * R), (-R, (WIDTH + 1) * R)]
    pathlib.Path("lid.stl").write_text("solid lid\n" + "".join(
        "facet normal 0 0 -1\nouter loop\n" + "".join(f"vertex {wide[k][0]!r} {wide[k][1]!r} {HEIGHT * R!r}\n" for k in corners) + "endloop\nendfacet\n"
        for corners in ((0, 1, 2), (0, 2, 3))) + "endsolid lid\n")
    end = volume / (WIDTH * R) ** 2 / 0.97 / R  # height over R
    text = head(options, "f f f", f"{-2 * R} {(WIDTH + 2) * R} {-2 * R} {(WIDTH + 2) * R} {-2 * R} {(HEIGHT + 2) * R}", 2)
    walls = (("x", 0, 1), ("x", WIDTH, 1), ("y", 0, 2), ("y", WIDTH, 2), ("z", 0, 3))
    model = f"all wall/gran model mpm tangential {options.tangential}"
    for k, (axis, at, _) in enumerate(walls):
        text += f"fix w{k} {model} primitive type 2 {axis}plane {at * R!r} store_force yes\n"
    text += (f"fix lid all mesh/surface/stress file lid.stl type 2\nfix press {model} mesh n_meshes 1 meshes lid\n"
             f"fix go all move/mesh mesh lid linear 0 0 {-speed!r}\n" + spheres(places) +
             f"velocity all ramp vz 0.0 {-speed!r} z 0.0 {HEIGHT * R!r} units box\ntimestep {options.step * UNIT!r}\n")
    text += "".join(f"compute f{k} all reduce sum f_force_w{k}[{axis}]\n" for k, (_, _, axis) in enumerate(walls))
    text += (f"variable d equal {volume!r}/({(WIDTH * R) ** 2!r}*({HEIGHT * R!r}-step*{speed * options.step * UNIT!r}))\n"
             "thermo_style custom step c_f0 c_f1 c_f2 c_f3 c_f4 f_lid[3]\n"
             'fix out all print 5 "$(v_d) $(c_f0) $(-c_f1) $(c_f2) $(-c_f3) $(c_f4) $(f_lid[3])" file out.txt screen no title ""\n'
             f"run {round((HEIGHT - end) / HEIGHT / RATE / options.step)}\n")
    force = YIELD * R**2
    return text, rows(TOP / "docs/evidence/confined-die.csv"), {"lid": ([6], force, ["lid"]), "floor": ([5], force, ["floor"]),
                                                                "sides": ([1, 2, 3, 4], force, ["left", "right", "front", "back"])}

def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("bed", choices=("packing", "die"))
    parser.add_argument("--step", type=float, default=0.05)
    parser.add_argument("--words", default="confinement on")
    parser.add_argument("--tangential", default="history")
    parser.add_argument("--ranks", type=int, default=1)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        pathlib.Path("m.toml").write_text(f"[material.powder]\ndensity = {DENSITY}\nyoungs_modulus = {E}\npoisson_ratio = {NU}\nyield_stress = {YIELD}\n")
        subprocess.run([os.environ.get("GRANULAW_MPM", "mpm"), "table", "m.toml", "--depth", "0.5", "-o", "law.h5"], check=True, capture_output=True)
        deck, resolved, compared = globals()[options.bed](options)
        pathlib.Path("in.bed").write_text(deck)
        launcher = [os.environ.get("GRANULAW_LAUNCHER", "liggghts-mpm"), "-in", "in.bed", "-log", "none"]
        done = subprocess.run((["mpirun", "-np", str(options.ranks)] if options.ranks > 1 else []) + launcher, capture_output=True, text=True, errors="replace")
        if done.returncode:
            raise SystemExit(f"confined_beds.py: LIGGGHTS stopped:\n{done.stdout[-1500:]}{done.stderr[-500:]}")
        found = [[float(x) for x in line.split()] for line in pathlib.Path("out.txt").read_text().splitlines() if line.strip()]
    print("| density | " + " | ".join(row["density"] for row in resolved) + " |")
    for name, (columns, unit, truth) in compared.items():
        cells = []
        for row in resolved:
            window = [sum(line[c] for c in columns) for line in found if abs(line[0] - float(row["density"])) <= 0.005]
            cells.append(f"{100 * (sum(window) / len(window) / unit / sum(float(row[c]) for c in truth) - 1):+.1f}" if window else "-")
        print(f"| {name} | " + " | ".join(cells) + " |")

if __name__ == "__main__":
    main()
