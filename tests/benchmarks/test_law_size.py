"""law_size_benchmark on a real law: its statements on errors hold."""
import json
import os

from programs import ROOT, run, table

BENCHMARK = os.environ["GRANULAW_LAW_SIZE_BENCHMARK"]


def test_errors_and_times():
    told = run(BENCHMARK, table((ROOT / "examples/hopper/materials.toml").read_text())).stdout
    whole, dropped, _ = map(json.loads, told.splitlines())
    assert whole["slices"] > 1, "this law should have a velocity axis"
    assert (whole["err_force"], whole["err_e"]) == (0, 0), whole  # the law against itself
    # `mpm info` says what leaving the axis out costs in e where it ends; with e near 0.25 there, that is some 0.02 absolute
    assert 0.005 < dropped["err_e"] < 0.1 and dropped["bytes"] < whole["bytes"], dropped
    assert all(r["ns_load_low"] <= r["ns_load"] <= r["ns_load_high"] for r in (whole, dropped))


def test_a_file_that_is_no_law():
    said = run(BENCHMARK, __file__, code=2).stderr
    assert len(said.splitlines()) == 1, said
