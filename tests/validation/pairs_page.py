#!/usr/bin/python3
"""docs/evidence/pairs.md, pairs-runs.md and pairs.png from the CSV of granulaw_pairs_study: pairs_page.py PAIRS.csv FOLDER"""
import csv
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

GROUPS = {
    "radius": "One material, unlike radii",
    "stiffness": "Elastic partner, equal radii",
    "strength": "Partner of higher yield stress, equal radii and E*",
    "wall": "Deformable wall",
    "mixture": "Random materials and radii",
    "press": "Slow presses to one overlap: F there, e from the works; no waves",
}


RUNS_INTRO = """# Pairs: the single runs

This page is the appendix of [how exact pairs are](pairs.md): every pair of the study, the pair rule over the two bodies, less 1. Behind `+-` stands twice what changes from 10 to 14 cells.
`tests/validation/pairs.csv` has the same numbers. V/V_y, d/(lambda R\\*) and I are those of the one sphere that stands for the pair.
"""


def percent(value, uncertainty):
    return f"{100 * value:+.2f} +- {100 * uncertainty:.2f}"


def main():
    if len(sys.argv) != 3:
        sys.exit("pairs_page.py PAIRS.csv FOLDER")
    rows = [{k: v if k == "group" else float(v) for k, v in row.items()} for row in csv.DictReader(open(sys.argv[1]))]
    docs = Path(sys.argv[2])

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
    figure.savefig(docs / "pairs.png", dpi=110)

    text = [RUNS_INTRO]
    for group, title in GROUPS.items():
        text += [f"## {title}", "",
                 "| E*/Y | radius ratio | E* ratio | Y ratio | V/V_y | d/(lambda R*) | I | e | F_max % | e % | time % |",
                 "|---|---|---|---|---|---|---|---|---|---|---|"]
        for r in (r for r in rows if r["group"] == group):
            time = "" if group == "press" else percent(r["error_time"], r["unc_time"])
            text.append("| " + " | ".join([
                f"{r['E_over_Y']:.0f}", f"{r['radius_ratio']:.3g}", f"{r['stiffness_ratio']:.3g}",
                f"{r['strength']:.2f}" if r["partner_E_over_Y"] else "elastic", f"{r['V_over_Vy']:.3g}",
                f"{r['depth']:.2g}", f"{r['inertia']:.1e}", f"{r['e']:.3f}",
                percent(r["error_force"], r["unc_force"]), percent(r["error_e"], r["unc_e"]), time]) + " |")
        text.append("")
    (docs / "pairs-runs.md").write_text("\n".join(text))
    (docs / "pairs.md").write_text((Path(__file__).parent / "pairs_intro.md").read_text())


if __name__ == "__main__":
    main()
