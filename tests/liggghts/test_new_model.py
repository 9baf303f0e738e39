"""A model made as docs/guide/new-contact-model.md says, of two files and a line (plain_hertz): against stock Hertz, and what a user sees."""
import os
import re

from pytest import approx, mark
from collisions import pair_deck, wall_deck
from harness import GLASS, POWDER, Deck, head, properties, sphere_mass
from programs import ROOT, run

RADIUS, SPEED, DT = 1.7e-3, 1.0, 2e-7
STEPS = 40  # within the contact, which takes 50 to 60 steps
PLAIN = {"LD_PRELOAD": os.environ["GRANULAW_PLAIN_HERTZ"]}
WORDS = "elasticDamping off tangentialDampingRatio 0"


class TestNewModel(Deck):
    def pair(self, model, words, materials=(POWDER, POWDER), radii=(RADIUS, RADIUS), run="run 120"):
        deck = pair_deck(model, words, materials, radii, SPEED, DT, run=run)
        if model == "hertz":  # elastic
            n = 1 if materials[0] is materials[1] else 2
            deck = deck.replace("fix p1", f"fix p6 all property/global coefficientRestitution peratomtypepair {n} {'1.0 ' * n * n}\nfix p1")
        return deck

    def speed(self, deck):
        return self.result(self.run_deck(deck, launcher="liggghts", environment=PLAIN), "SPEED")[0]

    @mark.parametrize("materials, radii", (((POWDER, POWDER), (RADIUS, RADIUS)), ((POWDER, GLASS), (RADIUS, 2 * RADIUS))))
    def test_two_spheres_collide_as_under_stock_hertz(self, materials, radii):
        """In the middle of the collision and behind it, of like and of unlike spheres; to rounding, summed over the steps."""
        for run in (f"run {STEPS}", "run 120"):
            stock = self.speed(self.pair("hertz", "tangential_damping off", materials, radii, run))
            ours = self.speed(self.pair("plain_hertz", WORDS, materials, radii, run))
            assert ours == approx(stock, abs=1e-9 * SPEED)
        assert ours / SPEED == approx(1.0, abs=1e-3)  # elastic; the deck's 120 steps hold the whole collision

    @mark.parametrize("rolling", ("", " rolling_friction epsd2"))
    def test_a_tangential_law_of_ours(self, rolling):
        """Spring in LIGGGHTS's place: spheres that meet beside their centres and spin, on a floor too, with a rolling model; to the last bit."""
        ends = []
        for tangential in ("history", "own_spring"):
            style = f"model plain_hertz tangential {tangential}{rolling}"
            words = "elasticDamping off tangentialDampingRatio 0.2"
            deck = (head(half=20 * RADIUS) + properties([POWDER], 0.3) + f"pair_style gran {style} {words}\npair_coeff * *\n"
                    f"fix w all wall/gran {style} primitive type 1 zplane 0.0 {words}\n"
                    f"create_atoms 1 single 0 0 {1.0005 * RADIUS!r} units box\ncreate_atoms 1 single {1.2 * RADIUS!r} {0.4 * RADIUS!r} {2.5543 * RADIUS!r} units box\n"
                    f"set group all diameter {2 * RADIUS!r} density {POWDER.density}\nset atom 1 vx 0.4 vy -0.2 vz -1.0\nset atom 2 vx -1.0 vy 0.7 vz -1.5\n"
                    f"fix i all nve/sphere\ntimestep {DT!r}\nrun 30\nrun 300\n" +
                    "".join(f"variable {q}{k} equal {q[:-1]}{q[-1]}[{k}]\n" for q in ("vx", "vy", "vz") for k in (1, 2)) +
                    "compute spin all erotate/sphere\nthermo_style custom step c_spin\nvariable s equal c_spin\nrun 0\n"
                    'print "END ' + " ".join(f"$(v_{q}{k})" for q in ("vx", "vy", "vz") for k in (1, 2)) + ' $(v_s)"\n')
            text = self.run_deck(deck, launcher="liggghts", environment=PLAIN)
            ends.append(text[text.index("END "):].split("\n")[0])
        assert ends[0] == ends[1]
        assert float(ends[0].split()[-1]) > 0

    @mark.parametrize("ranks", (1, 2))
    def test_a_piece_beside_the_laws(self, ranks):
        """It pulls behind the contact, too, and takes its force times its reach: of two spheres across the boundary of ranks, and at a wall."""
        force, charge, mass, gap = 0.02, 1.5, sphere_mass(RADIUS, POWDER.density), 0.1
        models = "model plain_hertz tangential history cohesion pull"
        for wall in (False, True):
            r_eff, m_eff = (RADIUS, mass) if wall else (RADIUS / 2, mass / 2)
            work = force * (charge if wall else charge**2) * gap * r_eff
            y = (RADIUS,) if wall else (RADIUS, -RADIUS)
            deck = (head(half=20 * RADIUS) + properties([POWDER]) + f"fix pull all property/global pullForce peratomtypepair 1 {force}\n"
                    f"pair_style gran {models} {WORDS}\npair_coeff * *\n" + wall * f"fix w all wall/gran {models} primitive type 1 yplane 0.0 {WORDS}\n" +
                    "".join(f"create_atoms 1 single 0 {1.0001 * at!r} 0 units box\n" for at in y) +
                    f"set group all diameter {2 * RADIUS!r} density {POWDER.density}\n"
                    f"set atom 1 vy {-SPEED!r}\nfix i all nve/sphere\ntimestep {DT / 4!r}\n" +
                    f'run 0\nset group all property/atom charge {charge} 0\nrun 6000\n' + 'variable s equal ' + ("vcm(all,y)" if wall else "vcm(a1,y)-vcm(a2,y)") + '\nprint "SPEED ${s}"\n')
            deck = deck.replace("fix i all", "group a1 id 1\n" + "group a2 id 2\n" * (not wall) + "fix i all")
            found = self.result(self.run_deck(deck, launcher="liggghts", environment=PLAIN, ranks=ranks), "SPEED")[0]
            # a step's motion is 1e-3 of the reach
            assert 0.5 * m_eff * (SPEED**2 - found**2) == approx(work, rel=5e-3)
            assert 0.01 < work / (0.5 * m_eff * SPEED**2) < 0.5

    def test_its_own_keyword(self):
        stiff = type(POWDER)("powder", POWDER.density, 4 * POWDER.youngs_modulus, POWDER.poisson_ratio, POWDER.yield_stress)
        expected = self.speed(self.pair("plain_hertz", WORDS, (stiff, stiff), run=f"run {STEPS}"))
        found = self.speed(self.pair("plain_hertz", WORDS + " modulusFactor 4", run=f"run {STEPS}"))
        assert found == approx(expected, abs=1e-9 * SPEED)

    def test_a_wall_takes_the_keyword_from_the_pair_style(self):
        deck = wall_deck("plain_hertz", WORDS + " modulusFactor 4", POWDER, RADIUS, SPEED, DT)
        again = wall_deck("plain_hertz", WORDS + " modulusFactor 4", POWDER, RADIUS, SPEED, DT, wall_words="modulusFactor 4")
        assert self.speed(deck) == self.speed(again)
        assert self.speed(deck) != self.speed(wall_deck("plain_hertz", WORDS, POWDER, RADIUS, SPEED, DT))

    def refused(self, deck, *parts):
        text = self.run_deck(deck, launcher="liggghts", environment=PLAIN, expect_failure=True)
        for part in parts:
            assert part in text

    def test_refusals(self):
        self.refused(self.pair("plain_hertz", "modulusFacto 4"), "pair_style gran model plain_hertz", "unknown keyword 'modulusFacto'",
                     "did you mean 'modulusFactor'")
        self.refused(self.pair("plain_hertz", "modulusFactor 40"), "'modulusFactor' is out of range", "0.1 to 10")
        self.refused(self.pair("plain_hertz", "law x.h5"), "unknown keyword 'law'")

    def test_other_combinations_are_refused(self):
        deck = self.pair("plain_hertz", "").replace("tangential history", "tangential tan_luding")
        self.refused(deck, "models plain_hertz are built for tangential off, history, no_history; cohesion off, sjkr")

    def test_statistics(self):
        text = self.run_deck(self.pair("plain_hertz", WORDS), launcher="liggghts", environment=PLAIN)
        assert "plain_hertz; none: elastic" in text
        assert re.search(r"(?m)^  contacts begun +1 +0$", text)


class TestConcept:
    def test_the_law_in_80_lines(self, tmp_path):
        """The page's program: e is sqrt(k1/k2), and what is booked is lost."""
        code = re.search(r"```cpp\n(.*?)```", (ROOT / "docs" / "guide" / "law-in-80-lines.md").read_text(), re.S)[1]
        assert len(code.splitlines()) <= 80
        run("c++", "-std=c++20", "-O2", "-Wall", "-Wextra", "-Werror", "-x", "c++", f"-I{ROOT / 'mpm_core'}", "-o", tmp_path / "law", "-", input=code)
        e, expected, lost, booked = (float(w) for w in re.findall(r"[\d.e-]*\d", run(tmp_path / "law").stdout.replace("k1", "").replace("k2", "")))
        assert (e, booked) == (expected, lost) == (0.5, approx(3.75e-6, rel=1e-3))

    def test_a_missing_member_is_named(self):
        """A model that lacks something does not compile, and the compiler says what."""
        source = (ROOT / "tests" / "liggghts" / "plain_hertz" / "plain_hertz_physics.hpp").read_text()
        for member, without in (("law.stiffness(", source.replace("double stiffness(", "double rigidity(")),
                                ("prepared.describe(", source.replace("PairInfo describe(", "PairInfo explain(")),
                                ("Physics::id", source.replace("id = 44", "id = 9"))):
            done = run("c++", "-std=c++20", "-fsyntax-only", "-x", "c++", f"-I{ROOT}", f"-I{ROOT / 'mpm_core'}", "-", input=without.replace("#pragma once", ""), code=None)
            assert "static assertion failed" in done.stderr
            assert member in done.stderr
