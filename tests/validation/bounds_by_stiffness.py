#!/usr/bin/python3
"""Table of docs/evidence/atlas.md: error bounds of atlas laws by E*/Y, each check by the 93 nearest others (mpm_core/atlas/law_from_atlas.cpp).

    bounds_by_stiffness.py mpm_core/characterise/atlas.h5             each check left out in turn
    bounds_by_stiffness.py mpm_core/characterise/atlas.h5 STUDY.txt   impacts that no atlas has seen, as granulaw_atlas_study prints them
"""
import math
import re
import sys

import h5py
import numpy as np

NEAR, TRUE_OVER_ESTIMATE = 93, 0.67
REGIONS = (20, 100, 600, 2500, 5000.1)


def confident_bound(values):
    """As mpm_core/atlas/confident_bound.hpp."""
    v = np.sort(np.abs(values))
    k, exactly = len(v), 0.95**len(v)
    at_least = exactly
    while k > 1:
        exactly *= k / (len(v) - k + 1) * 0.05 / 0.95
        if at_least + exactly > 0.05:
            break
        at_least += exactly
        k -= 1
    return max(v[k - 1], 0.5 * v[-1])


def bounds(checks, stiffness):
    """Error of F, of e, and of the solver, by the checks nearest in ln(E*/Y)."""
    near = checks[np.argsort(np.abs(np.log(checks[:, 0] / stiffness)), kind="stable")[:NEAR]]
    estimates = np.sort(near[:, 6])
    return confident_bound(near[:, 4]), confident_bound(near[:, 5]), TRUE_OVER_ESTIMATE * estimates[math.ceil(0.95 * len(estimates)) - 1]


def fresh_impacts(path):
    """E*/Y, nu, H/E, sqrt(I), errors of F and e, the solver's estimate: as the atlas keeps its checks."""
    rows = [line.replace("%", "").replace("<", "").split() for line in open(path)]  # "<" marks the largest errors
    rows = [[float(x) for x in row] for row in rows if len(row) == 7 and re.fullmatch(r"[\d.]+", row[0])]
    return np.array(rows) * [1, 1, 1, 1, 0.01, 1, 0.01]


def table(path, study=None):
    with h5py.File(path) as file:
        known = file["checks"][()].reshape(-1, 7)
    checks = fresh_impacts(study) if study else known
    found = np.array([bounds(known if study else np.delete(known, k, 0), check[0]) for k, check in enumerate(checks)])
    force, e = np.abs(checks[:, 4]), np.abs(checks[:, 5])
    lines = ["| E*/Y | checks | 95 % of errors: F, e | law's part: F, e | holds: F, e | with the solver's: F, e at e = 0.5 |", "|---|---|---|---|---|---|"]
    for low, high in zip(REGIONS, REGIONS[1:]):
        some = (checks[:, 0] >= low) & (checks[:, 0] < high)
        if not some.any():
            continue
        f, r, s = (np.median(found[some, k]) for k in range(3))
        lines.append(f"| {low:g} to {math.floor(high)} | {some.sum()} | {100 * np.quantile(force[some], 0.95):.2f} %, {np.quantile(e[some], 0.95):.4f} | "
                     f"{100 * f:.2f} %, {r:.4f} | {100 * np.mean(force[some] <= found[some, 0]):.1f}, {100 * np.mean(e[some] <= found[some, 1]):.1f} % | "
                     f"{100 * math.hypot(f, s):.2f} %, {math.hypot(r, 0.5 * s):.4f} |")
    return lines


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    print("\n".join(table(*sys.argv[1:])))
