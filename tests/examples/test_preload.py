"""A stretched contact under a static load P answers as if under s P (docs/guide/plan.md).

One sphere of wax on a plane, pressed by a force that grows slowly to P, and relieved. Predicted: the deflection is s F^-1(s P), with
F the unstretched law; it stays elastic while s P < F_y, so the force at yield falls to F_y/s."""
import math

from programs import LAUNCHER, ROOT, InFolder, run, table
from pytest import approx, mark

R, RHO, E, NU, Y = 3e-3, 920.0, 91e6, 0.3, 1e6  # examples/hopper/materials.toml
E_STAR = E / (1 - NU**2)
MASS = RHO * 4 / 3 * math.pi * R**3
DELTA_Y = (1.6 * math.pi * Y / (2 * E_STAR))**2 * R   # m, Thornton 1997: first yield at a pressure of 1.6 Y
F_Y = 4 / 3 * E_STAR * math.sqrt(R) * DELTA_Y**1.5     # N
LOAD = F_Y / 5                                         # N
STRETCHES = (1, 3, 10, 30)                             # s P = 0.2, 0.6, 2, 6 F_y

DECK = """atom_style granular
atom_modify map array
units si
boundary f f f
newton off
communicate single vel yes
hard_particles yes
region box block -0.02 0.02 -0.02 0.02 -0.01 0.03 units box
create_box 1 box
neighbor 0.001 bin
neigh_modify delay 0
fix E  all property/global youngsModulus peratomtype {E}
fix nu all property/global poissonsRatio peratomtype {NU}
fix mu all property/global coefficientFriction peratomtypepair 1 0.4
{pair}
pair_coeff * *
fix floor all wall/gran model {model} tangential history primitive type 1 zplane 0.0
create_atoms 1 single 0.0 0.0 {R} units box
set atom 1 diameter {diameter} density {RHO}
fix move all nve/sphere
fix drag all viscous {drag}
timestep {dt}
variable d equal {R}-xcm(all,z)
variable ramp equal -{load}*step/{steps}
fix push all addforce 0.0 0.0 v_ramp
thermo {steps}
run {steps}
unfix push
fix push all addforce 0.0 0.0 -{load}
run {steps}
variable pressed equal ${{d}}
print "PRESSED ${{d}}"
unfix push
fix push all addforce 0.0 0.0 -{rest}
run {steps}
print "RELIEVED ${{d}}"
"""
# Relative tolerance of the deflection: the law is the free, finite sphere's, at d/R < 5e-4 up to 1 + 1.3 %
# stiffer than Hertz's (free support).
CURVE = 0.02
REST = 0.02  # of the load, left on: a sphere with none would creep to its residual overlap for ever


def hertz(force):
    return (force / (4 / 3 * E_STAR * math.sqrt(R)))**(2 / 3)


def thornton(force):
    """Deflection on the loading curve (Thornton 1997, eq. 10: F = F_y + pi p_y R (d - d_y))."""
    return hertz(force) if force <= F_Y else DELTA_Y + (force - F_Y) / (math.pi * 1.6 * Y * R)


class TestPreload(InFolder):
    def prepare(self):
        self.law = table((ROOT / "examples/hopper/materials.toml").read_text())

    def press(self, model, load, s):
        """(deflection under `load`, under REST of it afterwards), m."""
        own = f"law {self.law} materials wax" if model == "mpm" else ""
        pair = f"pair_style gran model {model} tangential history {own} elasticDamping off stretch {s}"
        if model == "thornton":
            pair = f"fix Y all property/global yieldStress peratomtype {Y}\n" + pair
        # Stiffest on the way, k = 2 E* a at the load as the unstretched law has it, over s^2; the drag is aperiodic there,
        # so the load is never overshot. A ramp takes 300 of its time constants, a hold another 300.
        k = 2 * E_STAR * math.sqrt(R * hertz(s * load)) / s**2
        dt = 0.1 * math.sqrt(MASS / k)
        text = DECK.format(E=E, NU=NU, R=R, RHO=RHO, diameter=2 * R, model=model, pair=pair, drag=2 * math.sqrt(k * MASS), dt=dt,
                           load=load, rest=REST * load, steps=6000)
        (self.folder / "in.preload").write_text(text)
        said = run(LAUNCHER, "-in", "in.preload", "-log", "none", cwd=self.folder).stdout
        found = {line.split()[0]: float(line.split()[1]) for line in said.splitlines() if line.startswith(("PRESSED", "RELIEVED"))}
        return found["PRESSED"], found["RELIEVED"]

    def check_set(self, relieved, s):
        """Elastic: back on Hertz's curve at the rest of the load. Beyond F_y/s: a set is left."""
        elastic = s * hertz(s * REST * LOAD)
        if s * LOAD < F_Y:
            assert relieved / elastic == approx(1, abs=CURVE)
        else:
            assert relieved / elastic > 1 + 5 * CURVE  # no stiffness of the curve could be that wrong

    @mark.parametrize("s", STRETCHES)
    def test_thornton_in_closed_form(self, s):
        pressed, relieved = self.press("thornton", LOAD, s)
        assert pressed / (s * thornton(s * LOAD)) == approx(1, abs=1e-4), f"s = {s}"  # what the hold leaves
        self.check_set(relieved, s)

    @mark.parametrize("s", STRETCHES)
    def test_mpm_as_under_s_times_the_load(self, s):
        pressed, relieved = self.press("mpm", LOAD, s)
        plain, _ = self.press("mpm", s * LOAD, 1)
        assert pressed / (s * plain) == approx(1, abs=1e-4), f"s = {s}"
        self.check_set(relieved, s)
        if s * LOAD < F_Y:  # the deflection grows by s^(5/3)
            assert pressed / (s**(5 / 3) * hertz(LOAD)) == approx(1, abs=CURVE)
