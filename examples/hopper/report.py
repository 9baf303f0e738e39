#!/usr/bin/python3
"""Compares the hopper runs of the three contact laws: report.md, report.csv, curves.png, particles.png.

    report.py -o DIR RUNS        RUNS holds scene/ and one folder for each model that was run

Every number comes from the runs' own files. A difference is called significant only where both numbers have a
spread and the difference exceeds 1.96 times the combined standard error.
"""
import argparse
import csv
import json
import os
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "common"))
import one_sentence  # noqa: E402, F401
import numpy as np  # noqa: E402
import measures  # noqa: E402
import pictures  # noqa: E402
from measures import Value  # noqa: E402
from runs import read_runs  # noqa: E402


def text(value, error=None, digits=4):
    if value is None:
        return "n/a"
    return f"{value:.{digits}g}" + (f" ± {error:.2g}" if error is not None else "")


def timing_rows(folder):
    """{model: [microseconds of wall-clock a particle-step, ...]} of the interleaved runs, in order."""
    times = {}
    path = os.path.join(folder, "timing.csv")
    if os.path.exists(path):
        with open(path) as file:
            for row in csv.DictReader(file):
                times.setdefault(row["model"], []).append(
                    1e6 * float(row["loop_seconds"]) / (int(row["steps"]) * int(row["atoms"])))
    return times


def measure(run, scene, times):
    """Ordered {quantity: (unit, Value or None)} of one run."""
    f = measures.filling(run)
    rng = np.random.default_rng(1)
    rate = measures.discharge_rate(run, scene["mass"], rng)
    density = measures.bulk_density(run, scene)
    expected = measures.beverloo(density, scene)
    one = lambda v: None if v is None else Value(float(v))
    stats = run.stats or {}
    side = lambda s, key: one(stats[s][key]) if stats else None
    overlap = run.series["pair_overlap"]
    t = times.get(run.model, [])
    base = times.get("hertz", [])
    n = min(len(t), len(base))
    ratio = np.array(t[:n]) / np.array(base[:n]) if n else np.array([])
    return {
        "discharge rate": ("kg/s", rate),
        "rate / Beverloo (flat bottom)": ("", rate and expected and Value(rate.value / expected, rate.error / expected)),
        "bulk density of the bed": ("kg/m3", density),
        "coordination number, full": ("", measures.coordination(run)),
        "bed height": ("m", measures.bed_height(run)),
        "kinetic energy, peak while filling": ("J", one(f["peak"])),
        "time from peak to 1/10 of it": ("s", one(f[1e-1])),
        "time from peak to 1/100": ("s", one(f[1e-2])),
        "time from peak to 1/1000": ("s", one(f[1e-3])),
        "time from peak to 1/10000": ("s", one(f[1e-4])),
        "energy dissipated while filling": ("J", one(f["dissipated"])),
        "of it in normal contacts (plastic)": ("J", one(f["plastic"]) if stats else None),
        "plastic share while filling": ("", one(f["plastic"] / f["dissipated"]) if stats else None),
        "normal dissipation, whole run": ("J", one(run.series["plastic"][-1]) if stats else None),
        "largest impact speed, pairs": ("m/s", side("pair", "impact_speed_max_m_per_s")),
        "largest impact speed, walls": ("m/s", side("wall", "impact_speed_max_m_per_s")),
        "largest overlap/R*, pairs": ("", side("pair", "overlap_over_radius_max")),
        "largest overlap/R*, walls": ("", side("wall", "overlap_over_radius_max")),
        "largest overlap/R*, pairs, sampled": ("", one(np.max(overlap) / (0.5 * scene["radius"]))),
        "fastest particle, sampled": ("m/s", one(np.max(run.series["fastest"]))),
        "largest I = rho V^2/Y": ("", side("pair", "inertia_number_max") and one(
            max(stats["pair"]["inertia_number_max"], stats["wall"]["inertia_number_max"]) or None)),
        "contact-steps beyond the law": ("", one(stats["pair"]["contact_steps_beyond_table"] +
                                                 stats["wall"]["contact_steps_beyond_table"]) if stats else None),
        "wall-clock per particle-step, dense, median": ("us", one(np.median(t)) if t else None),
        "ratio to Hertz, interleaved, median": ("", Value(float(np.median(ratio)), float(np.std(ratio, ddof=1) / np.sqrt(n)))
                                                if n > 1 and run.model != "hertz" else None),
        "ratio to Hertz, lowest": ("", one(np.min(ratio)) if n else None),
        "ratio to Hertz, highest": ("", one(np.max(ratio)) if n else None),
        "particles lost": ("", one(run.lost())),
    }


def verdict(value, base):
    differs = value.differs(base) if value and base else None
    return "" if differs is None else ("yes" if differs else "no")


def sentences(runs, table):
    """Conclusions that the numbers support."""
    out = []
    for model in runs:
        if model == "hertz" or "hertz" not in runs:
            continue
        for quantity in ("discharge rate", "coordination number, full", "bed height"):
            (unit, value), (_, base) = table[model][quantity], table["hertz"][quantity]
            if not value or not base:
                continue
            change = 100 * (value.value / base.value - 1)
            words = "differs significantly" if value.differs(base) else "does not differ significantly"
            out.append(f"- {quantity}: `{model}` {words} from `hertz` ({change:+.1f} %, by the spread within one filling).")
    for model, run in runs.items():
        if run.lost():
            out.append(f"- **`{model}` lost {run.lost()} particles: its other numbers cannot be trusted.**")
        if run.series["atoms"][-1] > 0:
            out.append(f"- `{model}` ended with {run.series['atoms'][-1]:.0f} particles not discharged.")
        if run.dangerous_builds:
            out.append(f"- `{model}` had {run.dangerous_builds} dangerous neighbour-list builds.")
    return out


def write_markdown(path, runs, scene, table, times):
    expected = {m: measures.beverloo(measures.bulk_density(r, scene), scene) for m, r in runs.items()}
    lines = ["# The hopper under three contact laws", "",
             f"{scene['particles']} spheres of radius {1e3 * scene['radius']:g} mm ({scene['mass']:.3f} kg) fall "
             f"{scene['drop']:.3f} to {scene['cloud_top']:.3f} m into a conical hopper (half angle "
             f"{scene['half_angle_deg']:g} degrees, orifice {2e3 * scene['orifice']:g} mm), come to rest, and flow out. "
             "All models start from the same cloud.", "",
             "![particles](particles.png)", "", "![curves](curves.png)", "",
             "| quantity | " + " | ".join(runs) + " | " + " | ".join(f"{m} differs" for m in runs if m != "hertz") + " |",
             "|---|" + "---|" * (2 * len(runs) - ("hertz" in runs))]
    first = next(iter(table.values()))
    for quantity, (unit, _) in first.items():
        values = [table[m][quantity][1] for m in runs]
        marks = [verdict(table[m][quantity][1], table["hertz"][quantity][1]) if "hertz" in runs else ""
                 for m in runs if m != "hertz"]
        name = quantity + (f", {unit}" if unit else "")
        lines.append(f"| {name} | " + " | ".join(text(v.value, v.error) if v else "n/a" for v in values) + " | " +
                     " | ".join(marks) + " |")
    lines += ["", "## What may be said", ""] + sentences(runs, table) + [
        "", "## How to read it", "",
        "- `differs`: from `hertz`, by more than 1.96 combined standard errors. Empty: one number of one deterministic "
        "run, without a spread, so nothing is claimed.",
        "- The spread lies within one run each (windows of the flow, particles, sectors of the surface). Other fillings "
        "(`make_scene.py --seed`) may scatter more.",
        "- Beverloo: 0.58 rho_b sqrt(g) (D - 1.4 d)^2.5 with the measured bulk density, a flat bottom: " +
        ", ".join(f"{m} {v:.3f} kg/s" if v else f"{m} none (too shallow a bed)" for m, v in expected.items()) +
        ". A 30 degree cone flows faster than a flat bottom (Rose and Tanaka's factor (tan 30 tan 45)^-0.35 = 1.21).",
        "- The total energy dissipated while filling is fixed by the fall; what the models decide is how fast, and where: "
        "the plug-in's contact statistics give the share of normal contacts, friction takes the rest. Stock Hertz keeps no contact statistics.",
        "- The coordination number counts geometric overlaps. A plastic contact that has lost its force but not its "
        "overlap still counts: part of the difference is that.",
        "- `sampled`: from the time series every few hundred steps, so a lower bound; without the word: from every step.",
        f"- Wall-clock: runs of the filled hopper, just opened, one after the other in turn ({len(times.get('hertz', []))} "
        "rounds), each model from its own filling; the ratio is taken within a round. The production runs shared the "
        "machine and are not used for it. Another load on the machine still shows as spread.",
        "- Production runs: " + ", ".join(
            f"{m} {sum(s for s, _ in r.loops):.0f} s for {r.particle_steps():.3g} particle-steps on {r.ranks} rank"
            + ("s" if r.ranks > 1 else "") for m, r in runs.items()) + "."]
    with open(path, "w") as out:
        out.write("\n".join(lines) + "\n")


def write_csv(path, runs, table):
    with open(path, "w", newline="") as file:
        out = csv.writer(file)
        out.writerow(["quantity", "unit", "model", "value", "standard_error", "differs_from_hertz"])
        for m in runs:
            for quantity, (unit, v) in table[m].items():
                base = table["hertz"][quantity][1] if "hertz" in runs and m != "hertz" else None
                out.writerow([quantity, unit, m, "" if v is None else repr(v.value),
                              "" if v is None or v.error is None else repr(v.error), verdict(v, base)])


def main():
    parser = argparse.ArgumentParser(description="Report on the hopper runs.")
    parser.add_argument("runs")
    parser.add_argument("-o", "--out", required=True, metavar="DIR")
    args = parser.parse_args()
    runs = read_runs(args.runs)
    if not runs:
        raise SystemExit(f"{args.runs}: no run found (a folder hertz, thornton or mpm with series.csv)")
    with open(os.path.join(args.runs, "scene", "scene.json")) as file:
        scene = json.load(file)
    os.makedirs(args.out, exist_ok=True)
    times = timing_rows(args.runs)
    table = {m: measure(run, scene, times) for m, run in runs.items()}
    write_csv(os.path.join(args.out, "report.csv"), runs, table)
    pictures.curves(runs, scene, os.path.join(args.out, "curves.png"))
    pictures.particles(runs, scene, os.path.join(args.out, "particles.png"))
    write_markdown(os.path.join(args.out, "report.md"), runs, scene, table, times)
    lost = [m for m, run in runs.items() if run.lost()]
    if lost:
        raise SystemExit(f"particles were lost under {', '.join(lost)}: see report.md")


if __name__ == "__main__":
    main()
