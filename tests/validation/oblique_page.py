#!/usr/bin/python3
"""Picture of docs/evidence/oblique.md from the cases of `granulaw_oblique_study ... wall`: oblique_page.py docs/evidence/oblique.csv docs/evidence/oblique.png"""
import csv
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

QUANTITIES = {"e": ("e", "e"), "tangential_velocity": ("tangential_velocity_kept", "tangential velocity after / before"),
              "spin": ("spin_r_omega_over_v_n", "spin after, R omega / V_n")}
LAWS = {"history": ("tangential history", "0.35", "--"), "plastic": ("tangential plastic", "tab:blue", "-")}
cases = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(open(sys.argv[1]))]
frictions = sorted({c["friction"] for c in cases})
figure, axes = plt.subplots(len(frictions), 3, figsize=(11, 2.5 * len(frictions) + 0.5), sharex=True, sharey="col")
for row, friction in zip(axes, frictions):
    some = [c for c in cases if c["friction"] == friction]
    angles = [c["angle_deg"] for c in some]
    for axis, (name, (column, title)) in zip(row, QUANTITIES.items()):
        for law, (label, colour, line) in LAWS.items():
            off = [c[f"{law}_{name}_off_percent"] / 100 for c in some]
            axis.plot(angles, [c[column] + o if name == "tangential_velocity" else c[column] * (1 + o) for c, o in zip(some, off)], line, color=colour, lw=1.3, label=label)
        axis.plot(angles, [c[column] for c in some], "ko", ms=4, label="solver")
        axis.set_title(f"{title}, friction {friction:g}", fontsize=9)
        axis.grid(alpha=0.3)
for axis in axes[-1]:
    axis.set_xlabel("impact angle from the normal, degrees")
axes[0][0].legend(fontsize=8)
figure.tight_layout()
figure.savefig(sys.argv[2], dpi=100)
