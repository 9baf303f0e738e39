"""The first page of the guide works as it stands: its materials file, its command, its deck."""
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

PAGE = (Path(__file__).resolve().parents[2] / "docs/guide/first-flow.md").read_text()


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
            self.assertIn("wax: from the atlas", made)
            law = run(os.environ["GRANULAW_MPM"], "law", "wax.h5", "--pair", "wax:wall", "--radius", "3e-3", "--velocity", "1.0")
            # the page's number; the atlas may change its last digit
            self.assertAlmostEqual(float(re.search(r"restitution e +([\d.]+)", law)[1]), float(re.search(r"restitution e +([\d.]+)", PAGE)[1]), delta=0.002)
            log = run(os.environ["GRANULAW_LAUNCHER"], "-in", "in.first")
            self.assertIn("granulaw contact laws", log)
            self.assertNotIn("WARNING: granulaw", log)
            self.assertRegex(log, r"(?m)^ +100000 +150 ")  # all particles are there at the end
            self.assertTrue((Path(folder) / "stats.json").exists())


if __name__ == "__main__":
    unittest.main()
