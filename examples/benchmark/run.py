#!/usr/bin/python3
"""Answers of LIGGGHTS's and LAMMPS's contact models to the benchmark: answers/CODE.csv.

    run.py [-o out/benchmark] [CODE ...]

Codes: liggghts-mpm, lammps-granulaw, liggghts-hertz, liggghts-thornton_ning, liggghts-hooke_hysteresis. Programs are those on the PATH, or of build/release."""
import argparse
import csv
import math
import os
import pathlib
import shutil
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "common"))
import one_sentence  # noqa: E402, F401

HERE = pathlib.Path(__file__).resolve().parent
MATERIALS = {"wax": (920.0, 91e6, 0.3, 1e6), "hard_wax": (920.0, 91e6, 0.3, 1e6), "resin": (1200.0, 500e6, 0.3, 20e6)}  # density, E, nu, Y
R, SMALL, RIGID, FRICTION = 3e-3, 1.2e-3, 1e16, 0.3
SPEEDS, DEPTHS, DENSITIES = (0.05, 0.2, 0.5, 1.0, 2.0), (0.02, 0.05, 0.1), (0.63, 0.68, 0.73, 0.78)
OBLIQUE_SPEED = 1.666  # 100 V_y of wax, m/s
# What the models without a material's law are fitted to: e = 0.591 at 1 m/s, head-on
E_FITTED = 0.591


def program(name, folder):
    found = shutil.which(name) or str(HERE.parents[1] / "build/release" / folder / name)
    if not os.access(found, os.X_OK):
        sys.exit(f"run.py: no {name}: build it")
    return found


class Code:
    """Decks of one code and contact model. Types: the spheres' materials; in LIGGGHTS one more, the wall's, rigid."""

    def __init__(self, name, folder):
        self.name, self.folder = name, folder
        self.lammps = name == "lammps-granulaw"
        self.model = name.split("-")[1]

    def head(self, boundary, box):
        style = "sphere\ncomm_modify mode single vel yes" if self.lammps else "granular\nhard_particles yes\ncommunicate single vel yes"
        return f"units si\natom_style {style}\natom_modify map array\nboundary {boundary}\nnewton off\n{box}\nneighbor 0.0004 bin\nneigh_modify delay 0\n"

    def law(self, materials, friction):
        if self.lammps:
            return (f"pair_style granulaw {self.folder}/bench.h5 friction {friction!r} tangential plastic beyond continue\npair_coeff * * {' '.join(materials)} {materials[0]}\n")
        n = len(materials) + 1
        moduli = [MATERIALS[m][1] for m in materials] + [RIGID]
        text = f"fix p1 all property/global youngsModulus peratomtype {' '.join(map(repr, moduli))}\nfix p2 all property/global poissonsRatio peratomtype {' '.join(['0.3'] * n)}\n"
        matrices = {"coefficientFriction": friction}
        if self.model != "mpm":
            matrices["coefficientRestitution"] = {"hertz": E_FITTED}.get(self.model, 0.9999)
        if self.model == "thornton_ning":  # radius at yield over R*, of pressure 1.6 Y; no surface energy
            matrices["surfaceEnergy"] = 0.0
            text += f"fix py all property/global coefficientYieldRatio peratomtype {' '.join([repr(math.pi * 1.6 * 1e6 / (2 * 91e6 / 0.91))] * n)}\n"
        if self.model == "hooke_hysteresis":  # e^2 = k1/k2; k2 grows with the largest overlap, and is k1/E_FITTED^2 at that of 1 m/s
            most, e_star, mass = 5.0, 91e6 / 0.91, 4 / 3 * math.pi * R**3 * MATERIALS["wax"][0]
            k1 = 16 / 15 * math.sqrt(R) * e_star * (15 * mass / (16 * math.sqrt(R) * e_star))**0.2
            depth = math.sqrt(mass / k1) * (most - 1)**2 / (1 / E_FITTED**2 - 1) / (2 * R * most)
            matrices |= {"coefficientMaxElasticStiffness": most, "coefficientAdhesionStiffness": 0.0, "coefficientPlasticityDepth": depth}
            text += "fix pc all property/global characteristicVelocity scalar 1.0\n"
        text += "".join(f"fix q{k} all property/global {name} peratomtypepair {n} {' '.join([repr(value)] * n * n)}\n" for k, (name, value) in enumerate(matrices.items()))
        own = f"law {self.folder}/bench.h5 materials {' '.join(materials)} elastic elasticDamping 0.001 beyondRange continue" if self.model == "mpm" else ""
        return text + f"pair_style gran {self.style()} {own}\npair_coeff * *\n"

    def style(self):
        return f"model {self.model.replace('_', '/', self.model.startswith('hooke'))} tangential {'plastic' if self.model == 'mpm' else 'history'}"

    def wall(self, types):
        return "fix w all wall/granulaw zplane 0.0 NULL\n" if self.lammps else f"fix w all wall/gran {self.style()} primitive type {types} zplane 0.0\n"

    def run(self, name, text):
        (self.folder / f"in.{name}").write_text(text)
        command = [program("lmp-granulaw", "engines/lammps") if self.lammps else program("liggghts-mpm", "liggghts_plugin"), "-in", f"in.{name}", "-log", f"log.{name}"]
        done = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, check=False)
        if done.returncode:
            sys.exit(f"run.py: {self.name} {name}: " + "; ".join(line for line in (done.stdout + done.stderr).splitlines() if "ERROR" in line)[:600])
        return done.stdout

    def rows(self, name, text, steps, columns="id vx vz fz omegay z"):
        """Columns of each atom in each step."""
        line = "format line" if self.lammps else "format"
        text += f'dump d all custom 1 {name}.dump {columns}\ndump_modify d sort id {line} "%d{" %.12g" * (len(columns.split()) - 1)}"\nrun {steps}\n'
        self.run(name, text)
        found, lines = {}, (self.folder / f"{name}.dump").read_text().splitlines()
        for words in map(str.split, lines):
            if len(words) == len(columns.split()) and words[0].isdigit():
                found.setdefault(int(words[0]), []).append([float(w) for w in words[1:]])
        (self.folder / f"{name}.dump").unlink()
        return found

    def box(self, types):
        return f"region box block -0.02 0.02 -0.02 0.02 -0.02 0.02 units box\ncreate_box {types} box"

    def sphere(self, number, kind, radius, material, z, v):
        return (f"create_atoms {kind} single 0 0 {z!r} units box\nset atom {number} diameter {2 * radius!r}\nset atom {number} density {MATERIALS[material][0]!r}\n"
                f"group g{number} id {number}\nvelocity g{number} set {' '.join(map(repr, v))} units box\n")

    def impact(self, name, v, material="wax", partner=None, radius=R, partner_radius=R, tangential=0.0, friction=0.0):
        """e and the largest force, N; of oblique impacts the tangential velocity over that before, and the spin R omega/V_n."""
        dt = 1e-7 * min(radius, partner_radius) / R
        materials = [material] if partner in (None, material) else [material, partner]
        text = self.head("f f f", self.box(len(materials) + 1))
        wall = partner is None
        text += self.sphere(1, 1, radius, material, radius + 0.5 * dt * v if wall else radius + partner_radius + 0.5 * dt * v, (tangential, 0.0, -v))
        text += "" if wall else self.sphere(2, len(materials), partner_radius, partner, 0.0, (0.0, 0.0, 0.0))
        text += self.law(materials, friction) + (self.wall(len(materials) + 1) if wall else "") + f"fix i all nve/sphere\ntimestep {dt!r}\n"
        found = self.rows(name, text, 8000)
        vx, vz, _, omega, _ = found[1][-1]
        answer = {"e": (vz - (0 if wall else found[2][-1][1])) / v, "force_max": max(abs(row[2]) for row in found[1])}
        return {"e": answer["e"], "tangential_velocity_kept": vx / tangential, "spin": radius * omega / v} if tangential else answer

    def press(self):
        """Force at DEPTHS and the overlap over R where a slow press lets go."""
        speed, dt = 0.01, 1e-6
        text = self.head("f f f", self.box(2)) + self.sphere(1, 1, R, "wax", R + 0.5 * speed * dt, (0.0, 0.0, 0.0)) + self.law(["wax"], 0.0) + self.wall(2) + f"timestep {dt!r}\n"
        down = round(0.1 * R / speed / dt)
        text += f"fix m all move linear 0 0 {-speed!r} units box\nrun 0\n"
        loading = self.rows("press", text, down + 1)[1]
        unloading = self.rows("press", text + f"run {down}\nunfix m\nfix m all move linear 0 0 {speed!r} units box\n", down)[1]
        found = {("force", d): min(loading, key=lambda row: abs((R - row[4]) / R - d))[2] for d in DEPTHS}
        found["residual_overlap", 0.1] = max((R - row[4]) / R for row in unloading if row[2] < 1e-4 * loading[-1][2])
        return found

    def bed(self):
        """Mean stress over Y of 30 spheres pressed from all sides at a rate of 0.001 c*/R, at DENSITIES."""
        density, young, nu, yields = MATERIALS["wax"]
        points = [[float(x) for x in line.split()] for line in (HERE / "bed_30.txt").read_text().splitlines()]
        side, rate, dt = (len(points) * 4 * math.pi / 3 / 0.58)**(1 / 3) * R, 0.001 * math.sqrt(young / (1 - nu**2) / density) / R, 1e-7
        points = [[x * R % side for x in point] for point in points]
        text = self.head("p p p", f"region box block 0 {side!r} 0 {side!r} 0 {side!r} units box\ncreate_box 2 box").replace("neighbor 0.0004", "neighbor 0.001") + self.law(["wax"], FRICTION)
        text += "".join(f"create_atoms 1 single {' '.join(map(repr, p))} units box\n" for p in points) + f"set group all diameter {2 * R!r}\nset group all density {density!r}\n"
        text += "".join(f"group g id {k}\nvelocity g set {' '.join(repr(-rate * (x - side / 2)) for x in p)} units box\ngroup g delete\n" for k, p in enumerate(points, 1))
        text += "fix i all nve/sphere\nfix d all deform 1 " + " ".join(f"{a} vel {-rate * side!r}" for a in "xyz") + " remap v units box\n"
        text += f"compute p all pressure thermo_temp virial\nvariable p equal c_p\ntimestep {dt!r}\nthermo_style custom step v_p\nthermo 100000\n"
        steps = [round((1 - (0.58 / d)**(1 / 3)) / rate / dt) for d in DENSITIES]
        for step, before in zip(steps, [0, *steps]):
            text += f'run {step - before}\nprint "PRESSURE ${{p}}"\n'
        pressures = [float(line.split()[1]) for line in self.run("bed", text).splitlines() if line.startswith("PRESSURE")]
        return {("stress_over_Y", d): p / yields for d, p in zip(DENSITIES, pressures)}


def answers(code):
    found = {}
    for v in SPEEDS:
        found |= {("head_on", q, v): x for q, x in code.impact(f"head_{v}", v).items()}
    others = {"like_pair": dict(v=2.0, partner="wax"), "sizes": dict(v=1.0, partner="wax", partner_radius=SMALL)}
    if code.model in ("mpm", "granulaw", "hertz"):  # the other models have one number for all materials
        others |= {"unlike_pair": dict(v=1.0, partner="resin"), "hardening": dict(v=1.0, material="hard_wax")}
    for case, how in others.items():
        found |= {(case, q, how["v"]): x for q, x in code.impact(case, **how).items()}
    for angle in (20, 60):
        tangential = OBLIQUE_SPEED * math.tan(math.radians(angle))
        found |= {(f"oblique_{angle}", q, angle): x for q, x in code.impact(f"oblique_{angle}", OBLIQUE_SPEED, tangential=tangential, friction=FRICTION).items()}
    press = code.press()
    found |= {("press", q, at): x for (q, at), x in press.items()}
    # contacts of one sphere are independent in these codes: the force on each of six planes is that of one
    found |= {("six_planes", q, at): x for (q, at), x in press.items() if q == "force"}
    return found | {("bed", q, at): x for (q, at), x in code.bed().items()}


def main(argv=None):
    names = ("liggghts-mpm", "lammps-granulaw", "liggghts-hertz", "liggghts-thornton_ning", "liggghts-hooke_hysteresis")
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("codes", nargs="*", metavar="CODE", default=names)
    parser.add_argument("-o", "--out", default="out/benchmark")
    args = parser.parse_args(argv)
    if unknown := set(args.codes) - set(names):
        sys.exit(f"run.py: no code {', '.join(unknown)}: allowed is {', '.join(names)}")
    folder = pathlib.Path(args.out).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    subprocess.run([program("mpm", "tools/mpm"), "table", HERE / "materials.toml", "-o", "bench.h5"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    for name in args.codes:
        with open(folder / f"{name}.csv", "w", newline="", encoding="utf-8") as file:
            rows = csv.writer(file, lineterminator="\n")
            rows.writerow(("case", "quantity", "at", "value"))
            rows.writerows((case, quantity, f"{at:g}", f"{value:.6g}") for (case, quantity, at), value in answers(Code(name, folder)).items())
        print(folder / f"{name}.csv")


if __name__ == "__main__":
    main()
