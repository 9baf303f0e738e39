"""granulaw.h, called from programs in C: against `mpm law`, and against the plug-in to the last bit."""
import math
import os
import random
import re

from pytest import approx, mark
from harness import GLASS, POWDER, Deck, Material, head, mpm_law, properties, sphere_mass, worst
from programs import run

granulaw = __import__("granulaw") if os.environ.get("GRANULAW_MODULE") else None
COLLIDE, FORCES = (os.environ[k] for k in ("GRANULAW_COLLIDE", "GRANULAW_CONTACT_FORCES"))
RADIUS = 1.7e-3
RIGID = Material("rigid", 1500.0, 1e30, 0.3, 1e30)
LEGS = (0.7, -0.4, -2.0), (-0.9, 0.2, 1.5), (0.01, 0.02, -1.9), (0.3, 0.1, 0.8), (0.1, 0.3, 2.0)


class TestCInterface(Deck):
    def call(self, program, *words, given="", expect_failure=False):
        done = run(program, *words, input=given, code=1 if expect_failure else 0)
        return done.stderr if expect_failure else done.stdout

    def test_collisions_are_those_of_mpm_law(self):
        """A law without and with a velocity axis, and one with waves; loading, unloading, X and waves are all in e."""
        for kind in ("plain", "axis", "composed"):
            law = self.folder / f"{kind}.h5"
            self.fixture("write", law, *([] if kind == "plain" else [kind]))
            for pair, radius, partner, speed in (("powder:wall", RADIUS, math.inf, 0.02), ("powder:wall", RADIUS, math.inf, 5.0),
                                                 ("powder:powder", RADIUS, 0.6e-3, 3.0), ("powder:glass", RADIUS, 1.1e-3, 3.0), ("powder:glass", RADIUS, math.inf, 3.0)):
                if kind != "composed" and pair == "powder:glass" and partner == math.inf:
                    continue  # of composed laws alone a wall is another body than a sphere
                a, b = pair.split(":")
                expected = mpm_law(law, pair, speed, radius, None if b == "wall" else partner)
                # as law_fixture has it, the glass of the composed law is heavier
                density = {"powder": POWDER.density, "glass": GLASS.density * (60 if kind == "composed" else 1)}
                mass = sphere_mass(radius, density[a])
                if math.isfinite(partner):
                    other = sphere_mass(partner, density[b])
                    mass = mass * other / (mass + other)
                found = {name: float(value) for name, value in map(str.split, self.call(COLLIDE, law, a, b, radius, partner, repr(mass), speed).splitlines())}
                # mpm law prints ten digits
                for key, name in (("e", "e"), ("force_max", "force_max_N"), ("delta_max", "delta_max_m")):
                    assert found[key] / expected[name] == approx(1.0, abs=1e-9), f"{kind} {pair} {speed} {key}"
                # rounding of ten digits; with an axis the table of work, between levels as good as Curve::least_loss
                assert found["plastic"] + found["waves"] == approx(1 - found["e"]**2, abs=(1e-9 if kind == "plain" else 2e-4))
                assert (found["waves"] > 0) == (kind == "composed" and pair == "powder:glass" and partner == math.inf)

    def led(self, tangential, spin=(0.0, 0.0), velocities=LEGS):
        """A sphere that turns is led into a wall, back and in again, sideways: force and torque on it by granulaw.h, and by LIGGGHTS."""
        dt, friction, damping = 1e-6, 0.4, 0.3
        # tangential plastic has the wall's stiffness from its material: rigid by a modulus that no sum keeps
        materials, rigid = ("powder powder", [POWDER, POWDER]) if tangential == "history" else ("powder rigid", [POWDER, RIGID])
        words = f"law {self.law} materials {materials} elasticDamping off tangentialDampingRatio {damping} beyondRange continue"
        moves = "".join(f"fix m all move linear {' '.join(map(repr, v))} units box\nrun 17\nunfix m\n" for v in velocities)
        self.run_deck(head(types=2, half=20 * RADIUS) + properties(rigid, friction) +
                      f"pair_style gran model mpm tangential {tangential} {words}\npair_coeff * *\n"
                      f"fix w all wall/gran model mpm tangential {tangential} primitive type 2 zplane 0.0\n"
                      f"create_atoms 1 single 0 0 {1.0003 * RADIUS!r} units box\nset group all diameter {2 * RADIUS!r} density {POWDER.density}\n"
                      f"set group all omegax {spin[0]!r} omegay {spin[1]!r}\n"
                      f"timestep {dt!r}\ndump d all custom 1 forces.txt mass radius z fx fy fz tqx tqy tqz\n"
                      'dump_modify d format "%.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g"\n' + moves)
        frames = (self.folder / "forces.txt").read_text().split("ITEM: TIMESTEP\n")[1:]
        rows = {int(f.split("\n")[0]): [float(w) for w in f.strip().split("\n")[-1].split()] for f in frames}
        compliance = 2.0 * (2.0 - POWDER.poisson_ratio) * (1.0 + POWDER.poisson_ratio) / POWDER.youngs_modulus
        stiffness = 8.0 / (compliance + compliance) if tangential == "history" else 8.0 / compliance
        given, levers, expected = "", [], []
        for step, (mass, radius, z, *force) in sorted(rows.items()):
            if step == 0:
                continue
            vx, vy, vz = velocities[(step - 1) // 17]
            nz = z * (1.0 / z)  # LIGGGHTS's normal is off one by rounding
            vn, overlap = vz * nz, radius - z
            lever = radius - overlap if tangential == "plastic" else radius - 0.5 * overlap
            turn = spin[1] * nz, -spin[0] * nz  # spin x n
            slide = vx - lever * turn[0], vy - lever * turn[1], vz - vn * nz
            given += " ".join(repr(w) for w in (radius, math.inf, mass, overlap, -vn, dt, 0, 0, nz, *slide, *turn, 0.0)) + "\n"
            levers.append((lever, nz))
            expected.append(force)
        said = self.call(FORCES, self.law, "powder", "wall", friction, repr(stiffness), damping, tangential, given=given)
        self.compare_python(tangential, friction, stiffness, damping, given, said)
        found, couples = [], []
        for (lever, nz), line in zip(levers, said.splitlines()):
            normal, x, y, z, *couple = map(float, line.split())
            couples.append(abs(couple[0]))
            # torque of a force at -lever n: -lever n x F
            found.append([x, y, normal * nz + z, couple[0] + lever * nz * y, couple[1] - lever * nz * x, couple[2]])
        assert len(found) == 17 * len(velocities)
        assert sum(f[2] > 0 for f in found) > 30
        assert sum(abs(f[0]) > 0 for f in found) > 30
        assert (sum(c > 0 for c in couples) > 30) == (tangential == "plastic")
        return found, expected

    def compare_python(self, tangential, friction, stiffness, damping, given, said):
        """The same history by the module, where it is built: to the bit."""
        if not granulaw:
            return
        contact = granulaw.read(self.law).contact("powder:wall", friction=friction, tangential=tangential, shear_stiffness=stiffness, shear_damping=damping, elastic_damping=0)
        m, history = contact.motion(1), contact.history(1)
        for line, by_c in zip(given.splitlines(), said.splitlines()):
            values = [float(w) for w in line.split()]
            for name, value in zip(("radius_a", "radius_b", "m_eff", "overlap", "approach", "dt"), values):
                m[name] = value
            m["normal"], m["slide"], m["rolling"] = values[6:9], values[9:12], values[12:15]
            now = contact.advance(m, history)[0]
            assert [now["normal"], *now["shear"], *now["couple"]] == [float(w) for w in by_c.split()]

    @mark.parametrize("tangential", ("history", "plastic"))
    def test_forces_are_those_of_the_plugin(self, tangential):
        found, expected = self.led(tangential)
        assert [f[:3] for f in found] == [f[:3] for f in expected]

    def compare(self, found, expected):
        """The lever, by which spin slides the surface, is rounded in another order: 4e-16 of the largest."""
        for k in range(6):
            unit = max(abs(f[k]) for f in expected) or 1.0
            assert worst(abs(f[k] - g[k]) / unit for f, g in zip(found, expected)) < 1e-12, k

    @mark.parametrize("tangential", ("history", "plastic"))
    def test_forces_and_couples_of_a_sphere_that_turns_are_those_of_the_plugin(self, tangential):
        self.compare(*self.led(tangential, spin=(300.0, -500.0)))

    @mark.parametrize("tangential", ("history", "plastic"))
    def test_a_random_history_is_that_of_the_plugin(self, tangential):
        """Forty times in or out, up to 0.1 R, at random speeds along all axes."""
        draw = random.Random(70)
        z, legs = 0.0003 * RADIUS, []
        for k in range(40):
            deep = RADIUS * (draw.uniform(0.0, 0.02) if k % 2 else draw.uniform(0.02, 0.1))  # the overlap at the leg's end
            legs.append((draw.gauss(0, 0.5), draw.gauss(0, 0.5), (-deep - z) / 17e-6))
            z = -deep
        self.compare(*self.led(tangential, spin=(draw.gauss(0, 300), draw.gauss(0, 300)), velocities=legs))

    def test_what_cannot_be_used_is_one_sentence(self):
        for words, said in ((("no.h5", "powder", "wall"), "no.h5"), ((self.law, "powder", "clay"), "clay"), ((self.law, "mud", "wall"), "mud")):
            text = self.call(COLLIDE, *words, RADIUS, math.inf, 1e-6, 1.0, expect_failure=True)
            assert re.search(rf"^collide: .*{said}.*\n$", text)
        text = self.call(COLLIDE, self.law, "powder", "powder", RADIUS, -1.0, 1e-6, 1.0, expect_failure=True)
        assert text == "collide: granulaw_contact: radius_a and radius_b: both over 0, radius_b infinity for a wall, or both 0\n"
