"""`stretch S`, F_s(d) = F(d/S)/S: the same impacts, S times slower."""
import json
import math
import re

from pytest import approx, mark
from collisions import pair_deck, wall_deck
from harness import POWDER, Deck, head, properties, sphere_mass, worst

RADIUS = 1.7e-3
STEPS = 50                 # time steps a contact, stretched or not
SPEEDS = (0.03, 0.3, 3.0)  # below the onset of yield, above, 4 % of R deep
STRETCHES = (3, 10, 30)
DEEPEST = 0.2              # overlap/R, stretched: the required range
TOLERANCE = 0.002          # of e: required
ROUNDING = 1e-8            # a stretched head-on impact is the same arithmetic on other numbers, 1e-16 R in overlaps of 1e-4 R


class TestStretch(Deck):
    def words(self, stretch, model="mpm"):
        law = f"law {self.law} materials powder " if model == "mpm" else ""
        return law + f"stretch {stretch}"

    def speeds(self, decks):
        return [speed for speed, in self.run_each(decks, "SPEED")]

    def replay(self, partner, r_eff, m_eff, speed):
        return self.fixture("mpm", self.law, "powder", partner, r_eff, m_eff, speed)

    def test_wall_and_pair_head_on(self):
        mass = sphere_mass(RADIUS, POWDER.density)
        cases = (("wall", RADIUS, mass, lambda w, v, dt: wall_deck("mpm", w, POWDER, RADIUS, v, dt)),
                 ("powder", RADIUS / 2, mass / 2,
                  lambda w, v, dt: pair_deck("mpm", w, (POWDER, POWDER), (RADIUS, RADIUS), v, dt)))
        decks = {}
        for partner, r_eff, m_eff, deck in cases:
            for speed in SPEEDS:
                _, duration, delta_max = self.replay(partner, r_eff, m_eff, speed)
                for s in (1, *STRETCHES):
                    if s == 1 or s * delta_max / RADIUS <= DEEPEST:
                        decks[partner, speed, s] = deck(self.words(s), speed, s * duration / STEPS)
        found = dict(zip(decks, self.speeds(decks.values())))
        for (partner, speed, s), e in found.items():
            assert e / found[partner, speed, 1] == approx(1.0, abs=ROUNDING), f"{partner}, {speed} m/s, s = {s}"
        assert len(found) >= 10 + 2 * len(SPEEDS)

    def test_law_with_axis(self):
        """The speed that a contact latches is the real one."""
        self.fixture("write", self.law, "axis")
        speed = 8.0
        _, duration, _ = self.replay("wall", RADIUS, sphere_mass(RADIUS, POWDER.density), speed)
        plain, stretched = self.speeds(wall_deck("mpm", self.words(s), POWDER, RADIUS, speed, s * duration / STEPS)
                                       for s in (1, 3))
        assert stretched / plain == approx(1.0, abs=ROUNDING)

    def test_thornton(self):
        plain, stretched = self.speeds(wall_deck("thornton", self.words(s, "thornton"), POWDER, RADIUS, 1.0, s * 2e-7)
                                       for s in (1, 10))
        assert stretched / plain == approx(1.0, abs=ROUNDING)

    def oblique_deck(self, stretch, speed, angle_ratio, dt, pair, stiffness):
        """An impact whose tangential speed is angle_ratio * speed, friction 0.3."""
        words = self.words(stretch) + f" tangentialStiffness {stiffness}"
        text = head(half=20 * RADIUS) + properties([POWDER], 0.3)
        text += f"pair_style gran model mpm tangential history {words}\npair_coeff * *\n"
        gap = 0.3 * dt * stretch * speed
        t = angle_ratio * speed
        if pair:
            # mirror images: contact normal z when they touch
            z, lead = RADIUS + gap / 2, 0.5 * t * 0.3 * dt * stretch
            bodies = ((1, -lead, z, t / 2, -speed / 2), (2, lead, -z, -t / 2, speed / 2))
        else:
            text += "fix w all wall/gran model mpm tangential history primitive type 1 zplane 0.0\n"
            bodies = ((1, 0.0, RADIUS + gap, t, -speed),)
        for k, x, z, vx, vz in bodies:
            text += (f"create_atoms 1 single {x!r} 0.0 {z!r} units box\ngroup a{k} id {k}\n"
                     f"set group a{k} diameter {2 * RADIUS!r} density {POWDER.density}\n"
                     f"velocity a{k} set {vx!r} 0.0 {vz!r}\n")
        text += (f"fix i all nve/sphere\ntimestep {dt * stretch!r}\ncompute om a1 property/atom omegay\n"
                 "compute sum a1 reduce sum c_om\nvariable o equal c_sum\nvariable vx equal vcm(a1,x)\n"
                 "variable vz equal vcm(a1,z)\nvariable x equal xcm(a1,x)\nvariable z equal xcm(a1,z)\n"
                 'thermo_style custom step c_sum\nrun 120\nprint "AFTER ${vx} ${vz} ${o} ${x} ${z}"\n')
        return text

    def after(self, state, speed, pair):
        """Normal and tangential velocity, spin * R, over `speed`, and how far the line of centres turned."""
        vx, vz, spin, x, z = state
        turned = 0.0
        if pair:  # the line of centres where they parted: back along the free flight to |x| = R
            v2, xv, x2 = vx * vx + vz * vz, x * vx + z * vz, x * x + z * z
            back = (xv - math.sqrt(xv * xv - v2 * (x2 - RADIUS**2))) / v2
            x, z = x - back * vx, z - back * vz
            turned = math.atan2(x, z)
            vx, vz = (vx * z - vz * x) / RADIUS, (vx * x + vz * z) / RADIUS
            speed /= 2
        return (vz / speed, vx / speed, spin * RADIUS / speed), turned

    def oblique_cases(self, partner, ratios, stretches, stiffness="mindlin"):
        """(plain, stretched, s delta_max/R, turn of the line of centres while they touch, ratio) of each case."""
        mass, speed = sphere_mass(RADIUS, POWDER.density), 0.3
        r_eff, m_eff = (RADIUS, mass) if partner == "wall" else (RADIUS / 2, mass / 2)
        _, duration, delta_max = self.replay(partner, r_eff, m_eff, speed)
        pair = partner != "wall"
        cases = [(ratio, s) for ratio in ratios for s in (1, *stretches)]
        states = self.run_each((self.oblique_deck(s, speed, ratio, duration / STEPS, pair, stiffness) for ratio, s in cases), "AFTER")
        found = {case: self.after(state, speed, pair) for case, state in zip(cases, states)}
        for (ratio, s), (motion, turned) in found.items():
            if s > 1:
                yield found[ratio, 1][0], motion, s * delta_max / RADIUS, turned, ratio

    def check_wall(self, case):
        """Impulses are kept; what differs is their lever arm, which LIGGGHTS shortens by the overlap."""
        (e, slip, spin), (found_e, found_slip, found_spin), depth, _, ratio = case
        assert found_e == approx(e, abs=1e-6)  # e is not affected: rounding, as head-on
        assert abs(found_spin - spin) < depth * abs(spin)
        # sliding: the impulse is mu times the normal one; sticking: it also turns the sphere, by the same arm
        assert abs(found_slip - slip) < (1e-6 if ratio > 1 else 0.2 * depth)

    def test_oblique_wall(self):
        """Sticking (v_t/v_n = 0.3) and sliding (3)."""
        for case in self.oblique_cases("wall", (0.3, 3.0), STRETCHES):
            self.check_wall(case)
        for case in self.oblique_cases("wall", (0.3,), (10,), "computed"):
            self.check_wall(case)

    @mark.parametrize("ratio, stretches", ((0.3, STRETCHES), (3.0, (3, 30))))
    def test_oblique_pair(self, ratio, stretches):
        """e within 0.002 where spheres do not slide past each other. Where they do, the line of centres turns
        by phi = v_t t_c/(2R) during the longer contact and the centrifugal term takes phi v_t/v_n from the
        normal impulse: softness of any kind does that, and this is the bound here."""
        for plain, found, depth, turned, _ in self.oblique_cases("powder", (ratio,), stretches):
            if ratio < 1:
                assert abs(found[0] - plain[0]) < TOLERANCE
            for value, expected in zip(found, plain):
                assert abs(value - expected) < turned * ratio + depth * abs(plain[2])

    def test_walls_inherit(self):
        """The factor stands with the pair style alone; a wall may say otherwise."""
        deck = wall_deck("mpm", self.words(10), POWDER, RADIUS, 0.3, 2e-6)
        own = wall_deck("mpm", self.words(10), POWDER, RADIUS, 0.3, 2e-7, wall_words="stretch 1")
        plain = wall_deck("mpm", self.words(1), POWDER, RADIUS, 0.3, 2e-7)
        inherited, otherwise, alone = self.speeds((deck, own, plain))
        assert inherited / alone == approx(1.0, abs=ROUNDING)
        assert otherwise == alone

    def test_too_deep(self):
        """An overlap of more than half of R* ends the run, whatever beyondRange says."""
        deck = wall_deck("mpm", self.words(100) + " beyondRange continue", POWDER, RADIUS, 3.0, 2e-5)
        text = self.run_deck(deck, expect_failure=True)
        assert "'stretch 100' takes the overlap of types 1 and 1 to" in text
        assert "stretch less" in text

    def energies(self, deck, start):
        """Kinetic + elastic + dissipated energy over what there was at the start, at every step; the last row's f_ID[13]."""
        every = ("thermo_style custom step ke f_granulaw f_granulaw[14] f_granulaw[13]\nthermo_modify norm no\nthermo 1\n")
        deck = re.sub(r"thermo 1000?\n", every, deck)
        rows = [[float(w) for w in line.split()] for line in self.run_deck(deck).splitlines()
                if re.fullmatch(r"\s*\d+(\s+[-+.\deE]+){4}\s*", line)]
        assert len(rows) > 100
        return [(ke + dissipated + stored) / start for _, ke, dissipated, stored, _ in rows], rows[-1][4]

    def test_energy_is_kept_at_every_stretch(self):
        """Wall and pair, both models, a law with a velocity axis: what is kinetic, elastic and dissipated adds up at every step,
        stretched or not, and the time step that the stiffest contact allows grows as the stretch."""
        mass, speed, steps = sphere_mass(RADIUS, POWDER.density), 1.0, 200
        self.fixture("write", self.folder / "axis.h5", "axis")
        for model, law in (("mpm", self.law), ("mpm", self.folder / "axis.h5"), ("thornton", None)):
            for partner, m_eff in (("wall", mass), ("pair", mass / 2)):
                allowed = {}
                for s in (1, 3, 17.7):
                    words = (f"law {law} materials powder " if law else "") + f"stretch {s} energy on elasticDamping off"
                    dt = s * 3.2e-6 / steps  # a contact lasts 3 us here
                    deck = (wall_deck(model, words, POWDER, RADIUS, speed, dt) if partner == "wall" else
                            pair_deck(model, words, (POWDER, POWDER), (RADIUS, RADIUS), speed, dt))
                    total, allowed[s] = self.energies(deck.replace("run 120", f"run {2 * steps}"), 0.5 * m_eff * speed**2)
                    said = f"{model} {law} {partner} {s}"
                    # LIGGGHTS's kinetic energy is that of a whole step: velocity Verlet's own error, 1/steps^2 of the exchange
                    assert worst(abs(t - 1) for t in total) < 2e-3, said
                    assert allowed[s] / allowed[1] == approx(s, abs=1e-6 * s), said

    @mark.parametrize("model", ("mpm", "thornton"))
    def test_start_up_time_step_moves_with_the_stretch(self, model):
        """The limit of the whole law: 1/20 of the period of the stiffest contact."""
        limits = []
        for s in (1, 10):
            self.run_deck(wall_deck(model, self.words(s, model) + " stats s.json", POWDER, RADIUS, 0.1, 1e-8))
            stats = json.loads((self.folder / "s.json").read_text())
            limits.append(next(p for p in stats["pairs"] if p["kind"] == "rigid wall")["time_step_limit_of_law_s"])
        assert limits[1] / limits[0] == approx(10.0, abs=1e-6), model  # ten printed digits
