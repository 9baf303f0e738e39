"""Run files as decks write them, small and with numbers known by hand."""
import csv
import json
import math

TIME_STEP = {"mpm-stretch10": 6e-5}


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
             "damage_number_limit": 0.002, "damage_number_max": 0.001, "onset_speed_m_per_s": 0.03, "contacts_begun": sum(n for _, n in speeds),
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


def everything(root):
    """A flow under three models, and stretched."""
    folder = packing(root, {"hertz": {"solid fraction": [0.58, 0.59, 0.60], "energy dissipated, J": [1.0, 2.0, 3.0], "rattlers": [0.1, 0.2, 0.1]},
                            "thornton": {"solid fraction": [0.61, 0.61, 0.62], "energy dissipated, J": [2.0, 2.0, 3.0], "rattlers": [0.1, 0.1, 0.1]},
                            "mpm": {"solid fraction": [0.60, 0.60, 0.60], "energy dissipated, J": [2.0, 2.0, 2.0], "rattlers": [0.1, 0.1, 0.2]}},
                     {"hertz": [10, 11, 12], "thornton": [12, 12, 13], "mpm": [20, 20, 20]})
    packing(root, {"mpm-stretch10": {"solid fraction": [0.66, 0.67, 0.65], "energy dissipated, J": [2.0, 2.1, 1.9], "rattlers": [0.1, 0.1, 0.1]}},
            {"mpm-stretch10": [2, 2, 2]}, label="packing-stretch10")
    for seed in (1, 2, 3):
        content = stats([(0.01, 60), (1.0, 40)], [(1e-3, 60), (0.05, 40)])
        (folder / f"mpm-{seed}" / "stats.json").write_text(json.dumps(content))
    return folder
