"""Laws of bodies that are no plain sphere, end to end."""
from pathlib import Path

import h5py
from pytest import fixture

import programs
from programs import answer, material, particle

MATERIALS = "".join((
    material("core", 1200, "1e9", 0.3, "2e7"),
    material("shell", 1200, "2e9", 0.3, "4e7"),
    material("glass", 2500, "70e9", 0.22),
    material("rated", 1200, "1e9", 0.3, "2e7", 'rate = {law = "johnson-cook", coefficient = 0.03, reference_rate = 1}'),
    material("alloy", 1200, "9.1e9", 0.3, "2e7", 'hardening = {law = "voce", saturation_stress = 3e7, strain = 0.1}'),
    material("steep", 1200, "9.1e9", 0.3, "2e7", 'hardening = {law = "johnson-cook", strength = 2.6e7, exponent = 0.3}'),
    material("skin", 1200, "9.1e9", 0.3, "2e7", 'hardening = {law = "linear", modulus = 9.1e7}'),
    material("soft", 1200, "4.5e9", 0.3, "2e7"),
    material("creeping", 1200, "5.46e9", 0.3, "2e7", 'rate = {law = "cowper-symonds", reference_rate = 1e4, exponent = 5}'),
    particle("egg", "core", more='shape = {kind = "ellipsoid", axes = [1e-3, 1e-3, 1.5e-3]}'),
    particle("stiff", "alloy", 1e-3),
    particle("steeper", "steep", 1e-3),
    particle("capsule", "core", 1e-3, 'layers = [{material = "shell", thickness = 1e-4}]'),
    particle("coated", "soft", 1e-3, 'layers = [{material = "skin", thickness = 1e-4}]'),
    particle("bead", "glass", 1e-3, 'profile = {shape = "ellipsoid", aspect = 1.5}'),
    particle("viscous", "creeping", 1e-3),
    particle("ball", "rated", 1e-3)))
RADIUS = {"capsule": 1e-3, "bead": 1e-3 / 1.5, "ball": 1e-3, "viscous": 1e-3, "stiff": 1e-3, "steeper": 1e-3, "coated": 1e-3}  # of curvature at the pole


@fixture(autouse=True)
def materials(here):
    Path("m.toml").write_text(MATERIALS)


def mpm(*words, ok=True):
    done = programs.mpm(*words, code=0 if ok else None, timeout=3600)
    return done.stdout if ok else done.stderr


def end_to_end(name, velocity, depth, inertia, force, restitution):
    """Table, info, check, law; against a fresh impact within `force`, `restitution` (relative)."""
    mpm("table", "m.toml", "--pair", f"{name}:wall", "--depth", depth, "--inertia", inertia, "-o", "law.h5")
    assert name in mpm("info", "law.h5")
    assert "good" in mpm("check", "law.h5", "--materials", "m.toml", "--impacts", 1, "--seed", 1)
    compare(name, velocity, force, restitution)
    # not built for: refused
    assert "not built" in mpm("law", "law.h5", "--pair", f"{name}:{name}", "--velocity", velocity, ok=False)


def compare(name, velocity, force, restitution):
    told = answer("law", "law.h5", "--radius", RADIUS[name], "--velocity", velocity, "--json")
    run = answer("impact", "m.toml", "--particle", name, "--velocity", velocity, "--json")
    for key, allowed in (("force_max_N", force), ("e", restitution)):
        off = told[key] / run[key] - 1
        print(f"{name} {key}: law {told[key]:.5g}, impact {run[key]:.5g}, {100 * off:+.2f} %")
        assert abs(off) <= allowed, (key, off)


def test_shaped():
    # An elastic body's law is one press; an impact excites some waves besides: 2 %.
    end_to_end("bead", 5, 0.02, 0.01, 0.02, 0.02)


def test_layered():
    # The tolerance of the table, 1 %, once for the fit and once for the solver.
    end_to_end("capsule", 2, 0.1, 0.01, 0.02, 0.02)


def test_rated():
    # Bounds: the table's tolerance.
    end_to_end("ball", 3, 0.05, 0.01, 0.01, 0.01)
    assert "rate-dependent: holds for R = 0.001 m" in mpm("info", "law.h5")
    assert "holds for one size" in mpm("law", "law.h5", "--radius", 2e-3, "--velocity", 3, ok=False)
    assert "holds for one size" in mpm("export", "law.h5", "-o", "law.csv", "--effective-radius", 2e-3, ok=False)
    slow = answer("law", "law.h5", "--velocity", 0.01, "--json")  # its radius is the law's own
    assert slow["below_velocity_axis"] and slow["e"] > 0.999  # elastic at that speed, at any rate
    # below the axis the bound does not hold: e was found .034 off where the law states .008
    assert slow["error_force"] is None and slow["error_restitution"] is None
    assert "not stated" in mpm("law", "law.h5", "--velocity", 0.01)
    assert answer("law", "law.h5", "--velocity", 3, "--json")["error_force"] > 0
    # The force falls by a seventh before this one turns; without rate the atlas gives its law. 0.1 % seen.
    end_to_end("viscous", 12, 0.2, 0.0625, 0.01, 0.01)
    assert "rate_free.viscous = from the atlas" in mpm("info", "law.h5")


def test_stiff():
    # E*/Y = 500: the contact yields below the overlaps that are run (5e-4 R), where the guide's departure goes to zero.
    # At 0.04 m/s the impact turns at 2.3e-4 R, at 0.09 about where the first run does. Bounds: the table's tolerance.
    for name in ("stiff", "steeper"):
        end_to_end(name, 0.04, 0.05, 0.01, 0.01, 0.01)
        assert "the atlas, at the hardening of each strain" in mpm("info", "law.h5")
        compare(name, 0.09, 0.01, 0.01)
        oblique(name)
    assert "johnson-cook, exponent = 0.3" in mpm("info", "law.h5")


def oblique(name):
    """The law file's flow stress enters `tangential plastic`. Measured: e within 3 %, tangential velocity 3, spin 6; by the yield stress alone 25, 31, 50."""
    words = ["oblique", "m.toml", "--particle", name, "--velocity", 2, "--angle", 60, "--friction", 0.6, "--law", "law.h5", "--json"]
    plastic, solver = (answer(*words, "--tangential", way) for way in ("plastic", "solver"))
    for key, within in (("e", 0.06), ("e_tangential", 0.05), ("spin_after_rad_s", 0.1)):
        assert abs(plastic[key] / solver[key] - 1) < within, (name, key, plastic, solver)


def test_skin():
    # E*/Y = 100 in the skin, 49 in the core: stiffer ones cost minutes a run. At 1 m/s (0.0032 R) the contact is as wide as
    # the skin is thick: the core raises e from 0.868 to 0.913 and lowers F from 2.04 to 1.84 N. Bounds: the table's tolerance;
    # F is 0.3 % low, e 0.4 %.
    bodies = MATERIALS.index("[material.skin]")
    Path("m.toml").write_text(MATERIALS[:bodies] + MATERIALS[bodies:].replace("yield_stress = 2e7", "yield_stress = 1e8"))
    end_to_end("coated", 1, 0.05, 0.01, 0.01, 0.01)
    assert "behind a series compliance" in mpm("info", "law.h5")


def test_oriented():
    # A particle with a shape: its material's law, and a certificate over orientations.
    table = ("table", "m.toml", "--pair", "egg:wall", "--directions", 4, "--velocity", 2, "-o", "law.h5")
    told = mpm(*table)
    assert "egg: from the atlas" in told and "answers 100 % of 4 orientations at 2 m/s" in told and "8 runs made" in told, told
    assert "ellipsoid 0.001 0.001 0.0015" in mpm("info", "law.h5")
    assert "answers 100 %" in mpm("check", "law.h5", "--materials", "m.toml", "--impacts", 1, "--seed", 1)
    with h5py.File("law.h5") as file:
        group = file["bodies/egg/orientations"]
        off = group["law_force_max"][:] / group["force_max"][:] - 1
        assert group["force_max"].attrs["unit"] == b"N" and len(off) == 4 and list(group["mirrors"]) == [1, 1, 1]
        assert abs(off).max() < 0.05, off  # single grids of 8 cells: 2 %, and the shape's 1 to 2 %
        first = {name: group[name][:] for name in group if group[name].shape}
    again = mpm(*("--orientations" if word == "--directions" else word for word in table))  # the older name
    assert "0 runs made" in again and "8 taken from the cache" in again, again
    with h5py.File("law.h5") as file:
        for name, values in first.items():
            assert (file["bodies/egg/orientations"][name][:] == values).all(), name
    Path("other.toml").write_text(MATERIALS.replace("1e-3, 1.5e-3]}", "1e-3, 1.4e-3]}"))
    assert "another shape" in mpm("check", "law.h5", "--materials", "other.toml", "--impacts", 1, ok=False)
    mpm("plot", "law.h5", "--shape", "egg", "-o", "map.png")
    assert Path("map.png").read_bytes()[:4] == b"\x89PNG"
    assert "no body with a certificate" in mpm("plot", "law.h5", "--shape", "eg", "-o", "map.png", ok=False)
