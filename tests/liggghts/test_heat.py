"""Heat beside our models: `temperature` of walls, `compute wall/gran/local`, heat through the law's own contact radius."""
import math

from pytest import approx, mark
from harness import POWDER, Deck, head, plane_stl, properties

RADIUS = 1.7e-3
DT = 2e-7
CONDUCTIVITY, CAPACITY = 50.0, 10.0  # W/(m K), J/(kg K): a contact of some microseconds changes the sphere by some mK
HOT = 400.0
ONE = "fix p6 all property/global coefficientRestitution peratomtypepair 1 1.0\n"
THERMAL = (f"fix h1 all property/global thermalConductivity peratomtype {CONDUCTIVITY}\n"
           f"fix h2 all property/global thermalCapacity peratomtype {CAPACITY}\n")
CONDUCTION = "fix heat all heat/gran/conduction initial_temperature 300.0\n"
MODELS = ("hertz", "mpm", "thornton")


class TestHeat(Deck):
    def words(self, model, more=""):
        own = {"mpm": f"law {self.law} materials powder elasticDamping off ", "thornton": "elasticDamping off ", "hertz": ""}[model]
        return own + more

    def start(self, model, wall, more=""):
        """A deck up to its spheres: a wall at z = 0 with a temperature, conduction."""
        mesh = wall.startswith("mesh")
        (self.folder / "plane.stl").write_text(plane_stl())
        return (head(half=20 * RADIUS) + properties([POWDER]) + ONE + THERMAL +
                f"pair_style gran model {model} tangential history {self.words(model, more)}\npair_coeff * *\n" +
                (f"fix cad all mesh/surface file plane.stl type 1 temperature {HOT}\n" if mesh else "") + CONDUCTION +
                f"fix w all wall/gran model {model} tangential history {wall}" +
                ("" if mesh else f" temperature {HOT}") + f" {'wall deformable' if model != 'hertz' else ''}\n")

    def spheres(self, heights, speed=0.0):
        text = "".join(f"create_atoms 1 single {4 * k * RADIUS!r} {-1.1 * RADIUS!r} {z!r} units box\n" for k, z in enumerate(heights))
        return (text + f"set group all diameter {2 * RADIUS!r} density {POWDER.density}\n"
                f"velocity all set 0.0 0.0 {-speed!r}\nfix i all nve/sphere\ntimestep {DT!r}\n"
                "compute t all reduce sum f_Temp\nvariable t equal c_t\nthermo_style custom step c_t\nthermo 100\n")

    @mark.parametrize("wall", ("primitive type 1 zplane 0.0", "mesh n_meshes 1 meshes cad"))
    @mark.parametrize("model", MODELS)
    def test_spheres_beside_a_hot_wall_stay_cold(self, model, wall):
        """0.5 % of R off the wall: no contact, no heat."""
        deck = self.start(model, wall) + self.spheres([1.005 * RADIUS]) + 'run 10\nprint "TEMP ${t}"\n'
        assert self.result(self.run_deck(deck), "TEMP") == [300.0], f"{model}, {wall}"

    @mark.parametrize("wall", ("primitive type 1 zplane 0.0", "mesh n_meshes 1 meshes cad"))
    def test_an_impact_on_a_hot_wall_takes_heat(self, wall):
        """Below yield (0.03 m/s) all three models make the same contact: stock Hertz's heat, to the law's table."""
        found = {}
        for model in MODELS:
            deck = self.start(model, wall) + self.spheres([RADIUS * (1 + 1e-6)], 0.03) + 'run 300\nprint "TEMP ${t}"\n'
            found[model] = self.result(self.run_deck(deck), "TEMP")[0] - 300.0
        assert found["hertz"] > 1e-3
        # thornton has Hertz's formula itself; the law is Hertz corrected for a finite sphere, 0.9 sqrt(d/R) = 1 % of F
        # at d/R = 2e-4 here, and the time in contact follows; elastic spheres meet deformable walls of the same material
        assert found["thornton"] / found["hertz"] == approx(1.0, abs=1e-6), wall
        assert found["mpm"] / found["hertz"] == approx(1.0, abs=0.02), wall

    @mark.parametrize("model", MODELS)
    def test_local_rows_are_contacts(self, model):
        """Two spheres hover within 1 % of R, one is pressed 1 % in: one row, and the hovering ones get no heat."""
        deck = (self.start(model, "mesh n_meshes 1 meshes cad") +
                self.spheres([1.001 * RADIUS, 1.009 * RADIUS, 0.9999 * RADIUS]) +
                "compute rows all wall/gran/local id force contactArea heatFlux\n".replace(" heatFlux", "") +
                "compute n all reduce sum c_rows[1]\ndump d all local 1 rows.dump c_rows[1] c_rows[2] c_rows[3]\n"
                "run 1\n")
        self.run_deck(deck)
        lines = (self.folder / "rows.dump").read_text().splitlines()
        assert [int(b) for a, b in zip(lines, lines[1:]) if a == "ITEM: NUMBER OF ENTRIES"] == [1, 1], model

    def conducted(self, a):
        """K in one step that a contact of radius `a` with a wall at HOT gives: hc = 4 k k/(k + k) sqrt(pi a^2)."""
        mass = 4 / 3 * math.pi * RADIUS**3 * POWDER.density
        return 2 * CONDUCTIVITY * math.sqrt(math.pi) * a * (HOT - 300.0) * DT / (mass * CAPACITY)

    def test_law_area_on_walls(self):
        """`heatArea law`: the circle of the law's contact radius; by default LIGGGHTS's own, of the geometric overlap."""
        depth = 0.02  # overlap/R of a sphere that is set into the wall and not moved
        for model in ("mpm", "thornton"):
            cases = [(wall, more) for wall in ("primitive type 1 zplane 0.0", "mesh n_meshes 1 meshes cad") for more in ("", "heatArea law")]
            spheres = self.spheres([(1 - depth) * RADIUS]).replace("fix i all nve/sphere\n", "") + 'run 0\nrun 1\nprint "TEMP ${t}"\n'
            for (wall, more), (end,) in zip(cases, self.run_each((self.start(model, *case) + spheres for case in cases), "TEMP")):
                a = self.radius_of_law(model, depth) if more else RADIUS * math.sqrt(1 - (1 - depth)**2)
                # LIGGGHTS integrates with the flux of the step before: explicit, 1e-6 of the difference to the wall
                assert (end - 300.0) / self.conducted(a) == approx(1.0, abs=1e-5), f"{model} {wall} '{more}'"

    def test_heat_of_a_body_behind_the_contact(self):
        """A rigid body of two spheres set into a wall: `heatArea overlap` takes the circle of the geometric overlap under `bodyCompliance on`,
        too; `heatArea law` that of the overlap that the body leaves to the law, which is less."""
        depth, gained = 0.02, {}
        for body in ("off", "on"):
            for area in ("overlap", "law"):
                deck = (self.start("mpm", "primitive type 1 zplane 0.0", f"heatArea {area} bodyCompliance {body}") +
                        self.spheres([(1 - depth) * RADIUS]).replace("fix i all nve/sphere\n", "") +
                        f"create_atoms 1 single 0 {-1.1 * RADIUS!r} {(3 - depth) * RADIUS!r} units box\n"
                        f"set group all diameter {2 * RADIUS!r} density {POWDER.density}\nneigh_modify exclude group all all\n"
                        'fix hold all rigid single\nrun 0\nrun 1\nprint "TEMP ${t}"\n')
                gained[body, area] = self.result(self.run_deck(deck), "TEMP")[0] - 600.0
        assert gained["on", "overlap"] / gained["off", "overlap"] == approx(1.0, abs=1e-4)  # the step moves it by 1e-5 of the overlap
        ratio = gained["on", "law"] / gained["off", "law"]
        assert 0.9 < ratio < 0.999, ratio  # the radius goes as the root of the overlap, of which the body takes some per cent

    def test_stored_areas_are_means_over_the_contacts(self):
        """store_contact_data of three spheres in a row: the middle one's area is the mean of its two contacts'."""
        depths = 0.02, 0.005
        at = -(2 - depths[0]) * RADIUS, 0.0, (2 - depths[1]) * RADIUS
        deck = (head(half=20 * RADIUS) + properties([POWDER]) + THERMAL +
                f"pair_style gran model mpm tangential history {self.words('mpm', 'heatArea law')}\npair_coeff * *\n" +
                CONDUCTION.replace("\n", " store_contact_data yes\n") +
                "".join(f"create_atoms 1 single {x!r} 0 0 units box\n" for x in at) +
                f"set group all diameter {2 * RADIUS!r} density {POWDER.density}\ntimestep {DT!r}\n" +
                "".join(f"group g{k} id {k}\ncompute a{k} g{k} reduce sum f_contactAreaConduction\nvariable a{k} equal c_a{k}\n" for k in (1, 2, 3)) +
                "thermo_style custom step c_a1 c_a2 c_a3\nrun 0\nrun 1\n" 'print "AREAS ${a1} ${a2} ${a3}"\n')
        left, middle, right = self.result(self.run_deck(deck), "AREAS")
        for found, depth in ((left, depths[0]), (right, depths[1])):
            a = self.fixture("radius", self.law, "powder", "powder", RADIUS / 2, depth * RADIUS, depth * RADIUS, 0)[0]
            assert found / (math.pi * a * a) == approx(1.0, abs=1e-5)  # printed with six digits
        assert middle / (0.5 * (left + right)) == approx(1.0, abs=1e-5)

    def radius_of_law(self, model, depth):
        if model == "mpm":  # a rigid wall would have another: the wall here is deformable and of the same material
            return self.fixture("radius", self.law, "powder", "powder", RADIUS, depth * RADIUS, depth * RADIUS, 0)[0]
        return math.sqrt(RADIUS * depth * RADIUS)

    def test_law_area_between_spheres(self):
        """fix heat/gran/conduction between two spheres: the flux's ratio is that of the two radii."""
        depth, gained = 0.02, {}
        for model in ("mpm", "thornton"):
            for more in ("", "heatArea law"):
                for ranks in (1, 2):
                    deck = (head(half=20 * RADIUS) + properties([POWDER]) + THERMAL +
                            f"pair_style gran model {model} tangential history {self.words(model, more)}\npair_coeff * *\n" + CONDUCTION +
                            f"create_atoms 1 single {-(1 - depth / 2) * RADIUS!r} 0 0 units box\n"
                            f"create_atoms 1 single {(1 - depth / 2) * RADIUS!r} 0 0 units box\n"
                            f"set group all diameter {2 * RADIUS!r} density {POWDER.density}\ngroup hot id 1\n"
                            f"run 0\nset group all property/atom Temp 300.0\nset group hot property/atom Temp {HOT}\n"
                            f"timestep {DT!r}\ncompute t all reduce max f_Temp\nvariable t equal c_t\nthermo_style custom step c_t\n"
                            'run 0\nrun 1\nprint "TEMP ${t}"\n')
                    gained[model, more, ranks] = HOT - self.result(self.run_deck(deck, ranks=ranks), "TEMP")[0]
            geometric = math.sqrt(RADIUS**2 - ((1 - depth / 2) * RADIUS)**2)
            a = (self.fixture("radius", self.law, "powder", "powder", RADIUS / 2, depth * RADIUS, depth * RADIUS, 0)[0]
                 if model == "mpm" else math.sqrt(RADIUS / 2 * depth * RADIUS))
            assert gained[model, "heatArea law", 1] / gained[model, "", 1] == approx(a / geometric, abs=1e-5), model
            for more in ("", "heatArea law"):
                assert gained[model, more, 2] / gained[model, more, 1] == approx(1.0, abs=1e-12)
