"""A ball that is fixed to a body: the solver against the law."""
from pathlib import Path

from pytest import approx, fixture

from programs import answer, material, mpm, particle

BALL = "--pair", "wc:steel", "--radius", "1.5e-3", "--radius2", "inf", "--velocity", "2.05"
MASS, COMPLIANCE = 5.45e-3, 1e-9


@fixture(autouse=True)
def materials(here):
    Path("m.toml").write_text(material("wc", 14900, "625e9", 0.22) + material("steel", 7850, "210e9", 0.29, "1e9")
                              + particle("ball", "wc", 1.5e-3, more=f"impact_body_mass = {MASS}"))


def test_impact_body():
    mpm("table", "m.toml", "--pair", "wc:steel", "-o", "l.h5")
    impact = "impact", "m.toml", "--particle", "ball", "--wall", "steel", "--velocity", "2.05", "--resolution", "12", "--shifted-grids", "1", "--no-estimate"
    mass = "--impact-body-mass", str(MASS)
    for compliance in [], ["--impact-body-compliance", str(COMPLIANCE)]:
        law, run = answer("law", "l.h5", *BALL, *mass, *compliance, "--json"), answer(*impact, *compliance, "--json")
        # the law's bound, and 0.005 of a single grid of 12 cells
        assert run["e"] == approx(law["e"], abs=law["error_restitution"] + 0.005)
        assert run["force_max_N"] == approx(law["force_max_N"], rel=law["error_force"] + 0.01)
        # energies close: all that came is in the contact and the body
        assert run["work_load_J"] == approx(0.5 * MASS * 2.05 ** 2, rel=0.005)
        assert run["work_unload_J"] / run["work_load_J"] == approx(run["e"] ** 2, rel=0.01)
    free = answer("law", "l.h5", *BALL, "--json")
    assert free["force_max_N"] < 0.3 * law["force_max_N"]  # 26 times lighter; F goes as the root of the energy
    for words, sentence in [(("law", "l.h5", *BALL, "--impact-body-mass", "1e-4"), "is below the mass of its sphere"),
                            ((*impact, "--impact-body-mass", "1e-4"), "is below the particle's own"),
                            ((*impact[:4], "--velocity", "1", *mass, "--friction", "0.1"), "turns with its sphere")]:
        assert sentence in mpm(*words, code=None).stderr


def test_a_device_without_readings():
    """The radius of a rebound tester is no drop's, and its device is of no use to drops."""
    Path("drops.csv").write_text("velocity_m_per_s,restitution\n1,0.7\n2,0.6\n")
    words = "calibrate", "drops.csv", "--leeb", "D", "--density", "1500", "--youngs-modulus", "1e10", "--fit", "yield_stress"
    assert "--radius: is missing" in mpm(*words, code=None).stderr
    assert "--leeb: goes with leeb_hardness" in mpm(*words, "--radius", "1e-3", code=None).stderr
