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


class TestFast(Begun):
    """A particle that moves further than its radius in a step has run away if something kicked it."""

    def carried(self, start, more=""):
        """A sphere of 1 mm at 0.3 m/s, three radii a step, across a periodic box."""
        return self.deck(-5, 300, dt=1e-2, more=f"velocity all set 0.3 0 0\n{more}").replace("boundary f f f", "boundary p p f").replace("vcm(all,z)", "vcm(all,x)") + start

    def test_particles_that_nothing_moves(self):
        self.run_deck(self.deck(-5, 200, integrator="", dt=1.0, more="velocity all set 0 0 -0.1\n"))

    def test_particles_that_are_carried(self):
        speed, *_ = self.result(self.run_deck(self.carried("run 300\n")), "END")
        assert speed == 0.3

    def test_a_field_may_bring_them_up_to_speed(self):
        self.run_deck(self.carried("fix g all gravity 0.2 vector 1 0 0\nrun 300\n"))

    def test_what_is_kicked_stops(self):
        text = self.run_deck(self.carried("velocity all set 3 0 0\nrun 300\n"), expect_failure=True)
        assert "has run away" in text

    def test_what_met_something_too_fast_stops(self):
        """It comes onto the floor at three radii a step: no contact law means anything then."""
        text = self.run_deck(self.deck(-5, 200, dt=1e-2, more="velocity all set 0 0 -0.11\n"), expect_failure=True)
        assert "has run away" in text or "beyond the law's table" in text
