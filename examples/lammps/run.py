#!/usr/bin/python3
"""LAMMPS: a bed of wax in a die is pressed and released. Makes the law, runs in.die with lmp-granulaw, draws die.png.

    run.py [-o out/lammps] [--ranks N]

Programs are those on the PATH, or of build/release."""
import argparse
import os
import pathlib
import shutil
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "common"))
import one_sentence  # noqa: E402, F401
import matplotlib  # noqa: E402
import numpy as np  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent


def program(name, folder):
    found = shutil.which(name) or str(HERE.parents[1] / "build/release" / folder / name)
    if not os.access(found, os.X_OK):
        sys.exit(f"run.py: no {name}; build it with LAMMPS (Debian: liblammps-dev)")
    return found


def main(argv=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--out", default="out/lammps")
    parser.add_argument("--ranks", type=int, default=1)
    args = parser.parse_args(argv)
    folder = pathlib.Path(args.out)
    folder.mkdir(parents=True, exist_ok=True)
    subprocess.run([program("mpm", "tools/mpm"), "table", HERE.parent / "hopper/materials.toml", "-o", "wax.h5"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    ranks = ["mpirun", "-np", str(args.ranks)] if args.ranks > 1 else []
    subprocess.run([*ranks, program("lmp-granulaw", "engines/lammps"), "-in", HERE / "in.die"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    way, plate, floor, stored, plastic, friction = np.loadtxt(folder / "plate.txt", skiprows=1).T
    way, plate = -1e3 * way, -plate
    _, (left, right) = plt.subplots(1, 2, figsize=(9, 3.4), layout="constrained")
    left.plot(way, plate, label="plate"), left.plot(way, floor, label="floor")
    left.set(xlabel="way of the plate, mm", ylabel="force, N", title="Down and up again")
    step = np.arange(len(way))
    for values, name in ((stored, "stored in contacts of spheres"), (plastic - plastic[0], "plastic work"), (friction - friction[0], "friction")):
        right.plot(step, 1e3 * values, label=name)
    right.set(xlabel="time, 0.5 ms", ylabel="energy, mJ", title="Where the work goes")
    for axes in (left, right):
        axes.legend(frameon=False)
    plt.savefig(folder / "die.png", dpi=90)
    most = int(np.argmax(plate))
    work = np.trapz(plate, way) * 1e-3
    print(f"largest force: plate {plate[most]:.4g} N, floor {floor[most]:.4g} N, {1 - floor[most] / plate[most]:.3f} of it carried by the die")
    print(f"work of the plate {work:.4g} J: plastic {plastic[-1] - plastic[0]:.4g} J, friction {friction[-1] - friction[0]:.4g} J")


if __name__ == "__main__":
    main()
