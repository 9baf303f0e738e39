"""Decks that break plastic contact models: long rest, overlaps past the table, NaN.

With GRANULAW_FULL=1 the bed for a million steps (slow)."""
import os
import random

from collisions import pair_deck
from harness import POWDER, Deck, head, properties, worst

RADIUS = 1.7e-3
FULL = "GRANULAW_FULL" in os.environ
BED = 5e-7  # s, 30 steps a contact
THERMO = ("compute rot all erotate/sphere\nvariable pot equal mass(all)*981.0*xcm(all,z)\nthermo_style custom step ke c_rot v_pot f_granulaw[14] f_granulaw f_granulaw[15]\n"
          "thermo 200\nthermo_modify norm no lost error format float %.17g\n")


def bed(law, model, words, run, restart=None):
    """A box of 3 x 3 x 3 spheres between four walls under 100 g, that falls be short; thrown at a floor at 1 m/s. Frictionless. `restart`: a file that holds the spheres."""
    rng, pitch = random.Random(5), 2.02 * RADIUS
    half = 1.5 * pitch
    words = f"law {law} materials powder {words}" if model == "mpm" else words
    text = (head(half=60 * RADIUS, skin=RADIUS / 2, read=restart and f"read_restart {restart}") + properties([POWDER]) +
            f"pair_style gran model {model} tangential history {words}\npair_coeff * *\n")
    # none may fly out of the box
    for name, plane in (("x0", f"xplane {-half!r}"), ("x1", f"xplane {half!r}"), ("y0", f"yplane {-half!r}"), ("y1", f"yplane {half!r}"), ("floor", "zplane 0.0"), ("lid", f"zplane {50 * RADIUS!r}")):
        text += f"fix {name} all wall/gran model {model} tangential history primitive type 1 {plane}\n"
    for k in range(0 if restart else 27):
        x = [(k % 3 - 1) * pitch, (k // 3 % 3 - 1) * pitch, (k // 9 + 0.52) * pitch]
        text += "create_atoms 1 single {!r} {!r} {!r} units box\n".format(*(c + rng.uniform(-0.008, 0.008) * RADIUS for c in x))
    if not restart:
        text += f"set group all diameter {2 * RADIUS!r} density {POWDER.density}\nvelocity all set 0 0 -1.0\n"
    return text + f"fix g all gravity 981.0 vector 0 0 -1\nfix i all nve/sphere\ntimestep {BED!r}\n" + run


class TestEnergy(Deck):
    def energies(self, text, steps):
        """Energies of each output: motion (kinetic + held by contacts), mechanical (+ gravity), kinetic. J"""
        rows = [[float(w) for w in line.split()] for line in text.splitlines() if len(line.split()) == 7 and line.split()[0].isdigit()]
        assert len(rows) >= steps // 200
        return [(k + r + s, k + r + s + p, k + r) for _, k, r, p, s, _, _ in rows]

    def test_default_damping(self):
        """Mechanical energy never grows and the bed comes to rest."""
        steps = 1000000 if FULL else 40000
        for model in ("mpm", "thornton"):
            rows = self.energies(self.run_deck(bed(self.law, model, "energy on", THERMO + f"run {steps}\n")), steps)
            least = rows[0][1]
            for motion, mechanical, _ in rows:
                # velocity Verlet at 30 steps a contact: the work of a contact is good to (1/30)^2 of it, either sign
                assert mechanical - least < 1e-3 * motion, model
                least = min(least, mechanical)
            assert worst(row[2] for row in rows[-len(rows) // 10:]) < (1e-3 if FULL else 5e-2) * rows[0][2], model

    def test_rest(self):
        """A bed that lies still (settled with strong damping, read from a restart file), with default damping and with none."""
        steps = 1000000 if FULL else 20000
        for model in ("mpm", "thornton"):
            self.run_deck(bed(self.law, model, "energy on elasticDamping 0.3", "run 60000\nwrite_restart still.restart\n"))
            for damping in ("elasticDamping off", ""):
                rows = self.energies(self.run_deck(bed(self.law, model, f"energy on {damping}", THERMO + f"run {steps}\n", "still.restart")), steps)
                held = rows[0][0]
                assert held > 0.0  # contacts carry the weight
                assert worst(row[1] - rows[0][1] for row in rows) / rows[0][1] < 1e-14, model  # rounding of a sum over 27 spheres, 1e-16 each
                assert worst(abs(row[0] - held) for row in rows) / held < 1e-9, model    # overlaps of 1e-4 R are good to 1e-12, their energy to little more


class TestStops(Deck):
    def stopped(self, deck, sentence, ranks):
        text = self.run_deck(deck, ranks=ranks, expect_failure=True)
        lines = [line for line in text.splitlines() if line.startswith("ERROR")]
        # a pair that two ranks share may stop both: then both say the same
        assert len({line.split(": ", 1)[1] for line in lines}) == 1, text[-3000:]
        assert sentence in lines[0]

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
        for ranks, who, other in ((1, "last", "last"), (2, "first", "last")):
            self.stopped(self.two_spheres(f"{nan}run 50\nvelocity {who} set v_bad 0 0\nrun 1000\n"), "is not a number", ranks)
            self.stopped(self.two_spheres(f"run 50\nvelocity {other} set 1e5 0 0\nrun 1000\n"), "has run away", ranks)
            # becomes NaN while running: a force that is none
            self.stopped(self.two_spheres(f"{nan}run 50\nfix f last addforce v_bad 0 0\nrun 1000\n"), "is not a number", ranks)

    def test_fast_but_sound(self):
        """A sphere that leaves the box in good order stops nothing."""
        self.run_deck(self.two_spheres("velocity last set 50.0 0 0\nrun 10000\n"))
