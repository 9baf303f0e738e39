"""Drop tests at 50 velocities in one LIGGGHTS run, wall and pair alike, against `mpm law` (the tool's own integration)."""
import math

from pytest import mark
from harness import POWDER, head, mpm_law, properties, worst
from trials import Trial, dump

COUNT = 50
TOLERANCE = 0.005  # required, on e
RADIUS = 1.7e-3
SLOWEST, FASTEST = 0.03, 12.0  # m/s: from below the onset of yield (e = 1) to 7 % of R of overlap, the table's range
STEPS = 50         # time steps in the shortest contact
SPEEDS = [SLOWEST * (FASTEST / SLOWEST)**(k / (COUNT - 1)) for k in range(COUNT)]


class TestDrop(Trial):
    @mark.parametrize("kind, partner", (("wall", "wall"), ("pair", "powder")))
    def test_wall_and_pair(self, kind, partner):
        expected = [mpm_law(self.law, f"powder:{partner}", v, RADIUS) for v in SPEEDS]
        dt = min(x["contact_time_s"] for x in expected) / STEPS
        steps = math.ceil(1.2 * max(x["contact_time_s"] for x in expected) / dt)
        pitch = 6 * RADIUS
        text = (head(half=pitch * 5, skin=RADIUS / 2) + properties([POWDER]) +
                f"pair_style gran model mpm tangential history law {self.law} materials powder elasticDamping off\npair_coeff * *\n")
        if kind == "wall":
            text += "fix w all wall/gran model mpm tangential history primitive type 1 zplane 0.0\n"
        velocities, first = "", []
        for k, v in enumerate(SPEEDS):
            x, y = pitch * (k % 8 - 3.5), pitch * (k // 8 - 3)
            phase = 0.3 * dt * v  # of a step before first touch: no special phase
            n = 1 + (k if kind == "wall" else 2 * k)
            first.append(n)
            if kind == "wall":
                places = [(n, RADIUS + phase, -v)]
            else:
                places = [(n, RADIUS + phase / 2, -v / 2), (n + 1, -RADIUS - phase / 2, v / 2)]
            for i, z, vz in places:
                text += f"create_atoms 1 single {x!r} {y!r} {z!r} units box\n"
                velocities += f"group g id {i}\nvelocity g set 0 0 {vz!r}\ngroup g delete\n"
        text += (f"set group all diameter {2 * RADIUS!r} density {POWDER.density}\n{velocities}"
                 f"fix i all nve/sphere\ntimestep {dt!r}\nthermo {steps}\n" + dump("vz", steps) + f"run {steps}\n")
        self.run_deck(text)
        found = self.last_frame()
        largest = 0.0
        for k, v in enumerate(SPEEDS):
            after = found[first[k]][0] - (found[first[k] + 1][0] if kind == "pair" else 0.0)
            assert after > 0, f"{kind} at {v} m/s did not rebound"
            error = after / v - expected[k]["e"]
            largest = worst((largest, abs(error)))
            assert abs(error) < TOLERANCE, f"{kind} at {v} m/s: e {after / v}, {expected[k]['e']} by mpm law"
            if k % 7 == 0:
                self.record("drop", kind=kind, speed=v, e=after / v, law=expected[k]["e"])
        self.record("drop worst", kind=kind, count=COUNT, worst=largest)
