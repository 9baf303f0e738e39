"""The ways a deck can be written: order of commands, LD_PRELOAD, rolling friction, converted Hertz decks."""
import json

from pytest import mark
from programs import LAUNCHER, run
from collisions import wall_deck
from harness import PLUGIN, POWDER, Deck

RADIUS = 1.7e-3


class TestOptions(Deck):
    def prepare(self):
        self.words = f"law {self.law} materials powder"

    def deck(self, words=None, **keywords):
        return wall_deck("mpm", self.words if words is None else words, POWDER, RADIUS, 1.0, 2e-7, **keywords)

    def speed(self, deck, **keywords):
        return self.result(self.run_deck(deck, **keywords), "SPEED")[0]

    @mark.parametrize("words", ("", " energy on"))
    def test_pair_style_before_create_box(self, words):
        """Then the first wall adds the fixes, with `energy on` the particles' energies too."""
        deck = self.deck(self.words + words) + 'variable d equal f_granulaw\nprint "LOSS ${d}"\n'
        style = next(l for l in deck.splitlines() if l.startswith("pair_style"))
        early = deck.replace(style + "\n", "").replace("region box", style + "\nregion box")
        early, late = self.run_deck(early), self.run_deck(deck)
        for name in ("SPEED", "LOSS"):
            assert self.result(early, name) == self.result(late, name)

    def test_steps_of_a_short_run(self):
        """`-steps N FILE`, by which `mpm convert --check` compares decks, stands first and has a whole number."""
        (self.folder / "in.deck").write_text(self.deck())
        def short(*words, **how):
            return run(LAUNCHER, *words, "-in", "in.deck", "-log", "none", cwd=self.folder, **how)
        short("-steps", 7, "state.json")
        assert json.loads((self.folder / "state.json").read_text())["steps"] == 7
        for steps in ("x", "7.5", "-1", "1e300"):
            assert f"-steps: found {steps}, allowed is a whole number" in short("-steps", steps, "none.json", code=None).stderr
        short("-var", "word", "a", "-steps", "7", "none.json", code=None)  # LIGGGHTS has no such option
        assert not (self.folder / "none.json").exists()

    def test_ld_preload_with_the_stock_binary(self):
        found = self.speed(self.deck(), launcher="liggghts", environment={"LD_PRELOAD": PLUGIN})
        assert found == self.speed(self.deck())

    def test_converted_hertz_deck(self):
        """limitForce and tangential_damping are known; the deck says that coefficientRestitution is not for us."""
        e = "fix p6 all property/global coefficientRestitution peratomtypepair 1 0.5\nfix p1"
        words = self.words + " elasticDamping off"
        text = self.run_deck(self.deck(words + " limitForce on tangential_damping on").replace("fix p1", e))
        assert self.result(text, "SPEED")[0] == self.speed(self.deck(words))

    def test_density_warning(self):
        text = self.run_deck(self.deck().replace("density 1500.0", "density 1600.0"))
        assert text.count("have density 1600 to 1600 kg/m^3") == 1

    def test_density_of_a_template(self):
        """Said in the first run, ahead of the first particle that it makes."""
        template = "fix pt all particletemplate/sphere 15485863 atom_type 1 density constant 15000 radius constant 0.001\nrun 120"
        text = self.run_deck(self.deck().replace("run 120", template))
        assert text.count("have density 1500 to 15000 kg/m^3") == 1
