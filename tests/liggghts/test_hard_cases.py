"""Decks that break plastic contact models: long rest, shaking, overlaps past the table, NaN.

With GRANULAW_FULL=1 the bed for a million steps (slow)."""
import math
import os
import random

from collisions import pair_deck
from harness import POWDER, head, plane_stl, properties, worst
from trials import Trial

RADIUS = 1.7e-3
FULL = "GRANULAW_FULL" in os.environ
ELASTIC = "fix q1 all property/global coefficientRestitution peratomtypepair 1 1.0\n"
BED = 5e-7  # s, 30 steps a contact


def bed(law, model="mpm", n=3, layers=3, friction=0.0, run="", gravity=9.81, seed=5, floor=None, speed=0.0,
        words="elasticDamping off", restart=None):
    """A box of n x n x layers spheres between four walls, dropped on a floor. Frictionless unless said. `restart`: a file
    that holds the spheres."""
    rng, pitch = random.Random(seed), 2.02 * RADIUS
    half = n * pitch / 2
    words = {"mpm": f"law {law} materials powder {words}", "thornton": words, "hertz": "tangential_damping off"}[model]
    wall = f"wall/gran model {model} tangential history"
    text = (head(half=60 * RADIUS, skin=RADIUS / 2, read=restart and f"read_restart {restart}") + properties([POWDER], friction) +
            (ELASTIC if model == "hertz" else "") +
            f"pair_style gran model {model} tangential history {words}\npair_coeff * *\n")
    tail = "tangential_damping off" if model == "hertz" else ""
    for name, plane in (("x0", f"xplane {-half!r}"), ("x1", f"xplane {half!r}"), ("y0", f"yplane {-half!r}"),
                        ("y1", f"yplane {half!r}")):
        text += f"fix {name} all {wall} primitive type 1 {plane} {tail}\n"
    text += f"fix lid all {wall} primitive type 1 zplane {50 * RADIUS!r} {tail}\n"  # none may fly out of the box
    text += floor or f"fix floor all {wall} primitive type 1 zplane 0.0 {tail}\n"
    for k in range(0 if restart else n * n * layers):
        x = [(k % n - (n - 1) / 2) * pitch, (k // n % n - (n - 1) / 2) * pitch, (k // n**2 + 0.52) * pitch]
        x = [c + rng.uniform(-0.008, 0.008) * RADIUS for c in x]
        text += "create_atoms 1 single {!r} {!r} {!r} units box\n".format(*x)
    if not restart:
        text += f"set group all diameter {2 * RADIUS!r} density {POWDER.density}\nvelocity all set 0 0 {-speed!r}\n"
    return (text + f"fix g all gravity {gravity} vector 0 0 -1\nfix i all nve/sphere\ntimestep {BED!r}\n"
            "compute rot all erotate/sphere\n"
            f"variable pot equal mass(all)*{gravity}*xcm(all,z)\n" + run)


class TestEnergy(Trial):
    def series(self, text):
        """Columns of the thermo tables."""
        rows = []
        for line in text.splitlines():
            words = line.split()
            if len(words) >= 3 and words[0].isdigit():
                try:
                    rows.append([float(w) for w in words])
                except ValueError:
                    pass
        return rows

    THERMO = ("thermo_style custom step ke c_rot v_pot f_granulaw[14] f_granulaw f_granulaw[15]\nthermo 200\n"
              "thermo_modify norm no lost error format float %.17g\n")

    def energies(self, text, steps):
        """Energies of each output: motion (kinetic + held by contacts), mechanical (+ gravity), all (+ taken by contacts), kinetic. J"""
        rows = self.series(text)
        assert len(rows) >= steps // 200
        return [(k + r + s, k + r + s + p, k + r + s + p + d + o, k + r) for _, k, r, p, s, d, o in rows]

    def growth(self, rows):
        """Largest rise of the mechanical energy above its least value so far, over the motion of that moment."""
        least, largest = rows[0][1], 0.0
        for motion, mechanical, *_ in rows:
            if mechanical > least:
                largest = max(largest, (mechanical - least) / motion)
            least = min(least, mechanical)
        return largest

    def test_default_damping(self):
        """Thrown at 1 m/s under 100 g (that falls be short): mechanical energy never grows and the bed comes to rest."""
        steps = 1000000 if FULL else 40000
        for model in ("mpm", "thornton"):
            rows = self.energies(self.run_deck(bed(self.law, model, speed=1.0, gravity=981.0, words="energy on",
                                                   run=self.THERMO + f"run {steps}\n")), steps)
            growth, left = self.growth(rows), max(row[3] for row in rows[-len(rows) // 10:]) / rows[0][3]
            drift = worst(abs(row[2] - rows[0][2]) for row in rows) / rows[0][0]
            self.record("default damping", model=model, steps=steps, growth=growth, left=left, drift=drift)
            # velocity Verlet at 30 steps a contact: the work of a contact is good to (1/30)^2 of it, either sign
            assert growth < 1e-3, model
            assert left < (1e-3 if FULL else 5e-2), model

    def test_rest(self):
        """A bed that lies still (settled with strong damping, read from a restart file), with default damping and with none."""
        steps = 1000000 if FULL else 20000
        for model in ("mpm", "thornton"):
            still = dict(model=model, gravity=981.0)
            self.run_deck(bed(self.law, words="energy on elasticDamping 0.3", run="run 60000\nwrite_restart still.restart\n", **still))
            for damping in ("elasticDamping off", ""):
                rows = self.energies(self.run_deck(bed(self.law, words=f"energy on {damping}", restart="still.restart",
                                                       run=self.THERMO + f"run {steps}\n", **still)), steps)
                growth = max(row[1] - rows[0][1] for row in rows) / rows[0][1]
                held = rows[0][0]
                moves = worst(abs(row[0] - held) for row in rows) / held
                self.record("at rest", model=model, damping=damping.split()[-1] if damping else "default", steps=steps, growth=growth, moves=moves)
                assert held > 0.0  # contacts carry the weight
                assert growth < 1e-14, model  # rounding of a sum over 27 spheres, 1e-16 each
                assert moves < 1e-9, model    # overlaps of 1e-4 R are good to 1e-12, their energy to little more

    def test_bed_comes_down(self):
        """Kinetic + potential energy never exceeds what was there before the first touch, less what was dissipated."""
        steps = 1000000 if FULL else 20000
        out = ("thermo_style custom step ke c_rot v_pot {}\nthermo 200\nthermo_modify norm no lost error format float %.17g\n")
        for model in ("mpm", "thornton", "hertz"):
            out_model = out.format("f_granulaw" if model != "hertz" else "")
            # thrown at 1 m/s: yields; then gravity
            rows = self.series(self.run_deck(bed(self.law, model, speed=1.0, run=out_model + f"run {steps}\n")))
            assert len(rows) >= steps // 200
            # [step, kinetic, kinetic + potential, dissipated]
            rows = [[row[0], row[1] + row[2], row[1] + row[2] + row[3], row[4] if model != "hertz" else 0.0] for row in rows]
            start = rows[0][2]
            gained = max(row[2] + row[3] - start for row in rows) / start
            alone = max(row[2] - start for row in rows) / start
            late = rows[len(rows) // 2:]
            self.record("rest", model=model, steps=steps, gained=gained, mechanical=alone, kinetic_start=rows[0][1],
                        kinetic_half=late[0][1], kinetic_end=rows[-1][1], kinetic_late=max(row[1] for row in late))
            if model != "hertz":
                # velocity Verlet at 30 steps a contact: each contact's work is good to (1/30)^2 of it, either sign
                assert gained < 1e-3, model
                assert alone <= 1e-12, model
                assert rows[-1][1] < 0.5 * rows[0][1], model  # the contacts did dissipate

    def test_vibrated_bed(self):
        """A mesh floor that shakes (1 kHz, 0.2 mm: 1.3 m/s, 100 g lest spheres leave the box): contacts that dissipate keep less of it than elastic ones."""
        (self.folder / "plane.stl").write_text(plane_stl(half=16 * RADIUS))
        amplitude, period = 2e-4, 1e-3
        peak = 2 * math.pi * amplitude / period
        found = {}
        for model in ("mpm", "hertz"):
            tail = "tangential_damping off" if model == "hertz" else ""
            floor = ("fix cad all mesh/surface file plane.stl type 1\n"
                     f"fix shake all move/mesh mesh cad wiggle amplitude 0. 0. {amplitude!r} period {period!r}\n"
                     f"fix floor all wall/gran model {model} tangential history mesh n_meshes 1 meshes cad {tail}\n")
            rows = self.series(self.run_deck(bed(self.law, model, floor=floor, gravity=981.0, run=(
                "compute vmax all reduce max vz\nthermo_style custom step ke c_vmax\nthermo 100\nthermo_modify norm no lost error\nrun 20000\n"))))
            fastest = worst(row[2] for row in rows)
            late = sum(row[1] for row in rows[-50:]) / 50
            self.record("shaken", model=model, floor=peak, fastest=fastest, kinetic=late)
            found[model] = fastest, late
        for ours, elastic in zip(found["mpm"], found["hertz"]):  # 3.2 and 4.8 m/s; 0.5 and 1.1 mJ
            assert ours < elastic
            assert ours > 0.0


class TestStops(Trial):
    def stopped(self, deck, sentence, ranks):
        text = self.run_deck(deck, ranks=ranks, expect_failure=True)
        lines = [line for line in text.splitlines() if line.startswith("ERROR")]
        # a pair that two ranks share may stop both: then both say the same
        assert len({line.split(": ", 1)[1] for line in lines}) == 1, text[-3000:]
        assert sentence in lines[0]
        self.record("stops", ranks=ranks, line=lines[0])

    def two_spheres(self, extra="", gap=3.0, dt=2e-7):
        """Two spheres on either side of x = 0 (one per rank of two) that never touch; `extra` strikes."""
        text = head(half=20 * RADIUS) + properties([POWDER])
        text += f"pair_style gran model mpm tangential history law {self.law} materials powder\npair_coeff * *\n"
        for sign in (-1, 1):
            text += f"create_atoms 1 single {sign * gap * RADIUS!r} {sign * RADIUS!r} 0.0 units box\n"
        return (text + f"set group all diameter {2 * RADIUS!r} density {POWDER.density}\ngroup last id 2\ngroup first id 1\n"
                f"velocity all set 0 0 0.1\nfix i all nve/sphere\ntimestep {dt!r}\nthermo_modify lost ignore\n" + extra)

    def test_overlap_past_the_table(self):
        deck = pair_deck("mpm", f"law {self.law} materials powder", (POWDER, POWDER), (RADIUS, RADIUS), 200.0, 2e-8,
                         run="run 1000")
        for ranks in (1, 2):
            self.stopped(deck, "beyond the law's table", ranks)

    def test_nan_and_runaway(self):
        nan = "variable bad atom 1e308*1e308-1e308*1e308\n"
        for ranks in (1, 2):
            for who in ("first", "last"):
                self.stopped(self.two_spheres(f"{nan}run 50\nvelocity {who} set v_bad 0 0\nrun 1000\n"), "is not a number", ranks)
                self.stopped(self.two_spheres(f"run 50\nvelocity {who} set 1e5 0 0\nrun 1000\n"), "has run away", ranks)
            # becomes NaN while running: a force that is none
            self.stopped(self.two_spheres(f"{nan}run 50\nfix f last addforce v_bad 0 0\nrun 1000\n"), "is not a number", ranks)

    def test_fast_but_sound(self):
        """A sphere that leaves the box in good order stops nothing."""
        self.run_deck(self.two_spheres("velocity last set 50.0 0 0\nrun 10000\n"))
