#!/usr/bin/python3
"""The picture of docs/evidence/pairs.md from the CSV of granulaw_pairs_study: pairs_page.py PAIRS.csv FOLDER"""
import csv
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt


def main():
    if len(sys.argv) != 3:
        sys.exit("pairs_page.py PAIRS.csv FOLDER")
    rows = [{k: v if k == "group" else float(v) for k, v in row.items()} for row in csv.DictReader(open(sys.argv[1]))]

    figure, axes = plt.subplots(1, 3, figsize=(13, 4.2))
    colours = {5: "tab:blue", 20: "tab:orange", 100: "tab:red"}

    def series(axis, group, column, pick):
        for speed, colour in colours.items():
            own = sorted((r for r in rows if r["group"] == group and r["E_over_Y"] == 100 and r["V_over_Vy"] == speed
                          and pick(r)), key=lambda r: r[column])
            x = [r[column] for r in own]
            axis.errorbar(x, [100 * r["error_e"] for r in own], [100 * r["unc_e"] for r in own], color=colour,
                          marker="o", label=f"e, V/V_y = {speed}")
            axis.errorbar(x, [100 * r["error_force"] for r in own], [100 * r["unc_force"] for r in own],
                          color=colour, marker="s", mfc="w", ls="--", label=f"F_max, V/V_y = {speed}")
        axis.set_xscale("log")
        axis.axhline(0, color="k", lw=0.6)
        axis.grid(True, which="both", alpha=0.2)

    series(axes[0], "radius", "radius_ratio", lambda r: True)
    axes[0].set_xlabel("radius ratio, one material")
    axes[0].set_ylabel("rule over two bodies, less 1, %")
    series(axes[1], "stiffness", "stiffness_ratio", lambda r: r["stiffness_ratio"] >= 0.3)
    axes[1].set_xlabel("E* of the elastic partner over the yielding body's")
    for row in rows:
        row["strength"] = row["stiffness_ratio"] * row["E_over_Y"] / row["partner_E_over_Y"] if row["partner_E_over_Y"] else 0
    series(axes[2], "strength", "strength", lambda r: True)
    axes[2].set_xlabel("yield stress of the partner over the yielding body's")
    axes[0].legend(fontsize=6)
    figure.suptitle("What the pair rule costs, E*/Y = 100")
    figure.tight_layout()
    figure.savefig(Path(sys.argv[2]) / "pairs.png", dpi=110)


if __name__ == "__main__":
    main()
