"""Walls: primitive and mesh, rigid and deformable, the history of a contact that slides over a seam."""
from pytest import approx, mark
from collisions import wall_deck
from harness import GLASS, POWDER, Deck, head, plane_stl, properties, sphere_mass

RADIUS = 1.7e-3
MESH = "fix cad all mesh/surface file plane.stl type 1\n"
ON_MESH = "mesh n_meshes 1 meshes cad"


class TestWalls(Deck):
    def prepare(self):
        (self.folder / "plane.stl").write_text(plane_stl())

    @mark.parametrize("model", ("mpm", "thornton"))
    def test_mesh_equals_primitive(self, model):
        words = f"law {self.law} materials powder" if model == "mpm" else ""
        ways = [{"tangential": tangential, **wall} for tangential in ("history", "no_history", "off") for wall in ({}, {"wall": ON_MESH, "before_wall": MESH})]
        speeds = [speed for speed, in self.run_each((wall_deck(model, words, POWDER, RADIUS, 1.0, 2e-7, **way) for way in ways), "SPEED")]
        # the same arithmetic but for the distance to the wall: rounding of 1e-16 R against an overlap of 1e-2 R
        assert [mesh / primitive for primitive, mesh in zip(speeds[::2], speeds[1::2])] == approx([1.0] * 3, abs=1e-9)

    def test_wall_of_another_type(self):
        """A rigid wall's material needs no law of its own; a mesh wall takes its type from the mesh."""
        deck = (head(types=2, half=20 * RADIUS) + properties([POWDER, GLASS]) +
                f"pair_style gran model mpm tangential history law {self.law} materials powder steel\npair_coeff * *\n"
                "fix cad all mesh/surface file plane.stl type 2\n"
                f"fix w all wall/gran model mpm tangential history {ON_MESH}\n"
                f"create_atoms 1 single {RADIUS} 0.0 {1.0001 * RADIUS} units box\n"
                f"set group all diameter {2 * RADIUS} density {POWDER.density}\nvelocity all set 0.0 0.0 -1.0\n"
                "fix i all nve/sphere\ntimestep 2e-7\nvariable v equal vcm(all,z)\nrun 150\n"
                'print "SPEED ${v}"\n')
        expected = self.fixture("mpm", self.law, "powder", "wall", RADIUS, sphere_mass(RADIUS, POWDER.density), 1.0)[0]
        assert self.result(self.run_deck(deck), "SPEED")[0] / expected == approx(1.0, abs=0.01)

    def slide(self, wall, before_wall, start):
        """Pressed on and sliding without friction along the seam's normal; the plastic dent travels with the contact."""
        depth = 0.01 * RADIUS
        return (head(half=20 * RADIUS) + properties([POWDER]) +
                f"pair_style gran model mpm tangential history law {self.law} materials powder\npair_coeff * *\n"
                f"{before_wall}fix w all wall/gran model mpm tangential history {wall}\n"
                f"create_atoms 1 single {start * RADIUS} 0.0 {RADIUS - depth} units box\n"
                f"set group all diameter {2 * RADIUS} density {POWDER.density}\n"
                f"velocity all set 40.0 0.0 0.0\nfix i all nve/sphere\ntimestep 2e-7\n"
                'variable v equal vcm(all,z)\nvariable x equal xcm(all,x)\nrun 25\nprint "SPEED ${v} ${x}"\n')

    def test_history_crosses_a_coplanar_seam(self):
        """Crossing the seam x = y while unloading changes nothing against a wall without a seam."""
        start = -0.03  # crosses x = 0 (on y = 0) after 6 of the 25 steps
        mesh, plane = self.run_each((self.slide(ON_MESH, MESH, start), self.slide("primitive type 1 zplane 0.0", "", start)), "SPEED")
        assert start < 0
        assert mesh[1] > 0  # it did cross
        assert mesh[0] / plane[0] == approx(1.0, abs=1e-9)  # rounding of the distance, as above
