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
    assert full["slices"] > 1, "this law should have a velocity axis"
    whole, dropped = found["rows"]
    assert (whole["err_force"], whole["err_e"]) == (0, 0), whole  # the law against itself
    # `mpm info` says what leaving the axis out costs in e where it ends; with e near 0.25 there, that is some 0.02 absolute
    assert 0.005 < dropped["err_e"] < 0.1 and dropped["bytes"] < whole["bytes"], dropped
    assert all(r["ns_load_low"] <= r["ns_load"] <= r["ns_load_high"] for r in found["rows"])

    done = subprocess.run([BENCHMARK, __file__], capture_output=True, text=True)
    assert done.returncode == 2 and len(done.stderr.splitlines()) == 1, done.stderr
print("ok")
