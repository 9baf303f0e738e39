#!/usr/bin/python3
"""What mpm calibrate and mpm design print, write and refuse. Run one case: test_calibrate.py MPM CASE."""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

KNOWN = ["--radius", "1e-3", "--density", "1540", "--poisson-ratio", "0.25"]
MATERIAL = """
[material.stone]
density = 1540
youngs_modulus = 3.2e9
poisson_ratio = 0.25
yield_stress = 41e6
"""


def run(*words):
    return subprocess.run([MPM, *map(str, words)], capture_output=True, text=True)


def answer(*words):
    done = run(*words)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def drops(speeds, name="drops.csv"):
    """e of the material's own law at these speeds."""
    Path("stone.toml").write_text(MATERIAL)
    assert run("table", "stone.toml", "-o", "stone.h5", "--pair", "stone:wall").returncode == 0
    rows = ["velocity_m_per_s,restitution"]
    for v in speeds:
        e = answer("law", "stone.h5", "--radius", "1e-3", "--velocity", v, "--json")["e"]
        rows.append(f"{v},{min(e, 1)}")
    Path(name).write_text("\n".join(rows) + "\n")
    return name


def material():
    """Drops give back the material that made them, and mpm table takes what is written."""
    data = drops([0.2, 0.4, 0.8, 1.6, 3.2, 6])
    found = answer("calibrate", data, *KNOWN, "--youngs-modulus", "3.2e9", "--fit", "yield_stress", "--json",
                   "-o", "found.toml", "--ensemble", 12, "--plot", "fit.png")
    y = found["parameters"]["yield_stress"]
    # calibrate takes e from the law's shape, mpm law replays the table: 0.1 % of e is 0.2 % of Y
    assert abs(y["value"] / 41e6 - 1) < 0.004, y
    assert y["low95"] < y["low68"] < y["value"] < y["high68"] < y["high95"] and y["identifiable"], y
    assert found["p_value"] > 0.99 and found["misfits"] == [], found
    assert "# yield_stress" in Path("found.toml").read_text()
    assert Path("fit.png").stat().st_size > 5000
    assert len(list(Path(".").glob("found-*.toml"))) == 12
    for file in ("found.toml", "found-01.toml"):
        done = run("table", file, "-o", "law.h5", "--pair", "material:wall")
        assert done.returncode == 0, done.stderr


def verdicts():
    """What cannot be told is said."""
    slow = drops([0.01, 0.02, 0.03])
    found = answer("calibrate", slow, *KNOWN, "--youngs-modulus", "3.2e9", "--fit", "yield_stress", "hardening_modulus",
                   "--json")
    assert not found["parameters"]["yield_stress"]["identifiable"]
    assert "from below" in found["verdict"] and "nothing of hardening_modulus" in found["verdict"], found["verdict"]
    both = answer("calibrate", drops([0.2, 0.4, 0.8, 1.6]), *KNOWN, "--fit", "youngs_modulus", "yield_stress", "--json")
    assert "change together" in both["verdict"], both["verdict"]
    steep = "velocity_m_per_s,restitution\n0.2,0.97\n0.4,0.93\n0.8,0.8\n1.6,0.6\n3.2,0.4\n"
    Path("steep.csv").write_text(steep)
    said = answer("calibrate", "steep.csv", *KNOWN, "--youngs-modulus", "3.2e9", "--fit", "yield_stress", "--json")
    assert "falls faster" in said["verdict"], said["verdict"]


def design():
    """Plastic impacts tell more of Y than elastic ones."""
    table = answer("design", "--fit", "yield_stress", "--youngs-modulus", "3.2e9", "--guess", "yield_stress=41e6", *KNOWN,
                   "--speeds", "0.01..5", "--displacements", "2e-5..1e-4", "--places", 5, "--json")
    widths = [c["expected95"]["yield_stress"] for c in table["candidates"]]
    assert widths[0] > 10 * widths[4], widths
    assert 0 < table["best"]["yield_stress"] <= min(widths), table


def errors():
    """One sentence each."""
    header = "velocity_m_per_s,restitution\n"
    fit = ["--youngs-modulus", "3.2e9", "--fit", "yield_stress"]
    for text, wanted in [
        ("velocity,restitution\n1,0.5\n2,0.4\n", "must name its unit"),
        ("a,b\n1,2\n", "names no kind"),
        (header + "1\n2,0.5\n", "another number of columns"),
        (header + "-1,0.5\n2,0.4\n", "out of range"),
        (header + "1,1.5\n2,0.4\n", "out of range"),
        (header + "1,0.5\n", "too few values"),
        (header + "1,nan\n2,0.4\n", "not finite"),
        (header, "no row"),
        ("", "empty"),
        ("displacement_m,force_N\n0,0\n1e-6,1\n", "more rows"),
    ]:
        Path("bad.csv").write_text(text)
        done = run("calibrate", "bad.csv", *KNOWN, *fit)
        assert done.returncode == 1 and wanted in done.stderr, (text, done.stderr)
        assert done.stderr.startswith("mpm: bad.csv") and done.stderr.count("\n") == 1, done.stderr
    Path("good.csv").write_text(header + "1,0.7\n2,0.6\n")
    Path("curve.csv").write_text("displacement_m,force_N\n" + "".join(f"{k}e-6,{k**1.5}\n" for k in range(6)))
    Path("walls.toml").write_text(MATERIAL + "hardening = {law = \"voce\", saturation_stress = 8e7, strain = 0.1}\n")
    sphere = ["curve.csv", "--kind", "sphere", *KNOWN, *fit]
    for words, wanted in [
        (["nowhere.csv", *KNOWN, *fit], "no such file"),
        (["good.csv", *KNOWN, "--fit", "yield_stres"], "did you mean 'yield_stress'"),
        (["good.csv", *KNOWN, "--fit", "yield_stress"], "--youngs-modulus"),
        (["good.csv", "--radius", "1e-3", *fit], "--density"),
        (["good.csv", *KNOWN, *fit, "--yield-stress", "4e7"], "is given, too"),
        (["good.csv", *KNOWN, *fit, "--prior", "yield_stress > 3"], "--prior"),
        (["good.csv", *KNOWN, *fit, "--ensemble", "3"], "--ensemble"),
        (["good.csv", *KNOWN, *fit, "--hardening", "voce"], "saturation_stress is neither"),
        (["good.csv", *KNOWN, *fit, "--hardening", "voce", "--known", "offset=1"], "no parameter of the hardening law 'voce'"),
        (["good.csv", *KNOWN, *fit, "exponent"], "no parameter of this hardening law"),
        (["good.csv", *KNOWN, *fit, "--known", "strain=1"], "--known: belongs to"),
        (sphere, "--indenter-radius: is missing"),
        ([*sphere, "--indenter-radius", "1e-7"], "goes deeper than the atlas knows"),
        ([*sphere, "--indenter-radius", "1e-3", "--indenter", "stone", "--materials", "walls.toml"], "--indenter: this material must"),
        (["good.csv", "--radius", "inf", "--density", "1500", *fit], "only an indenter"),
    ]:
        done = run("calibrate", *words)
        assert done.returncode == 1 and wanted in done.stderr and done.stderr.count("\n") == 1, (words, done.stderr)


if __name__ == "__main__":
    MPM, case = Path(sys.argv[1]).resolve(), sys.argv[2]
    import os
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        {"material": material, "verdicts": verdicts, "design": design, "errors": errors}[case]()
