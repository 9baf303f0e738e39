"""Superquadrics, with a LIGGGHTS that has them: GRANULAW_SUPERQUADRIC_LIGGGHTS names its source tree or install prefix
(docs/guide/own-liggghts.md). Builds the plug-in against it, then: a superquadric that is a sphere moves as the sphere does in the plug-in
at hand, an ellipsoid on its pole rebounds as the law of the local curvature says, tilted elastic ellipsoids move as under LIGGGHTS's
own Hertz, LIGGGHTS's tutorial runs, and what cannot work is refused."""
import math
import os
import pathlib
import re

from pytest import approx, fixture, mark, skip
from harness import POWDER, Deck, head, plane_stl, properties, worst
from programs import LAUNCHER, ROOT, material, particle, run, table

LIGGGHTS = os.environ.get("GRANULAW_SUPERQUADRIC_LIGGGHTS", "")
if not LIGGGHTS:
    skip("GRANULAW_SUPERQUADRIC_LIGGGHTS names no LIGGGHTS with superquadrics (docs/guide/own-liggghts.md)", allow_module_level=True)
BUILD = pathlib.Path(os.environ["GRANULAW_SUPERQUADRIC_BUILD"])
WITH_SHAPES = BUILD / "liggghts_plugin" / "liggghts-mpm"
TUTORIAL = pathlib.Path(LIGGGHTS) / "examples" / "LIGGGHTS" / "Tutorials_public" / "superquadric" / "in.particle_particle"
GAUSSIAN, MEAN = (f"{kind}Curvature yes curvatureLimitFactor 100" for kind in ("gaussian", "mean"))


@fixture(autouse=True, scope="module")
def plugin():
    run("cmake", "-S", ROOT, "-B", BUILD, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DGRANULAW_BUILD_TESTS=OFF", "-DGRANULAW_BUILD_BENCHMARKS=OFF",
        f"-DGRANULAW_LIGGGHTS_ROOT={LIGGGHTS}")
    run("cmake", "--build", BUILD, "--target", "liggghts-mpm", timeout=3000)


def mass(shape):
    return 4 / 3 * math.pi * math.prod(shape) * POWDER.density


class Impact:
    """A particle, half-axes `shape` (m), that falls on a wall at z = 0, or two that meet at the origin."""

    def __init__(self, shape, partner="wall", model="mpm", words="", wall_words="", curvature=GAUSSIAN, turn="", friction=0.0):
        self.shape, self.partner, self.model, self.words, self.wall_words = shape, partner, model, words, wall_words
        self.curvature, self.turn, self.friction = curvature, turn, friction
        self.surface, self.height, self.aside = "superquadric", shape[2], "0 0"
        # not over the edge between the mesh's triangles: there LIGGGHTS lets a superquadric touch both, each with the whole force
        self.place = "0.003 -0.002" if partner == "mesh" else "0 0"

    def deck(self, speed, dt, steps, every=1):
        shapes = self.surface == "superquadric"
        models = f"model {self.model} tangential history" + (f" surface {self.surface}" if shapes else "")
        curvature = self.curvature if shapes else ""
        text = head(half=0.02, skin=1e-3).replace("atom_style granular", f"atom_style {'superquadric' if shapes else 'granular'}")
        text += properties([POWDER], self.friction)
        if self.model == "hertz":
            text += "fix p9 all property/global coefficientRestitution peratomtypepair 1 1.0\n"
            curvature = self.curvature
        text += f"pair_style gran {models} {self.words} {curvature}\npair_coeff * *\n"
        z = self.height + 0.3 * dt * speed
        if self.partner == "wall":
            text += f"fix w all wall/gran {models} primitive type 1 zplane 0.0 {self.wall_words} {curvature}\n"
        if self.partner == "mesh":
            text += (f"fix m all mesh/surface file plane.stl type 1\n"
                     f"fix w all wall/gran {models} mesh n_meshes 1 meshes m {self.wall_words} {curvature}\n")
        text += f"create_atoms 1 single {self.place} {z!r} units box\n"
        if self.partner == "pair":
            text += f"create_atoms 1 single {self.aside} {-z!r} units box\nset atom 2 vz {speed}\n"
        text += f"set atom 1 vz {-speed}\n"
        if shapes:
            text += (f"set group all shape {' '.join(map(repr, self.shape))} blockiness 2 2\nset group all density {POWDER.density}\n"
                     + (f"set group all quat {self.turn}\n" if self.turn else ""))
        else:
            text += f"set group all diameter {2 * self.shape[0]!r} density {POWDER.density}\n"
        energies = f"compute r all erotate/{'superquadric' if shapes else 'sphere'}\ncompute k all ke\n"
        text += (f"fix i all nve/{'superquadric' if shapes else 'sphere'}\ntimestep {dt!r}\n{energies}"
                 "variable z equal z[1]\nvariable v equal vz[1]\nvariable f equal fz[1]\nvariable r equal c_r\nvariable k equal c_k\n"
                 f'fix out all print {every} "PATH $z $v $f $k $r"\nthermo {steps}\n'
                 f"thermo_style custom step c_k c_r\nrun {steps}\n")
        if self.model != "hertz":
            text += 'variable d equal f_granulaw[7]+f_granulaw[8]\nprint "DEPTH $d"\n'
        return text


class TestShapes(Deck):
    def path(self, impact, speed, dt, steps, every=1, launcher=WITH_SHAPES):
        (self.folder / "plane.stl").write_text(plane_stl())
        self.text = self.run_deck(impact.deck(speed, dt, steps, every), launcher=launcher)
        return self.results(self.text, "PATH")

    def words(self, model, material="powder"):
        return f"law {self.law} materials {material}" if model == "mpm" else ""

    def difference(self, one, other):
        """Largest differences of each column of two paths, over its largest value."""
        assert len(one) == len(other)
        return [worst(abs(a[c] - b[c]) for a, b in zip(one, other)) / max(1e-300, *(abs(a[c]) for a in one))
                for c in range(len(one[0]))]

    @mark.parametrize("turn", ("", "1 1 0 37"))
    @mark.parametrize("partner", ("wall", "mesh", "pair"))
    @mark.parametrize("model", ("mpm", "thornton"))
    def test_sphere(self, model, partner, turn):
        """Against the plug-in for spheres and its LIGGGHTS: the same path, velocity and force; measured 1e-13."""
        impact = Impact((2.5e-3,) * 3, partner, model, self.words(model), turn=turn)
        found = self.path(impact, 1.0, 2e-7, 400)
        impact.surface = "default"
        expected = self.path(impact, 1.0, 2e-7, 400, launcher=LAUNCHER)
        assert found[-1][1] > 0.5  # it did rebound
        for what, off in zip(("place", "velocity", "force"), self.difference(expected, found)):
            assert off < 1e-9, f"{model}, {partner}, turned '{turn}': {what}"

    @mark.parametrize("a, b, c", ((2e-3, 2e-3, 4e-3), (4e-3, 4e-3, 2e-3), (2e-3, 4e-3, 3e-3)))
    def test_pole_of_an_ellipsoid(self, a, b, c):
        """e and largest overlap are the replayed law's at R* of the pole, a b/c or 2/(c/a^2 + c/b^2)."""
        for curvature, radius in ((GAUSSIAN, a * b / c), (MEAN, 2 / (c / a**2 + c / b**2))):
            for partner, share in (("wall", 1.0), ("pair", 0.5)):
                other = "wall" if partner == "wall" else "powder"
                e, duration, deepest = self.fixture("mpm", self.law, "powder", other, share * radius, share * mass((a, b, c)), 1 / share)
                impact = Impact((a, b, c), partner, "mpm", self.words("mpm") + " elasticDamping off", curvature=curvature)
                path = self.path(impact, 1.0, duration / 400, 500)
                where = f"half-axes {a} {b} {c}, {curvature}, {partner}"
                assert path[-1][1] / e == approx(1, abs=2e-5), where  # measured 4e-6, 400 steps a contact
                assert self.result(self.text, "DEPTH")[0] * share * radius / deepest == approx(1, abs=2e-5), where

    def test_the_body_behind_the_contact(self):
        """Ellipsoids on their poles under `bodyCompliance on`: e is that of the law in series with the field between the radius of curvature
        and the half-axis. A sphere has no body behind it."""
        nu, (a, b, c) = POWDER.poisson_ratio, (2e-3, 2e-3, 4e-3)
        k = (3 - 2 * nu) / (2 * math.pi * (1 - nu)) / POWDER.e_star
        for partner, share in (("wall", 1.0), ("pair", 0.5)):
            other, radius = "wall" if partner == "wall" else "powder", a * b / c
            given = self.law, "powder", other, share * radius, share * mass((a, b, c)), 1 / share
            (without, duration, _), (e, *_) = (self.fixture("mpm", *given, behind / share) for behind in (0.0, k * (1 / radius - 1 / c)))
            assert abs(e - without) > 1e-3
            words = self.words("mpm") + " elasticDamping off bodyCompliance on"
            path = self.path(Impact((a, b, c), partner, "mpm", words), 1.0, duration / 400, 600)
            assert path[-1][1] == approx(e, abs=2e-4)  # the contact point lies in the middle of the first overlap
        paths = [self.path(Impact((a, a, a), "wall", "mpm", self.words("mpm") + f" bodyCompliance {word}"), 1.0, 2e-7, 400) for word in ("on", "off")]
        assert worst(self.difference(*paths)) < 1e-4

    @mark.parametrize("partner", ("wall", "mesh", "pair"))
    @mark.parametrize("friction", (0.0, 0.3))
    def test_tilted_against_stock_hertz(self, friction, partner):
        """Elastic and off the centre: force, torque and friction as LIGGGHTS's own Hertz gives them; measured 2e-7."""
        impact = Impact((2e-3, 3e-3, 4e-3), partner, "hertz", turn="1 2 0.5 31", friction=friction)
        if partner == "pair":
            impact.height, impact.aside = 2.65e-3, "0.0008 0.0007"
        expected = self.path(impact, 1.0, 1e-7, 16000, 5)
        impact.model = "mpm"
        impact.words = self.words("mpm", "elastic") + " elasticDamping off tangentialDampingRatio 0"
        impact.wall_words = "wall deformable"
        found = self.path(impact, 1.0, 1e-7, 16000, 5)
        assert max(row[4] for row in found) > 1e-3 * found[0][3]  # it turns
        for off in self.difference(expected, found):
            assert off < 1e-5, f"{partner}, friction {friction}"

    def test_tutorial(self):
        """LIGGGHTS's own deck (without its VTK dump), the models' names and words changed; on 2 ranks as on 1."""
        if not TUTORIAL.exists():
            skip(f"no {TUTORIAL}: {LIGGGHTS} is no source tree")
        law = table(material("soft", 2500, 1e7, 0.3, 1e5) + particle("grain", "soft", 2.5e-3))
        kept = [line for line in TUTORIAL.read_text().splitlines()
                if not line.startswith(("dump", "shell")) and "coefficientRestitution" not in line]
        curvature = "gaussianCurvature yes curvatureLimitFactor 10"
        for model, words in (("mpm", f"law {law} materials soft soft"), ("thornton", "")):
            text = "\n".join(kept).replace("model hertz", f"model {model}").replace("#Hertzian without cohesion", f"{words} {curvature}")
            text = re.sub(r"(primitive .*)", rf"\1 {curvature}", text).replace("cpu time", "f_granulaw")
            text = text.replace("pair_style", "fix y all property/global yieldStress peratomtype 1e5 1e5\npair_style", 1)
            for name, value in (("blockiness1", "4"), ("blockiness2", "4"), ("angle", "30")):
                text = text.replace(f"${{{name}}}", value)
            text += '\nvariable a equal f_granulaw\nvariable b equal f_granulaw[3]\nvariable c equal f_granulaw[4]\n'
            text += 'variable k equal c_kin_e+c_rke\nprint "END $b $c $a $k"\n'
            one, two = (self.result(self.run_deck(text, ranks=ranks, launcher=WITH_SHAPES), "END") for ranks in (1, 2))
            assert one[0] == 1.0, "the two particles meet once"
            assert one[2] > 0.0, "they yield"
            for a, b in zip(one, two):
                assert b / a == approx(1.0, abs=1e-6), model

    def test_refusals(self):
        sphere = (2.5e-3,) * 3

        def refused(sentence, deck, **more):
            assert sentence in self.run_deck(deck, expect_failure=True, launcher=WITH_SHAPES, **more)

        for curvature in ("", "curvatureLimitFactor 10", "meanCurvature yes", "gaussianCurvature no curvatureLimitFactor 10",
                          "meanCurvature yes gaussianCurvature yes curvatureLimitFactor 10", "meanCurvature yes curvatureLimitFactor 0"):
            refused("needs the local curvature", Impact(sphere, words=self.words("mpm"), curvature=curvature).deck(1.0, 1e-7, 1))
        deck = Impact(sphere, words=self.words("mpm")).deck(1.0, 1e-7, 1)
        refused("fix w wall/gran model mpm: 'surface superquadric' needs the local curvature",
                deck.replace(f"zplane 0.0  {GAUSSIAN}", "zplane 0.0"))
        refused("'energy on' is for spheres", deck.replace("materials powder", "materials powder energy on"))
        refused("with cohesion off also superquadric", deck.replace("tangential history", "tangential history cohesion sjkr"))
        refused("atom_style superquadric needs 'surface superquadric'",
                deck.replace(" surface superquadric", "").replace(GAUSSIAN, ""))
        refused("needs atom_style superquadric", re.sub("atom_style superquadric", "atom_style granular", deck))
        self.fixture("write", self.law, "rate", sphere[0])
        refused("superquadrics have another at each point", deck)

    def test_other_library(self):
        """Each plug-in refuses the other LIGGGHTS, loaded before its own."""
        def library(launcher):
            return re.search(r"libliggghts\S* => (\S+)", run("ldd", launcher).stdout)[1]

        impact = Impact((2.5e-3,) * 3, model="thornton")
        impact.surface = "default"
        deck = impact.deck(1.0, 1e-7, 1)
        for launcher, other, sentence in ((LAUNCHER, WITH_SHAPES, "this LIGGGHTS was built with superquadrics"),
                                          (WITH_SHAPES, LAUNCHER, "this LIGGGHTS was built without superquadrics")):
            assert sentence in self.run_deck(deck, expect_failure=True, launcher=launcher, environment={"LD_PRELOAD": library(other)})
