"""`mpm convert`: a deck of another normal model becomes one of model mpm that runs at once."""
import json
import pathlib
import re

from pytest import approx
from programs import LAUNCHER, InFolder, material, mpm, run
from harness import plane_stl

MATERIALS = material("bead", 2500, "5e9", 0.3, "25e6")
TWO_MATERIALS = MATERIALS + material("soft", 1000, "1e9", 0.4, "10e6")
HEAD = """units si
atom_style granular
atom_modify map array
boundary f f f
newton off
communicate single vel yes
region box block -0.03 0.03 -0.03 0.03 -0.005 0.2 units box
create_box {types} box
neighbor 0.002 bin
neigh_modify delay 0
"""
SOFT = """fix m1 all property/global youngsModulus peratomtype {young}
fix m2 all property/global poissonsRatio peratomtype {poisson}
fix m3 all property/global coefficientRestitution peratomtypepair {types} {e}
fix m4 all property/global coefficientFriction peratomtypepair {types} {e}
"""
PAIR = "pair_style gran model hertz tangential history\npair_coeff * *\n"
WALL = "fix floor all wall/gran model hertz tangential history primitive type {type} zplane 0\n"
REST = """timestep 1e-5
fix gravi all gravity 9.81 vector 0 0 -1
region above block -0.02 0.02 -0.02 0.02 0.01 0.1 units box
fix pts all particletemplate/sphere 15485863 atom_type 1 density constant 2500 radius constant 0.002
fix pdd all particledistribution/discrete 32452843 1 pts 1
fix ins all insert/pack seed 49979687 distributiontemplate pdd vel constant 0 0 0 insert_every once overlapcheck yes all_in yes particles_in_region 50 region above
fix integr all nve/sphere
"""
RUN = "dump d all custom 100 post/d*.txt id x y z\nthermo 100\nrun 1000\n"


def soft(types=1):
    return SOFT.format(types=types, young=" ".join(["5e6"] * types), poisson=" ".join(["0.45"] * types), e=" ".join(["0.5"] * types * types))


DECK = HEAD.format(types=1) + soft() + PAIR + WALL.format(type=1)


class Convert(InFolder):
    def prepare(self):
        self.out = self.folder / "out"
        (self.folder / "post").mkdir()
        self.write("materials.toml", MATERIALS)

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(exist_ok=True, parents=True)
        path.write_text(text)

    def mpm(self, *words, code=0, cwd=None):
        return mpm(*words, code=code, cwd=cwd or self.folder)

    def convert(self, *words, deck="in.deck", code=0):
        """The converted deck's text, and what --json said."""
        done = self.mpm("convert", deck, "--materials-file", "materials.toml", "-o", "out", "--json", *words, code=code)
        if code:
            return done.stderr
        for name in (pathlib.Path(deck).name, "law.h5", "conversion.md"):
            assert (self.out / name).is_file(), name
        return (self.out / pathlib.Path(deck).name).read_text(), json.loads(done.stdout)

    def run_converted(self, steps=200, deck="in.deck", cwd=None):
        """State after some steps."""
        run(LAUNCHER, "-steps", steps, self.folder / "state.json", "-in", deck, "-log", "none", cwd=cwd or self.out)
        return json.loads((self.folder / "state.json").read_text())


class TestFiles(Convert):
    def test_deck_law_and_page_are_written_and_the_original_stays(self):
        text = DECK + REST + RUN
        self.write("in.deck", text)
        now, said = self.convert()
        assert (self.folder / "in.deck").read_text() == text
        assert "pair_style gran model mpm tangential history law law.h5 materials bead" in now
        assert "fix floor all wall/gran model mpm tangential history primitive type 1 zplane 0" in now
        assert "hard_particles yes" in now
        assert "youngsModulus peratomtype 5000000000" in now
        assert "poissonsRatio peratomtype 0.3" in now
        assert "# fix m3 all property/global coefficientRestitution" in now
        assert said["pairs"] == ["bead:bead", "bead:wall"]
        page = (self.out / "conversion.md").read_text()
        for line in ("in.deck:11", "in.deck:13", "in.deck:15", "time step"):
            assert line in page
        assert self.run_converted()["particles"] == 50

    def test_includes_meshes_and_folders_come_along(self):
        self.write("meshes/floor.stl", plane_stl())
        self.write("parts/materials.in", soft())
        wall = "fix cad all mesh/surface file meshes/floor.stl type 1\nfix wall all wall/gran model hertz tangential history mesh n_meshes 1 meshes cad\n"
        self.write("in.deck", HEAD.format(types=1) + "include parts/materials.in\n" + PAIR + wall + REST + RUN)
        now, _ = self.convert()
        assert "include parts/materials.in" in now
        assert "5000000000" in (self.out / "parts/materials.in").read_text()
        assert self.run_converted()["particles"] == 50
        assert list((self.out / "post").glob("d*.txt"))

    def test_its_own_folder_is_refused(self):
        self.write("in.deck", HEAD.format(types=1) + soft() + PAIR + REST + RUN)
        assert "the original would be lost" in self.mpm("convert", "in.deck", "--materials-file", "materials.toml", "-o", ".", code=2).stderr

    def test_paths_from_where_one_stands(self):
        self.write("meshes/floor.stl", plane_stl())
        wall = "fix cad all mesh/surface file meshes/floor.stl type 1\nfix walls all wall/gran model hertz tangential history mesh n_meshes 1 meshes cad\n"
        self.write("decks/in.deck", HEAD.format(types=1) + soft() + PAIR + wall + REST + RUN)
        self.convert(deck="decks/in.deck")
        assert self.run_converted()["particles"] == 50


    def test_paths_that_leave_the_folder_come_within_it(self):
        self.write("parts/materials.in", soft())
        self.write("DEM/in.deck", "log ../DEM/log.liggghts\n" + HEAD.format(types=1) + "include ../parts/materials.in\n" + PAIR + WALL.format(type=1) + REST +
                   "run 10\nwrite_restart ../DEM/bed.restart\n")
        self.mpm("convert", "in.deck", "--materials-file", "../materials.toml", "-o", "../out", cwd=self.folder / "DEM")
        now = (self.out / "in.deck").read_text()
        assert "log log.liggghts" in now
        assert "include parts/materials.in" in now
        assert "write_restart bed.restart" in now
        self.run_converted(20)
        assert (self.out / "bed.restart").is_file()
        assert not (self.folder / "DEM/bed.restart").exists()

    def test_a_deck_for_several_ranks_is_converted_by_one(self):
        self.write("in.deck", "processors 2 1 1\n" + DECK + REST + RUN)
        now, said = self.convert("--check")
        assert "processors 2 1 1" in now
        assert said["check"]["converted"]["particles"] == 50

    def test_stresses_of_particles_are_planned(self):
        observed = "compute s all stress/atom virial\ncompute sum all reduce sum c_s[1]\nthermo_style custom step c_sum\n"
        self.write("in.deck", DECK + REST + observed + RUN)
        self.convert()
        self.run_converted(20)


class TestModels(Convert):
    def converted(self, pair, more="", materials=None, types=1, wall=None, properties=None):
        self.write("in.deck", HEAD.format(types=types) + (soft(types) if properties is None else properties) + more + pair + "pair_coeff * *\n" + (wall or WALL.format(type=types)) + REST + RUN)
        now, said = self.convert(*(["--materials", materials] if materials else []))
        state = self.run_converted()
        assert state["particles"] == 50
        return now, said

    def test_hooke(self):
        now, _ = self.converted("pair_style gran model hooke tangential history tangential_damping on viscous off\n", "fix m5 all property/global characteristicVelocity scalar 2\n",
                                wall="fix floor all wall/gran model hooke tangential history primitive type 1 zplane 0 viscous off\n")
        assert "pair_style gran model mpm tangential history tangential_damping on law" in now
        assert "viscous" not in now

    def test_hooke_stiffness_gets_moduli(self):
        stiffness = "".join(f"fix {n} all property/global {n} peratomtypepair 1 {v}\n" for n, v in (("kn", 1e4), ("kt", 3e3), ("gamman", 10), ("gammat", 5), ("coefficientFriction", 0.5)))
        now, _ = self.converted("pair_style gran model hooke/stiffness tangential history absolute_damping on\n", properties=stiffness)
        assert "property/global youngsModulus peratomtype 5000000000" in now

    def test_hysteresis(self):
        plastic = "".join(f"fix h{k} all property/global {n} peratomtypepair 1 {v}\n" for k, (n, v) in enumerate((("kn2kcMax", 0.6), ("kn2k1", 1.5), ("phiF", 0.25), ("cohesionEnergyDensity", 3e3))))
        self.converted("pair_style gran model hooke/hysteresis tangential history\n", "fix m5 all property/global characteristicVelocity scalar 2\n" + plastic)

    def test_rolling_friction_stays(self):
        properties = soft() + "".join(f"fix l{k} all property/global {n} {v}\n" for k, (n, v) in enumerate((("coefficientRollingFriction", "peratomtypepair 1 0.1"),)))
        now, _ = self.converted("pair_style gran model hertz tangential no_history rolling_friction cdt\n", properties=properties)
        assert "model mpm tangential no_history rolling_friction cdt law" in now

    def test_a_wall_before_its_pair_style_goes_behind(self):
        self.write("in.deck", HEAD.format(types=1) + soft() + WALL.format(type=1) + PAIR + REST + RUN)
        now, said = self.convert()
        assert now.index("pair_style gran") < now.index("\nfix floor")
        assert any("moved behind" in c["why"] for c in said["changes"])
        self.run_converted()

    def test_rigid_walls_and_two_materials(self):
        self.write("materials.toml", TWO_MATERIALS)
        now, said = self.converted(PAIR.split("\n")[0] + "\n", types=2, materials="bead,steel")
        assert "materials bead steel" in now
        assert said["pairs"] == ["bead:bead", "bead:wall"]
        again = self.convert("--materials", "steel,bead", code=2)  # type 1 has particles
        assert "steel" in again

    def test_a_stretched_law_divides_the_cohesion(self):
        now, said = self.converted("pair_style gran model hertz tangential history cohesion sjkr\n", "fix m5 all property/global cohesionEnergyDensity peratomtypepair 1 3e5\n")
        assert said["stretch"] > 1
        density = float(re.search(r"cohesionEnergyDensity peratomtypepair 1 (\S+)", now)[1])
        assert density == approx(3e5 / said["stretch"]**2, abs=1e-6 * 3e5)


class TestTime(Convert):
    FAST = REST.replace("vel constant 0 0 0", "vel constant 0 0 -3").replace("timestep 1e-5", "timestep 2e-5")

    def test_counts_of_steps_keep_their_times(self):
        self.write("in.deck", DECK + self.FAST + "fix a all ave/time 5 10 100 c_1 file post/a.txt\n".replace("c_1", "c_k") .join(["compute k all ke\n", ""]) + RUN)
        now, said = self.convert()
        f = said["steps_factor"]
        assert f > 1
        assert int(re.search(r"^run (\d+)", now, re.M)[1]) == round(1000 * f)
        assert int(re.search(r"^thermo (\d+)", now, re.M)[1]) == round(100 * f)
        assert int(re.search(r"custom (\d+)", now)[1]) == round(100 * f)
        every, _, frequency = map(int, re.search(r"ave/time (\d+) (\d+) (\d+)", now).groups())
        assert frequency == 20 * every  # 100 of 5, or LIGGGHTS refuses it
        assert float(re.search(r"^timestep (\S+)", now, re.M)[1]) == approx(2e-5 / f, abs=1e-12)
        assert said["not_converted"] == []
        assert self.run_converted(round(300 * f))["time"] == approx(300 * 2e-5, abs=2e-5)

    def test_counts_that_follow_the_step_are_left(self):
        variables = "variable dt equal 2e-5\nvariable n equal round(0.02/${dt})\nvariable m equal 500\n"
        self.write("in.deck", DECK + variables + self.FAST.replace("timestep 2e-5", "timestep ${dt}") +
                   "thermo ${m}\nrun ${n}\n")
        now, said = self.convert()
        f = said["steps_factor"]
        assert "run ${n}" in now
        assert f"thermo {round(500 * f)}" in now
        assert float(re.search(r"variable dt equal (\S+)", now)[1]) == approx(2e-5 / f, abs=1e-12)
        assert said["not_converted"] == []

    def test_a_deck_that_moves_nothing_keeps_its_step(self):
        self.write("in.deck", HEAD.format(types=1) + soft() + PAIR + REST.replace("fix integr all nve/sphere\n", "").replace("1e-5", "1") + "run 3\n")
        now, said = self.convert()
        assert "timestep 1\n" in now
        assert "run 3\n" in now
        self.run_converted(3)

    def test_branches_and_step_numbers_are_named(self):
        self.write("in.deck", DECK + self.FAST + "variable s equal step\nrun 1000\nif \"${s} > 500\" then \"run 100\"\n")
        _, said = self.convert()
        left = "\n".join(said["not_converted"])
        assert "number of the step" in left
        assert "'run 100' in a branch" in left


class TestChains(Convert):
    def test_a_deck_that_continues_has_the_stretch_of_the_first(self):
        self.write("in.first", DECK + REST + "run 300\nwrite_restart bed.restart\n")
        _, first = self.convert(deck="in.first")
        assert first["stretch"] > 1
        for where, deck in ((self.folder, "in.first"), (self.out, "in.first")):  # the original's and the converted one's
            run(LAUNCHER, "-in", deck, "-log", "none", cwd=where)
        head = re.sub(r"region box .*\ncreate_box .*\n", "read_restart bed.restart\n", HEAD.format(types=1))
        fast = "velocity all set 0 0 -3\nfix integr all nve/sphere\ntimestep 1e-5\nfix gravi all gravity 9.81 vector 0 0 -1\nrun 300\n"
        self.write("in.second", head + soft() + PAIR + WALL.format(type=1) + fast)
        now, second = self.convert(deck="in.second")
        assert second["stretch"] == first["stretch"]
        assert self.run_converted(100, deck="in.second")["particles"] == 50


class TestQuestions(Convert):
    def test_a_missing_number_is_asked_for(self):
        self.write("in.deck", DECK + REST + "fix push all addforce 0 0 1\nrun 100\n")
        said = self.convert(code=3)
        assert "--speed" in said
        default = re.search(r"\(--speed (\S+):", said)[1]
        _, json_said = self.convert("--speed", default)
        _, accepted = self.convert("--accept-defaults")
        assert json_said["stretch"] == accepted["stretch"]

    def test_which_material_is_asked_for(self):
        self.write("materials.toml", TWO_MATERIALS)
        self.write("in.deck", DECK + REST + RUN)
        assert "--materials" in self.convert(code=3)

    def test_a_deck_without_contacts_is_refused(self):
        self.write("in.deck", HEAD.format(types=1) + "atom_modify sort 0 0\nrun 0\n")
        assert "no contact model to convert" in self.convert(code=1)


class TestCheck(Convert):
    def test_both_decks_are_compared(self):
        self.write("in.deck", DECK + REST + RUN)
        _, said = self.convert("--check")
        original, now = said["check"]["original"], said["check"]["converted"]
        assert (original["particles"], now["particles"], original["steps"]) == (50, 50, 300)
        assert original["time"] == approx(now["time"], abs=1e-5)
        # 3 ms of free fall: the converted deck's step differs at most
        assert now["kinetic_energy"] / original["kinetic_energy"] == approx(1, abs=0.01)
        assert (said["check"]["files_missing"], said["check"]["files_new"]) == ([], [])
        assert not list((self.out / "post").glob("*"))  # in a copy
