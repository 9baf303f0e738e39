#!/usr/bin/python3
"""law_size_benchmark on a real law: what it says of errors holds, and the report reads it.   test_law_size.py MPM LAW_SIZE_BENCHMARK"""
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tools"), str(ROOT / "examples" / "common")]
from reporting import law_part  # noqa: E402

MPM, BENCHMARK = sys.argv[1:3]
with tempfile.TemporaryDirectory(prefix="granulaw-law-size-") as folder:
    law, out = pathlib.Path(folder, "wax.h5"), pathlib.Path(folder, "law_size.json")
    subprocess.run([MPM, "table", ROOT / "examples/hopper/materials.toml", "-o", law], check=True, stdout=subprocess.DEVNULL)
    subprocess.run([BENCHMARK, law, "-o", out], check=True, stdout=subprocess.DEVNULL)
    found = law_part.read(out)
    full = law_part.whole(found["rows"])
    rows = {(r["nodes"], r["slices"], r["evaluator"]): r for r in found["rows"]}
    nodes, slices = full["nodes"], full["slices"]
    assert slices > 1, "this law should have a velocity axis"

    same, fast = rows[nodes, slices, "curve"], rows[nodes, slices, "fast"]
    assert (same["err_force"], same["err_e"]) == (0, 0), same  # the law against itself
    # FastCurve: 1e-5 of F (tests/unit/fast_curve_test.cpp: 3e-6 of smooth functions); a real law has kinks at its onset
    assert 0 < fast["err_force"] < 1e-4 and fast["err_e"] < 1e-5, fast
    coarse, fine = rows[8, slices, "curve"], rows[64, slices, "curve"]
    assert coarse["err_force"] > 10 * fine["err_force"] and coarse["bytes"] < fine["bytes"], (coarse, fine)
    # `mpm info` says what leaving the axis out costs in e where it ends; with e near 0.25 there, that is some 0.02 absolute
    dropped = rows[nodes, 0, "curve"]
    assert 0.005 < dropped["err_e"] < 0.1 and dropped["err_e"] > rows[nodes, 1, "curve"]["err_e"] and dropped["bytes"] < same["bytes"], dropped
    assert all(r["ns_load_low"] <= r["ns_load"] <= r["ns_load_high"] for r in found["rows"])

    done = subprocess.run([BENCHMARK, __file__], capture_output=True, text=True)
    assert done.returncode == 2 and len(done.stderr.splitlines()) == 1, done.stderr
print("ok")
