#!/usr/bin/python3
"""MPI efficiency of the silo's discharge beside stock Hertz's, by runs in turn on 1 and 2 ranks.

    ranks.py RUNS [-o out/silo-ranks] [--steps 1000] [--rounds 3]

RUNS: what run.py left (seed 1, 1 rank) of the models. The spheres start where they were when it opened the orifice (first dump after the start, at
their speeds, contacts anew), stand --steps steps with it closed and flow as many more, which are timed. Writes ranks.csv and prints a table; what it
needs and means: examples/common/ranks.py."""
import json
import pathlib
import shutil
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common"))
import one_sentence  # noqa: E402, F401
import numpy as np  # noqa: E402
import clouds, ranks, readings  # noqa: E401, E402


def main(argv=None):
    args = ranks.options(__doc__, "out/silo-ranks", 1000).parse_args(argv)
    scene = json.loads((args.runs / "scene-1/scene.json").read_text())
    high = 1.2 * scene["cylinder"]

    def settled(model, folder):
        run = args.runs / f"{model}-1-ranks1"
        steps = [s for s in readings.dump_steps(run) if s > 0]
        if not steps:
            raise SystemExit(f"{run}: no dump of the filled silo; run.py leaves it")
        bed = readings.dump(run, steps[0])
        for mesh in ("hopper.stl", "outlet.stl"):
            shutil.copy(args.runs / "scene-1" / mesh, folder)
        clouds.write_data(folder / "cloud.data", np.column_stack([bed[c] for c in "xyz"]), scene["radius"], scene["density"],
                          (-high, -high, scene["outlet"] - 20 * scene["radius"]), (high, high, scene["cloud_top"] + 5 * scene["radius"]),
                          np.column_stack([bed[f"v{c}"] for c in "xyz"]))
        return {"common": HERE.parent / "common", "scene": folder, "law": args.runs / "law.h5", "fill": args.steps, "flow": args.steps,
                "every": 10**9, "pictures": 10**9}

    return ranks.in_turn(args, HERE / "in.silo", settled)


if __name__ == "__main__":
    main()
