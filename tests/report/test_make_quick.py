"""tools/report --make quick makes every part it shows. Some ten minutes, mostly LIGGGHTS runs."""
from programs import ROOT, run


def test_every_part(folder):
    done = run(ROOT / "tools/report", "--make", "quick", "--from", folder, timeout=7200)
    print(done.stdout, done.stderr)
    text = (folder / "report/report.md").read_text()
    for words in ("mapped, double", "velocity axis dropped", "### Packing", "mpm, stretched by 3", "wax-wax, particles", "56 cases"):
        assert words in text, words
    # the quick study leaves the elastic impact out, and says so; nothing else is missing
    assert text.count("**Missing.**") == 1 and "The whole study" in text, text
