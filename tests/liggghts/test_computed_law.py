"""The whole chain for single collisions: `mpm table`, then LIGGGHTS at 50 steps a contact, against `mpm law`.

Prints e of both for every case: these are the numbers that an issue asks for.
"""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

from collisions import pair_deck, wall_deck
from harness import POWDER, Deck

MPM = os.environ["GRANULAW_MPM"]
STEPS = 50        # time steps a contact
TOLERANCE = 0.01  # the issue's: e in LIGGGHTS within 1 % of `mpm law`
RADIUS = 1.7e-3
SPEEDS = (0.15, 0.6, 2.0, 8.0, 11.0)  # V/V_y 1.1 to 84, I up to 0.0018 on the wall; yield starts at 0.14 m/s


class ComputedLaw(Deck):
    @classmethod
    def setUpClass(cls):
        cls.shared = tempfile.TemporaryDirectory(prefix="granulaw-computed-")
        folder = pathlib.Path(cls.shared.name)
        cls.computed = folder / "computed.h5"
        (folder / "materials.toml").write_text(
            f"[material.powder]\ndensity = {POWDER.density}\nyoungs_modulus = {POWDER.youngs_modulus}\n"
            f"poisson_ratio = {POWDER.poisson_ratio}\nyield_stress = {POWDER.yield_stress}\n")
        subprocess.run([MPM, "table", folder / "materials.toml", "--pair", "powder:wall", "--pair", "powder:powder",
                        "-o", cls.computed], check=True)

    @classmethod
    def tearDownClass(cls):
        cls.shared.cleanup()

    def check(self, name, words, deck, speeds=SPEEDS):
        for speed in speeds:
            done = subprocess.run([MPM, "law", self.computed, "--velocity", str(speed), "--json", *words],
                                  capture_output=True, text=True, check=True)
            law = json.loads(done.stdout)
            found = self.result(self.run_deck(deck(speed, law["contact_time_s"] / STEPS)), "SPEED")[0] / speed
            print(f"{name} {speed} m/s: mpm law e = {law['e']:.5f}, LIGGGHTS e = {found:.5f} ({100 * (found / law['e'] - 1):+.3f} %)")
            self.assertAlmostEqual(found / law["e"], 1.0, delta=TOLERANCE)

    def test_wall(self):
        self.check("wall", ["--pair", "powder:wall", "--radius", str(RADIUS)],
                   lambda v, dt: wall_deck("mpm", f"law {self.computed} materials powder", POWDER, RADIUS, v, dt))

    def test_like_pair(self):
        self.check("like pair", ["--pair", "powder:powder", "--radius", str(RADIUS)],
                   lambda v, dt: pair_deck("mpm", f"law {self.computed} materials powder", (POWDER, POWDER),
                                           (RADIUS, RADIUS), v, dt))

    def test_pair_of_radii_1_to_2(self):
        self.check("pair 1:2", ["--pair", "powder:powder", "--radius", str(RADIUS), "--radius2", str(2 * RADIUS)],
                   lambda v, dt: pair_deck("mpm", f"law {self.computed} materials powder", (POWDER, POWDER),
                                           (RADIUS, 2 * RADIUS), v, dt))


if __name__ == "__main__":
    unittest.main()
