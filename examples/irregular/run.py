#!/usr/bin/python3
"""A hopper of irregular grains, each a clump of spheres, under stock Hertz, Thornton and the computed law of a sphere.

    run.py [-o out/irregular] [--ranks 2] [--count 60] [--fill 30000] [--flow 60000] [--quick]

Writes report.md: spheres at the end (none may be lost), discharge rate, loop time over stock Hertz's, beside spheres of the
grains' volume. A run that is done is not made again."""
import argparse
import pathlib
import sys

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common"))
from clump_hopper import DENSITY, add_options, clump_template, prepared, report, sphere_template

RADIUS = 3e-3  # m, of the sphere of the grain's volume: the scale of grain.stl and grain.clump


def corners_of_stl(path):
    record = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    return np.frombuffer(path.read_bytes()[84:], dtype=record)["corners"].astype(float)


def mass_and_inertia(corners):
    """Of the body inside the triangles, at DENSITY: a sum of tetrahedra about the origin, its centre of mass."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    parts = DENSITY * np.einsum("ij,ij->i", a, np.cross(b, c)) / 6
    second = sum(np.einsum("n,ni,nj->ij", parts, v, v) for v in (a, b, c, a + b + c)) / 20
    return parts.sum(), np.trace(second) * np.eye(3) - second


def main(argv=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    add_options(parser, "out/irregular", 60, 30000, 60000)
    parser.add_argument("--quick", action="store_true", help="12 grains that fall through, one rank")
    args = parser.parse_args(argv)
    if args.quick:
        args.count, args.fill, args.flow, args.ranks = 12, 2000, 40000, 1
    prepared(args)
    spheres = [line for line in (HERE / "grain.clump").read_text().splitlines() if not line.startswith("#")]
    mass, inertia = mass_and_inertia(RADIUS * corners_of_stl(HERE / "grain.stl"))
    (args.out / "grains.template").write_text(
        clump_template(len(spheres), f"file {HERE / 'grain.clump'} scale {RADIUS}", mass, inertia))
    (args.out / "spheres.template").write_text(sphere_template(RADIUS))
    return report(args, {"grains": len(spheres), "spheres": 1})


if __name__ == "__main__":
    main()
