"""`tangential plastic` in LIGGGHTS: the library's integrator, invariance, restart, ranks, stretch, books, clumps, and what is refused."""
import json
import math
import pathlib
import re

from pytest import approx, mark
from harness import POWDER, Deck, Material, head, plane_stl, properties, sphere_mass, worst
from programs import answer, material, particle, table

R = 1e-3
MASS = sphere_mass(R, POWDER.density)
RIGID = Material("rigid", 1500.0, 1e30, 0.3, 1e30)  # a wall of this type shears as little as it is pressed in
TOML = material("powder", 1500, 9.1e9, 0.3, 1e8) + particle("grain", "powder", R)

# Density of a periodic packing of 30 spheres (E*/Y = 100, mu = 0.3, total-Lagrangian bodies of 12 cells a diameter): T/F and stress/Y
DENSITIES = [0.63, 0.73, 0.78, 0.83]
RESOLVED = [(0.124, 0.0800), (0.102, 0.2929), (0.101, 0.4104), (0.088, 0.5541)]


def step_of(speed, steps):
    """s: Hertz's contact time over the steps."""
    return 2.87 * (MASS**2 / (POWDER.e_star**2 * R * speed)) ** 0.2 / steps


class TestPlasticShear(Deck):
    def prepare(self):
        self.atlas_law = str(table(TOML, "--depth", "0.5"))

    def style(self, tangential="plastic", words="", rolling=""):
        return f"model mpm tangential {tangential} {rolling}", f"law {self.atlas_law} materials powder rigid {words}"

    def begin(self, friction, tangential="plastic", words="", rolling="", half=0.05, **given):
        models, own = self.style(tangential, words, rolling)
        return head(types=2, half=half, **given) + properties([POWDER, RIGID], friction) + f"pair_style gran {models} {own}\npair_coeff * *\n"

    def wall(self, tangential="plastic", rolling=""):
        return f"fix w all wall/gran model mpm tangential {tangential} {rolling} primitive type 2 zplane 0.0\n"

    def thrown(self, speed, angle, friction, steps, tangential="plastic", words="", run=None, turn=0.0, stretch=1.0):
        """A sphere flies at the wall from contact; `turn`: of its direction in the plane of the wall, degrees."""
        along = speed * math.tan(math.radians(angle))
        x, y = along * math.cos(math.radians(turn)), along * math.sin(math.radians(turn))
        return (self.begin(friction, tangential, words) + self.wall(tangential) +
                f"create_atoms 1 single 0 0 {R!r} units box\nset group all diameter {2 * R!r} density {POWDER.density}\n"
                f"velocity all set {x!r} {y!r} {-speed!r}\nfix i all nve/sphere\ntimestep {stretch * step_of(speed, steps)!r}\n" +
                (run or f"run {int(2.5 * steps)}\n") + self.motion())

    @staticmethod
    def motion():
        text = "".join(f"variable {q} equal {q}[1]\n" for q in ("vx", "vy", "vz"))
        for axis in "xyz":
            text += f"compute o{axis} all property/atom omega{axis}\ncompute p{axis} all reduce sum c_o{axis}\nvariable o{axis} equal c_p{axis}\n"
        return text + ("thermo_style custom step c_px c_py c_pz\nrun 0\n"
                       'print "END ${vx} ${vy} ${vz} ${ox} ${oy} ${oz}"\n')

    def end(self, deck, **given):
        return self.result(self.run_deck(deck, **given), "END")

    @mark.parametrize("tangential", ("history", "plastic"))
    @mark.parametrize("speed, angle, friction", ((13, 45, 0.3), (13, 70, 0.6), (39, 45, 0.6)))
    def test_an_impact_is_the_librarys(self, speed, angle, friction, tangential):
        """The same pieces, integrated alike: to rounding over some hundred steps, unless the contact begins a step later."""
        told = answer("oblique", pathlib.Path(self.atlas_law).with_name("m.toml"), "--particle", "grain", "--velocity", speed, "--angle", angle,
                      "--friction", friction, "--tangential", tangential, "--law", self.atlas_law, "--steps", 50, "--json")
        vx, _, vz, _, spin, _ = self.end(self.thrown(speed, angle, friction, 50, tangential))
        along = speed * math.tan(math.radians(angle))
        assert vz / speed == approx(told["e"], abs=1e-6)
        assert vx / along == approx(told["e_tangential"], abs=1e-6)
        assert spin / told["spin_after_rad_s"] == approx(1.0, abs=1e-6)

    def test_no_direction_is_preferred(self):
        straight = self.end(self.thrown(39, 45, 0.3, 100))
        turned = self.end(self.thrown(39, 45, 0.3, 100, turn=37.0))
        c, s = math.cos(math.radians(37)), math.sin(math.radians(37))
        back = [c * turned[0] + s * turned[1], -s * turned[0] + c * turned[1], turned[2],
                c * turned[3] + s * turned[4], -s * turned[3] + c * turned[4], turned[5]]
        scale = [39.0] * 3 + [39.0 / R] * 3
        assert worst(abs(a - b) / u for a, b, u in zip(straight, back, scale)) < 1e-9  # rounding

    def test_stretch_keeps_the_velocities_of_an_impact(self):
        """A contact that moves S times as far in S times the time ends with the same velocities; the lever of the deck's overlap differs."""
        plain, stretched = self.end(self.thrown(5, 45, 0.3, 100)), self.end(self.thrown(5, 45, 0.3, 100, words="stretch 3", stretch=3.0))
        for k, unit in ((0, 5.0), (2, 5.0), (4, 5.0 / R)):
            assert stretched[k] / unit == approx(plain[k] / unit, abs=0.01)

    def test_a_restart_within_the_contact_goes_on_as_without(self):
        speed, steps = 39, 60
        whole = self.end(self.thrown(speed, 60, 0.3, steps, run="run 50\nrun 100\n"))
        begin = self.thrown(speed, 60, 0.3, steps, run="run 50\nwrite_restart half.rest\n").split("variable vx")[0]
        self.run_deck(begin)
        models, own = self.style()
        again = (head(read="read_restart half.rest") + properties([POWDER, RIGID], 0.3) +
                 f"pair_style gran {models} {own}\npair_coeff * *\n" + self.wall() + f"fix i all nve/sphere\ntimestep {step_of(speed, steps)!r}\nrun 100\n" + self.motion())
        for a, b in zip(whole, self.end(again)):
            assert a == approx(b, abs=1e-9 * speed / R)

    def test_elastic_types_follow_history_to_the_bit(self):
        ends = [self.end(self.thrown(5, 40, 0.3, 60, tangential).replace("materials powder rigid", "materials elastic elastic"))
                for tangential in ("history", "plastic")]
        assert ends[0] == ends[1]
        assert abs(ends[0][4]) > 0

    @mark.parametrize("tangential", ("history", "plastic"))
    def test_a_sphere_inserted_beyond_the_law_parts(self, tangential):
        """It slides and its dent would deepen: its largest overlap stays the table's end, as under history."""
        deck = self.thrown(0.01, 89, 0.5, 100, tangential).replace(f"create_atoms 1 single 0 0 {R!r}", f"create_atoms 1 single 0 0 {0.4 * R!r}")
        text = self.run_deck(deck)
        assert "1 contacts began deeper than the motion of a step can bring them" in text
        assert self.result(text, "END")[2] > 0

    def test_a_mesh_is_the_primitive_wall(self):
        (self.folder / "plane.stl").write_text(plane_stl(0.02))
        primitive = self.thrown(39, 45, 0.3, 100)
        mesh = primitive.replace("fix w all wall/gran model mpm tangential plastic  primitive type 2 zplane 0.0\n",
                                 "fix m all mesh/surface file plane.stl type 2\nfix w all wall/gran model mpm tangential plastic mesh n_meshes 1 meshes m\n")
        assert mesh != primitive
        for a, b in zip(self.end(primitive), self.end(mesh)):
            assert a == approx(b, abs=1e-6 * 39 / R)

    def test_two_spheres_keep_their_momenta(self):
        """Force and couple on one are the opposite of those on the other: linear and angular momentum to rounding."""
        radii, speed = (R, 1.6 * R), 39.0
        mass = [sphere_mass(r, POWDER.density) for r in radii]
        place = [(0.0, 0.0, 0.0), (0.7 * sum(radii), 0.1 * sum(radii), math.sqrt(1 - 0.5) * sum(radii))]
        text = self.begin(0.4) + "".join(f"create_atoms 1 single {' '.join(map(repr, x))} units box\n" for x in place)
        for k in (0, 1):
            text += f"group a{k} id {k + 1}\nset group a{k} diameter {2 * radii[k]!r} density {POWDER.density}\n"
        text += f"velocity a0 set 0 0 {speed!r}\nfix i all nve/sphere\ntimestep {step_of(speed, 100)!r}\n"
        columns = "".join(f"variable {q}{k} equal {q}[{k}]\n" for k in (1, 2) for q in ("x", "y", "z", "vx", "vy", "vz"))
        for k in (0, 1):
            for axis in "xyz":
                columns += f"compute o{axis}{k} a{k} property/atom omega{axis}\ncompute p{axis}{k} a{k} reduce sum c_o{axis}{k}\nvariable o{axis}{k + 1} equal c_p{axis}{k}\n"
        names = [f"{q}{k}" for k in (1, 2) for q in ("x", "y", "z", "vx", "vy", "vz", "ox", "oy", "oz")]
        text += "run 350\n" + columns + "thermo_style custom step " + " ".join(f"c_p{a}{k}" for k in (0, 1) for a in "xyz") + "\nrun 0\n"
        text += 'print "END ' + " ".join(f"${{{name}}}" for name in names) + '"\n'
        found = self.end(text)

        def momenta(bodies):
            linear, angular = [0.0] * 3, [0.0] * 3
            for m, r, (x, v, w) in zip(mass, radii, bodies):
                for c in range(3):
                    d, e = (c + 1) % 3, (c + 2) % 3
                    linear[c] += m * v[c]
                    angular[c] += m * (x[d] * v[e] - x[e] * v[d]) + 0.4 * m * r * r * w[c]
            return linear + [a / R for a in angular]

        before = momenta([(place[0], (0, 0, speed), (0, 0, 0)), (place[1], (0, 0, 0), (0, 0, 0))])
        after = momenta([(found[9 * k:9 * k + 3], found[9 * k + 3:9 * k + 6], found[9 * k + 6:9 * k + 9]) for k in (0, 1)])
        assert worst(map(abs, found[6:9])) > 100  # it spins
        assert worst(abs(a - b) for a, b in zip(before, after)) < 1e-9 * mass[0] * speed  # rounding

    def gas(self, ranks, run="run 4000\n", tangential="plastic", words="energy on"):
        """Spheres with friction in a box of periodic sides, that collide at some 100 V_y."""
        text = self.begin(0.4, tangential, words, half=5 * R, boundary="p p p", skin=0.4 * R)
        spacing = 2.5 * R
        k = 0
        for a in range(4):
            for b in range(4):
                for c in range(4):
                    k += 1
                    place = " ".join(repr(spacing * (q - 1.5) + 0.2 * R * math.sin(7.3 * k + q)) for q in (a, b, c))
                    text += f"create_atoms 1 single {place} units box\n"
        text += f"set group all diameter {2 * R!r} density {POWDER.density}\n"
        for n in range(1, 65):
            v = [20 * math.sin(n * f) for f in (1.7, 2.3, 3.1)]
            text += f"set atom {n} vx {v[0]!r} vy {v[1]!r} vz {v[2]!r}\n"
        text += f"fix i all nve/sphere\nfix s all granulaw/stats file stats.json\ntimestep {step_of(20, 200)!r}\ncompute k all ke\ncompute r all erotate/sphere\n"
        text += "variable e equal c_k+c_r\nthermo_style custom step atoms c_k c_r\nthermo 1000\nrun 0\nvariable b equal ${e}\n"
        return text + run + 'print "END ${b} ${e}"\n'

    def test_the_books_of_a_gas(self):
        before, after = self.end(self.gas(1))
        said = json.loads((self.folder / "stats.json").read_text())
        books = said["pair"]
        assert after < 0.8 * before
        assert books["shear_dissipation_J"] > 0
        elastic = said["series"]["elastic_J"][-1]
        lost = books["normal_dissipation_J"] + books["shear_dissipation_J"] + books["other_work_J"] + elastic
        # of the first order in the step: 0.0015 measured here, 0.0005 and 0.0002 with half and a quarter of it
        assert (before - after) / before == approx(lost / before, abs=2e-3)

    def test_ranks_agree(self):
        """Two ranks sum forces in another order; over some collisions each that differs by rounding."""
        one, two = self.end(self.gas(1, "run 600\n")), self.end(self.gas(2, "run 600\n"), ranks=2)
        assert one[1] / one[0] == approx(two[1] / two[0], abs=1e-9)

    def test_a_rolling_model_of_zero_changes_nothing(self):
        """It has another loop over contacts, the models behind virtual calls. Forces are summed in another order: rounding."""
        alone = self.gas(1, "run 600\n")
        rolling = re.sub("RollingFriction .*", "RollingFriction peratomtypepair 2 0 0 0 0",
                         alone.replace("tangential plastic ", "tangential plastic rolling_friction cdt "))
        one, two = self.end(alone), self.end(rolling)
        assert one[1] < 0.95 * one[0]  # they collided
        assert two[1] / two[0] == approx(one[1] / one[0], abs=1e-9)

    def pressed(self, tangential, friction):
        """T/F and stress over Y at DENSITIES of the packing, pressed from all sides at a rate of 0.001 c*/R."""
        points = [[float(x) for x in line.split()] for line in (pathlib.Path(__file__).parents[2] / "examples/benchmark/bed_30.txt").read_text().splitlines()]
        side = (len(points) * 4 * math.pi / 3 / 0.58) ** (1 / 3) * R
        points = [[x * R % side for x in point] for point in points]
        rate, dt = 0.001 * math.sqrt(POWDER.e_star / POWDER.density) / R, 4e-9
        text = (head(types=2, half=1, boundary="p p p", skin=0.4 * R).replace("region box block -1 1 -1 1 -1 1", f"region box block 0 {side!r} 0 {side!r} 0 {side!r}") +
                properties([POWDER, RIGID], friction))
        models, own = self.style(tangential)
        text += f"pair_style gran {models} {own}\npair_coeff * *\n"
        text += "".join(f"create_atoms 1 single {x!r} {y!r} {z!r} units box\n" for x, y, z in points)
        text += f"set group all diameter {2 * R!r} density {POWDER.density}\n"
        text += "".join(f"set atom {k} " + " ".join(f"v{a} {-rate * (x - side / 2)!r}" for a, x in zip("xyz", point)) + "\n" for k, point in enumerate(points, 1))
        text += ("fix i all nve/sphere\nfix d all deform 1 " + " ".join(f"{a} vel {-rate * side!r}" for a in "xyz") + " remap v units box\n"
                 "compute l all pair/gran/local id force_normal force_tangential delta\n" f"timestep {dt!r}\nthermo 100000\n")
        steps = [round((1 - (0.58 / density) ** (1 / 3)) / rate / dt) for density in DENSITIES]
        columns = " ".join(f"c_l[{k}]" for k in range(1, 11))
        for k, (step, before) in enumerate(zip(steps, [0] + steps)):
            text += f"run {step - before}\ndump d all local 1 forces{k}.txt {columns}\nrun 0\nundump d\n"
        self.run_deck(text)
        found = []
        for k, density in enumerate(DENSITIES):
            lines = (self.folder / f"forces{k}.txt").read_text().split("ENTRIES")[-1].splitlines()[1:]
            rows = [[float(x) for x in line.split()] for line in lines if line.strip()]
            pull, push = (sum(math.hypot(*row[a:a + 3]) for row in rows) for a in (6, 3))
            virial = sum(math.hypot(*row[3:6]) * (2 * R - row[9]) for row in rows)
            found.append((pull / push, virial / (3 * side**3 * 0.58 / density) / POWDER.yield_stress))
        return found

    def test_a_packing_pressed_from_all_sides(self):
        """Contacts that deepen let their tangential force go: T/F and stress of the same packing of resolved deformable spheres."""
        for friction in (0.3, 0.6):  # it hardly matters there, nor here
            for (ratio, stress), (resolved_ratio, resolved_stress) in zip(self.pressed("plastic", friction), RESOLVED):
                # measured: 0.008; -2.2 to +7.9 %, as contacts of one sphere act on each other; the resolved ones are good to 1 % (grid)
                assert ratio == approx(resolved_ratio, abs=0.012)
                assert stress / resolved_stress == approx(1.03, abs=0.06)
        for (ratio, stress), (resolved_ratio, resolved_stress) in zip(self.pressed("history", 0.3)[1:], RESOLVED[1:]):
            assert ratio > 1.5 * resolved_ratio
            assert stress / resolved_stress > 1.11  # measured: 1.125 to 1.163

    def refused(self, deck, *parts):
        text = self.run_deck(deck, expect_failure=True)
        for part in parts:
            assert part in text

    def test_refusals(self):
        thornton = self.begin(0.3).replace("model mpm tangential plastic  law " + self.atlas_law + " materials powder rigid ", "model thornton tangential plastic ")
        self.refused(thornton + "run 0\n", "'tangential plastic' is for 'model mpm'")
        hertz = thornton.replace("model thornton", "model hertz")
        self.refused(hertz + "run 0\n", "'tangential plastic' is for 'model mpm'")
        rated = str(self.folder / "rated.h5")
        self.fixture("write", rated, "rate", R)
        by_rate = self.thrown(1.0, 45, 0.3, 50).replace(self.atlas_law, rated).replace("materials powder rigid", "materials powder elastic")
        self.refused(by_rate, f"law file {rated}: 'powder' depends on the strain rate: 'tangential plastic' needs one flow stress")
        self.run_deck(by_rate.replace("tangential plastic", "tangential history"))

    @mark.parametrize("angle, friction", ((45, 0.3), (70, 0.6), (80, 0.6)))
    def test_the_statistics_have_the_overlaps_themselves(self, angle, friction):
        """Shear takes the law's depth ahead of the overlap, from a fifth up to seven times."""
        deck = self.thrown(13, angle, friction, 100, words="stats s.json").replace("run 250\n", "variable z equal z[1]\nthermo_style custom step v_z\nthermo 1\nrun 250\n", 1)
        heights = [float(row[1]) for row in re.finditer(r"^\s*\d+\s+([-+.\de]+)\s*$", self.run_deck(deck), re.M)]
        largest = (R - min(heights)) / R
        found = json.loads((self.folder / "s.json").read_text())["wall"]
        assert found["overlap_over_radius_max"] == approx(largest, abs=1e-7)  # heights have eight digits
        histogram = found["largest_overlap_over_radius"]
        (place,) = [k for k, count in enumerate(histogram["count"]) if count]
        edges = histogram["lower_edge"]
        assert edges[place] <= largest < edges[place] * 10 ** (1 / histogram["bins_per_decade"])

    def test_another_law_at_walls_is_named(self):
        deck = self.thrown(1.0, 45, 0.3, 50)
        assert "different laws" not in self.run_deck(deck)
        at_wall = re.sub(r"(?m)^(fix \S+ all wall/gran .*)tangential plastic", r"\1tangential history", deck)
        assert at_wall != deck
        assert "it has 'tangential history' and the pair style 'tangential plastic': walls and particles turn and slide by different laws" in self.run_deck(at_wall)
