#!/usr/bin/python3
"""A hopper of clumps of three spheres under stock Hertz, Thornton and the computed law, beside spheres of the same volume.

    run.py [-o out/clumps] [--ranks 2] [--count 160] [--fill 80000] [--flow 200000]

Writes report.md: spheres at the end (none may be lost), discharge rate, loop time over stock Hertz's. A run that is done is not made again."""
import argparse
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "common"))
import one_sentence  # noqa: E402, F401
from clump_hopper import DENSITY, add_options, clump_template, prepared, report, sphere_template

RADIUS = 2.2e-3  # m, of the spheres of a clump


def three_spheres():
    """Three spheres that touch, with the mass and inertia of solid spheres."""
    side = 2.0002 * RADIUS
    centres = [(side / math.sqrt(3) * math.cos(a), side / math.sqrt(3) * math.sin(a), 0.0) for a in (0, 2 * math.pi / 3, 4 * math.pi / 3)]
    mass = 4 / 3 * math.pi * RADIUS**3 * DENSITY
    def moment(a, b):
        return sum(mass * ((0.4 * RADIUS**2 + sum(x * x for x in c)) * (a == b) - c[a] * c[b]) for c in centres)
    spheres = "  ".join(" ".join(f"{x:.9g}" for x in c) + f" {RADIUS}" for c in centres)
    return clump_template(3, spheres, 3 * mass, [[moment(a, b) for b in range(3)] for a in range(3)])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    add_options(parser, "out/clumps", 160, 80000, 200000)
    args = prepared(parser.parse_args())
    (args.out / "clumps.template").write_text(three_spheres())
    (args.out / "spheres.template").write_text(sphere_template(RADIUS * 3 ** (1 / 3)))
    report(args, {"clumps": 3, "spheres": 1})


if __name__ == "__main__":
    main()
