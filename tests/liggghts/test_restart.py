"""Restart files: the trajectory, the contacts' history, the contact statistics' counts and the particles' energies go on."""
import json
import math
import re
import struct

from pytest import approx
from test_energy import DT, PRINT, SUM, data_file, model, start
from harness import POWDER, Deck, properties


class TestRestart(Deck):
    def test_goes_on(self):
        """Half a run, a restart file, the other half: as the run in one go (in two pieces, for the set-up's sake)."""
        data_file(self.folder / "bed.data")
        rules = model(f"law {self.law} materials powder energy on stats s.json tangentialDampingRatio 0", "history", 0.3) + SUM
        whole = self.result(self.run_deck(start() + rules + "run 15000\nrun 5000\n" + PRINT), "ENERGY")
        whole_stats = json.loads((self.folder / "s.json").read_text())
        for written_on, read_on in ((1, 1), (2, 1), (1, 2)):
            self.run_deck(start() + rules + "run 15000\nwrite_restart half.restart\n", ranks=written_on)
            text = self.run_deck(start("read_restart half.restart") + rules + "run 5000\n" + PRINT, ranks=read_on)
            resumed = self.result(text, "ENERGY")
            for k, (value, expected) in enumerate(zip(resumed, whole)):
                # rounding, amplified by 5000 steps of collisions
                assert value / expected == approx(1.0, abs=1e-7), f"{k} {written_on} {read_on}"
            stats = json.loads((self.folder / "s.json").read_text())
            for side in ("pair", "wall"):
                for name in ("contacts_begun", "contacts_ended", "impact_speed_max_m_per_s", "impact_speed_min_m_per_s",
                             "overlap_over_radius_max", "normal_dissipation_J", "time_step_allowed_s"):
                    assert stats[side][name] / whole_stats[side][name] == approx(1.0, abs=1e-7), name
                assert stats[side]["impact_speed"]["count"] == whole_stats[side]["impact_speed"]["count"]
            assert whole_stats["pair"]["contacts_begun"] > 10

    def test_a_wall_named_pair(self):
        """Its models' words are not taken for the pair style's."""
        data_file(self.folder / "bed.data")
        rules = model(f"law {self.law} materials powder", "history", 0.3).replace("fix w all", "fix pair all").replace("zplane 0.0", "zplane 0.0 wall deformable")
        self.run_deck(start() + rules + "run 10\nwrite_restart half.restart\n")
        assert "holds contacts of" not in self.run_deck(start("read_restart half.restart") + rules + "run 1\n")
        renamed = rules.replace("fix pair all", "fix w all")
        assert "the restart file holds contacts of fix pair wall/gran" in self.run_deck(start("read_restart half.restart") + renamed + "run 1\n")

    def test_a_damaged_record(self):
        """LIGGGHTS hands over a fix's record without its length."""
        data_file(self.folder / "bed.data")
        rules = model(f"law {self.law} materials powder", "history", 0.3)
        self.run_deck(start() + rules + "run 10\nwrite_restart half.restart\n")
        whole = (self.folder / "half.restart").read_bytes()
        record = whole.index(struct.pack("<d", -4.7113e300))  # the mark that it begins with (books/restart_record.cpp)
        for place, value in ((0, 387.0), (1, math.nan), (1, -1.0), (1, 1e18), (1, 1e6), (4, 2.0)):
            at = record + 8 * place
            (self.folder / "half.restart").write_bytes(whole[:at] + struct.pack("<d", value) + whole[at + 8:])
            self.refused(start("read_restart half.restart") + rules + "run 1\n", "granulaw/stats: its record in the restart file is damaged")

    def test_pair_style_forgotten(self):
        data_file(self.folder / "bed.data")
        rules = model(f"law {self.law} materials powder", "history", 0.3)
        self.run_deck(start() + rules + "run 10\nwrite_restart half.restart\n")
        text = self.run_deck(start("read_restart half.restart") + properties([POWDER], 0.3) +
                             f"fix i all nve/sphere\ntimestep {DT}\nrun 1\n", expect_failure=True)
        assert "repeat pair_style and pair_coeff after read_restart" in text

    def test_another_number_of_values(self):
        """`energy on` on one side alone: the sentence names both numbers."""
        data_file(self.folder / "bed.data")
        words = f"law {self.law} materials powder"
        self.run_deck(start() + model(words, "history", 0.3) + "run 10\nwrite_restart half.restart\n")
        text = self.run_deck(start("read_restart half.restart") + model(words + " energy on", "history", 0.3) + "run 1\n", expect_failure=True)
        assert "the restart file has another number of values for each contact" in text
        assert re.search("found 10, .*16", text)
