"""Two MPI ranks: the same physics, the same statistics, and a clean stop when something is wrong."""

from pytest import approx, mark
import gas
from harness import Deck


class TestParallel(Deck):
    def prepare(self):
        gas.data_file(self.folder / "gas.data")
        self.axis_law = self.folder / "axis.h5"
        self.fixture("write", self.axis_law, "axis")

    @mark.parametrize("model", ("mpm", "mpm with axis", "thornton"))
    def test_gas_on_two_ranks(self, model):
        law = {"mpm": self.law, "mpm with axis": self.axis_law}.get(model)
        words = f"law {law} materials powder" if law else ""
        deck = gas.start() + gas.model(words, name=model.split()[0]) + gas.MOVE + gas.OUTPUT + "run 5000\n" + gas.PRINT
        one = self.result(self.run_deck(deck), "GAS")
        two = self.result(self.run_deck(deck, ranks=2), "GAS")
        for value, expected in zip(two, one):
            assert value / expected == approx(1.0, abs=1e-6), model  # order of summation, as in test_history

    def test_error_stops_all_ranks(self):
        for words, sentence in ((f"law missing.h5 materials powder", "missing.h5"),
                                (f"law {self.law} materials chalk", "no material 'chalk'")):
            deck = gas.start() + gas.model(words) + gas.MOVE + "run 1\n"
            text = self.run_deck(deck, ranks=2, expect_failure=True)
            assert text.count("ERROR") == 1, text[-2000:]
            assert sentence in text
