"""Decks as users write them, in small: each ran into a stop or a refusal that nothing demanded."""
from harness import POWDER, Deck, head, properties, sphere_mass

RADIUS = 1e-3


class Begun(Deck):
    def deck(self, wall_overlap, run, integrator="fix i all nve/sphere\n", dt=2e-8, more=""):
        """One sphere that begins with this overlap (over its radius) with a floor."""
        return (head(half=20 * RADIUS) + properties([POWDER]) +
                f"pair_style gran model mpm tangential history law {self.law} materials powder\npair_coeff * *\n"
                "fix floor all wall/gran model mpm tangential history primitive type 1 zplane 0.0\n"
                f"create_atoms 1 single 0 0 {(1 - wall_overlap) * RADIUS!r} units box\n"
                f"set group all diameter {2 * RADIUS!r} density {POWDER.density}\n{integrator}timestep {dt!r}\n{more}"
                "fix track all ave/time 1 1 1 f_granulaw[17] f_granulaw[18]\n"
                "variable v equal vcm(all,z)\nvariable n equal f_granulaw[17]\nvariable w equal f_granulaw[18]\n"
                f"thermo_style custom step v_v v_n v_w\nthermo 100\nrun {run}\n" 'print "END ${v} ${n} ${w}"\n')


class TestInserted(Begun):
    def test_a_contact_that_began_beyond_the_table_does_not_stop_the_run(self):
        text = self.run_deck(self.deck(0.9, 4000))
        speed, count, _ = self.result(text, "END")
        assert count == 1
        assert "began deeper than the motion of a step" in text
        # the force at the table's end (some 0.25 R) over the way from 0.9 R: no more than Y pi R^2 over R
        mass = sphere_mass(RADIUS, POWDER.density)
        work = 10 * POWDER.yield_stress * RADIUS**3
        assert speed > 0
        assert 0.5 * mass * speed**2 < work

    def test_depth_by_motion_still_stops(self):
        text = self.run_deck(self.deck(-0.1, 20000, more="velocity all set 0 0 -200\n"), expect_failure=True)
        assert "beyond the law's table" in text


class TestStill(Begun):
    def test_particles_that_nothing_moves_are_no_runaways(self):
        fast = dict(dt=1.0, more="velocity all set 0 0 -0.1\n")
        self.run_deck(self.deck(-5, 200, integrator="", **fast))
        text = self.run_deck(self.deck(-5, 200, **fast), expect_failure=True)
        assert "run" in text
