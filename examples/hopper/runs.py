"""Reads what one run of in.hopper left in its folder."""
import csv
import glob
import json
import os
import re

import numpy as np

MODELS = ("hertz", "thornton", "mpm")


class Run:
    """One model's run. `series`: columns of series.csv; `fill_steps`, `dt` from its log; `stats`: the plug-in's."""

    def __init__(self, folder, model):
        self.folder, self.model = folder, model
        with open(os.path.join(folder, "series.csv")) as file:
            rows = list(csv.reader(file))
        if len(rows) < 3:
            raise SystemExit(f"{folder}/series.csv: the run has not come far enough to report on")
        self.series = {name: np.array([float(r[k]) for r in rows[1:]]) for k, name in enumerate(rows[0])}
        with open(os.path.join(folder, "log"), errors="replace") as file:
            log = file.read()
        self.loops = [(float(s), int(n)) for s, n in
                      re.findall(r"^Loop time of (\S+) on \d+ procs for (\d+) steps", log, re.M)]
        self.ranks = int(re.search(r"^Loop time of \S+ on (\d+) procs", log, re.M).group(1))
        self.dt = float(re.findall(r"^timestep\s+([0-9.eE+-]+)\s*$", log, re.M)[-1])
        self.fill_steps = self.loops[0][1]
        self.dangerous_builds = sum(int(n) for n in re.findall(r"^Dangerous builds = (\d+)", log, re.M))
        self.stats = None
        path = os.path.join(folder, "stats.json")
        if os.path.exists(path):
            with open(path) as file:
                self.stats = json.load(file)

    @property
    def opened(self):
        """Time at which the plug was removed, s."""
        return self.fill_steps * self.dt

    def lost(self):
        """Particles that are neither there nor removed at the outlet: must be 0."""
        total = self.series["atoms"] + self.series["removed"]
        return int(np.max(np.abs(total - total[0])))

    def particle_steps(self):
        every = np.diff(self.series["time"], prepend=0.0) / self.dt
        return float(np.sum(self.series["atoms"] * every))

    def dump_steps(self):
        return sorted(int(re.search(r"dump_(\d+)\.txt$", p).group(1))
                      for p in glob.glob(os.path.join(self.folder, "dump_*.txt")))

    def dump(self, step):
        """Columns id x y z vx vy vz radius contacts, one row a particle."""
        path = os.path.join(self.folder, f"dump_{step}.txt")
        with open(path) as file:
            lines = file.readlines()
        head = next(i for i, line in enumerate(lines) if line.startswith("ITEM: ATOMS"))
        names = lines[head].split()[2:]
        rows = np.array([line.split() for line in lines[head + 1:]], dtype=float).reshape(-1, len(names))
        return dict(zip(names, rows.T))


def read_runs(folder):
    return {m: Run(os.path.join(folder, m), m) for m in MODELS if os.path.exists(os.path.join(folder, m, "series.csv"))}
