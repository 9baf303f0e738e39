"""The contact statistics of fix granulaw/stats against the kinetic energy that really went."""
import json

from pytest import approx
import gas
from collisions import pair_deck, wall_deck
from harness import POWDER, Deck, sphere_mass

RADIUS = 1.7e-3


class TestContactStatistics(Deck):
    def words(self, model):
        if model == "mpm with axis":
            self.fixture("write", self.folder / "axis.h5", "axis")
            return f"law {self.folder / 'axis.h5'} materials powder elasticDamping off"
        # damping below yield is no plastic loss: not in these contact statistics
        return (f"law {self.law} materials powder " if model == "mpm" else "") + "elasticDamping off"

    def test_one_collision(self):
        """Wall and pair: dissipated = kinetic energy before - after; one contact begun; impact speed and overlap."""
        m = sphere_mass(RADIUS, POWDER.density)
        out = '\nvariable d equal f_granulaw\nvariable a equal f_granulaw[{}]\nvariable b equal f_granulaw[{}]\n' \
              'variable c equal f_granulaw[{}]\nprint "STATISTICS ${{d}} ${{a}} ${{b}} ${{c}}"\n'
        for case in ("mpm", "mpm with axis", "thornton"):
            model = case.split()[0]
            for kind, m_eff, radius_ratio in (("wall", m, 1.0), ("pair", m / 2, 0.5)):
                speed = 1.0
                # 500 steps a contact: the discrete work is good to 1e-5
                args = (speed, 1.2e-8 if model == "mpm" else 1.2e-8)
                if kind == "wall":
                    deck = wall_deck(model, self.words(case), POWDER, RADIUS, *args).replace("run 120", "run 2500")
                else:
                    deck = pair_deck(model, self.words(case), (POWDER, POWDER), (RADIUS, RADIUS), *args,
                                     run="run 2500")
                vector = (4, 6, 8) if kind == "wall" else (3, 5, 7)
                text = self.run_deck(deck + out.format(*vector))
                e = self.result(text, "SPEED")[0] / speed
                dissipated, begun, impact, overlap = self.result(text, "STATISTICS")
                assert e < 0.95
                # 2e-4 of the loss: the step's own error in e at this resolution
                assert dissipated / (0.5 * m_eff * speed**2 * (1 - e * e)) == approx(1.0, abs=2e-4), f"{case} {kind}"
                assert begun == 1
                assert impact / speed == approx(1.0, abs=1e-6)  # nothing acts before first touch
                if case == "mpm":
                    other = "wall" if kind == "wall" else "powder"
                    _, _, delta = self.fixture("mpm", self.law, "powder", other, RADIUS * radius_ratio, m_eff, speed)
                    assert overlap / (delta / (RADIUS * radius_ratio)) == approx(1.0, abs=1e-4)

    def test_gas_and_json(self):
        """Frictionless gas: what is gone from the kinetic energy is in the statistics, but for what contacts still hold."""
        gas.data_file(self.folder / "gas.data")
        words = f"law {self.law} materials powder stats stats.json"
        start = gas.start() + gas.model(words, friction=0.0) + gas.MOVE.replace("2e-7", "5e-8") + gas.OUTPUT
        before = self.result(self.run_deck(start + "run 0\n" + gas.PRINT), "GAS")
        after = self.result(self.run_deck(start + "run 16000\n" + gas.PRINT), "GAS")
        stats = json.loads((self.folder / "stats.json").read_text())
        assert not list(self.folder.glob("*.tmp.*"))
        # contacts open at the end hold some elastic energy: a few of the 125 spheres, 3 % of the loss at most
        assert after[1] / (before[0] - after[0]) == approx(1.0, abs=0.03)
        assert after[1] <= (before[0] - after[0]) * (1 + 2e-4)  # never more than was lost
        assert stats["pair"]["normal_dissipation_J"] / after[1] == approx(1.0, abs=1e-6)
        assert stats["pair"]["contacts_begun"] == approx(after[2], abs=1e-6)
        assert sum(stats["pair"]["impact_speed"]["count"]) == stats["pair"]["contacts_begun"]
        assert sum(stats["pair"]["largest_overlap_over_radius"]["count"]) == stats["pair"]["contacts_ended"]
        assert stats["wall"]["contacts_begun"] == 0
