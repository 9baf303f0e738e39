"""One rule for the time step (mpm_core/law/contact_step.hpp): what `mpm plan`, `mpm stretch` and the plug-in say of one deck is one number."""
import json
import math
import pathlib
import re
import tempfile

from programs import run
from pytest import approx

MARGIN = 1.25  # of `mpm plan --from` (tools/deck/visited.hpp)


def ask(mpm, command, words, *more):
    return json.loads(run(mpm, command, *words, *more, "--json").stdout)


def key(pair):
    """Number of an entry of the plan or of the statistics."""
    return (pair["wall"] if "wall" in pair else pair["kind"] != "particles", *pair["types"])


def shortest(plan):
    """s, unstretched, of the pair that requires the shortest step."""
    return min(p["time_step_s"] for p in plan["pairs"] if p["time_step_s"])


def steps_at(mpm, words, stats, quantity):
    """{pair: s} that `mpm plan` allows where contacts reach the overlaps that `quantity` of the statistics names."""
    seen = [{"kind": p["kind"], "types": p["types"], "contacts_begun": 1, "impact_speed_max_m_per_s": 1e-6,
             "overlap_over_radius_max": p[quantity] / MARGIN} for p in stats["pairs"] if p[quantity]]
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "seen.json"
        path.write_text(json.dumps({"pairs": seen}))
        plan = ask(mpm, "plan", words, "--from", str(path))
    stretch = plan["time_step_s"]["advised"] / shortest(plan)
    return {key(p): stretch * p["time_step_s"] for p in plan["pairs"] if p["time_step_s"]}


def check(mpm, words, stats, screen):
    """`words`: the deck and its variables; `stats`: JSON of the plug-in after a run of it; `screen`: what the run printed."""
    said = re.search(r"stretch ([\d.]+)", " ".join(map(str, words)))
    stretch = float(said[1]) if said else 1.0
    plan = ask(mpm, "plan", words)
    assert plan["complete"], plan["asks_for"]
    assert plan["time_step_s"]["advised"] / (stretch * shortest(plan)) == approx(1, abs=1e-12)
    soft = ask(mpm, "soften", words)
    # the smaller of the plan's step and the deck's, which both have the deck's stretch in them
    step = min(plan["time_step_s"]["advised"], plan["time_step_s"]["deck"] or math.inf)
    assert soft["time_step_s"] / (soft["stretch"] / stretch * step) == approx(1, abs=1e-12)

    # Overlap for which the plug-in calls the step in use short enough: the plan gives the same step for it.
    used = stats["time_step_used_s"]
    at_limit = steps_at(mpm, words, stats, "overlap_over_radius_limit_of_time_step")
    at_visited = steps_at(mpm, words, stats, "overlap_over_radius_max")
    for pair in stats["pairs"]:
        if pair["overlap_over_radius_limit_of_time_step"] is None or key(pair) not in at_limit:
            continue
        deepest = pair["overlap_over_radius_limit"] or 0.1  # of thornton, which has no table
        if pair["overlap_over_radius_limit_of_time_step"] < 0.999 * deepest:
            # 1e-3: the plug-in finds the overlap to 1e-6 of the deepest, which may be a thousand times this one
            assert at_limit[key(pair)] / used == approx(1, abs=1e-3), pair["types"]
        else:
            assert at_limit[key(pair)] > 0.999 * used, pair["types"]
        # The plan takes the smallest particles, and the stiffest up to the overlap, pressed or hit. 0.5 %: a contact that others turn back
        # latched a higher speed than its overlap corresponds to, and is stiffer (0.14 % of the step in examples/packing).
        if pair["overlap_over_radius_max"]:
            assert at_visited[key(pair)] < 1.005 * pair["time_step_allowed_s"], pair["types"]
    # a run that visited what its step is short enough for is not warned of
    assert "was so deep that its time step" not in screen
