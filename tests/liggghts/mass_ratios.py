"""Granules and balls of up to 1000 times their mass, in twelve flows: the decks, and what `mpm plan` allowed beside what the runs visited.

    mass_ratios.py FOLDER [FLOW ...]        # the table of all flows, or of these"""
import json
import math
import pathlib
import sys

from programs import LAUNCHER, material, mpm, run

DENSITY, GRANULE = 1500.0, 0.5e-3  # kg/m^3; m, radius of the small ones
YOUNG, YIELD = 2e8, 2e6
MATERIALS = material("granule", DENSITY, YOUNG, 0.3, YIELD) + material("ball", DENSITY, 2e9, 0.3, 3e7)
DT = 1e-6
PRIMES = (15485863, 15485867, 32452843, 32452867, 49979687, 49979693)
SEEDS = (67867967, 86028121, 104395301)  # of three runs of each flow: another packing


def stl(*squares):
    """Two triangles for each four corners."""
    text = "solid s\n"
    for a, b, c, d in squares:
        for corners in ((a, b, c), (a, c, d)):
            text += "facet normal 0 0 1\nouter loop\n" + "".join("vertex {:.9g} {:.9g} {:.9g}\n".format(*p) for p in corners) + "endloop\nendfacet\n"
    return text + "endsolid s\n"


def plate(half, z, x=0.0):
    return stl([(x - half, -half, z), (x + half, -half, z), (x + half, half, z), (x - half, half, z)])


def open_box(half, height, low=0.0):
    c = [(-half, -half), (half, -half), (half, half), (-half, half)]
    sides = [[(*c[k], low), (*c[(k + 1) % 4], low), (*c[(k + 1) % 4], height), (*c[k], height)] for k in range(4)]
    return stl([(*p, low) for p in c], *sides)


def ring(radius, low, high, facets=24, radius_low=None, axis="z"):
    """A cylinder or cone about `axis`, from `low` to `high`."""
    bottom = radius if radius_low is None else radius_low
    def at(k, r, z):
        x, y = r * math.cos(2 * math.pi * k / facets), r * math.sin(2 * math.pi * k / facets)
        return (x, y, z) if axis == "z" else (x, z, y)
    return stl(*([at(k, bottom, low), at(k + 1, bottom, low), at(k + 1, radius, high), at(k, radius, high)] for k in range(facets)))


class Flow:
    """`balls` of `ratio` times the granules' radius among `granules` of them in the box `region` (x, y, z ranges, m)."""

    def __init__(self, name, seconds, ratio, granules, balls, region, walls, half=(0.03, 0.03), height=0.12, boundary="f f f", gravity="0 0 -1", low=-0.01, meshes=(), motion="",
                 fast=0.0, ball_region=None, more=""):
        self.__dict__.update({k: v for k, v in locals().items() if k != "self"})

    def insertion(self, number, region, speed, **counts):
        """One fix for both kinds where they share a region: two do not check their spheres against each other."""
        spheres = [(kind, radius, count) for kind, radius, count in ((1, GRANULE, counts.get("granules", 0)), (2, self.ratio * GRANULE, counts.get("balls", 0))) if count]
        total = sum(count * radius**3 for _, radius, count in spheres)
        shares = " ".join(f"t{number}{kind} {count * radius**3 / total!r}" for kind, radius, count in spheres)
        box = " ".join(f"{v:.6g}" for pair in region for v in pair)
        return (f"region r{number} block {box} units box\n" +
                "".join(f"fix t{number}{kind} all particletemplate/sphere {PRIMES[number + kind]} atom_type {kind} density constant {DENSITY} radius constant {radius}\n"
                        for kind, radius, _ in spheres) +
                f"fix d{number} all particledistribution/discrete {PRIMES[number]} {len(spheres)} {shares}\n"
                f"fix i{number} all insert/pack seed ${{seed}} distributiontemplate d{number} vel constant 0 0 {-speed} insert_every once overlapcheck yes all_in yes "
                f"particles_in_region {sum(count for *_, count in spheres)} region r{number} ntry_mc 10000\n")

    def text(self):
        (hx, hy), moduli = self.half, (YOUNG, 2e9, 210e9)
        text = (f"variable seed index {SEEDS[0]}\nunits si\nhard_particles yes\natom_style granular\natom_modify map array\nboundary {self.boundary}\nnewton off\ncommunicate single vel yes\n"
                f"region box block {-hx} {hx} {-hy} {hy} {self.low} {self.height} units box\ncreate_box 3 box\nneighbor {0.5 * GRANULE} bin\nneigh_modify delay 0\n"
                f"fix m1 all property/global youngsModulus peratomtype {' '.join(map(str, moduli))}\nfix m2 all property/global poissonsRatio peratomtype 0.3 0.3 0.3\n"
                f"fix m4 all property/global coefficientFriction peratomtypepair 3 {' '.join(['0.4'] * 9)}\n"
                "pair_style gran model mpm tangential history law law.h5 materials granule ball steel stats stats.json beyondRange stop\npair_coeff * *\n"
                f"timestep {DT}\nfix g all gravity 9.81 vector {self.gravity}\nfix move all nve/sphere\n")
        names = [name for name, _ in self.meshes]
        for name in names:
            text += f"fix {name} all mesh/surface file {name}.stl type 3\n"
        if names:
            text += f"fix meshes all wall/gran model mpm tangential history mesh n_meshes {len(names)} meshes {' '.join(names)}\n"
        for k, wall in enumerate(self.walls):
            text += f"fix w{k} all wall/gran model mpm tangential history primitive type 3 {wall}\n"
        text += self.motion
        if self.ball_region:
            text += self.insertion(0, self.ball_region, self.fast, balls=self.balls) + self.insertion(3, self.region, 0.0, granules=self.granules)
        else:
            text += self.insertion(0, self.region, 0.0, granules=self.granules, balls=self.balls)
        steps = round(self.seconds / DT)
        return text + f"thermo {steps // 4}\nthermo_style custom step atoms ke\n" + self.more + f"run {steps}\n"

    def write(self, folder):
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "materials.toml").write_text(MATERIALS)
        (folder / "in.flow").write_text(self.text())
        for name, text in self.meshes:
            (folder / f"{name}.stl").write_text(text)

    def run(self, folder, seeds=SEEDS):
        """[Compared]: as planned, as `mpm table --deck` made it, and as the runs went under `beyondRange stop`, which must all end."""
        self.write(folder)
        plan = json.loads(mpm("plan", "in.flow", "--materials-file", "materials.toml", "--json", cwd=folder).stdout)
        mpm("table", "materials.toml", "--deck", "in.flow", "-o", "law.h5", cwd=folder)
        runs = []
        for seed in seeds:
            run(LAUNCHER, "-in", "in.flow", "-var", "seed", seed, cwd=folder, timeout=3000)
            runs.append(json.loads((folder / "stats.json").read_text()))
        return [c for c in (Compared(p, runs) for p in plan["pairs"]) if c.contacts]


class Compared:
    """A pair of types as it was planned, and the largest that its contacts visited in any of the runs."""

    def __init__(self, planned, runs):
        self.name = ("{}:wall" if planned["wall"] else "{}:{}").format(*planned["types"])
        found = [s for run in runs for s in run["pairs"] if s["types"] == planned["types"] and ("wall" in s["kind"]) == planned["wall"]]
        self.contacts = sum(s["contacts_begun"] for s in found)
        keys = (("speed_max_m_per_s", "impact_speed_max_m_per_s"), ("overlap_over_radius_max", "overlap_over_radius_max"))
        self.speed, self.overlap = ((planned[key], max(s[visited] for s in found)) for key, visited in keys)

    def row(self):
        (v, seen_v), (d, seen_d) = self.speed, self.overlap
        return f"{self.name:<8} {v:9.3g} {seen_v:8.3g} {v / seen_v:6.2f}   {d:12.3g} {seen_d:8.3g} {d / seen_d:6.2f} {self.contacts:9.0f}"


SIDES = ("xplane -0.011", "xplane 0.011", "yplane -0.011", "yplane 0.011")
BED = ((-0.0105, 0.0105), (-0.0105, 0.0105), (0.001, 0.02))
SMALL = 0.012, 0.012
FLOWS = [
    Flow("vibrated plate", 0.35, 10, 700, 10, ((-0.0125, 0.0125), (-0.0125, 0.0125), (0.001, 0.04)), ("xplane -0.013", "xplane 0.013", "yplane -0.013", "yplane 0.013"), (0.014, 0.014),
         meshes=[("plate", plate(0.014, 0.0))], motion="fix shake all move/mesh mesh plate wiggle amplitude 0 0 0.0005 period 0.02\n"),
    Flow("vibrated box", 0.2, 4, 500, 20, BED, (), (0.014, 0.014), meshes=[("tub", open_box(0.011, 0.08))],
         motion="fix shake all move/mesh mesh tub wiggle amplitude 0 0 0.001 period 0.0125\n"),
    Flow("dropped", 0.2, 7, 500, 12, ((-0.0105, 0.0105), (-0.0105, 0.0105), (0.02, 0.08)), (*SIDES, "zplane 0.0"), SMALL),
    Flow("intruder", 0.12, 10, 700, 1, BED, (*SIDES, "zplane 0.0"), SMALL, ball_region=((-0.006, 0.006), (-0.006, 0.006), (0.03, 0.045)), fast=1.0),
    Flow("hail", 0.2, 6, 400, 12, ((-0.0105, 0.0105), (-0.0105, 0.0105), (0.001, 0.06)), (*SIDES, "zplane 0.0"), SMALL),
    Flow("drum of a mesh", 0.8, 6, 350, 24, ((-0.016, 0.016), (-0.0095, 0.0095), (-0.015, 0.018)), ("yplane -0.01", "yplane 0.01"), height=0.03, low=-0.03,
         meshes=[("drum", ring(0.025, -0.011, 0.011, axis="y"))], motion="fix turn all move/mesh mesh drum rotate origin 0 0 0 axis 0 1 0 period 0.33\n"),
    Flow("drum", 0.5, 5, 300, 30, ((-0.016, 0.016), (-0.0095, 0.0095), (-0.015, 0.018)), ("yplane -0.01", "yplane 0.01", "ycylinder 0.025 0 0 shear x 19"), height=0.03, low=-0.03),
    Flow("piston", 0.2, 4, 600, 46, ((-0.0105, 0.0105), (-0.0105, 0.0105), (0.001, 0.04)), (*SIDES, "zplane 0.0"), SMALL, meshes=[("lid", plate(0.012, 0.045))],
         motion="fix press all move/mesh mesh lid linear 0 0 -0.15\n"),
    Flow("hopper", 0.25, 3, 500, 20, ((-0.009, 0.009), (-0.009, 0.009), (0.042, 0.075)), ("zplane 0.0",), meshes=[("cone", ring(0.02, 0.02, 0.045, radius_low=0.006))]),
    Flow("chute", 0.3, 5, 500, 8, ((-0.0105, 0.0105), (-0.0105, 0.0105), (0.001, 0.025)), ("zplane 0.0",), half=(0.011, 0.011), boundary="p p f", gravity="0.5 0 -0.866"),
    Flow("paddle", 0.25, 4, 400, 30, (BED[0], (0.0005, 0.0105), (0.001, 0.03)), (*SIDES, "zplane 0.0"), SMALL,
         meshes=[("blade", stl([(-0.006, 0, 0.004), (0.006, 0, 0.004), (0.006, 0, 0.012), (-0.006, 0, 0.012)]))],
         motion="fix stir all move/mesh mesh blade rotate origin 0 0 0 axis 0 0 1 period 0.05\n"),
    Flow("shaken sideways", 0.2, 5, 500, 20, (*BED[:2], (0.001, 0.025)), (), (0.016, 0.014), meshes=[("tub", open_box(0.011, 0.08))],
         motion="fix shake all move/mesh mesh tub wiggle amplitude 0.002 0 0 period 0.025\n"),
]


def main(folder, *chosen):
    print(f"{'flow':<16} {'pair':<8} {'V planned':>9} {'visited':>8} {'ratio':>6}   {'d/R* planned':>12} {'visited':>8} {'ratio':>6} {'contacts':>9}")
    for flow in FLOWS:
        if chosen and flow.name not in chosen:
            continue
        for compared in flow.run(pathlib.Path(folder) / flow.name.replace(" ", "_")):
            print(f"{flow.name:<16} {compared.row()}", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
