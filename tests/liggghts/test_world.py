"""Public decks in small, one folder of world/ for each: what `mpm plan`, `mpm table --deck`, `mpm stretch` and the run make of them."""
import json
import pathlib
import re
import shutil
import sys

from pytest import approx
from harness import PLUGIN
from programs import LAUNCHER, MPM, InFolder, run

WORLD = pathlib.Path(__file__).resolve().parent / "world"


class World(InFolder):
    def take(self, name):
        """A copy of the deck's folder."""
        self.folder /= name
        shutil.copytree(WORLD / name, self.folder)

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
        self.take("one_sphere")
        self.change("in.one", "run          200000", "run 2000")
        assert sorted(self.table("in.one").split(", ")) == ["bead:bead", "bead:wall"]
        self.run_deck("in.one")

    def test_walls_count_beside_particles_of_a_program(self):
        self.take("driver_inserts")
        plan = self.plan("in.driver", "--drop-height", "0.1", "--particles", "100")
        assert plan["radius_m"] == [0.004, 0.004]  # of the templates
        assert [p["materials"] for p in plan["pairs"]] == [["bead", "bead"], ["bead", "wall"]]
        assert "bead:wall" in self.table("in.driver", "--drop-height", "0.1")

    def test_walls_count_beside_a_restart_file(self):
        self.take("restart_walls")
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
        self.take("mesh_named_wall")
        self.change("in.beaker", "run          20000", "run 2000")
        assert self.plan("in.beaker")["not_followed"] == []
        assert "bead:wall" in self.table("in.beaker")
        self.run_deck("in.beaker")


class TestBeginnings(World):
    def test_particles_inserted_into_a_wall_do_not_stop_the_run(self):
        """Each contact that began beyond the table parts with no more energy than the table's end holds, so no motion leads beyond it."""
        self.take("inserted_into_wall")
        self.table("in.wall")
        self.change("in.wall", "run          20000", "variable n equal atoms\nrun 20000\nprint \"END ${n}\"")
        text = self.run_deck("in.wall")
        assert re.search(r"END 100\b", text)
        assert "began deeper than the motion of a step" in text

    def test_particles_that_nothing_moves_do_not_run_away(self):
        self.take("no_integrator")
        self.mpm("table", "materials.toml", "-o", "law.h5")
        self.run_deck("in.still")


class TestLimits(World):
    def test_a_scene_beyond_all_laws_is_named(self):
        self.take("plan_past_law")
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
        self.take("soften_step")
        plan = self.plan("in.pour")
        soft = json.loads(self.mpm("soften", "in.pour", "--materials-file", "materials.toml", "--json"))
        assert plan["time_step_s"]["advised"] < 1e-5
        assert soft["time_step_s"] / (soft["stretch"] * plan["time_step_s"]["advised"]) == approx(1, abs=1e-6)
        self.change("in.pour", "timestep     1e-5", "timestep     1e-7")  # for another reason than contacts
        short = json.loads(self.mpm("soften", "in.pour", "--materials-file", "materials.toml", "--json"))
        assert short["time_step_s"] / (short["stretch"] * 1e-7) == approx(1, abs=1e-6)

    def test_a_loop_that_only_a_run_ends_has_no_cost(self):
        self.take("loop_cost")
        plan = self.plan("in.settle")
        assert plan["cost"]["hours"] is None
        assert re.search(r"in\.settle:3\d$", plan["cost"]["unknown_loop"])
        assert "cost: not known (the loop of in.settle:" in self.mpm("plan", "in.settle", "--materials-file", "materials.toml")


class TestSentences(World):
    def test_a_wall_before_its_pair_style(self):
        self.take("wall_before_pair")
        self.mpm("table", "materials.toml", "-o", "law.h5")
        assert "put the wall behind its pair_style" in self.run_deck("in.order", code=None)
        assert any("the wall stands before its pair_style" in note for note in self.plan("in.order")["not_followed"])

    def test_cohesion_above_the_pressure_of_yield(self):
        self.take("cohesion_over_hardness")
        self.change("in.cohesive", "run          60000", "run 10")
        self.table("in.cohesive")
        assert "cohesion pulls the particles into each other" in self.run_deck("in.cohesive")
        self.change("in.cohesive", "peratomtypepair 1 3e5", "peratomtypepair 1 3e3")
        assert "cohesion pulls" not in self.run_deck("in.cohesive")

    def test_paths_from_where_liggghts_is_started(self):
        self.take("paths_from_cwd")
        assert len(self.plan("decks/in.paths")["pairs"]) == 2
        self.table("decks/in.paths")
        self.run_deck("decks/in.paths")

    def test_a_yield_stress_above_a_lowered_modulus(self):
        self.take("plan_past_law")
        self.change("materials.toml", "25e3", "50e6")
        assert "where 'youngs_modulus' is lowered for the time step, give the real one" in self.mpm("plan", "in.soft", "--materials-file", "materials.toml", code=1)

    def test_the_check_of_the_time_step(self):
        self.take("one_sphere")
        self.change("in.one", "run          200000", "fix ts all check/timestep/gran 100 0.1 0.1\nrun 200")
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
        self.change("in.one", "run          200000", f"{more}variable speed equal vcm(all,z)\nrun 100\nprint \"END ${{speed}}\"")
        self.table("in.one", *words)

    def end(self, text):
        return [float(word) for word in re.findall(r"^END (\S+)", text, re.M)]

    def test_a_program_that_loads_the_library(self):
        self.take("one_sphere")
        self.steps()
        (self.folder / "driver.py").write_text(DRIVER)
        said = self.command(sys.executable, "driver.py", "in.one", env={"LD_PRELOAD": PLUGIN})
        for found, steps in zip(self.end(said), (100, 150), strict=True):
            assert found == approx(-9.81 * steps * 1e-6, abs=1e-8)  # free fall; print has six digits

    def test_the_coupling_to_a_fluid(self):
        self.take("one_sphere")
        self.change("in.one", "atom_style   granular", "atom_style   granular\natom_modify  map array")
        self.steps("fix cfd all couple/cfd couple_every 100 mpi\nfix drag all couple/cfd/force\n", "--speed", "1")
        assert self.end(self.run_deck("in.one"))[0] == approx(-9.81 * 1e-4, abs=1e-8)  # without a fluid no drag
