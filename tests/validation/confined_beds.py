#!/usr/bin/python3
"""Tables of docs/guide/pressing.md and of docs/evidence/confined.md: LIGGGHTS against resolved spheres.

    confined_beds.py packing|die|bed [--step 0.05] [--words "confinement on"] [--tangential history] [--ranks N]
    confined_beds.py bed [--count 30] [--spread 0] [--stiffness 100] [--friction 0.3] [--rate 0.001] [--cells 12] [--back]

packing: 30 spheres in a periodic box, pressed from all sides. die: 30 spheres between six walls, under a lid that comes down. Both at 0.001 c*/R, friction
0.3, E*/Y = 100; --step over R/c*. Prints differences in %. Takes `mpm` and `liggghts-mpm` of the PATH or of GRANULAW_MPM and GRANULAW_LAUNCHER; 10 to 60 CPU s.
bed: as packing, of --count spheres with radii of 1 -+ --spread. `mpm compact` resolves it first: 45 CPU s of 30 spheres at 12 cells, 100 of 1000 at 6.
--back: it is unloaded from 0.948.
"""
import argparse
import csv
import math
import os
import pathlib
import subprocess
import tempfile

import numpy as np

TOP = pathlib.Path(__file__).resolve().parents[2]
R, E, NU, DENSITY, E_STAR, RATE = 1e-3, 9.1e9, 0.3, 1500.0, 1e10, 0.001
UNIT = R / math.sqrt(E_STAR / DENSITY)         # s, R/c*
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
            f"fix mu all property/global coefficientFriction peratomtypepair {types}{f' {options.friction}' * types**2}\n"
            f"pair_style gran model mpm tangential {options.tangential} law law.h5 materials{' powder' * types} beyondRange continue {options.words}\npair_coeff * *\n")

def spheres(places, radii=None):
    return ("".join(f"create_atoms 1 single {x!r} {y!r} {z!r} units box\n" for x, y, z in places) + f"set group all diameter {2 * R!r} density {DENSITY}\n" +
            "".join(f"set atom {k} diameter {2 * r!r}\n" for k, r in enumerate(radii or (), 1)) + "fix i all nve/sphere\n")

def speed(side):
    return " ".join(f"{axis} vel {side!r}" for axis in "xyz") + " remap x units box\n"

def periodic(options, places, radii=None):
    """A deck up to its first run, the volume of the spheres and the side of the box."""
    volume = 4 * math.pi / 3 * sum(r**3 for r in radii or [R] * len(places))
    side = (volume / 0.58) ** (1 / 3)
    return (head(options, "p p p", " ".join(f"0 {side!r}" for _ in "xyz"), 1) + spheres([[x % side for x in p] for p in places], radii) +
            f"fix d all deform 1 {speed(-side * options.rate / UNIT)}compute p all pressure thermo_temp virial\n"
            f"thermo_style custom step c_p\nvariable d equal {volume!r}/vol\n"
            f'timestep {options.step * UNIT!r}\nfix out all print 5 "$(v_d) $(c_p)" file out.txt screen no title ""\n'), volume, side

def steps_to(options, density):
    return round((1 - (0.58 / density) ** (1 / 3)) / options.rate / options.step)

def packing(options):
    """Deck, and what is compared: name, column of its output, unit, column of the resolved rows."""
    text, _, _ = periodic(options, points(TOP / "examples/benchmark/bed_30.txt"))
    return text + f"run {steps_to(options, 0.985)}\n", rows(TOP / "tests/liggghts/packing_30_resolved.csv"), {"stress": ([1], options.yields, ["stress"])}

def loose_bed(options):
    """Places and radii of spheres at random that do not overlap, at a density of 0.58."""
    if options.count == 30 and not options.spread:
        return points(TOP / "examples/benchmark/bed_30.txt"), [R] * 30
    chance = np.random.default_rng(20291129)
    radii = chance.permutation(np.linspace(1 - options.spread, 1 + options.spread, options.count))
    side = (4 * math.pi / 3 * (radii**3).sum() / 0.58) ** (1 / 3)
    places, touch = side * chance.random((options.count, 3)), radii[:, None] + radii
    np.fill_diagonal(touch, 0)
    for _ in range(2000):  # overlapping pairs move apart
        push, deepest = np.zeros_like(places), 0.0
        for i, place in enumerate(places):
            way = place - places
            way -= side * np.round(way / side)
            distance = np.sqrt((way**2).sum(axis=1)) + 1e-12
            overlap = np.maximum(touch[i] * 1.001 - distance, 0)
            push[i], deepest = (way * (0.3 * overlap / distance)[:, None]).sum(axis=0), max(deepest, overlap.max())
        places += push
        if deepest < 0.001:
            break
    return (places * R).tolist(), (radii * R).tolist()

def bed(options):
    places, radii = loose_bed(options)
    text, volume, side = periodic(options, places, radii)
    pathlib.Path("bed.txt").write_text(f"# box {side!r} {side!r} {side!r}\n" + "".join(" ".join(repr(x % side) for x in p) + f" {r!r}\n" for p, r in zip(places, radii, strict=True)))
    words = ["--density", "0.948", "--unload-to", "0.02"] if options.back else ["--density", "0.98"]
    subprocess.run([options.mpm, "compact", "bed.txt", "m.toml", "--friction", str(options.friction), "--rate", str(options.rate), "--cells", str(options.cells), *words,
                    "-o", "resolved.csv", "--contacts", "contacts.csv"], check=True, capture_output=True)
    resolved = rows(pathlib.Path("resolved.csv"))
    if options.back:  # the speed turns as that of `mpm compact` does, over a strain of 0.01, and goes on at -0.2
        legs = [1 - 0.6 * (1 - math.cos(math.pi * (k + 0.5) / 20)) for k in range(20)]
        left = 0.0005 * sum(v for v in legs if v > 0)
        top = side * (0.58 / 0.948) ** (1 / 3)
        text += f"run {round((1 - top / side * (1 + left)) / options.rate / options.step)}\n"
        for v, strain in [*((v, 0.0005) for v in legs), (-0.2, 0.06)]:
            text += f"unfix d\nfix d all deform 1 {speed(-v * top * options.rate / UNIT)}run {round(strain / options.rate / options.step)}\n"
        return text, resolved, {"stress": ([1], 1.0, ["stress_Pa"])}
    kept = [row for row in resolved if round(100 * float(row["density"])) in range(63, 99, 5)]
    text += "compute l all pair/gran/local id force\n"
    for k, row in enumerate(kept):
        text += (f"run {steps_to(options, float(row['density']))} upto\ndump l all local 1 local.{k} c_l[1] c_l[2] c_l[3] c_l[4] c_l[5] c_l[6]\nrun 0\nundump l\n")
    return text + f"run {steps_to(options, 0.985)} upto\n", kept, {"stress": ([1], 1.0, ["stress_Pa"])}

def die(options):
    places = points(TOP / "tests/validation/die_30.txt")
    volume, fall = len(places) * 4 * math.pi / 3 * R**3, HEIGHT * RATE * R / UNIT
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
             f"fix go all move/mesh mesh lid linear 0 0 {-fall!r}\n" + spheres(places) +
             f"velocity all ramp vz 0.0 {-fall!r} z 0.0 {HEIGHT * R!r} units box\ntimestep {options.step * UNIT!r}\n")
    text += "".join(f"compute f{k} all reduce sum f_force_w{k}[{axis}]\n" for k, (_, _, axis) in enumerate(walls))
    text += (f"variable d equal {volume!r}/({(WIDTH * R) ** 2!r}*({HEIGHT * R!r}-step*{fall * options.step * UNIT!r}))\n"
             "thermo_style custom step c_f0 c_f1 c_f2 c_f3 c_f4 f_lid[3]\n"
             'fix out all print 5 "$(v_d) $(c_f0) $(-c_f1) $(c_f2) $(-c_f3) $(c_f4) $(f_lid[3])" file out.txt screen no title ""\n'
             f"run {round((HEIGHT - end) / HEIGHT / RATE / options.step)}\n")
    force = options.yields * R**2
    return text, rows(TOP / "docs/evidence/confined-die.csv"), {"lid": ([6], force, ["lid"]), "floor": ([5], force, ["floor"]),
                                                                "sides": ([1, 2, 3, 4], force, ["left", "right", "front", "back"])}

def say_contacts(resolved):
    """Forces of single pairs of spheres, rms of the differences over rms, and contacts of a sphere, at each density."""
    every, forces, contacts = rows(pathlib.Path("contacts.csv")), [], []
    for k, row in enumerate(resolved):
        truth, found = {}, {}
        for c in every:
            if c["density"] == row["density"]:
                pair = tuple(sorted((int(c["sphere"]), int(c["other"]))))
                truth[pair] = truth.get(pair, 0) + math.hypot(float(c["normal_N"]), float(c["tangential_N"]))
        lines = [[float(x) for x in line.split()] for line in pathlib.Path(f"local.{k}").read_text().split("ENTRIES")[-1].splitlines()[1:]]
        sizes = [math.hypot(*line[3:]) for line in lines]
        for line, size in zip(lines, sizes, strict=True):
            pair = tuple(sorted((int(line[0]), int(line[1]))))
            found[pair] = found.get(pair, 0) + size
        missed = sum((truth.get(p, 0) - found.get(p, 0)) ** 2 for p in truth | found)
        forces.append(f"{100 * math.sqrt(missed / sum(f * f for f in truth.values())):.0f}")
        spheres = max(max(p) for p in truth)
        contacts.append(f"{2 * sum(size > 1e-3 * sum(sizes) / len(sizes) for size in sizes) / spheres - float(row['coordination']):+.2f}")
    print("| forces, rms | " + " | ".join(forces) + " |\n| contacts a sphere | " + " | ".join(contacts) + " |")

def say_way_back(resolved, found):
    """Differences over the largest resolved stress."""
    turn, peak = max(range(len(found)), key=lambda k: found[k][0]), max(float(row["stress_Pa"]) for row in resolved)
    back = [row for row in resolved if row["branch"] == "unload" and float(row["stress_Pa"]) > 0.02 * peak]
    print(f"peak {100 * (max(line[1] for line in found) / peak - 1):+.1f} %\n| density on the way back | " + " | ".join(row["density"] for row in back) + " |\n| resolved, over the peak | " +
          " | ".join(f"{float(row['stress_Pa']) / peak:.3f}" for row in back) + " |\n| difference over the peak | " +
          " | ".join(f"{100 * (min(found[turn:], key=lambda line: abs(line[0] - float(row['density'])))[1] - float(row['stress_Pa'])) / peak:+.1f}" for row in back) + " |")

def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("bed", choices=("packing", "die", "bed"))
    parser.add_argument("--step", type=float, default=0.05)
    parser.add_argument("--words", default="confinement on")
    parser.add_argument("--tangential", default="history")
    parser.add_argument("--ranks", type=int, default=1)
    for name, value in {"count": 30, "spread": 0.0, "stiffness": 100.0, "friction": 0.3, "rate": RATE, "cells": 12}.items():
        parser.add_argument(f"--{name}", type=type(value), default=value)
    parser.add_argument("--back", action="store_true")
    options = parser.parse_args()
    options.yields, options.mpm = E_STAR / options.stiffness, os.environ.get("GRANULAW_MPM", "mpm")
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        pathlib.Path("m.toml").write_text(f"[material.powder]\ndensity = {DENSITY}\nyoungs_modulus = {E}\npoisson_ratio = {NU}\nyield_stress = {options.yields}\n")
        subprocess.run([options.mpm, "table", "m.toml", "--depth", "0.5", "-o", "law.h5"], check=True, capture_output=True)
        deck, resolved, compared = globals()[options.bed](options)
        pathlib.Path("in.bed").write_text(deck)
        launcher = [os.environ.get("GRANULAW_LAUNCHER", "liggghts-mpm"), "-in", "in.bed", "-log", "none"]
        done = subprocess.run((["mpirun", "-np", str(options.ranks)] if options.ranks > 1 else []) + launcher, capture_output=True, text=True, errors="replace")
        if done.returncode:
            raise SystemExit(f"confined_beds.py: LIGGGHTS stopped:\n{done.stdout[-1500:]}{done.stderr[-500:]}")
        found = [[float(x) for x in line.split()] for line in pathlib.Path("out.txt").read_text().splitlines() if line.strip()]
        if options.back:
            return say_way_back(resolved, found)
        print("| density | " + " | ".join(f"{float(row['density']):.2f}" for row in resolved) + " |")
        for name, (columns, unit, truth) in compared.items():
            cells = []
            for row in resolved:
                window = [sum(line[c] for c in columns) for line in found if abs(line[0] - float(row["density"])) <= 0.005]
                cells.append(f"{100 * (sum(window) / len(window) / unit / sum(float(row[c]) for c in truth) - 1):+.1f}" if window else "-")
            print(f"| {name} | " + " | ".join(cells) + " |")
        if options.bed == "bed":
            say_contacts(resolved)

if __name__ == "__main__":
    main()
