"""Numbers that several pages state agree with the table that one of them holds; what a page says of a table, the table holds."""
import csv
import math
import os
import re
import statistics
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

def page(name):
    return (ROOT / name).read_text()

def tables(text):
    """[[cells of a row, ...], ...] of each table, without its head."""
    found = re.findall(r"^\|.*\|\n\|[-| ]+\|\n((?:\|.*\|\n)+)", text + "\n", re.MULTILINE)
    return [[[c.strip() for c in re.split(r"(?<!\\)\|", row)[1:-1]] for row in table.splitlines()] for table in found]

def table_with(text, head):
    """Rows of the one table whose head begins so."""
    assert text.count(head) == 1, f"{text.count(head)} tables begin with {head}"
    after = text[text.index(head):]
    return tables(after)[0]

def stored(name):
    """Rows of a CSV by the names of its columns, without its comments."""
    return list(csv.DictReader(line for line in page(name).splitlines() if not line.startswith("#")))

class Flows(unittest.TestCase):
    def test_margins_follow_from_means_and_errors(self):
        """Each margin of two one-sided tests is |difference| + t standard errors of the values that the deck's page has."""
        import sys
        sys.path.insert(0, str(ROOT / "examples/common"))
        import spread
        rows = table_with(page("docs/evidence/flows.md"), "| deck (seeds) | observable | wanted |")
        self.assertEqual(len(rows), 5)
        for deck, what, _, *margins in rows:
            name, seeds = re.fullmatch(r"(\w+) \((\d+)\)", deck).groups()
            text = page(f"examples/{name}/README.md")
            cells = next(row for table in tables(text) for row in table if row[0] == what and len(row) == 4)[1:]
            values = [tuple(map(float, re.match(r"([-\d.e]+) ± ([-\d.e+]+)", c).groups())) for c in cells]
            for (a, b), stated in zip(((1, 0), (2, 0), (2, 1)), margins):
                (m, s), (n, t) = values[a], values[b]
                freedom = (s**2 + t**2)**2 * (int(seeds) - 1) / (s**4 + t**4)
                least = 100 * (abs(m - n) + spread.student_quantile(0.05, freedom) * math.hypot(s, t)) / n
                self.assertAlmostEqual(least, float(stated), delta=0.051, msg=f"{deck}, {what}")  # rounded to 0.1

class Accuracy(unittest.TestCase):
    def test_estimates(self):
        """How many estimates hold in three dimensions: both errors of a run count, against one estimate."""
        found, ratios = {}, {}
        for row in stored("docs/evidence/estimates.csv"):
            true, stated = max(abs(float(row["e %"])), abs(float(row["F %"]))), float(row["estimate %"])
            held, count = found.get(row["set"], (0, 0))
            found[row["set"]] = (held + (true <= stated + 0.05), count + 1)  # both are rounded to 0.1
            ratios.setdefault("default" if row["set"] == "default" else "four", []).append(true / stated)
        (fit, of_fit), (fresh, of_fresh), (one, of_one) = (found[name] for name in ("rule", "fresh", "default"))
        self.assertEqual(fit, of_fit)
        text = page("docs/evidence/solver-accuracy.md")
        self.assertIn(f"It held in {fit + fresh} of {of_fit + of_fresh} runs on four grids (fresh jobs: {fresh} of {of_fresh};", text)
        self.assertIn(f"it held in {one} of {of_one}. The true error is {statistics.median(ratios['four']):.1f} and {statistics.median(ratios['default']):.1f} of", text)

class Times(unittest.TestCase):
    def test_laws_by_runs(self):
        """The times of the pages of the guide span those of the table, within a tenth."""
        rows = table_with(page("docs/evidence/particles.md"), "| law | runs | CPU s |")
        kinds = {"a law": rows, "by runs": rows[:3], "with layers": rows[3:]}
        for name in ("docs/guide/when-it-stops.md", "docs/guide/particle-laws.md", "docs/evidence/particles.md"):
            for low, high, kind in re.findall(r"(\d+) to (\d+) CPU seconds (a law|by runs|with layers)", page(name)):
                seconds = [float(row[2]) for row in kinds[kind]]
                self.assertTrue(0.9 * min(seconds) <= float(low) <= min(seconds) and max(seconds) <= float(high) <= 1.1 * max(seconds), (name, low, high))

    def test_three_dimensions(self):
        fast, slow, die = table_with(page("docs/guide/shapes.md"), "| run | CPU s | error estimate |")
        told = re.search(r"three dimensions \| (\d+) to (\d+) CPU seconds at 100 V_y, (\d+) to (\d+) at 15 V_y", page("docs/guide/when-it-stops.md"))
        for row, low, high in ((fast, told[1], told[2]), (slow, told[3], told[4])):
            for seconds in row[1].split(","):
                self.assertTrue(float(low) <= float(seconds) <= float(high), row)

class Limits(unittest.TestCase):
    """The page of limits and the README against the tables of the pages that they link to."""
    PAGE, README = page("docs/guide/limits.md"), page("README.md")

    def test_laws(self):
        atlas = stored("docs/evidence/atlas-checks.csv")
        force, e = ({row["bound"] for row in atlas if row["quantity"] == name} for name in ("F_max", "e"))
        self.assertEqual((len(force), len(e)), (1, 1))
        text = page("docs/evidence/atlas.md")
        self.assertIn(f"within **{min(force)} of F_max and {min(e)} of e**", text)
        for label, seeds in (("500 checks", ("1",)), ("500 that no choice has seen (seeds 13, 14)", ("13", "14"))):
            largest = lambda quantity, column: max((row[column] for row in atlas if row["seed"] in seeds and row["quantity"] == quantity), key=lambda x: float(x.rstrip(" %")))
            cells = [", ".join(largest(quantity, column).rstrip(" %") for column in ("median", "95 %", "worst")) for quantity in ("F_max", "e")]
            self.assertIn(f"| {label} | {cells[0]} % | {cells[1]} |", text)
        for row in stored("docs/evidence/atlas-bounds.csv"):
            if row["set"] == "fresh":
                values = [row[column].removesuffix(" %") for column in list(row)[3:]]
                holds = ", ".join(f"{float(x):.1f}".removesuffix(".0") if float(x) == 100 else x for x in values[4:6])
                self.assertIn(f"| {row['E*/Y']} | {values[0]} %, {values[1]} | {values[2]} %, {values[3]} | {holds} % | {values[6]} %, {values[7]} |".replace("*", "\\*"), text)
        self.assertIn(f"| F_max {min(force)}, e {min(e)} (95 % of impacts) |", self.PAGE)
        self.assertIn(f"| {min(force)}, {min(e)} in 95 % of impacts |", self.README)
        every = table_with(page("docs/evidence/pairs.md"), "| mixtures | within the bound: F, e |")[-1]
        (_, force, worst_force), (_, e, worst_e) = (cell.split(", ") for cell in every[2:4])
        self.assertIn(f"| F_max {force}, e {e} (95 % of mixtures); {worst_force}, {worst_e} (largest) |", self.PAGE)
        self.assertIn(f"| {force}, {e} in 95 % of mixtures |", self.README)
        runs = stored("docs/evidence/pairs-corrected.csv")
        largest = {column: max(abs(float(row[column])) for row in runs) for column in list(runs[0])[3:]}
        force, e = (f"{largest[f'corrected {name}']:g}" for name in ("F %", "e"))
        self.assertIn(f"(`--correct-pairs`) | F within {force} %, e within {e} at equal radii", page("docs/evidence/pairs.md"))
        self.assertIn(f"| corrected | {force} % | {e} |", page("docs/evidence/pairs.md"))
        self.assertIn(f"| composed | {largest['composed F %']} % | {largest['composed e']:g} |", page("docs/evidence/pairs.md"))
        self.assertIn(f"| F_max {force} %, e {e} | runs of both particles |", self.PAGE)
        runs = table_with(page("docs/evidence/particles.md"), "| law | runs | CPU s |")
        largest = max(float(row[3].rstrip(" %")) for row in runs)
        self.assertIn(f"agree within {largest:.1f} % of F and {max(float(row[4]) for row in runs)} of e", page("docs/evidence/particles.md"))
        self.assertIn(f"| F_max and e {largest:.1f} % (largest) | new runs |", self.PAGE)

    def test_pressed_from_six_sides(self):
        """The same three forces on the page of limits, of the atlas and in README."""
        force = next(row[1:] for row in table_with(self.PAGE, "| overlap of each contact | 0.05 R | 0.1 R | 0.2 R |"))
        self.assertIn(f"force {', '.join(force)} times the law's at 0.05, 0.1, 0.2 R", page("docs/evidence/atlas.md"))
        for text in (self.PAGE, self.README, page("examples/compression/README.md")):
            self.assertRegex(text, rf"\[?{re.escape(force[2])} times\b")

    def test_stretch(self):
        """What stretch changes in the hopper: coordination numbers of its table."""
        row = next(row for table in tables(page("examples/hopper/README.md")) for row in table if row[0] == "coordination number" and len(row) == 6)
        real, three, ten = (float(cell.split()[0]) for cell in row[1:4])
        rise = [f"{100 * (x / real - 1):.0f}" for x in (three, ten)]
        self.assertIn("rises by {} % at s = 3 and {} % at 10".format(*rise), page("docs/guide/plan.md"))
        self.assertIn("rises by {} and {} %".format(*rise), page("examples/hopper/README.md"))

    def test_shapes(self):
        rows = {row[0].split()[0]: row for row in table_with(page("docs/evidence/shapes.md"), "| body, E\\*/Y = 100 |")}
        force, e = ({k: row[n].split(", ")[1] for k, row in rows.items()} for n in (2, 3))
        for body, name in (("ellipsoid", "an ellipsoid of axes 1 : 1.2 : 1.5"), ("elongated", "one of axes 1 : 2 : 3"), ("clump", "a clump"), ("box", "a rounded box")):
            self.assertIn(f"| a sphere's law for {name} | F_max {force[body]}, e {e[body]}", self.PAGE)
        self.assertIn(f"| {force['ellipsoid']} ellipsoid, {force['clump']} clump, {force['box']} rounded box; axes of 1 : 2 : 3: {force['elongated']} |", self.README)

    def test_oblique(self):
        """Largest deviations of both tangential laws up to a contact radius of R/4, and in deep dents."""
        every = stored("docs/evidence/oblique-materials.csv")
        fitted, fresh = ([row for row in every if row["set"] == name] for name in ("fitted", "fresh"))
        shallow = [row for row in fitted if float(row["contact radius/R"]) <= 0.25]
        deep = [row for row in fitted if row not in shallow]

        def deviations(rows, law, quantity):
            return [abs(float(row[f"{law} {quantity} largest"])) for row in rows]

        def largest(rows, law):
            return [round(max(deviations(rows, law, quantity))) for quantity in ("e", "v_t", "omega")]

        text = page("docs/evidence/oblique.md")
        slow = [row for row in fresh if float(row["V/V_y"]) < 1000]
        for label, rows in (("to a contact radius of R/4:", shallow), ("deeper, to 0.17 R:", deep), ("fresh materials and speeds, to 671 V_y", slow),
                            ("fresh, at 1000 V_y", [row for row in fresh if row not in slow])):
            cells = ["; ".join(map(str, largest(rows, law))) for law in ("history", "plastic")]
            self.assertRegex(text, rf"\| {re.escape(label)}[^|]*\| {cells[0]} \| {cells[1]} \|")
        (e, speed, spin), plastic = largest(shallow, "history"), largest(shallow, "plastic")
        self.assertIn(f"errs by up to {spin} % in spin, {e} % in e and {speed} % in tangential velocity", text)
        self.assertIn(f"errs by up to {plastic[2]} % in spin, {plastic[1]} % in tangential velocity and {plastic[0]} % in e there", text)
        self.assertIn(f"spin up to {spin} %, tangential velocity {speed} %, e {e} % off", self.PAGE)
        self.assertIn(f"errs by up to {spin} %", self.README)
        self.assertIn(f"within {plastic[2]} %", self.README)
        self.assertIn(f"spin within {plastic[2]} %, tangential velocity {plastic[1]} %", page("docs/guide/tangential.md"))
        dents = [row for row in fitted if round(float(row["overlap/R"]), 2) >= 0.08]
        told = " | ".join(f"{min(spins):.0f} to {max(spins):.0f} %{off}" for spins, off in ((deviations(dents, "history", "omega"), " off"), (deviations(dents, "plastic", "omega"), "")))
        self.assertIn(f"| deep dents, overlap from 0.08 R on | spin {told} |", page("docs/guide/tangential.md"))

    def test_loop_time(self):
        text = page("docs/evidence/loop-time.md")
        rows = [row for row in table_with(text, "| scene of `settled.py` | mpm, no axis |") if "`tangential off`" not in row[0]]
        times = [float(cell.split()[0]) for row in rows for cell in row[1:4] if cell.strip()]
        low, high = min(times), max(times)
        self.assertIn(f"the loop time is {low:.2f} to {high:.2f} of stock Hertz's", text)
        wall = re.search(r"([\d.]+) \(mpm\)", text)[1]
        self.assertIn(f"| {low:.2f} to {high:.2f} of stock Hertz's; {wall} if only walls are touched |", self.PAGE)
        self.assertIn(f"is {low:.2f} to {high:.2f} of stock Hertz's in", self.README)
        self.assertIn(f"only a wall take {wall} of", self.README)

    def test_time_of_the_tangential_law(self):
        """The guide's table against all that is said of it."""
        rows = table_with(page("docs/guide/tangential.md"), "| deck | E\\*/Y | `history` | `plastic` |")
        times = [float(row[3].split()[0]) for row in rows]
        low, high = min(times), max(times)
        energy = re.search(r"pressed bed then takes ([\d.]+) of Hertz's", page("docs/evidence/loop-time.md"))[1]
        self.assertIn(f"`tangential plastic`; a bed pressed to a solid fraction of 0.94 with `energy on` | {low:.1f} to {high:.1f}; {energy} |", self.PAGE)
        self.assertIn(f"A bed pressed to a solid fraction of 0.94 takes {energy} times Hertz's time with `energy on`,", self.README)
        self.assertIn(f"takes {low:.1f} to {high:.1f}.", self.README)
        self.assertIn(f"takes {high:.1f} times Hertz's time", page("docs/project/roadmap.md"))

    def test_solver(self):
        solver = page("docs/evidence/solver-accuracy.md")
        self.assertRegex(solver, r"0\.3 % of finite elements")
        self.assertRegex(solver, r"\b(?:two|2)\W+of 76 estimates\b")
        self.assertIn("| 74 of 76 estimates hold; the others are exceeded by at most 0.3 % |", self.PAGE)
        for text in (self.PAGE, self.README):
            self.assertIn("F_max, e | 0.3 % | finite elements", text)

    def test_drop(self):
        self.assertRegex(page("examples/drop/README.md"), r"`mpm law` by (?:at most )?7e-5")
        self.assertIn("| collision in LIGGGHTS: e | 7e-5 |", self.PAGE)
        self.assertIn("within 7e-5 |", self.README)

class Project(unittest.TestCase):
    def test_one_place_of_the_address(self):
        """An address that nobody has filled in stands in CITATION.cff alone."""
        files = subprocess.run(["git", "grep", "-l", r"@granulaw\.invalid"], cwd=ROOT, capture_output=True, text=True).stdout.split()
        self.assertLessEqual(set(files), {"CITATION.cff"})

    def test_version(self):
        """One version in the build, the citation, the BibTeX entry, the changes."""
        version = re.search(r"project\(granulaw VERSION ([\d.]+)", page("CMakeLists.txt"))[1]
        self.assertIn(f"\nversion: {version}\n", page("CITATION.cff"))
        self.assertIn(f"version = {{{version}}}", page("docs/guide/cite.md"))
        self.assertRegex(page("CHANGELOG.md"), rf"(?m)^## {re.escape(version)}\b")
        self.assertIn(f"| program | {version} |", page("docs/project/versions.md"))

OBSERVABLES = stored("examples/differences.csv")

class Examples(unittest.TestCase):
    def test_differences(self):
        """The page's significant differences are those of the file; its speeds, too."""
        text = page("examples/README.md")
        for deck, what, models, change in table_with(text, "| deck (seeds) | observable | models | change |"):
            name, seeds = re.fullmatch(r"(\w+) \((\d+)\)", deck).groups()
            row = next(row for row in OBSERVABLES if (row["deck"], row["observable"]) == (name, what))
            self.assertEqual(row["seeds"], seeds)
            self.assertTrue(row["{} differs from {}".format(*models.split(", "))].startswith(f"yes, {change}, p"), (deck, what))
        ratios = [float(row["ratio of the yielding particle"]) for row in stored("examples/planned.csv")]
        self.assertIn(f"the plan is {min(ratios):.1f} to {max(ratios):.1f} times the speed visited", text)

    def test_thornton_below_the_law(self):
        """The page of model thornton against the drops of the examples."""
        rows = [row for row in OBSERVABLES if row["observable"].startswith("e on the wall at ")]
        low = [round(100 * (1 - float(row["thornton"].split()[0]) / float(row["mpm"].split()[0]))) for row in rows[:3]]
        self.assertIn(": {}, {}, {} % at".format(*low), page("docs/reference/pair_gran_model_thornton.md"))

    def test_thornton_against_the_solver(self):
        """The closed form with p_y = 1.6 Y and 2.5 Y against e of the hard cases; e by Poisson's ratio there."""
        cases = {row["case"]: float(row["e"]) for row in stored("docs/evidence/hard-cases.csv") if row["e"]}

        def off(speed, e, y):
            x = (y / 1.6) ** 2.5 / speed
            form = math.sqrt(6 * math.sqrt(3) / 5) * math.sqrt(1 - x * x / 6) * (x / (x + 2 * math.sqrt(6 / 5 - x * x / 5))) ** 0.25
            return f"{100 * (form / e - 1):+.0f}"

        for stiffness, names in (("100", {v: f"V/V_y = {v}" for v in (5, 20, 100, 500)}), ("1000", {v: f"E*/Y = 1000, V/V_y = {v}" for v in (100, 1000)})):
            cells = [", ".join(off(v, cases[name], y) for v, name in names.items()) for y in (1.6, 2.5)]
            self.assertIn(f"| {stiffness}: {', '.join(map(str, names))} | {cells[0]} | {cells[1]} |", page("docs/reference/pair_gran_model_thornton.md"))
        nu = [round(cases[name], 3) for name in ("nu = 0", "V/V_y = 100", "nu = 0.49")]
        self.assertIn("e is {}, {}, {} for $\\nu$ = 0, 0.3, 0.49".format(*(f"{e:.3f}" for e in nu)), page("docs/theory/law.md"))

    def test_calibration(self):
        """Coverage of the intervals: the summary spans the table, its rows of two kinds."""
        rows = table_with(page("docs/evidence/calibration.md"), "| synthetic data sets | identified |")
        known, free = [], []
        for row in rows:
            (free if "hardening" in row[0] or row[0].startswith("drops, E and Y") else known).extend(int(x) for x in row[2].split(", "))
        self.assertIn(f"in {min(known)} to {max(known)} of 100 data sets", page("docs/evidence/calibration.md"))
        self.assertIn(f"It is {min(free)} to {max(free)} of 100 where", page("docs/evidence/calibration.md"))

    def test_heap(self):
        """The verdicts of the pile: the page's answer is no stronger than the table of all decks."""
        angle = next(row for row in OBSERVABLES if row["deck"] == "heap" and "angle" in row["observable"])
        self.assertTrue(not any(cell.startswith("yes") for cell in angle.values()))
        self.assertIn("**Answer.** Perhaps: 16 degrees", page("examples/heap/README.md"))

    def test_speeds_of_the_hopper(self):
        """The page on plan quotes the row of the smaller hopper."""
        row = next(row for row in stored("examples/planned.csv") if (row["deck"], row["model"]) == ("hopper", "mpm"))
        pair, hit, wall, touched = (row[f"{side} {what} m/s"] for side in ("pairs", "walls") for what in ("planned", "visited"))
        self.assertIn(f"bounds of {pair} and {wall} m/s, and its simulations under `mpm` visited {hit} and {touched}", page("docs/guide/plan.md"))

    def test_compression(self):
        rows = [row for row in OBSERVABLES if row["deck"] == "compression" and "stress" in row["observable"]]
        ratios = [float(row["mpm"].split()[0]) / float(row["thornton"].split()[0]) for row in rows]
        self.assertIn(f"and {min(ratios):.1f} to {max(ratios):.1f} times Thornton's", page("examples/compression/README.md"))

    def test_irregular(self):
        """The clump's certificate on its page and in the table of shapes."""
        rows = {row[0].split()[0]: row for row in table_with(page("docs/evidence/shapes.md"), "| body, E\\*/Y = 100 |")}
        text = page("examples/irregular/README.md")
        (median, most), (e, e_most) = (rows["clump"][k].split(", ") for k in (2, 3))
        self.assertIn(f"F_max is off by {median} in the median and {most} at 95 %, e by {e} and {e_most}. The solver error is {rows['clump'][4]}", text)
        self.assertIn(f"(34 runs, {rows['clump'][5]} CPU s)", text)
        self.assertIn(f"The mesh takes {rows['mesh'][5]} CPU s", text)

    def test_gallery(self):
        """Answers that the README and the gallery quote."""
        mixture = re.search(r"lactose with mcc dissipate \(([\d.]+) ±", page("examples/mixture/README.md"))[1]
        clumps = re.search(r"mpm ([\d.]+) \[", page("examples/clumps/README.md"))[1]
        self.assertIn(f"dissipate {mixture} % less", page("README.md"))
        self.assertIn(f"dissipate {mixture} % less", page("examples/README.md"))
        self.assertIn(f"at {clumps} of Hertz's time", page("examples/README.md"))

    def test_corrected_laws(self):
        """Error bounds of corrected laws in the guide: those of the table of evidence."""
        force, e = ([float(row[column]) for row in stored("docs/evidence/pairs-corrected.csv")] for column in ("bound of F %", "bound of e"))
        self.assertIn(f"{min(force)} to {max(force)} % of F, {min(e):.3f} to {max(e):.3f} of e in the cases measured", page("docs/guide/pairs.md"))
        self.assertIn(f"| {min(force)} to {max(force)} % of F, {min(e):.3f} to {max(e):.3f} of e |", page("docs/evidence/pairs.md"))

class Published(unittest.TestCase):
    def test_table_is_that_of_the_stored_rows(self):
        table = subprocess.run(["/usr/bin/python3", ROOT / "tests/validation/published/compare.py", "--table", ROOT / "docs/evidence/published/compared.csv"],
                               capture_output=True, text=True, check=True).stdout
        printed = [[cell.strip().strip("`") for cell in row.split("|")[1:-1]] for row in table.splitlines()]
        self.assertGreater(len(printed), 10)
        self.assertEqual([printed[0], *printed[2:]], list(csv.reader(page("docs/evidence/published/summary.csv").splitlines())))

    def test_formulas(self):
        """Every cell of both tables is the CSV's, rounded."""
        known = {(r["E*/Y"], r["quantity"], float(r["at"])): r for r in stored("docs/evidence/formulas.csv")}
        columns = {"e": ("law", "Thornton 1.6", "Thornton 2.5", "Thornton 2.8", "Jackson-Green"),
                   "force": ("law", "Hertz", "Thornton 1.6", "Thornton 2.5", "Thornton 2.8", "Jackson-Green")}
        for quantity, head in (("e", "| E*/Y | V/V_y | law |"), ("force", "| E*/Y | overlap/R | F/(Y R²), law |")):
            rows = table_with(page("docs/evidence/formulas.md"), head)
            self.assertGreater(len(rows), 5)
            for stiffness, at, *cells in rows:
                row = known[stiffness, quantity, float(at)]
                for cell, column in zip(cells, columns[quantity], strict=True):
                    self.assertEqual(bool(cell), bool(row[column]), (stiffness, at, column))
                    if cell:
                        digits = len(cell.partition(".")[2])
                        self.assertLessEqual(abs(float(cell) - float(row[column])), 0.5001 * 10**-digits, (stiffness, at, column))
        times = table_with(page("docs/evidence/formulas.md"), "| over the law's | 1.6 Y |")
        for name, *cells in times:
            for cell, factor in zip(cells, ("1.6", "2.5", "2.8"), strict=True):
                self.assertAlmostEqual(float(cell), float(known["100", name, 50.0][f"Thornton {factor}"]), delta=0.0051)

class Matlab(unittest.TestCase):
    def test_names(self):
        """The columns, groups and attributes that the Matlab lines name are in the files."""
        import h5py
        block = re.search(r"```matlab\n(.*?)```", page("docs/reference/law-format.md"), re.DOTALL)[1]
        with tempfile.TemporaryDirectory() as folder:
            run = lambda *words: subprocess.run([os.environ["GRANULAW_MPM"], *words], cwd=folder, check=True, capture_output=True)
            (Path(folder) / "m.toml").write_text(re.search(r"```toml\n(.*?)```", page("docs/guide/first-flow.md"), re.DOTALL)[1])
            run("table", "m.toml", "-o", "law.h5")
            run(*re.search(r"system\('mpm (.*?)'\)", block)[1].split())
            lines = (Path(folder) / "law.csv").read_text().splitlines()
            columns = next(line for line in lines if not line.startswith("#")).split(",")
            named = set(re.findall(r"law\.(\w+)[,)]", block))
            self.assertGreaterEqual(named, {"pair", "overlap_m", "force_N"})
            self.assertLessEqual(named - {"h5"}, set(columns))
            self.assertIn("wax:wall", {line.split(",")[0] for line in lines})
            with h5py.File(Path(folder) / "law.h5") as file:
                for place in re.findall(r"h5read\('law.h5', '(\S+?)'\)", block):
                    self.assertIn(place, file)
                for place, name in re.findall(r"h5readatt\('law.h5', '(\S+?)', '(\w+)'\)", block):
                    self.assertIn(name, file[place].attrs)

if __name__ == "__main__":
    unittest.main()
