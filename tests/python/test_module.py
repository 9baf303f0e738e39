"""`import granulaw`: the numbers of `mpm`, the names of its stub, the page that shows it."""
import ast
import inspect
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
from programs import ROOT, InFolder, mpm, run

import granulaw

POWDER = granulaw.Material(density=1500, youngs_modulus=10e9, poisson_ratio=0.3, yield_stress=100e6)
TOML = "[material.powder]\ndensity = 1500\nyoungs_modulus = 10e9\npoisson_ratio = 0.3\nyield_stress = 100e6\n[particle.grain]\nradius = 1e-3\nmaterial = 'powder'\n"
EFFORT = {"cpu_s", "point_updates_per_s"}


@pytest.fixture(scope="module")
def law():
    return granulaw.table({"powder": POWDER, "glass": granulaw.Material(density=2500, youngs_modulus=70e9, poisson_ratio=0.2)})


class TestLaws(InFolder):
    def test_a_table_is_that_of_mpm(self, law):
        law.write(self.folder / "law.h5")
        assert granulaw.read(self.folder / "law.h5").pairs == law.pairs
        (self.folder / "m.toml").write_text(TOML)
        mpm("table", "m.toml", "--pair", "powder:wall", "-o", "own.h5", cwd=self.folder)
        said = json.loads(mpm("law", "own.h5", "--velocity", "2", "--radius", "1e-3", "--json", cwd=self.folder).stdout)
        found = law.pair("powder:wall", radius=1e-3).impact(2.0)
        assert found.pop("warnings") == []
        assert {k: v for k, v in found.items() if k not in EFFORT} == {k: v for k, v in said.items() if k not in EFFORT}

    def test_curves_are_one_law(self, law):
        """The work under the loading force less that of the unloading is what e says is lost; the slope is that of the force."""
        pair = law.pair("powder:wall", radius=1e-3)
        impact = pair.impact(0.5)
        deepest = impact["delta_max_m"]
        overlap = np.linspace(0, deepest, 20001)
        loading, unloading = pair.force(overlap, speed=0.5), pair.force(overlap, deepest, speed=0.5)
        assert np.array_equal(unloading, pair.force(overlap, np.full_like(overlap, deepest), speed=0.5))
        assert np.trapz(unloading, overlap) / np.trapz(loading, overlap) == pytest.approx(impact["e"]**2, rel=1e-5)  # 1e-5: what trapezia miss of the foot
        force, stiffness, radius = pair.curves(overlap.reshape(-1, 3), speed=0.5)
        assert force.shape == (6667, 3)
        assert np.array_equal(force.ravel(), loading)
        assert np.gradient(loading, overlap)[50:-1] == pytest.approx(stiffness.ravel()[50:-1], rel=2e-3)  # differences of 20000 pieces, coarse at the foot
        assert np.all(np.diff(radius.ravel()) >= 0)
        assert pair.restitution([[0.5], [2.0]])[0, 0] == impact["e"]

    def test_nothing_is_extrapolated(self, law):
        pair = law.pair("powder:wall", radius=1e-3)
        for call in (lambda: pair.force([0, 2 * pair.largest_overlap]), lambda: pair.force([0, np.nan]), lambda: pair.curves([1e-6], [2 * pair.largest_overlap])):
            with pytest.raises(granulaw.Error, match="overlap"):
                call()

    def test_what_cannot_be_used_is_one_sentence(self, law):
        for call, said in ((lambda: granulaw.read("no.h5"), "no.h5"), (lambda: law.pair("powder:clay"), "clay"), (lambda: law.pair("powder:wall", radius=-1), "radius"),
                           (lambda: granulaw.table({"x": POWDER}, ["x"]), "'a:b'"), (lambda: granulaw.Material(density=-1, youngs_modulus=1e9, poisson_ratio=0.3), "density"),
                           (lambda: granulaw.table({}), "materials: is empty"), (lambda: granulaw.table({"x": 3}), "no granulaw.Material"),
                           (lambda: granulaw.table({"x": POWDER}, jobs=0), "jobs"), (lambda: granulaw.sphere(-1, POWDER), "^radius"),
                           (lambda: granulaw.impact(granulaw.sphere(1e-3, POWDER), 1.0, against=3), "^against"),
                           (lambda: granulaw.impact(granulaw.sphere(1e-3, POWDER), 1.0, threads=0), "^threads"),
                           (lambda: law.pair("powder:wall").impact(-1), "^velocity"), (lambda: granulaw.calibrate("x.csv", fit="yield_stress", help=True), "--help"),
                           (lambda: law.contact("powder:wall", tangential="plastik"), "history or plastic"), (lambda: granulaw.impact(granulaw.sphere(1e-3, POWDER), 1.0, grid="round"), "mapped")):
            with pytest.raises(granulaw.Error, match=said) as raised:
                call()
            assert "\n" not in str(raised.value)


class TestContacts:
    def test_a_contact_collides_as_the_law_says(self, law):
        """Velocity Verlet over numpy arrays: two bodies at three speeds at once."""
        pair = law.pair("powder:powder", radius=1e-3, radius2=2e-3)
        contact = law.contact("powder:powder", elastic_damping=0, radius_a=1e-3, radius_b=2e-3)
        speeds = np.array([0.05, 0.5, 3.0])
        impacts = [pair.impact(v) for v in speeds]
        m, history, ledger = contact.motion(3), contact.history(3), np.zeros(5)
        m["radius_a"], m["radius_b"], m["m_eff"] = 1e-3, 2e-3, pair.m_eff
        m["dt"] = dt = np.array([i["contact_time_s"] for i in impacts]) / 20000
        v, overlap, force, most = speeds.copy(), np.zeros(3), np.zeros(3), np.zeros(3)
        for _ in range(22000):
            v -= 0.5 * dt * force / pair.m_eff
            overlap += dt * v
            m["overlap"], m["approach"] = overlap, v
            force = contact.advance(m, history, ledger)["normal"]
            v -= 0.5 * dt * force / pair.m_eff
            most = np.maximum(most, force)
        assert -v / speeds == pytest.approx([i["e"] for i in impacts], abs=1e-6)  # both by steps of a 20000th
        assert most == pytest.approx([i["force_max_N"] for i in impacts], rel=1e-7)
        assert ledger.sum() == pytest.approx((0.5 * pair.m_eff * (speeds**2 - v**2)).sum(), rel=1e-4)  # the axis's table of work

    def test_surfaces_stick(self, law):
        """Drawn off from a dent in small steps: the largest pull is that of mpm law, beyond that of an undented contact; parted, nothing is left."""
        radius, work, reach = 100e-6, 0.02, 0.6e-9
        contact = law.contact("powder:wall", radius_a=radius, radius_b=np.inf, work_of_adhesion=work, adhesion_range=reach)
        m, history, ledger = contact.motion(1), contact.history(1), np.zeros(5)
        m["radius_a"], m["radius_b"], m["m_eff"], m["dt"] = radius, np.inf, 1e-12, 1e-9
        depth, forces = 0.02 * radius, []
        for overlap in np.concatenate((np.linspace(0, depth, 200), np.linspace(depth, -0.01 * radius, 20000))):
            m["overlap"] = overlap
            forces.append(contact.advance(m, history, ledger)["normal"][0])
        pull = -min(forces)
        assert pull > 3 * 1.5 * np.pi * work * radius
        assert forces[-1] == 0
        assert not history.any()
        assert ledger[4] > 0
        with pytest.raises(granulaw.Error, match="work_of_adhesion: not with .*tangential plastic"):
            law.contact("powder:wall", friction=0.3, tangential="plastic", work_of_adhesion=work, adhesion_range=reach)
        with pytest.raises(granulaw.Error, match="contact pressure"):
            law.contact("powder:wall", radius_a=radius, radius_b=np.inf, work_of_adhesion=0.1, adhesion_range=0.4e-9)

    def test_a_wrong_motion_has_its_place(self, law):
        contact = law.contact("powder:wall")
        m = contact.motion(3)
        m["radius_a"], m["m_eff"], m["overlap"] = 1e-3, 6e-6, 1e-6
        m["approach"][1] = np.nan
        with pytest.raises(granulaw.Error, match="contact 1: "):
            contact.advance(m, contact.history(3))
        with pytest.raises(granulaw.Error, match="history: has another size"):
            contact.advance(m, contact.history(2))
        # a converted copy would lose what a contact keeps
        for lost in (contact.history(3).astype(np.float32), np.zeros((contact.values, 3)).T, contact.history(6)[::2]):
            with pytest.raises(granulaw.Error, match="history: is no float64 array in C order"):
                contact.advance(m, lost)
        fixed = contact.history(3)
        fixed.setflags(write=False)
        with pytest.raises(granulaw.Error, match="history: is read-only"):
            contact.advance(m, fixed)
        with pytest.raises(granulaw.Error, match="ledger: is no float64"):
            contact.advance(m, contact.history(3), np.zeros(5, int))


class TestRuns(InFolder):
    def test_an_impact_is_that_of_mpm(self):
        (self.folder / "m.toml").write_text(TOML)
        words = ("m.toml", "--particle", "grain", "--resolution", "6", "--json")
        grain = granulaw.read_materials(self.folder / "m.toml").particle("grain")
        seen = []
        for found, command in ((granulaw.impact(grain, 1.0, resolution=6, progress=seen.append), ("impact", *words, "--velocity", "1")),
                               (granulaw.press(grain, 0.05, resolution=6), ("press", *words, "--depth", "0.05")),
                               (granulaw.impact(grain, 1.0, resolution=6, shifted_grids=1, friction=0.2, tangential_velocity=0.5),
                                ("impact", *words, "--velocity", "1", "--shifted-grids", "1", "--friction", "0.2", "--tangential-velocity", "0.5"))):
            said = json.loads(mpm(*command, cwd=self.folder).stdout)
            trace = found.pop("trace")
            assert {k: v for k, v in found.items() if k not in EFFORT} == {k: v for k, v in said.items() if k not in EFFORT}
            assert len({len(column) for column in trace.values()}) == 1
            assert trace["force_N"].max() > 0
        assert seen
        assert max(seen) <= 1

    def test_two_deformable_spheres_in_three_dimensions(self):
        """Head-on, against the solver of two dimensions; obliquely they slip less than they came."""
        small, large = granulaw.sphere(1e-3, POWDER), granulaw.sphere(1.5e-3, POWDER)
        flat = granulaw.impact(small, 20.0, against=large)
        space = {"grid": "rectilinear-3d", "resolution": 6, "shifted_grids": 1}
        assert granulaw.impact(small, 20.0, against=large, **space)["e"] == pytest.approx(flat["e"], rel=0.015)  # 6 cells
        assert 0 < granulaw.impact(large, 20.0, against=small, tangential_velocity=20.0, friction=0.3, **space)["velocity_after_tangential_m_per_s"] < 20
        with pytest.raises(granulaw.Error):
            granulaw.impact(small, 20.0, against=POWDER, **space)

    def test_ctrl_c_stops_a_run(self):
        code = ("import granulaw\np = granulaw.Material(density=1500, youngs_modulus=10e9, poisson_ratio=.3, yield_stress=1e8)\nprint('begins', flush=True)\n"
                "granulaw.impact(granulaw.sphere(1e-3, p), 0.1, resolution=24)")
        child = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        assert child.stdout.readline() == "begins\n"
        time.sleep(0.5)
        child.send_signal(signal.SIGINT)
        _, said = child.communicate(timeout=60)
        assert said.rstrip().endswith("KeyboardInterrupt")

    def test_a_calibration_is_that_of_mpm(self):
        drops = ROOT / "examples/calibrate/drops.csv"
        known = {"radius": 1e-3, "density": 1540, "poisson_ratio": 0.25, "youngs_modulus": 3.2e9}
        found = granulaw.calibrate(drops, fit="yield_stress", **known)
        said = json.loads(mpm("calibrate", drops, "--fit", "yield_stress", "--json", *(w for k, v in known.items() for w in (f"--{k.replace('_', '-')}", v))).stdout)
        assert found == said
        with pytest.raises(granulaw.Error, match="--densty"):
            granulaw.calibrate(drops, fit="yield_stress", densty=1)


class TestNames:
    def test_every_public_name_is_in_the_stub_with_a_docstring(self):
        stub = ast.parse(pathlib.Path(os.environ["GRANULAW_STUB"]).read_text())
        described = {node.name: node for node in stub.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
        assert set(described) | {"__version__"} == set(granulaw.__all__)
        for name, node in described.items():
            value = getattr(granulaw, name)
            assert ast.get_docstring(node), name
            if isinstance(node, ast.FunctionDef):
                assert ast.get_docstring(node).split("\n")[0] in inspect.getdoc(value)
                continue
            members = {m.name: m for m in node.body if isinstance(m, ast.FunctionDef)}
            assert {n for n in vars(value) if not n.startswith("_")} == {n for n in members if not n.startswith("_")}, name
            for member, stated in members.items():
                assert ast.get_docstring(stated), f"{name}.{member}"
                if not member.startswith("_"):
                    assert ast.get_docstring(stated).split("\n")[0] in inspect.getdoc(getattr(value, member)), f"{name}.{member}"

    def test_the_parameters_are_those_of_the_stub(self):
        """Names and order; of compiled functions by the first line of their docstrings."""
        stub = ast.parse(pathlib.Path(os.environ["GRANULAW_STUB"]).read_text())
        compared = 0
        for owner in [stub, *(n for n in stub.body if isinstance(n, ast.ClassDef))]:
            for node in (n for n in owner.body if isinstance(n, ast.FunctionDef) and not n.decorator_list and not n.name.startswith("_")):
                value = getattr(granulaw if owner is stub else getattr(granulaw, owner.name), node.name)
                head = re.match(rf"{node.name}\((.*)\) ->", value.__doc__)
                if head:
                    found = [w for w in re.findall(r"(?:^|, )(\w+)(?=:|,|$)", re.sub(r"\[[^\]]*\]|\{[^}]*\}", "", head[1])) if w != "self"]
                    assert found == [a.arg for a in node.args.args + node.args.kwonlyargs if a.arg != "self"], node.name
                    compared += 1
        assert compared > 10

    def test_types_are_mypys(self):
        stub = pathlib.Path(os.environ["GRANULAW_STUB"])
        run(sys.executable, "-m", "mypy", "--strict", "--cache-dir", os.devnull, stub)


class TestPage(InFolder):
    def test_the_pages_programs_run(self):
        """docs/guide/python.md, one program after the other, as a notebook does."""
        page = (ROOT / "docs/guide/python.md").read_text()
        cells = re.findall(r"```python\n(.*?)```", page, re.S)
        assert len(cells) > 4
        (self.folder / "drops.csv").write_text((ROOT / "examples/calibrate/drops.csv").read_text())
        run(sys.executable, "-c", "import matplotlib; matplotlib.use('Agg')\n" + "\n".join(cells), cwd=self.folder)
        assert (self.folder / "law.png").stat().st_size > 5000
