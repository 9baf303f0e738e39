#!/usr/bin/python3
"""Parallel efficiency of the run farm on 1 to 1024 ranks, simulated from measured run times.

    schedule.py RUNS [--threads T] [--batch N] [--measured RANKS:SECONDS ...]
    schedule.py RUNS --rehearse FARM_RANKS [--up-to 32] [--scale 0.02]     the farm itself, with runs that only sleep
    schedule.py --measure DIR -- MPM table ...      measures 1 and 2 ranks, and simulates their runs

RUNS is a cache folder (~/.cache/granulaw/runs: its files hold the expected cost and the CPU seconds of each run) or a
CSV file with columns cost and cpu_s, and batch where runs were made in several.

The farm's policy (mpm_core/farm/run_queue.hpp, mpm_core/farm_mpi): within a batch the runs start in the order
of their EXPECTED cost, the most expensive first, each on the next free thread; a batch starts when the one before it
has ended. Each hand-out costs 4 ms on a rank other than 0 (both sides look for messages every 2 ms), and the outcomes
of a batch go to all ranks at 1 GB/s, 30 kB each. Not modelled: what lies between batches (fits; seconds at most), and
cores that share memory bandwidth or clock.

efficiency = CPU seconds of all runs/(ranks x threads x time). `limit` is what no schedule can beat: the time is at
least that of the longest run of each batch, and at least an equal share of each batch for all.
"""
import argparse
import csv
import heapq
import os
import subprocess
import sys
import tempfile
import time
from itertools import groupby
from pathlib import Path

HAND_OUT = 4e-3          # s
BYTES, BANDWIDTH = 30e3, 1e9  # of an outcome; of a broadcast, bytes/s


def from_folder(folder):
    """(batch, cost, cpu_s) of all runs in a cache folder; run_cache.hpp has the format."""
    for path in sorted(folder.glob("*.run")):
        with open(path, "rb") as file:
            head = dict(file.readline().decode(errors="replace").rstrip("\n").split(" ", 1) for _ in range(4))
        if head.get("granulaw") != "run 2":
            raise SystemExit(f"schedule.py: {path}: not a run of this version's cache")
        yield 0, float(head["cost"]), float(head["cpu_s"])


def from_csv(path):
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            yield int(row.get("batch") or 0), float(row["cost"]), float(row["cpu_s"])


def read(path):
    runs = list(from_folder(path) if path.is_dir() else from_csv(path))
    if not runs:
        raise SystemExit(f"schedule.py: {path}: no runs")
    return runs


def batches_of(runs, size):
    """Lists of (cost, cpu_s); a batch of more than `size` is cut, dearest first (0: as they are)."""
    for _, batch in groupby(sorted(runs, key=lambda r: r[0]), key=lambda r: r[0]):
        batch = sorted(((cost, cpu) for _, cost, cpu in batch), key=lambda r: -r[0])
        for k in range(0, len(batch), size or len(batch)):
            yield batch[k:k + (size or len(batch))]


def makespan(batch, ranks, threads):
    """Time of one batch, longest expected first, on the next thread that is free."""
    free = [(0.0, rank) for _ in range(threads) for rank in range(ranks)]
    heapq.heapify(free)
    for _, cpu in batch:
        start, rank = heapq.heappop(free)
        heapq.heappush(free, (start + cpu + (HAND_OUT if rank else 0), rank))
    share = BYTES * len(batch) / BANDWIDTH if ranks > 1 else 0
    return max(end for end, _ in free) + share


def simulate(batches, ranks, threads):
    """(time, lower bound of any schedule), s"""
    workers = ranks * threads
    bound = sum(max(sum(cpu for _, cpu in b) / workers, max(cpu for _, cpu in b)) for b in batches)
    return sum(makespan(b, ranks, threads) for b in batches), bound


def report(runs, threads, batch, measured):
    batches = list(batches_of(runs, batch))
    times = [cpu for _, _, cpu in runs]
    total = sum(times)
    print(f"{len(runs)} runs in {len(batches)} batch(es), {total:.1f} CPU s; one run {min(times):.3g} to {max(times):.3g} s, "
          f"mean {total / len(runs):.3g} s; {threads} thread(s) a rank")
    print("ranks      time/s   efficiency   limit   measured time/s   efficiency")
    for ranks in [2**k for k in range(11)]:
        time_s, bound = simulate(batches, ranks, threads)
        share = total / (ranks * threads)
        line = f"{ranks:5} {time_s:11.3f} {share / time_s:12.3f} {share / bound:7.3f}"
        if ranks in measured:
            line += f" {measured[ranks]:17.3f} {share / measured[ranks]:12.3f}"
        print(line)


def rehearse(program, batches, scale, most):
    """Times of the real farm (tests/farm/farm_ranks) for the first batch, its runs replaced by sleeps of `scale` of
    their times: hand-outs and messages as they are, without the cores."""
    found = {}
    with tempfile.NamedTemporaryFile("w", suffix=".txt") as file:
        file.writelines(f"{cost} {cpu * scale}\n" for cost, cpu in batches[0])
        file.flush()
        ranks = 1
        while ranks <= most:
            done = subprocess.run(["mpirun", "--oversubscribe", "--bind-to", "none", "-np", str(ranks), program, "sleep",
                                   "--output", file.name], check=True, capture_output=True, text=True)
            found[ranks] = float(done.stdout)
            ranks *= 2
    return found


def measure(folder, command):
    """Wall times of the command on 1 and 2 ranks, each with a cache of its own. The load of the machine stands beside."""
    folder.mkdir(parents=True, exist_ok=True)
    found = {}
    for ranks in (1, 2):
        cache = folder / f"cache{ranks}"
        if cache.exists():
            raise SystemExit(f"schedule.py: {cache} exists: what is in it would not be run")
        words = ["mpirun", "--bind-to", "none", "-np", str(ranks), *command, "--jobs", "1", "--cache", str(cache),
                 "-o", str(folder / f"law{ranks}.h5")]
        before, start = os.times(), time.time()
        subprocess.run(words, check=True, stdout=subprocess.DEVNULL)
        found[ranks] = time.time() - start
        after = os.times()
        cpu = after.children_user + after.children_system - before.children_user - before.children_system
        print(f"{ranks} rank(s): {found[ranks]:.2f} s, {cpu:.2f} CPU s; load of the machine {os.getloadavg()[0]:.1f} on "
              f"{os.cpu_count()} cores")
    print(f"measured: 2 ranks are {found[1] / found[2]:.3f} times as fast as 1, efficiency {found[1] / found[2] / 2:.3f}")
    return found


def main():
    words = sys.argv[1:]
    command = words[words.index("--") + 1:] if "--" in words else []
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", type=Path, nargs="?", help="cache folder or CSV file")
    parser.add_argument("--threads", type=int, default=1, help="threads of each rank")
    parser.add_argument("--batch", type=int, default=0, help="cut batches to this many runs (default: not)")
    parser.add_argument("--measured", nargs="*", default=[], metavar="RANKS:SECONDS")
    parser.add_argument("--rehearse", metavar="FARM_RANKS")
    parser.add_argument("--up-to", type=int, default=32, help="ranks of the rehearsal")
    parser.add_argument("--scale", type=float, default=0.02, help="of the run times in it")
    parser.add_argument("--measure", type=Path, metavar="DIR")
    options = parser.parse_args(words[:words.index("--")] if command else words)
    measured = {int(r): float(s) for r, s in (m.split(":") for m in options.measured)}
    if options.measure:
        measured = measure(options.measure, command)
        report(read(options.measure / "cache1"), 1, options.batch, measured)
    elif options.rehearse:
        first = list(batches_of(read(options.runs), options.batch))[0]
        scaled = [(0, cost, cpu * options.scale) for cost, cpu in first]
        report(scaled, 1, 0, rehearse(options.rehearse, [first], options.scale, options.up_to))
    elif options.runs:
        report(read(options.runs), options.threads, options.batch, measured)
    else:
        parser.error("give RUNS or --measure")


if __name__ == "__main__":
    main()
