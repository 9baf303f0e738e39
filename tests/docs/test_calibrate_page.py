"""The worked cases of docs/guide/calibrate.md run as printed, and say what the page says, digit for digit. With `flows` also the commands
that need LIGGGHTS; with `write` the page gets what they say."""
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
FILE = TOP / "docs/guide/calibrate.md"
PAGE = FILE.read_text()
CASES = PAGE[PAGE.index("## Worked cases"):]
MODE = sys.argv.pop() if len(sys.argv) > 1 else ""
FLOWS, WRITE = MODE == "flows", MODE == "write"


def blocks():
    """[(commands, the output on the page or None)]."""
    found = re.findall(r"```(sh|text)\n(.*?)```", CASES, re.DOTALL)
    return [(text.strip().splitlines(), found[k + 1][1].strip() if found[k + 1:] and found[k + 1][0] == "text" else None)
            for k, (kind, text) in enumerate(found) if kind == "sh"]


class WorkedCases(unittest.TestCase):
    def test_as_printed(self):
        mpm = Path(os.environ["GRANULAW_MPM"]).resolve()
        with tempfile.TemporaryDirectory() as folder:
            for name in ("examples", "tools", "docs"):
                (Path(folder) / name).symlink_to(TOP / name)
            (Path(folder) / "out/calibrate").mkdir(parents=True)
            path = os.pathsep.join([str(mpm.parent), *([str(Path(os.environ["GRANULAW_LAUNCHER"]).resolve().parent)] if FLOWS else []),
                                    os.environ["PATH"]])
            ran = 0
            for commands, said in blocks():
                for command in commands:
                    if not command.startswith("mpm ") and not FLOWS:
                        continue
                    done = subprocess.run(command, shell=True, cwd=folder, capture_output=True, text=True, env={**os.environ, "PATH": path}, timeout=1200)
                    self.assertEqual(done.returncode, 0, command + done.stdout[-500:] + done.stderr[-1000:])
                    ran += 1
                    if said and command.startswith("mpm "):
                        printed = done.stdout.strip().splitlines()[-1]
                        if WRITE:
                            FILE.write_text(FILE.read_text().replace(said, printed))
                        else:
                            self.assertEqual(printed, said)
            self.assertGreater(ran, 3)


if __name__ == "__main__":
    unittest.main()
