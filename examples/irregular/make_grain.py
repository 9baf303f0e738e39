#!/usr/bin/python3
"""Makes a random grain: a closed triangle mesh, and a clump of spheres for it (LIGGGHTS's multisphere file).

    make_grain.py [-o FOLDER] [--seed 3] [--roughness 0.12] [--spheres 12]

Writes grain.stl (binary) and grain.clump (lines of x y z r), both with the centre of mass in the origin and the volume of a
sphere of radius 1: `scale` says the size. The grain.* beside this script are those of the defaults.

The surface is r(n) = 1 + sum over degrees l = 2 to 8 of random spherical harmonics, of amplitude falling as l^-1.5: each
degree is a sum of Legendre polynomials P_l(n.k) about random axes k. The clump's spheres touch the surface from inside:
of the largest ones at every vertex, those that bring the most vertices within a twentieth of the radius, one by one."""
import argparse
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.append(str(HERE.parent / "common"))
import one_sentence  # noqa: E402, F401
import numpy as np  # noqa: E402


def icosphere(halvings):
    """Vertices on the unit sphere, and triangles counter-clockwise seen from outside."""
    golden = (1 + 5**0.5) / 2
    corners = [(-1, golden, 0), (1, golden, 0), (-1, -golden, 0), (1, -golden, 0), (0, -1, golden), (0, 1, golden), (0, -1, -golden),
               (0, 1, -golden), (golden, 0, -1), (golden, 0, 1), (-golden, 0, -1), (-golden, 0, 1)]
    vertices = [np.array(c) / np.linalg.norm(c) for c in corners]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2), (10, 7, 6), (7, 1, 8),
             (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)]
    for _ in range(halvings):
        middles = {}
        def middle(a, b):
            key = (min(a, b), max(a, b))
            if key not in middles:
                middles[key] = len(vertices)
                between = vertices[a] + vertices[b]
                vertices.append(between / np.linalg.norm(between))
            return middles[key]
        faces = [t for a, b, c in faces for ab, bc, ca in [(middle(a, b), middle(b, c), middle(c, a))]
                 for t in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))]
    return np.array(vertices), np.array(faces)


def random_radius(directions, seed, roughness):
    random = np.random.default_rng(seed)
    radius = np.ones(len(directions))
    for degree in range(2, 9):
        axes = random.normal(size=(64, 3))
        axes /= np.linalg.norm(axes, axis=1)[:, None]
        weights = random.normal(size=64) / 8
        amplitude = roughness * (degree / 2) ** -1.5 * np.sqrt(2 * degree + 1)
        radius += amplitude * np.polynomial.legendre.Legendre.basis(degree)(directions @ axes.T) @ weights
    return radius


def volume_and_centre(vertices, faces):
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    parts = np.einsum("ij,ij->i", a, np.cross(b, c)) / 6
    return parts.sum(), (parts[:, None] * (a + b + c) / 4).sum(axis=0) / parts.sum()


def grain(seed, roughness):
    directions, faces = icosphere(3)
    vertices = directions * random_radius(directions, seed, roughness)[:, None]
    volume, centre = volume_and_centre(vertices, faces)
    return (vertices - centre) * (4 * np.pi / 3 / volume) ** (1 / 3), faces


def normals_of(vertices, faces):
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    across = np.cross(b - a, c - a)
    normals = np.zeros_like(vertices)
    for k in range(3):
        np.add.at(normals, faces[:, k], across)
    return normals / np.linalg.norm(normals, axis=1)[:, None]


def inscribed_spheres(vertices, normals):
    """At each vertex p of normal n the largest sphere that touches it and holds no other vertex q: its radius is the least
    |p - q|^2/(2 n.(p - q))."""
    apart = vertices[:, None] - vertices[None]
    along = np.einsum("ik,ijk->ij", normals, apart)
    with np.errstate(divide="ignore", invalid="ignore"):
        radii = np.where(along > 1e-9, (apart**2).sum(axis=2) / (2 * along), np.inf).min(axis=1)
    return vertices - radii[:, None] * normals, radii


def clump(vertices, faces, count, least_radius=0.25, tolerance=0.05):
    centres, radii = inscribed_spheres(vertices, normals_of(vertices, faces))
    large = radii >= least_radius
    centres, radii = centres[large], radii[large]
    gaps = np.linalg.norm(vertices[None] - centres[:, None], axis=2) - radii[:, None]
    chosen, left = [], np.full(len(vertices), np.inf)
    for _ in range(count):
        # Number of vertices that come within the tolerance, and the distance by which all come nearer.
        best = max(range(len(radii)), key=lambda k: ((gaps[k] < tolerance) & (left >= tolerance)).sum() + np.minimum(
            left, 1).sum() - np.minimum(np.minimum(left, gaps[k]), 1).sum())
        chosen.append(best)
        left = np.minimum(left, gaps[best])
    return centres[chosen], radii[chosen], left


def write_stl(path, vertices, faces):
    vertices = vertices.astype("<f4")
    record = np.zeros(len(faces), dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    record["corners"] = vertices[faces]
    path.write_bytes(b"grain of make_grain.py".ljust(80) + np.uint32(len(faces)).tobytes() + record.tobytes())


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("-o", "--out", type=pathlib.Path, default=HERE)
    parser.add_argument("--seed", type=int, default=3)
    parser.add_argument("--roughness", type=float, default=0.12)
    parser.add_argument("--spheres", type=int, default=12)
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    vertices, faces = grain(args.seed, args.roughness)
    write_stl(args.out / "grain.stl", vertices, faces)
    centres, radii, left = clump(vertices, faces, args.spheres)
    lines = [f"# {len(radii)} spheres for grain.stl, by make_grain.py: x y z r"]
    lines += [" ".join(f"{x:.6f}" for x in (*c, r)) for c, r in zip(centres, radii)]
    (args.out / "grain.clump").write_text("\n".join(lines) + "\n")
    print(f"{len(faces)} triangles; {len(radii)} spheres of {radii.min():.2f} to {radii.max():.2f}; the surface lies outside of them by "
          f"{left.mean():.3f} on average, {left.max():.3f} at most")


if __name__ == "__main__":
    main()
