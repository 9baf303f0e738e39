"""`elasticDamping` and `tangentialStiffness`: what they add, and what they leave alone."""
import math
import unittest

from collisions import pair_deck, wall_deck
from harness import POWDER, Deck, head, properties, sphere_mass

RADIUS = 1.7e-3
MASS = sphere_mass(RADIUS, POWDER.density)
ELASTIC_SPEED = 0.03  # below the onset of yield on the wall, 0.06 m/s
RESTITUTION = "fix p6 all property/global coefficientRestitution peratomtypepair 1 0.6\nfix p1"


def damped_restitution(z):
    """Of a Hertz contact damped with sqrt(5) Z sqrt(k m) d^(1/4) v: Antypov & Elliott 2011."""
    return math.exp(-math.pi * z / math.sqrt(1 - z * z))


class Damping(Deck):
    def deck(self, words, speed, model="mpm", **keywords):
        law = f"law {self.law} materials powder " if model == "mpm" else ""
        _, duration, _ = self.fixture("mpm", self.law, "powder", "wall", RADIUS, MASS, speed)
        return wall_deck(model, law + words, POWDER, RADIUS, speed, duration / 100, **keywords).replace(
            "run 120", "run 240")

    def e(self, deck, speed):
        return self.result(self.run_deck(deck), "SPEED")[0] / speed

    def test_restitution_below_yield(self):
        # 0.002: velocity Verlet with damping at 100 steps a contact, and the last of the pull of the dashpot
        # that is clamped to keep the force from turning attractive
        for words, z in (("", 0.001), ("elasticDamping 0.05", 0.05), ("elasticDamping 0.2", 0.2)):
            for model in ("mpm", "thornton"):
                self.assertAlmostEqual(self.e(self.deck(words, ELASTIC_SPEED, model), ELASTIC_SPEED),
                                       damped_restitution(z), delta=0.002 + 0.06 * z * z, msg=f"{model} {words}")

    def test_off_is_the_pure_law(self):
        self.assertAlmostEqual(self.e(self.deck("elasticDamping off", ELASTIC_SPEED), ELASTIC_SPEED), 1.0, delta=1e-4)

    def test_default_stays_within_0_0035(self):
        """The default's e differs from the pure law's by at most 1 - exp(-0.001 pi) = 0.0031 (and rounding up)."""
        for speed in (0.03, 0.07, 0.1, 1.0):
            pure, default = (self.e(self.deck(w, speed), speed) for w in ("elasticDamping off", ""))
            self.assertLess(abs(default - pure), 0.0035, msg=f"{speed} m/s")
            self.assertLessEqual(default, pure)

    def test_plastic_impacts_keep_their_rebound(self):
        """Far above yield strong damping takes only what it took before yield."""
        pure, damped = (self.e(self.deck(w, 3.0), 3.0) for w in ("elasticDamping off", "elasticDamping 0.1"))
        self.assertAlmostEqual(damped, pure, delta=0.002)

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
        self.assertAlmostEqual(self.e(deck, ELASTIC_SPEED), plain, delta=1e-6)

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
                     "variable v equal ke\nvariable k equal vmax(all)\n")
            for _ in range(3):
                text += "run 100\n"
                text += "variable m1 equal ke\n"
            values = []
            text += "variable n loop 40\nlabel again\nrun 997 post no\nprint \"E ${v}\"\nnext n\njump SELF again\n"
            text = text.replace("variable k equal vmax(all)\n", "").replace("variable m1 equal ke\n", "")
            out = self.run_deck(text)
            values = [float(l.split()[1]) for l in out.splitlines() if l.startswith("E ")]
            self.assertEqual(len(values), 40)
            return values
        damped, free = energies("elasticDamping 0.02"), energies("elasticDamping off")
        self.assertLess(max(damped[-5:]), 1e-6 * max(free[-5:]))
        self.assertGreater(max(free[-10:]), 0.5 * max(free[:10]))

    def test_coefficient_of_restitution(self):
        """Refused unless the deck says what it is for; `restitution` takes it below yield."""
        deck = self.deck("", ELASTIC_SPEED).replace("fix p1", RESTITUTION)
        self.assertIn("say 'elasticDamping off'", self.run_deck(deck, expect_failure=True))
        said = self.deck("elasticDamping restitution", ELASTIC_SPEED).replace("fix p1", RESTITUTION)
        self.assertAlmostEqual(self.e(said, ELASTIC_SPEED), 0.6, delta=0.01)  # the clamp of the pull: 0.003 at Z = 0.16
        ignored = self.deck("elasticDamping off", ELASTIC_SPEED)
        self.assertEqual(self.e(ignored.replace("fix p1", RESTITUTION), ELASTIC_SPEED), self.e(ignored, ELASTIC_SPEED))

    def test_never_attractive(self):
        """Overdamped: the sphere never comes back faster, and nothing pulls it back to the wall."""
        e = self.e(self.deck("elasticDamping 0.9", ELASTIC_SPEED), ELASTIC_SPEED)
        self.assertGreaterEqual(e, 0.0)
        self.assertLess(e, 0.3)


class TangentialStiffness(Deck):
    def slip(self, stiffness, speed):
        """A pressed sphere pushed sideways: displacement over force gives k_t."""
        text = head(half=20 * RADIUS) + properties([POWDER], 0.5)
        text += (f"pair_style gran model mpm tangential history law {self.law} materials powder "
                 f"tangentialStiffness {stiffness} tangentialDampingRatio 0 elasticDamping off\npair_coeff * *\n"
                 "fix w all wall/gran model mpm tangential history primitive type 1 zplane 0.0\n"
                 f"create_atoms 1 single 0.0 0.0 {RADIUS * (1 - 0.02)!r} units box\n"
                 f"set group all diameter {2 * RADIUS!r} density {POWDER.density}\n"
                 f"velocity all set {speed} 0.0 0.0\nfix i all nve/sphere\nfix z all setforce NULL NULL 0.0\n"
                 "fix o all freeze\nunfix o\ntimestep 1e-9\nvariable f equal fcm(all,x)\nvariable x equal xcm(all,x)\n"
                 "compute f all reduce sum fx\nvariable g equal c_f\nthermo_style custom step c_f\nrun 50\n"
                 'print "PUSH ${g} ${x}"\n')
        text = text.replace("fix z all setforce NULL NULL 0.0\nfix o all freeze\nunfix o\n", "")
        text = text.replace("variable f equal fcm(all,x)\n", "")
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
        self.assertGreater(computed / mindlin, 1.05)
        # 1e-3: the sphere moves down and turns a little in the 50 steps
        self.assertAlmostEqual(self.slip("mindlin", 1e-3) / mindlin, 1.0, delta=1e-3)
        self.assertAlmostEqual(self.slip("computed", 1e-3) / computed, 1.0, delta=1e-3)


if __name__ == "__main__":
    unittest.main()
