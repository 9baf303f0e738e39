#!/usr/bin/python3
"""The hopper example in small: three models on one and two ranks, from one cloud of 200 spheres.

    test_hopper.py MODEL LAUNCHER LAW MPIRUN PLUGIN_LAUNCHER      (LAW: a law file of the example's material; used by mpm)
"""
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLE = ROOT / "examples" / "hopper"
sys.path.insert(0, str(EXAMPLE))
import measures  # noqa: E402
from runs import Run  # noqa: E402

PARTICLES = 200


class Hopper(unittest.TestCase):
    model = launcher = law = mpirun = plugin_launcher = ""

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory(prefix="granulaw-hopper-")))
        subprocess.run([sys.executable, str(EXAMPLE / "make_scene.py"), "-o", str(cls.folder / "scene"),
                        "--particles", str(PARTICLES), "--drop", "0.03"], check=True, capture_output=True)
        cls.runs = {ranks: cls.run_model(ranks) for ranks in (1, 2)}

    @classmethod
    def run_model(cls, ranks):
        out = cls.folder / f"ranks{ranks}"
        out.mkdir()
        command = [cls.launcher, "-in", str(EXAMPLE / "in.hopper"), "-log", str(out / "log")]
        if ranks > 1:
            command = [cls.mpirun, "--oversubscribe", "-np", str(ranks)] + command
        for name, value in {"model": cls.model, "scene": cls.folder / "scene", "out": out, "law": cls.law,
                            "fill": 40000, "flow": 65000, "pictures": 20000, "every": 250}.items():
            command += ["-var", name, str(value)]
        done = subprocess.run(command, capture_output=True, text=True, errors="replace", stdin=subprocess.DEVNULL,
                              timeout=500)
        if done.returncode:
            raise AssertionError(f"{' '.join(command)}\n{done.stdout[-3000:]}{done.stderr[-3000:]}")
        return Run(str(out), cls.model)

    def each(self):
        for ranks, run in self.runs.items():
            self.assertEqual(run.ranks, ranks)
            yield run

    def test_no_particle_is_lost_and_all_flow_out(self):
        for run in self.each():
            self.assertEqual(run.series["atoms"][0], PARTICLES)
            self.assertEqual(run.lost(), 0)
            self.assertEqual(run.series["passed"][-1], PARTICLES)
            self.assertEqual(run.series["removed"][-1], PARTICLES)
            self.assertEqual(run.dangerous_builds, 0)

    def test_none_leaves_before_the_orifice_opens(self):
        for run in self.each():
            closed = run.series["time"] <= run.opened
            self.assertEqual(np.max(run.series["passed"][closed]), 0)

    def test_energy_only_falls_while_closed(self):
        for run in self.each():
            s = run.series
            closed = s["time"] <= run.opened
            energy = (s["kinetic"] + s["rotational"] + s["potential"])[closed]
            # Energy that contacts store elastically (not in this sum) can come back; at most what they held:
            # 1e-3 of the initial energy bounds it at the peak of the impacts. Velocity Verlet adds less than
            # that.
            self.assertLess(np.max(np.diff(energy)), 1e-3 * energy[0])
            self.assertGreater(energy[-1], 0)
            self.assertLess(energy[-1], 0.8 * energy[0], "the fall must have been dissipated")

    def test_the_bed_comes_to_rest(self):
        for run in self.each():
            f = measures.filling(run)
            closed = run.series["time"] <= run.opened
            self.assertLess(run.series["kinetic"][closed][-1], 1e-3 * f["peak"])
            self.assertGreater(f["peak_time"], 0)

    def test_the_contact_statistics_are_part_of_the_balance(self):
        if self.model == "hertz":
            self.skipTest("stock Hertz keeps no contact statistics")
        for run in self.each():
            f = measures.filling(run)
            # normal contacts cannot take more than was lost; friction takes some too
            self.assertGreater(f["plastic"], 0.1 * f["dissipated"])
            self.assertLess(f["plastic"], f["dissipated"])

    def test_stock_hertz_is_stock_hertz(self):
        """The launcher with the plug-in loaded changes nothing in a stock run: the same dumps, digit for digit, in impact and at rest."""
        if self.model != "hertz":
            self.skipTest("of the stock model only")
        first = []
        for launcher in (self.launcher, self.plugin_launcher):
            out = self.folder / f"plain{len(first)}"
            out.mkdir()
            command = [launcher, "-in", str(EXAMPLE / "in.hopper"), "-log", str(out / "log"), "-var", "model", "hertz", "-var", "scene",
                       str(self.folder / "scene"), "-var", "out", str(out), "-var", "fill", "16000", "-var", "flow", "4000",
                       "-var", "pictures", "4000"]
            subprocess.run(command, check=True, capture_output=True, stdin=subprocess.DEVNULL, timeout=100)
            first.append([p.read_text() for p in sorted(out.glob("dump_*.txt"))])
        self.assertEqual(len(first[0]), 6)
        self.assertEqual(first[0], first[1])

    def test_ranks_agree_until_chaos_parts_them(self):
        """One cloud, two rank counts: the free fall is one to rounding, the settled bed only in the mean."""
        one, two = self.runs[1].series, self.runs[2].series
        early = one["time"] < 0.04  # before the first impact: the lowest sphere falls 27 mm, 0.074 s
        np.testing.assert_allclose(one["kinetic"][early], two["kinetic"][early], rtol=1e-9)
        drop = [measures.filling(self.runs[r])["dissipated"] for r in (1, 2)]
        # the height of 200 spheres at rest differs by a fraction of a radius in a fall of about ten: 2 %
        self.assertLess(abs(drop[1] / drop[0] - 1), 0.02)


if __name__ == "__main__":
    Hopper.model, Hopper.launcher, Hopper.law, Hopper.mpirun, Hopper.plugin_launcher = sys.argv[1:6]
    unittest.main(argv=sys.argv[:1], verbosity=2)
