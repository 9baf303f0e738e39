"""Values of history that LIGGGHTS keeps for a contact, 8 bytes each: the number that docs/reference/pair_gran_model_*.md state."""
import pathlib
import re

from harness import POWDER, Deck, head, properties

RADIUS = 1.7e-3
HERTZ = "fix q1 all property/global coefficientRestitution peratomtypepair 1 1.0\n"
PAGE = pathlib.Path(__file__).resolve().parents[2] / "docs/reference/pair_gran_model_mpm.md"


def stated(model):
    """The page's row of a model: values with tangential off, with tangential history, with `energy on`, where it says so."""
    row = re.search(rf"^\| {model} \|(.*)\|$", PAGE.read_text().partition("### Memory")[2], re.M)[1]
    return [int(cell.split(":")[0]) for cell in row.split("|") if cell.strip()]


class TestMemory(Deck):
    def deck(self, model, tangential, words, last):
        """Two spheres that touch, on a floor; the last value of history is asked for, of pairs and of the wall."""
        wall_words = "" if model == "mpm" else words.replace("energy on", "")
        return (head(half=20 * RADIUS) + properties([POWDER]) + HERTZ +
                f"pair_style gran model {model} tangential {tangential} {words}\npair_coeff * *\n"
                f"fix w all wall/gran model {model} tangential {tangential} primitive type 1 zplane 0.0 {wall_words}\n"
                f"create_atoms 1 single 0 0 {0.999 * RADIUS!r} units box\ncreate_atoms 1 single 0 0 {2.998 * RADIUS!r} units box\n"
                f"set group all diameter {2 * RADIUS!r} density {POWDER.density}\nfix i all nve/sphere\ntimestep 2e-8\n" + last)

    def test_values_a_contact(self):
        law = f"law {self.law} materials powder "
        words_of = {"hertz": "tangential_damping off", "thornton": "elasticDamping off", "mpm": law + "elasticDamping off"}
        variants = (("off", ""), ("history", ""), ("history", " energy on"))
        for model, tangential, words, values in ((model, tangential, words + more, values) for model, words in words_of.items()
                                                 for (tangential, more), values in zip(variants, stated(model))):
            pairs = "compute c all pair/gran/local history\ndump d all local 1 d.txt {}\nrun 1\n"
            walls = "compute m all reduce max {}\nthermo_style custom step c_m\nrun 1\n"
            for last, name in ((pairs, "c_c[{}]"), (walls, "f_history_w[{}]")):
                if values == 0:  # then LIGGGHTS keeps no history at all
                    self.run_deck(self.deck(model, tangential, words, last.format(name.format(1))), expect_failure=True)
                    continue
                self.run_deck(self.deck(model, tangential, words, last.format(name.format(values))))
                text = self.run_deck(self.deck(model, tangential, words, last.format(name.format(values + 1))), expect_failure=True)
                assert "accessed out-of-range" in text, f"{model}, tangential {tangential} {words}"
