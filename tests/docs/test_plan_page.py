"""Numbers and promises of the page on plan and soften."""
import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
PAGE = (SOURCE / "docs/guide/plan.md").read_text()
HOPPER = SOURCE / "examples/hopper"
TEMPLATES = """
units si
atom_style granular
boundary f f f
newton off
communicate single vel yes
region box block -0.05 0.05 -0.05 0.05 0 0.5 units box
create_box 1 box
neighbor 0.002 bin
"""


class PlanPage(unittest.TestCase):
    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))

    def run_in(self, *command):
        # LIGGGHTS 3.8.0 adds bytes of freed memory to some of its errors
        return subprocess.run(list(map(str, command)), cwd=self.folder, capture_output=True, text=True, errors="backslashreplace", timeout=120)

    def test_bound_of_the_hopper(self):
        """To the last digit of the page."""
        said = re.search(r"In `examples/hopper` the bound is ([\d.]+) m/s for pairs and ([\d.]+) for walls", PAGE)
        made = self.run_in("/usr/bin/python3", HOPPER / "make_scene.py", "-o", "scene")
        self.assertEqual(made.returncode, 0, made.stderr)
        for name in ("in.hopper", "materials.toml"):
            shutil.copy(HOPPER / name, self.folder)
        words = ("in.hopper", "--var", "model", "mpm", "--var", "scene", "scene", "--materials-file", "materials.toml")
        plan = self.run_in(os.environ["GRANULAW_MPM"], "plan", *words, "--json")
        self.assertEqual(plan.returncode, 0, plan.stderr)
        for number, pair in zip(said.groups(), json.loads(plan.stdout)["pairs"]):
            last_digit = 10.0 ** -len(number.partition(".")[2])
            self.assertAlmostEqual(float(number), pair["speed_max_m_per_s"], delta=0.5 * last_digit, msg=pair)

    def test_templates(self):
        """Decks that LIGGGHTS refuses end the plan with LIGGGHTS's own sentence."""
        self.assertIn("An error of LIGGGHTS ends the plan with LIGGGHTS's message", PAGE)
        for radius, taken in (("constant 0.002", True), ("uniform 0.001 0.002", False), ("gaussian number 0.002 0.0001", False)):
            deck = TEMPLATES + f"fix t all particletemplate/sphere 15485863 atom_type 1 density constant 1000 radius {radius}\n"
            (self.folder / "in.t").write_text(deck)
            done = self.run_in(os.environ["GRANULAW_LAUNCHER"], "-in", "in.t")
            self.assertEqual(done.returncode == 0, taken, done.stdout[-500:] + done.stderr[-500:])
            if not taken:
                self.assertIn("invalid radius random style", done.stdout + done.stderr)
            plan = self.run_in(os.environ["GRANULAW_MPM"], "plan", "in.t", "--json")
            self.assertEqual(plan.returncode == 0, taken, plan.stderr)
            if taken:
                self.assertNotIn("--radius R [R_MAX]", [q["option"] for q in json.loads(plan.stdout)["asks_for"]])
            else:
                self.assertIn("invalid radius random style", plan.stderr)


if __name__ == "__main__":
    unittest.main()
