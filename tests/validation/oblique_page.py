#!/usr/bin/python3
"""Picture of docs/evidence/oblique.md from the cases of `granulaw_oblique_study ... wall`: oblique_page.py docs/evidence/oblique.csv docs/evidence/oblique.png"""
import csv
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

QUANTITIES = {"e": ("e", "e"), "tangential_velocity": ("tangential_velocity_kept", "tangential velocity after / before"),
              "spin": ("spin_r_omega_over_v_n", "spin after, R omega / V_n")}
cases = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(open(sys.argv[1]))]
figure, axes = plt.subplots(1, 3, figsize=(12, 3.8))
for colour, friction in enumerate(sorted({c["friction"] for c in cases})):
    some = [c for c in cases if c["friction"] == friction]
    angles = [c["angle_deg"] for c in some]
    for axis, (name, (column, title)) in zip(axes, QUANTITIES.items()):
        axis.plot(angles, [c[column] for c in some], f"C{colour}o-", lw=1, ms=4, label=f"solver, {friction:g}")
        for model, line in ("history", "--"), ("plastic", ":"):
            off = [c[f"{model}_{name}_off_percent"] / 100 for c in some]
            axis.plot(angles, [c[column] + o if name == "tangential_velocity" else c[column] * (1 + o) for c, o in zip(some, off)], f"C{colour}{line}", lw=1.2)
        axis.set_title(title, fontsize=10)
        axis.set_xlabel("impact angle from the normal, degrees")
        axis.grid(alpha=0.3)
axes[0].legend(fontsize=8)
axes[1].legend([axes[1].plot([], [], line)[0] for line in ("k--", "k:")], ["tangential history", "tangential plastic"], fontsize=8)
figure.tight_layout()
figure.savefig(sys.argv[2], dpi=110)
