#!/usr/bin/python3
"""tools/report --make quick makes every part it shows. Some ten minutes, mostly LIGGGHTS runs."""
import pathlib
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
with tempfile.TemporaryDirectory(prefix="granulaw-make-quick-") as name:
    done = subprocess.run([ROOT / "tools" / "report", "--make", "quick", "--from", name], text=True, capture_output=True)
    print(done.stdout, done.stderr)
    text = pathlib.Path(name, "report", "report.md").read_text()
    assert done.returncode == 0, done.stderr
    for words in ("mapped, double", "velocity axis dropped", "### Packing", "mpm, stretched by 3", "wax-wax, particles", "56 cases"):
        assert words in text, words
    # the quick study leaves the elastic impact out, and says so; nothing else is missing
    assert text.count("**Missing.**") == 1 and "The whole study" in text, text
print("ok")
