"""tools/report: what the page says of files whose numbers are known, of missing files and of damaged ones."""
import contextlib
import html.parser
import importlib.machinery
import importlib.util
import io
import json
import math
import re
import shutil

import run_files
from programs import ROOT, InFolder, run
from pytest import approx, fixture, mark, raises
from reporting import contacts_part, page, solver_part


def module(path):
    loader = importlib.machinery.SourceFileLoader("report_tool", str(path))
    found = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(found)
    return found


TOOL = module(ROOT / "tools" / "report")


def without_drawing(folder):
    """The same in this process, figures counted but not drawn, for speed: (exit status, stderr)."""
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
    return status, told.getvalue()


def report(folder, *words):
    return run(ROOT / "tools" / "report", "--from", folder, "-o", folder / "page", *words, cwd=folder)


class Loads(html.parser.HTMLParser):
    """All that a browser would fetch, and all script."""

    def __init__(self):
        super().__init__()
        self.found, self.ids, self.figures = [], [], 0

    def handle_starttag(self, tag, attributes):
        self.figures += tag == "svg"
        if tag in ("script", "link", "iframe", "object", "embed", "base", "form", "img", "image"):
            self.found.append(tag)
        for name, value in attributes:
            value = value or ""
            if name == "id":
                self.ids.append(value)
            if name.startswith("on") or (name in ("src", "href", "xlink:href", "srcset", "data", "action", "poster") and not value.startswith("#")):
                self.found.append(f"{tag} {name}={value}")
            if re.search(r"url\((?!#)|@import", value):
                self.found.append(f"{tag} {name}={value}")

    def handle_data(self, data):
        if re.search(r"url\((?!#)|@import", data):
            self.found.append(data[:80])


def loads(text):
    parser = Loads()
    parser.feed(text)
    return parser


class TestWhole:
    @fixture(autouse=True, scope="class")
    def _page(self, request, tmp_path_factory):
        cls = request.cls
        cls.folder = tmp_path_factory.mktemp("report")
        run_files.everything(cls.folder)
        cls.done = report(cls.folder)
        cls.html = (cls.folder / "page" / "report.html").read_text()
        cls.markdown = (cls.folder / "page" / "report.md").read_text()

    def row(self, *cells):
        """The line of the Markdown that holds all of these; where it stands in two tables, it is the same in both."""
        found = {line for line in self.markdown.splitlines() if all(c in line for c in cells)}
        assert len(found) == 1, f"{cells}: {found}"
        return found.pop()

    def test_it_is_written_whole(self):
        assert (self.done.returncode, self.done.stderr) == (0, "")
        names = sorted(p.name for p in (self.folder / "page").iterdir())
        pictures = sorted(re.findall(r"!\[.*?\]\((.+?)\)", self.markdown))
        assert names == sorted(pictures + ["report.html", "report.md"])  # no temporary file stays
        assert pictures == ["contacts-1.png", "flow-1-packing.png", "solver.png"]
        assert "Missing" not in self.markdown

    def test_nothing_is_loaded(self):
        parser = loads(self.html)
        assert parser.found == []
        assert parser.figures == 3
        assert len(parser.ids) == len(set(parser.ids))  # figures do not take each other's shapes
        for tag, bad in (("<img src='https://x/y.png'>", 2), ("<p style='background: url(http://x)'>", 1), ("<style>@import 'x';</style>", 1)):
            assert len(loads(tag).found) == bad  # and the search would find it

    def test_solver(self):
        # within 1 %: of mapped double 8 cells (1.7 %) are too coarse, 16 (0.63 %) do; within 0.3 %: 24 cells; within 0.1 %: none
        assert "| 0.210 s<br>16 cells, e +1.3 % | 0.740 s<br>24 cells, e +0.56 % | none |" in self.markdown
        assert "F 0.05 %, e 0.1 %" in self.markdown  # the reference's own error
        assert "changes the error of F by at most 0 %, of e by 0 %, and costs 0.62 to 0.62 of double" in self.markdown  # 0.46/0.74
        assert "0.460 CPU s<br>mapped, single" in self.row("Impact", "F within 0.3 %", "solver:")

    def test_law(self):
        assert "| 93.5 | 10.2 (9.22 to 12.3) |" in self.row("| velocity axis kept | 93.5 |")
        assert "| 21 | 1.9e-02 |" in self.row("| velocity axis dropped | 47.0 |")
        assert "solver's error (force 1.3 %" in self.markdown

    def test_flow(self):
        # solid fraction: 0.59 ± 0.01/sqrt(3) against 0.6 ± 0: -1.67 %, error 0.00577/0.6 = 0.96 %, t = 1.73 with 2 degrees of freedom: p = 0.23
        assert "−1.7 ± 1.0 %<br>not significant" in self.row("| hertz | 6 |")
        # stretched: +10 %, error 0.00577/0.6, t = 10.4: p = 0.009; wall-clock 2 of 20 s
        assert "+10.0 ± 1.0 %<br>**significant**" in self.row("| mpm, stretched by 10 | 60 | 2 ± 0 | 0.1 ± 0 |")  # 60 microseconds
        assert "11.0 ± 0.6" in self.row("| hertz | 6 |")  # wall-clock of 10, 11, 12 s
        assert "**Stopped.** mpm, stretched by 30: pair_style gran model mpm: stretch less." in self.markdown
        assert "**Stopped.** mpm, stretched by 100: stretch far less." in self.markdown
        assert "LIGGGHTS-TEST 1.2" in self.markdown

    def test_contacts(self):
        # V_y = 0.03 m/s * ((0.8 pi/100)^2/6.4e-4)^1.25; the largest speed is 1 m/s
        unit = 0.03 * ((0.008 * math.pi)**2 / run_files.ONSET)**1.25
        line = self.row("| packing | wax-wax, particles | 300 |")
        assert f"| {page.number(1.0 / unit)} |" in line
        assert "| 60 % |" in line  # 60 of 100 contacts at 0.01 m/s are below the onset at 0.03 m/s
        assert "| 9 | 0 |" in line  # three seeds of three contact-steps beyond the table

    def test_contacts_by_speed_and_overlap(self):
        deck = contacts_part.Contacts.__new__(contacts_part.Contacts)
        deck.joint, deck.mapped, deck.yield_speed = {}, True, 0.5
        entry = run_files.stats([(0.01, 60), (1.0, 40)], [(1e-4, 60), (0.02, 40)])["pairs"][0]
        deck.add_map(entry, "x")
        deck.add_map(entry, "x")
        speed, overlap, counts = deck.plane()
        assert counts.sum() == 200
        assert (counts[0, 0], counts[-1, -1]) == (120, 80)  # slow and flat, fast and deep; nothing between
        assert speed[-2] * 0.5 == approx(1.0, abs=1e-5)  # lower edge of the bin of 1 m/s, in V_y
        assert overlap[-2] <= 0.02 < overlap[-1]
        del entry["contact_map"]
        deck.add_map(entry, "x")
        assert deck.plane() is None  # one run of several did not count them

    @mark.parametrize("damaged", ({"speed_lower_edge": [1.0], "overlap_lower_edge": [1.0], "count": [[1, 2]]}, {"count": [[1]]}, [1],
                                  {"speed_lower_edge": ["a"], "overlap_lower_edge": [1.0], "count": [[1]]}))
    def test_a_cut_map(self, damaged):
        deck = contacts_part.Contacts.__new__(contacts_part.Contacts)
        deck.joint, deck.mapped = {}, True
        with raises(contacts_part.files.Unreadable):
            deck.add_map({"contact_map": damaged}, "x")

    def test_hard_cases(self):
        assert "2 cases: 1 stable with their energy balance closed, 1 refused with a sentence, 0 failed." in self.markdown


class TestFormulas:
    def test_map_of_a_hertz_law(self, folder):
        run_files.hertz_law(folder / "law.h5")
        law = contacts_part.Law(folder / "law.h5", ("wax",))
        speed, overlap = law.impacts()
        # W ~ x^2.5, so V/V_onset = (x/x_onset)^1.25; trapezoids over 20000 steps in x^(1/4): 1e-4 from a tenth of the onset up
        for v, x in list(zip(speed, overlap))[::500]:
            if x > 0.1 * run_files.ONSET:
                assert v * law.yield_per_onset / (x / run_files.ONSET)**1.25 == approx(1, abs=1e-4)
        # docs/theory/damage-number.md: rho V_y^2/Y = 25.5 (Y/E*)^4, so I = 25.5e-8 is V_y; 25.5 has three digits
        assert law.fastest(25.5e-8) == approx(1, abs=2e-3)

    def test_cheapest_run_stays_within(self):
        rows = [{"cpu_s": s, "L2_force": e} for s, e in ((1, 0.02), (2, 0.001), (3, 0.005), (4, 0.002))]
        assert solver_part.cheapest(rows, 0.003)["cpu_s"] == 4  # 2 s was luck
        assert solver_part.cheapest(rows, 0.01)["cpu_s"] == 2
        assert solver_part.cheapest(rows, 0.001) is None

    def test_numbers(self):
        assert page.with_error(-0.0832, 0.0215, plus=True) == "−0.08 ± 0.02"
        assert page.with_error(12.34, 3.4) == "12 ± 3"
        assert page.with_error(7.009e-6, 3.2e-6) == "(7 ± 3)e−6"
        assert page.with_error(0.1, 1e-17) == "0.1 ± 0"  # three equal numbers have a rounded spread
        assert page.with_error(-1e-5, 2e-3, plus=True) == "0.000 ± 0.002"
        assert page.number(0.04567) == "0.0457"
        assert page.number(None) == "n/a"


class TestMaking:
    def test_what_fails_is_named_and_a_stopped_stretch_is_not(self, folder):
        recipes = module(ROOT / "tools" / "reporting" / "recipes.py")
        script, lines = folder / "run.py", []
        script.write_text("import sys\nsys.exit(\"'stretch 30' takes the overlap to 0.6 R*: stretch less\")\n")
        recipes.PARTS = {"law": lambda out, quick: ["tools/no-such-program x", "true", f"/usr/bin/python3 {script}", f"/usr/bin/python3 {script} --stretch 30"]}
        assert recipes.make(str(folder), False, lines.append) == ["tools/no-such-program x", f"/usr/bin/python3 {script}"]
        said = "\n".join(lines)
        assert "No such file" in said
        assert "stopped: 'stretch 30' takes the overlap to 0.6 R*: stretch less" in said


    def test_decks_that_were_named(self):
        recipes = module(ROOT / "tools" / "reporting" / "recipes.py")
        lines = recipes.flow("out", False, 3, ["drop", "heap"])
        assert {line.split()[1] for line in lines[1:]} == {"examples/drop/run.py", "examples/heap/run.py"}
        assert all(line.endswith("--seeds 3") for line in lines[1:]), lines


class TestMissing:
    def test_each_part_names_its_commands(self, folder):
        assert without_drawing(folder) == (0, "")
        text = (folder / "page" / "report.md").read_text()
        for command in ("granulaw_cost_study", "law_size_benchmark", "examples/packing/run.py"):
            assert command in text
        assert text.count("**Missing.**") == 4  # solver, law, flow, contacts; the hard cases come with the tree
        assert text.count("figure ") == 0  # no empty plot
        assert "nan" not in text

    def test_small_versions_are_not_mixed_with_the_rest(self, folder):
        run_files.everything(folder / "quick")
        assert (without_drawing(folder), without_drawing(folder / "quick")) == ((0, ""), (0, ""))
        assert "**Missing.** No `cost.json`" in (folder / "page" / "report.md").read_text()
        assert "Missing" not in (folder / "quick" / "page" / "report.md").read_text()

    def test_a_folder_that_is_not_there(self, folder):
        done = run(ROOT / "tools" / "report", "--from", folder / "no", code=1)
        assert re.search(r"^tools/report: .*/no is no folder; .*\n$", done.stderr)


class TestOwnDecks:
    """Files of `stats FILE` in folders that no example made."""

    def write(self, folder, name="results.json", **more):
        folder.mkdir(parents=True, exist_ok=True)
        content = {**run_files.stats([(0.01, 60), (1.0, 40)], [(1e-3, 60), (0.05, 40)]), **more}
        for entry in content["pairs"]:
            entry["law"] = "mpm mine.h5"
        # as the plug-in writes it: these first
        (folder / name).write_text('{\n  "granulaw_version": "0",\n  "time_step_used_s": 1e-6,\n' + json.dumps(content)[1:])

    def series(self, rows=5):
        return {"time_s": [0.1 * k for k in range(rows)], **{name: [k * 1e-4 for k in range(rows)] for name in
                ("particles", "kinetic_J", "rotational_J", "normal_dissipation_J", "wave_dissipation_J", "fastest_particle_m_per_s")}}

    def page(self, folder):
        status, told = without_drawing(folder)
        return status, told, (folder / "page" / "report.md").read_text()

    def test_contacts_energies_and_speeds(self, folder):
        self.write(folder / "mill", series=self.series())
        run_files.hertz_law(folder / "mill" / "mine.h5")
        status, told, text = self.page(folder)
        assert (status, told) == (0, "")
        assert "| mill/results.json | wax-wax, particles | 100 |" in text
        for figure in ("figure contacts-1", "figure run-1"):
            assert figure in text
        assert text.count("**Missing.**") == 2  # solver, law
        run, = contacts_part.read_own(folder, [])[0]
        figure = contacts_part.picture_of_run(run)
        energies, fastest, speeds = figure.axes
        assert energies.get_ylabel() == "energy, µJ"
        for line in energies.lines:
            assert list(line.get_ydata()) == [100.0 * k for k in range(5)]
        assert {line.get_label() for line in energies.lines} == {"kinetic", "rotation", "taken by normal contacts", "taken by waves"}
        assert speeds.lines[0].get_xdata()[0] / 0.03 == approx(1, abs=1e-12)  # the onset, as the file has it
        page.plt.close(figure)

    def test_a_body_that_does_not_yield(self, folder):
        self.write(folder)
        text = (folder / "results.json").read_text()
        (folder / "results.json").write_text(text.replace('"onset_speed_m_per_s": 0.03', '"onset_speed_m_per_s": null'))
        status, told, text = self.page(folder)
        assert (status, told) == (0, "")
        assert re.search(r"\| 100 \| 0.01\d+ m/s \|", text)
        assert "The file has no energies over time" in text

    def test_what_cannot_be_used_is_one_sentence(self, folder):
        self.write(folder, series={"time_s": [1, 2], "kinetic_J": [1]})
        run_files.hertz_law(folder / "mine.h5")
        status, told, text = self.page(folder)
        assert status == 1
        assert re.search(r"^tools/report: \S+/results\.json: 'series' is no table with columns of one length\n$", told)
        (folder / "mine.h5").unlink()
        self.write(folder)
        status, told, text = self.page(folder)
        assert re.search(r"^tools/report: \S+/results\.json: its law 'mpm mine\.h5' is not there any more\n$", told)


class TestInstalled:
    def test_it_needs_of_the_sources_what_the_package_holds(self, folder):
        """In a folder as /usr/share/granulaw: tools/report, tools/reporting, examples/common."""
        share, folder = (folder / "share"), (folder / "runs")
        for part in ("tools/reporting", "examples/common"):
            shutil.copytree(ROOT / part, share / part, ignore=shutil.ignore_patterns("__pycache__"))
        shutil.copy(ROOT / "tools/report", share / "tools")
        TestOwnDecks().write(folder)
        run_files.hertz_law(folder / "mine.h5")
        done = run(share / "tools/report", "--from", folder, "-o", folder / "page", cwd=share.parent)
        assert done.stderr == ""
        assert "contacts: results.json" in done.stdout
        assert (folder / "page/run-1.png").exists()


class TestDamaged(InFolder):
    def check(self, damage, sentence, still="cheapest run"):
        """One sentence on stderr and on the page, exit 1, and the other parts as ever."""
        damage(self.folder, run_files.everything(self.folder))
        status, told = without_drawing(self.folder)
        assert (status, len(told.splitlines())) == (1, 1), told
        assert re.search("^tools/report: .*" + sentence, told)
        text = (self.folder / "page" / "report.md").read_text()
        assert re.search(sentence, text)
        assert still in text
        assert loads((self.folder / "page" / "report.html").read_text()).found == []

    def cut(self, path):
        content = path.read_bytes()
        path.write_bytes(content[:len(content) // 2])

    def test_a_cut_study(self):
        self.check(lambda root, deck: self.cut(root / "solver" / "cost.json"), r"cost\.json: not a whole JSON file", still="## (b) Law")

    def test_no_number(self):
        def damage(root, deck):
            content = run_files.cost()
            content["jobs"][0]["rows"][1]["err_e"] = math.nan
            (root / "solver" / "cost.json").write_text(json.dumps(content))
        self.check(damage, r"cost\.json: row 3: 'err_e' is nan, expected a number", still="## (b) Law")

    def test_another_study(self):
        self.check(lambda root, deck: (root / "law" / "law_size.json").write_text('{"benchmark": "other"}'),
                   r"law_size\.json: 'benchmark' is 'other', expected 'law_size'")

    def test_bytes(self):
        self.check(lambda root, deck: (root / "law" / "law_size.json").write_bytes(bytes(range(256))), r"law_size\.json: not a whole JSON file")

    def test_a_word_for_a_number(self):
        def damage(root, deck):
            text = (deck / "packing.csv").read_text()
            (deck / "packing.csv").write_text(text.replace("0.58", "abc"))
        self.check(damage, r"packing\.csv: line 2: value is 'abc', expected a number")

    def test_cut_statistics(self):
        self.check(lambda root, deck: self.cut(deck / "mpm-2" / "stats.json"), r"mpm-2/stats\.json: not a whole JSON file")

    def test_old_statistics(self):
        self.check(lambda root, deck: (deck / "mpm-2" / "stats.json").write_text("{}"), r"stats\.json: has no 'pairs': an older plug-in")

    def test_a_law_that_is_none(self):
        self.check(lambda root, deck: (deck / "law.h5").write_text("no law"), r"law\.h5: not a law file with material 'wax'")

    def test_old_hard_cases(self):
        # the tree's own table takes the place of one that cannot be read
        self.check(lambda root, deck: (root / "hard" / "hard-cases.json").write_text('{"mpm": "m", "runs": {}}'), r"hard-cases\.json: has no 'rows'")

    def test_hostile_names(self, folder):
        deck = run_files.everything(folder)
        with open(deck / "packing.csv", "a") as file:
            for model in ("hertz", "mpm"):
                file.writelines(f'{model},{k},"<script src=""http://x""></script>|a",{k}\n' for k in (1, 2, 3))
        assert without_drawing(folder) == (0, "")
        assert loads((folder / "page" / "report.html").read_text()).found == []
        assert "\\|a" in (folder / "page" / "report.md").read_text()


class TestHelp:
    def test_it_teaches(self):
        done = run(ROOT / "tools" / "report", "--help")
        for word in ("--make quick", "--from DIR", "cost.json", "law_size.json", "stats.json", "Exit:"):
            assert word in done.stdout
