"""A small battery of commands whose numbers show if a fault changes any result: sound and faulty outputs are compared.

Times, rates, hashes and paths are left out; numbers may differ by a relative 1e-9 (rounding of sums in another order).
"""
import json
import math
import re
import shutil
import subprocess

import h5py
import numpy as np

ROUNDING = 1e-9
LIMIT = 120.0  # s a command; all of them take about a minute
IGNORED = ("cpu_s", "point_updates_per_s", "seconds", "loop_time_s", "version", "git_hash", "solver_id", "time_s_wall")

MATERIALS = """
[material.powder]
density = 1500
youngs_modulus = 2.73e9
poisson_ratio = 0.3
yield_stress = 100e6
[material.hard]
density = 1700
youngs_modulus = 4e9
poisson_ratio = 0.25
yield_stress = 90e6
hardening = {law = "linear", modulus = 1e8}
[material.voce]
density = 1500
youngs_modulus = 9.1e9
poisson_ratio = 0.3
yield_stress = 100e6
hardening = {law = "voce", saturation_stress = 1.5e8, strain = 0.1}
rate = {law = "cowper-symonds", reference_rate = 40, exponent = 5}
[material.swift]
density = 1500
youngs_modulus = 9.1e9
poisson_ratio = 0.3
yield_stress = 1e8
hardening = {law = "tabulated", strain = [0, 0.1, 0.5], stress = [1e8, 1.4e8, 1.6e8]}
rate = {law = "johnson-cook", coefficient = 0.03, reference_rate = 1}
[material.glass]
density = 2500
youngs_modulus = 70e9
poisson_ratio = 0.22
[particle.grain]
radius = 2e-3
material = "powder"
[particle.small]
radius = 1e-3
material = "hard"
[particle.rated]
radius = 2e-3
material = "voce"
[particle.table]
radius = 2e-3
material = "swift"
[particle.bead]
radius = 2e-3
material = "glass"
[particle.coated]
radius = 2e-3
material = "powder"
layers = [{material = "hard", thickness = 2e-4}]
[particle.porous]
radius = 2e-3
material = "powder"
inclusions = [{pore = true, radius = 2e-4, z = 1e-3}, {material = "glass", radius = 2e-4, z = 2.5e-3}]
[particle.egg]
radius = 2e-3
material = "powder"
profile = {shape = "ellipsoid", aspect = 1.5}
"""

# A scene that the deck reader has to follow: regions, templates, insertion, gravity, a mesh, a loop, formulas.
SCENE = """units si
atom_style granular
boundary f f f
newton off
communicate single vel yes
variable h equal 0.04
variable n loop 2
variable speed equal sqrt(2*9.81*${h})+abs(-0.1)
if "${h} > 0.03" then "variable wide equal 0.02" else "variable wide equal 0.01"
region box block -0.05 0.05 -0.05 0.05 -0.01 0.12 units box
create_box 2 box
neighbor 0.002 bin
hard_particles yes
fix m1 all property/global youngsModulus peratomtype 2.73e9 70e9
fix m2 all property/global poissonsRatio peratomtype 0.3 0.22
fix m3 all property/global coefficientRestitution peratomtypepair 2 0.5 0.5 0.5 0.5
fix m4 all property/global coefficientFriction peratomtypepair 2 0.3 0.3 0.3 0.3
pair_style gran model hertz tangential history
pair_coeff * *
fix g all gravity 9.81 vector 0.0 0.1 -1.0
fix w1 all wall/gran model hertz tangential history primitive type 2 zplane 0.0
fix w2 all wall/gran model hertz tangential history primitive type 2 zcylinder 0.03 0.0 0.0
fix cad all mesh/surface file plate.stl type 2 scale 1.5 rotate axis 0 1 0 angle 30
fix w3 all wall/gran model hertz tangential history mesh n_meshes 1 meshes cad
fix t1 all particletemplate/sphere 15485863 atom_type 1 density constant 1500 radius constant 0.001
fix t2 all particletemplate/sphere 15485867 atom_type 1 density constant 1700 radius constant 0.0015
fix d1 all particledistribution/discrete 32452843 2 t1 0.4 t2 0.6
region fill cylinder z 0 0 ${wide} 0.05 0.09 units box
fix ins all insert/pack seed 32452867 distributiontemplate d1 vel constant 0. 0. -${speed} insert_every once overlapcheck yes all_in yes particles_in_region 200 region fill
fix i all nve/sphere
timestep 1e-6
run 1000
label again
run 500
next n
jump SELF again
"""
PLATE = """solid plate
facet normal 0 0 1
outer loop
vertex -0.01 -0.01 0.02
vertex 0.01 -0.01 0.02
vertex 0.01 0.01 0.02
endloop
endfacet
facet normal 0 0 1
outer loop
vertex -0.01 -0.01 0.02
vertex 0.01 0.01 0.02
vertex -0.01 0.01 0.02
endloop
endfacet
endsolid plate
"""
GAS = """units si
hard_particles yes
atom_style granular
atom_modify map array sort 0 0
boundary f f f
newton off
communicate single vel yes
region box block -0.02 0.02 -0.02 0.02 -0.001 0.04 units box
create_box 2 box
neighbor 0.0004 bin
neigh_modify delay 0
fix p1 all property/global youngsModulus peratomtype 2.73e9 2.73e9
fix p2 all property/global poissonsRatio peratomtype 0.3 0.3
fix p3 all property/global yieldStress peratomtype 1e8 1e8
fix p4 all property/global coefficientFriction peratomtypepair 2 0.3 0.3 0.3 0.3
fix p5 all property/global coefficientRollingFriction peratomtypepair 2 0.1 0.1 0.1 0.1
pair_style gran model ${model} tangential history WORDS stats s.json
pair_coeff * *
fix w1 all wall/gran model ${model} tangential history primitive type 1 zplane 0.0
fix cad all mesh/surface file plate.stl type 1
fix w2 all wall/gran model ${model} tangential history mesh n_meshes 1 meshes cad
fix g all gravity 9.81 vector 0.0 0.0 -1.0
"""


GASES = {"mpm": "law law.h5 materials powder powder tangentialDampingRatio 0 contactMap on", "thornton": "contactMap on",
         "stretch": "law law.h5 materials powder powder stretch 2 elasticDamping 0.1"}


def gas(name):
    """Three layers of spheres, of two radii, thrown at each other, a floor and a plate."""
    model = "thornton" if name == "thornton" else "mpm"
    text, k = GAS.replace("${model}", model).replace("WORDS", GASES[name]), 0
    for layer, (z, speed) in enumerate(((0.00205, -1.5), (0.006, -6.0), (0.0105, -9.0), (0.0245, -4.0))):
        for x in range(3):
            for y in range(3):
                k += 1
                text += (f"create_atoms {1 + (x + layer) % 2} single {0.0045 * (x - 1) + 2e-4 * layer:.6g} {0.0045 * (y - 1) - 3e-4 * layer:.6g} {z:.6g} units box\n"
                         f"group a{k} id {k}\nset group a{k} diameter {4e-3 if (x + y) % 2 else 3e-3} density 1500\n"
                         f"velocity a{k} set {0.3 * (y - 1):.6g} {-0.2 * (x - 1):.6g} {speed}\ngroup a{k} delete\n")
    return text + ("fix i all nve/sphere\ntimestep 1e-7\ncompute rot all erotate/sphere\n"
                   "thermo_style custom step atoms ke c_rot f_granulaw f_granulaw[1] f_granulaw[2] f_granulaw[3] f_granulaw[4] f_granulaw[5] f_granulaw[6] f_granulaw[7]\n"
                   "thermo 2000\nthermo_modify norm no lost error format float %.12g\nrun 6000\n"
                   "dump d all custom 1 end.txt id x y z vx vy vz fx fy fz omegax omegay omegaz\n"
                   "dump_modify d sort id format \"%d %.12g %.12g %.12g %.12g %.12g %.12g %.12g %.12g %.12g %.12g %.12g %.12g\"\nrun 0\n")


RUNS = "--resolution 8 --phases 2 --json"
BY_RUNS = "--no-atlas --depth 0.05 --inertia 0.01 --jobs 1 --cache runs"
COMMANDS = {
    "impact": f"mpm impact m.toml --particle grain --velocity 2.6 {RUNS} -o t.csv --fields f.xdmf --frames 4",
    "impact, two bodies": f"mpm impact m.toml --particle grain --against small --velocity 2 {RUNS} --no-estimate -o t.csv",
    "impact, wall": f"mpm impact m.toml --particle grain --wall hard --velocity 2 {RUNS} --no-estimate",
    "impact, layers": f"mpm impact m.toml --particle coated --velocity 2 {RUNS} --no-estimate",
    "impact, inclusions": f"mpm impact m.toml --particle porous --velocity 2 {RUNS} --no-estimate",
    "impact, shape": f"mpm impact m.toml --particle egg --velocity 2 {RUNS} --no-estimate",
    "impact, updated": f"mpm impact m.toml --particle grain --velocity 2 {RUNS} --grid updated --no-estimate",
    "impact, rate": f"mpm impact m.toml --particle rated --velocity 2 {RUNS} --no-estimate",
    "impact, single": f"mpm impact m.toml --particle table --velocity 2 {RUNS} --precision single",
    "impact, elastic": f"mpm impact m.toml --particle bead --velocity 2 {RUNS}",
    "impact, tolerance": "mpm impact m.toml --particle grain --velocity 2.6 --tolerance 0.05 --json",
    "press": f"mpm press m.toml --particle small --depth 0.03 {RUNS} -o t.csv --fields f.xdmf --frames 4",
    "press, midplane": f"mpm press m.toml --particle coated --depth 0.03 --support midplane {RUNS} --no-estimate",
    "table": "mpm table m.toml --pair powder:wall --pair powder:powder --pair powder:hard --pair hard:glass -o law.h5",
    "info": "mpm info law.h5",
    "export": "mpm export law.h5 -o t.csv --points 60",
    "export, speed": "mpm export law.h5 -o t.csv --points 60 --pair powder:wall --speed 10 --effective-radius 2e-3",
    "law, slow": "mpm law law.h5 --pair powder:wall --velocity 0.2 --radius 2e-3 --json",
    "law, fast": "mpm law law.h5 --pair powder:powder --velocity 30 --radius 2e-3 --radius2 1e-3 --json",
    "law, unlike": "mpm law law.h5 --pair powder:hard --velocity 8 --radius 2e-3 --radius2 1e-3 --json",
    "law, glass": "mpm law law.h5 --pair hard:glass --velocity 8 --radius 1e-3",
    "table, runs": f"mpm table m.toml {BY_RUNS} --pair powder:wall -o runs.h5",
    "info, runs": "mpm info runs.h5",
    "export, runs": "mpm export runs.h5 -o t.csv --points 60 --speed 3",
    "check": "mpm check law.h5 --impacts 2 --seed 3",
    "plan": "mpm plan in.scene --materials-file m.toml --materials powder glass --json",
    "plan, words": "mpm plan in.scene --materials-file m.toml --materials powder glass",
    "soften": "mpm stretch in.scene --materials-file m.toml --materials powder glass --json",
    "table, deck": "mpm table m.toml --deck in.scene --materials powder glass -o deck.h5",
    "info, deck": "mpm info deck.h5",
    "refused": "mpm impact m.toml --particle gran --velocity 1",
    "fixture": "law_fixture mpm law.h5 powder hard 1e-3 1e-5 3",
    "thornton": "law_fixture thornton 3e9 1.6e8 1e-3 1e-5 3",
    **{f"liggghts {name}": f"liggghts-mpm -in in.{name}" for name in GASES},
}
# Names of the commands whose programs hold the code of a folder (and of those that make their files).
OF = {
    "mpm_core/solver": "impact|press",
    "mpm_core/contact": "table$|info$|export$|export, speed|law|fixture|thornton|liggghts|.*deck",
    "mpm_core/law": "table$|info$|export$|export, speed|law|fixture|thornton|liggghts|.*deck",
    "mpm_core/characterise": "table|info|export|law",
    "liggghts_plugin": "table$|liggghts",
    "tools/deck": "plan|soften|.*deck",
    "tools/mpm": "(?!.*runs|impact, updated|impact, tolerance)",
}
def plain(value):
    """JSON without what time or the build decides."""
    if isinstance(value, dict):
        return {k: plain(v) for k, v in value.items() if k not in IGNORED}
    return [plain(v) for v in value] if isinstance(value, list) else value


def told(text):
    """Lines that depend on the run's numbers alone."""
    try:
        return json.dumps(plain(json.loads(text)), indent=0)
    except ValueError:
        pass
    lines, keep = [], not re.search(r"^LIGGGHTS|^Loop time", text, re.M)
    for line in text.splitlines():
        if re.match(r"\s*Step\b", line):
            keep = True  # LIGGGHTS: only the table of the run
        elif line.startswith("Loop time"):
            keep = False
        if keep and not re.search(r"CPU|\bcommit\b|version|\d s\b|hash|solver|built|date|created|checksum|cpu_s|ranks", line):
            lines.append(line)
    return "\n".join(lines)


def run(tools, folder, env, say, of=""):
    """Output of each command whose name begins so (a pattern): printed and written. `tools`: {program: path}."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / "m.toml").write_text(MATERIALS)
    (folder / "in.scene").write_text(SCENE)
    (folder / "plate.stl").write_text(PLATE)
    for name in GASES:
        (folder / f"in.{name}").write_text(gas(name))
    found = {}
    chosen = {name: command for name, command in COMMANDS.items() if re.match(of, name)}
    for k, (name, command) in enumerate(chosen.items()):
        say(f"battery: {k + 1} of {len(chosen)}, {name}")
        program, *words = command.split()
        try:
            done = subprocess.run([tools[program], *words], cwd=folder, env=env, capture_output=True, text=True, errors="replace",
                                  stdin=subprocess.DEVNULL, timeout=LIMIT)
            text = f"exit {done.returncode}\n" + told(done.stdout) + "\n" + told(done.stderr)
        except subprocess.TimeoutExpired:
            text = "no end"
        for output in ("t.csv", "s.json", "end.txt"):
            if (folder / output).exists():
                text += f"\n{output}\n" + told((folder / output).read_text(errors="replace"))
                (folder / output).unlink()
        if (folder / "f.h5").exists():
            text += "\nf.h5\n" + fields(folder / "f.h5")
            (folder / "f.h5").unlink()
        found[name] = text
    return found


def fields(path):
    """Sums over every array of a file of fields."""
    lines = []

    def add(name, data):
        if isinstance(data, h5py.Dataset):
            values = data[...].astype(float)
            lines.append(f"{name} {data.shape} {np.abs(values).sum()} {values.sum()}")
    try:
        with h5py.File(path) as file:
            file.visititems(add)
    except (OSError, ValueError):
        lines.append("cannot be read")
    return "\n".join(lines)


def differing(sound, faulty):
    """Names of the commands whose numbers or words differ."""
    return [name for name in faulty if not alike(sound[name], faulty[name])]


def alike(a, b):
    if a == b:
        return True
    one, two = (re.split(r"[\s,:;\"=\[\]{}()]+", t) for t in (a, b))
    return len(one) == len(two) and all(x == y or close(x, y) for x, y in zip(one, two))


def close(x, y):
    try:
        return math.isclose(float(x), float(y), rel_tol=ROUNDING, abs_tol=1e-300)
    except ValueError:
        return False
