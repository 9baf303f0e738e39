"""Reads what a run left in its folder: series.csv, dumps, log, stats.json."""
import csv
import glob
import json
import os
import re

import numpy as np


def series(folder):
    """Columns of series.csv by name."""
    with open(os.path.join(folder, "series.csv")) as file:
        rows = list(csv.reader(file))
    if len(rows) < 3:
        raise SystemExit(f"{folder}/series.csv: {len(rows) - 1} rows: the run has not come far enough to report on")
    return {name: np.array([float(r[k]) for r in rows[1:]]) for k, name in enumerate(rows[0])}


def dump_steps(folder):
    return sorted(int(re.search(r"dump_(\d+)\.txt$", p).group(1)) for p in glob.glob(os.path.join(folder, "dump_*.txt")))


def dump(folder, step=None):
    """Columns of one dump (the last one if no step is named), one row a particle."""
    step = dump_steps(folder)[-1] if step is None else step
    with open(os.path.join(folder, f"dump_{step}.txt")) as file:
        lines = file.readlines()
    head = next(i for i, line in enumerate(lines) if line.startswith("ITEM: ATOMS"))
    names = lines[head].split()[2:]
    rows = np.array([line.split() for line in lines[head + 1:]], dtype=float).reshape(-1, len(names))
    return dict(zip(names, rows.T))


def stats(folder):
    """The plug-in's account of the contacts, None under stock Hertz."""
    path = os.path.join(folder, "stats.json")
    if not os.path.exists(path):
        return None
    with open(path) as file:
        return json.load(file)


def loops(folder):
    """[(seconds, steps, atoms at its end)] of each run command, from the log."""
    with open(os.path.join(folder, "log"), errors="replace") as file:
        found = re.findall(r"^Loop time of (\S+) on \d+ procs for (\d+) steps with (\d+) atoms", file.read(), re.M)
    return [(float(s), int(n), int(a)) for s, n, a in found]


def decay(time, kinetic, level, until=None):
    """s from the peak to the first fall below `level` times it (straight in log energy between rows), None if not before row `until`."""
    peak = int(np.argmax(kinetic[:until]))
    below = np.flatnonzero(kinetic[peak:until] < level * kinetic[peak])
    if not len(below):
        return None
    k = peak + below[0]
    a, b = np.log(kinetic[k - 1:k + 1] / (level * kinetic[peak]))
    return float(time[k - 1] + (time[k] - time[k - 1]) * a / (a - b) - time[peak])


def lost(folder, removed="removed"):
    """Particles that are neither there nor removed on purpose: must be 0. The first row counts as complete."""
    s = series(folder)
    total = s["atoms"] + s.get(removed, 0)
    return int(np.max(np.abs(total - total[0])))
