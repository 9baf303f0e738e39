"""Meshes that are flat, split, curved, squeezed or ridged: what a contact feels where triangles meet (test_collisions.py: e on meshes)."""
import math

from pytest import mark
from harness import POWDER, Deck, dump, head, properties, worst

RADIUS = 1.7e-3
DT = 2e-7
MODELS = ("mpm", "thornton")
MESH = "fix cad all mesh/surface file wall.stl type 1\n"
ON_MESH = "mesh n_meshes 1 meshes cad"
PLANE = "primitive type 1 zplane 0.0"


def stl(triangles):
    """Each triangle three points, seen counter-clockwise from its free side."""
    text = "solid s\n"
    for triangle in triangles:
        (a, b, c) = triangle
        u, v = [q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)]
        n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        size = math.sqrt(sum(x * x for x in n))
        text += "facet normal {:.9g} {:.9g} {:.9g}\nouter loop\n".format(*(x / size for x in n))
        text += "".join("vertex {:.9g} {:.9g} {:.9g}\n".format(*p) for p in triangle) + "endloop\nendfacet\n"
    return text + "endsolid s\n"


def strip(count, pitch, half):
    """`count` coplanar triangles along x at z = 0, centred on x = 0."""
    triangles, x0 = [], -count / 2 * pitch
    for k in range(count):
        a, b = x0 + k * pitch, x0 + (k + 2) * pitch
        m = x0 + (k + 1) * pitch
        low, high = (-half, half) if k % 2 == 0 else (half, -half)
        triangle = [(a, low, 0.0), (b, low, 0.0), (m, high, 0.0)]
        triangles.append(triangle if k % 2 == 0 else triangle[::-1])
    return triangles


def trough(radius, facets, half, low=-60.0, high=60.0):
    """A cylinder about y at z = radius, lowest point at the origin; `facets` flat strips from `low` to `high` degrees."""
    triangles = []
    def point(k, y):
        angle = math.radians(low + (high - low) * k / facets)
        return (radius * math.sin(angle), y, radius * (1 - math.cos(angle)))
    for k in range(facets):
        a, b, c, d = point(k, -half), point(k + 1, -half), point(k + 1, half), point(k, half)
        triangles += [(a, b, c), (a, c, d)]
    return triangles


@mark.parametrize("model", MODELS)
class Geometry(Deck):
    def words(self, model):
        return {"mpm": f"law {self.law} materials powder elasticDamping off", "thornton": "elasticDamping off"}[model]

    def wall(self, model, wall, name="w"):
        return f"fix {name} all wall/gran model {model} tangential history {wall}\n"

    def pair(self, model, friction=0.0, more=""):
        return (head(half=20 * RADIUS) + properties([POWDER], friction) +
                f"pair_style gran model {model} tangential history {self.words(model)} {more}\npair_coeff * *\n")

    def sphere(self, x, v, spin=0.0):
        return ("create_atoms 1 single {!r} {!r} {!r} units box\n".format(*x) + f"set group all diameter {2 * RADIUS!r} density {POWDER.density}\n" +
                "velocity all set {!r} {!r} {!r}\n".format(*v) + f"set group all omegay {spin!r}\nfix i all nve/sphere\ntimestep {DT!r}\nthermo 100000\n")

    def write(self, triangles):
        (self.folder / "wall.stl").write_text(stl(triangles))


class TestFlat(Geometry):
    def check(self, model, triangles, x, v, spin, friction):
        """Forces at every step on the mesh and on a plane without seams; pressed on by 2 N, which dents the sphere by 1e-3 R."""
        self.write(triangles)
        press, run = "fix push all addforce 0.0 0.0 -2.0\n", f"run {int(-2.2 * x[0] / v[0] / DT)}\n"
        self.run_deck("clear\n".join(self.pair(model, friction) + before + self.wall(model, wall) + self.sphere(x, v, spin) + press + dump("x fx fz", name=name) + run
                                     for name, wall, before in (("mesh", ON_MESH, MESH), ("plane", PLANE, ""))))
        mesh, plane = ([next(iter(frame.values())) for frame in self.frames(f"{name}.dump")] for name in ("mesh", "plane"))
        assert mesh[-1][0] > -x[0]  # crossed all of it
        biggest = max(abs(row[2] + 2.0) for row in plane)
        assert biggest > 1.0
        # vertices are read at 9 digits and z = 0 exactly: only rounding of the distance is left, 1e-16 R against
        # an overlap of 1e-3 R, carried through the oscillation of the contact
        assert worst(abs(a[c] - b[c]) for a, b in zip(mesh, plane) for c in (1, 2)) / biggest < 1e-9

    def test_sphere_rolls_over_the_edge(self, model):
        a, b, c, d = (-0.02, -0.02, 0.0), (0.02, -0.02, 0.0), (0.02, 0.02, 0.0), (-0.02, 0.02, 0.0)
        self.check(model, [(a, b, c), (a, c, d)], (-0.6 * RADIUS, 0.1 * RADIUS, RADIUS * 0.999), (10.0, 0.0, 0.0), 10.0 / RADIUS, 0.3)

    def test_contact_slides_over_ten_triangles(self, model):
        pitch = 0.4 * RADIUS
        self.check(model, strip(10, pitch, 3 * RADIUS), (-2.5 * pitch, 0.0, RADIUS * 0.999), (20.0, 0.0, 0.0), 0.0, 0.2)

    def test_squeezed_between_two_walls(self, model):
        """A floor and a lid that comes down at 0.5 m/s: no step changes the force by more than its stiffness allows."""
        self.write([tuple(reversed(t)) for t in strip(6, 3 * RADIUS, 6 * RADIUS)])
        speed, steps = 0.5, 1000
        # mesh wall: only one mesh fix wall/gran per run; the floor is a primitive
        self.run_deck(self.pair(model) + f"fix cad all mesh/surface file wall.stl type 1 move 0. 0. {2 * RADIUS!r}\nfix m all move/mesh mesh cad linear 0. 0. {-speed!r}\n" +
                      self.wall(model, PLANE, "floor") + self.wall(model, ON_MESH, "lid") + self.sphere((0.1 * RADIUS, 0.2 * RADIUS, RADIUS), (0.0, 0.0, 0.0)) + dump("z fz") + f"run {steps}\n")
        rows = [next(iter(frame.values())) for frame in self.frames()]
        down, moved = speed * steps * DT, RADIUS - rows[-1][0]
        # 2 sqrt(R d) E* is the most that dF/dd can be; both walls move against the sphere by at most 2 speeds a step
        limit = 2 * 2 * POWDER.e_star * math.sqrt(RADIUS * down / 2) * 2 * speed * DT
        assert worst(abs(b[1] - a[1]) for a, b in zip(rows, rows[1:])) < limit
        assert 0.3 * down < moved < 0.7 * down  # in the middle but for its own oscillation


class TestCurved(Geometry):
    def test_no_more_virgin_contacts_than_facets(self, model):
        """A sphere rolls down a trough of flat strips: stock geometry hands history on between coplanar triangles only."""
        big, facets = 12 * RADIUS, 60
        self.write(trough(big, facets, 4 * RADIUS))
        speed, steps, angle = 20.0, 4000, math.radians(-50)
        at = big - RADIUS * 0.999
        x, v = (at * math.sin(angle), 0.3 * RADIUS, big - at * math.cos(angle)), (speed * math.cos(angle), 0.0, speed * math.sin(angle))
        text = self.run_deck(self.pair(model, 0.3) + MESH + self.wall(model, ON_MESH) + self.sphere(x, v) + dump("x z", steps) + f"run {steps}\n"
                             'variable n equal f_granulaw[4]\nprint "BEGAN ${n}"\n')
        (counted,), end = self.result(text, "BEGAN"), next(iter(self.last_frame().values()))
        turned = math.degrees(math.atan2(end[0], big - end[1]) - angle)
        assert turned > 20
        assert 0 < counted <= turned / (120 / facets) + 2  # one for each strip passed, and the two it starts and ends on


class TestRidge(Geometry):
    def test_what_a_convex_edge_adds_is_named(self, model):
        """A sphere, pressed by 2 N without friction, slides at 10 m/s over the ridge between two planes. LIGGGHTS gives the edge to one of its two triangles: from that
        one to the other, the sphere begins a contact at full depth beside the one that it has. The statistics name the energy that it brings."""
        press, speed, far, decks = 2.0, 10.0, 0.6 * RADIUS, []
        for degrees in (0.5, 1.0, 2.0):  # over a steeper ridge it flies
            slope = math.radians(degrees) / 2
            c, s, wide = math.cos(slope), math.sin(slope), 6 * RADIUS
            left = [(-wide * c, -wide, -wide * s), (0.0, -wide, 0.0), (0.0, wide, 0.0), (-wide * c, wide, -wide * s)]
            right = [(0.0, -wide, 0.0), (wide * c, -wide, -wide * s), (wide * c, wide, -wide * s), (0.0, wide, 0.0)]
            (self.folder / f"{degrees}.stl").write_text(stl([t for a, b, c_, d in (right, left) for t in ((a, b, c_), (a, c_, d))]))
            # overlap at which Hertz's force balances the press; the sphere starts there, above the left plane
            delta = (press * c / (4 / 3 * POWDER.e_star * math.sqrt(RADIUS)))**(2 / 3)
            at = RADIUS - delta
            x, z = -far * c - at * s, -far * s + at * c
            # kinetic energy + height under the press + what contacts hold + what they dissipated, J; contacts that began overlapping, and what they brought
            show = f'variable e equal ke+{press}*xcm(all,z)+f_granulaw[14]+f_granulaw\nvariable n equal f_granulaw[17]\nvariable b equal f_granulaw[18]\n'
            said = f'print "AT ${{e}} ${{n}} ${{b}} {0.4 * press * delta!r}"\n'
            decks.append(self.pair(model, more="energy on tangential_damping off") + MESH.replace("wall.stl", f"{degrees}.stl") + self.wall(model, ON_MESH) +
                         self.sphere((x, 0.13 * RADIUS, z), (speed * c, 0.0, speed * s)) + f"fix push all addforce 0.0 0.0 {-press}\n{show}"
                         f"thermo_style custom step ke f_granulaw\nthermo_modify norm no\nrun 2\n{said}run {int(2 * far / speed / DT)}\n{said}")
        rows = self.results(self.run_deck("clear\n".join(decks)), "AT")
        assert len(rows) == 6
        for before, after in zip(rows[::2], rows[1::2]):
            gained, begun, brought, one = (b - a if k < 3 else a for k, (a, b) in enumerate(zip(before, after)))
            assert begun >= 1
            # nothing is gained that the contact statistics does not name; what vanishes at full depth is lost
            assert gained < brought + 0.05 * one, (gained / one, brought / one)
