"""e of single collisions in LIGGGHTS: one table of laws, bodies and speeds, against the law replayed outside LIGGGHTS and Thornton's
closed form. All collisions under one law run in one process."""
import collections

from pytest import approx
from collisions import pair_deck, wall_deck
from harness import GLASS, POWDER, Material, sphere_mass, thornton_closed_form, thornton_yield_velocity
from trials import Trial

RADIUS = 1.7e-3
# Error of e. The force is explicit and a step resolves the contact's reversal to 1/steps: the error falls with its square. The limits
# are three times or more what was measured, 0.005 at 10 steps and 0.00002 at 100
LIMITS = {10: 0.015, 20: 0.004, 50: 0.001, 100: 0.0003}
SPEEDS = (0.03, 0.2, 1.0, 5.0, 8.0, 12.0)  # from below the onset of yield (0.06 m/s on the wall) to an overlap of 7 % of R
FEW = (0.05, 1.0, 8.0)
RATIOS = (1.5, 2.0, 5.0, 20.0, 100.0, 300.0, 1000.0)  # V/V_y
DAMAGED = Material("m", 2500.0, 63.7e9, 0.3, 7e7)  # E*/Y = 1000: at V/V_y = 1000 the overlap is still 0.5 % of R
SOFT, STIFF = Material("soft", 1500.0, 9.1e9, 0.3, 1e8), Material("stiff", 1500.0, 9.1e12, 0.3, 1e30)

# name; replay: words of law_fixture before R* and m*; bodies: one on a wall, two against each other, and their radii over RADIUS;
# more: words of the wall
Bodies = collections.namedtuple("Bodies", "name replay materials radii more", defaults=((1.0, 1.0), ""))


def elastic(ratio):
    return Material("elastic", 1500.0, ratio * POWDER.youngs_modulus, POWDER.poisson_ratio, 1e30)


WALL = Bodies("wall", ("powder", "wall"), (POWDER,))
PAIR = Bodies("pair", ("powder", "powder"), (POWDER, POWDER))
# glass by its law, and by its moduli as an `elastic` type
MIXED = [Bodies(f"{a.name} against {b.name}", ("powder", "glass"), (a, b))
         for other in (GLASS, Material("elastic", GLASS.density, GLASS.youngs_modulus, GLASS.poisson_ratio, 1e30)) for a, b in ((POWDER, other), (other, POWDER))]
UNLIKE = [Bodies(f"radii {a:g}:{b:g}", ("powder", "powder"), (POWDER, POWDER), (a, b)) for a, b in ((1, 2), (0.1, 1), (1, 0.1))]
DECLARED = [Bodies("wall rigid", ("powder", "wall"), (POWDER,), more="wall rigid"),
            Bodies("wall deformable", ("powder", "powder"), (POWDER,), more="wall deformable")]  # softer: a like pair with R* = R
MODULI = [Bodies(f"moduli {'1:1000' if ratio > 1 else '1000:1'}, {pair[0].name} first", ("powder", str(elastic(ratio).e_star)), pair)
          for ratio in (1000.0, 0.001) for pair in ((POWDER, elastic(ratio)), (elastic(ratio), POWDER))]


class TestRestitution(Trial):
    def effective(self, bodies):
        radii = [RADIUS * r for r in bodies.radii]
        masses = [sphere_mass(r, m.density) for r, m in zip(radii, bodies.materials)]
        if len(bodies.materials) == 1:
            return radii[0], masses[0]
        return radii[0] * radii[1] / sum(radii), masses[0] * masses[1] / sum(masses)

    def deck(self, model, bodies, speed, dt, steps, damping="elasticDamping off"):
        names = " ".join(dict.fromkeys(m.name for m in bodies.materials))  # one for each atom type
        words = damping + (f" law {self.law} materials {names}" if model == "mpm" else "")
        if len(bodies.materials) == 1:
            return wall_deck(model, words, bodies.materials[0], RADIUS, speed, dt, wall_words=bodies.more).replace("run 120", f"run {2 * steps + 20}")
        return pair_deck(model, words, bodies.materials, [RADIUS * r for r in bodies.radii], speed, dt, run=f"run {2 * steps + 20}")

    def compare(self, table, model="mpm", relative=False, **deck):
        """`table`: (bodies, speed, expected e, duration, steps, limit)."""
        found = self.run_each([self.deck(model, bodies, speed, duration / steps, steps, **deck) for bodies, speed, _, duration, steps, _ in table], "SPEED")
        for (bodies, speed, expected, _, steps, limit), (after,) in zip(table, found):
            e = after / speed
            if bodies in (WALL, PAIR):
                self.record("steps", kind=bodies.name, speed=speed, steps=steps, e=e, law=expected)
            elif bodies in UNLIKE + MODULI or model == "thornton" and STIFF in bodies.materials:
                self.record("ratios", case=bodies.name, model=model, speed=speed, e=e, law=expected)
            assert (e / expected if relative else e) == approx((1.0 if relative else expected), abs=limit), f"{model}, {bodies.name}, {speed} m/s, {steps} steps: e {e} for {expected}"

    def rows(self, cases, speeds, steps=(50,), limit=None, replay="mpm"):
        table = []
        for bodies in cases:
            for speed in speeds:
                e, duration, _ = self.fixture(replay, self.law, *bodies.replay, *self.effective(bodies), speed)
                table += [(bodies, speed, e, duration, n, limit or LIMITS[n]) for n in steps]
        return table

    def test_law(self):
        table = self.rows((WALL, PAIR), SPEEDS, LIMITS) + self.rows((*MIXED, *UNLIKE, *DECLARED), FEW)
        self.compare(table + self.rows(MODULI, FEW, replay="elastic"))

    def test_default_damping(self):
        """e of the elastic part within 1 % of the law's."""
        self.compare(self.rows((WALL, PAIR, *MIXED), SPEEDS, limit=0.01), relative=True, damping="")

    def test_velocity_axis(self):
        """A law that latches the approach speed; the axis ends at 17 m/s on the wall."""
        self.fixture("write", self.law, "axis")
        table = self.rows((WALL, PAIR, *MIXED, *UNLIKE), (0.03, 1.0, 5.0, 12.0))
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
        self.compare(self.rows((WALL,), (1.0,), (100,)))

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
        table = self.thornton(Bodies("wall", (), (m,)), m.e_star, yields, RATIOS, 0.003)  # of e: 50 steps, LIMITS[50] of e > 0.35
        for radii in ((1, 1), (1, 2)):
            table += self.thornton(Bodies(f"radii {radii[0]}:{radii[1]}", (), (m, m), radii), m.e_star / 2, yields, RATIOS, 0.003)
        both = SOFT.e_star * STIFF.e_star / (SOFT.e_star + STIFF.e_star)
        for pair in ((SOFT, STIFF), (STIFF, SOFT)):
            table += self.thornton(Bodies(f"moduli {pair[0].name}:{pair[1].name}", (), pair), both, SOFT.yield_stress, RATIOS[2:5], 0.003)
        self.compare(table, "thornton", relative=True)

    def test_thornton_takes_the_yield_pressure_of_the_deck(self):
        """`yieldPressure`: p_y over Y, on a wall without the word, too."""
        m = DAMAGED
        for factor in (2.5, 2.8):
            table = self.thornton(Bodies("wall", (), (m,)), m.e_star, m.yield_stress, RATIOS[1:4], 0.003, factor)
            table += self.thornton(Bodies("pair", (), (m, m)), m.e_star / 2, m.yield_stress, RATIOS[1:4], 0.003, factor)
            self.compare(table, "thornton", relative=True, damping=f"elasticDamping off yieldPressure {factor}")
