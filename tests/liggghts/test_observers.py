"""Quantities that LIGGGHTS reads out of the pair loop, which is our own: equal to stock Hertz's under an elastic law.

Material `elastic` is Hertz from the law's tables (error 3e-6 of the force: docs/evidence/tests.md), without damping;
stock Hertz with restitution 1 has none either. One state, so that nothing has time to drift apart.
"""

import gas
import re

from pytest import approx
from harness import POWDER, Deck, properties

TOLERANCE = 1e-5  # of the largest value: three times the table's error, and six printed digits
DUMP = ('compute l all pair/gran/local pos id force torque history\n'
        'dump d all local 1 local.dump c_l[1] c_l[2] c_l[3] c_l[4] c_l[5] c_l[6] c_l[7] c_l[8] c_l[9] c_l[10] c_l[11]'
        ' c_l[12] c_l[13] c_l[14] c_l[15]\ndump_modify d format "' + " ".join(["%.12g"] * 15) + '"\n')
PRESSURE = ("compute p all pressure thermo_temp virial\n" +
            "".join(f"variable p{k} equal c_p[{k}]\n" for k in range(1, 7)) +
            "thermo_style custom step c_p[1] c_p[2] c_p[3] c_p[4] c_p[5] c_p[6]\nthermo 1\nthermo_modify norm no\n")


class TestObservers(Deck):
    def run_gas(self, name, words, extra):
        gas.data_file(self.folder / "gas.data")
        restitution = "fix p6 all property/global coefficientRestitution peratomtypepair 1 1.0\n"
        deck = (gas.start(neigh="delay 0 contact_distance_factor 1.01") + properties([POWDER], 0.3) + restitution +
                f"pair_style gran model {name} tangential history {words} tangential_damping off\npair_coeff * *\n" +
                gas.MOVE + extra + DUMP + PRESSURE +
                "run 900\nprint \"P ${p1} ${p2} ${p3} ${p4} ${p5} ${p6}\"\n")
        pressure = self.result(self.run_deck(deck), "P")
        rows, state = {}, None
        for line in (self.folder / "local.dump").read_text().splitlines():
            if line.startswith("ITEM:"):
                state = line
                if "TIMESTEP" in line:
                    rows = {}  # the last step's stay
            elif "ENTRIES" in state and "NUMBER" not in state:
                values = [float(w) for w in line.split()]
                rows[tuple(values[6:8])] = values
        return pressure, rows

    def compare(self, extra=""):
        hertz_pressure, hertz = self.run_gas("hertz", "", extra)
        pressure, ours = self.run_gas("mpm", f"law {self.law} materials elastic elasticDamping off", extra)
        assert len(hertz) > 10, "the state shows nothing: hardly a contact"
        assert ours.keys() ^ hertz.keys() == set(), "pairs in contact under one model only"
        for column in range(9, 15):
            largest = max(abs(r[column]) for r in hertz.values())
            for pair, row in hertz.items():
                assert ours[pair][column] == approx(row[column], abs=TOLERANCE * max(largest, 1e-12)), f"pair {pair}, column {column + 1}"
        scale = max(map(abs, hertz_pressure))
        for found, wanted in zip(pressure, hertz_pressure):
            assert found == approx(wanted, abs=TOLERANCE * scale)

    def test_pressure_and_local_forces(self):
        self.compare()

    def test_with_frozen_spheres(self):
        """The effective mass and who gets a force when some spheres are held."""
        self.compare("group held id 1 5 9 20 31 62 63 64 100\nfix h held freeze\n")

    def test_multicontact_is_refused(self):
        gas.data_file(self.folder / "gas.data")
        deck = (gas.start() + gas.model(f"law {self.law} materials powder") + gas.MOVE +
                "fix m all multicontact/halfspace\nrun 1\n")
        assert re.search("multicontact", self.run_deck(deck, expect_failure=True))
