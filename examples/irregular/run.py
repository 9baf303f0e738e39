#!/usr/bin/python3
"""A hopper of irregular grains, each a clump of spheres, under stock Hertz, Thornton and the computed law of a sphere.

    run.py [-o out/irregular] [--ranks 2] [--count 60] [--fill 30000] [--flow 60000] [--orientations 30] [--quick]

Writes clump.h5, the clump's law with its certificate over orientations, and a map of it, orientations.png; then report.md:
spheres at the end (none may be lost), discharge rate, loop time over stock Hertz's, beside spheres of the grains' volume. A run
that is done is not made again."""
import argparse
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common"))
import one_sentence  # noqa: E402, F401
import numpy as np  # noqa: E402
from clump_hopper import DENSITY, add_options, clump_template, prepared, program, report, sphere_template

RADIUS = 3e-3  # m, of the sphere of the grain's volume: the scale of grain.stl and grain.clump


def corners_of_stl(path):
    record = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    return np.frombuffer(path.read_bytes()[84:], dtype=record)["corners"].astype(float)


def mass_and_inertia(corners):
    """Mass properties of the body inside the triangles, at DENSITY: a sum of tetrahedra about the origin, its centre of mass."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    parts = DENSITY * np.einsum("ij,ij->i", a, np.cross(b, c)) / 6
    second = sum(np.einsum("n,ni,nj->ij", parts, v, v) for v in (a, b, c, a + b + c)) / 20
    return parts.sum(), np.trace(second) * np.eye(3) - second


def certify(out, orientations):
    """Error of the law of spheres for the clump, hit from all around at 1 m/s; finished runs are not made again."""
    law = out / "clump.h5"
    subprocess.run([program("mpm"), "table", HERE / "materials.toml", "--pair", "clump:clump", "--pair", "clump:wall", "--orientations",
                    str(orientations), "--velocity", "1", "-o", law], check=True)
    subprocess.run([program("mpm"), "plot", law, "--shape", "clump", "-o", out / "orientations.png"], check=True)


def main(argv=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    add_options(parser, "out/irregular", 60, 30000, 60000)
    parser.add_argument("--orientations", type=int, default=30, help="of the certificate; 0: none")
    parser.add_argument("--quick", action="store_true", help="12 grains that fall through, one rank, no certificate")
    args = parser.parse_args(argv)
    if args.quick:
        args.count, args.fill, args.flow, args.ranks, args.orientations = 12, 2000, 40000, 1, 0
    prepared(args)
    if args.orientations:
        certify(args.out, args.orientations)
    spheres = [line for line in (HERE / "grain.clump").read_text().splitlines() if not line.startswith("#")]
    mass, inertia = mass_and_inertia(RADIUS * corners_of_stl(HERE / "grain.stl"))
    (args.out / "grains.template").write_text(
        clump_template(len(spheres), f"file {HERE / 'grain.clump'} scale {RADIUS}", mass, inertia))
    (args.out / "spheres.template").write_text(sphere_template(RADIUS))
    return report(args, {"grains": len(spheres), "spheres": 1})


if __name__ == "__main__":
    main()
