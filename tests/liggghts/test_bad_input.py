"""Input that a user can get wrong: each ends with one clear sentence and a non-zero status."""
import re

from collisions import wall_deck
from harness import POWDER, Deck, Material, head, plane_stl, properties
from programs import LAUNCHER, MPIRUN, run

RADIUS = 1.7e-3


class TestBadInput(Deck):
    def deck(self, words, material=POWDER, model="mpm", **keywords):
        return wall_deck(model, words, material, RADIUS, 1.0, 2e-7, **keywords)

    def good(self):
        return f"law {self.law} materials powder"

    def test_the_deck_is_good_otherwise(self):
        self.run_deck(self.deck(self.good()))

    def test_law_and_materials(self):
        """The way from the law file and the deck to one sentence and a non-zero status; which words are refused: tests/unit (options, keywords, law_file)."""
        self.refused(self.deck("materials powder"), "'law FILE' is missing")
        self.refused(self.deck(f"law {self.law} materials powdr"), "no material 'powdr'", "did you mean 'powder'")
        self.refused(self.deck(f"law {self.law} materials powder glass"), "one name for each of the 1 atom types, found 2")
        other = self.folder / "other.h5"
        other.write_bytes(self.law.read_bytes()[:3000])
        self.refused(self.deck(f"law {other} materials powder"), "other.h5")
        for pairs, command, parts in (("powder:powder", "fix w wall/gran", ("'powder:wall'", "powder:powder")), ("powder:wall", "pair_style gran", ("'powder:powder'", "types 1"))):
            self.fixture("write", other, "pairs", pairs)
            self.refused(self.deck(f"law {other} materials powder"), command, *parts)

    def test_moduli_that_disagree(self):
        soft = Material("powder", 1500.0, 8e9, 0.3, 1e8)
        self.refused(self.deck(self.good(), material=soft), "youngsModulus of type 1", "8e+09", "9.1e+09", "powder.h5")
        other = Material("powder", 1500.0, 9.1e9, 0.31, 1e8)
        self.refused(self.deck(self.good(), material=other), "poissonsRatio of type 1", "0.31", "0.3 ")

    def test_words(self):
        self.refused(self.deck(self.good() + " limitForc on"), "'limitForc' is no keyword", "'limitForce'")
        self.refused(self.deck(self.good(), wall="", wall_words="wall rigid primitive type 1 zplane 0.0"), "'primitive' must stand before")
        self.refused(self.deck(self.good() + " computeElasticPotential on"), "not available", "f_granulaw[1]")
        self.refused(self.deck(self.good(), wall_words="computeDissipatedEnergy on"), "say it there")
        self.refused(self.deck(self.good() + " tangential_damping off", tangential="no_history"), "no friction")

    def test_units(self):
        self.refused(self.deck(self.good()).replace("units si", "units micro"), "units micro", "units si, units cgs")

    def test_thornton_yield_stress(self):
        deck = self.deck("", model="thornton")
        self.refused("\n".join(l for l in deck.splitlines() if "yieldStress" not in l), "yieldStress")
        bad = Material("powder", 1500.0, 9.1e9, 0.3, -1.0)
        self.refused(self.deck("", material=bad, model="thornton"), "yieldStress of type 1")

    def test_wall_without_a_pair_to_inherit_from(self):
        deck = self.deck("", model="hertz").replace("wall/gran model hertz", "wall/gran model mpm")
        deck = deck.replace("fix p1", "fix p6 all property/global coefficientRestitution peratomtypepair 1 0.5\nfix p1")
        self.refused(deck, "fix w wall/gran model mpm", "'law FILE' is missing")

    def test_beyond_the_table(self):
        fast = wall_deck("mpm", self.good(), POWDER, RADIUS, 60.0, 2e-7)
        text = self.run_deck(fast, expect_failure=True)
        assert "more than 5 % beyond the law's table, which ends at 0.1" in text
        text = self.run_deck(wall_deck("mpm", self.good() + " beyondRange continue", POWDER, RADIUS, 60.0, 2e-7,
                                       wall_words="beyondRange continue"))
        assert "contact-steps beyond the law's table" in text


class TestLastWords(Deck):
    """LIGGGHTS's error->one ends all ranks at once: its sentence is in the output of a batch job all the same."""

    def test_a_stop_of_one_rank(self):
        plane = plane_stl()
        triangle = plane[plane.index("facet"):plane.index("endfacet") + 9]
        (self.folder / "floor.stl").write_text(plane.replace("endsolid", triangle + "endsolid"))
        (self.folder / "in.deck").write_text(head() + properties([POWDER]) + "fix p6 all property/global coefficientRestitution peratomtypepair 1 0.5\npair_style gran model hertz tangential history\npair_coeff * *\n"
                                             "fix floor all mesh/surface file floor.stl type 1\n"
                                             "fix w all wall/gran model hertz tangential history mesh n_meshes 1 meshes floor\ncreate_atoms 1 single 0 0 0.01 units box\n"
                                             "set group all density 2500 diameter 0.002\nfix move all nve/sphere\ntimestep 1e-6\nrun 1\n")
        for ranks in (1, 2):
            for words in ((), ("-screen", "none")):
                mpirun = [MPIRUN, "--oversubscribe", "-np", ranks] if ranks > 1 else []
                done = run(*mpirun, LAUNCHER, "-in", "in.deck", "-log", "log.liggghts", *words, cwd=self.folder, code=None)
                assert re.search(r"ERROR on proc \d: .*duplicate", done.stdout + done.stderr), (ranks, words)
                assert "duplicate" in (self.folder / "log.liggghts").read_text(), (ranks, words)

    def test_what_came_before_a_signal(self):
        """Self-reference of a variable ends LIGGGHTS by a signal."""
        (self.folder / "in.deck").write_text('print "begun"\nvariable a equal v_a\nprint $a\n')
        assert "begun" in run(LAUNCHER, "-in", "in.deck", "-log", "none", cwd=self.folder, code=None).stdout
