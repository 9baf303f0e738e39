"""Run files as the studies, benchmarks and decks write them, small and with numbers known by hand."""
import csv
import json
import math

import h5py
import numpy as np

E_STAR_OVER_Y = 100.0
NU, YOUNG = 0.3, 91e6
ONSET = 6.4e-4
TIME_STEP = {"mpm-stretch10": 6e-5}


def cost():
    def row(grid, precision, cells, cpu, error):
        return {"job": "plastic", "grid": grid, "precision": precision, "cells": cells, "grids": 4, "points": 100 * cells, "cpu_s": cpu,
                "Mupd_s": 50.0, "L2_force": error, "err_force": -error, "err_e": 2 * error, "ripple": 0.003, "energy": 1e-6}
    rows = [row("mapped", "double", 8, 0.026, 0.017), row("mapped", "double", 16, 0.21, 0.0063), row("mapped", "double", 24, 0.74, 0.0028),
            row("mapped", "single", 24, 0.46, 0.0028), row("tartan", "double", 16, 0.61, 0.0029), row("updated", "double", 16, 2.9, 0.002)]
    elastic = [{**row("mapped", "double", 12, 0.65, 0.0017), "job": "elastic"}]
    return {"study": "cost", "granulaw_version": "0", "git_hash": "c057", "created": "then", "processor": "some", "quick": False,
            "jobs": [{"name": "plastic", "reference_cells": 56, "reference": row("mapped", "double", 40, 12.1, 0.0005), "rows": rows},
                     {"name": "elastic", "reference_cells": 56, "reference": {**row("mapped", "double", 40, 88.0, 0.0001), "job": "elastic"},
                      "rows": elastic}]}


def law_size():
    def row(nodes, slices, size, ns, force, e):
        return {"nodes": nodes, "slices": slices, "ratio_nodes": 31 if slices else 0, "bytes": size, "err_force": force,
                "err_e": e, "err_e_at_inertia_number": 0.01,
                **{f"ns_{side}{end}": ns * by for side in ("load", "unload") for end, by in (("", 1), ("_low", 0.9), ("_high", 1.2))}}
    rows = [row(148, 7, 95776, 10.25, 0, 0), row(148, 0, 48160, 4.8, 0.21, 0.019)]
    return {"benchmark": "law_size", "git_hash": "1a30", "law": "wax.h5", "material": "wax", "hertz": {"ns": 2.8, "ns_low": 2.7, "ns_high": 3.1},
            "own_errors": {"origin": "atlas", "solver_error_force": 0.013, "solver_error_restitution": 0.013, "atlas_error_force": 0.0066,
                           "atlas_error_restitution": 0.0087}, "rows": rows}


def hertz_law(path):
    """A law whose loading force is Hertz's, so that overlaps go as V^(4/5) exactly."""
    with h5py.File(path, "w") as file:
        body = file.create_group("bodies/wax")
        for name, value in (("density", 920.0), ("youngs_modulus", YOUNG), ("poisson_ratio", NU), ("yield_stress", YOUNG / (1 - NU**2) / E_STAR_OVER_Y)):
            body[f"material/{name}"] = value
        octaves, k = 30, np.arange(8 * (30 + math.ceil(math.log2(0.1 / ONSET))) + 1)
        x = ONSET * (1 + k % 8 / 8) * 2.0**(k // 8 - octaves)
        body["curve/end"], body["curve/onset"], body["curve/octaves"] = 0.1, ONSET, float(octaves)
        body["curve/force"], body["curve/force_slope"] = x**1.5, 1.5 * x**0.5


def histogram(values, per_decade=8):
    bins = {}
    for value, count in values:
        k = math.floor(per_decade * math.log10(value))
        bins[k] = bins.get(k, 0) + count
    span = range(min(bins), max(bins) + 1)
    return {"quantity": "", "bins_per_decade": per_decade, "lower_edge": [float(f"{10**(k / per_decade):.6g}") for k in span],
            "count": [bins.get(k, 0) for k in span]}


def contact_map(speeds, overlaps):
    """Each speed with the overlap of the same place in its list."""
    v, x = histogram(speeds), histogram(overlaps)
    rows = [[0] * len(x["count"]) for _ in v["count"]]
    for (speed, n), (overlap, _) in zip(speeds, overlaps):
        at = [math.floor(8 * math.log10(value)) - round(8 * math.log10(h["lower_edge"][0])) for value, h in ((speed, v), (overlap, x))]
        rows[at[0]][at[1]] += n
    return {"quantity": "", "bins_per_decade": 8, "speed_lower_edge": v["lower_edge"], "overlap_lower_edge": x["lower_edge"], "count": rows}


def stats(speeds, overlaps):
    entry = {"kind": "particles", "types": [1, 1], "materials": ["wax", "wax"], "law": "mpm law.h5", "rule": "single", "overlap_over_radius_limit": 0.4,
             "inertia_number_limit": 0.002, "onset_speed_m_per_s": 0.03, "contacts_begun": sum(n for _, n in speeds),
             "contact_steps_beyond_table": 3, "impact_speed_max_m_per_s": max(v for v, _ in speeds),
             "overlap_over_radius_max": max(d for d, _ in overlaps), "impact_speed": histogram(speeds),
             "largest_overlap_over_radius": histogram(overlaps), "contact_map": contact_map(speeds, overlaps)}
    return {"granulaw_version": "0", "pairs": [entry]}


def run_folder(folder, dt, seconds, finished=True):
    folder.mkdir(parents=True)
    (folder / "log").write_text(f"LIGGGHTS (Version LIGGGHTS-TEST 1.2, compiled)\ntimestep ${{dt}}\ntimestep {dt:g}\n"
                                f"Loop time of {seconds} on 1 procs for 100 steps with 150 atoms, finish time 0\n")
    if finished:
        (folder / "done").write_text("x")


def packing(root, values, seconds, label="packing"):
    """values[model][quantity]: one a seed."""
    folder = root / label
    folder.mkdir(parents=True)
    with open(folder / "packing.csv", "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["model", "seed", "quantity", "value"])
        for model, quantities in values.items():
            for quantity, numbers in quantities.items():
                writer.writerows([model, k + 1, quantity, v] for k, v in enumerate(numbers))
    for model in values:
        for k, s in enumerate(seconds[model]):
            run_folder(folder / f"{model}-{k + 1}", TIME_STEP.get(model, 6e-6), s)
    return folder


def hard_cases():
    rows = [{"name": "onset", "stress": "hardly plastic", "command": "mpm impact", "verdict": "stable", "e": 0.9999, "energy_error": 1e-8, "steps": 10,
             "cpu_s": 11.2, "depth": 6e-4, "change": -9e-6, "reference": "1 ± 0.001", "deviation": -5e-5},
            {"name": "Courant 1.1", "stress": "beyond the limit", "command": "mpm impact", "verdict": "refused: unstable above 1"}]
    return {"mpm": "mpm 0", "sha256": "0", "runs": {}, "rows": rows}


def everything(root):
    """All parts of the report under `root`."""
    for folder, name, content in (("solver", "cost.json", cost()), ("law", "law_size.json", law_size()), ("hard", "hard-cases.json", hard_cases())):
        (root / folder).mkdir(parents=True)
        (root / folder / name).write_text(json.dumps(content))
    folder = packing(root, {"hertz": {"solid fraction": [0.58, 0.59, 0.60], "energy dissipated, J": [1.0, 2.0, 3.0], "rattlers": [0.1, 0.2, 0.1]},
                            "thornton": {"solid fraction": [0.61, 0.61, 0.62], "energy dissipated, J": [2.0, 2.0, 3.0], "rattlers": [0.1, 0.1, 0.1]},
                            "mpm": {"solid fraction": [0.60, 0.60, 0.60], "energy dissipated, J": [2.0, 2.0, 2.0], "rattlers": [0.1, 0.1, 0.2]}},
                     {"hertz": [10, 11, 12], "thornton": [12, 12, 13], "mpm": [20, 20, 20]})
    packing(root, {"mpm-stretch10": {"solid fraction": [0.66, 0.67, 0.65], "energy dissipated, J": [2.0, 2.1, 1.9], "rattlers": [0.1, 0.1, 0.1]}},
            {"mpm-stretch10": [2, 2, 2]}, label="packing-stretch10")
    run_folder(folder / "mpm-stretch30-1", 1.8e-4, 1, finished=False)
    (folder / "mpm-stretch30-1" / "screen").write_text("Step\nERROR on proc 0: pair_style gran model mpm: stretch less\n")
    alone = root / "packing-stretch100" / "mpm-stretch100-1"  # stopped before there was any table
    run_folder(alone, 6e-4, 1, finished=False)
    (alone / "screen").write_text("ERROR on proc 0: stretch far less\n")
    hertz_law(folder / "law.h5")
    for seed in (1, 2, 3):
        content = stats([(0.01, 60), (1.0, 40)], [(1e-3, 60), (0.05, 40)])
        (folder / f"mpm-{seed}" / "stats.json").write_text(json.dumps(content))
    return folder
