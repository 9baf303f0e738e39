#!/usr/bin/python3
"""MPI efficiency of the filled hopper's flow beside stock Hertz's, by runs in turn on 1 and 2 ranks.

    ranks.py RUNS [-o out/ranks] [--steps 400] [--rounds 3]

RUNS holds scene/ and MODEL/filled.restart of the models, as tools/demo leaves them, and the law wax.h5. Writes ranks.csv and prints a table;
what it needs and means: examples/common/ranks.py."""
import pathlib
import shutil
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common"))
import one_sentence  # noqa: E402, F401
import ranks  # noqa: E402


def main(argv=None):
    args = ranks.options(__doc__, "out/ranks", 400).parse_args(argv)

    def filled(model, folder):
        shutil.copy(args.runs / model / "filled.restart", folder)
        return {"scene": args.runs / "scene", "law": args.runs / "wax.h5", "refill": 0, "flow": args.steps, "every": 10**9, "pictures": 10**9}

    return ranks.in_turn(args, HERE / "in.hopper", filled)


if __name__ == "__main__":
    main()
