"""A granulaw model at the walls alone, under pairs of LIGGGHTS's own hertz: the fixes that report and that stop come with the
walls, in every order of the deck's commands."""
import json
import re

from pytest import approx
from harness import POWDER, Deck, head, properties, sphere_mass

RADIUS = 1.7e-3
MASS = sphere_mass(RADIUS, POWDER.density)
SPEED, PARTING = 1.0, 0.5  # m/s: at the wall; of two spheres at each other
RESTITUTION = "fix q1 all property/global coefficientRestitution peratomtypepair 1 1.0\n"
PAIR = "pair_style gran model hertz tangential history tangential_damping off\npair_coeff * *\n"


class TestWallsOnly(Deck):
    def wall(self, model="mpm", name="w", plane="primitive type 1 zplane 0.0", more=""):
        law = f"law {self.law} materials powder " if model == "mpm" else ""
        return f"fix {name} all wall/gran model {model} tangential history {plane} {law}elasticDamping off {more}\n"

    def spheres(self, speed=SPEED):
        """One flies at the floor, two meet higher up: each at its own known speed."""
        text = ""
        for k, (x, z) in enumerate(((-4, 1.0001), (0, 5), (0, 7.0001)), start=1):
            text += f"create_atoms 1 single {x * RADIUS!r} 0.0 {z * RADIUS!r} units box\ngroup a{k} id {k}\n"
        text += f"set group all diameter {2 * RADIUS!r} density {POWDER.density}\n"
        return (text + f"velocity a1 set 0 0 {-speed}\nvelocity a2 set 0 0 {PARTING}\n"
                "fix i all nve/sphere\ntimestep 2e-8\nthermo_modify lost ignore\n")

    def deck(self, walls, before="", after="", speed=SPEED):
        return head(half=20 * RADIUS) + properties([POWDER]) + RESTITUTION + before + PAIR + walls + after + self.spheres(speed)

    def test_they_report(self):
        """Line, table, JSON and thermo values: the wall's contact, with its speed and loss; none between particles."""
        out = ("variable d equal f_granulaw\nvariable n equal f_granulaw[4]\nvariable p equal f_granulaw[3]\n"
               "variable v equal vcm(a1,z)\nrun 3000\nrun 10\n" 'print "SAID ${d} ${n} ${p} ${v}"\n')
        orders = {"one wall": self.wall() + "fix s all granulaw/stats file s.json\n",
                  "two walls": self.wall() + self.wall(name="lid", plane=f"primitive type 1 zplane {15 * RADIUS!r}") +
                  "fix s all granulaw/stats file s.json\n",
                  "the same wall twice": self.wall() + self.wall() + "fix s all granulaw/stats file s.json\n"}
        for name, walls in orders.items():
            for ranks in (1, 2) if name == "one wall" else (1,):
                text = self.run_deck(self.deck(walls) + out, ranks=ranks)
                loss, begun, between, rebound = self.result(text, "SAID")
                assert (begun, between) == (1, 0), name
                # 500 steps a contact: the step's own error, as in test_stats.py
                assert loss / (0.5 * MASS * (SPEED**2 - rebound**2)) == approx(1.0, abs=2e-4), name
                assert rebound < 0.95
                assert text.count("granulaw contact laws") == 1, name
                assert len(re.findall("^granulaw contacts ", text, re.M)) == 2, text[-3000:]  # one for each run
                stats = json.loads((self.folder / "s.json").read_text())
                assert stats["wall"]["impact_speed_max_m_per_s"] == approx(SPEED, abs=1e-9)
                assert stats["pair"]["contacts_begun"] == 0
                (self.folder / "s.json").unlink()

    def test_thornton_and_replaced_models(self):
        """A wall that was hertz and is granulaw's now, under the same id."""
        out = "variable n equal f_granulaw[4]\nrun 3000\n" 'print "SAID ${n}"\n'
        hertz = "fix w all wall/gran model hertz tangential history primitive type 1 zplane 0.0 tangential_damping off\n"
        for walls in (self.wall("thornton"), hertz + self.wall("thornton"), hertz + self.wall()):
            assert self.result(self.run_deck(self.deck(walls) + out), "SAID") == [1.0]

    def test_other_fixes_stay_whole(self):
        """The wall's own fixes stand behind ours in LIGGGHTS's list: all of them still act, history survives a restart."""
        run = "variable d equal f_granulaw\nvariable v equal vcm(a1,z)\nrun {}\n" + 'print "SAID ${{v}} ${{d}}"\n'
        whole = self.result(self.run_deck(self.deck(self.wall()) + run.format(200)), "SAID")
        self.run_deck(self.deck(self.wall()) + run.format(100) + "write_restart half.restart\n")
        again = head(read="read_restart half.restart", skin=RADIUS)
        moving = "fix i all nve/sphere\ntimestep 2e-8\n"
        resumed = self.result(self.run_deck(again + properties([POWDER]) + RESTITUTION + PAIR + self.wall() + moving +
                                            run.format(100)), "SAID")
        assert whole[1] > 0.0  # half-way in, plastic
        for a, b in zip(resumed, whole):
            assert a / b == approx(1.0, abs=1e-9)  # rounding of positions of 1e-3 R deep, as in test_restart.py

    def test_they_stop(self):
        """Runaway particle, NaN, table left behind: one sentence, on one rank or two."""
        nan = "variable bad atom 1e308*1e308-1e308*1e308\n"
        cases = ((self.deck(self.wall()) + "run 10\nvelocity a3 set 1e7 0 0\nrun 1000\n", "has run away"),
                 (self.deck(self.wall()) + nan + "run 10\nvelocity a3 set v_bad 0 0\nrun 1000\n", "is not a number"),
                 (self.deck(self.wall(), speed=100.0) + "run 3000\n", "beyond the law's table"))
        for ranks, (deck, sentence) in zip((1, 2, 2), cases):
            self.refused(deck, sentence, ranks=ranks)
