"""A law of a rate-dependent material in LIGGGHTS: for particles of its own size only (test_collisions.py: as the replay has it)."""
import json
import math
import re

from pytest import mark
from collisions import pair_deck, wall_deck
from harness import GLASS, POWDER, Deck, head

RADIUS = 1.7e-3


class TestRateLaw(Deck):
    def prepare(self):
        self.fixture("write", self.law, "rate", RADIUS)
        self.words = f"law {self.law} materials powder elasticDamping off"

    def test_another_size_is_refused(self):
        for factor, units in ((1.2, "si"), (0.9, "si")):
            deck = wall_deck("mpm", self.words, POWDER, factor * RADIUS, 1.0, 2e-7)
            text = self.run_deck(deck, expect_failure=True)
            assert re.search("depends on the strain rate, so it holds for one size: radius: found 0.00[0-9]+ m", text)
        text = self.run_deck(deck, ranks=2, expect_failure=True)
        assert text.count("holds for one size") == 1

    @mark.parametrize("factor", (1.3, 0.9, 1.04))
    @mark.parametrize("speed", (1.0, 0.0))
    def test_a_size_outgrown_in_a_run(self, speed, factor):
        """By fix adapt, on the wall and before it; a type that becomes that of the law; within 5 % it goes on."""
        deck = wall_deck("mpm", self.words, POWDER, RADIUS, speed, 2e-8)
        grow = f"variable g equal {2 * RADIUS!r}*(1+{factor - 1!r}*(step-20)/200)\nfix a all adapt 1 atom diameter v_g\nrun 20\nrun 200"
        text = self.run_deck(deck.replace("run 120", grow), expect_failure=factor != 1.04)
        if factor != 1.04:
            assert re.search("step [0-9]+: particle 1: .*type 1.* depends on the strain rate, so it holds for one size: radius: found 0.00[0-9]+ m", text)

    def count(self, deck, ranks=1):
        """Contacts slower than the law's slowest impact: f_granulaw[16]; the file's pair and wall; the line at the end."""
        out = '\nvariable d equal f_granulaw[16]\nvariable f equal f_granulaw[11]\nprint "SLOW ${d} ${f}"\n'
        text = self.run_deck(deck.replace("run 120", "run 400") + out, ranks=ranks)
        slow, fast = self.result(text, "SLOW")
        stats = json.loads((self.folder / "s.json").read_text())
        assert slow == stats["pair"]["contacts_below_speed_axis"] + stats["wall"]["contacts_below_speed_axis"]
        assert ("slower than the lowest speed of the rate-dependent law" in text) == (slow > 0)
        return slow, fast, stats

    def test_slower_impacts_than_the_law_knows_are_counted(self):
        """The fixture's axis ends at V sqrt(rho/Y) = 0.066 on the rigid wall (twice that V for a like pair) and begins at 1/40 of it."""
        fastest = 0.066 * math.sqrt(POWDER.yield_stress / POWDER.density)
        words = f"{self.words} stats s.json"
        for share, slow, fast in ((0.97 / 40, 1, 0), (1.03 / 40, 0, 0), (1.03, 0, 1)):
            speed = share * fastest
            deck = wall_deck("mpm", words, POWDER, RADIUS, speed, 2e-8 if fast == 0 else 2e-9)
            assert self.count(deck)[:2] == (slow, fast), share
            deck = pair_deck("mpm", words, [POWDER, POWDER], [RADIUS, RADIUS], 2 * speed, 2e-8 if fast == 0 else 2e-9)
            for ranks in (1, 2):
                assert self.count(deck, ranks)[:2] == (slow, fast), (share, ranks)

    def test_the_count_survives_a_restart(self):
        deck = wall_deck("mpm", f"{self.words} stats s.json", POWDER, RADIUS, 0.01, 2e-8)
        assert self.count(deck + "write_restart half.restart\n")[0] == 1
        begin, rest = deck.split("create_atoms", 1)
        again = head(half=20 * RADIUS, read="read_restart half.restart")
        again += "fix p1" + begin.split("fix p1", 1)[1] + "fix i all" + rest.split("fix i all", 1)[1]
        assert self.count(again)[0] == 1

    def test_a_contact_without_approach_is_not_slow(self):
        deck = wall_deck("mpm", f"{self.words} stats s.json", POWDER, RADIUS, 0.01, 2e-8)
        assert self.count(deck.replace("velocity all set 0.0 0.0 -0.01", f"displace_atoms all move 0 0 {-1e-3 * RADIUS} units box"))[0] == 0

    def test_the_partner_may_have_any_size(self):
        words = f"law {self.law} materials powder glass elasticDamping off"
        self.run_deck(pair_deck("mpm", words, [POWDER, GLASS], [RADIUS, 2 * RADIUS], 0.5, 2e-7))
