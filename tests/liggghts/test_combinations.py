"""What a deck may combine: models, units, materials, elastic and plastic types, radii, laws for walls and pairs."""
import itertools
import unittest

from collisions import pair_deck, wall_deck
from harness import GLASS, POWDER, Deck, Material, head, properties, sphere_mass

RADIUS = 1.7e-3
MASS = sphere_mass(RADIUS, POWDER.density)
STEEL = Material("steel", 7800.0, 2.1e11, 0.3, 1e30)
# what cohesion and the epsd models ask for besides
MORE = ("fix p7 all property/global cohesionEnergyDensity peratomtypepair 1 1000\n"
        "fix p8 all property/global coefficientRollingViscousDamping peratomtypepair 1 0.1\nfix p1")
LAW_TOLERANCE = 0.01  # 50 steps a contact, as test_restitution.py


class Combinations(Deck):
    def words(self, materials="powder"):
        return f"law {self.law} materials {materials} elasticDamping off"

    def e(self, deck, speed=1.0):
        return self.result(self.run_deck(deck), "SPEED")[0] / speed

    def replay(self, a, b, r_eff, m_eff, speed):
        return self.fixture("mpm", self.law, a, b, r_eff, m_eff, speed)

    def test_every_combination(self):
        """All 36, for pair and wall. Rolling and tangential models do not touch a head-on impact; the weak
        cohesion (its work is 1e-4 of the impact's) hardly."""
        plain = self.e(wall_deck("mpm", self.words(), POWDER, RADIUS, 1.0, 2e-7))
        for tangential, cohesion, rolling in itertools.product(
                ("off", "history", "no_history"), ("", "sjkr", "sjkr2"), ("", "cdt", "epsd", "epsd2")):
            models = tangential + (f" cohesion {cohesion}" if cohesion else "")
            models += f" rolling_friction {rolling}" if rolling else ""
            deck = wall_deck("mpm", self.words(), POWDER, RADIUS, 1.0, 2e-7, tangential=models).replace("fix p1", MORE)
            self.assertAlmostEqual(self.e(deck), plain, delta=1e-3 if cohesion else 1e-12, msg=models)

    def test_thornton_too(self):
        for models in ("off cohesion sjkr2 rolling_friction epsd", "history cohesion sjkr rolling_friction epsd2"):
            deck = wall_deck("thornton", "", POWDER, RADIUS, 1.0, 2e-7, tangential=models).replace("fix p1", MORE)
            self.assertGreater(self.e(deck), 0.3)

    def test_cohesion_is_felt(self):
        strong = MORE.replace("1000", "1e6")
        deck = wall_deck("mpm", self.words(), POWDER, RADIUS, 1.0, 2e-7, tangential="history cohesion sjkr")
        self.assertLess(self.e(deck.replace("fix p1", strong)), self.e(deck.replace("fix p1", MORE)) - 0.001)
        text = self.run_deck(deck.replace("fix p1", MORE).replace("materials powder", "materials powder stretch 3"))
        self.assertEqual(text.count("does not reach into the cohesion model"), 1)

    def test_cgs(self):
        """The same collision in cgs: speeds 100 times the numbers, energy 1e7 times. The law file stays in SI."""
        loss = 'variable d equal f_granulaw\nprint "LOSS ${d}"\n'
        for variant, model in ((), "mpm"), (("axis",), "mpm"), ((), "thornton"):
            self.fixture("write", self.law, *variant)
            words = self.words() if model == "mpm" else "elasticDamping 0.01"
            si = self.run_deck(wall_deck(model, words, POWDER, RADIUS, 3.0, 2e-7, tangential="history") + loss)
            m = Material("powder", POWDER.density * 1e-3, POWDER.youngs_modulus * 10, POWDER.poisson_ratio,
                         POWDER.yield_stress * 10)
            cgs = self.run_deck(wall_deck(model, words, m, RADIUS * 100, 300.0, 2e-7).replace("units si", "units cgs") + loss)
            # rounding: 1e-16 R in overlaps of 1e-2 R, 50 steps
            self.assertAlmostEqual(self.result(cgs, "SPEED")[0] / self.result(si, "SPEED")[0], 100, delta=1e-8)
            self.assertAlmostEqual(self.result(cgs, "LOSS")[0] / self.result(si, "LOSS")[0], 1e7, delta=1)
            said = [[line for line in text.splitlines() if line.startswith("granulaw: 0 contacts")] for text in (si, cgs)]
            self.assertEqual(said[0], said[1])  # the log is in SI
            self.assertEqual(len(said[0]), 1)

    def test_radii_1_to_10(self):
        masses = sphere_mass(RADIUS, POWDER.density), sphere_mass(10 * RADIUS, POWDER.density)
        expected, duration, _ = self.replay("powder", "powder", RADIUS * 10 / 11, masses[0] * masses[1] / sum(masses), 1.0)
        found = self.e(pair_deck("mpm", self.words(), (POWDER, POWDER), (RADIUS, 10 * RADIUS), 1.0, duration / 50))
        self.assertAlmostEqual(found / expected, 1.0, delta=LAW_TOLERANCE)

    def test_elastic_type_against_powder(self):
        """`elastic` with glass's moduli stands for the law's glass, in either order; alone it is stock Hertz."""
        for order in ((POWDER, GLASS), (GLASS, POWDER)):
            masses = [sphere_mass(RADIUS, m.density) for m in order]
            expected, duration, _ = self.replay("powder", "glass", RADIUS / 2, masses[0] * masses[1] / sum(masses), 1.0)
            names = " ".join("powder" if m is POWDER else "elastic" for m in order)
            found = self.e(pair_deck("mpm", self.words(names), order, (RADIUS, RADIUS), 1.0, duration / 50))
            self.assertAlmostEqual(found / expected, 1.0, delta=LAW_TOLERANCE)

    def test_elastic_is_hertz(self):
        """Half-way through a contact, where velocities still change: against stock hertz with e = 1."""
        one = "fix p6 all property/global coefficientRestitution peratomtypepair 1 1.0\nfix p1"
        wall = lambda model, words: wall_deck(model, words, STEEL, RADIUS, 1.0, 1e-7,  # stock hertz's walls give way
                                              wall_words="wall deformable" if model == "mpm" else "")
        pair = lambda model, words: pair_deck(model, words, (STEEL, STEEL), (RADIUS, 2 * RADIUS), 1.0, 1e-7)
        for make in (wall, pair):
            ours, stock = (self.result(self.run_deck(make(*case).replace("fix p1", one).replace("run 120", "run 40")),
                                       "SPEED")[0] for case in (("mpm", self.words("elastic")), ("hertz", "")))
            self.assertAlmostEqual(ours / stock, 1.0, delta=1e-6)  # the re-tabulated x^1.5

    def mixed(self, pair, wall):
        one = "fix p6 all property/global coefficientRestitution peratomtypepair 1 1.0\n"
        return (head(half=20 * RADIUS) + properties([POWDER]) + one +
                f"pair_style gran model {pair}\npair_coeff * *\nfix s all granulaw/stats\n"
                f"fix w all wall/gran model {wall}\n"
                f"create_atoms 1 single 0.0 0.0 {1.0001 * RADIUS} units box\n"
                f"set group all diameter {2 * RADIUS} density {POWDER.density}\nvelocity all set 0.0 0.0 -1.0\n"
                "fix i all nve/sphere\ntimestep 2e-7\nvariable v equal vcm(all,z)\nrun 150\n"
                'print "SPEED ${v}"\n')

    def test_hertz_pairs_with_mpm_walls_and_the_reverse(self):
        expected, _, _ = self.replay("powder", "wall", RADIUS, MASS, 1.0)
        wall = f"mpm tangential history primitive type 1 zplane 0.0 {self.words()}"
        deck = self.mixed("hertz tangential history", wall).replace("fix s all granulaw/stats\n", "")
        self.assertAlmostEqual(self.e(deck) / expected, 1.0, delta=LAW_TOLERANCE)
        deck = self.mixed(f"mpm tangential history {self.words()}", "hertz tangential history primitive type 1 zplane 0.0")
        self.assertAlmostEqual(self.e(deck), 1.0, delta=LAW_TOLERANCE)

    def test_walls_inherit(self):
        """tangential_damping, tangentialStiffness, elasticDamping: said once. 0.03 m/s is elastic: damping shows."""
        words = f"law {self.law} materials powder elasticDamping 0.1 tangentialStiffness computed tangential_damping off"
        inherited = self.e(wall_deck("mpm", words, POWDER, RADIUS, 0.03, 4e-7), 0.03)
        own = self.e(wall_deck("mpm", words, POWDER, RADIUS, 0.03, 4e-7, wall_words="elasticDamping off"), 0.03)
        self.assertLess(inherited, 0.8)
        self.assertGreater(own, 0.99)

    def test_multisphere_needs_a_law_without_axis(self):
        template = ("fix t1 all particletemplate/multisphere 15485863 atom_type 1 density constant 1500 nspheres 2 ntry 1000 "
                    f"spheres file clump.txt scale 1.0 type 1\n"
                    "fix pd all particledistribution/discrete 15485867 1 t1 1.0\n"
                    "region r block -0.01 0.01 -0.01 0.01 0.0 0.01 units box\n"
                    "fix ins all insert/pack seed 32452843 distributiontemplate pd vel constant 0. 0. -1. "
                    "insert_every once overlapcheck yes all_in yes particles_in_region 3 region r\n"
                    "fix i all multisphere allow_group_and_set yes\n")
        (self.folder / "clump.txt").write_text(f"{-RADIUS / 2} 0 0 {RADIUS}\n{RADIUS / 2} 0 0 {RADIUS}\n")
        deck = (head(half=20 * RADIUS) + properties([POWDER]) +
                f"pair_style gran model mpm tangential history {self.words()}\npair_coeff * *\n"
                "fix w all wall/gran model mpm tangential history primitive type 1 zplane 0.0\n"
                f"{template}timestep 2e-7\nrun 20000\n"
                "variable n equal f_granulaw[4]\nvariable z equal vcm(all,z)\nprint \"CLUMPS ${n} ${z}\"\n")
        text = self.run_deck(deck)
        contacts, rebound = self.result(text, "CLUMPS")
        self.assertGreater(contacts, 0)
        self.assertGreater(rebound, -0.9)
        self.fixture("write", self.law, "axis")
        self.assertIn("fix multisphere needs a law without inertia axis", self.run_deck(deck, expect_failure=True))


if __name__ == "__main__":
    unittest.main()
