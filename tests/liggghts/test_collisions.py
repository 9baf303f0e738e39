"""e of single collisions: one table of surfaces, bodies and speeds, against the law replayed outside LIGGGHTS, Thornton's closed form
or stock Hertz. All collisions under one law run in one process."""
import collections
import re

from pytest import approx, mark
from collisions import pair_deck, wall_deck
from harness import GLASS, POWDER, Deck, Material, mpm_law, plane_stl, properties, sphere_mass, thornton_closed_form, thornton_yield_velocity
from programs import material, mpm

RADIUS = 1.7e-3
# Error of e. The force is explicit and a step resolves the contact's reversal to 1/steps: the error falls with its square. The limits
# are three times or more what was measured, 0.005 at 10 steps and 0.00002 at 100
LIMITS = {10: 0.015, 20: 0.004, 50: 0.001, 100: 0.0003}
SPEEDS = (0.03, 0.2, 1.0, 5.0, 8.0, 12.0)  # from below the onset of yield (0.06 m/s on the wall) to an overlap of 7 % of R
FEW = (0.05, 1.0, 8.0)
RATIOS = (1.5, 2.0, 5.0, 20.0, 100.0, 300.0, 1000.0)  # V/V_y
DAMAGED = Material("m", 2500.0, 63.7e9, 0.3, 7e7)  # E*/Y = 1000: at V/V_y = 1000 the overlap is still 0.5 % of R
SOFT, STIFF = Material("soft", 1500.0, 9.1e9, 0.3, 1e8), Material("stiff", 1500.0, 9.1e12, 0.3, 1e30)
STEEL = Material("steel", 7800.0, 2.1e11, 0.3, 1e30)
HERTZ = "fix p6 all property/global coefficientRestitution peratomtypepair {} {}\n"

# name; replay: words of law_fixture before R* and m*; bodies: one on a wall, two against each other, and their radii over RADIUS;
# surface: a change of the deck; more: words of the wall
Bodies = collections.namedtuple("Bodies", "name replay materials radii surface more", defaults=((1.0, 1.0), None, ""))


def elastic(ratio):
    return Material("elastic", 1500.0, ratio * POWDER.youngs_modulus, POWDER.poisson_ratio, 1e30)


def change(text, *pairs):
    for old, new in pairs:
        assert old in text, (old, text)
        text = text.replace(old, new)
    return text


def mesh(deck, speed, move=0.0):
    """On a mesh; `move`: of the mesh towards the sphere, over the speed of approach. e is that seen from the mesh."""
    mover = f"fix m all move/mesh mesh cad linear 0. 0. {move * speed!r}\n" if move else ""
    return change(deck, ("fix w all", f"fix cad all mesh/surface file plane.stl type 1\n{mover}fix w all"), ("primitive type 1 zplane 0.0", "mesh n_meshes 1 meshes cad"),
                  (f"0.0 0.0 {-speed!r}", f"0.0 0.0 {(move - 1) * speed!r}"), ("vcm(all,z)", f"vcm(all,z)-{move * speed!r}"))


def other_type(deck, speed):
    """A rigid wall's material needs no law of its own; a mesh wall has the type of its mesh."""
    two = properties([POWDER, GLASS])
    return change(mesh(deck, speed), ("create_box 1", "create_box 2"), (properties([POWDER]), two), ("materials powder", "materials powder steel"), ("plane.stl type 1", "plane.stl type 2"))


def dumb_bell(deck, speed):
    """A rigid one that lands flat: it rebounds as one of its spheres does."""
    second = re.search(r"create_atoms 1 single (\S+) (.*)", deck)
    return change(deck, (second[0], f"{second[0]}\ncreate_atoms 1 single {float(second[1]) - 3 * RADIUS!r} {second[2]}"), ("fix i all nve/sphere", "fix i all rigid single"))


def frozen(deck, speed, one=0):
    """One of the pair has an infinite mass; the other, with the whole speed, its own."""
    velocity = {k: re.search(rf"velocity a{k} set (.*)", deck)[0] for k in (0, 1)}
    doubled = " ".join(repr(2 * float(v)) for v in velocity[1 - one].split()[3:])
    return change(deck, (velocity[one], f"velocity a{one} set 0.0 0.0 0.0"), (velocity[1 - one], f"velocity a{1 - one} set {doubled}"),
                  ("fix i all nve/sphere", f"fix z a{one} freeze\nfix i a{1 - one} nve/sphere"))


def frozen_second(deck, speed):
    return frozen(deck, speed, 1)


def periodic(deck, speed):
    """Across a boundary of the box; the spheres stand on the line of centres through it."""
    half, moved = 34.0 * RADIUS, re.findall(r"single (\S+) (\S+) (\S+) units", deck)
    for x, *rest in moved:
        deck = change(deck, (f"single {x}", f"single {float(x) + (half if float(x) < 0 else -half)!r}"))
    return re.sub(r"region box block \S+ \S+", f"region box block {-half!r} {half!r}", change(deck, ("boundary f f f", "boundary p p p")))


def hertz_pairs(deck, speed):
    """The wall alone has our model."""
    word = re.search(r"pair_style gran model mpm (tangential history)(.*)\n", deck)
    return change(deck, (word[0], f"pair_style gran model hertz {word[1]}\n"), ("fix p1", HERTZ.format(1, 1.0) + "fix p1"), ("zplane 0.0", f"zplane 0.0{word[2]}"))


def hertz_walls(deck, speed):
    return change(deck, ("fix w all wall/gran model mpm", "fix s all granulaw/stats\nfix w all wall/gran model hertz"), ("fix p1", HERTZ.format(1, 1.0) + "fix p1"))


WALL = Bodies("wall", ("powder", "wall"), (POWDER,))
PAIR = Bodies("pair", ("powder", "powder"), (POWDER, POWDER))
# glass by its law, and by its moduli as an `elastic` type
MIXED = [Bodies(f"{a.name} against {b.name}", ("powder", "glass"), (a, b))
         for other in (GLASS, Material("elastic", GLASS.density, GLASS.youngs_modulus, GLASS.poisson_ratio, 1e30)) for a, b in ((POWDER, other), (other, POWDER))]
UNLIKE = [Bodies(f"radii {a:g}:{b:g}", ("powder", "powder"), (POWDER, POWDER), (a, b)) for a, b in ((1, 2), (0.1, 1), (1, 0.1))]
DECLARED = [WALL._replace(name="wall rigid", more="wall rigid"), WALL._replace(name="wall deformable", replay=("powder", "powder"), more="wall deformable")]  # a like pair with R* = R
MODULI = [Bodies(f"moduli {'1:1000' if ratio > 1 else '1000:1'}, {pair[0].name} first", ("powder", str(elastic(ratio).e_star)), pair)
          for ratio in (1000.0, 0.001) for pair in ((POWDER, elastic(ratio)), (elastic(ratio), POWDER))]
SURFACES = [WALL._replace(name=name, surface=surface) for name, surface in (
    ("mesh", mesh), ("mesh that comes up at 0.4", lambda *deck: mesh(*deck, 0.4)), ("mesh that comes up at a sphere at rest", lambda *deck: mesh(*deck, 1.0)),
    ("mesh of another type", other_type), ("rigid dumb-bell", dumb_bell), ("hertz pairs", hertz_pairs))]
PARTNERS = [PAIR._replace(name="frozen partner", surface=frozen), PAIR._replace(name="frozen partner, the second", surface=frozen_second), PAIR._replace(name="periodic boundary", surface=periodic)]


class Collisions(Deck):
    def prepare(self):
        (self.folder / "plane.stl").write_text(plane_stl())

    def effective(self, bodies):
        radii = [RADIUS * r for r in bodies.radii]
        masses = [sphere_mass(r, m.density) for r, m in zip(radii, bodies.materials)]
        if len(bodies.materials) == 1:
            return radii[0], masses[0]
        return radii[0] * radii[1] / sum(radii), masses[1] if bodies.surface in (frozen, frozen_second) else masses[0] * masses[1] / sum(masses)

    def deck(self, model, bodies, speed, dt, steps, damping="elasticDamping off"):
        names = " ".join(dict.fromkeys(m.name for m in bodies.materials))  # one for each atom type
        words, run = damping + (f" law {self.law} materials {names}" if model == "mpm" else ""), f"run {2 * steps + 20}"
        if len(bodies.materials) == 1:
            deck = wall_deck(model, words, bodies.materials[0], RADIUS, speed, dt, wall_words=bodies.more).replace("run 120", run)
        else:
            deck = pair_deck(model, words, bodies.materials, [RADIUS * r for r in bodies.radii], speed, dt, run=run)
        return bodies.surface(deck, speed) if bodies.surface else deck

    def compare(self, table, model="mpm", relative=False, ranks=1, **deck):
        """`table`: (bodies, speed, expected e, duration, steps, limit)."""
        found = self.run_each([self.deck(model, bodies, speed, duration / steps, steps, **deck) for bodies, speed, _, duration, steps, _ in table], "SPEED", ranks=ranks)
        for (bodies, speed, expected, _, steps, limit), (after,) in zip(table, found):
            e = after / speed
            assert (e / expected if relative else e) == approx((1.0 if relative else expected), abs=limit), f"{model}, {bodies.name}, {speed} m/s, {steps} steps: e {e} for {expected}"

    def rows(self, cases, speeds, steps=(50,), limit=None, replay="mpm"):
        table = []
        for bodies in cases:
            for speed in speeds:
                e, duration, _ = self.fixture(replay, self.law, *bodies.replay, *self.effective(bodies), speed)
                table += [(bodies, speed, e, duration, n, limit or LIMITS[n]) for n in steps]
        return table

    def own_law(self):
        # of e: the step's error, 1e-3 at 50 steps, falls with its square
        table = [(bodies._replace(radii=radii), v, law["e"], law["contact_time_s"], 2000, 1e-6) for bodies, radii in zip(MIXED, ((1.0, 2.0), (2.0, 1.0))) for v in (0.05, 1.0, 5.0) for law in (
            mpm_law(self.law, "powder:glass", v, RADIUS, 2 * RADIUS),)]
        assert table[1][2] < 0.97
        for ranks in (1, 2):
            self.compare(table, ranks=ranks)


class TestCollisions(Collisions):
    def test_law(self):
        table = self.rows((WALL, PAIR), SPEEDS, LIMITS) + self.rows((*MIXED, *UNLIKE, *DECLARED, *SURFACES, *PARTNERS), FEW)
        self.compare(table + self.rows(MODULI, FEW, replay="elastic"))

    def test_default_damping(self):
        """e of the elastic part within 1 % of the law's."""
        self.compare(self.rows((WALL, PAIR, *MIXED), SPEEDS, limit=0.01), relative=True, damping="")

    def test_velocity_axis(self):
        """A law that latches the approach speed; the axis ends at 17 m/s on the wall."""
        self.fixture("write", self.law, "axis")
        table = self.rows((WALL, PAIR, *MIXED, *UNLIKE, *SURFACES[:3]), (0.03, 1.0, 5.0, 12.0)) + self.rows(PARTNERS, (1.0, 5.0, 12.0), (100,))
        self.compare(table)
        fastest = next(row for row in table if row[:2] == (WALL, 12.0))
        self.fixture("write", self.law)
        e, *_ = self.fixture("mpm", self.law, *WALL.replay, *self.effective(WALL), 12.0)
        assert abs(e / fastest[2] - 1) > 0.01  # else the table would pass without an axis

    def test_speeds_beyond_the_axis_are_counted(self):
        self.fixture("write", self.law, "axis")
        for speed, count in ((12.0, 0), (20.0, 1)):
            deck = wall_deck("mpm", f"law {self.law} materials powder beyondRange continue", POWDER, RADIUS, speed, 1e-8)
            text = self.run_deck(deck + '\nvariable d equal f_granulaw[11]\nprint "FAST ${d}"\n')
            assert ("1 contacts began faster than the law's velocity axis goes" in text) == (count == 1)
            assert self.result(text, "FAST")[0] == count

    def test_rate_law(self):
        self.fixture("write", self.law, "rate", RADIUS)
        self.compare(self.rows((WALL, *SURFACES[:2]), (1.0,), (100,)))

    def test_a_pairs_own_law(self):
        """/pair_laws: as `mpm law` has it, in either order of the types, on 1 and 2 ranks (the contact lies on the border of two)."""
        self.fixture("write", self.law, "pair_law")
        self.own_law()
        deck = self.deck("mpm", MIXED[0], 5.0, 1e-7, 1)
        rules = []
        for variant in ("axis", "pair_law"):
            self.fixture("write", self.law, variant)
            line = next(line for line in self.run_deck(deck).splitlines() if line.startswith("  1 powder -  2 glass"))
            rules.append(line.split()[5])
        assert rules == ["reduced", "two-body"]

    def thornton(self, bodies, e_star, yield_stress, speeds, limit, factor=1.6):
        r_eff, m_eff = self.effective(bodies)
        table = []
        for ratio in speeds:
            speed = ratio * thornton_yield_velocity(e_star, factor * yield_stress, r_eff, m_eff)
            _, duration, _ = self.fixture("thornton", e_star, factor * yield_stress, r_eff, m_eff, speed)
            table.append((bodies, speed, thornton_closed_form(ratio), duration, 50, limit))
        return table

    def test_thornton(self):
        """model thornton takes its moduli from the deck; of unlike ones the soft body yields."""
        m, yields = DAMAGED, DAMAGED.yield_stress
        table = []
        for bodies in (WALL, *SURFACES[:3], SURFACES[4]):
            table += self.thornton(bodies._replace(materials=(m,)), m.e_star, yields, RATIOS if bodies is WALL else RATIOS[2:4], 0.003)  # of e: 50 steps, LIMITS[50] of e > 0.35
        for bodies in (PAIR, UNLIKE[0], *PARTNERS):
            table += self.thornton(bodies._replace(materials=(m, m)), m.e_star / 2, yields, RATIOS, 0.003)
        both = SOFT.e_star * STIFF.e_star / (SOFT.e_star + STIFF.e_star)
        for pair in ((SOFT, STIFF), (STIFF, SOFT)):
            table += self.thornton(PAIR._replace(name=f"moduli {pair[0].name}:{pair[1].name}", materials=pair), both, SOFT.yield_stress, RATIOS[2:5], 0.003)
        self.compare(table, "thornton", relative=True)

    def test_thornton_takes_the_yield_pressure_of_the_deck(self):
        """`yieldPressure`: p_y over Y, on a wall without the word, too."""
        m = DAMAGED
        for factor in (2.5, 2.8):
            table = self.thornton(WALL._replace(materials=(m,)), m.e_star, m.yield_stress, RATIOS[1:4], 0.003, factor)
            table += self.thornton(PAIR._replace(materials=(m, m)), m.e_star / 2, m.yield_stress, RATIOS[1:4], 0.003, factor)
            self.compare(table, "thornton", relative=True, damping=f"elasticDamping off yieldPressure {factor}")


class TestComputed(Collisions):
    def test_a_pairs_own_law(self):
        """`mpm table --own-law` runs the solver with the two bodies, 140 CPU s where its cache is empty."""
        file = self.folder / "materials.toml"
        file.write_text("".join(material(m.name, m.density, m.youngs_modulus, m.poisson_ratio, m.yield_stress if m is POWDER else None) for m in (POWDER, GLASS)))
        pairs = [word for pair in ("powder:glass", "powder:powder", "glass:glass", "powder:wall") for word in ("--pair", pair)]
        done = mpm("table", file, *pairs, "--own-law", "--tolerance", "0.006", "-o", self.law, timeout=7000)  # composing costs 0.0065 of F
        assert "powder:glass: corrected by " in done.stdout + done.stderr
        self.own_law()
        self.compare([(bodies, v, law["e"], law["contact_time_s"], 50, LIMITS[50]) for bodies in (WALL, PAIR, UNLIKE[0]) for v in (0.05, 1.0, 5.0) for law in (
            mpm_law(self.law, ":".join(bodies.replay), v, RADIUS, None if bodies is WALL else bodies.radii[1] * RADIUS),)])


class TestExactly(Deck):
    """Decks that must agree with each other, whatever the law."""

    def prepare(self):
        (self.folder / "plane.stl").write_text(plane_stl())

    def words(self, materials="powder"):
        return f"law {self.law} materials {materials} elasticDamping off"

    def test_stock_walls_beside_our_pairs(self):
        """They are elastic."""
        (after,), = self.run_each([hertz_walls(wall_deck("mpm", self.words(), POWDER, RADIUS, 1.0, 2e-7), 1.0)], "SPEED")
        assert after == approx(1.0, abs=LIMITS[20])

    @mark.parametrize("model", ("mpm", "thornton"))
    def test_mesh_equals_primitive(self, model):
        ways = [wall_deck(model, self.words() if model == "mpm" else "", POWDER, RADIUS, 1.0, 2e-7, tangential=tangential) for tangential in ("history", "no_history", "off")]
        speeds = [speed for speed, in self.run_each([*ways, *(mesh(deck, 1.0) for deck in ways)], "SPEED")]
        # the same arithmetic but for the distance to the wall: rounding of 1e-16 R against an overlap of 1e-2 R
        assert [on_mesh / primitive for on_mesh, primitive in zip(speeds[3:], speeds[:3])] == approx([1.0] * 3, abs=1e-9)

    def test_elastic_is_hertz(self):
        """Half-way through a contact, where velocities still change: against stock hertz with e = 1, whose walls give way."""
        for make in (lambda model, words: wall_deck(model, words, STEEL, RADIUS, 1.0, 1e-7, wall_words="wall deformable" if model == "mpm" else ""),
                     lambda model, words: pair_deck(model, words, (STEEL, STEEL), (RADIUS, 2 * RADIUS), 1.0, 1e-7)):
            (ours,), (stock,) = self.run_each((make(*case).replace("fix p1", HERTZ.format(1, 1.0) + "fix p1").replace("run 120", "run 40")
                                               for case in (("mpm", self.words("elastic")), ("hertz", ""))), "SPEED")
            assert ours / stock == approx(1.0, abs=1e-6)  # the re-tabulated x^1.5

    def test_walls_inherit(self):
        """tangential_damping, tangentialStiffness, elasticDamping: said once. 0.03 m/s is elastic: damping shows."""
        words = f"law {self.law} materials powder elasticDamping 0.1 tangentialStiffness computed tangential_damping off"
        (inherited,), (own,) = self.run_each((wall_deck("mpm", words, POWDER, RADIUS, 0.03, 4e-7, wall_words=more) for more in ("", "elasticDamping off")), "SPEED")
        assert inherited / 0.03 < 0.8
        assert own / 0.03 > 0.99

    def test_cgs(self):
        """The same collision in cgs: speeds 100 times the numbers, energy 1e7 times. The law file stays in SI."""
        loss = 'variable d equal f_granulaw\nprint "LOSS ${d}"\n'
        for variant, model in ((), "mpm"), (("axis",), "mpm"), ((), "thornton"):
            self.fixture("write", self.law, *variant)
            words = self.words() if model == "mpm" else "elasticDamping 0.01"
            m = Material("powder", POWDER.density * 1e-3, POWDER.youngs_modulus * 10, POWDER.poisson_ratio, POWDER.yield_stress * 10)
            si, cgs = (self.run_deck(deck + loss) for deck in (wall_deck(model, words, POWDER, RADIUS, 3.0, 2e-7),
                                                               wall_deck(model, words, m, RADIUS * 100, 300.0, 2e-7).replace("units si", "units cgs")))
            # rounding: 1e-16 R in overlaps of 1e-2 R, 50 steps
            assert self.result(cgs, "SPEED")[0] / self.result(si, "SPEED")[0] == approx(100, abs=1e-8)
            assert self.result(cgs, "LOSS")[0] / self.result(si, "LOSS")[0] == approx(1e7, abs=1)
            said = [text[text.index("granulaw contacts"):text.index("Loop time")] for text in (si, cgs)]
            assert said[0] == said[1]  # the log is in SI
            assert len(said[0].splitlines()) > 4
