"""tools/ensemble and what tools/report says of its runs: folders whose numbers are known, a command that is known."""
import math

from programs import ROOT, InFolder, run
from pytest import approx, mark, raises
from reporting import ensemble_part


def member_files(folder, yields, measure):
    """Members with these yield stresses; measure(k): {quantity: value}."""
    rows = ["member,density,yield_stress"]
    for k, y in enumerate(yields, 1):
        rows.append(f"{k:02},1500,{y}")
        (folder / f"{k:02}").mkdir(parents=True)
        values = "".join(f"{q},{v}\n" for q, v in measure(k, y).items())
        (folder / f"{k:02}" / "observables.csv").write_text("quantity,value\n" + values)
    (folder / "ensemble.csv").write_text("\n".join(rows) + "\n")


class TestNumbers:
    def test_rank_correlation(self):
        rho, p = ensemble_part.rank_correlation([1, 2, 3, 4, 5], [1, 4, 9, 16, 25])
        assert (rho, p) == (1.0, 0.0)
        rho, p = ensemble_part.rank_correlation([1, 2, 3, 4, 5, 6], [2, 1, 4, 3, 6, 5])
        assert rho == approx(1 - 6 * 6 / (6 * 35), abs=0.5e-7)  # Spearman's formula without ties
        t = rho * math.sqrt(4 / (1 - rho**2))
        assert p == approx(0.0416, abs=5e-4), f"t = {t}"  # Student's t of 4 degrees of freedom, tables
        assert ensemble_part.rank_correlation([1, 1, 1], [1, 2, 3]) is None

    def test_equal_values_share_their_rank(self):
        assert list(ensemble_part.ranks([3, 1, 1, 2])) == [4, 1.5, 1.5, 3]

    def test_numbers_of_a_material(self, folder):
        path = folder / "m.toml"
        path.write_text('[material.grain]\ndensity = 1500\nhardening = {law = "voce", strain = 0.1}\n')
        assert ensemble_part.numbers_of(path) == {"density": 1500.0, "hardening.strain": 0.1}
        path.write_text("what = \n")
        with raises(ensemble_part.Unreadable):
            ensemble_part.numbers_of(path)


class TestFolders(InFolder):
    def prepare(self):
        self.root = self.folder / "sweep"

    def test_what_follows_the_material_is_named(self):
        noise = [3, 1, 4, 1, 5, 9, 2, 6, 5, 3, 5, 8]
        member_files(self.root, [40e6 + 1e6 * k for k in range(12)],
                     lambda k, y: {"rate": 1e-9 * y, "angle": 30 + 0.01 * noise[k - 1], "constant": 2.0})
        (e,), broken = ensemble_part.read_all(self.root)
        assert broken == []
        assert list(e.parameters) == ["yield_stress"]  # the density does not vary
        assert ensemble_part.feels(e, "rate") == ("yield_stress", 1.0)
        assert ensemble_part.feels(e, "constant") is None
        row = ensemble_part.row_of(e, "rate")
        assert row[1] == "0.04550"
        # quantiles 2.5 % and 97.5 % of 12 evenly spaced values: 0.275 from either end
        low, high = map(float, row[2].split(" to "))
        assert low == approx(0.040275, abs=1e-5)  # four digits are shown
        assert high == approx(0.050725, abs=1e-5)

    def test_the_page(self):
        member_files(self.root, [40e6 + 1e6 * k for k in range(8)], lambda k, y: {"rate": 1e-9 * y})
        run(ROOT / "tools/report", "--from", self.root, "-o", self.root / "page")
        text = (self.root / "page" / "report.md").read_text()
        assert "8 members" in text
        assert "rate (yield_stress, +1.00)" in text

    def test_a_deck_of_a_member_is_no_deck_of_the_report(self):
        member_files(self.root, [40e6 + 1e6 * k for k in range(5)], lambda k, y: {"rate": 1e-9 * y})
        for k in range(1, 6):
            (self.root / f"{k:02}" / "observables.csv").unlink()
            (self.root / f"{k:02}" / "hopper.csv").write_text(f"model,seed,quantity,value\nmpm,1,rate,{k}\nmpm,2,rate,{k + 0.5}\n")
        from reporting import flow_part
        assert flow_part.read_all(self.root)[0] == []
        (e,), _ = ensemble_part.read_all(self.root)
        assert list(e.means("rate")) == [k + 0.25 for k in range(1, 6)]  # of two seeds

    def test_a_member_without_results_is_named(self):
        member_files(self.root, [40e6 + 1e6 * k for k in range(6)], lambda k, y: {"rate": 1e-9 * y})
        (self.root / "03" / "observables.csv").unlink()
        (e,), broken = ensemble_part.read_all(self.root)
        assert len(e.members) == 5
        assert "neither observables.csv" in str(broken[0])


class TestDriver(InFolder):
    """A program in place of mpm writes the yield stress for a law; the command measures it."""

    def prepare(self):
        self.root = self.folder
        fake = self.root / "mpm"
        fake.write_text('#!/bin/sh\necho ran >> "$(dirname "$0")/count"\ngrep yield_stress "$2" | cut -d" " -f3 > "$4"\n')
        fake.chmod(0o755)
        for k in range(1, 7):
            (self.root / f"grain-{k}.toml").write_text(f"[material.grain]\nyield_stress = {k}e6\n")

    def run_tool(self, *words, code=0):
        return run(ROOT / "tools/ensemble", *sorted(self.root.glob("grain-*.toml")), "-o", self.root / "out", "--mpm", self.root / "mpm", *words, code=code)

    COMMAND = ("--", "sh", "-c", "echo quantity,value > {folder}/observables.csv; echo rate,$(cat {law}) >> {folder}/observables.csv")

    def test_members_are_run_once(self):
        for _ in range(2):
            self.run_tool("--jobs", "2", *self.COMMAND)
        assert (self.root / "count").read_text().count("ran") == 6
        (e,), broken = ensemble_part.read_all(self.root)
        assert broken == []
        assert ensemble_part.feels(e, "rate") == ("yield_stress", 1.0)

    def test_numbers_of_the_material_are_at_hand(self):
        self.run_tool("--", "sh", "-c", "test {yield_stress} = {member}000000.0 && echo {other} {law} > {folder}/x")
        assert (self.root / "out" / "3" / "x").read_text().startswith("{other} /")

    def test_a_member_that_fails_is_named(self):
        done = self.run_tool("--", "sh", "-c", "test {member} != 4 && touch {folder}/x {law}", code=1)
        assert "member 4: failed" in done.stderr
        assert "5 of 6 members" in done.stdout

    @mark.parametrize("words, said", [(("--", "true", "{folder}"), "no {law}"), (("--", "true", "{law}"), "no {folder}"), ((), "no command")])
    def test_a_command_without_law_is_refused(self, words, said):
        assert said in self.run_tool(*words, code=2).stderr
