"""Between two runs: the histories of open contacts outlast every command that leaves them alone (matrix_between.py).

::TestCommands   every command on one rank, those that touch lists and particles on two
::TestThorough   every command on two ranks; a restart file after each, read on the other number of ranks"""
import csv
import math
import re

from pytest import mark
import matrix_between as between
from harness import Deck, worst
from programs import ROOT

# A rank's sums are in another order than one rank's, and lists that are made anew list neighbours in another one: 1e-16 a step, amplified by 250 steps.
ROUNDING = 1e-9
MODELS = ("mpm", "thornton")
SPLIT = f"run {between.BEFORE}\n{{}}\nrun {between.AFTER}\n"

class Between(Deck):
    def prepare(self):
        for name, text in between.FILES.items():
            (self.folder / name).write_text(text)

    def deck(self, model, run, file, **more):
        wall = more.get("wall_model") or model
        run = run.replace("@NOW", str(between.BEFORE)).replace("@WALL", f"model {wall} tangential history")
        run = run.replace("@OURS", "tangential_damping off" if wall == "hertz" else "wall deformable")
        return between.start(model, **more) + between.GROUPS + run + between.state(file)

    def read(self, name):
        """{id: values} of a state."""
        lines = (self.folder / name).read_text().splitlines()
        first = next(k for k, line in enumerate(lines) if line.startswith("ITEM: ATOMS")) + 1
        rows = [[float(w) for w in line.split()] for line in lines[first:]]
        return {int(row[0]): row[2:] for row in rows}

    def apart(self, name, wanted, by_place=False):
        """The largest difference of two states, over the largest value of each column, of the particles that both have. by_place: they have other numbers."""
        ours, theirs = (self.read(file) for file in (name, wanted))
        if by_place:
            ours = {k: min(ours.values(), key=lambda row: math.dist(row[:3], there[:3])) for k, there in theirs.items()}
        common = ours.keys() & theirs.keys()
        assert len(common) > 50
        scale = [max(map(abs, column)) for column in zip(*theirs.values())]
        return worst(abs(a - b) / s for k in common for a, b, s in zip(ours[k], theirs[k], scale))

    def check(self, model, ranks, rows, whole=f"run {between.BEFORE + between.AFTER}\n", one_process=True, **more):
        """Each row's bed against the unbroken run, or against its own equivalent sphere."""
        decks = [self.deck(model, whole, "whole.txt", **more)]
        for k, (_, lines, twin) in enumerate(rows):
            decks.append(self.deck(model, SPLIT.format(lines), f"{k}.txt", **more))
            if twin:
                decks.append(self.deck(model, SPLIT.format(twin), f"{k}.twin.txt", **more))
        for text in ["clear\n".join(decks)] if one_process else decks:
            self.run_deck(text, ranks=ranks)
        found = {}
        for k, (_, lines, twin) in enumerate(rows):
            apart = self.apart(f"{k}.txt", f"{k}.twin.txt" if twin else "whole.txt", by_place="delete_atoms" in lines or "compress_tags" in lines)
            if not apart <= ROUNDING:
                found[lines] = apart
        assert found == {}, (model, ranks)

TOUCHING = ("atom_modify", "change_box", "create_atoms", "delete_atoms", "neigh_modify", "neighbor", "run", "set", "write_restart")

class TestCommands(Between):
    @mark.parametrize("model", MODELS)
    def test_every_command(self, model):
        self.check(model, 1, between.rows())

    def test_the_table_has_every_command(self):
        with open(ROOT / "docs/evidence/liggghts-matrix.csv", newline="", encoding="utf-8") as table:
            stated = {row["command or option"] for row in csv.DictReader(table) if row["group"] == "Between two runs"}
        assert stated == set(between.COMMANDS)

    def test_commands_that_touch_lists_and_particles(self):
        self.check("mpm", 2, [row for row in between.rows() if row[0] in TOUCHING or "coord/atom" in row[1]])

    @mark.parametrize("model", MODELS)
    def test_histories_matter(self, model):
        """The rows would show it: beds whose contacts begin anew are others."""
        self.run_deck(self.deck(model, SPLIT.format(""), "whole.txt"))
        self.run_deck(self.deck(model, SPLIT.format("neigh_modify exclude group all all\nrun 0\nneigh_modify exclude none"), "lost.txt"))
        assert self.apart("lost.txt", "whole.txt") > 0.01, model

    def test_another_search(self):
        """`neighbor ... nsq` makes all lists anew; it needs primitive walls."""
        rows = [("neighbor", "neighbor 0.0004 nsq", ""), ("neighbor", "neighbor 0.0004 nsq\nrun 0\nneighbor 0.0004 bin", "")]
        for model in MODELS:
            for ranks in (1, 2):
                self.check(model, ranks, rows, mesh=False)

    def test_hybrid(self):
        """One gran within a hybrid is as one alone; two are refused, with stock models, too: LIGGGHTS ends in signal 11 there."""
        for model in MODELS:
            hybrid = lambda lines, file: re.sub(r"pair_style gran (.*)\npair_coeff \* \*", r"pair_style hybrid gran \1\npair_coeff * * gran", self.deck(model, lines, file))
            self.run_deck(self.deck(model, SPLIT.format(""), "alone.txt"))
            self.run_deck(hybrid(SPLIT.format("neigh_modify page 200000\ncompute n all coord/atom 0.0036"), "hybrid.txt"))
            assert self.apart("hybrid.txt", "alone.txt") < ROUNDING, model
        for model in (*MODELS, "hertz"):
            two = ("fix v1 all property/global characteristicVelocity scalar 2.0\npair_style hybrid gran \\1 gran model hooke tangential off\n"
                   "pair_coeff 1 1 gran 1\npair_coeff 2 2 gran 1\npair_coeff 1 2 gran 2")
            text = self.run_deck(re.sub(r"pair_style gran (.*)\npair_coeff \* \*", two, self.deck(model, "run 1\n", "two.txt")), expect_failure=True)
            assert "ERROR: pair_style hybrid: LIGGGHTS keeps the contact histories of one sub-style gran alone" in text

    def test_a_servo_lid_and_a_box_that_shrinks(self):
        """The lid is pressed on by a controller; the box shrinks (fix deform stands behind the first run, which makes the histories)."""
        controlled = f"mesh/surface/stress/servo file lid.stl type 2 com 0.0 0.0 {between.TOP!r} ctrlPV force axis 0.0 0.0 1.0 target_val -1000.0 vel_max 1.0 kp 5.0"
        shrink = "run 0\nfix shrink all deform 10 x vel -0.05 y vel -0.05 remap none\n"
        for first, old, new in (("", "mesh/surface file lid.stl type 2", controlled), (shrink, "boundary f f f", "boundary p p p")):
            for ranks in (1, 2):
                change = lambda lines, file: self.deck("mpm", first + lines, file).replace(old, new)
                self.run_deck(change(f"run {between.BEFORE + between.AFTER}\n", "whole.txt"), ranks=ranks)
                self.run_deck(change(SPLIT.format("neigh_modify page 200000\ncompute n all coord/atom 0.0036"), "split.txt"), ranks=ranks)
                assert self.apart("split.txt", "whole.txt") < ROUNDING, (new, ranks)

    def test_growth_and_change_of_type(self):
        """Radii that grow and types that change while spheres touch: the run that foresaw them and runs that begin on the way see one bed."""
        steps = between.BEFORE + between.AFTER
        grow = f"variable d equal {2 * between.RADIUS!r}*(1+0.004*step/{steps})\nfix grow all adapt 1 atom diameter v_d\n"
        cases = {"growth": (grow + f"run {steps}\n", grow + "run 60\nrun 60\nneigh_modify page 200000\nrun 130\n"),
                 "type": ("run 100\nset group low type 2\nrun 150\n", "run 100\nset group low type 2\nwrite_restart type.restart\nneigh_modify page 200000\nrun 70\nrun 80\n")}
        for name, (whole, split) in cases.items():
            for model in MODELS:
                self.run_deck(self.deck(model, whole, "whole.txt"))
                for ranks in (1,) if name == "growth" else (1, 2):  # other ranks learn of new radii when lists are made, with every model
                    self.run_deck(self.deck(model, split, "split.txt"), ranks=ranks)
                    assert self.apart("split.txt", "whole.txt") < ROUNDING, (name, model, ranks)

    def test_stock_models(self):
        """Decks of Hertz alone, and with walls of ours, keep their springs under liggghts-mpm as well."""
        rows = [row for row in between.rows() if row[1] in ("neigh_modify page 200000", "write_restart other.restart\nneigh_modify page 200000", "compute n all coord/atom 0.0036",
                                                            "delete_atoms group low compress yes")]
        assert len(rows) == 4
        split = SPLIT.format("")  # Hertz keeps the springs of contacts that part until the lists are made again, as a run does when it begins
        self.check("hertz", 1, rows, split, one_process=False)  # `clear` takes the launcher's classes away where no model of ours brings them back
        self.check("hertz", 1, rows, split, wall_model="mpm")

    @mark.parametrize("model", MODELS)
    def test_restart_on_the_way(self, model):
        """A file that a run writes on its way holds the histories of its step, not of the last rebuild of the lists."""
        self.run_deck(self.deck(model, f"restart {between.BEFORE} way.*.restart\nrun {between.BEFORE + between.AFTER}\n", "whole.txt"))
        self.run_deck(between.again(model, f"way.{between.BEFORE}.restart") + f"run {between.AFTER}\n" + between.state("rest.txt"))
        assert self.apart("rest.txt", "whole.txt") < ROUNDING, model

class TestThorough(Between):
    @mark.parametrize("model", MODELS)
    def test_every_command_on_two_ranks(self, model):
        self.check(model, 2, between.rows())

    def test_a_restart_file_after_every_command(self):
        rows = between.rows()
        for model in MODELS:
            for ranks in (1, 2):
                decks = [self.deck(model, SPLIT.format(f"{lines}\nwrite_restart {k}.restart"), f"{k}.txt") for k, (_, lines, _) in enumerate(rows)]
                self.run_deck("clear\n".join(decks), ranks=ranks)
                decks = [between.again(model, f"{k}.restart") + f"run {between.AFTER}\n" + between.state(f"{k}.rest.txt") for k in range(len(rows))]
                self.run_deck("clear\n".join(decks), ranks=3 - ranks)
                found = {lines: apart for k, (_, lines, _) in enumerate(rows) if not (apart := self.apart(f"{k}.txt", f"{k}.rest.txt", "compress_tags" in lines)) <= ROUNDING}
                assert found == {}, (model, ranks)
