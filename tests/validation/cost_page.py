#!/usr/bin/python3
"""docs/evidence/cost.md, cost.csv and cost.png from what granulaw_cost_study wrote: cost_page.py COST.json FOLDER"""
import csv
import json
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

JOBS = {"plastic": "impact, E*/Y = 100, V/V_y = 100", "elastic": "elastic impact to 0.002 R"}
STYLE = {
    ("mapped", "double"): ("tab:blue", "o", "-"),
    ("mapped", "single"): ("tab:cyan", "s", "--"),
    ("rectilinear", "double"): ("tab:red", "o", "-"),
    ("rectilinear", "single"): ("tab:orange", "s", "--"),
    ("updated", "double"): ("tab:green", "^", "-"),
    ("rectilinear-3d", "double"): ("tab:purple", "D", "-"),
}
# marks: CPU seconds and L2 error that were to be beaten
MARKS = {"plastic": [(0.3, 0.01), (1.0, 0.003)], "elastic": [(0.5, 0.002)]}


def main():
    if len(sys.argv) != 3:
        sys.exit("cost_page.py COST.json FOLDER")
    study = json.loads(Path(sys.argv[1]).read_text())
    jobs = {job["name"]: job for job in study["jobs"]}
    docs = Path(sys.argv[2])

    figure, axes = plt.subplots(1, 2, figsize=(10, 4.2), sharey=True)
    for axis, (job, title) in zip(axes, JOBS.items()):
        reference, own = jobs[job]["reference"], jobs[job]["rows"]
        for (grid, precision), (colour, marker, line) in STYLE.items():
            points = [(r["cpu_s"], r["L2_force"]) for r in own
                      if (r["grid"], r["precision"], r["grids"]) == (grid, precision, 4)]
            if not points:
                continue
            axis.loglog(*zip(*points), color=colour, marker=marker, linestyle=line, label=f"{grid}, {precision}")
        single = [(r["cpu_s"], r["L2_force"]) for r in own
                  if (r["grid"], r["precision"], r["grids"]) == ("mapped", "double", 1)]
        axis.loglog(*zip(*single), color="grey", marker=".", linestyle=":", label="mapped, one grid")
        axis.loglog(*zip(*MARKS[job]), "kx", markersize=9, label="mark to beat")
        axis.axhline(reference["L2_force"], color="black", linewidth=0.7)
        axis.set_title(title, fontsize=10)
        axis.set_xlabel("CPU seconds, one core")
        axis.grid(True, which="both", alpha=0.2)
    axes[0].set_ylabel("L2 error of the loading force")
    axes[0].legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(docs / "cost.png", dpi=110)

    tables = {title: [jobs[job]["reference"], *jobs[job]["rows"]] for job, title in JOBS.items()}
    (docs / "cost.md").write_text(page(study["processor"], tables))
    with (docs / "cost.csv").open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        writer.writerows(rows_of(tables))


INTRO = """# Cost: error against CPU seconds

Error of a run against CPU seconds, on one core of: {processor} (a virtual machine that names no model).

![L2 error of the loading force against CPU seconds](cost.png)

- One shifted grid gives the smoothed force of four for a quarter of the time. Four give a better e.
- Single precision changes no digit of the errors.
- Three dimensions (`rectilinear-3d`) have the error of `rectilinear` at equal cells. A quarter of the sphere is computed.

Solid: four shifted grids, both precisions; dotted: one grid. The black line is the error of the reference: mapped, 56 cells, 8 shifted grids, Courant number 0.5, against the same at 40 cells.

| column | |
|---|---|
| L2 | deviation of the smoothed loading force over 0.05 to 1 delta_max |
| F_max, e | deviation. F_max of several grids is the peak of their mean. Of a single grid it is the fit's, which does not follow the ringing: 0.7 % lower here |
| grid noise | rms of raw/smoothed force - 1 over 0.25 to 1 delta_max, of the mean of the shifted grids |

    cmake --build --preset release --target cost_page        # makes this page in twenty minutes; use an idle machine

## Which resolution

The default: mapped grid, double precision, four shifted grids.
"""


def percents(row):
    return [f"{100 * row[c]:{'+' if c.startswith('err') else ''}.3f}" for c in ("L2_force", "err_force", "err_e", "ripple")]


COLUMNS = ("job", "grid", "precision", "cells", "shifted_grids", "points", "cpu_s", "million_updates_per_s", "l2_percent", "force_max_percent",
           "e_percent", "grid_noise_percent", "energy_error")


def rows_of(jobs):
    """Rows of cost.csv; `jobs` as in page()."""
    for title, rows in jobs.items():
        for k, r in enumerate(rows):
            yield [title, r["grid"] + (" (against the reference)" if k == 0 else ""), r["precision"], r["cells"], r["grids"], r["points"],
                   f"{r['cpu_s']:.4g}", f"{r['Mupd_s']:.0f}", *percents(r), f"{r['energy']:.2g}"]


def page(processor, jobs):
    """`jobs`: title -> its rows, the reference first."""
    text = [INTRO.format(processor=processor)]
    for title, (_, *rows) in jobs.items():
        text += [f"{title[0].upper()}{title[1:]}:", "", "| cells | CPU s | L2 % | F_max % | e % |", "|---|---|---|---|---|"]
        text += ["| " + " | ".join([str(r["cells"]), f"{r['cpu_s']:.4g}", *percents(r)[:3]]) + " |" for r in rows
                 if (r["grid"], r["precision"], r["grids"]) == ("mapped", "double", 4)] + [""]
    text += ["## All rows", "",
             "[cost.csv](cost.csv) has every grid, precision and resolution, with points, updates per second, grid noise and energy error. "
             "The first row of each job is the reference against the same at 40 cells.", ""]
    return "\n".join(text)


if __name__ == "__main__":
    main()
