#!/usr/bin/python3
"""docs/evidence/oblique.png and oblique.csv, and the table of docs/evidence/oblique.md on stdout, from what granulaw_oblique_study wrote:
oblique_page.py OBLIQUE.json FOLDER [OTHER_MATERIAL.json ...]"""
import csv
import json
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

MODELS = {"history": ("tangential history", "--"), "plastic": ("tangential plastic", ":")}
QUANTITIES = {"e": "e", "tangential": "tangential velocity after / before", "spin": "spin after, R omega / V_n"}


def value(row, key, angle):
    """Quantity of the picture: the tangential velocity over the one before."""
    return row[key] / np.tan(np.radians(angle)) if key == "tangential" else row[key]


def draw(study, picture):
    figure, axes = plt.subplots(1, 3, figsize=(12, 3.8))
    for colour, friction in enumerate(sorted({c["friction"] for c in study["cases"]})):
        cases = [c for c in study["cases"] if c["friction"] == friction]
        angles = [c["angle"] for c in cases]
        for axis, (key, title) in zip(axes, QUANTITIES.items()):
            axis.plot(angles, [value(c["solver"], key, c["angle"]) for c in cases], f"C{colour}o-", lw=1, ms=4, label=f"solver, {friction:g}")
            for model, (_, line) in MODELS.items():
                axis.plot(angles, [value(c[model], key, c["angle"]) for c in cases], f"C{colour}{line}", lw=1.2)
            axis.set(title=title, xlabel="impact angle from the normal, degrees")
            axis.title.set_fontsize(10)
            axis.grid(alpha=0.3)
    for label, line in MODELS.values():
        axes[1].plot([], [], f"k{line}", label=label)
    axes[0].legend(fontsize=8)
    axes[1].legend(*(list(part)[-len(MODELS):] for part in axes[1].get_legend_handles_labels()), fontsize=8)
    figure.tight_layout()
    figure.savefig(picture, dpi=110)


def off(case, model):
    """e relative; tangential velocity over that before; spin relative; %."""
    solver, told = case["solver"], case[model]
    before = np.tan(np.radians(case["angle"]))
    return [100 * (told["e"] / solver["e"] - 1), 100 * (told["tangential"] - solver["tangential"]) / before,
            100 * (told["spin"] / solver["spin"] - 1)]


def write_cases(study, path):
    """One row a case: the solver's result, and each model's deviations."""
    with path.open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["friction", "angle_deg", "e", "tangential_velocity_kept", "spin_r_omega_over_v_n",
                         *(f"{m}_{q}_off_percent" for m in MODELS for q in ("e", "tangential_velocity", "spin"))])
        for case in study["cases"]:
            solver = case["solver"]
            writer.writerow([f"{case['friction']:g}", f"{case['angle']:g}", f"{solver['e']:.3f}",
                             f"{value(solver, 'tangential', case['angle']):.3f}", f"{solver['spin']:.3f}",
                             *(f"{x:+.1f}" for m in MODELS for x in off(case, m))])


def spread(values):
    """Median and largest of the sizes."""
    return f"{np.median(np.abs(values)):.1f}, {max(values, key=abs):+.1f}"


def materials(studies):
    names = list(MODELS)
    print("| E\\*/Y | H/E | V/V_y | overlap/R | contact radius/R | cases |" + "".join(f" {MODELS[m][0]}: e, v_t, omega |" for m in names))
    print("|---|---|---|---|---|---|" + "---|" * len(names))
    for study in studies:
        trace = np.array(study["frictionless"])
        words = [f"{study['stiffness']:g}", f"{study['hardening']:g}", f"{study['velocity']:g}", f"{trace[:, 1].max():.2g}",
                 f"{np.median(np.sort(trace[:, 4])[-9:]):.2f}", str(len(study["cases"]))]
        for name in names:
            words.append("; ".join(spread(column) for column in zip(*(off(case, name) for case in study["cases"]))))
        print("| " + " | ".join(words) + " |")


if __name__ == "__main__":
    told, *others = [json.loads(Path(name).read_text()) for name in [sys.argv[1], *sys.argv[3:]]]
    draw(told, Path(sys.argv[2]) / "oblique.png")
    write_cases(told, Path(sys.argv[2]) / "oblique.csv")
    materials([told, *others])
