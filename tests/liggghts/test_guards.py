"""Decks that LIGGGHTS accepts and that would go wrong without a word: refused in one sentence, or right."""
import pathlib
import re

from pytest import approx, mark
from collisions import pair_deck, wall_deck
from harness import POWDER, Deck, head, plane_stl, properties

RADIUS = 1.7e-3
DT = 2e-7
MODELS = ("mpm", "thornton")


class TestGuards(Deck):
    def words(self, model, more=""):
        return (f"law {self.law} materials powder " if model == "mpm" else "") + more

    def deck(self, model, more="", **keywords):
        return wall_deck(model, self.words(model, more), POWDER, RADIUS, 1.0, DT, **keywords)

    def test_pages_of_one_particle(self):
        """A page as short as LIGGGHTS allows, ten numbers for each of `one` neighbours, holds histories of more values than that, with a wall of each kind."""
        small = "neigh_modify delay 0 one 5000 page 50000"
        mesh = {"wall": "mesh n_meshes 1 meshes cad", "before_wall": "fix cad all mesh/surface file plane.stl type 1\n"}
        (self.folder / "plane.stl").write_text(plane_stl())
        decks = [self.deck(model, more, tangential=tangential, **wall) for model in MODELS for wall in ({}, mesh)
                 for more, tangential in (("energy on contactMap on", "history"), ("", "history rolling_friction epsd2"))]
        assert self.run_each((deck.replace("neigh_modify delay 0", small) for deck in decks), "SPEED") == self.run_each(decks, "SPEED")

    @mark.parametrize("model", MODELS)
    def test_multi(self, model):
        deck = self.deck(model)
        line = next(l for l in deck.splitlines() if l.startswith("neighbor "))
        self.refused(deck.replace(line, line.replace("bin", "multi")), "'neighbor ... multi' lets spheres of unlike size")

    @mark.parametrize("model", MODELS)
    def test_respa(self, model):
        """Pairs work at every level; walls and energies do not: LIGGGHTS calls no wall there, not stock Hertz's either."""
        pair = lambda more="", style="": pair_deck(model, self.words(model, more), (POWDER, POWDER), (RADIUS, RADIUS), 1.0,
                                                   DT).replace("timestep", f"{style}\ntimestep")
        plain, *levels = (self.result(self.run_deck(pair(style=style)), "SPEED")[0]
                          for style in ("", "run_style respa 1", "run_style respa 2 2 pair 2", "run_style respa 2 2 pair 1"))
        for e, delta in zip(levels, (1e-12, 1e-12, 1e-3)):  # the last has half the step: its own error in e
            assert e / plain == approx(1.0, abs=delta)
        self.refused(self.deck(model).replace("timestep", "run_style respa 1\ntimestep"), "does not call fix wall/gran")
        self.refused(pair("energy on", "run_style respa 1"), "run_style verlet")

    @mark.parametrize("model", MODELS)
    def test_wall_before_the_pair_style(self, model):
        """A wall that stands first cannot take what the pair style says later."""
        for more in ("energy on", "contactMap on", "stretch 3", "elasticDamping 0.1"):
            deck = self.deck(model, more)
            wall = next(l for l in deck.splitlines() if l.startswith("fix w "))
            first = deck.replace(wall + "\n", "").replace("pair_style", wall + " " + self.words(model) + "\npair_style")
            self.refused(first, "put it behind")
        deck = self.deck(model)
        wall = next(l for l in deck.splitlines() if l.startswith("fix w "))
        first = deck.replace(wall + "\n", "").replace("pair_style", wall + " " + self.words(model) + "\npair_style")
        if model == "thornton":  # has nothing to take
            assert self.result(self.run_deck(first), "SPEED") == self.result(self.run_deck(deck), "SPEED")

    @mark.parametrize("model", MODELS)
    def test_pair_style_again_with_other_words(self, model):
        deck = self.deck(model)
        again = f"pair_style gran model {model} tangential history {self.words(model, 'stretch 3')}\npair_coeff * *\ntimestep"
        self.refused(deck.replace("timestep", again), "put it behind")

    @mark.parametrize("model", MODELS)
    def test_two_spheres_at_one_place(self, model):
        place = "0.001 0.002 0.003"
        deck = (head(half=20 * RADIUS) + properties([POWDER]) +
                f"pair_style gran model {model} tangential history {self.words(model)}\npair_coeff * *\n" +
                f"create_atoms 1 single {place} units box\n" * 2 +
                f"set group all diameter {2 * RADIUS!r} density {POWDER.density}\nfix i all nve/sphere\ntimestep {DT}\nrun 1\n")
        text = self.run_deck(deck, expect_failure=True)
        assert "particles 1 and 2 are at one place (0.001, 0.002, 0.003)" in text
        assert "nan" not in text.lower()

    def test_axis_of_a_cylinder(self):
        """On the axis of a narrow pipe a sphere touches nothing, whatever LIGGGHTS calls it; later it hits the wall as any other."""
        big = 1.6 * RADIUS
        for model in MODELS:
            found = []
            for x in (0.0, 1e-3 * RADIUS):
                deck = (head(half=20 * RADIUS) + properties([POWDER]) +
                        f"pair_style gran model {model} tangential history {self.words(model)}\npair_coeff * *\n"
                        f"fix w all wall/gran model {model} tangential history primitive type 1 zcylinder {big!r} 0.0 0.0\n"
                        f"create_atoms 1 single {x!r} 0.0 0.0 units box\nset group all diameter {2 * RADIUS!r} density {POWDER.density}\n"
                        f"fix i all nve/sphere\ntimestep {DT}\nvariable v equal vcm(all,x)\nrun 10\n"
                        "velocity all set 3.0 0.0 0.0\n" f"run {int(0.9 * RADIUS / 3.0 / DT)}\n"
                        'print "SPEED ${v}"\n')
                found.append(self.result(self.run_deck(deck), "SPEED")[0])
            assert found[0] < -1.0
            # the phase of the step at first touch differs: its error in e, 1e-3 at 25 steps a contact
            assert found[0] / found[1] == approx(1.0, abs=5e-3)

    def again(self, deck, first="fix p1"):
        """The words of `deck` behind read_restart r.bin."""
        return head(read="read_restart r.bin", skin=RADIUS / 2) + deck[deck.index(first):deck.index("create_atoms")] + f"fix i all nve/sphere\ntimestep {DT!r}\nrun 10\n"

    @mark.parametrize("model", MODELS)
    def test_restart_of_another_combination(self, model):
        """Histories of as many values are not those of another model."""
        viscous = "fix p6 all property/global coefficientRollingViscousDamping peratomtypepair 1 0.1\nfix p1"
        base = self.deck(model).replace("run 120", "run 20").replace("fix p1", viscous)
        write = base.replace("history ", "history rolling_friction epsd2 ") + "write_restart r.bin\n"
        self.run_deck(write)
        read = self.again(write, "fix p6")
        self.run_deck(read)
        other = read.replace("rolling_friction epsd2", "rolling_friction epsd")
        self.refused(other, "written with other models", "rolling_friction epsd2", "found model mpm tangential history rolling_friction epsd,".replace("mpm", model))

    @mark.parametrize("model", MODELS)
    def test_restart_into_every_changed_keyword(self, model):
        """Every keyword, said otherwise behind read_restart: one that gives the histories another meaning is refused, any other goes on.
        A keyword that is new stands in neither list: the test asks where it belongs."""
        meaning = {"stretch": "3", "tangentialStiffness": "computed", "wall": "deformable"}
        sizes = {"energy": "on", "contactMap": "on", "computeDissipatedEnergy": "on", "bodyCompliance": "on"}  # values of their own: another number of them
        free = {"tangentialDampingRatio": "0.5", "elasticDamping": "0.2", "heatArea": "law", "stats": "s.json", "beyondRange": "continue", "waves": "off", "law": None,
                "materials": None, "tangential_damping": "off", "limitForce": "on", "heating_tracking": "off", "heating_tangential_history": "off"}
        # in test_confinement.py; refused anyway; of other tangential and rolling models; of superquadrics
        foreign = {"confinement", "computeElasticPotential", "heating_tangential_no_history", "tangential_reduce", "torsionTorque", "meanCurvature", "gaussianCurvature", "curvatureLimitFactor"}
        sources = pathlib.Path(__file__).resolve().parents[2] / "liggghts_plugin"
        said = {word for name in ("deck/keywords.hpp", "contact/mpm_physics.hpp") for word in re.findall(r'Keyword(?: beyond_range)?\{\.name = "(\w+)"', (sources / name).read_text())}
        assert said - foreign == meaning.keys() | sizes.keys() | free.keys()
        other = self.folder / "other.h5"
        self.fixture("write", other, "depth", 0.8)
        base = self.deck(model).replace("run 120", "run 20")
        self.run_deck(base + "write_restart r.bin\n")
        read = self.again(base)
        say = lambda key, value: read.replace("\npair_coeff", f" {key} {value}\npair_coeff") if key != "wall" else read.replace("zplane 0.0 ", f"zplane 0.0 wall {value} ")
        for key, value in meaning.items():
            self.refused(say(key, value), "written with other models or words", f"{key} {value}")
        for key, value in sizes.items():
            self.refused(say(key, value), "another number of values for each contact")
        own = () if model == "mpm" else ("law", "materials", "beyondRange", "waves")
        decks = [read, *(say(key, value) for key, value in free.items() if value and key not in own)]
        self.run_deck("clear\n".join(decks + ([read.replace(str(self.law), str(other))] if model == "mpm" else [])))
        for key in ("stretch", "tangentialStiffness"):  # and back: said before, not said behind
            said = f"{key} {meaning[key]}"
            base = self.deck(model, said).replace("run 120", "run 20")
            self.run_deck(base + "write_restart r.bin\n")
            self.refused(self.again(base).replace(said, ""), "written with other models or words", said)

    def test_messages_have_numbers(self):
        """Two at rest that overlap beyond the law do not stop a run; a folder in the place of a law is named."""
        for model in MODELS:
            more = "stretch 300" if model == "thornton" else ""
            text = pair_deck(model, self.words(model, more), (POWDER, POWDER), (RADIUS, RADIUS), 1.0, DT)
            places = [line for line in text.splitlines() if line.startswith("create_atoms")]
            for sign, place in zip((-1, 1), places):
                text = text.replace(place, f"create_atoms 1 single {sign * 0.6 * RADIUS!r} 0 0 units box")
            assert "began deeper than the motion of a step" in self.run_deck(re.sub("velocity .*", "", text))  # no motion, no stop
        text = self.run_deck(self.deck("mpm").replace(str(self.law), str(self.folder)), expect_failure=True)
        assert f"{self.folder}: cannot be read as a file" in text

    def test_other_allocators(self):
        """jemalloc and tcmalloc round sizes up in their own way."""
        libraries = pathlib.Path("/usr/lib/x86_64-linux-gnu")
        found = [libraries / name for name in ("libjemalloc.so.2", "libtcmalloc_minimal.so.4") if (libraries / name).exists()]
        assert found, "tools/setup installs libjemalloc2"
        deck = self.deck("mpm")
        expected = self.result(self.run_deck(deck), "SPEED")
        for library in found:
            assert self.result(self.run_deck(deck, environment={"LD_PRELOAD": str(library)}), "SPEED") == expected


class TestGapDamping(Deck):
    @mark.parametrize("model", MODELS)
    def test_no_force_below_the_residual_overlap(self, model):
        """`elasticDamping` works where the law carries force: not in the gap of a dent, neither on the way out nor in."""
        law = f"law {self.law} materials powder " if model == "mpm" else ""
        # down, up until the force is gone, and back in within the same overlap, without friction and with
        deck = (head(half=20 * RADIUS) + properties([POWDER], 0.5) +
                f"pair_style gran model {model} tangential history {law}elasticDamping 0.2\npair_coeff * *\n"
                f"fix w all wall/gran model {model} tangential history primitive type 1 zplane 0.0\n"
                f"create_atoms 1 single 0.0 0.0 {RADIUS!r} units box\nset group all diameter {2 * RADIUS!r} density {POWDER.density}\n"
                f"timestep {DT!r}\nfix m all move linear 0.0 0.0 -1.0\nvariable f equal fcm(all,z)\nvariable z equal xcm(all,z)\n"
                "thermo_style custom step\nrun 200\n"   # 40 um down: 2 % of R, far beyond yield
                "unfix m\nfix m all move linear 0.0 0.0 1.0\nrun 180\n")  # 4 um below the first touch
        deck += ('print "OUT ${z} ${f}"\nunfix m\nfix m all move linear 1.0 0.0 -1.0\nrun 5\nvariable t equal fcm(all,x)\n'
                 'print "IN ${z} ${f} ${t}"\n')
        text = self.run_deck(deck)
        z, force = self.result(text, "OUT")
        assert z < RADIUS  # they overlap still
        assert force == 0.0, model
        z, force, friction = self.result(text, "IN")
        assert z < RADIUS
        assert (force, friction) == (0.0, 0.0), model
