"""`mpm plan`, `mpm table --deck` and the run: granules among balls of up to 1000 times their mass, in twelve flows."""
import json
import re
import statistics

from pytest import approx, mark
from mass_ratios import FLOWS, SEEDS
from programs import LAUNCHER, mpm, run

QUICK = ("intruder", "vibrated box")
LIGHT_PAIR = "1:1"


def check_inside(flow, compared):
    """A light one that slips out from under a ball meets others at a speed that the plan names as not bounded: it is of pairs of granules alone that the numbers may be
    passed. In the flow of 1000 times the mass they were: 5.1 and 6.8 m/s for 3.5."""
    for c in compared:
        if c.name == LIGHT_PAIR:
            continue
        for planned, visited in (c.speed, c.overlap):
            assert visited <= planned, (flow.name, c.row())


@mark.parametrize("flow", [f for f in FLOWS if f.name in QUICK], ids=lambda f: f.name)
def test_no_run_stops_and_contacts_stay_inside_the_plan(flow, tmp_path):
    check_inside(flow, flow.run(tmp_path, SEEDS[:1]))


def test_twelve_flows(tmp_path):
    ratios = []
    for flow in FLOWS:
        compared = flow.run(tmp_path / flow.name.replace(" ", "_"))
        check_inside(flow, compared)
        for c in compared:
            print(f"{flow.name:<16} {c.row()}")
            ratios += [planned / visited for planned, visited in (c.speed, c.overlap)]
    assert len(FLOWS) == 12
    # the largest of three runs is one event: another packing moves it by a third
    assert statistics.quantiles(ratios, n=10)[-1] < 3
    assert max(ratios) < 4


def test_the_stop_names_what_was_planned_and_the_line_that_holds(tmp_path):
    """A law that is too shallow on purpose."""
    flow = next(f for f in FLOWS if f.name == "intruder")
    flow.write(tmp_path)
    mpm("table", "materials.toml", "--deck", "in.flow", "--depth", "0.02", "-o", "law.h5", cwd=tmp_path)
    said = run(LAUNCHER, "-in", "in.flow", cwd=tmp_path, code=None).stdout + json.loads((tmp_path / "stats.json").read_text())["stopped"]
    found = re.search(r"which ends at \S+ \(planned for in.flow: d/R\* (\S+) at (\S+) m/s\): build a deeper law by '(mpm table [^']*)'", said)
    assert found, said[-2000:]
    plan = json.loads(mpm("plan", "in.flow", "--materials-file", "materials.toml", "--json", cwd=tmp_path).stdout)
    assert any(float(found[1]) == approx(p["overlap_over_radius_max"], rel=5e-3) and float(found[2]) == approx(p["speed_max_m_per_s"], rel=5e-3) for p in plan["pairs"])
    mpm(*found[3].split()[1:], cwd=tmp_path)
    run(LAUNCHER, "-in", "in.flow", cwd=tmp_path)
