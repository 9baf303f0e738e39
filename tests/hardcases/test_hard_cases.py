#!/usr/bin/python3
"""tools/hard_cases passes with this mpm, goes on where it was, and finds a solver that is wrong.

    test_hard_cases.py tools/hard_cases MPM quick|judges|all
"""
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

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


def run(mpm, output, *words):
    return subprocess.run([TOOL, "--mpm", mpm, "-o", output, *words], capture_output=True, text=True)


def made(done):
    """Runs that were made, not kept."""
    return sum(line.startswith("    mpm ") for line in done.stdout.splitlines())


def case_quick():
    first = run(MPM, "table", "--quick")
    print(first.stdout)
    assert first.returncode == 0, first.stdout + first.stderr
    text = Path("table.md").read_text()
    assert text.count("| stable |") >= 8 and "unstable above 1" in text and "FAILED" not in text
    second = run(MPM, "table", "--quick")
    assert made(first) > 10 and made(second) == 0 and Path("table.md").read_text() == text
    # a stopped table goes on: with one run taken out, only that one is made
    kept = json.loads(Path("table.json").read_text())
    kept["runs"].pop(next(iter(kept["runs"])))
    Path("table.json").write_text(json.dumps(kept))
    assert made(run(MPM, "table", "--quick")) == 1


def case_judges():
    Path("wrong").write_text(WRONG.format(mpm=MPM))
    os.chmod("wrong", 0o755)
    done = run("wrong", "table", "--only", "nu = 0", "--quick")
    assert done.returncode == 1 and "FAILED: energy error 1.0e-02" in done.stdout, done.stdout
    done = run("wrong", "table", "--only", "Courant 1.1")
    assert done.returncode == 1 and "FAILED: should be refused" in done.stdout, done.stdout
    assert not Path("table.md").exists()  # a part of the rows is not the table


def case_all():
    done = run(MPM, "table")
    print(done.stdout)
    assert done.returncode == 0, done.stdout + done.stderr


if __name__ == "__main__":
    TOOL, MPM = str(Path(sys.argv[1]).resolve()), str(Path(sys.argv[2]).resolve())
    with tempfile.TemporaryDirectory(prefix="granulaw_hardcases_") as folder:
        os.chdir(folder)
        globals()["case_" + sys.argv[3]]()
        os.chdir("/")
