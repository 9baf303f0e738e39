"""The time step: how deep a contact it is short enough for, the warning, what the stiffest contact allowed, and what the fraction is worth."""
import json
import math

from pytest import approx
from collisions import pair_deck, wall_deck
from harness import GLASS, POWDER, Deck, sphere_mass

RADIUS = 1.7e-3
FRACTION = 1 / 20


class TestTimeStep(Deck):
    def stats(self, deck):
        text = self.run_deck(deck)
        return text, json.loads((self.folder / "s.json").read_text())

    def test_elastic_pair(self):
        """The synthetic glass in closed form, at the deepest overlap visited and at the table's end.

        F = F_Hertz (1 + 0.9 sqrt(x)), x = delta/(4 R*) for like spheres: k = 2 E* sqrt(R* delta) (1 + 1.2 sqrt(x)).
        """
        words = f"law {self.law} materials glass stats s.json"
        r, m = RADIUS / 2, sphere_mass(RADIUS, GLASS.density) / 2
        deck = pair_deck("mpm", words, (GLASS, GLASS), (RADIUS, RADIUS), 1.0, 1e-8, run="run 3000")
        text, stats = self.stats(deck)
        pair = stats["pairs"][0]
        for found, depth in ((pair["time_step_allowed_s"], pair["overlap_over_radius_max"]),
                             (pair["time_step_limit_of_law_s"], pair["overlap_over_radius_limit"])):
            k = 2 * (GLASS.e_star / 2) * r * math.sqrt(depth) * (1 + 1.2 * math.sqrt(depth / 4))
            # 1e-4: the table's interpolation
            assert found / (FRACTION * 2 * math.pi * math.sqrt(m / k)) == approx(1.0, abs=1e-4)
        assert "is over" not in text
        assert stats["time_step_used_s"] == 1e-8

    def test_yielded_contact(self):
        """Powder on a wall: the limit is that of the steepest branch, loading or unloading from a reversal, of 64 overlaps.

        Slopes by three points h = 1e-3 of the overlap apart: an error of the order of (h/(overlap - residual))^2, 2e-5 where
        the unloading is shortest; the forces are printed with ten digits, 1e-7 of the slope.
        """
        words = f"law {self.law} materials powder stats s.json"
        m = sphere_mass(RADIUS, POWDER.density)
        _, stats = self.stats(wall_deck("mpm", words, POWDER, RADIUS, 0.5, 1e-8))
        wall = next(p for p in stats["pairs"] if p["kind"] == "rigid wall")

        def force(delta, largest):
            return self.fixture("force", self.law, "powder", "wall", RADIUS, repr(delta), repr(largest), 0)[0]

        slopes = []
        for k in range(1, 65):
            d = k / 64 * wall["overlap_over_radius_limit"] * RADIUS
            h, top = 1e-3 * d, force(d, d)
            for at in (lambda x: force(x, x), lambda x: force(x, d)):
                slopes.append((3 * top - 4 * at(d - h) + at(d - 2 * h)) / (2 * h))
        assert max(slopes[1::2]) > 1.2 * max(slopes[::2])  # it is an unloading
        allowed = FRACTION * 2 * math.pi * math.sqrt(m / max(slopes))
        assert wall["time_step_limit_of_law_s"] / allowed == approx(1.0, abs=1e-4)

    def test_largest_step_used(self):
        """The longer step of two runs is stated, whichever was the first."""
        words = f"law {self.law} materials powder stats s.json"
        for first, second in ((1e-8, 4e-9), (4e-9, 1e-8)):
            deck = wall_deck("mpm", words, POWDER, RADIUS, 0.5, first)
            _, stats = self.stats(deck.replace("run 120", f"run 60\ntimestep {second!r}\nrun 60"))
            assert stats["time_step_used_s"] == 1e-8

    def wall(self, deck):
        text, stats = self.stats(deck)
        return text, next(p for p in stats["pairs"] if p["kind"] == "rigid wall")

    def test_warning(self):
        """A contact that requires a shorter step earns one warning with both numbers; before there is one, a step that the table's end
        would ask to be shorter is none. The smallest particle counts.

        3 %: of 13 steps a contact none need hit the largest overlap, which costs 1 % of it and 0.3 % of the step; the powder's
        stiffness falls by so much more.
        """
        words = f"law {self.law} materials powder stats s.json"
        _, fine = self.wall(wall_deck("mpm", words, POWDER, RADIUS, 0.5, 1e-8).replace("run 120", "run 8000"))
        limit, allowed = fine["time_step_limit_of_law_s"], fine["time_step_allowed_s"]
        assert allowed > 1.1 * limit
        for step, count in ((1.05 * limit, 0), (0.97 * allowed, 0), (1.03 * allowed, 1)):
            deck = wall_deck("mpm", words, POWDER, RADIUS, 0.5, step)
            text, wall = self.wall(deck.replace("run 120", "run 10\nrun 50\nrun 50"))
            assert text.count("a contact of type 1 with a wall of type 1 was so deep that") == count, (step, limit, allowed)
            deep = wall["overlap_over_radius_limit_of_time_step"]
            assert (deep < wall["overlap_over_radius_max"]) == (count == 1)
        # the period goes with the radius: rho R^3/(E R)
        _, small = self.stats(wall_deck("mpm", words, POWDER, RADIUS / 3, 0.5, 1e-8))
        assert 3 * next(p for p in small["pairs"] if p["kind"] == "rigid wall")["time_step_limit_of_law_s"] / limit == approx(1.0, abs=1e-9)

    def test_later_runs_begin_anew(self):
        """A contact of an earlier run with a shorter step earns a longer one no warning."""
        words = f"law {self.law} materials powder stats s.json"
        _, fine = self.wall(wall_deck("mpm", words, POWDER, RADIUS, 0.5, 1e-8).replace("run 120", "run 8000"))
        allowed = fine["time_step_allowed_s"]
        deck = wall_deck("mpm", words, POWDER, RADIUS, 0.5, 0.9 * allowed)
        text, _ = self.wall(deck.replace("run 120", f"run 60\ntimestep {2 * allowed!r}\nrun 5"))
        assert "was so deep that" not in text

    def test_overlap_of_the_step(self):
        """The synthetic glass in closed form: where k(d) requires just this step."""
        words = f"law {self.law} materials glass stats s.json"
        r, m = RADIUS / 2, sphere_mass(RADIUS, GLASS.density) / 2
        for depth in (0.01, 0.1):
            k = 2 * (GLASS.e_star / 2) * r * math.sqrt(depth) * (1 + 1.2 * math.sqrt(depth / 4))
            step = FRACTION * 2 * math.pi * math.sqrt(m / k)
            _, stats = self.stats(pair_deck("mpm", words, (GLASS, GLASS), (RADIUS, RADIUS), 1.0, step))
            # the interpolation's 1e-4 of k is four times that of the overlap
            assert stats["pairs"][0]["overlap_over_radius_limit_of_time_step"] / depth == approx(1.0, abs=5e-4)

    def test_template_counts(self):
        """A particle that can be inserted later is smaller than all that exist: the limit is its own."""
        words = f"law {self.law} materials powder stats s.json"
        template = (f"fix pt all particletemplate/sphere 15485863 atom_type 1 density constant {POWDER.density} "
                    f"radius constant {RADIUS / 4}\nrun 120")
        deck = wall_deck("mpm", words, POWDER, RADIUS, 0.5, 1e-8)
        limit = [self.stats(d)[1]["pairs"][-1]["time_step_limit_of_law_s"]
                 for d in (deck, deck.replace("run 120", template))]
        assert limit[0] / limit[1] == approx(4.0, abs=1e-9)

    def test_what_the_fraction_is_worth(self):
        """At the step that the visited stiffness allows, e is within 0.005 of the law (issue 5) whatever the phase."""
        m = sphere_mass(RADIUS, POWDER.density)
        for speed in (0.5, 3.0):
            e, duration, _ = self.fixture("mpm", self.law, "powder", "wall", RADIUS, m, speed)
            words = f"law {self.law} materials powder stats s.json"
            _, stats = self.stats(wall_deck("mpm", words, POWDER, RADIUS, speed, duration / 400).replace("run 120", "run 700"))
            dt = stats["wall"]["time_step_allowed_s"]
            assert duration / dt > 10
            for phase in (0.05, 0.55):
                deck = wall_deck("mpm", words, POWDER, RADIUS, speed, dt).replace(
                    repr(RADIUS + 0.3 * dt * speed), repr(RADIUS + phase * dt * speed)).replace("run 120", "run 60")
                assert self.result(self.run_deck(deck), "SPEED")[0] / speed == approx(e, abs=0.005)
