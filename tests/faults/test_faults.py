"""tools/faults: the rules on a made-up source, the pick of a seed, the results file, the comparison."""
import json
import sys

from faulting import battery, page, rules, workshop
from programs import ROOT, module, run

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


class TestFaults:
    def test_rules(self):
        """Code in functions alone: no comment, string, macro, message, guard, member or constant outside."""
        found = {kind: set() for kind in rules.KINDS}
        for fault in rules.faults_of(SOURCE, "mpm_core/law", "f.cpp"):
            assert SOURCE.split("\n")[fault.line - 1] == fault.before
            found[fault.kind].add(fault.after)
        found["swap"] = {line for line in found["swap"] if "fail" not in line}  # the condition of a guard may be swapped
        for kind in rules.KINDS:
            assert found[kind] == EXPECTED[kind], kind

    def test_pick(self):
        """The same seed picks the same; a larger count begins with a smaller one's; each folder and kind has its turn."""
        some, more, other = rules.picked(ROOT, 1, 35), rules.picked(ROOT, 1, 70), rules.picked(ROOT, 2, 35)
        assert some == more[:35]
        assert some != other
        assert {(f.folder, f.kind) for f in some} == {(f, k) for f in rules.FOLDERS for k in rules.KINDS}
        assert len({f.id for f in more}) == 70
        for fault in list(rules.named(ROOT)) + more:
            assert (ROOT / fault.path).read_text().split("\n")[fault.line - 1] == fault.before
            assert fault.before != fault.after
        assert rules.picked(ROOT, 1, 35, "tools/deck") == [f for f in some if f.folder == "tools/deck"]

    def test_results(self, folder):
        """A line that a kill cut off counts for nothing; the last line of a fault counts; nine in ten must be caught."""
        faults = [f for f in rules.named(ROOT)] + rules.picked(ROOT, 1, 10)
        file, text = folder / "r.jsonl", ""
        for k, f in enumerate(faults):
            for verdict in ("survived", "caught" if k else "survived"):
                text += json.dumps({"id": f.id, "folder": f.folder, "kind": f.kind, "file": f.path, "line": f.line, "named": f.named,
                                    "before": f.before.strip(), "after": f.after.strip(), "verdict": verdict, "by": "a.test",
                                    "changed": [] if k else ["law, fast"], "seconds": 1.0}) + "\n"
        file.write_text(text + text.splitlines()[0][:50])
        words = [sys.executable, ROOT / "tools/faults", "--count", "10", "--results", file]
        done = run(*words)  # all are done: nothing is built
        assert f"{len(faults) - 1} of {len(faults)} faults that change a result are caught" in done.stdout
        assert f"survived: {faults[0].path}:{faults[0].line}" in done.stdout
        (folder / "page.md").write_text("<!-- tools/faults: begin -->\n<!-- tools/faults: end -->\n")
        run(*words, "--page", folder / "page.md")
        shown = (folder / "page.md").read_text()
        assert f"**{len(faults) - 1} of the {len(faults)} faults that change a result are caught" in shown
        assert "law, fast" in (folder / "faults.csv").read_text()

    def test_comparison(self):
        assert battery.alike("e 0.5123456789012 N\n", "e 0.5123456789013 N\n")  # rounding
        assert not battery.alike("e 0.5123456789", "e 0.5123457789")
        assert not battery.alike("good", "bad")
        assert battery.told('{"e": 0.5, "cpu_s": 3}') == battery.told('{"e": 0.5, "cpu_s": 4}')
        assert battery.told('{"e": 0.5}') != battery.told('{"e": 0.6}')
        assert battery.told("  checksum = 1a\ne 0.5\n") == battery.told("  checksum = 2b\ne 0.5\n")  # it covers the time of creation

    def test_page_shows_what_changed(self):
        assert page.change("a = b + c;", "a = b - c;") == ("a = b + c;", "a = b - c;")


class TestKilled:
    """After a kill the same command goes on: no fault is tried twice, none is left out, the scratch copy is sound again."""

    def test_results_stay(self, folder, monkeypatch):
        tool = module(ROOT / "tools/faults")
        tried = []

        def judge(trial, fault, what):
            if len(tried) in (3, 7):
                tried.append(None)
                raise KeyboardInterrupt
            tried.append(fault.id)
            return {"id": fault.id, "folder": fault.folder, "kind": fault.kind, "file": fault.path, "line": fault.line, "named": fault.named,
                    "before": "", "after": "", "verdict": "caught", "by": "a.test", "changed": [], "seconds": 1.0}
        monkeypatch.setattr(tool.workshop.Workshop, "prepare", lambda shop: None)
        monkeypatch.setattr(tool.Trial, "__init__", lambda trial, shop: None)
        monkeypatch.setattr(tool.Trial, "judge", judge)
        monkeypatch.setattr(sys, "argv", ["faults", "--count", "10", "--results", str(folder / "r.jsonl")])
        assert [tool.main() for _ in range(4)] == [130, 130, 0, 0]
        tried = [t for t in tried if t]
        assert len(tried) == len(set(tried)) == len(list(rules.named(ROOT))) + 10

    def test_scratch_copy(self, folder):
        top = folder / "top"
        top.mkdir()
        (top / ".gitignore").write_text("/build\n")
        (top / "a.cpp").write_text("sound\n")
        run("git", "init", "-q", top)
        shop = workshop.Workshop(top, 1, print)
        shop.home.mkdir(parents=True)
        shop.copy_tree()
        (shop.source / "a.cpp").write_text("fault\n")  # as a kill leaves it
        (shop.source / "b.cpp").write_text("of an earlier tree\n")
        shop.copy_tree()
        assert {p.name for p in shop.source.iterdir()} == {".gitignore", "a.cpp"}
        assert (shop.source / "a.cpp").read_text() == "sound\n"

    def test_battery_of_the_sound_tree_is_kept(self, folder, monkeypatch):
        tool = module(ROOT / "tools/faults")
        ran = []
        monkeypatch.setattr(tool.battery, "run", lambda *_: ran.append(1) or {"impact": "e 0.5"})
        monkeypatch.setattr(workshop.Workshop, "fingerprint", lambda shop: "the same")
        shop = workshop.Workshop(folder, 1, print)
        shop.home.mkdir(parents=True)
        assert [tool.Trial(shop).sound for _ in range(2)] == [{"impact": "e 0.5"}] * 2
        assert len(ran) == 1
