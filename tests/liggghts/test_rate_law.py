"""A law of a rate-dependent material in LIGGGHTS: for particles of its own size only, and then as `mpm law` replays it."""
import unittest

from collisions import pair_deck, wall_deck
from harness import GLASS, POWDER, Deck, sphere_mass

RADIUS = 1.7e-3


class RateLaw(Deck):
    def setUp(self):
        super().setUp()
        self.fixture("write", self.law, "rate", RADIUS)
        self.words = f"law {self.law} materials powder elasticDamping off"

    def test_its_own_size(self):
        found = self.result(self.run_deck(wall_deck("mpm", self.words, POWDER, RADIUS, 1.0, 2e-8).replace("run 120", "run 3000")), "SPEED")[0]
        e, _, _ = self.fixture("mpm", self.law, "powder", "wall", RADIUS, sphere_mass(RADIUS, POWDER.density), 1.0)
        self.assertAlmostEqual(found, e, delta=1e-3)  # of the step, a hundred a contact

    def test_another_size_is_refused(self):
        for factor, units in ((1.2, "si"), (0.9, "si")):
            deck = wall_deck("mpm", self.words, POWDER, factor * RADIUS, 1.0, 2e-7)
            text = self.run_deck(deck, expect_failure=True)
            self.assertRegex(text, "depends on the strain rate, so it holds for one size: radius: found 0.00[0-9]+ m")
        text = self.run_deck(deck, ranks=2, expect_failure=True)
        self.assertEqual(text.count("holds for one size"), 1)

    def test_the_partner_may_have_any_size(self):
        words = f"law {self.law} materials powder glass elasticDamping off"
        self.run_deck(pair_deck("mpm", words, [POWDER, GLASS], [RADIUS, 2 * RADIUS], 0.5, 2e-7))


if __name__ == "__main__":
    unittest.main()
