"""pair_style granulaw and fix wall/granulaw in Debian's LAMMPS, against LIGGGHTS with the plug-in, and against `mpm law`."""
import math
import os
import random
import re

import pytest
from pytest import approx, mark

if "GRANULAW_LMP" not in os.environ:
    pytest.skip("the styles for LAMMPS or the plug-in for LIGGGHTS are not built (Debian: liblammps-dev, libliggghts-dev)", allow_module_level=True)

from decks import Lammps, Liggghts, data_file, dump_line, frames, said
from programs import LAUNCHER, MPIRUN, InFolder, answer, run

LMP, STYLES, STOCK, FIXTURE = (os.environ[k] for k in ("GRANULAW_LMP", "GRANULAW_LAMMPS_STYLES", "GRANULAW_STOCK_LMP", "GRANULAW_FIXTURE"))
RADIUS, DENSITY, YOUNG, NU = 1.7e-3, 1500.0, 9.1e9, 0.3  # powder of law_fixture
MASS = 4 / 3 * math.pi * RADIUS**3 * DENSITY


class Scene(InFolder):
    def prepare(self):
        self.law = self.folder / "powder.h5"
        run(FIXTURE, "write", self.law, "axis")

    def play(self, engine, deck, ranks=1, expect_failure=False, program=None, env=None):
        (self.folder / "in.deck").write_text(deck)
        words = [MPIRUN, "--oversubscribe", "-np", ranks] if ranks > 1 else []
        program = program or (LMP if engine is Lammps else LAUNCHER)
        done = run(*words, program, "-in", "in.deck", "-log", "log", cwd=self.folder, code=None if expect_failure else 0, timeout=300, env=env)
        return done.stdout + done.stderr

    def refused(self, deck, *parts):
        text = self.play(Lammps, deck, expect_failure=True)
        errors = [line for line in text.splitlines() if line.startswith("ERROR")]
        assert len(errors) == 1, text[-2000:]
        for part in parts:
            assert part in errors[0], errors[0]

    def frames(self, engine, deck, ranks=1):
        self.play(engine, deck, ranks)
        return frames(self.folder / "d.dump")


def largest_difference(a, b):
    """Over all steps, atoms and columns, relative to the largest of its kind (x, v, F, omega, torque)."""
    assert a.keys() == b.keys()
    worst = 0.0
    for kind in range(5):
        columns = range(3 * kind, 3 * kind + 3)
        unit = max(abs(row[c]) for frame in a.values() for row in frame.values() for c in columns) or 1.0
        worst = max(worst, max(abs(a[s][i][c] - b[s][i][c]) / unit for s in a for i in a[s] for c in columns))
    return worst


class TestContactHistory(Scene):
    """Particles led through a random history of contact by both codes: motions, forces and torques to 1e-12 of the largest."""

    def led(self, engine, at_wall, tangential, rolling=None):
        chance = random.Random(7)
        second = 0.6 * RADIUS
        atoms = [(1, RADIUS, DENSITY, 0.0, 0.0, 1.0003 * RADIUS)] if at_wall else [(1, RADIUS, DENSITY, 0.0, 0.0, 0.0), (1, second, DENSITY, 0.0, 0.0, 1.0003 * (RADIUS + second))]
        box = ((-0.05, 0.05),) * 3
        text = engine.head() + f"read_data {data_file(self.folder / 'atoms', atoms, box)}\n"
        # LIGGGHTS takes the moduli of the wall's type; `tangential plastic` has a rigid wall
        stiffness = 8.0 / (2 * 2 * (2 - NU) * (1 + NU) / YOUNG) if at_wall and tangential == "history" else 0.0
        words = (f"shear_stiffness {stiffness!r} " if stiffness else "") + (f"rolling {rolling!r}" if rolling else "") if engine is Lammps else "beyondRange continue"
        more = {} if engine is Lammps else {"rolling": rolling, "moduli": [(YOUNG, NU)]}
        text += engine.law(self.law, ["powder"], "beyond continue " * (engine is Lammps) + (words if not at_wall or engine is Liggghts else ""), 0.4, tangential, 0.3, **more)
        if at_wall:
            text += engine.floor(words if engine is Lammps else "", **({} if engine is Lammps else {"tangential": tangential, "rolling": rolling}))
        text += "timestep 1e-6\ngroup m id {}\n".format(1 if at_wall else 2) + dump_line(engine)
        depth = 0.0
        for _ in range(12):  # in and out, never deeper than 1 % of the radius
            vz = chance.uniform(-2, 2)
            depth -= 17e-6 * vz
            if not 0 < depth < 0.01 * RADIUS:
                depth += 34e-6 * vz
                vz = -vz
            v = (chance.uniform(-1, 1), chance.uniform(-1, 1), vz)
            text += engine.spin("m", tuple(chance.uniform(-500, 500) for _ in range(3)))
            text += f"fix m m move linear {' '.join(map(repr, v))} units box\nrun 17\nunfix m\n"
        return self.frames(engine, text)

    @mark.parametrize("tangential", ("history", "plastic"))
    @mark.parametrize("at_wall", (False, True))
    def test_forces_are_those_of_liggghts(self, at_wall, tangential):
        by_lammps, by_liggghts = (self.led(engine, at_wall, tangential) for engine in (Lammps, Liggghts))
        # rounding of the normal and the lever: 2e-15 was measured
        difference = largest_difference(by_lammps, by_liggghts)
        print(f"at a wall: {at_wall}, {tangential}: largest difference {difference:.1e}")
        assert difference < 1e-12
        forces = [rows[1][6:9] for rows in by_lammps.values()]
        assert sum(abs(f[2]) > 0 for f in forces) > 50
        assert sum(abs(f[0]) > 0 for f in forces) > 50

    @mark.parametrize("at_wall", (False, True))
    def test_rolling_friction_is_epsd2(self, at_wall):
        by_lammps, by_liggghts, without = self.led(Lammps, at_wall, "history", 0.2), self.led(Liggghts, at_wall, "history", 0.2), self.led(Lammps, at_wall, "history")
        # at a wall LIGGGHTS's epsd2 takes omega (R - d/2)/(R - d); d is up to 1 % of R here
        assert largest_difference(by_lammps, by_liggghts) < (5e-3 if at_wall else 1e-12)
        assert largest_difference(by_lammps, without) > 1e-3


def bed(folder, count, seed=1, second=None, types=1):
    """A loose column of spheres over z = 0, sides periodic. `second`: radius of every other one."""
    chance, pitch, side = random.Random(seed), 2.3 * RADIUS, max(4, round((count / 3)**(1 / 3)))
    atoms = []
    for k in range(count):
        place = [(n + 0.5 + chance.uniform(-0.06, 0.06)) * pitch for n in (k % side, k // side % side, k // side**2)]
        atoms.append((1 + k % types, second if second and k % 2 else RADIUS, DENSITY, *place, chance.uniform(-0.2, 0.2), chance.uniform(-0.2, 0.2), chance.uniform(-0.4, 0.0)))
    height = (count // side**2 + 2) * pitch
    return f"read_data {data_file(folder / 'bed.data', atoms, ((0.0, side * pitch), (0.0, side * pitch), (-1e-3, height)), types)}\n"


LEDGER = ("compute L all pair granulaw\ncompute K all ke\ncompute T all erotate/sphere\nvariable k equal c_K+c_T\n" +
          "".join(f"variable l{k} equal c_L[{k}]+f_floor[{k}]\n" for k in range(1, 9)) + "thermo_style custom step v_k v_l1 v_l2 v_l3 v_l4 v_l5 v_l6\nthermo 100\n")
SAY = 'run 0 post no\nprint "K $(v_k:%.17g)"\nprint "L $(v_l1:%.17g) $(v_l2:%.17g) $(v_l3:%.17g) $(v_l4:%.17g)"\n'


class TestBed(Scene):
    def deck(self, engine, steps, words="", friction=0.3, damping=0.1, elastic_damping=0.001, tangential="history", count=60, read=None, dt=2e-6):
        text = engine.head(boundary="p p f") + (read or bed(self.folder, count))
        moduli = {} if engine is Lammps else {"moduli": [(YOUNG, NU)]}
        text += engine.law(self.law, ["powder"], words, friction, tangential, damping, elastic_damping, **moduli)
        # LIGGGHTS takes the moduli of the wall's type
        text += engine.floor(f"shear_stiffness {8.0 / (2 * 2 * (2 - NU) * (1 + NU) / YOUNG)!r}" if engine is Lammps else "")
        return text + engine.gravity + f"timestep {dt!r}\n" + (LEDGER if engine is Lammps else "") + (f"run {steps}\n" if steps else "")

    def test_bed_is_that_of_liggghts(self):
        """4000 steps of a bed that falls: the two codes add forces in the same order here."""
        lammps, liggghts = (self.frames(engine, self.deck(engine, 0) + dump_line(engine, 500) + "run 4000\n") for engine in (Lammps, Liggghts))
        energy = [sum(MASS * (v[3]**2 + v[4]**2 + v[5]**2) / 2 for v in f[4000].values()) for f in (lammps, liggghts)]
        assert energy[0] / energy[1] == approx(1.0, abs=1e-9)  # rounding that the collisions amplify; the same steps of 2000 spheres: 2e-16
        assert largest_difference({4000: lammps[4000]}, {4000: liggghts[4000]}) < 1e-6

    def test_ranks_agree(self):
        found = {ranks: self.play(Lammps, self.deck(Lammps, 3000) + SAY, ranks) for ranks in (1, 2, 4)}
        for ranks in (2, 4):
            for name, few in (("K", 1e-8), ("L", 1e-8)):  # sums in another order, amplified by collisions
                one, more = (said(found[k], name)[-1] for k in (1, ranks))
                assert more == approx(one, rel=few, abs=1e-20)
        assert all(v > 0 for v in (said(found[1], "L")[-1][0], said(found[1], "L")[-1][2]))

    @mark.parametrize("tangential", ("history", "plastic"))
    def test_a_restart_continues_to_the_bit(self, tangential):
        """Undamped: LAMMPS computes the first force of a run with the velocity of the full step, as for its own styles."""
        deck = self.deck(Lammps, 0, damping=0.0, elastic_damping=0.0, tangential=tangential)
        whole = self.play(Lammps, deck + "run 3000\n" + SAY)
        self.play(Lammps, deck + "run 2000\nwrite_restart r.bin\n")
        for ranks in (1, 2):
            again = (Lammps.head(boundary="p p f").replace("boundary p p f\n", "").replace("newton off\n", "newton off\n") + "read_restart r.bin\n" +
                     Lammps.floor(f"shear_stiffness {8.0 / (2 * 2 * (2 - NU) * (1 + NU) / YOUNG)!r}") + Lammps.gravity + "timestep 2e-6\n" + LEDGER + "run 1000\n" + SAY)
            text = self.play(Lammps, again, ranks)  # pair style, file and words are the restart file's
            for name in ("K", "L"):
                if ranks == 1:
                    assert said(text, name)[-1] == said(whole, name)[-1]
                else:
                    assert said(text, name)[-1] == approx(said(whole, name)[-1], rel=1e-8)

    def test_energy_is_that_of_the_ledger(self):
        """A frictionless bed: kinetic, potential and stored energy and the ledger have one sum."""
        deck = self.deck(Lammps, 0, friction=0.0, elastic_damping=0.0, count=30, dt=4e-7) + ("compute z all reduce sum z\n" f"variable e equal c_K+c_T+pe+f_floor+v_l1+{MASS * 9.81!r}*c_z\n"
                                                                           'thermo_style custom step v_e pe f_floor v_l1 c_z\nprint "E $(v_e:%.17g) $(v_l1:%.17g)"\n')
        # values in a print need a step that computed them
        deck = deck.replace('print "E', 'run 0\nprint "E') + 'run 10000\nprint "E $(v_e:%.17g) $(v_l1:%.17g)"\n'
        begin, end = said(self.play(Lammps, deck), "E")
        assert end[1] > 1e-6
        assert end[0] - begin[0] == approx(0.0, abs=2e-3 * end[1])  # Verlet's error at some 100 steps a contact


def lone(wall, words="", speed=2.0, units="si", scale=(1.0, 1.0, 1.0), more="", steps=3000, law="powder.h5", radius=RADIUS, pair="", after=""):
    """A sphere flies down onto a wall. scale: one unit of the deck, m, kg, s."""
    m, kg, s = scale
    return (Lammps.head(units=units, skin=1e-3 / m) + f"region box block {-0.02 / m!r} {0.02 / m!r} {-0.02 / m!r} {0.02 / m!r} {-0.02 / m!r} {0.02 / m!r} units box\ncreate_box 1 box\n"
            f"create_atoms 1 single 0 0 {(radius + 2.505e-6 * speed) / m!r} units box\nset group all diameter {2 * radius / m!r} density {DENSITY * m**3 / kg!r}\n"
            f"velocity all set 0 0 {-speed * s / m!r} units box\npair_style granulaw {law} {pair}\npair_coeff * * powder\n{more}fix w all wall/granulaw {wall} {words}\n"
            f"fix i all nve/sphere\ntimestep {1e-8 / s!r}\nvariable e equal vz[1]/{speed * s / m!r}\nvariable s equal vx[1]/{speed * s / m!r}\nthermo_style custom step\n{after}run {steps}\n"
            'print "e $(v_e:%.17g) $(v_s:%.17g)"\nprint "w $(f_w[1]:%.17g)"\n')


class TestStyles(Scene):
    def e(self, *words, **how):
        return said(self.play(Lammps, lone(*words, **how)), "e")[-1][0]

    def test_restitution_is_that_of_mpm_law(self):
        for speed in (0.02, 0.5, 2.0):
            expected = answer("law", self.law, "--pair", "powder:wall", "--radius", repr(RADIUS), "--velocity", repr(speed), "--json")["e"]
            found = self.e("zplane 0.0 NULL", "elastic_damping 0", speed=speed, steps=int(3000 * (2 / speed)**0.25))
            assert found == approx(expected, abs=2e-5)  # steps of 1e-8 s; mpm law's are finer

    def test_the_force_of_a_wall_has_its_place(self):
        """Values 9 to 11: a mechanism that these styles lack does not move them."""
        force = 'print "F $(f_w[9]:%.17g) $(f_w[10]:%.17g) $(f_w[11]:%.17g) $(fz[1]:%.17g)"\n'
        x, y, z, of_sphere = said(self.play(Lammps, lone("zplane 0.0 NULL", steps=400) + force), "F")[-1]
        assert x == y == 0 and z == of_sphere > 0.1

    def test_units(self):
        """The same in all units but for rounding."""
        si = self.e("zplane 0.0 NULL")
        assert si < 0.95
        for units, scale in (("cgs", (1e-2, 1e-3, 1.0)), ("micro", (1e-6, 1e-15, 1e-6)), ("nano", (1e-9, 1e-21, 1e-9))):
            assert self.e("zplane 0.0 NULL", units=units, scale=scale) == approx(si, abs=1e-10)

    def test_cylinders_and_regions_are_walls(self):
        """Planes of a region as zplane; a cylinder is flat for the law, inside and outside; a plane that moves as a sphere that is faster."""
        plane = self.e("zplane 0.0 NULL")
        assert self.e("region r", more="region r block -1 1 -1 1 0 1 units box open 2 open 1 open 3 open 4 open 6\n") == approx(plane, abs=1e-12)
        onto_side = lone("zcylinder 0.01").replace(f"single 0 0 {RADIUS + 2.505e-6 * 2.0!r}", f"single {0.01 - RADIUS - 5.01e-6!r} 0 0").replace("set 0 0 -2.0", "set 2.0 0 0").replace("vz[1]", "-vx[1]")
        from_outside = lone("zcylinder 0.01").replace(f"single 0 0 {RADIUS + 2.505e-6 * 2.0!r}", f"single {0.01 + RADIUS + 5.01e-6!r} 0 0").replace("set 0 0 -2.0", "set -2.0 0 0").replace("vz[1]", "vx[1]")
        for deck in (onto_side, from_outside):
            assert said(self.play(Lammps, deck), "e")[-1][0] == approx(plane, abs=1e-10)
        moving = lone("region r", speed=1.0, more="variable up equal 1.0*step*1e-8\nregion r plane 0 0 0 0 0 1 move NULL NULL v_up units box\n").replace("variable e equal vz[1]/1.0", "variable e equal (vz[1]-1)/2")
        assert said(self.play(Lammps, moving), "e")[-1][0] == approx(plane, abs=1e-4)  # LAMMPS finds a region's velocity by differences

    def test_a_wall_of_a_material_deforms(self):
        rigid, soft = (self.e("zplane 0.0 NULL", words) for words in ("", "of powder"))
        assert abs(rigid - soft) > 1e-3
        assert soft == approx(answer("law", self.law, "--pair", "powder:powder", "--radius", repr(RADIUS), "--radius2", "inf", "--velocity", "2.0", "--json")["e"], abs=1e-3)

    def test_a_rigid_body_has_the_mass_of_all(self):
        """Two spheres in a line fall end-on: as one sphere of twice the density."""
        run(FIXTURE, "write", self.folder / "mass.h5", "axis")
        two = lone("zplane 0.0 NULL").replace("set group all diameter", f"create_atoms 1 single 0 0 {3 * RADIUS + 5.01e-6!r} units box\nset group all diameter")
        two = two.replace("fix i all nve/sphere", "fix i all rigid single\nneigh_modify exclude group all all")
        one = lone("zplane 0.0 NULL").replace(f"density {DENSITY!r}", f"density {2 * DENSITY!r}")
        assert said(self.play(Lammps, two), "e")[-1][0] == approx(said(self.play(Lammps, one), "e")[-1][0], abs=1e-6)

    def test_pair_local_gives_contacts(self):
        deck = (Lammps.head() + f"read_data {data_file(self.folder / 'a', [(1, RADIUS, DENSITY, 0, 0, 0.0), (2, 0.6 * RADIUS, DENSITY, 0, 0, 1.599 * RADIUS, 0.1, 0, -1)], ((-0.02, 0.02),) * 3, 2)}\n"
                f"pair_style granulaw {self.law} friction 0.3\npair_coeff * * powder glass\npair_coeff 1 2 friction 0.5\nfix i all nve/sphere\ntimestep 1e-8\n"
                "compute c all pair/local dist eng force fx fy fz p1 p4 p5 p6 p7 p8\ndump d all local 100 contacts c_c[1] c_c[2] c_c[3] c_c[7] c_c[8] c_c[9] c_c[10] c_c[11] c_c[12]\n"
                'dump_modify d format float %.17g\nthermo_style custom step pe\nrun 100\nprint "C $(fz[2]:%.17g) $(pe:%.17g)"\n')
        force, pe = said(self.play(Lammps, deck), "C")[-1]
        distance, energy, by_normal, shear, size, normal, overlap, radius, largest = map(float, (self.folder / "contacts").read_text().splitlines()[-1].split())
        assert normal == approx(by_normal)
        assert overlap == approx(1.6 * RADIUS - distance, rel=1e-9)
        assert largest >= overlap * (1 - 1e-9)
        assert energy == approx(pe)
        assert abs(shear) == approx(size)
        assert 0 < size <= 0.5 * normal * (1 + 1e-9)
        assert force == approx(normal, rel=1e-2)
        assert 0.3 < radius / math.sqrt(0.375 * RADIUS * overlap) < 3

    def test_all_ways_to_load_it(self):
        """The launcher, also after `clear`; LD_PRELOAD under Debian's lmp; the entry that `plugin load` calls."""
        deck = lone("zplane 0.0 NULL")
        whole = said(self.play(Lammps, deck + "clear\n" + deck), "e")
        assert whole[0] == whole[1]
        assert said(self.play(Lammps, deck, program=STOCK, env={"LD_PRELOAD": STYLES}), "e")[0] == whole[0]
        assert "nrecognized pair style" in self.play(Lammps, deck, program=STOCK, expect_failure=True)
        names = run("nm", "-DC", "--defined-only", STYLES).stdout
        assert re.search(r"T lammpsplugin_init$", names, re.M)
        script = ("import ctypes, sys\nlib = ctypes.CDLL(sys.argv[1])\nclass P(ctypes.Structure):\n    _fields_ = [(n, ctypes.c_char_p) for n in 'version style name info author'.split()] + [('creator', ctypes.c_void_p), ('handle', ctypes.c_void_p)]\n"
                  "found = []\n@ctypes.CFUNCTYPE(None, ctypes.POINTER(P), ctypes.c_void_p)\ndef add(p, lmp):\n    found.append((p[0].style, p[0].name, bool(p[0].creator), p[0].handle))\n"
                  "lmp = (ctypes.c_char * 4096)()\nlib.lammpsplugin_init(lmp, ctypes.c_void_p(7), add)\nprint(found)\n")
        assert run("/usr/bin/python3", "-c", script, STYLES).stdout.strip() == str([(b"pair", b"granulaw", True, 7), (b"fix", b"granulaw/history", True, 7), (b"fix", b"wall/granulaw", True, 7)])

    def test_what_cannot_be_used_is_one_sentence(self):
        deck = lone("zplane 0.0 NULL")
        for old, new, *parts in (("powder.h5", "no.h5", "no.h5"), ("pair_coeff * * powder", "pair_coeff * * clay", "clay", "powder", "glass"), ("pair_coeff * * powder", "", "wall/granulaw", "pair_coeff"),
                                 ("powder.h5 ", "powder.h5 cohesion 1", "cohesion"), ("powder.h5 ", "powder.h5 friction -1", "friction", "-1"), ("powder.h5 ", "powder.h5 tangential both", "both", "plastic"),
                                 ("units si", "units lj", "lj", "micro"), ("newton off", "newton on", "newton off"), ("vel yes", "vel no", "vel yes"), ("zplane 0.0 NULL", "zplane 0.0", "value is missing"),
                                 ("zplane 0.0 NULL", "cone 0", "cone"), ("zplane 0.0 NULL", "region none", "none"),
                                 ("set 0 0 -2.0", "set 0 0 -500.0", "5 %", "beyond continue")):
            self.refused(deck.replace(old, new, 1), *parts)
        text = self.play(Lammps, lone("zplane 0.0 NULL", speed=100.0, pair="beyond continue").replace(f"density {DENSITY!r}", "density 2000.0"))
        assert re.search(r"WARNING: fix w wall/granulaw: \d+ contact steps deeper than the law's table", text)
        assert re.search(r"WARNING: fix w wall/granulaw: 1 contacts began faster than the law's velocity axis", text)
        assert re.search(r"WARNING: pair_style granulaw: particles of type 1 have density 2000 to 2000 kg/m\^3, 'powder' in powder.h5 has 1500", text)

    def test_particles_poured_in_are_known(self):
        """The box is empty when the run begins. Histories change place with atoms that leave."""
        (self.folder / "grain.mol").write_text(f"grain\n\n1 atoms\n\nCoords\n\n1 0 0 0\n\nTypes\n\n1 1\n\nDiameters\n\n1 {2 * RADIUS!r}\n\nMasses\n\n1 {MASS!r}\n")
        text = (Lammps.head(boundary="p p f") + "region box block 0 0.02 0 0.02 -0.001 0.05 units box\ncreate_box 1 box\n" + Lammps.law(self.law, ["powder"], friction=0.3) + Lammps.floor() +
                Lammps.gravity + "timestep 2e-6\nregion above block 0.003 0.017 0.003 0.017 0.02 0.045 units box\nmolecule grain grain.mol\n"
                "fix d all deposit 20 0 100 4711 region above mol grain near 0.0035 units box vz -1 -1\nregion corner block 0 0.008 0 0.008 0 0.02 units box\n" + LEDGER +
                "run 8000\nfix v all evaporate 100 2 corner 77\nrun 4000\n" + SAY)
        found = self.play(Lammps, text)
        assert said(found, "L")[-1][0] > 0
        assert re.search(r"Loop time .* with 20 atoms", found)
        assert re.search(r"Loop time .* with 1\d atoms", found)

    def test_grown_particles_stop_the_run(self):
        self.refused(lone("zplane 0.0 NULL", after="variable d equal 0.0034*(1+step*0.001)\nfix grow all adapt 1 atom diameter v_d\nneigh_modify every 1 check no\n").replace("sphere\n", "sphere 1\n", 1), "radius", "missed")
