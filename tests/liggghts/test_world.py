"""Public decks in small: what `mpm plan`, `mpm table --deck`, `mpm stretch` and the run make of them."""
import json
import re
import sys

from pytest import approx
from harness import PLUGIN, plane_stl
from programs import LAUNCHER, MPM, InFolder, material, run

FLOOR = "fix floor all wall/gran model mpm tangential history primitive type 1 zplane 0\n"
MESH = "fix {0} all mesh/surface file meshes/floor.stl type {1}\nfix floor all wall/gran model mpm tangential history mesh n_meshes 1 meshes {0}\n"
MOVE = "fix integr all nve/sphere\n"
ONE = "create_atoms 1 single 0 0 0.05 units box\nset group all diameter 0.005 density {}\n"


def deck(body, half=0.03, low=-0.005, height=0.2, types=1, young="5e9", poisson="0.3", step="1e-6", names="bead", box="", walls=FLOOR, more="", cohesion=""):
    """A public deck in small, with the material's own moduli: walls, then `body`. `box`: in the place of region and box."""
    region = f"region reg block {-half} {half} {-half} {half} {low} {height} units box\ncreate_box {types} reg\n"
    return ("atom_style granular\nboundary f f f\nnewton off\ncommunicate single vel yes\nunits si\n" + (box or region) + "neighbor 0.002 bin\nneigh_modify delay 0\n" +
            ("hard_particles yes\n" if young == "5e9" else "") + f"fix m1 all property/global youngsModulus peratomtype {' '.join([young] * types)}\n"
            f"fix m2 all property/global poissonsRatio peratomtype {' '.join([poisson] * types)}\nfix m3 all property/global coefficientFriction peratomtypepair {types} {' '.join(['0.3'] * types**2)}\n"
            f"{more}pair_style gran model mpm tangential history {cohesion} law law.h5 materials {names}\npair_coeff * *\ntimestep {step}\nfix gravi all gravity 9.81 vector 0 0 -1\n{walls}{body}")


def templates(radius, density=2500):
    return (f"fix pts all particletemplate/sphere 15485863 atom_type 1 density constant {density} radius constant {radius}\n"
            "fix pdd all particledistribution/discrete 32452843 1 pts 1\n")


def packed(region, count, radius, all_in="yes", speed=0):
    return (f"region above {region} units box\n{templates(radius)}fix ins all insert/pack seed 49979687 distributiontemplate pdd vel constant 0 0 {-speed} insert_every once overlapcheck yes "
            f"all_in {all_in} particles_in_region {count} region above\n{MOVE}")


BEAD, LIGHT, SOFT = (material(*m) for m in (("bead", 2500, "5e9", 0.3, "25e6"), ("bead", 1500, "5e9", 0.3, "25e6"), ("soft", 2500, "5e6", 0.45, "25e3")))
SOFT_DECK = dict(half=0.05, low=-0.01, height=1.2, young="5e6", poisson="0.45", step="1e-5", names="soft")
HIGH = "block -0.02 0.02 -0.02 0.02 0.01 0.1"
# name: the deck's file and text, its materials
WORLD = {
    "one sphere on a plane, the commonest first deck": ("in.one", deck(ONE.format(1500) + MOVE + "run 200000\n", 0.02, height=0.1), LIGHT),
    "templates in the deck, the insertion by a Python driver": ("in.driver", deck(templates(0.004) + MOVE, types=2, names="bead steel", walls=MESH.format("cad", 2)), BEAD),
    "the second deck, particles from a restart file": ("in.second", deck(MOVE + "run 10000\n", types=2, names="bead steel", box="read_restart bed.restart\n", walls=MESH.format("cad", 2)), BEAD),
    "a mesh called wall, which is also a keyword": ("in.beaker", deck(packed(HIGH, 50, 0.004, speed=1) + "run 20000\n", walls=MESH.format("wall", 1)), BEAD),
    "packed nearer to the wall than a radius": ("in.wall", deck(packed("cylinder z 0 0 0.026 0.01 0.15", 100, 0.004, "no") + "run 20000\n",
                                                walls=FLOOR + FLOOR.replace("floor", "side").replace("zplane 0", "zcylinder 0.027 0 0")), BEAD),
    "a velocity, a step of 1 s, and no fix that moves": ("in.still", deck(ONE.format(1000) + "velocity all set 0 0 -0.1\nrun 3\n", step="1"), LIGHT),
    "moduli of 5e6 Pa, Y of E/200, a fall of a metre": ("in.soft", deck(packed("block -0.04 0.04 -0.04 0.04 1.0 1.1", 50, 0.005) + "run 60000\n", **SOFT_DECK), SOFT),
    "real moduli, the soft deck's step": ("in.pour", deck(packed("cylinder z 0 0 0.025 0.01 0.15", 500, 0.002) + "run 20000\n", step="1e-5",
                                          walls=FLOOR + FLOOR.replace("floor", "side").replace("zplane 0", "zcylinder 0.03 0 0")), BEAD),
    "runs until the bed is at rest": ("in.settle", deck(ONE.format(1500) + "create_atoms 1 single 0 0.01 0.05 units box\nset group all diameter 0.005 density 1500\n" + MOVE +
                                      "compute ke all ke\nvariable k equal c_ke\nthermo_style custom step atoms c_ke\nrun 1\nlabel again\nrun 1000\n"
                                      "if \"${k} < 1e-9\" then \"jump in.settle done\"\njump in.settle again\nlabel done\n", 0.02, height=0.1), LIGHT),
    "a wall before its pair style": ("in.order", deck(ONE.format(2500) + MOVE + "run 100\n", walls="", more=FLOOR), BEAD),
    "cohesion that pulls harder than the material resists": ("in.cohesive", deck(packed("block -0.04 0.04 -0.04 0.04 0.01 0.06", 200, 0.005) + "run 60000\n", **SOFT_DECK, cohesion="cohesion sjkr",
                                                             walls=FLOOR.replace("history", "history cohesion sjkr"), more="fix m4 all property/global cohesionEnergyDensity peratomtypepair 1 3e5\n"), SOFT),
    "paths from the folder where LIGGGHTS is started": ("decks/in.paths", deck(packed(HIGH, 50, 0.004) + "run 2000\n", walls=MESH.format("cad", 1)), BEAD),
}
DECKS = {file: (text, materials) for file, text, materials in WORLD.values()}


class World(InFolder):
    def take(self, name):
        text, materials = DECKS[name]
        for folder in ("meshes", "decks"):
            (self.folder / folder).mkdir()
        (self.folder / "meshes/floor.stl").write_text(plane_stl())
        (self.folder / "materials.toml").write_text(materials)
        (self.folder / name).write_text(text)

    def command(self, *words, **how):
        done = run(*words, cwd=self.folder, **how)
        return done.stdout + done.stderr

    def mpm(self, *words, **how):
        return self.command(MPM, *words, **how)

    def plan(self, deck, *words):
        return json.loads(self.mpm("plan", deck, "--materials-file", "materials.toml", *words, "--json"))

    def table(self, deck, *words):
        """The pairs of the law that the deck gets."""
        text = self.mpm("table", "materials.toml", "--deck", deck, *words, "-o", "law.h5")
        return re.search(r"wrote law.h5: pairs (.*)", text)[1]

    def run_deck(self, deck, *words, code=0):
        return self.command(LAUNCHER, "-in", deck, "-log", "none", *words, code=code)

    def change(self, deck, old, new):
        path = self.folder / deck
        text = path.read_text()
        assert old in text
        path.write_text(text.replace(old, new))


class TestLaws(World):
    """The law of `mpm table --deck` is the law that the run demands."""

    def test_one_sphere(self):
        self.take("in.one")
        self.change("in.one", "run 200000", "run 2000")
        assert sorted(self.table("in.one").split(", ")) == ["bead:bead", "bead:wall"]
        self.run_deck("in.one")

    def test_walls_count_beside_particles_of_a_program(self):
        self.take("in.driver")
        plan = self.plan("in.driver", "--drop-height", "0.1", "--particles", "100")
        assert plan["radius_m"] == [0.004, 0.004]  # of the templates
        assert [p["materials"] for p in plan["pairs"]] == [["bead", "bead"], ["bead", "wall"]]
        assert "bead:wall" in self.table("in.driver", "--drop-height", "0.1")

    def test_walls_count_beside_a_restart_file(self):
        self.take("in.second")
        first = (self.folder / "in.second").read_text()
        first = first.replace("read_restart bed.restart", "region reg block -0.03 0.03 -0.03 0.03 -0.005 0.2 units box\ncreate_box 2 reg")
        first = first.replace("run 10000", "create_atoms 1 single 0 0 0.05 units box\nset group all diameter 0.008 density 2500\nrun 10\nwrite_restart bed.restart")
        (self.folder / "in.first").write_text(first)
        self.change("in.second", "run 10000", "run 200")
        assert "bead:wall" in self.table("in.first")
        self.run_deck("in.first")
        plan = self.plan("in.second", "--drop-height", "0.1")
        assert [p["materials"] for p in plan["pairs"]] == [["bead", "wall"]]
        assert "bead:wall" in self.table("in.second", "--drop-height", "0.1")
        self.run_deck("in.second")

    def test_a_mesh_may_be_called_wall(self):
        self.take("in.beaker")
        self.change("in.beaker", "run 20000", "run 2000")
        assert self.plan("in.beaker")["not_followed"] == []
        assert "bead:wall" in self.table("in.beaker")
        self.run_deck("in.beaker")


class TestBeginnings(World):
    def test_particles_inserted_into_a_wall_do_not_stop_the_run(self):
        """Each contact that began beyond the table parts with no more energy than the table's end holds, so no motion leads beyond it."""
        self.take("in.wall")
        self.table("in.wall")
        self.change("in.wall", "run 20000", "variable n equal atoms\nrun 20000\nprint \"END ${n}\"")
        text = self.run_deck("in.wall")
        assert re.search(r"END 100\b", text)
        assert "began deeper than the motion of a step" in text

    def test_particles_that_nothing_moves_do_not_run_away(self):
        self.take("in.still")
        self.mpm("table", "materials.toml", "-o", "law.h5")
        self.run_deck("in.still")


class TestLimits(World):
    def test_a_scene_beyond_all_laws_is_named(self):
        self.take("in.soft")
        self.change("in.soft", "materials soft", "materials soft stats stats.json")
        plan = self.plan("in.soft")
        assert len(plan["beyond_laws"]) == len(plan["pairs"])
        for text in (plan["beyond_laws"][0], self.mpm("plan", "in.soft", "--materials-file", "materials.toml"),
                     self.mpm("table", "materials.toml", "--deck", "in.soft", "-o", "law.h5"), self.mpm("soften", "in.soft", "--materials-file", "materials.toml")):
            assert "the material is too soft for these speeds" in text
        assert "no law goes beyond 0.5 of the radius" in self.run_deck("in.soft", code=None)
        # the file of the stop holds the contact that stopped the run
        stats = json.loads((self.folder / "stats.json").read_text())
        assert "beyond the law's table" in stats["stopped"]
        assert stats["step"] > 0
        assert max(stats["pair"]["overlap_over_radius_max"], stats["wall"]["overlap_over_radius_max"]) > 0.5
        visited = self.plan("in.soft", "--from", "stats.json")
        assert "visited" in [p["speed_by"] for p in visited["pairs"]]

    def test_the_step_of_soften_is_that_of_the_real_contacts(self):
        self.take("in.pour")
        plan = self.plan("in.pour")
        soft = json.loads(self.mpm("soften", "in.pour", "--materials-file", "materials.toml", "--json"))
        assert plan["time_step_s"]["advised"] < 1e-5
        assert soft["time_step_s"] / (soft["stretch"] * plan["time_step_s"]["advised"]) == approx(1, abs=1e-6)
        self.change("in.pour", "timestep 1e-5", "timestep 1e-7")  # for another reason than contacts
        short = json.loads(self.mpm("soften", "in.pour", "--materials-file", "materials.toml", "--json"))
        assert short["time_step_s"] / (short["stretch"] * 1e-7) == approx(1, abs=1e-6)

    def test_a_loop_that_only_a_run_ends_has_no_cost(self):
        self.take("in.settle")
        plan = self.plan("in.settle")
        assert plan["cost"]["hours"] is None
        assert re.search(r"in\.settle:\d\d$", plan["cost"]["unknown_loop"])
        assert "cost: not known (the loop of in.settle:" in self.mpm("plan", "in.settle", "--materials-file", "materials.toml")


class TestSentences(World):
    def test_a_wall_before_its_pair_style(self):
        self.take("in.order")
        self.mpm("table", "materials.toml", "-o", "law.h5")
        assert "put the wall behind its pair_style" in self.run_deck("in.order", code=None)
        assert any("the wall stands before its pair_style" in note for note in self.plan("in.order")["not_followed"])

    def test_cohesion_above_the_pressure_of_yield(self):
        self.take("in.cohesive")
        self.change("in.cohesive", "run 60000", "run 10")
        self.table("in.cohesive")
        assert "cohesion pulls the particles into each other" in self.run_deck("in.cohesive")
        self.change("in.cohesive", "peratomtypepair 1 3e5", "peratomtypepair 1 3e3")
        assert "cohesion pulls" not in self.run_deck("in.cohesive")

    def test_paths_from_where_liggghts_is_started(self):
        self.take("decks/in.paths")
        assert len(self.plan("decks/in.paths")["pairs"]) == 2
        self.table("decks/in.paths")
        self.run_deck("decks/in.paths")

    def test_a_yield_stress_above_a_lowered_modulus(self):
        self.take("in.soft")
        self.change("materials.toml", "25e3", "50e6")
        assert "where 'youngs_modulus' is lowered for the time step, give the real one" in self.mpm("plan", "in.soft", "--materials-file", "materials.toml", code=1)

    def test_the_check_of_the_time_step(self):
        self.take("in.one")
        self.change("in.one", "run 200000", "fix ts all check/timestep/gran 100 0.1 0.1\nrun 200")
        self.table("in.one")
        assert "check/timestep/gran takes Hertz's contact time of the deck's moduli" in self.run_deck("in.one")


DRIVER = """import ctypes, sys
library = ctypes.CDLL("libliggghts.so.3", mode=ctypes.RTLD_GLOBAL)
words = [b"liggghts", b"-log", b"none"]
liggghts = ctypes.c_void_p()
library.lammps_open_no_mpi(len(words), (ctypes.c_char_p * len(words))(*words), ctypes.byref(liggghts))
library.lammps_file(liggghts, sys.argv[1].encode())
library.lammps_command(liggghts, b"run 50")
library.lammps_command(liggghts, b'print "END ${speed}"')
"""


class TestCoupling(World):
    def steps(self, more="", *words):
        self.change("in.one", "run 200000", f"{more}variable speed equal vcm(all,z)\nrun 100\nprint \"END ${{speed}}\"")
        self.table("in.one", *words)

    def end(self, text):
        return [float(word) for word in re.findall(r"^END (\S+)", text, re.M)]

    def test_a_program_that_loads_the_library(self):
        self.take("in.one")
        self.steps()
        (self.folder / "driver.py").write_text(DRIVER)
        said = self.command(sys.executable, "driver.py", "in.one", env={"LD_PRELOAD": PLUGIN})
        for found, steps in zip(self.end(said), (100, 150), strict=True):
            assert found == approx(-9.81 * steps * 1e-6, abs=1e-8)  # free fall; print has six digits

    def test_the_coupling_to_a_fluid(self):
        self.take("in.one")
        self.change("in.one", "atom_style granular", "atom_style granular\natom_modify map array")
        self.steps("fix cfd all couple/cfd couple_every 100 mpi\nfix drag all couple/cfd/force\n", "--speed", "1")
        assert self.end(self.run_deck("in.one"))[0] == approx(-9.81 * 1e-4, abs=1e-8)  # without a fluid no drag
