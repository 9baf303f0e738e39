"""Pairs with a law of their own in the file (/pair_laws, `mpm table --own-law`): drops in LIGGGHTS against `mpm law` of the file.

::TestComputed runs the solver (slow)."""
from pytest import approx
from collisions import pair_deck, wall_deck
from harness import GLASS, POWDER, Deck, mpm_law
from programs import material, mpm

RADII = {"powder": 1.7e-3, "glass": 3.4e-3}
SPEEDS = (0.05, 1.0, 5.0)  # from below the onset of yield to 4 % of R*
STEPS = 2000               # time steps a contact
TOLERANCE = 1e-6           # of e: the step's error, 1e-3 at 50 steps (test_restitution.py), falls with its square


class Drops:
    """Entry of whatever law prepare() wrote to self.law."""

    def tool(self, first, second, speed):
        return mpm_law(self.law, f"{first.name}:{second.name}", speed, RADII[first.name], RADII[second.name])

    def deck(self, first, second, speed, duration, steps=STEPS):
        return pair_deck("mpm", f"law {self.law} materials {first.name} {second.name} elasticDamping off", (first, second),
                         (RADII[first.name], RADII[second.name]), speed, duration / steps, run=f"run {steps * 6 // 5}")

    def test_drops(self):
        """Both orders of the types, 1 and 2 ranks (the contact lies on the border of two)."""
        cases = [(order, speed) for order in ((POWDER, GLASS), (GLASS, POWDER)) for speed in SPEEDS]
        laws = [self.tool(*order, speed) for order, speed in cases]
        decks = [self.deck(*order, speed, law["contact_time_s"]) for (order, speed), law in zip(cases, laws)]
        for ranks in (1, 2):
            found = self.run_each(decks, "SPEED", ranks=ranks)
            for ((first, _), speed), law, (after,) in zip(cases, laws, found):
                assert after / speed == approx(law["e"], abs=TOLERANCE), f"{first.name} first, {speed} m/s, {ranks} ranks"
        assert laws[1]["e"] < 0.97

    def test_of_one_body(self):
        """On the rigid wall and against its like, of the same radius and of another."""
        words, radius = f"law {self.law} materials powder elasticDamping off", RADII["powder"]
        for pair, radius2 in (("powder:wall", None), ("powder:powder", radius), ("powder:powder", 2 * radius)):
            laws = [mpm_law(self.law, pair, speed, radius, radius2) for speed in SPEEDS]
            steps = [law["contact_time_s"] / 50 for law in laws]
            found = self.run_each((wall_deck("mpm", words, POWDER, radius, v, dt) if pair == "powder:wall" else
                                   pair_deck("mpm", words, (POWDER, POWDER), (radius, radius2), v, dt) for v, dt in zip(SPEEDS, steps)), "SPEED")
            for speed, law, (after,) in zip(SPEEDS, laws, found):
                assert after / speed == approx(law["e"], abs=1e-3), f"{pair} {radius2} {speed} m/s"  # test_restitution.LIMITS[50]


class TestSynthetic(Drops, Deck):
    def prepare(self):
        self.fixture("write", self.law, "pair_law")

    def test_it_is_the_pairs_own(self):
        """Without it e is another, and the start-up table says whose law it is."""
        law = self.tool(POWDER, GLASS, 5.0)
        self.fixture("write", self.law, "axis")
        assert abs(self.tool(POWDER, GLASS, 5.0)["e"] - law["e"]) > 0.01
        rules = []
        for variant in ("axis", "pair_law"):
            self.fixture("write", self.law, variant)
            text = self.run_deck(self.deck(POWDER, GLASS, 5.0, law["contact_time_s"], steps=50))
            line, = [line for line in text.splitlines() if line.startswith("  1 powder -  2 glass")]
            rules.append(line.split()[5])
        assert rules == ["reduced", "two-body"]


class TestComputed(Drops, Deck):
    """The whole chain: `mpm table --own-law` runs the solver with the two bodies, 140 CPU s where its cache is empty."""

    def prepare(self):
        file = self.folder / "materials.toml"
        file.write_text("".join(material(m.name, m.density, m.youngs_modulus, m.poisson_ratio, m.yield_stress if m is POWDER else None) for m in (POWDER, GLASS)))
        pairs = [word for pair in ("powder:glass", "powder:powder", "glass:glass", "powder:wall") for word in ("--pair", pair)]
        done = mpm("table", file, *pairs, "--own-law", "-o", self.law, timeout=7000)
        assert "powder:glass: corrected by " in done.stdout + done.stderr
