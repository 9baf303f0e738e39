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


class TestDefaults(Convert):
    def test_a_speed_is_no_less_than_what_the_plan_knows(self):
        """Two beads at 4 m/s each, beside a plate that a force moves."""
        (self.folder / "plate.stl").write_text(plane_stl())
        self.write("in.deck", DECK.replace(WALL.format(type=1), "fix plate all mesh/surface/stress/servo file plate.stl type 1 com 0 0 0.03 ctrlPV force axis 0 0 -1 target_val 1 "
                                           "vel_max 0.1 kp 5\nfix walls all wall/gran model hertz tangential history mesh n_meshes 1 meshes plate\n") +
                   "create_atoms 1 single 0 0 0.05 units box\ncreate_atoms 1 single 0 0 0.06 units box\nset group all density 2500 diameter 0.002\n"
                   "set atom 1 vz 4\nset atom 2 vz -4\nfix move all nve/sphere\ntimestep 1e-6\nrun 100\n")
        _, said = self.convert("--accept-defaults")
        assert said["taken_from_deck"][0].endswith("--speed 8, the fastest approach that the deck shows")
        assert "1:1 bead:bead | up to 8 m/s" in (self.out / "conversion.md").read_text()


class TestFiles(Convert):
    def test_deck_law_and_page_are_written_and_the_original_stays(self):
        text = DECK + REST + RUN
        self.write("in.deck", text)
        now, said = self.convert()
        assert (self.folder / "in.deck").read_text() == text
        assert re.search("^pair_style gran model mpm tangential history law law.h5 materials bead .*beyondRange crush$", now, re.M)
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
        """`include` counts from where LIGGGHTS is started, a mesh here as well."""
        self.write("meshes/floor.stl", plane_stl())
        self.write("parts/materials.in", soft())
        wall = "fix cad all mesh/surface file meshes/floor.stl type 1\nfix wall all wall/gran model hertz tangential history mesh n_meshes 1 meshes cad\n"
        self.write("decks/in.deck", HEAD.format(types=1) + "include parts/materials.in\n" + PAIR + wall + REST + RUN)
        now, _ = self.convert(deck="decks/in.deck")
        assert "include parts/materials.in" in now
        assert "5000000000" in (self.out / "parts/materials.in").read_text()
        run(LAUNCHER, "-in", "in.deck", cwd=self.out)
        assert list((self.out / "post").glob("d*.txt"))

    def test_its_own_folder_is_refused(self):
        self.write("in.deck", HEAD.format(types=1) + soft() + PAIR + REST + RUN)
        assert "the original would be lost" in self.mpm("convert", "in.deck", "--materials-file", "materials.toml", "-o", ".", code=2).stderr

    def test_paths_that_leave_the_folder_come_within_it(self):
        self.write("parts/materials.in", soft())
        self.write("DEM/in.deck", "log ../DEM/log.liggghts\n" + HEAD.format(types=1) + "include ../parts/materials.in\n" + PAIR + WALL.format(type=1) + REST +
                   "run 10\nwrite_restart ../DEM/bed.restart\n")
        self.mpm("convert", "in.deck", "--materials-file", "../materials.toml", "-o", "../out", cwd=self.folder / "DEM")
        now = (self.out / "in.deck").read_text()
        assert "log log.liggghts" in now
        assert "include parts/materials.in" in now
        assert "write_restart bed.restart" in now
        run(LAUNCHER, "-in", "in.deck", cwd=self.out)
        assert (self.out / "bed.restart").is_file()
        assert not (self.folder / "DEM/bed.restart").exists()


class TestLines(Convert):
    """A line is converted alike behind lines of any length and kind."""
    NOTES = ("#" + " a note" * 500 + "\n", "#" + " a note" * 500 + " &\nthat goes on\n", "variable note string \"" + "heights in mm, " * 40 + "\"\n", "print 'a # b'" + " " * 3000 + "# \"\n")

    def changes(self, deck, name="in.deck"):
        self.write(name, deck)
        self.write("parts/in.more", self.more)
        now, said = self.convert("--check", deck=name)
        assert said["check"]["converted"]["ended"]
        return now, {re.sub(r"^.*:", "", c["before"]): (c["after"], c["why"]) for c in said["changes"]}, said

    def test_long_lines(self):
        self.more = WALL.format(type=1)
        plain = DECK.replace(WALL.format(type=1), "include parts/in.more\n") + REST + "run 400\nrun 100"
        _, expected, said = self.changes(plain)
        assert said["not_converted"] == []
        head, tail = plain.split("fix m1")
        notes = "".join(self.NOTES)
        self.more = notes + WALL.format(type=1)
        now, found, _ = self.changes(notes + head + notes + "fix m1" + tail.replace("\nrun 400", "\n" + notes + "run 400"))
        assert found == expected
        assert all(now.count(note.split("\n")[0][:200]) >= 3 for note in self.NOTES)


class TestModels(Convert):
    """Of each kind one; the lines of each model: tests/unit/deck/convert_test.cpp."""

    def converted(self, pair, more="", materials=None, types=1, wall=None, properties=None):
        self.write("in.deck", HEAD.format(types=types) + (soft(types) if properties is None else properties) + more + pair + "pair_coeff * *\n" + (wall or WALL.format(type=types)) + REST + RUN)
        now, said = self.convert(*(["--materials", materials] if materials else []))
        state = self.run_converted()
        assert state["particles"] == 50
        return now, said

    def test_hooke_stiffness_gets_moduli(self):
        stiffness = "".join(f"fix {n} all property/global {n} peratomtypepair 1 {v}\n" for n, v in (("kn", 1e4), ("kt", 3e3), ("gamman", 10), ("gammat", 5), ("coefficientFriction", 0.5)))
        now, _ = self.converted("pair_style gran model hooke/stiffness tangential history absolute_damping on\n", properties=stiffness)
        assert "property/global youngsModulus peratomtype 5000000000" in now

    def test_hysteresis(self):
        plastic = "".join(f"fix h{k} all property/global {n} peratomtypepair 1 {v}\n" for k, (n, v) in enumerate((("kn2kcMax", 0.6), ("kn2k1", 1.5), ("phiF", 0.25), ("cohesionEnergyDensity", 3e3))))
        self.converted("pair_style gran model hooke/hysteresis tangential history\n", "fix m5 all property/global characteristicVelocity scalar 2\n" + plastic)

    def test_rigid_walls_and_two_materials(self):
        self.write("materials.toml", TWO_MATERIALS)
        now, said = self.converted(PAIR.split("\n")[0] + "\n", types=2, materials="bead,steel")
        assert "materials bead steel" in now
        assert said["pairs"] == ["bead:bead", "bead:wall"]
        again = self.convert("--materials", "steel,bead", code=2)  # type 1 has particles
        assert "steel" in again


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
        assert frequency % every == 0  # or LIGGGHTS refuses it
        assert frequency == approx(100 * f, rel=0.05)
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

    def test_counts_are_whole_under_the_new_step(self):
        """Counts worked out from a time and the time step, as most public decks have them."""
        counts = ("${seconds}/${dt}", "round(${seconds}/${dt})", "v_seconds/v_dt", "\"v_seconds/v_dt\"", "$(v_seconds/v_dt)", "${seconds}/dt", "${half}+${half}")
        text = ("variable dt equal 2e-5\nvariable seconds equal 0.0024\nvariable half equal ${seconds}/${dt}/2\n" + DECK + self.FAST.replace("timestep 2e-5\n", "timestep ${dt}\n") + "compute k all ke\n")
        for k, count in enumerate(counts):
            text += (f"variable n{k} equal {count}\nvariable many{k} equal 2*${{n{k}}}\nfix a{k} all ave/time 1 1 ${{n{k}}} c_k\ndump e{k} all custom ${{n{k}}} post/e{k}.*.txt id\n"
                     f"thermo ${{n{k}}}\nrun ${{many{k}}}\nundump e{k}\nunfix a{k}\n")
        self.write("in.deck", text + "run $(2 * v_seconds/v_dt)\n")
        now, said = self.convert()
        assert said["steps_factor"] > 1
        assert said["not_converted"] == []
        assert all(f"run ${{many{k}}}" in now for k in range(len(counts)))
        assert self.run_converted(10**6)["time"] == approx(0.0048 * (len(counts) + 1), rel=2e-3)

    def test_counts_do_not_change_what_else_follows_the_step(self):
        """A speed that is worked out from the time step stays; so do variables that LIGGGHTS gets by -var."""
        variables = "variable seconds equal 0.01\nvariable v equal 6e-5/${dt}\nvariable n equal ${seconds}/${dt}\n"
        for dt, speed, words in (("variable dt equal 2e-5\n", "-${v}", ()), ("variable dt index 1e-5\n", "-3", ("--var", "dt", "2e-5"))):
            self.write("in.deck", DECK + dt + variables + self.FAST.replace("timestep 2e-5", "timestep ${dt}").replace("0 0 -3", f"0 0 {speed}") + "thermo ${n}\nrun ${n}\nrun ${n}\n")
            now, said = self.convert(*words)
            assert said["steps_factor"] > 1
            assert dt in now
            run(LAUNCHER, "-steps", 10**6, self.folder / "state.json", "-in", "in.deck", "-log", "none", *(["-var", *words[1:]] if words else []), cwd=self.out)
            assert json.loads((self.folder / "state.json").read_text())["time"] == approx(0.02, rel=2e-3)
            assert said["not_converted"] == []

    def test_averages_fit_into_their_periods(self):
        averages = ("1 1 ${n}", "5 120 ${n}", "1 600 ${n}", "1 ${n} ${n}", "6 10 ${n}", "${n} 1 ${n}", "5 10 600")
        fixes = "".join(f"fix a{k} all ave/time {average} c_k file post/a{k}.txt\n" for k, average in enumerate(averages))
        self.write("in.deck", "variable dt equal 2e-5\nvariable n equal 0.012/${dt}\n" + DECK + self.FAST.replace("timestep 2e-5", "timestep ${dt}") + f"compute k all ke\n{fixes}run ${{n}}\nrun 0\n")
        _, said = self.convert()
        assert (said["steps_factor"] > 1, said["not_converted"]) == (True, [])
        for folder in (self.folder, self.out):
            run(LAUNCHER, "-in", "in.deck", "-log", "none", cwd=folder)
        for k, average in enumerate(averages):
            before, after = ([int(row.split()[0]) for row in (folder / f"post/a{k}.txt").read_text().splitlines() if not row.startswith("#")] for folder in (self.folder, self.out))
            assert [round(0.012 / 2e-5 * step / after[-1]) for step in after] == before, average

    def test_counts_of_a_loop_over_steps(self):
        """A stride and its period, each worked out for each pass."""
        loop = ("variable dt index 2e-5 1e-5\nlabel again\nclear\n" + DECK + self.FAST.replace("timestep 2e-5", "timestep ${dt}") +
                "variable s equal 1e-4/${dt}\nvariable n equal 0.002/${dt}\ncompute k all ke\nfix a all ave/time ${s} 10 ${n} c_k\nthermo ${n}\nrun ${n}\nnext dt\njump SELF again\n")
        self.write("in.deck", loop)
        _, said = self.convert()
        assert said["steps_factor"] > 1
        assert said["not_converted"] == []
        run(LAUNCHER, "-in", "in.deck", "-log", "none", cwd=self.out)

    def test_loops_keep_their_time(self):
        """A loop over single steps follows the time step; one whose runs are longer keeps its number of passes."""
        start = "variable dt equal 2e-5\nvariable n equal 0.0002/${dt}\n" + DECK + self.FAST.replace("timestep 2e-5", "timestep ${dt}")
        for steps, time in ((1, 0.0002), ("${n}", 0.002)):
            self.write("in.deck", start + f"variable i loop ${{n}}\nlabel again\nrun {steps}\nnext i\njump SELF again\n")
            _, said = self.convert()
            assert said["steps_factor"] > 1
            assert self.run_converted(10**6)["time"] == approx(time, rel=0.02), steps
            assert said["not_converted"] == []

    def test_runs_of_single_steps_are_named(self):
        self.write("in.deck", DECK + self.FAST + "variable i loop 100\nlabel again\nrun 1\nnext i\njump SELF again\n")
        _, said = self.convert()
        assert re.search("the runs last .* s in all, 0.002 s in the original", said["not_converted"][0])

    def test_a_loop_of_single_steps_beside_longer_runs_is_named(self):
        """It follows a time step that the longer loop keeps from being changed: it lasts a sixth, hidden in the total."""
        loop = "variable {0} loop ${{n}}\nlabel {0}\nrun {1}\nnext {0}\njump SELF {0}\n"
        self.write("in.deck", "variable dt equal 2e-5\nvariable n equal 0.0002/${dt}\n" + DECK + self.FAST.replace("timestep 2e-5", "timestep ${dt}") + loop.format("i", 1) + loop.format("j", 2000))
        _, said = self.convert()
        assert any(re.search(r"in.deck:\d+: lasts .* s, 0.0002 s in the original", line) for line in said["not_converted"]), said["not_converted"]
        assert len(said["not_converted"]) == 1

    def test_a_step_by_a_formula(self):
        self.write("in.deck", "variable tenth equal 2e-4\nvariable dt equal ${tenth}*0.1\n" + DECK + self.FAST.replace("timestep 2e-5", "timestep ${dt}") + "variable n equal 0.01/${dt}\nrun ${n}\n")
        now, said = self.convert()
        assert re.search(r"variable dt equal \(\$\{tenth\}\*0.1\)/", now)
        assert self.run_converted(10**6)["time"] == approx(0.01, rel=2e-3)
        assert said["not_converted"] == []

    def test_a_deck_that_moves_nothing_keeps_its_step(self):
        self.write("in.deck", HEAD.format(types=1) + soft() + PAIR + REST.replace("fix integr all nve/sphere\n", "").replace("1e-5", "1") + "run 3\n")
        now, said = self.convert()
        assert "timestep 1\n" in now
        assert "run 3\n" in now
        self.run_converted(3)

    def test_step_numbers_are_named(self):
        self.write("in.deck", DECK + self.FAST + "variable s equal step\nrun 1000\n")
        _, said = self.convert()
        assert "number of the step" in "\n".join(said["not_converted"])


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
        assert (second["law"], re.search(r"law (\S+)", now)[1]) == ("out/in.second.law.h5", "in.second.law.h5")
        assert "in.first, converted" in (self.out / "conversion.md").read_text()
        assert "in.second, converted" in (self.out / "in.second.conversion.md").read_text()
        self.convert(deck="in.second")  # once more
        assert self.run_converted(100, deck="in.second")["particles"] == 50


class TestFolders(Convert):
    """No file is lost that another deck's conversion wrote."""

    def files(self):
        return {p: p.read_bytes() for p in self.out.rglob("*") if p.is_file()}

    def test_another_decks_folder_is_refused(self):
        self.write("in.deck", DECK + REST + RUN)
        self.convert()
        self.convert("--no-stretch")  # once more
        before = self.files()
        for other in ("in.other", "below/in.deck"):
            self.write(other, DECK + REST + RUN)
            said = self.convert(deck=other, code=2)
            assert "-o: it holds the conversion of another deck (../in.deck)" in said
            assert "name another folder" in said
        assert self.files() == before

    def test_files_of_another_origin_are_refused(self):
        self.write("in.deck", DECK + REST + RUN)
        for name in ("law.h5", "in.deck", "conversion.md"):
            self.write(f"out/{name}", "precious")
            assert name in self.convert(code=2)
            assert (self.out / name).read_text() == "precious"
            (self.out / name).unlink()
        self.write("out/notes.txt", "mine")
        self.convert()
        assert (self.out / "notes.txt").read_text() == "mine"

    def test_a_conversion_that_did_not_end_is_made_again(self):
        self.write("in.deck", DECK + REST + RUN)
        self.convert()
        page = self.out / "conversion.md"
        page.write_text(next(line for line in page.read_text().splitlines() if line.startswith("Original: ")))
        (self.out / "law.h5").unlink()
        self.convert()


class TestClumps(Convert):
    def test_clumps_yield_behind_their_spheres(self):
        self.write("two", "0 0 -0.001 0.002\n0 0 0.001 0.002\n")
        rest = REST.replace("particletemplate/sphere 15485863 atom_type 1 density constant 2500 radius constant 0.002",
                            "particletemplate/multisphere 15485863 atom_type 1 density constant 2500 nspheres 2 ntry 10000 spheres file two scale 1.0 type 1").replace("nve/sphere", "multisphere")
        self.write("in.deck", DECK + rest + RUN)
        now, said = self.convert()
        assert re.search(r"^pair_style gran model mpm .*bodyCompliance on\b", now, re.M)
        assert any("bodyCompliance: what a clump of 'fix multisphere' yields" in c["why"] for c in said["changes"])
        assert self.run_converted()["particles"] == 100


class TestDensities(Convert):
    DISK = "the mass of a disk one unit of length thick"

    def test_other_densities_are_named(self):
        self.write("in.deck", DECK + REST.replace("2500", "25000") + RUN)
        _, said = self.convert()
        assert "the materials file says 2500 kg/m^3, the deck's particles have 2.5e+04" in said["not_converted"][0]
        assert self.DISK not in said["not_converted"][0]

    def test_two_dimensions(self):
        head = HEAD.format(types=1).replace("units si", "units si\ndimension 2").replace("boundary f f f", "boundary f f p").replace("-0.005 0.2", "-0.001 0.001")
        bed = "create_atoms 1 single 0 0.01 0 units box\nset group all density {} diameter 0.002\nfix move all nve/sphere\nfix flat all enforce2d\nfix grav all gravity 9.81 vector 0 -1 0\ntimestep 1e-5\nrun 300\n"
        floor = WALL.format(type=1).replace("zplane", "yplane")
        self.write("in.deck", head + soft() + PAIR + floor + bed.format(2500))
        _, said = self.convert()
        told = said["not_converted"][0]
        assert "the deck's particles have 1.875e+06" in told  # 3/(4 R) of the material's
        assert self.DISK in told
        assert self.DISK in (self.out / "conversion.md").read_text()
        ran = run(LAUNCHER, "-in", "in.deck", "-log", "none", cwd=self.out).stdout
        assert "density 1.875e+06 to 1.875e+06" in ran
        assert self.DISK in ran
        density = re.search(r"a density of (\S+) kg/m\^3 in the deck", told)[1]
        self.write("in.deck", head + soft() + PAIR + floor + bed.format(density))
        _, said = self.convert()
        assert said["not_converted"] == []


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

    def test_lists_by_blanks_or_commas(self):
        """The same list in every command."""
        self.write("materials.toml", TWO_MATERIALS)
        self.write("in.deck", HEAD.format(types=2) + soft(2) + PAIR + WALL.format(type=2) + REST + RUN)
        answers = []
        for words in (["bead", "steel"], ["bead", ",steel"], ["bead steel"]):
            of = ["--materials-file", "materials.toml", "--materials", *words]
            table = self.mpm("table", "materials.toml", "--deck", "in.deck", "--materials", *words, "-o", "law.h5").stdout
            answers.append((json.loads(self.mpm("plan", "in.deck", *of, "--json").stdout)["pairs"], json.loads(self.mpm("soften", "in.deck", *of, "--json").stdout), re.search("wrote .*", table)[0]))
        assert all(answer == answers[0] for answer in answers)
        self.mpm("convert", "--materials", "bead,steel", "in.deck", "--materials-file", "materials.toml", "-o", "out")
        assert self.mpm("plan", "in.deck", "--radius=1e-3,2e-3", "--materials-file", "materials.toml", "--materials=bead,steel", "--json").stdout
        assert "DECK is required" in self.mpm("convert", "--materials", "bead,steel", "--materials-file", "materials.toml", code=2).stderr

    def test_a_deck_without_contacts_is_refused(self):
        self.write("in.deck", HEAD.format(types=1) + "atom_modify sort 0 0\nrun 0\n")
        assert "no contact model to convert" in self.convert(code=1)


class TestTangential(Convert):
    def test_plastic_is_offered(self):
        """Where a deck needs it, the command says so."""
        self.write("in.deck", DECK + REST + RUN)
        self.convert("--speed", "30")
        assert "`tangential plastic` suits this deck" in (self.out / "conversion.md").read_text()


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
        assert not list((self.out / "post").glob("*"))

    def test_neither_writes_a_file_nor_starts_a_program(self):
        """Absolute paths and the shell would reach behind any copy."""
        kept, other = self.folder / "kept.1", self.folder / "other"
        kept.write_text("kept\n")
        self.write("in.deck", DECK + REST + f"dump k all custom 1 {self.folder}/kept.* id\nshell touch {other}\n" + RUN)
        _, said = self.convert("--check")
        assert said["check"]["original"]["steps"] == 300
        assert (said["check"]["files_missing"], said["check"]["files_new"]) == ([], [])
        assert kept.read_text() == "kept\n" and not other.exists()
