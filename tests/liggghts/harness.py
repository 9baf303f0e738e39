"""Decks, runs and numbers for the tests of the LIGGGHTS plug-in."""
import math
import os
import re

import pytest
from programs import LAUNCHER, MPIRUN, InFolder, answer, run

PLUGIN = os.environ["GRANULAW_PLUGIN"]
FIXTURE = os.environ["GRANULAW_FIXTURE"]


class Material:
    """SI. E*/Y = 100 for powder, as in tests/unit/synthetic_law.hpp."""

    def __init__(self, name, density, youngs_modulus, poisson_ratio, yield_stress):
        self.name, self.density, self.yield_stress = name, density, yield_stress
        self.youngs_modulus, self.poisson_ratio = youngs_modulus, poisson_ratio
        self.e_star = youngs_modulus / (1 - poisson_ratio**2)


POWDER = Material("powder", 1500.0, 9.1e9, 0.3, 1e8)
GLASS = Material("glass", 2500.0, 70e9, 0.2, 1e30)


def properties(materials, friction=0.0):
    n = len(materials)
    matrix = " ".join([str(friction)] * (n * n))
    return (
        f"fix p1 all property/global youngsModulus peratomtype {' '.join(repr(m.youngs_modulus) for m in materials)}\n"
        f"fix p2 all property/global poissonsRatio peratomtype {' '.join(repr(m.poisson_ratio) for m in materials)}\n"
        f"fix p3 all property/global yieldStress peratomtype {' '.join(repr(m.yield_stress) for m in materials)}\n"
        f"fix p4 all property/global coefficientFriction peratomtypepair {n} {matrix}\n"
        f"fix p5 all property/global coefficientRollingFriction peratomtypepair {n} {matrix}\n")


def head(types=1, half=0.05, units="si", boundary="f f f", skin=None, extra="", read="", neigh="delay 0"):
    """Everything before the pair style; a cube of half-width `half` (m), or what the command `read` reads."""
    box = read or f"region box block {-half} {half} {-half} {half} {-half} {half} units box\ncreate_box {types} box"
    return (f"units {units}\nhard_particles yes\natom_style granular\natom_modify map array {extra}\nboundary {boundary}\nnewton off\n"
            f"communicate single vel yes\n{box}\nneighbor {skin if skin else half / 20} bin\nneigh_modify {neigh}\n")


def worst(values):
    """The largest; not a number where one of them is none: max() passes over it unless it comes first."""
    values = list(values)
    return math.nan if any(v != v for v in values) else max(values)


class Deck(InFolder):
    """A test with a folder and a law of its own."""

    @pytest.fixture(autouse=True)
    def _own_folder(self, tmp_path):
        self.folder, self.law = tmp_path, tmp_path / "powder.h5"
        self.fixture("write", self.law)
        self.prepare()

    def fixture(self, *words):
        return [float(w) for w in run(FIXTURE, *words).stdout.split()]

    def run_deck(self, deck, ranks=1, launcher=None, environment=None, expect_failure=False):
        """Runs and returns what was printed. Fails the test unless the exit status is as expected."""
        (self.folder / "in.deck").write_text(deck)
        command = [MPIRUN, "--oversubscribe", "-np", ranks] if ranks > 1 else []
        done = run(*command, launcher or LAUNCHER, "-in", self.folder / "in.deck", "-log", self.folder / "log.liggghts", code=None if expect_failure else 0,
                   cwd=self.folder, timeout=int(os.environ.get("GRANULAW_DECK_TIMEOUT", "300")), env=environment)
        return done.stdout + done.stderr

    def refused(self, deck, *parts, **how):
        """One sentence that holds all of these, the same on all ranks."""
        text = self.run_deck(deck, expect_failure=True, **how)
        errors = [line for line in text.splitlines() if line.startswith("ERROR")]
        assert len(errors) == 1, text[-3000:]
        for part in parts:
            assert part in errors[0], errors[0]

    def result(self, text, name):
        """The numbers behind `print "NAME ..."`."""
        found = self.results(text, name)
        assert found, f"no line '{name} ...' in:\n{text[-3000:]}"
        return found[-1]

    def results(self, text, name):
        return [[float(w) for w in line.split()] for line in re.findall(rf"^{name} (.*)$", text, re.M)]

    def run_each(self, decks, name, ranks=1):
        """The numbers behind `print "NAME ..."` of each of many short decks: one process, `clear` between them."""
        decks = list(decks)
        text = self.run_deck("clear\n".join(decks), ranks=ranks)
        found = self.results(text, name)
        assert len(found) == len(decks), text[-3000:]
        return found


    def frames(self, name="end.dump"):
        """Columns of each frame of a text dump by particle id: {id: [numbers]}."""
        found, lines = [], (self.folder / name).read_text().splitlines()
        for k, line in enumerate(lines):
            if line.startswith("ITEM: NUMBER OF"):
                count = int(lines[k + 1])
            elif line.startswith(("ITEM: ATOMS", "ITEM: ENTRIES")):
                rows = [row.split() for row in lines[k + 1:k + 1 + count]]
                found.append({int(row[0]): [float(w) for w in row[1:]] for row in rows})
        return found

    def last_frame(self, name="end.dump"):
        return self.frames(name)[-1]


def dump(what, every=1, name="end"):
    """A dump of the columns `what` (all of them numbers) at full precision, id first."""
    form = " ".join(["%d"] + ["%.17g"] * len(what.split()))
    return f'dump {name} all custom {every} {name}.dump id {what}\ndump_modify {name} format "{form}"\n'


def mpm_law(law, pair, speed, radius, radius2=None):
    """A collision as `mpm law` integrates it."""
    words = ["--radius2", repr(radius2)] if radius2 else []
    return answer("law", law, "--pair", pair, "--radius", repr(radius), *words, "--velocity", repr(speed), "--json")


def sphere_mass(radius, density):
    return 4.0 / 3.0 * math.pi * radius**3 * density


def thornton_closed_form(ratio):
    """e of V/V_y = ratio > 1: Thornton 1997, eq. 41."""
    x = 1.0 / ratio
    return (math.sqrt(6 * math.sqrt(3) / 5) * math.sqrt(1 - x * x / 6)
            * (x / (x + 2 * math.sqrt(1.2 - 0.2 * x * x)))**0.25)


def thornton_yield_velocity(e_star, p_y, r_eff, m_eff):
    """Speed whose kinetic energy is the elastic work up to yield: m V_y^2/2 = 8/15 E* R*^3 (pi p_y/(2E*))^5."""
    return math.sqrt(16 / 15 * e_star * r_eff**3 * (math.pi * p_y / (2 * e_star))**5 / m_eff)


def plane_stl(half=0.02, z=0.0):
    """A square of two triangles, normal +z, split along the diagonal x = y."""
    a, b, c, d = (-half, -half, z), (half, -half, z), (half, half, z), (-half, half, z)
    text = "solid plane\n"
    for triangle in ((a, b, c), (a, c, d)):
        text += "facet normal 0 0 1\nouter loop\n"
        text += "".join("vertex {:.9g} {:.9g} {:.9g}\n".format(*v) for v in triangle) + "endloop\nendfacet\n"
    return text + "endsolid plane\n"
