"""Pairs with laws at several ratios of radii, composed of two bodies' laws: which one a contact follows, waves, deformable walls."""
import json
import math
import random
import re

from pytest import approx, mark
import test_energy
from collisions import pair_deck
from harness import POWDER, Deck, Material, head, mpm_law, properties, sphere_mass, worst

GUM = Material("gum", 1500.0, 9.1e9, 0.3, 1e30)  # elastic, as stiff as powder
RADIUS = 1.7e-3            # of the powder sphere
LARGE = 6 * RADIUS         # waves in a partner of this size do not come back in time
SPEEDS = (0.05, 1.0, 5.0)  # from below the onset of yield to 4 % of R*
TOLERANCE = 1e-6           # of e and of F_max: with the replay's own step
STEPS = 20000              # of the replay, in Hertz's contact time
MIXED = (POWDER, GUM)


def effective(a, b):
    return a * b / (a + b) if b != float("inf") else a


def step(radius, radius2, speed):
    """The replay's time step (replay.cpp) of a powder sphere against one of gum, or a wall of it."""
    mass = sphere_mass(radius, POWDER.density)
    if radius2 != float("inf"):
        mass = effective(mass, sphere_mass(radius2, GUM.density))
    e_star = effective(POWDER.e_star, GUM.e_star)
    return 2.87 * (mass**2 / (e_star**2 * effective(radius, radius2) * speed))**0.2 / STEPS


class Composed(Deck):
    def prepare(self):
        self.fixture("write", self.law, "by_size", "composed")

    def tool(self, radius2, speed):
        return mpm_law(self.law, "powder:gum", speed, RADIUS, radius2)

    def words(self, more=""):
        return f"law {self.law} materials powder gum elasticDamping off {more}"

    def pair(self, radius2, speed, duration, order=MIXED, more="", dt=None):
        """Two spheres. The powder's type is 1, whichever comes first."""
        dt = dt or step(RADIUS, radius2, speed)
        radii = (RADIUS, radius2) if order[0] is POWDER else (radius2, RADIUS)
        words = f"law {self.law} materials {order[0].name} {order[1].name} elasticDamping off {more}"
        return pair_deck("mpm", words, order, radii, speed, dt, run=f"run {int(1.2 * duration / dt)}")

    def wall(self, speed, duration, more="", wall_words="wall deformable"):
        """A powder sphere flies at a wall of gum."""
        dt = step(RADIUS, float("inf"), speed)
        z = RADIUS + 0.3 * dt * speed
        return (head(types=2, half=20 * RADIUS) + properties(list(MIXED)) +
                f"pair_style gran model mpm tangential history {self.words(more)}\npair_coeff * *\n"
                f"fix w all wall/gran model mpm tangential history primitive type 2 zplane 0.0 {wall_words}\n"
                f"create_atoms 1 single 0.0 0.0 {z!r} units box\nset group all diameter {2 * RADIUS!r} density {POWDER.density}\n"
                f"velocity all set 0.0 0.0 {-speed!r}\nfix i all nve/sphere\ntimestep {dt!r}\nthermo 100000\n"
                f"variable v equal vcm(all,z)\nrun {int(1.2 * duration / dt)}\n" 'print "SPEED ${v}"\n')


class TestDrops(Composed):
    """e and F_max as `mpm law` replays them from the same file."""

    def test_two_spheres(self):
        cases = [(order, speed) for order in (MIXED, MIXED[::-1]) for speed in SPEEDS]
        laws = [self.tool(LARGE, speed) for _, speed in cases]
        decks = [self.pair(LARGE, speed, law["contact_time_s"], order) for (order, speed), law in zip(cases, laws)]
        for ranks in (1, 2):  # the contact lies on the border of two
            for ((first, _), speed), law, (after,) in zip(cases, laws, self.run_each(decks, "SPEED", ranks=ranks)):
                assert after / speed == approx(law["e"], abs=TOLERANCE), f"{first.name} first, {speed} m/s, {ranks} ranks"
        assert laws[2]["e"] < 0.97

    def test_deformable_wall(self):
        laws = [self.tool(math.inf, speed) for speed in SPEEDS]
        decks = [self.wall(speed, law["contact_time_s"]) for speed, law in zip(SPEEDS, laws)]
        for speed, law, (after,) in zip(SPEEDS, laws, self.run_each(decks, "SPEED")):
            assert after / speed == approx(law["e"], abs=TOLERANCE), f"{speed} m/s"

    def test_largest_force(self):
        speed = 5.0
        law = self.tool(math.inf, speed)
        deck = self.wall(speed, law["contact_time_s"])
        watch = ("compute f all reduce max fz\nthermo 1\nthermo_style custom step c_f\n"
                 'thermo_modify format float %.12g norm no\nrun')
        text = self.run_deck(deck.replace("run", watch, 1))
        forces = [float(line.split()[1]) for line in text.splitlines() if len(line.split()) == 2 and line.split()[0].isdigit()]
        assert worst(forces) / law["force_max_N"] == approx(1.0, abs=TOLERANCE)

    def test_waves_off(self):
        """Then a composed law is its curve alone."""
        speed, mass = 5.0, sphere_mass(RADIUS, POWDER.density)
        both = effective(mass, sphere_mass(LARGE, GUM.density))
        pair = self.fixture("still", self.law, "powder", "gum", 1, 6, effective(RADIUS, LARGE), both, speed)
        wall = self.fixture("still", self.law, "powder", "gum", 1, "inf", RADIUS, mass, speed)
        assert pair[0] - self.tool(LARGE, speed)["e"] > 1e-3
        decks = [self.pair(LARGE, speed, pair[1], more="waves off"), self.wall(speed, wall[1], "waves off"),
                 self.wall(speed, wall[1], wall_words="wall deformable waves off")]
        for (after,), law in zip(self.run_each(decks, "SPEED"), (pair, wall, wall)):
            assert after / speed == approx(law[0], abs=TOLERANCE)
        text = self.run_deck(self.pair(LARGE, speed, 1e-5, more="waves maybe"), expect_failure=True)
        assert "'waves' has an unknown value: found 'maybe', allowed is on, off" in text

    def test_stretch(self):
        """The same e in S times the time."""
        speed, stretch = 5.0, 7.0
        law = self.tool(LARGE, speed)
        dt = step(RADIUS, LARGE, speed)
        deck = self.pair(LARGE, speed, stretch * law["contact_time_s"], more=f"stretch {stretch}", dt=stretch * dt)
        after, = self.result(self.run_deck(deck), "SPEED")
        assert after / speed == approx(law["e"], abs=TOLERANCE)


class TestSizes(Composed):
    """Which law a contact follows."""

    def collision(self, radius2, law_shares, speed=5.0):
        """e and time of spheres of RADIUS and radius2 under the law for the middle of these shares R_powder/(sum)."""
        share = 0.5 * sum(law_shares)
        radii = (share, 1 - share) if share else (1, "inf")
        mass = effective(sphere_mass(RADIUS, POWDER.density), sphere_mass(radius2, GUM.density))
        return self.fixture("collision", self.law, "powder", "gum", *radii, effective(RADIUS, radius2), mass, speed)

    def test_sizes_of_one_type_that_follow_two_laws(self):
        """Gum spheres of 1.1 and five times the powder's radius: the former follow the law of ratio 1, the latter that of 3."""
        speed, radii = 5.0, (1.1 * RADIUS, 5.0 * RADIUS)
        shares = [RADIUS / (RADIUS + r) for r in radii]
        bound = 0.5 * (0.5 + 0.25)  # half-way between the laws' shares
        expected = [self.collision(radii[0], (bound, shares[0])), self.collision(radii[1], (shares[1], bound))]
        assert abs(self.collision(radii[1], (bound + 1e-6, bound + 1e-6))[0] - expected[1][0]) > 0.01
        dt = step(RADIUS, radii[0], speed)
        text = head(types=2, half=40 * RADIUS) + properties(list(MIXED)) + (
            f"pair_style gran model mpm tangential history {self.words()}\npair_coeff * *\n")
        for k, radius2 in enumerate(radii):
            gap, x = RADIUS + radius2 + 0.3 * dt * speed, 20 * RADIUS * (2 * k - 1)
            text += (f"create_atoms 1 single {x!r} 0 0 units box\ncreate_atoms 2 single {x!r} 0 {gap!r} units box\n"
                     f"group a{k} id {2 * k + 1}\ngroup b{k} id {2 * k + 2}\nset group a{k} diameter {2 * RADIUS!r} density {POWDER.density}\n"
                     f"set group b{k} diameter {2 * radius2!r} density {GUM.density}\nvelocity a{k} set 0 0 {speed!r}\n")
        text += (f"fix i all nve/sphere\ntimestep {dt!r}\nthermo 100000\nvariable e0 equal vcm(b0,z)-vcm(a0,z)\n"
                 f"variable e1 equal vcm(b1,z)-vcm(a1,z)\nrun {int(1.3 * max(c[1] for c in expected) / dt)}\n" 'print "E ${e0} ${e1}"\n')
        for found, law in zip(self.result(self.run_deck(text), "E"), expected):
            assert found / speed == approx(law[0], abs=TOLERANCE)

    def test_the_time_step_is_that_of_the_law_followed(self):
        """Gum of 1.1 and of five times the powder's radius: the former's law is the stiffer one, beyond what the sizes make."""
        steps = []
        for radius2 in (1.1 * RADIUS, 5.0 * RADIUS):
            self.run_deck(self.pair(radius2, 1.0, 1e-7, more="stats s.json", dt=1e-8))
            (pair,) = [p for p in json.loads((self.folder / "s.json").read_text())["pairs"] if p["types"] == [1, 2]]
            mass = effective(sphere_mass(RADIUS, POWDER.density), sphere_mass(radius2, GUM.density))
            steps.append(pair["time_step_limit_of_law_s"] / math.sqrt(mass / effective(RADIUS, radius2)))
        assert steps[1] > 1.2 * steps[0]  # 1.39; without a law of its own 1

    @mark.parametrize("radius2, share", ((5.0 * RADIUS, 0.25), (10.0 * RADIUS, 0.0)))  # the law's own ratio, 3, and a deformable wall: it served no known particle
    def test_an_unforeseen_size(self, radius2, share):
        """A sphere that grows within a run, beyond what was known when the run began: its contacts follow the nearest law all the same."""
        speed, law = 5.0, self.collision(radius2, (share, share))
        dt = step(RADIUS, radius2, speed)
        steps = int(1.2 * law[1] / dt)
        z = RADIUS + radius2 + (steps + 0.3) * dt * speed  # they meet in the second half of the run
        text = (head(types=2, half=20 * radius2) + properties(list(MIXED)) +
                f"pair_style gran model mpm tangential history {self.words()}\npair_coeff * *\n"
                f"create_atoms 1 single 0 0 0 units box\ncreate_atoms 2 single 0 0 {z!r} units box\ngroup a id 1\ngroup b id 2\n"
                f"set group a diameter {2 * RADIUS!r} density {POWDER.density}\nset group b diameter {2.2 * RADIUS!r} density {GUM.density}\n"
                f"velocity a set 0 0 {speed!r}\nfix i all nve/sphere\ntimestep {dt!r}\nthermo 100000\nvariable s equal vcm(b,z)-vcm(a,z)\n"
                f'run {2 * steps} pre no every {steps} "set group b diameter {2 * radius2!r} density {GUM.density}"\n' 'print "SPEED ${s}"\n')
        after, = self.result(self.run_deck(text), "SPEED")
        assert after / speed == approx(law[0], abs=TOLERANCE)

    def test_wall_without_a_law(self):
        """No law for a deformable wall: that of the largest ratio."""
        self.fixture("write", self.law, "by_size", "runs")
        speed = 5.0
        mass = sphere_mass(RADIUS, POWDER.density)
        law = self.fixture("collision", self.law, "powder", "gum", 1, 3, RADIUS, mass, speed)
        after, = self.result(self.run_deck(self.wall(speed, law[1])), "SPEED")
        assert after / speed == approx(law[0], abs=TOLERANCE)

    def test_particles_change_places(self):
        """i and j, whichever comes first in LIGGGHTS's lists: the same motion to the last bit."""
        found = []
        for order in (0, 1):
            spheres = [(1, RADIUS, POWDER.density, "0 0 0", "0.3 0 4.0"), (2, LARGE, GUM.density, f"0.0004 0 {6.9988 * RADIUS!r}", "0 0 -1.0")]
            text = head(types=2, half=20 * RADIUS) + properties(list(MIXED), 0.3) + (
                f"pair_style gran model mpm tangential history {self.words()}\npair_coeff * *\n")
            for k, (kind, radius, density, x, v) in enumerate(spheres[::-1] if order else spheres):
                text += (f"create_atoms {kind} single {x} units box\ngroup g{k} id {k + 1}\n"
                         f"set group g{k} diameter {2 * radius!r} density {density}\nvelocity g{k} set {v}\n")
            text += ("fix i all nve/sphere\ntimestep 5e-9\nthermo 100000\nrun 3000\ndump d all custom 1 end.dump type x y z vx vy vz omegay\n"
                     'dump_modify d format "%d %.17g %.17g %.17g %.17g %.17g %.17g %.17g"\nrun 0\n')
            self.run_deck(text)
            found.append(sorted((self.folder / "end.dump").read_text().splitlines()[-2:]))
        assert found[0] == found[1]
        assert " 4 " not in found[0][0]  # they have met

    def test_restart(self):
        """In the middle of a contact, in and after the reversal: as without, to the last bit."""
        law = self.tool(LARGE, 5.0)
        dt = step(RADIUS, LARGE, 5.0)
        for part in (0.3, 0.7):
            first = int(part * law["contact_time_s"] / dt)
            deck = self.pair(LARGE, 5.0, law["contact_time_s"])
            begin, run, end = deck.partition("run ")
            dump = ("dump d all custom 1 end.dump id x y z vx vy vz\n"
                    'dump_modify d format "%d %.17g %.17g %.17g %.17g %.17g %.17g"\nrun 0\n')
            rest = f"run {int(law['contact_time_s'] / dt) - first + 500}\n"
            self.run_deck(f"{begin}run {first}\nwrite_restart half.restart\n{rest}{dump}")
            whole = (self.folder / "end.dump").read_text().splitlines()[-2:]
            (self.folder / "end.dump").unlink()
            again = (head(read="read_restart half.restart", skin=0.003) + properties(list(MIXED)) +
                     f"pair_style gran model mpm tangential history {self.words()}\npair_coeff * *\nfix i all nve/sphere\ntimestep {dt!r}\n")
            self.run_deck(again + rest + dump)
            assert (self.folder / "end.dump").read_text().splitlines()[-2:] == whole, part


class TestLedger(Composed):
    """Energy before = after + all that was lost."""

    def test_one_collision(self):
        """Work booked as waves equals the replay's, and the rest closes the balance: dissipated and waves are all that is lost."""
        speed, radius2 = 5.0, LARGE
        share = RADIUS / (RADIUS + radius2)
        mass = effective(sphere_mass(RADIUS, POWDER.density), sphere_mass(radius2, GUM.density))
        e, duration, _, _, waves = self.fixture("collision", self.law, "powder", "gum", share, 1 - share, effective(RADIUS, radius2), mass, speed)
        deck = self.pair(radius2, speed, duration, more="stats s.json")
        text = self.run_deck(deck + "variable w equal f_granulaw[19]\nvariable d equal f_granulaw\nvariable c equal f_granulaw[2][8]\n"
                             "thermo_style custom step f_granulaw f_granulaw[19] f_granulaw[2][8]\nthermo_modify norm no\nrun 0\n"
                             'print "LOST ${d} ${w} ${c}"\n')
        dissipated, booked, in_row = self.result(text, "LOST")
        lost = 0.5 * mass * speed**2 * (1 - e * e)
        assert booked / waves == approx(1.0, abs=1e-4)  # of first order in the replay
        # the work of loading with a velocity axis is a table, to 9e-5 of the work
        assert (dissipated + booked) / lost == approx(1.0, abs=9e-5)
        assert in_row == booked
        stats = json.loads((self.folder / "s.json").read_text())
        assert stats["pair"]["wave_dissipation_J"] / booked == approx(1.0, abs=1e-8)
        assert float(re.search(r"(?m)^  taken by waves, J +(\S+)", text)[1]) / booked == approx(1.0, abs=1e-5)  # six digits

    @mark.parametrize("friction, ranks", ((0.0, 1), (0.0, 2), (0.3, 1)))
    def test_bed(self, friction, ranks):
        """Powder and gum of several sizes on a deformable floor, with and without friction, on 1 and 2 ranks."""
        error, dissipated, waves, other, of_particles = self.balance(friction, ranks)
        assert abs(error) < 2e-5, (friction, ranks)
        assert waves > 5e-4 * dissipated
        assert of_particles / (waves + other) == approx(1.0, abs=1e-9)
        if friction == 0:  # what the booking of waves leaves to the measured work of the other forces
            assert abs(other) < 1e-3 * waves

    def balance(self, friction, ranks, steps=30000):
        """Mechanical + elastic energy + losses, less that at the beginning, over the losses; what the losses are."""
        self.data_file(self.folder / "bed.data")
        model = test_energy.model(f"law {self.law} materials powder gum energy on elasticDamping off", "history" if friction else "off", friction)
        model = model.replace(properties([POWDER], friction), properties(list(MIXED), friction)).replace("type 1 zplane 0.0", "type 2 zplane 0.0 wall deformable")
        total = test_energy.SUM + "variable w equal f_granulaw[19]\n"
        show = 'print "ENERGY ${e} ${d} ${s} ${o} ${w} ${a3}"\n'
        style = "thermo_style custom step ke c_rot f_granulaw f_granulaw[14] f_granulaw[15] f_granulaw[19] c_a[1] c_a[2] c_a[3]\nthermo_modify norm no\n"
        text = self.run_deck(test_energy.start() + model + total + style + "run 0\n" + show + f"run {steps}\n" + show, ranks=ranks)
        before, after = self.results(text, "ENERGY")
        mechanical, dissipated, stored, other, waves, of_particles = after
        lost = dissipated + other + waves
        return (mechanical + stored + lost - before[0]) / lost, dissipated, waves, other, of_particles

    def data_file(self, path):
        """As test_energy.data_file, with two materials and radii between 0.5 and 1 times its own."""
        test_energy.data_file(path)
        rng = random.Random(5)
        lines = path.read_text().replace("1 atom types", "2 atom types").splitlines()
        at = lines.index("Atoms") + 2
        for k in range(at, at + test_energy.SIDE**3):
            number, _, diameter, _, *x = lines[k].split()
            material = rng.choice(MIXED)
            lines[k] = " ".join([number, str(1 + MIXED.index(material)), repr(float(diameter) * rng.uniform(0.5, 1.0)), str(material.density), *x])
        path.write_text("\n".join(lines) + "\n")
