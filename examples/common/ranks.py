"""MPI efficiency: the same short stretch of a deck on 1 and 2 ranks, in turn, under each model; the table of it.

Efficiency: seconds on 1 rank / (2 x seconds on 2 ranks), of the same round. It needs two idle cores: where others compute too, a rank waits for
the other's turn, and burns CPU while it waits. What no load changes is the fraction of the work: particles of the fuller rank over the mean bound the
efficiency, and each rank computes its pairs with the ghosts itself."""
import argparse
import csv
import datetime
import os
import pathlib
import re
import resource
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import sweep  # noqa: E402
from spread import Sample  # noqa: E402


def options(description, out, steps):
    parser = argparse.ArgumentParser(description=description.splitlines()[0])
    parser.add_argument("runs", type=pathlib.Path)
    parser.add_argument("-o", "--out", type=pathlib.Path, default=pathlib.Path(out), help=f"default: {out}")
    parser.add_argument("--steps", type=int, default=steps, help=f"that are timed, default {steps}")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--models", nargs="+", default=["hertz", "mpm"], choices=sweep.MODELS)
    return parser


def once(deck, model, ranks, folder, variables):
    """Timing of the deck's last `run`: (wall-clock s of the loop, CPU s of all ranks from start to end, processor grid, mean over largest number of
    particles a rank, ghosts/particles)."""
    launcher = sweep.program("liggghts" if model == "hertz" else "liggghts-mpm")
    command = ["mpirun", "--oversubscribe", "-np", str(ranks), launcher, "-in", str(deck), "-log", str(folder / "log")]
    for name, value in {"model": model, "out": folder, **variables}.items():
        command += ["-var", name, str(value)]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, capture_output=True, text=True, stdin=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode:
        raise SystemExit(f"{' '.join(command)}\n{done.stdout[-1500:]}{done.stderr[-500:]}")
    last = lambda pattern: re.findall(pattern, done.stdout, re.M)[-1]
    own, most = last(r"^Nlocal: +(\S+) ave (\S+) max")
    return (float(last(r"^Loop time of (\S+) on")), after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime,
            last(r"(\d+ by \d+ by \d+) MPI processor grid"), float(own) / float(most), float(last(r"^Nghost: +(\S+) ave")) / float(own))


def in_turn(args, deck, prepare):
    """Runs every model on 1 and 2 ranks, round by round. `prepare(model, folder)` puts what the run needs into its folder and returns
    the deck's further variables. Writes ranks.csv and prints the table."""
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
                    row = once(deck, model, ranks, folder, prepare(model, folder))
                    found.setdefault((model, ranks), []).append(row)
                    writer.writerow([k + 1, model, ranks, *row])
                    file.flush()
    print(f"{datetime.date.today()}, {args.steps} steps, {args.rounds} rounds in turn; {os.cpu_count()} cores; load average {os.getloadavg()[0]:.1f}\n")
    print("| model | grid of 2 | wall-clock, 1 and 2 ranks, s | efficiency | CPU, 1 and 2 ranks, s | bound by balance | ghosts/particles |\n"
          "|---|---|---|---|---|---|---|")
    for model in args.models:
        (w1, c1), (w2, c2) = ([[row[i] for row in found[model, ranks]] for i in (0, 1)] for ranks in (1, 2))
        grid, balance, ghosts = found[model, 2][0][2:]
        efficiency = Sample(a / (2 * b) for a, b in zip(w1, w2))
        print(f"| {model} | {grid} | {Sample(w1)}, {Sample(w2)} | {efficiency} | {Sample(c1)}, {Sample(c2)} | {balance:.3f} | {ghosts:.2f} |")
    return found
