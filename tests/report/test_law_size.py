"""law_size_benchmark on a real law: what it says of errors holds, and the report reads it."""
import os

from programs import ROOT, run, table
from reporting import law_part

BENCHMARK = os.environ["GRANULAW_LAW_SIZE_BENCHMARK"]


def test_errors_and_times(folder):
    run(BENCHMARK, table((ROOT / "examples/hopper/materials.toml").read_text()), "-o", folder / "law_size.json")
    found = law_part.read(folder / "law_size.json")
    assert law_part.whole(found["rows"])["slices"] > 1, "this law should have a velocity axis"
    whole, dropped = found["rows"]
    assert (whole["err_force"], whole["err_e"]) == (0, 0), whole  # the law against itself
    # `mpm info` says what leaving the axis out costs in e where it ends; with e near 0.25 there, that is some 0.02 absolute
    assert 0.005 < dropped["err_e"] < 0.1 and dropped["bytes"] < whole["bytes"], dropped
    assert all(r["ns_load_low"] <= r["ns_load"] <= r["ns_load_high"] for r in found["rows"])


def test_a_file_that_is_no_law():
    said = run(BENCHMARK, __file__, code=2).stderr
    assert len(said.splitlines()) == 1, said
