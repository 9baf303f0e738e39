"""tools/report: what the page says of files whose numbers are known, of missing files and of damaged ones."""
import contextlib
import io
import json
import math
import re
import shutil

import run_files
from programs import ROOT, module, run
from pytest import approx, fixture, mark, raises
from reporting import contacts_part, files, page

TOOL = module(ROOT / "tools" / "report")


def without_drawing(folder):
    """(exit status, stderr, page) of the same in this process, figures named but not drawn, for speed."""
    def figure(self, picture, name, caption):
        page.plt.close(picture)
        self.text(f"figure {name}")
    told, drawn = io.StringIO(), page.Page.figure
    page.Page.figure = figure
    try:
        with contextlib.redirect_stderr(told), contextlib.redirect_stdout(io.StringIO()):
            status = TOOL.main(["--from", str(folder), "-o", str(folder / "page")])
    finally:
        page.Page.figure = drawn
    return status, told.getvalue(), (folder / "page" / "report.md").read_text()


class TestWhole:
    @fixture(autouse=True, scope="class")
    def _page(self, request, tmp_path_factory):
        cls = request.cls
        cls.folder = tmp_path_factory.mktemp("report")
        run_files.everything(cls.folder)
        cls.done = run(ROOT / "tools" / "report", "--from", cls.folder, "-o", cls.folder / "page", cwd=cls.folder)
        cls.markdown = (cls.folder / "page" / "report.md").read_text()

    def row(self, *cells):
        """The line of the Markdown that holds all of these."""
        line, = [line for line in self.markdown.splitlines() if all(c in line for c in cells)]
        return line

    def test_it_is_written_whole(self):
        assert self.done.stderr == ""
        pictures = sorted(re.findall(r"!\[.*?\]\((.+?)\)", self.markdown))
        assert pictures == ["contacts-1.png", "flow-1-packing.png"]
        assert sorted(p.name for p in (self.folder / "page").iterdir()) == sorted(pictures + ["report.md"])

    def test_flow(self):
        # solid fraction: 0.59 ± 0.01/sqrt(3) against 0.6 ± 0: -1.67 %, error 0.00577/0.6 = 0.96 %; stretched +10 %
        line = self.row("| solid fraction |")
        assert "−1.7 ± 1.0 %" in line and "+10.0 ± 1.0 %" in line and "0.6 ± 0 |" in line
        assert self.row("| time step, µs |").endswith("| 6 | 6 | 6 | 60 |")
        assert "| 11.0 ± 0.6 |" in self.row("| wall-clock, s a run |")  # of 10, 11, 12 s
        assert "|  | hertz | thornton | mpm | mpm, stretched by 10 |" in self.markdown

    def test_contacts(self):
        line = self.row("| packing | wax-wax, particles | 300 |")
        assert "| 33.3 | 47.1 |" in line  # the largest speed is 1 m/s, yield begins at 0.03; I is 0.001 there, and the law goes to twice that
        assert "| 60 % |" in line  # 60 of 100 contacts at 0.01 m/s are below the onset at 0.03 m/s
        assert "| 9 | 0 |" in line  # three seeds of three contact-steps beyond the table


class TestMap:
    @fixture
    def contacts(self):
        found = contacts_part.Contacts.__new__(contacts_part.Contacts)
        found.joint, found.mapped, found.unit = {}, True, 0.5
        return found

    def test_contacts_by_speed_and_overlap(self, contacts):
        entry = run_files.stats([(0.01, 60), (1.0, 40)], [(1e-4, 60), (0.02, 40)])["pairs"][0]
        contacts.add_map(entry, "x")
        contacts.add_map(entry, "x")
        speed, overlap, counts = contacts.plane()
        assert counts.sum() == 200
        assert (counts[0, 0], counts[-1, -1]) == (120, 80)  # slow and flat, fast and deep; nothing between
        assert speed[-2] * 0.5 == approx(1.0, abs=1e-5)  # lower edge of the bin of 1 m/s, in V_y
        assert overlap[-2] <= 0.02 < overlap[-1]
        del entry["contact_map"]
        contacts.add_map(entry, "x")
        assert contacts.plane() is None  # one run of several did not count them

    @mark.parametrize("damaged", ({"speed_lower_edge": [1.0], "overlap_lower_edge": [1.0], "count": [[1, 2]]}, {"count": [[1]]}, [1],
                                  {"speed_lower_edge": ["a"], "overlap_lower_edge": [1.0], "count": [[1]]}))
    def test_a_cut_map(self, contacts, damaged):
        with raises(files.Unreadable):
            contacts.add_map({"contact_map": damaged}, "x")


class TestFormulas:
    def test_numbers(self):
        assert page.with_error(-0.0832, 0.0215, plus=True) == "−0.08 ± 0.02"
        assert page.with_error(12.34, 3.4) == "12 ± 3"
        assert page.with_error(7.009e-6, 3.2e-6) == "(7 ± 3)e−6"
        assert page.with_error(0.1, 1e-17) == "0.1 ± 0"  # three equal numbers have a rounded spread
        assert page.with_error(-1e-5, 2e-3, plus=True) == "0.000 ± 0.002"
        assert page.number(0.04567) == "0.0457"
        assert page.number(None) == "n/a"


class TestMissing:
    def test_a_folder_without_runs(self, folder):
        """Runs under a folder named *quick do not count, unless it is named itself."""
        run_files.everything(folder / "quick")
        assert re.fullmatch(r"tools/report: \S+ has no file of a deck with `stats FILE`, .*\n", run(ROOT / "tools/report", "--from", folder, code=1).stderr)
        assert without_drawing(folder / "quick")[:2] == (0, "")

    def test_a_folder_that_is_not_there(self, folder):
        done = run(ROOT / "tools" / "report", "--from", folder / "no", code=1)
        assert re.search(r"^tools/report: .*/no is no folder; .*\n$", done.stderr)


def own_deck(folder, rows=5, **more):
    """A file of `stats FILE` in a folder that no example made, and its law."""
    folder.mkdir(parents=True, exist_ok=True)
    series = {"time_s": [0.1 * k for k in range(rows)], **{name: [k * 1e-4 for k in range(rows)] for name in
              ("particles", "kinetic_J", "rotational_J", "normal_dissipation_J", "wave_dissipation_J", "fastest_particle_m_per_s")}}
    content = {**run_files.stats([(0.01, 60), (1.0, 40)], [(1e-3, 60), (0.05, 40)]), "series": series, **more}
    for entry in content["pairs"]:
        entry["law"] = "mpm mine.h5"
    # as the plug-in writes it: these first
    (folder / "results.json").write_text('{\n  "granulaw_version": "0",\n  "time_step_used_s": 1e-6,\n' + json.dumps(content)[1:])


class TestOwnDecks:
    def test_contacts_energies_and_speeds(self, folder):
        own_deck(folder / "mill")
        status, told, text = without_drawing(folder)
        assert (status, told) == (0, "")
        assert "| mill/results.json | wax-wax, particles | 100 |" in text
        for figure in ("figure contacts-1", "figure run-1"):
            assert figure in text
        run, = contacts_part.read_own(folder, [])[0]
        figure = contacts_part.picture_of_run(run)
        energies, fastest, speeds = figure.axes
        assert energies.get_ylabel() == "energy, µJ"
        for line in energies.lines:
            assert list(line.get_ydata()) == [100.0 * k for k in range(5)]
        assert {line.get_label() for line in energies.lines} == {"kinetic", "rotation", "taken by normal contacts", "taken by waves"}
        assert speeds.lines[0].get_xdata()[0] / 0.03 == approx(1, abs=1e-12)  # the onset, as the file has it
        page.plt.close(figure)

    def test_a_run_that_stopped_at_a_number_that_is_none(self, folder):
        none = {"time_s": [0, 1, 2], "kinetic_J": [2e-3, 1e-3, None], "fastest_particle_m_per_s": [1, 2, None]}
        own_deck(folder, series=none)
        assert without_drawing(folder)[:2] == (0, "")
        figure = contacts_part.picture_of_run(contacts_part.read_own(folder, [])[0][0])
        assert figure.axes[0].get_ylabel() == "energy, mJ"
        assert list(figure.axes[1].lines[0].get_ydata())[:2] == [1, 2]
        page.plt.close(figure)

    def test_a_body_that_does_not_yield(self, folder):
        own_deck(folder)
        text = (folder / "results.json").read_text()
        (folder / "results.json").write_text(text.replace('"onset_speed_m_per_s": 0.03', '"onset_speed_m_per_s": null'))
        status, told, text = without_drawing(folder)
        assert (status, told) == (0, "")
        assert re.search(r"\| 100 \| 0.01\d+ m/s \|", text)

    def test_it_needs_of_the_sources_what_the_package_holds(self, folder):
        """In a folder as /usr/share/granulaw: tools/report, tools/reporting, examples/common."""
        share, folder = (folder / "share"), (folder / "runs")
        for part in ("tools/reporting", "examples/common"):
            shutil.copytree(ROOT / part, share / part, ignore=shutil.ignore_patterns("__pycache__"))
        shutil.copy(ROOT / "tools/report", share / "tools")
        own_deck(folder)
        done = run(share / "tools/report", "--from", folder, "-o", folder / "page", cwd=share.parent)
        assert done.stderr == ""
        assert "contacts: results.json" in done.stdout
        assert (folder / "page/run-1.png").exists()


def cut(path):
    content = path.read_bytes()
    path.write_bytes(content[:len(content) // 2])


class TestDamaged:
    """One sentence on stderr and on the page, exit 1, and the other parts as ever."""

    @mark.parametrize("damage, sentence", (
        (lambda root: (root / "packing/packing.csv").write_text((root / "packing/packing.csv").read_text().replace("0.58", "abc")),
         r"packing\.csv: line 2: value is 'abc', expected a number"),
        (lambda root: cut(root / "packing/mpm-2/stats.json"), r"mpm-2/stats\.json: not a whole JSON file"),
        (lambda root: (root / "packing/mpm-2/stats.json").write_bytes(bytes(range(256))), r"mpm-2/stats\.json: not a whole JSON file"),
        (lambda root: (root / "packing/mpm-2/stats.json").write_text("{}"), r"stats\.json: has no 'pairs'"),
        (lambda root: (root / "packing/mpm-2/stats.json").write_text('{"pairs": [{"kind": "wall", "materials": ["wax"], "contacts_begun": 1}]}'),
         r"stats\.json: row 1: 'contact_steps_beyond_table' is None, expected a number"),
        (lambda root: own_deck(root / "mill", rows=1, series={"time_s": [1, 2], "kinetic_J": [1]}), r"results\.json: 'series' is no table with columns of one length")))
    def test_it_is_named(self, folder, damage, sentence):
        run_files.everything(folder)
        damage(folder)
        status, told, text = without_drawing(folder)
        assert (status, len(told.splitlines())) == (1, 1), told
        assert re.search(f"^tools/report: .*{sentence}", told)
        assert re.search(sentence, text)
        assert "## Flow" in text

    def test_a_name_with_a_bar(self, folder):
        deck = run_files.everything(folder)
        with open(deck / "packing.csv", "a") as file:
            for model in ("hertz", "mpm"):
                file.writelines(f'{model},{k},a|b,{k}\n' for k in (1, 2, 3))
        assert "| a\\|b |" in without_drawing(folder)[2]

    def test_seeds_that_are_equal(self, folder):
        """The spread of equal seeds is 0."""
        run_files.packing(folder, {model: {"solid fraction": [value, value]} for model, value in (("hertz", 0.6), ("mpm", 0.5))}, {"hertz": [1, 1], "mpm": [1, 1]})
        assert "+20 ± 0 %" in without_drawing(folder)[2]
