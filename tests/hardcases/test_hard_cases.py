"""tools/hard_cases passes with this mpm, goes on where it was, and finds a solver that is wrong."""
import json
import os
from pathlib import Path

import programs
from programs import MPM, ROOT
from pytest import mark

pytestmark = mark.usefixtures("here")
# An mpm that hands the real one's answers on, falsified: its energy balance is open, and it runs at any Courant number.
WRONG = """#!/usr/bin/python3
import json, subprocess, sys
words = [w if w != "1.1" else "1.0" for w in sys.argv[1:]]
done = subprocess.run(["{mpm}", *words], capture_output=True, text=True)
if "--json" in words and done.returncode == 0:
    answer = json.loads(done.stdout)
    answer["energy_error"] = 0.01
    done.stdout = json.dumps(answer)
print(done.stdout, end="")
print(done.stderr, end="", file=sys.stderr)
sys.exit(done.returncode)
"""


def run(mpm, output, *words, code=0):
    done = programs.run(ROOT / "tools/hard_cases", "--mpm", mpm, "-o", output, *words, code=code, timeout=7200)
    print(done.stdout)
    return done


def made(done):
    """Runs that were made, not kept."""
    return sum(line.startswith("    mpm ") for line in done.stdout.splitlines())


def test_quick():
    first = run(MPM, "table", "--quick")
    text = Path("table.csv").read_text()
    assert text.count(",stable\n") >= 8 and "unstable above 1" in text and "FAILED" not in text
    second = run(MPM, "table", "--quick")
    assert made(first) > 10 and made(second) == 0 and Path("table.csv").read_text() == text
    # a stopped table goes on: with one run taken out, only that one is made
    kept = json.loads(Path("table.json").read_text())
    kept["runs"].pop(next(iter(kept["runs"])))
    Path("table.json").write_text(json.dumps(kept))
    assert made(run(MPM, "table", "--quick")) == 1


def test_judges():
    Path("wrong").write_text(WRONG.format(mpm=MPM))
    os.chmod("wrong", 0o755)
    assert "FAILED: energy error 1.0e-02" in run("wrong", "table", "--only", "nu = 0", "--quick", code=1).stdout
    assert "FAILED: should be refused" in run("wrong", "table", "--only", "Courant 1.1", code=1).stdout
    assert not Path("table.csv").exists()  # a part of the rows is not the table


def test_all():
    run(MPM, "table")
