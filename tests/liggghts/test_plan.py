"""`liggghts-mpm -plan`: the scene that LIGGGHTS reads from a deck, without running it, and what `mpm plan` makes of it."""
import json
import math
import shutil

from pytest import approx, mark
from harness import Deck
from programs import LAUNCHER, MPIRUN, MPM, ROOT, mpm, run

BOX = """units si
hard_particles yes
atom_style granular
atom_modify map array
boundary f f f
newton off
communicate single vel yes
region box block -0.1 0.1 -0.1 0.1 0 0.5 units box
create_box 2 box
neighbor 0.002 bin
neigh_modify delay 0
fix m1 all property/global youngsModulus peratomtype 91e6 210e9
fix m2 all property/global poissonsRatio peratomtype 0.3 0.25
fix m3 all property/global coefficientRestitution peratomtypepair 2 0.5 0.4 0.4 0.6
fix m4 all property/global coefficientFriction peratomtypepair 2 0.4 0.4 0.4 0.4
pair_style gran model hertz tangential history
pair_coeff * *
timestep 1e-5
fix g all gravity 9.81 vector 0 0 -2
fix move all nve/sphere
"""
FLOOR = "fix floor all wall/gran model hertz tangential history primitive type 2 zplane 0.0\n"
SPHERES = """fix t all particletemplate/sphere 15485863 atom_type 1 density constant 1000 radius constant 0.002
fix d all particledistribution/discrete 32452843 1 t 1.0
region high block -0.05 0.05 -0.05 0.05 0.1 0.2 units box
"""
ONE = "create_atoms 1 single 0 0 0.3 units box\nset type 1 diameter 0.004 density 1000\n"


def insertion(amount, every="once", kind="pack", more=""):
    return (f"fix ins all insert/{kind} seed 49979687 distributiontemplate d vel constant 0 0 -0.5 {more}insert_every {every} "
            f"overlapcheck yes all_in yes {amount} region high\n")


def two_triangles(half=0.05, z=0.0, at=(0.0, 0.0)):
    x, y = at
    corners = [(x - half, y - half), (x + half, y - half), (x + half, y + half), (x - half, y + half)]
    text = "solid s\n"
    for a, b, c in ((0, 1, 2), (0, 2, 3)):
        text += "facet normal 0 0 1\nouter loop\n" + "".join(f"vertex {corners[k][0]} {corners[k][1]} {z}\n" for k in (a, b, c)) + "endloop\nendfacet\n"
    return text + "endsolid s\n"


def state_of(folder):
    """Every file below, with its bytes; every folder."""
    return {str(p.relative_to(folder)): p.read_bytes() if p.is_file() else None for p in sorted(folder.rglob("*"))}


def radii(source):
    return [source["radius_min"], source["radius_max"]]


class Planned(Deck):
    def scene(self, text, *words):
        (self.folder / "in.deck").write_text(text)
        run(LAUNCHER, "-plan", "scene.json", "-in", "in.deck", *words, cwd=self.folder)
        return json.loads((self.folder / "scene.json").read_text())

    def mpm(self, *words, code=0):
        return mpm(*words, code=code, cwd=self.folder)

    def refused(self, text, *wanted):
        """One sentence, and the exit code of bad input."""
        (self.folder / "in.deck").write_text(text)
        said = self.mpm("plan", "in.deck", code=1).stderr
        assert len(said.strip().splitlines()) == 1, said
        for part in wanted:
            assert part in said


class TestScenes(Planned):
    def test_settings_materials_and_runs(self):
        scene = self.scene(BOX + FLOOR + ONE + "run 300\ntimestep 2e-5\nrun 1000 upto\n")
        assert scene["units"] == "si"
        assert scene["gravity"][2] == approx(-9.81, abs=0.5e-12)
        assert scene["domain"] == {"low": [-0.1, -0.1, 0.0], "high": [0.1, 0.1, 0.5]}
        assert scene["periodic"] == [False] * 3
        assert [(t, m["youngs_modulus"], m["poisson_ratio"]) for t, m in scene["materials"]] == [(1, 91e6, 0.3), (2, 210e9, 0.25)]
        assert scene["restitution"] == 0.4
        assert [(r["steps"], r["time_step"], r["particles"], r["where"].split(":")[0]) for r in scene["runs"]] == [(300, 1e-5, 1, "in.deck"), (700, 2e-5, 1, "in.deck")]
        assert scene["time_step"] == 2e-5
        floor, = scene["walls"]
        assert (floor["id"], floor["type"], floor["model"], floor["box"]["low"], floor["box"]["high"]) == ("floor", 2, "hertz", [-0.1, -0.1, 0.0], [0.1, 0.1, 0.0])
        assert floor["where"] == f"in.deck:{BOX.count(chr(10)) + 1}"

    def test_particles_of_commands(self):
        more = ("create_atoms 2 single 0.01 0 0.2 units box\nset type 2 diameter 0.008 density 2000\nvelocity all set 0 3 -4\n"
                "run 10\nset type 1 diameter 0.006\ndisplace_atoms all move 0 0 0.1\nrun 10\n")
        one, two = sorted(self.scene(BOX + FLOOR + ONE + more)["sources"], key=lambda s: s["type"])
        assert (one["type"], two["type"], one["count"], two["count"]) == (1, 2, 1, 1)
        assert radii(one) == [0.002, 0.003]  # before and after the set
        assert radii(two) == [0.004, 0.004]
        assert two["density"] == approx(2000, abs=1e-9)
        assert one["speed"] == approx(5, abs=1e-12)
        assert one["centres"]["high"][2] == approx(0.4, abs=0.5e-12)  # 0.3, and then 0.1 more
        assert one["centres"]["low"] == [0.0, 0.0, 0.3]

    def test_insertions(self):
        deck = BOX + FLOOR + SPHERES
        source, = self.scene(deck + insertion("particles_in_region 100") + "run 1000\n")["sources"]
        assert (source["type"], radii(source), source["count"]) == (1, [0.002, 0.002], 100)
        assert source["density"] == approx(1000, abs=1e-9)
        assert (source["speed"], source["centres"]["low"], source["centres"]["high"]) == (0.5, approx([-0.048, -0.048, 0.102]), approx([0.048, 0.048, 0.198]))  # all in
        # as LIGGGHTS counts: every 400 steps from the first on, in two runs as in one
        for runs, expected in (("run 1000\n", 3), ("run 399\nrun 601\n", 3), ("run 0\nrun 1\n", 1), ("run 1\nrun 399\n", 1), ("run 1\nrun 400\n", 2)):
            scene = self.scene(deck + insertion("nparticles 5000 particlerate 5000", 400, "rate/region") + runs)
            assert sum(s["count"] for s in scene["sources"]) == approx(20 * expected, abs=1e-9), runs
        limited = self.scene(deck + insertion("nparticles 50 particlerate 5000", 400, "rate/region") + "run 1000\n")
        assert limited["sources"][0]["count"] == 50
        ended = self.scene(deck + insertion("nparticles 5000 particlerate 5000", 400, "rate/region") + "run 400\nunfix ins\nrun 1000\n")
        assert ended["sources"][0]["count"] == approx(20, abs=1e-9)
        # the same numbers as a run of LIGGGHTS gives
        text = self.run_deck(deck + insertion("nparticles 50 particlerate 5000", 400, "rate/region") + "run 1000\nvariable n equal atoms\nprint \"n ${n}\"\n")
        assert self.result(text, "n") == [50]
        # what does not fit into the region is not inserted
        full = self.scene(deck + insertion("particles_in_region 20000") + "run 10\n")["sources"][0]["count"]
        text = self.run_deck(deck + insertion("particles_in_region 20000") + "run 10\nvariable n equal atoms\nprint \"n ${n}\"\n")
        assert [full] == self.result(text, "n")
        assert full < 20000

    @mark.parametrize("words, speed", (("constant 0 3 -4", 5), ("uniform 0 3 -3 0 0 1", 5), ("gaussian 0 3 -1 0 0 1", 5)))
    def test_spread_velocities(self, words, speed):
        deck = BOX + FLOOR + SPHERES + insertion("particles_in_region 10").replace("constant 0 0 -0.5", words) + "run 10\n"
        assert self.scene(deck)["sources"][0]["speed"] == approx(speed, abs=1e-12), words

    def test_streams_start_at_their_face(self):
        (self.folder / "face.stl").write_text(two_triangles(0.04, 0.4))
        deck = (BOX + FLOOR + SPHERES + "fix face all mesh/surface/planar file face.stl type 1\n"
                "fix ins all insert/stream seed 49979687 distributiontemplate d nparticles 1000 particlerate 1000 vel constant 0 0 -1 insert_every 2000 overlapcheck yes "
                "all_in no insertion_face face\nrun 5000\n")
        scene = self.scene(deck)
        assert [w["id"] for w in scene["walls"]] == ["floor"]  # the face is none
        source, = scene["sources"]
        assert source["count"] == approx(60, abs=1e-9)  # 20 each at steps 1, 2001, 4001
        assert source["centres"]["high"][2] == approx(0.4, abs=1e-9)
        assert source["speed"] == 1

    def test_walls_and_their_motion(self):
        (self.folder / "plate.stl").write_text(two_triangles(0.05, 0.0))
        motions = {"still": "", "lifted": "linear 0 0 0.5", "turned": "rotate origin 0 0 0.1 axis 0 0 1 period 0.1", "long": "rotate origin 0.05 0 0.1 axis 0 1 0 period 0.1",
                   "wiggled": "wiggle amplitude 0 0 0.02 period 0.03", "conveyor": ""}
        meshes = "".join(f"fix {name} all mesh/surface file plate.stl type 2 move 0 0 0.1{' surface_vel 0.3 0.4 0' if name == 'conveyor' else ''}\n" for name in motions)
        meshes += f"fix plates all wall/gran model hertz tangential history mesh n_meshes {len(motions)} meshes {' '.join(motions)}\n"
        meshes += "".join(f"fix m_{name} all move/mesh mesh {name} {motion}\n" for name, motion in motions.items() if motion)
        primitives = {"shear": "zplane 0.0 shear x -0.7", "drum": "zcylinder 0.03 0 0 shear y 1.5", "up": "zcylinder 0.03 0 0 shear z 1.5", "pipe": "zcylinder 0.03 0.01 -0.02"}
        others = "".join(FLOOR.replace("floor", name).replace("zplane 0.0", wall) for name, wall in primitives.items())
        walls = {w["id"]: w for w in self.scene(BOX + ONE + meshes + others + "run 20000\n")["walls"]}  # 0.2 s

        def plate(name):
            return walls[name], walls[name]["box"]["low"], walls[name]["box"]["high"]

        still, low, high = plate("still")
        assert (still["speed"], still["drag_speed"], low, high) == (0, 0, [-0.05, -0.05, 0.1], [0.05, 0.05, 0.1])
        lifted, low, high = plate("lifted")
        assert (lifted["speed"], lifted["push_speed"]) == (approx(0.5, abs=1e-12), approx(0.5, abs=1e-12))
        assert lifted["lift"] == approx(0.1, abs=1.1e-5)  # likewise, and rounding
        assert (low[2], high[2]) == (approx(0.1, abs=1e-5), approx(0.2, abs=1e-5))  # a step of 1e-5 s at 0.5 m/s
        turned, low, high = plate("turned")
        assert turned["speed"] == approx(2 * math.pi / 0.1 * 0.05 * math.sqrt(2), abs=1e-9)  # of its corners
        assert high[0] == approx(0.05 * math.sqrt(2), abs=0.05 * 0.01)  # within strides of a twentieth of a radian
        # an arm whose corners lie at unlike distances: the fastest is that of its corners, not that of a box around it
        assert walls["long"]["speed"] == approx(2 * math.pi / 0.1 * 0.1, abs=1e-9)
        wiggled, low, high = plate("wiggled")
        assert wiggled["speed"] == approx(2 * math.pi / 0.03 * 0.02, abs=0.01)
        assert (low[2], high[2]) == (approx(0.08, abs=0.001), approx(0.12, abs=0.001))  # the mover adds velocities times strides, a twentieth of a radian of 0.02 m late
        assert (walls["conveyor"]["speed"], walls["conveyor"]["drag_speed"]) == (0, 0.5)
        assert (walls["shear"]["drag_speed"], walls["shear"]["lift"]) == (0.7, 0)
        # a turn, rad/s, about the vertical; a speed along the axis, up it
        assert (walls["drum"]["drag_speed"], walls["drum"]["lift"]) == (approx(1.5 * 0.03, abs=1e-15), 0)
        assert (walls["up"]["drag_speed"], walls["up"]["lift"]) == (approx(1.5, abs=1e-15), approx(0.5))
        assert [round(x, 12) for x in walls["pipe"]["box"]["low"] + walls["pipe"]["box"]["high"]] == [-0.02, -0.05, 0.0, 0.04, 0.01, 0.5]

    def test_words_of_our_models(self):
        """No law is there, and none is needed."""
        deck = (BOX.replace("model hertz tangential history", "model mpm tangential history law gone.h5 materials wax steel stretch 4 stats nowhere/s.json")
                + FLOOR.replace("model hertz tangential history primitive type 2 zplane 0.0", "model mpm tangential history primitive type 2 zplane 0.0 wall deformable"))
        deck = deck.replace("fix m3", "#")  # refused beside a law
        scene = self.scene(deck + ONE + "variable p equal f_granulaw\nthermo_style custom step atoms v_p\nrun 1000\n")
        assert [scene[k] for k in ("model", "law_file", "material_names", "stretch", "yield_pressure")] == ["mpm", "gone.h5", ["wax", "steel"], 4.0, 1.6]
        assert scene["walls"][0]["deformable"]
        assert scene["walls"][0]["model"] == "mpm"
        thornton = BOX.replace("model hertz tangential history", "model thornton tangential history yieldPressure 2.5")
        thornton += "fix m5 all property/global yieldStress peratomtype 1e7 1e7\n"
        assert self.scene(thornton + ONE + "run 1000\n")["yield_pressure"] == 2.5

    def test_clumps_have_their_bodys_mass(self):
        (self.folder / "two").write_text("0 0 -0.002 0.002\n0 0 0.002 0.003\n")
        deck = BOX + FLOOR + SPHERES + """fix c all particletemplate/multisphere 67867967 atom_type 1 density constant 1000 nspheres 2 ntry 10000 spheres file two scale 1.0 type 1
fix e all particledistribution/discrete 86028121 1 c 1.0
fix ins all insert/pack seed 49979687 distributiontemplate e vel constant 0 0 -0.5 insert_every once overlapcheck yes all_in yes particles_in_region 20 region high
fix body all multisphere
run 100
"""
        deck = deck.replace("fix move all nve/sphere\n", "")
        source, = self.scene(deck)["sources"]
        assert (radii(source), source["count"]) == ([0.002, 0.003], 40)
        ball = 4 / 3 * math.pi * 0.002**3
        body = 1000 * 4 / 3 * math.pi * (0.002**3 + 0.003**3)
        assert source["density"] * ball / body == approx(1, abs=0.05)  # LIGGGHTS counts the overlap of the spheres by 10,000 throws

    def test_decks_without_a_run(self):
        scene = self.scene(BOX + FLOOR + SPHERES)
        assert radii(scene["sources"][0]) == [0.002, 0.002]
        assert [w["id"] for w in scene["walls"]] == ["floor"]

    def test_radii_that_a_fix_changes(self):
        grow = "variable grown equal 0.004+0.002*step/1000\nfix a all adapt 1 atom diameter v_grown\n"
        source, = self.scene(BOX + FLOOR + ONE + grow + "run 1000\n")["sources"]
        assert source["radius_min"] == approx(0.002, abs=1e-5)
        assert source["radius_max"] == approx(0.003, abs=1e-5)


LONG = "".join(f" {k}" for k in range(1000))  # LIGGGHTS reads lines with a buffer that grows: 256, 2048 and so on


class TestLines(Planned):
    """A command is joined to the line of the file where it begins, whatever the lines before it are."""

    def commands(self, text, *words):
        return {(f"{c['file']}:{c['line']}", *c["words"][:2]) for c in self.scene(text, *words)["commands"]}

    def test_long_lines(self):
        deck, expected = BOX, set()
        for j, line in enumerate(("#{}", "variable a string \"{}\"", "print '{}' # ends", "thermo 10 # a note {} &\nand its second line", "thermo &\n10 # {}")):
            for k, length in enumerate((254, 255, 256, 257, 510, 511, 512, 1024, 2047, 2048, 2049, 3000)):
                before = len(line.format("").split("\n")[-1 if line.startswith("thermo &") else 0])
                text = line.format(LONG[:length - before])
                assert max(map(len, text.split("\n"))) == length
                deck += f"{text}\nvariable behind_{j}_{k} index 1\n"
                expected.add((f"in.deck:{deck.count(chr(10))}", "variable", f"behind_{j}_{k}"))
        deck += FLOOR + ONE + "run 10"  # no newline at the end
        expected |= {(f"in.deck:{deck.count(chr(10)) - 2}", "fix", "floor"), (f"in.deck:{deck.count(chr(10)) + 1}", "run", "10")}
        assert expected <= self.commands(deck)

    def test_lines_of_all_kinds(self):
        """Tabs, CRLF, continuations, branches, loops, jumps and includes."""
        (self.folder / "more.in").write_text(f"# {LONG}\n\n\tthermo \t&\n\t\t12\r\n#{LONG}\nvariable inner equal 1")
        deck = BOX + (f"#{LONG}\r\n\tvariable a index 1 2\r\n# a comment that goes on &\r\nthermo 77\r\nlabel again\n#{LONG}\ninclude\tmore.in\nvariable b index &\n"
                      f"  1 &\n  $a # {LONG} &\n and on\n\nif \"$a == 2\" then &\n  \"jump SELF out\" # {LONG}\nthermo 1$a\nnext a\njump SELF again # {LONG}\nthermo 5\n"
                      f"label out\n#{LONG}\n") + FLOOR + ONE + "run 10 every 5 \"thermo 3\"\n"
        lines = deck.split("\n")
        found = self.commands(deck)
        for words, line in ((("variable", "a"), "\tvariable a index 1 2\r"), (("include", "more.in"), "include\tmore.in"), (("variable", "b"), "variable b index &"),
                            (("thermo", "11"), "thermo 1$a"), (("fix", "floor"), FLOOR.strip()), (("run", "10"), "run 10 every 5 \"thermo 3\"")):
            assert [c[0] for c in found if c[1:] == words] == [f"in.deck:{lines.index(line) + 1}"], words
        assert {("more.in:3", "thermo", "12"), ("more.in:6", "variable", "inner")} <= found
        assert not {"77", "5"} & {c[2] for c in found if c[1] == "thermo"}  # in a comment, and jumped over

    def test_messages_name_the_line(self):
        for before in (f"# {LONG}\n", f"# {LONG}\r\n", f"thermo &\n 10 # {LONG}\n", f"variable a string '{LONG}'\n"):
            self.refused(BOX + before + "\nfix p all mesh/surface file gone.stl type 1\n", f"in.deck:{(BOX + before).count(chr(10)) + 2}:", "gone.stl")

    def test_a_branch_over_several_lines_is_named(self):
        start = BOX + FLOOR + ONE + "compute ke all ke\nthermo_style custom step c_ke\nrun 10\nvariable k equal c_ke\n"
        for branch in ('if &\n  "${k} > 1" &\n  then "run 5" else "run 7"\n', f'if "${{k}} > 1" then "run 5" else "run 7" # {LONG}\n'):
            assert self.scene(start + branch)["notes"] == [f"in.deck:{start.count(chr(10)) + 1}: the branch depends on a value of a run: it takes the side of the start"]
        skipped = start + 'jump SELF behind\nif "${k} > 1" then "run 5"\nlabel behind\nrun 1\n'
        assert self.scene(skipped)["notes"] == []


class TestWeakPoints(Planned):
    """Decks that do more than a run of two steps shows."""

    def test_nothing_is_written(self):
        (self.folder / "keep").write_text("as it was")
        (self.folder / "gone").write_text("as it was")
        deck = BOX + FLOOR + SPHERES + insertion("particles_in_region 10", 100) + """shell mkdir made
shell touch touched
shell mv keep moved
shell rm gone
shell rmdir made
log logged
print "text" append printed
fix p all print 1 "text" file fixed screen no
dump a all custom 1 dump.*.txt id x y z
dump v all custom/vtk 1 dump*.vtk id type x y z
restart 1 r.*.restart
variable atoms equal atoms
fix aver all ave/time 1 1 1 v_atoms file averages
run 10
write_restart saved.restart
write_data saved.data
run 1
"""
        before = state_of(self.folder)
        self.scene(deck, "-echo", "none")
        after = state_of(self.folder)
        for made in ("scene.json", "in.deck"):
            after.pop(made)
        assert before == after

    @mark.parametrize("end", ("run 10\n", "xyzzy\n"))
    @mark.parametrize("isolated", ("0", "1"))  # with a daemon of Open MPI, and without
    def test_open_mpi_takes_its_own_files_away(self, end, isolated):
        """They would stay where the process ends with its files closed, and stop later ones of the same number."""
        (self.folder / "in.deck").write_text(BOX + FLOOR + ONE + end)
        session = self.folder / "session"
        session.mkdir()
        run(LAUNCHER, "-plan", "scene.json", "-in", "in.deck", cwd=self.folder, code=..., env={"OMPI_MCA_orte_tmpdir_base": str(session), "OMPI_MCA_ess_singleton_isolated": isolated})
        assert [p for p in session.rglob("*") if not p.is_dir()] == []
        assert list(session.glob("*/*")) == []

    def test_what_the_deck_wrote_it_can_read(self):
        deck = BOX + FLOOR + ONE + "run 10\nwrite_restart saved.restart\nclear\n"
        again = BOX.replace("region box block -0.1 0.1 -0.1 0.1 0 0.5 units box\ncreate_box 2 box\n", "read_restart saved.restart\n")
        scene = self.scene(deck + again + FLOOR + "run 10\n")
        assert [r["particles"] for r in scene["runs"]] == [1, 1]
        assert not (self.folder / "saved.restart").exists()

    def test_lists_of_contacts_are_empty(self):
        """No contact acts, and no history is kept: decks that list contacts are planned all the same."""
        lists = ("compute l all pair/gran/local pos id force history contactArea\ncompute one all pair/gran/local delta\ncompute n all reduce sum c_l[20]\n"
                 "dump l all local 1 contacts c_l[1] c_l[30] c_one[1]\nthermo_style custom step c_n\n")
        assert len(self.scene(BOX + FLOOR + ONE + lists + "run 10\n")["runs"]) == 1

    def test_values_of_the_models_may_be_dumped(self):
        """Words and fixes of the models are there, though no contact acts."""
        deck = BOX.replace("hertz tangential history", "mpm tangential history law none.h5 materials a b confinement on energy on") + FLOOR + ONE
        deck += ("compute l all pair/gran/local contactRadius largestOverlap dissipatedEnergy\ndump l all local 1 contacts c_l[4] c_l[6]\n"
                 "dump p all custom 1 dump.* id f_granulaw[2] f_granulaw_confined[1] f_granulaw_confined[4]\nthermo_style custom step f_granulaw_confined[3]\nrun 10\n")
        assert len(self.scene(deck)["runs"]) == 1
        assert "'confinement on', which excludes 'stretch'" in self.mpm("stretch", "in.deck", "--speed", "1", code=1).stderr

    def test_dumps_of_contacts_change_no_plan(self):
        (self.folder / "plate.stl").write_text(two_triangles())
        start = BOX + FLOOR + ONE + "fix plate all mesh/surface file plate.stl type 2 move 0 0 0.1\nfix plates all wall/gran model hertz tangential history mesh n_meshes 1 meshes plate\n"
        dumps = ("pair/gran/local pos force\ndump {0} all local/gran/vtk 1 {0}*.vtp {0}", "pair/gran/local\ndump {0} all local/gran/vtk 1 {0}*.vtk {0}",
                 "pair/gran/local pos id force_normal torque contactArea delta contactPoint ms_id\ndump {0} all local/gran/vtk 1 {0}*.vtu {0}",
                 "wall/gran/local pos id\ndump {0} all local/gran/vtk 1 {0}*.vtp {0}", "wall/gran/local\ndump {0} all local 1 {0}*.txt c_{0}[1] c_{0}[2]")
        dumped = "".join(f"compute l{k} all {dump.format(f'l{k}')}\n" for k, dump in enumerate(dumps)) + "run 10\n" + "".join(f"undump l{k}\nuncompute l{k}\n" for k in range(len(dumps)))
        plain, dumped = self.scene(start + "run 10\nrun 10\n"), self.scene(start + dumped + "run 10\n")
        for scene in (plain, dumped):
            for run in scene["runs"]:
                run.pop("where")
            scene["files_read"], scene["files_written"], scene["commands"] = [], [], []
        assert dumped == plain

    def test_loops_over_a_universe(self):
        """LIGGGHTS keeps the value that is next in a file, which it renames while it reads it."""
        loop = 'variable speed universe 0.5 1.0 2.0\nvariable k uloop 3\nlabel again\nclear\n' + BOX + FLOOR + ONE + "velocity all set 0 0 -${speed}\nrun 10\nnext speed k\njump SELF again\n"
        scene = self.scene(loop)
        assert len(scene["runs"]) == 3
        assert max(s["speed"] for s in scene["sources"]) == 2
        assert sorted(p.name for p in self.folder.iterdir() if p.suffix != ".h5") == ["in.deck", "scene.json"]

    def test_folders_that_the_deck_makes_and_goes_to(self):
        (self.folder / "more.in").write_text(FLOOR + ONE)
        (self.folder / "there").mkdir()
        (self.folder / "there/steps.in").write_text("variable n index 7\n")
        moved = "shell mkdir made made/deeper\nshell cd made/deeper\nshell cd ..\nprint x file own\ninclude ../there/steps.in\nshell cd ../there\ninclude ../more.in\nshell cd ..\n"
        assert self.scene(BOX + moved + "run $n\n")["runs"][0]["steps"] == 7
        assert sorted(p.name for p in self.folder.iterdir() if p.suffix != ".h5") == ["in.deck", "more.in", "scene.json", "there"]

    def test_a_program_that_a_plan_does_not_start(self):
        (self.folder / "in.deck").write_text(BOX + "shell sed s/a/b/ in.deck > made.in\ninclude made.in\nrun 1\n")
        text = self.mpm("plan", "in.deck", code=1).stderr
        assert "made.in" in text and "'shell sed s/a/b/ in.deck > made.in' of line" in text
        assert not (self.folder / "made.in").exists()

    def test_files_that_the_deck_moves_and_removes(self):
        (self.folder / "there").write_text("variable a index 5\n")
        moved = 'print "variable b index 6" file made\nshell mv made other\nshell mv there elsewhere\ninclude other\ninclude elsewhere\n'
        scene = self.scene(moved + BOX + FLOOR + ONE + "run $a$b\n")
        assert [r["steps"] for r in scene["runs"]] == [56]
        assert (self.folder / "there").is_file()
        self.refused("shell rm there\ninclude there\n", "in.deck:2", "Cannot open input script there")
        self.refused('print "run 1" file made\nshell mv made other\ninclude made\n', "in.deck:3", "Cannot open input script made")

    def test_a_crash_names_its_command(self):
        """A variable that is computed from itself fills LIGGGHTS's stack."""
        self.refused("units si\n# a note\nvariable a equal v_a\nprint &\n $a\n", "in.deck:4", "LIGGGHTS was ended by signal 11")

    def test_scenes_behind_clear(self):
        two = "create_atoms 1 single 0 0 0.1 units box\n"
        first, second = self.scene(BOX + FLOOR + ONE + "run 10\nclear\n" + BOX + FLOOR + two + ONE + "run 20\n")["runs"]
        assert (first["particles"], second["particles"]) == (1, 2)

    def test_loops_that_wait(self):
        deck = BOX + FLOOR + ONE + 'compute ke all ke\nthermo_style custom step c_ke\nlabel settle\nrun 1\nvariable k equal c_ke\nif "${k} > -1" then "jump SELF settle"\nrun 77\n'
        scene = self.scene(deck)
        assert len(scene["runs"]) == 1003  # the first is new, and the second: its branch is noted
        assert scene["runs"][-1]["steps"] == 77  # the deck goes on behind the loop
        assert len(scene["notes"]) == 1 and "the loop waits for c_ke, which only a simulation has" in scene["notes"][0], scene["notes"]
        counted = BOX + FLOOR + ONE + "variable n loop 1500\nlabel again\nvariable dt equal 1e-6*$n\ntimestep ${dt}\nrun 2\nnext n\njump SELF again\n"
        scene = self.scene(counted)  # each run is new
        assert (len(scene["runs"]), scene["notes"]) == (1500, [])

    @mark.parametrize("boundary, wait", (("f f f", 'if "${force} < 2" then "jump SELF press"\n'), ("f f m", 'if "${force} > 2" then "jump SELF done"\njump SELF press\nlabel done\n')))
    def test_a_plate_that_waits_for_a_force(self, boundary, wait):
        """It passes the particles once; what comes behind the loop is planned."""
        (self.folder / "plate.stl").write_text(two_triangles(0.05, 0.31))
        press = ("fix plate all mesh/surface/stress file plate.stl type 2\nfix top all wall/gran model hertz tangential history mesh n_meshes 1 meshes plate\n"
                 "fix down all move/mesh mesh plate linear 0 0 -0.2\nlabel press\nrun 200\nvariable force equal abs(f_plate[3])\n")
        text = (BOX + FLOOR + ONE + press + wait + "unfix down\nrun 77\n").replace("boundary f f f", "boundary " + boundary)
        scene = self.scene(text)
        place = 1 + text[:text.index("if ")].count("\n")
        assert [note.split(": ")[0] for note in scene["notes"]] == [f"in.deck:{place}"]
        assert "the loop waits for f_plate[3], which only a simulation has" in scene["notes"][0]
        assert scene["left_loop"] == f"in.deck:{place}"
        assert scene["runs"][-1]["steps"] == 77
        plate = scene["walls"][-1]
        assert plate["speed"] == approx(0.2) and plate["push_speed"] == approx(0.2) and plate["lift"] == 0
        assert 0.299 < plate["box"]["low"][2] < 0.3  # the centre of the sphere, and no further
        planned = json.loads(self.mpm("plan", "in.deck", "--json", "--speed", "1").stdout)
        assert planned["fall_m"] == approx(0.298) and "'plate'" in planned["not_bounded"][0]

    def test_presses_know_their_solid_volume(self):
        """810 spheres of 2 mm below a lid that ends 30 mm above the floor; 1000 in a periodic box that shrinks from 40 to 35 mm; in both by their volume."""
        ball = 4 / 3 * math.pi * 0.002**3
        sides = "".join(f"fix {a}{k} all wall/gran model hertz tangential history primitive type 2 {a}plane {v}\n" for a in "xy" for k, v in enumerate((-0.02, 0.02)))
        lid = ("fix lid all mesh/surface/stress file lid.stl type 2\nfix top all wall/gran model hertz tangential history mesh n_meshes 1 meshes lid\n"
               "fix down all move/mesh mesh lid linear 0 0 -1\n")
        (self.folder / "lid.stl").write_text(two_triangles(0.02, 0.05))
        grain = "set group all diameter 0.004 density 1000\n"
        die = BOX.replace("-0.1 0.1 -0.1 0.1 0 0.5", "-0.02 0.02 -0.02 0.02 0 0.1") + "lattice sc 0.004\nregion r block -0.018 0.018 -0.018 0.018 0.002 0.04 units box\n" + sides + FLOOR
        periodic = BOX.replace("boundary f f f", "boundary p p p").replace("-0.1 0.1 -0.1 0.1 0 0.5", "0 0.04 0 0.04 0 0.04").replace("fix g all gravity 9.81 vector 0 0 -2\n", "")
        shrinks = "lattice sc 0.004\ncreate_atoms 1 box\n" + grain + "fix d all deform 1 x vel -0.1 y vel -0.1 z vel -0.1 remap x units box\nrun 5000\n"
        for text, volume, needed in ((die + lid + "create_atoms 1 region r\n" + grain + "run 2000\n", 810 * ball / (0.04**2 * 0.03), False),
                                     (die + "create_atoms 1 region r\n" + grain + "run 2000\n", 0, False), (periodic + shrinks, 1000 * ball / 0.035**3, True)):
            assert self.scene(text)["solid_volume"] == approx(volume, rel=1e-9)
            pressing = json.loads(self.mpm("plan", "in.deck", "--json", "--speed", "1", code=...).stdout)["pressing"]
            said = self.mpm("plan", "in.deck", "--speed", "1", code=...).stdout
            assert (pressing is None) == (volume == 0) == ("pressed:" not in said) and (not pressing or pressing["needs_confinement"] == needed)
            assert ("say 'confinement auto'" in said) == needed

    def test_a_long_way_takes_few_runs(self):
        (self.folder / "plate.stl").write_text(two_triangles(0.05, 0.49))
        scene = self.scene(BOX + FLOOR + ONE + "fix plate all mesh/surface/stress file plate.stl type 2\nfix top all wall/gran model hertz tangential history mesh n_meshes 1 meshes plate\n"
                           "fix down all move/mesh mesh plate linear 0 0 -0.01\nlabel press\nrun 20\nvariable force equal abs(f_plate[3])\nif \"${force} < 2\" then \"jump SELF press\"\n")
        assert len(scene["runs"]) < 300  # of 95,000

    def test_branches_on_a_runs_value_are_named(self):
        start = BOX + FLOOR + ONE + "compute ke all ke\nthermo_style custom step c_ke\nrun 10\nvariable k equal c_ke\nvariable twice equal 2*v_k\n"
        line = start.count("\n") + 1
        for condition in ("${k} > 1", "${twice} > 1"):
            scene = self.scene(start + f'if "{condition}" then "run 5" else "run 7"\n')
            assert [r["steps"] for r in scene["runs"]] == [10, 7], condition
            assert scene["notes"] == [f"in.deck:{line}: the branch depends on a value of a run: it takes the side of the start"], condition
        scene = self.scene(start + 'variable s equal step\nif "${s} > 3" then "run 5" else "run 7"\n')
        assert ([r["steps"] for r in scene["runs"]], scene["notes"]) == ([10, 5], [])

    def test_meshes_that_forces_move_ask_for_their_speed(self):
        (self.folder / "plate.stl").write_text(two_triangles(0.05, 0.1))
        (self.folder / "in.deck").write_text(
            BOX + FLOOR + ONE + "fix plate all mesh/surface/stress/servo file plate.stl type 2 com 0 0 0.1 axis 0 0 -1 vel_max 0.1 target_val 1 ctrlPV force kp 1\n"
            "fix plates all wall/gran model hertz tangential history mesh n_meshes 1 meshes plate\nrun 1000\n")
        asked = json.loads(self.mpm("plan", "in.deck", "--json").stdout)["asks_for"]
        assert any(q["option"] == "--speed V" and "mesh/surface/stress/servo" in q["what"] for q in asked), asked

    def test_fixes_that_give_velocities_ask_for_them(self):
        fixes = ("addforce 0 0 1", "setforce 0 0 1", "aveforce 0 0 1", "drag 0 0 0 1 1", "nve/limit absolute 1")
        deck = BOX.replace("fix move all nve/sphere\n", "") + FLOOR + ONE + "".join(f"fix f{k} all {fix}\n" for k, fix in enumerate(fixes)) + "run 10\n"
        asked = self.scene(deck)["unknown_speeds"]
        for fix in fixes:
            assert any(fix.split()[0] in text and "in.deck:" in text for text in asked), (fix, asked)

    def test_liggghts_errors_are_passed_on(self):
        last = BOX.count("\n") + 1
        self.refused(BOX + "xyzzy 1\n", f"in.deck:{last}", "Unknown command: xyzzy 1")
        self.refused(BOX + "fix p all mesh/surface file gone.stl type 1\nrun 1\n", f"in.deck:{last}", "gone.stl")
        self.refused(BOX + "include gone\n", f"in.deck:{last}", "gone")
        self.refused(BOX + "run ${n}\n", f"in.deck:{last}", "Substitution for illegal variable", "--var NAME VALUE")
        self.refused(BOX + "pair_style gran model mpm tangential history law x materials wax\nfix w all wall/gran model mpm tangential history primitive type 1 zplane 0 stretc 2\n",
                     f"in.deck:{last + 1}", "did you mean 'stretch'?")
        self.refused("units si\n# a comment\nread_restart bed.restart\n", "in.deck:3", "the restart file is not there", "bed.restart")
        included = self.folder / "more"
        included.write_text("\n\nthermo xyzzy\n")
        self.refused(BOX + "include more\n", "more:3")

    def test_a_plan_needs_one_rank(self):
        (self.folder / "in.deck").write_text(BOX + ONE + "run 1\n")
        done = run(MPIRUN, "--oversubscribe", "-np", 2, LAUNCHER, "-plan", "scene.json", "-in", "in.deck", cwd=self.folder, code=None)
        assert "-plan needs one rank" in done.stdout + done.stderr

    def test_paths_count_from_the_deck_or_from_here(self):
        (self.folder / "meshes").mkdir()
        (self.folder / "decks" / "meshes").mkdir(parents=True)
        (self.folder / "meshes" / "here.stl").write_text(two_triangles(0.05, 0.1))
        (self.folder / "decks" / "meshes" / "there.stl").write_text(two_triangles(0.05, 0.1))
        for mesh in ("here", "there"):
            (self.folder / "decks" / "in.paths").write_text(
                BOX + ONE + f"fix p all mesh/surface file meshes/{mesh}.stl type 1\nfix w all wall/gran model hertz tangential history mesh n_meshes 1 meshes p\nrun 10\n")
            plan = json.loads(self.mpm("plan", "decks/in.paths", "--json", "--materials-file", ROOT / "examples/hopper/materials.toml", "--materials", "wax").stdout)
            assert len(plan["pairs"]) == 1, mesh

    def test_a_missing_launcher_is_named(self, monkeypatch):
        (self.folder / "in.deck").write_text(BOX)
        done = mpm("plan", "in.deck", cwd=self.folder, code=1, env={"GRANULAW_LAUNCHER": "/gone/liggghts-mpm"})
        assert "/gone/liggghts-mpm: cannot be started" in done.stderr
        alone = self.folder / "mpm"
        shutil.copy(MPM, alone)
        monkeypatch.delenv("GRANULAW_LAUNCHER")
        done = run(alone, "plan", "in.deck", cwd=self.folder, code=1)
        assert done.stderr.startswith("mpm: LIGGGHTS reads the deck, and liggghts-mpm is not beside this program")


class TestUnits(Planned):
    def test_a_deck_in_cgs_gives_the_plan_of_si(self):
        deck = BOX + FLOOR + SPHERES + insertion("particles_in_region 100") + "fix y all property/global yieldStress peratomtype 1e6 1e9\nrun 1000\n"
        swaps = (("units si", "units cgs"), ("block -0.1 0.1 -0.1 0.1 0 0.5", "block -10 10 -10 10 0 50"), ("block -0.05 0.05 -0.05 0.05 0.1 0.2", "block -5 5 -5 5 10 20"),
                 ("91e6 210e9", "91e7 210e10"), ("1e6 1e9", "1e7 1e10"), ("gravity 9.81", "gravity 981"), ("density constant 1000 radius constant 0.002", "density constant 1 radius constant 0.2"),
                 ("constant 0 0 -0.5", "constant 0 0 -50"), ("neighbor 0.002", "neighbor 0.2"))
        cgs = deck
        for si, other in swaps:
            assert si in cgs
            cgs = cgs.replace(si, other)
        plans = []
        for text in (deck, cgs):
            (self.folder / "in.deck").write_text(text)
            plans.append(json.loads(self.mpm("plan", "in.deck", "--json").stdout))
        a, b = plans
        assert len(a["pairs"]) == 2
        for key in ("radius_m", "mass_kg"):
            for x, y in zip(a[key], b[key]):
                assert x / y == approx(1, abs=1e-12)
        for p, q in zip(a["pairs"], b["pairs"]):
            for key in ("speed_max_m_per_s", "time_step_s", "overlap_over_radius_max"):
                assert p[key] / q[key] == approx(1, abs=1e-12), key
        ours = BOX.replace("model hertz tangential history", "model mpm tangential history law x materials a a").replace("hard_particles yes\n", "")
        self.refused(ours.replace("units si", "units micro") + ONE + "run 1\n", "micro", "si")
        self.refused(BOX.replace("units si", "units lj").replace("hard_particles yes\n", "") + ONE + "run 1\n", "units lj", "units si")
