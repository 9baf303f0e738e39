"""The hopper example in small: model mpm on one and two ranks, from one cloud of 200 spheres; stock Hertz with and without the plug-in."""
import sys

import numpy as np
from programs import LAUNCHER, MPIRUN, ROOT, run, table
from pytest import fixture

EXAMPLE = ROOT / "examples" / "hopper"
sys.path.insert(0, str(EXAMPLE))
import measures  # noqa: E402
from runs import Run  # noqa: E402

PARTICLES = 200


class TestHopper:
    @fixture(autouse=True, scope="class")
    def _runs(self, request, tmp_path_factory):
        cls = request.cls
        cls.folder = tmp_path_factory.mktemp("hopper")
        run(sys.executable, EXAMPLE / "make_scene.py", "-o", cls.folder / "scene", "--particles", PARTICLES, "--drop", "0.03")
        cls.runs = {ranks: self.run_model(cls.folder, ranks) for ranks in (1, 2)}

    def run_deck(self, folder, launcher, ranks=1, **variables):
        folder.mkdir()
        command = [MPIRUN, "--oversubscribe", "-np", ranks] if ranks > 1 else []
        command += [launcher, "-in", EXAMPLE / "in.hopper", "-log", folder / "log"]
        for name, value in {"scene": folder.parent / "scene", "out": folder, **variables}.items():
            command += ["-var", name, value]
        run(*command)

    def run_model(self, folder, ranks):
        out = folder / f"ranks{ranks}"
        self.run_deck(out, LAUNCHER, ranks, model="mpm", law=table((EXAMPLE / "materials.toml").read_text()), fill=40000, flow=65000, pictures=20000, every=250)
        return Run(str(out), "mpm")

    def each(self):
        for ranks, run in self.runs.items():
            assert run.ranks == ranks
            yield run

    def test_no_particle_is_lost_and_all_flow_out(self):
        for run in self.each():
            assert run.series["atoms"][0] == PARTICLES
            assert run.lost() == 0
            assert run.series["passed"][-1] == PARTICLES
            assert run.series["removed"][-1] == PARTICLES
            assert run.dangerous_builds == 0

    def test_none_leaves_before_the_orifice_opens(self):
        for run in self.each():
            closed = run.series["time"] <= run.opened
            assert np.max(run.series["passed"][closed]) == 0

    def test_energy_only_falls_while_closed(self):
        for run in self.each():
            s = run.series
            closed = s["time"] <= run.opened
            energy = (s["kinetic"] + s["rotational"] + s["potential"])[closed]
            # Energy that contacts store elastically (not in this sum) can come back; at most what they held:
            # 1e-3 of the initial energy bounds it at the peak of the impacts. Velocity Verlet adds less than
            # that.
            assert np.max(np.diff(energy)) < 1e-3 * energy[0]
            assert energy[-1] > 0
            assert energy[-1] < 0.8 * energy[0], "the fall must have been dissipated"

    def test_the_bed_comes_to_rest(self):
        for run in self.each():
            f = measures.filling(run)
            closed = run.series["time"] <= run.opened
            assert run.series["kinetic"][closed][-1] < 1e-3 * f["peak"]
            assert f["peak_time"] > 0

    def test_the_contact_statistics_are_part_of_the_balance(self):
        for run in self.each():
            f = measures.filling(run)
            # normal contacts cannot take more than was lost; friction takes some too
            assert f["plastic"] > 0.1 * f["dissipated"]
            assert f["plastic"] < f["dissipated"]

    def test_stock_hertz_is_stock_hertz(self):
        """The launcher with the plug-in loaded changes nothing in a stock run: the same dumps, digit for digit, in impact and at rest."""
        first = []
        for launcher in ("liggghts", LAUNCHER):
            out = self.folder / f"plain{len(first)}"
            self.run_deck(out, launcher, model="hertz", fill=16000, flow=4000, pictures=4000)
            first.append([p.read_text() for p in sorted(out.glob("dump_*.txt"))])
        assert len(first[0]) == 6
        assert first[0] == first[1]

    def test_ranks_agree_until_chaos_parts_them(self):
        """One cloud, two rank counts: the free fall is one to rounding, the settled bed only in the mean."""
        one, two = self.runs[1].series, self.runs[2].series
        early = one["time"] < 0.04  # before the first impact: the lowest sphere falls 27 mm, 0.074 s
        np.testing.assert_allclose(one["kinetic"][early], two["kinetic"][early], rtol=1e-9)
        drop = [measures.filling(self.runs[r])["dissipated"] for r in (1, 2)]
        # the height of 200 spheres at rest differs by a fraction of a radius in a fall of about ten: 2 %
        assert abs(drop[1] / drop[0] - 1) < 0.02
