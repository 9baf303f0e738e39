#!/usr/bin/python3
"""MPI efficiency of the filled hopper's flow beside stock Hertz's, by runs in turn on 1 and 2 ranks.

    ranks.py RUNS [-o out/ranks] [--steps 400] [--rounds 3]

RUNS holds scene/ and MODEL/filled.restart of the models, as tools/demo leaves them, and the law wax.h5. Writes ranks.csv and prints a table.
Efficiency: seconds on 1 rank / (2 x seconds on 2 ranks), of the same round. It needs two idle cores: where others compute too, a rank waits for
the other's turn, and burns CPU while it waits. What no load changes is the share of the work: particles of the fuller rank over the mean bound the
efficiency, and each rank computes its pairs with the ghosts itself."""
import argparse
import csv
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common"))
import sweep  # noqa: E402
from spread import Sample  # noqa: E402


def one(args, model, ranks, folder):
    """(wall-clock s of the loop, CPU s of all ranks, processor grid, mean over largest number of particles a rank, ghosts/particles)."""
    launcher = sweep.program("liggghts" if model == "hertz" else "liggghts-mpm")
    command = ["mpirun", "--oversubscribe", "-np", str(ranks), launcher, "-in", str(HERE / "in.hopper"), "-log", str(folder / "log")]
    for name, value in {"model": model, "scene": args.runs / "scene", "out": folder, "law": args.runs / "wax.h5", "refill": 0,
                        "flow": args.steps, "every": 10**9, "pictures": 10**9}.items():
        command += ["-var", name, str(value)]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, capture_output=True, text=True, stdin=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode:
        raise SystemExit(f"{' '.join(command)}\n{done.stdout[-1500:]}{done.stderr[-500:]}")
    loop = float(re.search(r"^Loop time of (\S+) on", done.stdout, re.M).group(1))
    grid = re.search(r"(\d+ by \d+ by \d+) MPI processor grid", done.stdout).group(1)
    own, most = re.search(r"^Nlocal: +(\S+) ave (\S+) max", done.stdout, re.M).groups()
    ghosts = re.search(r"^Nghost: +(\S+) ave", done.stdout, re.M).group(1)
    return (loop, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, grid, float(own) / float(most),
            float(ghosts) / float(own))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("runs", type=pathlib.Path)
    parser.add_argument("-o", "--out", type=pathlib.Path, default=pathlib.Path("out/ranks"))
    parser.add_argument("--steps", type=int, default=400)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--models", nargs="+", default=["hertz", "mpm"], choices=sweep.MODELS)
    args = parser.parse_args()
    os.environ.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMP_NUM_THREADS="1")
    found = {}
    args.out.mkdir(parents=True, exist_ok=True)
    with open(args.out / "ranks.csv", "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["round", "model", "ranks", "loop_seconds", "cpu_seconds", "grid", "balance", "ghosts"])
        for k in range(args.rounds):
            for model in args.models:
                for ranks in (1, 2):
                    folder = args.out / f"{model}-{ranks}"
                    folder.mkdir(exist_ok=True)
                    shutil.copy(args.runs / model / "filled.restart", folder)
                    row = one(args, model, ranks, folder)
                    found.setdefault((model, ranks), []).append(row)
                    writer.writerow([k + 1, model, ranks, *row])
                    file.flush()
    print(f"{args.steps} steps, {args.rounds} rounds in turn; {os.cpu_count()} cores; load average {os.getloadavg()[0]:.1f}\n")
    print("| model | grid of 2 | wall-clock, 1 and 2 ranks, s | efficiency | CPU, 1 and 2 ranks, s | bound by balance | ghosts/particles |\n"
          "|---|---|---|---|---|---|---|")
    for model in args.models:
        (w1, c1), (w2, c2) = ([[row[i] for row in found[model, ranks]] for i in (0, 1)] for ranks in (1, 2))
        grid, balance, ghosts = found[model, 2][0][2:]
        efficiency = Sample(a / (2 * b) for a, b in zip(w1, w2))
        print(f"| {model} | {grid} | {Sample(w1)}, {Sample(w2)} | {efficiency} | {Sample(c1)}, {Sample(c2)} | {balance:.3f} | {ghosts:.2f} |")


if __name__ == "__main__":
    main()
