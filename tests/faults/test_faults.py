#!/usr/bin/python3
"""tools/faults: the rules on a made-up source, the pick of a seed, the results file, the comparison. test_faults.py SOURCE."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

TOP = pathlib.Path(sys.argv.pop(1) if len(sys.argv) > 1 else ".").resolve()
sys.path.insert(0, str(TOP / "tools"))
from faulting import battery, page, rules  # noqa: E402

SOURCE = """#include <cmath>  // a + b
#define TWICE(x) (x + x)
constexpr double outside = 1 + 2;  // no function
struct S
{
  double a = b - c;
};
double f(double a, double b)
{
  // a - b, if (a) ...
  const char* text = "a + b * c";
  if (a < 0) fail("f", fmt::format("{}", a + b));
  if (a < b) return a - b;
  for (int k = 0; k < 3; ++k) sum += v[k + 1] * 2.5;
  return a > b ? a : b;
}
"""
EXPECTED = {
    "sign": {"  if (a < b) return a + b;", "  for (int k = 0; k < 3; ++k) sum -= v[k + 1] * 2.5;"},
    "factor": {"  for (int k = 0; k < 3; ++k) sum += v[k + 1] * 1.01 * 2.5;", "  for (int k = 0; k < 3; ++k) sum += 1.01 * v[k + 1] * 2.5;"},
    "off by one": {"  for (int k = 0; k <= 3; ++k) sum += v[k + 1] * 2.5;", "  for (int k = 1; k < 3; ++k) sum += v[k + 1] * 2.5;",
                   "  for (int k = 0; k < 3; ++k) sum += v[k] * 2.5;"},
    "branch": {"  if (!(a < b)) return a - b;", "  if (false && (a < b)) return a - b;", "  return a > b ? b : a;"},
    "swap": {"  if (b < b) return a - b;", "  if (a < a) return a - b;", "  if (a < b) return b - b;", "  if (a < b) return a - a;",
             "  return b > b ? a : b;", "  return a > b ? b : b;", "  return a > b ? a : a;"},
}


class Faults(unittest.TestCase):
    def test_rules(self):
        """Code in functions alone: no comment, string, macro, message, guard, member or constant outside."""
        found = {kind: set() for kind in rules.KINDS}
        for fault in rules.faults_of(SOURCE, "mpm_core/law", "f.cpp"):
            self.assertEqual(SOURCE.split("\n")[fault.line - 1], fault.before)
            found[fault.kind].add(fault.after)
        found["swap"] = {line for line in found["swap"] if "fail" not in line}  # the condition of a guard may be swapped
        for kind in rules.KINDS:
            self.assertEqual(found[kind], EXPECTED[kind], kind)

    def test_pick(self):
        """The same seed picks the same; a larger count begins with a smaller one's; each folder and kind has its turn."""
        some, more, other = rules.picked(TOP, 1, 35), rules.picked(TOP, 1, 70), rules.picked(TOP, 2, 35)
        self.assertEqual(some, more[:35])
        self.assertNotEqual(some, other)
        self.assertEqual({(f.folder, f.kind) for f in some}, {(f, k) for f in rules.FOLDERS for k in rules.KINDS})
        self.assertEqual(len({f.id for f in more}), 70)
        for fault in list(rules.named(TOP)) + more:
            self.assertEqual((TOP / fault.path).read_text().split("\n")[fault.line - 1], fault.before)
            self.assertNotEqual(fault.before, fault.after)
        self.assertEqual(rules.picked(TOP, 1, 35, "tools/deck"), [f for f in some if f.folder == "tools/deck"])

    def test_results(self):
        """A line that a kill cut off counts for nothing; the last line of a fault counts; nine in ten must be caught."""
        faults = [f for f in rules.named(TOP)] + rules.picked(TOP, 1, 10)
        with tempfile.TemporaryDirectory() as folder:
            file, text = pathlib.Path(folder, "r.jsonl"), ""
            for k, f in enumerate(faults):
                for verdict in ("survived", "caught" if k else "survived"):
                    text += json.dumps({"id": f.id, "folder": f.folder, "kind": f.kind, "file": f.path, "line": f.line, "named": f.named,
                                        "before": f.before.strip(), "after": f.after.strip(), "verdict": verdict, "by": "a.test",
                                        "changed": [] if k else ["law, fast"], "seconds": 1.0}) + "\n"
            file.write_text(text + text.splitlines()[0][:50])
            words = [sys.executable, str(TOP / "tools/faults"), "--count", "10", "--results", str(file)]
            done = subprocess.run(words, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)  # all are done: nothing is built
            self.assertIn(f"{len(faults) - 1} of {len(faults)} faults that change a result are caught", done.stdout)
            self.assertIn(f"survived: {faults[0].path}:{faults[0].line}", done.stdout)
            subprocess.run([*words, "--page", str(pathlib.Path(folder, "page.md"))], check=True)
            shown = pathlib.Path(folder, "page.md").read_text()
            self.assertIn(f"| all | {len(faults) - 1} | 1 | 0 | 0 |", shown)  # caught, survived, no change seen, not compiled
            self.assertIn(f"**{len(faults) - 1} of the {len(faults)} faults that change a result are caught", shown)
            self.assertIn("law, fast", pathlib.Path(folder, "faults.csv").read_text())

    def test_comparison(self):
        self.assertTrue(battery.alike("e 0.5123456789012 N\n", "e 0.5123456789013 N\n"))  # rounding
        self.assertFalse(battery.alike("e 0.5123456789", "e 0.5123457789"))
        self.assertFalse(battery.alike("good", "bad"))
        self.assertEqual(battery.told('{"e": 0.5, "cpu_s": 3}'), battery.told('{"e": 0.5, "cpu_s": 4}'))
        self.assertNotEqual(battery.told('{"e": 0.5}'), battery.told('{"e": 0.6}'))

    def test_page_shows_what_changed(self):
        self.assertEqual(page.change("a = b + c;", "a = b - c;"), ("a = b + c;", "a = b - c;"))


if __name__ == "__main__":
    unittest.main()
