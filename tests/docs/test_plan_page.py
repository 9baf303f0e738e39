"""Numbers and promises of the page on plan and soften."""
import json
import re
import shutil

from programs import LAUNCHER, ROOT, answer, mpm, run
from pytest import approx, mark

PAGE = (ROOT / "docs/guide/plan.md").read_text()
HOPPER = ROOT / "examples/hopper"
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


def test_bound_of_the_hopper(here):
    """To the last digit of the page."""
    said = re.search(r"In `examples/hopper` the bound is ([\d.]+) m/s for pairs and ([\d.]+) for walls", PAGE)
    run("/usr/bin/python3", HOPPER / "make_scene.py", "-o", "scene")
    for name in ("in.hopper", "materials.toml"):
        shutil.copy(HOPPER / name, here)
    plan = answer("plan", "in.hopper", "--var", "model", "mpm", "--var", "scene", "scene", "--materials-file", "materials.toml", "--json")
    for number, pair in zip(said.groups(), plan["pairs"]):
        last_digit = 10.0 ** -len(number.partition(".")[2])
        assert float(number) == approx(pair["speed_max_m_per_s"], abs=0.5 * last_digit), pair


@mark.parametrize("radius, taken", (("constant 0.002", True), ("uniform 0.001 0.002", False), ("gaussian number 0.002 0.0001", False)))
def test_templates(radius, taken, here):
    """Decks that LIGGGHTS refuses end the plan with LIGGGHTS's own sentence."""
    assert "An error of LIGGGHTS ends the plan with LIGGGHTS's message" in PAGE
    (here / "in.t").write_text(TEMPLATES + f"fix t all particletemplate/sphere 15485863 atom_type 1 density constant 1000 radius {radius}\n")
    done = run(LAUNCHER, "-in", "in.t", code=0 if taken else None)
    plan = mpm("plan", "in.t", "--json", code=0 if taken else None)
    if taken:
        assert "--radius R [R_MAX]" not in [q["option"] for q in json.loads(plan.stdout)["asks_for"]]
    else:
        assert "invalid radius random style" in done.stdout + done.stderr
        assert "invalid radius random style" in plan.stderr
