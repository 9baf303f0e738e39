"""The first page of the guide works as it stands: its materials file, its command, its deck."""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/examples"))
import steps  # noqa: E402

PAGE = (ROOT / "docs/guide/first-flow.md").read_text()


def block(beginning):
    """The fenced block that begins with this line."""
    return next(b for b in re.findall(r"```\w*\n(.*?)```", PAGE, re.DOTALL) if b.startswith(beginning))


class FirstFlow(unittest.TestCase):
    def test_as_written(self):
        with tempfile.TemporaryDirectory() as folder:
            def run(*command):
                done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=120)
                self.assertEqual(done.returncode, 0, done.stdout[-1000:] + done.stderr[-1000:])
                return done.stdout
            (Path(folder) / "materials.toml").write_text(block("[material.wax]"))
            (Path(folder) / "in.first").write_text(block("atom_style"))
            made = run(os.environ["GRANULAW_MPM"], "table", "materials.toml", "-o", "wax.h5")
            self.assertEqual(made, block("wrote wax.h5"))
            law = run(os.environ["GRANULAW_MPM"], "law", "wax.h5", "--pair", "wax:wall", "--radius", "3e-3", "--velocity", "1.0")
            # the page's number; the atlas may change its last digit
            self.assertAlmostEqual(float(re.search(r"restitution e +([\d.]+)", law)[1]), float(re.search(r"restitution e +([\d.]+)", PAGE)[1]), delta=0.002)
            log = run(os.environ["GRANULAW_LAUNCHER"], "-in", "in.first")
            shown = [b for b in re.findall(r"```text\n(.*?)```", PAGE, re.DOTALL) if not b.startswith("atom_style")]
            for line in "".join(shown).splitlines():  # what the page shows is what they say
                self.assertIn(line, (made + law + log).splitlines())
            self.assertNotIn("WARNING: granulaw", log)
            self.assertRegex(log, r"(?m)^ +100000 +150 ")  # all particles are there at the end
            # the page's picture: all particles are in its frame, and the script draws it
            frame = [line.split() for line in (Path(folder) / "frame_30000.txt").read_text().splitlines()[9:]]
            self.assertEqual(len(frame), 150)
            self.assertTrue(all(0 < float(row[3]) < 0.075 for row in frame))
            (Path(folder) / "frame.py").write_text(block("import matplotlib"))
            run("/usr/bin/python3", "frame.py")
            self.assertEqual((Path(folder) / "frame.png").read_bytes()[:4], b"\x89PNG")
            if os.environ.get("GRANULAW_KEEP_FRAME"):
                shutil.copy(Path(folder) / "frame.png", os.environ["GRANULAW_KEEP_FRAME"])
            # a deck that is no example: its contacts, energies and speeds
            told = run(ROOT / "tools/report", "--from", ".", "-o", "page")
            self.assertIn("contacts: stats.json", told)
            page = (Path(folder) / "page/report.md").read_text()
            self.assertRegex(page, r"\| stats.json \| wax-wax, particles \| \d+ \|")
            for name in ("contacts-1.png", "run-1.png"):
                self.assertIn(f"]({name})", page)
                self.assertTrue((Path(folder) / "page" / name).exists())
            self.assertNotIn("no energies over time", page)
            stats = json.loads((Path(folder) / "stats.json").read_text())
            steps.check(self, os.environ["GRANULAW_MPM"], [Path(folder) / "in.first"], stats, log)


class Readme(unittest.TestCase):
    def test_commands(self):
        """The commands of the README, in turn: the collision of the solver and of the law agree within the law's error bound."""
        lines = re.findall(r"(?m)^    (mpm .*?)(?:  #.*)?$", (ROOT / "README.md").read_text())
        self.assertEqual([line.split()[1] for line in lines], ["impact", "table", "law"])
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "examples").symlink_to(ROOT / "examples")
            said = []
            for line in lines:
                done = subprocess.run([os.environ["GRANULAW_MPM"], *line.split()[1:]], cwd=folder, capture_output=True, text=True, timeout=120)
                self.assertEqual(done.returncode, 0, line + done.stderr)
                said.append(done.stdout)
        bound = float(re.search(r"error bound .* e ([\d.]+)", said[2])[1])
        e = [float(re.search(r"restitution e +([\d.]+)", text)[1]) for text in (said[0], said[2])]
        self.assertLess(abs(e[0] - e[1]), bound)


if __name__ == "__main__":
    unittest.main()
