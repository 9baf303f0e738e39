"""`elasticDamping` and `tangentialStiffness`: what they add, and what they leave alone."""
import math

from pytest import approx
from collisions import wall_deck
from harness import POWDER, Deck, head, properties, sphere_mass, worst

RADIUS = 1.7e-3
MASS = sphere_mass(RADIUS, POWDER.density)
ELASTIC_SPEED = 0.03  # below the onset of yield on the wall, 0.13 m/s
RESTITUTION = "fix p6 all property/global coefficientRestitution peratomtypepair 1 0.6\nfix p1"


def damped_restitution(z):
    """e of d'' = -max(0, d^1.5 + sqrt(5) z d^(1/4) d'), d'(0) = 1: Antypov & Elliott's (2011) Hertz contact, whose
    e is exp(-pi z/sqrt(1 - z^2)), but for the force that may not pull."""
    d, v, h = 0.0, 1.0, 1e-4
    def a(d, v):
        return -max(0.0, d**1.5 + math.sqrt(5) * z * d**0.25 * v) if d > 0 else 0.0
    while d >= 0:  # midpoint rule: error far below 1e-4
        d_mid, v_mid = d + 0.5 * h * v, v + 0.5 * h * a(d, v)
        d, v = d + h * v_mid, v + h * a(d_mid, v_mid)
    return -v


class TestDamping(Deck):
    def deck(self, words, speed, model="mpm", **keywords):
        law = f"law {self.law} materials powder " if model == "mpm" else ""
        _, duration, _ = self.fixture("mpm", self.law, "powder", "wall", RADIUS, MASS, speed)
        return wall_deck(model, law + words, POWDER, RADIUS, speed, duration / 100, **keywords).replace(
            "run 120", "run 240")

    def e(self, deck, speed):
        return self.result(self.run_deck(deck), "SPEED")[0] / speed

    def test_collisions_below_yield(self):
        assert damped_restitution(0.001) == approx(math.exp(-0.001 * math.pi), abs=1e-4)
        # 0.003: LIGGGHTS takes the velocity half a step late, at 100 steps a contact 1 % of the damping's loss
        ratios = {"": 0.001, "elasticDamping 0.05": 0.05, "elasticDamping 0.2": 0.2}
        for model in ("mpm", "thornton"):
            found = self.run_each((self.deck(words, ELASTIC_SPEED, model) for words in ratios), "SPEED")
            assert [after / ELASTIC_SPEED for after, in found] == approx([damped_restitution(z) for z in ratios.values()], abs=0.003), model

    def test_default_stays_within_0_0035(self):
        """The default's e differs from the pure law's by at most 1 - exp(-0.001 pi) = 0.0031 (and rounding up)."""
        speeds = (0.03, 0.07, 0.1, 1.0)
        found = [after for after, in self.run_each((self.deck(words, speed) for speed in speeds for words in ("elasticDamping off", "")), "SPEED")]
        for speed, pure, default in zip(speeds, found[::2], found[1::2]):
            assert 0 <= (pure - default) / speed < 0.0035, f"{speed} m/s"

    def test_plastic_impacts_keep_their_rebound(self):
        """Far above yield strong damping takes only what it took before yield."""
        def e(words):
            deck = self.deck(words, 3.0)
            step = deck.split("timestep ")[1].split()[0]
            # ten times finer: else the elastic range is one step wide or none
            return self.e(deck.replace(f"timestep {step}", f"timestep {float(step) / 10!r}").replace("run 240", "run 2400"), 3.0)
        pure, damped = e("elasticDamping off"), e("elasticDamping 0.1")
        # up to yield (V_y = 0.13 m/s) 4 Z V_y/V of the kinetic energy goes, half of that of the speed: 0.0067 of e
        assert damped < pure
        assert damped == approx(pure, abs=pure * 2 * 0.1 * 0.133 / 3.0)

    def test_stretched(self):
        """Damping is stretched with the force: the same e."""
        words = "elasticDamping 0.1"
        plain = self.e(self.deck(words, ELASTIC_SPEED), ELASTIC_SPEED)
        deck = self.deck(words + " stretch 10", ELASTIC_SPEED)
        line = next(l for l in deck.splitlines() if l.startswith("create_atoms"))
        step = float(deck.split("timestep ")[1].split()[0])
        gap = RADIUS + 0.3 * 10 * step * ELASTIC_SPEED
        deck = deck.replace(line, " ".join(line.split()[:5] + [repr(gap), "units box"]))
        deck = deck.replace(f"timestep {step!r}", f"timestep {10 * step!r}")
        assert self.e(deck, ELASTIC_SPEED) == approx(plain, abs=1e-6)

    def test_bounces_come_to_rest(self):
        """A sphere under gravity that yielded, then rattles: mechanical energy falls and never grows; off: stays."""

        def energies(words):
            text = head(half=20 * RADIUS) + properties([POWDER])
            text += (f"pair_style gran model mpm tangential off law {self.law} materials powder {words}\npair_coeff * *\n"
                     "fix w all wall/gran model mpm tangential off primitive type 1 zplane 0.0\n"
                     f"create_atoms 1 single 0.0 0.0 {RADIUS * 0.99999!r} units box\n"
                     f"set group all diameter {2 * RADIUS!r} density {POWDER.density}\n"
                     # pressed with 1 N: rattles in its dent without leaving it
                     "fix push all addforce 0.0 0.0 -1.0\nfix i all nve/sphere\ntimestep 2e-7\n"
                     "variable v equal ke\nrun 300\nvariable n loop 40\nlabel again\nrun 997 post no\n"
                     'print "E ${v}"\nnext n\njump SELF again\n')
            out = self.run_deck(text)
            values = [float(l.split()[1]) for l in out.splitlines() if l.startswith("E ")]
            assert len(values) == 40
            return values
        damped, free = energies("elasticDamping 0.02"), energies("elasticDamping off")
        assert worst(damped[-5:]) < 1e-6 * max(free[-5:])
        assert max(free[-10:]) > 0.5 * max(free[:10])

    def test_coefficient_of_restitution(self):
        """Refused unless the deck says what it is for; `restitution` takes it below yield."""
        deck = self.deck("", ELASTIC_SPEED).replace("fix p1", RESTITUTION)
        assert "say 'elasticDamping off'" in self.run_deck(deck, expect_failure=True)
        said = self.deck("elasticDamping restitution", ELASTIC_SPEED).replace("fix p1", RESTITUTION)
        assert self.e(said, ELASTIC_SPEED) == approx(damped_restitution(0.1605), abs=0.003)
        # 0.6 is Z = 0.1605; that the force may not pull makes it 0.63
        ignored = self.deck("elasticDamping off", ELASTIC_SPEED)
        assert self.e(ignored.replace("fix p1", RESTITUTION), ELASTIC_SPEED) == self.e(ignored, ELASTIC_SPEED)

    def test_never_attractive(self):
        """Overdamped: the sphere never comes back faster, and nothing pulls it back to the wall."""
        e = self.e(self.deck("elasticDamping 0.9", ELASTIC_SPEED), ELASTIC_SPEED)
        assert e >= 0.0
        assert e < 0.3


class TestTangentialStiffness(Deck):
    def slip(self, stiffness, speed):
        """A pressed sphere pushed sideways: displacement over force gives k_t."""
        text = head(half=20 * RADIUS) + properties([POWDER], 0.5)
        text += (f"pair_style gran model mpm tangential history law {self.law} materials powder "
                 f"tangentialStiffness {stiffness} tangentialDampingRatio 0 elasticDamping off\npair_coeff * *\n"
                 "fix w all wall/gran model mpm tangential history primitive type 1 zplane 0.0\n"
                 f"create_atoms 1 single 0.0 0.0 {RADIUS * (1 - 0.02)!r} units box\n"
                 f"set group all diameter {2 * RADIUS!r} density {POWDER.density}\n"
                 f"velocity all set {speed} 0.0 0.0\nfix i all nve/sphere\n"
                 "timestep 1e-9\nvariable x equal xcm(all,x)\n"
                 "compute f all reduce sum fx\nvariable g equal c_f\nthermo_style custom step c_f\nrun 50\n"
                 'print "PUSH ${g} ${x}"\n')
        force, x = self.result(self.run_deck(text), "PUSH")
        return -force / x

    def test_from_the_contact_radius(self):
        """At 2 % of R the synthetic law's contact is wider than Hertz's by the table's ratio."""
        e, nu = POWDER.youngs_modulus, POWDER.poisson_ratio
        eight_g = 8 / (2 * 2 * (2 - nu) * (1 + nu) / e)
        mindlin = eight_g * RADIUS * math.sqrt(0.02)
        s = 0.02**0.25
        q = math.log(s / 6.4e-4**0.25)              # tests/unit/synthetic_law.hpp
        computed = mindlin * (1 + 0.3 * q * q / (1 + q))
        assert computed / mindlin > 1.05
        # 1e-3: the sphere moves down and turns a little in the 50 steps
        assert self.slip("mindlin", 1e-3) / mindlin == approx(1.0, abs=1e-3)
        assert self.slip("computed", 1e-3) / computed == approx(1.0, abs=1e-3)
