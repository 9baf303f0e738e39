#!/usr/bin/python3
"""Speeds at which clouds of several sizes and densities hit the floor, beside those that `mpm plan` gives (docs/guide/plan.md).

    floor.py [-o out/floor] [--quick]     # model thornton, wax and elastic; ten runs of 0.4 s

Prints the table; finished runs are kept."""
import argparse
import json
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent / "common"), str(HERE.parent)]
import one_sentence  # noqa: E402, F401
import numpy as np  # noqa: E402
import clouds, planned, sweep  # noqa: E401, E402
from run import DENSITY, RADIUS  # noqa: E402

DT = 6e-6
# spheres, side in diameters, solid fraction of the cloud, seed, yield stress, Pa: 1e12 never yields
CLOUDS = ((2000, 10, 0.25, 1, 1e6), (2000, 10, 0.25, 3, 1e6), (500, 6, 0.25, 1, 1e6), (300, 8, 0.05, 1, 1e6), (300, 8, 0.05, 2, 1e6),
          (100, 8, 0.01, 1, 1e6), (100, 8, 0.01, 2, 1e6), (500, 6, 0.25, 1, 1e12), (300, 8, 0.05, 1, 1e12), (100, 8, 0.01, 1, 1e12))


def main(argv=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("-o", "--out", type=pathlib.Path, default=pathlib.Path("out/floor"))
    parser.add_argument("--quick", action="store_true", help="the two smallest clouds")
    args = parser.parse_args(argv)
    args.ranks, args.stretch, rows = 1, 1.0, []
    print("| spheres | side, diameters | solid fraction | seed | Y, Pa | fall, m/s | planned | visited | ratio |\n|---|---|---|---|---|---|---|---|---|")
    for count, wide, fraction, seed, stress in [c for c in CLOUDS if not args.quick or c[0] == 100 and c[3] == 1]:
        side = 2 * RADIUS * wide
        top = 4 * RADIUS + count * 4 / 3 * np.pi * RADIUS**3 / (fraction * side**2)
        scene = args.out / f"scene-{count}-{wide}-{fraction:g}-{seed}"
        scene.mkdir(parents=True, exist_ok=True)
        centres = clouds.random_cloud(count, RADIUS, (0, 0, 3 * RADIUS), (side, side, top), np.random.default_rng(seed), (True, True, False))
        clouds.write_data(scene / "cloud.data", centres, RADIUS, DENSITY, (0, 0, -RADIUS), (side, side, 2 * (top + RADIUS)))
        done = sweep.run(args, HERE / "in.packing", "thornton", args.out / f"{scene.name[6:]}-{stress:g}", [scene / "cloud.data"],
                         variables={"scene": scene, "dt": DT, "steps": round(0.4 / DT), "Y": stress})
        bound, plan = planned.planned(done)
        fall, seen = np.sqrt(2 * 9.81 * plan["fall_m"]), planned.visited([done])["wall"]
        rows.append(bound["wall"] / seen)
        print(f"| {count} | {wide} | {fraction:g} | {seed} | {stress:g} | {fall:.2f} | {bound['wall']:.2f} | {seen:.2f} | {rows[-1]:.2f} |", flush=True)
    return rows


if __name__ == "__main__":
    main()
