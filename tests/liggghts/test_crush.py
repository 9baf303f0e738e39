"""`beyondRange crush`: beyond the law's table the force stays, and the way there is lost for good."""
import json
import re

from pytest import approx, mark
from collisions import pair_deck, wall_deck
from harness import POWDER, Deck, sphere_mass

RADIUS, SPEED, STEP = 1.7e-3, 60.0, 1e-7
COLUMNS = 'compute taken all reduce sum f_granulaw_crush[1]\ncompute most all reduce max f_granulaw_crush[2]\nvariable taken equal c_taken\nvariable most equal c_most\n'
PRINT = 'variable loss equal f_granulaw+f_granulaw[15]\nprint "LOSS ${loss}"\nvariable crushed equal f_granulaw[21]\nprint "CRUSHED ${crushed}"\nprint "TAKEN ${taken}"\nprint "MOST ${most}"\n'


class TestCrush(Deck):
    def words(self, more="beyondRange crush energy on stats s.json elasticDamping off"):
        return f"law {self.law} materials powder {more}"

    def deck(self, of, steps=400):
        """Velocities of each step, then energies."""
        text = of.replace("run 120\n", COLUMNS + f"thermo_style custom step ke time c_taken c_most\nthermo_modify norm no\nthermo 1\nrun {steps}\n")
        return text + PRINT

    @mark.parametrize("ranks", (1, 2))
    @mark.parametrize("kind", ("wall", "pair"))
    def test_an_impact_far_beyond(self, kind, ranks):
        """Energy is kept, the force is bounded, and what was crushed is counted by pair and particle."""
        mass = sphere_mass(RADIUS, POWDER.density)
        if kind == "wall":
            deck, energy = wall_deck("mpm", self.words(), POWDER, RADIUS, SPEED, STEP), 0.5 * mass * SPEED**2
        else:
            deck, energy = pair_deck("mpm", self.words(), (POWDER, POWDER), (RADIUS, RADIUS), 2 * SPEED, STEP), mass * SPEED**2
        text = self.run_deck(self.deck(deck), ranks=ranks)
        loss, crushed, taken, most = (self.result(text, name)[0] for name in ("LOSS", "CRUSHED", "TAKEN", "MOST"))
        rows = [[float(w) for w in line.split()] for line in text.splitlines() if re.fullmatch(r"\s*\d+(\s+[-+.\deE]+){4}\s*", line)]
        assert len(rows) > 300
        after = rows[-1][1]
        # the crossing of the table's end is taken at the force of the end: one step of hundreds
        assert (after + loss) / energy == approx(1.0, abs=2e-3)
        assert 0.05 * energy < crushed < loss
        assert taken == approx(crushed, rel=1e-9)
        found = json.loads((self.folder / "s.json").read_text())
        counts = found["wall" if kind == "wall" else "pair"]
        assert (counts["contacts_past_table"], counts["crush_dissipation_J"]) == (1, approx(crushed, rel=1e-6))
        assert most == approx(counts["overlap_over_radius_max"], rel=1e-6)
        assert "contacts crushed beyond the law's table took" in text
        # a constant force takes the same momentum in each step
        beyond = [(2 * row[1]) ** 0.5 for row in rows if 0 < row[3] < taken * (1 - 1e-6)]
        changes = [a - b for a, b in zip(beyond, beyond[1:])]
        assert max(changes[1:-1]) == approx(min(changes[1:-1]), rel=1e-6)

    def test_a_stop_names_it(self):
        text = self.run_deck(wall_deck("mpm", self.words("beyondRange stop"), POWDER, RADIUS, SPEED, STEP), expect_failure=True)
        assert "or say 'beyondRange crush', or 'confinement auto' for pressed beds" in text

    def test_less_than_the_table_is_the_law_to_the_bit(self):
        (plain,), (crush,) = self.run_each((wall_deck("mpm", self.words(more), POWDER, RADIUS, 1.0, STEP) for more in ("", "beyondRange crush")), "SPEED")
        assert plain == crush
