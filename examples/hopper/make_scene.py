#!/usr/bin/python3
"""Writes the scene of the hopper example: hopper.stl, outlet.stl and cloud.data.

    make_scene.py -o DIR [--particles 3000] [--radius 3e-3] [--seed 1] ...

The geometry (metres), axis z, orifice in the plane z = 0:

        |       |   cylinder, radius 0.050, up to the top of the cloud
        |       |
         \\     /    cone, half angle 30 degrees (--half-angle)
          \\___/     orifice, radius 0.024 (8 particle diameters across)

The particles are a random cloud at rest. Every model and every rank count reads the same cloud.data, so the
fillings differ only by their contact law.
"""
import argparse
import json
import math
import os
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "common"))
import one_sentence  # noqa: E402, F401
import numpy as np  # noqa: E402

FACETS = 48  # around the axis


def wall_points(orifice, cylinder, top, half_angle):
    """Profile (r, z) from the orifice to the top; spacing about the facet width, so that no triangle is thin."""
    cone_height = (cylinder - orifice) / math.tan(half_angle)
    width = 2.0 * math.pi * orifice / FACETS
    n_cone = max(1, round(cone_height / math.cos(half_angle) / (2.0 * width)))
    n_cylinder = max(1, round((top - cone_height) / (3.0 * width)))
    cone = [(orifice + (cylinder - orifice) * i / n_cone, cone_height * i / n_cone) for i in range(n_cone + 1)]
    return cone + [(cylinder, cone_height + (top - cone_height) * i / n_cylinder) for i in range(1, n_cylinder + 1)]


def ring(r, z):
    phi = 2.0 * np.pi * np.arange(FACETS) / FACETS
    return np.column_stack([r * np.cos(phi), r * np.sin(phi), np.full(FACETS, z)])


def write_stl(path, name, triangles):
    with open(path, "w") as out:
        out.write(f"solid {name}\n")
        for a, b, c in triangles:
            normal = np.cross(b - a, c - a)
            normal /= np.linalg.norm(normal)
            out.write("facet normal %.9g %.9g %.9g\nouter loop\n" % tuple(normal))
            for p in (a, b, c):
                out.write("vertex %.9g %.9g %.9g\n" % tuple(p))
            out.write("endloop\nendfacet\n")
        out.write(f"endsolid {name}\n")


def wall_triangles(profile):
    rings = [ring(r, z) for r, z in profile]
    for low, high in zip(rings, rings[1:]):
        for i in range(FACETS):
            j = (i + 1) % FACETS
            yield low[i], low[j], high[j]
            yield low[i], high[j], high[i]


def square(half, z):
    a, b, c, d = (np.array([x, y, z]) for x, y in ((-half, -half), (half, -half), (half, half), (-half, half)))
    return [(a, b, c), (a, c, d)]


def random_cloud(count, radius, orifice, cylinder, half_angle, bottom, packing, rng):
    """Centres placed one by one at random, clear of each other and of the walls (random sequential addition)."""
    def free(z):  # distance from the axis that a centre at height z may have
        cone = orifice + z * math.tan(half_angle) - 1.05 * radius / math.cos(half_angle)
        return min(cone, cylinder - 1.1 * radius)

    height, volume, slice_height = 0.0, 0.0, 0.1 * radius
    while volume < count * 4.0 / 3.0 * math.pi * radius**3 / packing:
        volume += math.pi * max(free(bottom + height), 0.0) ** 2 * slice_height
        height += slice_height
    cell = 2.0 * radius
    cells = {}
    centres = np.empty((count, 3))
    widest = cylinder - 1.1 * radius
    n = 0
    while n < count:
        p = rng.uniform([-widest, -widest, bottom], [widest, widest, bottom + height])
        if math.hypot(p[0], p[1]) > free(p[2]):
            continue
        key = tuple((p // cell).astype(int))
        near = (q for dx in (-1, 0, 1) for dy in (-1, 0, 1) for dz in (-1, 0, 1)
                for q in cells.get((key[0] + dx, key[1] + dy, key[2] + dz), ()))
        if any(np.sum((p - q) ** 2) < (2.02 * radius) ** 2 for q in near):
            continue
        cells.setdefault(key, []).append(p)
        centres[n] = p
        n += 1
    return centres, bottom + height


def write_data(path, centres, radius, density, box):
    with open(path, "w") as out:
        out.write(f"LIGGGHTS data file: the cloud that fills the hopper\n\n{len(centres)} atoms\n2 atom types\n\n")
        for lo_hi, axis in zip(box, "xyz"):
            out.write(f"{lo_hi[0]:.9g} {lo_hi[1]:.9g} {axis}lo {axis}hi\n")
        out.write("\nAtoms\n\n")
        for i, p in enumerate(centres, 1):  # id, type, diameter, density, x, y, z
            out.write(f"{i} 1 {2 * radius:.9g} {density:.9g} {p[0]:.9g} {p[1]:.9g} {p[2]:.9g}\n")


def main():
    parser = argparse.ArgumentParser(description="Write the hopper example's mesh and particle cloud.")
    parser.add_argument("-o", "--out", required=True, metavar="DIR")
    parser.add_argument("--particles", type=int, default=3000)
    parser.add_argument("--radius", type=float, default=3e-3, help="of a particle, m")
    parser.add_argument("--density", type=float, default=920.0, help="of a particle, kg/m^3: as in materials.toml")
    parser.add_argument("--orifice", type=float, default=24e-3, help="radius of the orifice, m")
    parser.add_argument("--cylinder", type=float, default=50e-3, help="radius of the cylinder, m")
    parser.add_argument("--half-angle", type=float, default=30.0, help="of the cone, degrees from the axis")
    parser.add_argument("--drop", type=float, default=60e-3, help="lowest height of the cloud over the orifice, m")
    parser.add_argument("--packing", type=float, default=0.25, help="solid fraction of the cloud")
    parser.add_argument("--seed", type=int, default=1)
    args = parser.parse_args()
    if args.particles < 1 or min(args.radius, args.density, args.drop) <= 0 or not 0 < args.packing <= 0.3:
        parser.error("particles, radius, density and drop must be positive and packing in (0, 0.3]")
    if not 5 <= args.half_angle <= 80:
        parser.error(f"--half-angle {args.half_angle} must be 5 to 80 degrees")
    if not args.orifice < args.cylinder:
        parser.error(f"--orifice {args.orifice} must be below --cylinder {args.cylinder}")

    os.makedirs(args.out, exist_ok=True)
    rng = np.random.default_rng(args.seed)
    half_angle = math.radians(args.half_angle)
    centres, top = random_cloud(args.particles, args.radius, args.orifice, args.cylinder, half_angle, args.drop,
                                args.packing, rng)
    wall_top = top + 5 * args.radius
    outlet = -10 * args.radius  # the plane where particles are counted and removed
    half = 1.2 * args.cylinder
    write_stl(os.path.join(args.out, "hopper.stl"), "hopper",
              wall_triangles(wall_points(args.orifice, args.cylinder, wall_top, half_angle)))
    write_stl(os.path.join(args.out, "outlet.stl"), "outlet", square(0.99 * half, outlet))
    write_data(os.path.join(args.out, "cloud.data"), centres, args.radius, args.density,
               [(-half, half), (-half, half), (outlet - 20 * args.radius, wall_top)])
    scene = dict(vars(args), half_angle_deg=args.half_angle, cloud_top=top, outlet=outlet,
                 mass=args.particles * args.density * 4.0 / 3.0 * math.pi * args.radius**3)
    del scene["out"]
    with open(os.path.join(args.out, "scene.json"), "w") as out:
        json.dump(scene, out, indent=1)
    print(f"{args.particles} particles, {scene['mass']:.3f} kg, cloud from {args.drop:.3f} to {top:.3f} m: {args.out}")


if __name__ == "__main__":
    main()
