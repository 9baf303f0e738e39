"""(a) Solver: CPU seconds against the error in F and e, by grid and precision."""
from . import files
from .page import legend_below, number, plt

NAME = "cost.json"  # of granulaw_cost_study
JOBS = {"plastic": "Impact, E*/Y = 100, V/V_y = 100", "elastic": "Elastic impact to 0.002 R"}
COLOURS = {"mapped": "tab:blue", "rectilinear": "tab:red", "updated": "tab:green"}
TARGETS = (0.01, 0.003, 0.001)  # relative errors of F that a user may ask for
KEYS = ("cells", "grids", "points", "cpu_s", "Mupd_s", "L2_force", "err_force", "err_e", "ripple", "energy")


def read(path):
    found = files.read_json(path, study="cost", jobs=list, git_hash=str, processor=str)
    for job in found["jobs"]:
        files.rows_with(path, [job.get("reference")] + list(job.get("rows", [])), KEYS)
    return found


def label(row):
    grids = "1 grid" if row["grids"] == 1 else f"mean of {row['grids']} shifted grids"
    return f"{row['grid']}, {row['precision']}, {grids}"


def groups(rows):
    """{label: rows by growing cost}."""
    found = {}
    for row in rows:
        found.setdefault(label(row), []).append(row)
    return {name: sorted(g, key=lambda r: r["cpu_s"]) for name, g in found.items()}


def picture(study):
    figure, axes = plt.subplots(len(study["jobs"]), 2, figsize=(9.6, 3.5 * len(study["jobs"])), squeeze=False, sharex="row")
    for line, job in zip(axes, study["jobs"]):
        for axis, key, what in zip(line, ("L2_force", "err_e"), ("loading force, L2", "e")):
            for name, rows in groups(job["rows"]).items():
                first = rows[0]
                single = first["precision"] == "single"
                errors = [max(100 * abs(r[key]), 1e-5) for r in rows]
                axis.loglog([r["cpu_s"] for r in rows], errors, color=COLOURS.get(first["grid"], "0.4"), label=name,
                            linestyle=":" if first["grids"] == 1 else "--" if single else "-", alpha=0.75 if single else 1,
                            marker="s" if single else "." if first["grids"] == 1 else "o", markerfacecolor="white" if single else None)
            floor = 100 * abs(job["reference"][key])
            if floor > 0:
                axis.axhspan(axis.get_ylim()[0] if floor > axis.get_ylim()[0] else floor / 3, floor, color="0.85", zorder=0)
            axis.set(xlabel="CPU seconds, one core", ylabel=f"error of {what}, %", title=JOBS.get(job["name"], job["name"]).replace("V/V_y", "$V/V_y$"))
    handles, names = axes[0][0].get_legend_handles_labels()
    legend_below(figure, handles, names, 2)
    return figure


def cheapest(rows, target, keys=("L2_force",)):
    """The cheapest run of a group from which on all finer ones keep these errors within `target`; None: none does."""
    for k, row in enumerate(rows):
        if all(abs(r[key]) <= target for r in rows[k:] for key in keys):
            return row
    return None


def single_precision(study):
    """Effect of single precision, over all runs that were made in both: a sentence, or nothing."""
    key = lambda r: (r["job"], r["grid"], r["cells"], r["grids"])
    rows = [r for job in study["jobs"] for r in job["rows"]]
    double = {key(r): r for r in rows if r["precision"] == "double"}
    both = [(r, double[key(r)]) for r in rows if r["precision"] == "single" and key(r) in double]
    if not both:
        return ""
    force, e = (max(abs(s[k] - d[k]) for s, d in both) for k in ("L2_force", "err_e"))
    cost = sorted(s["cpu_s"] / d["cpu_s"] for s, d in both)
    return (f" Single precision changes the error of F by at most {100 * force:.1g} %, of e by {100 * e:.1g} %, and costs {cost[0]:.2f} to {cost[-1]:.2f} "
            "of double.")


def glance(study):
    rows = []
    for job in study["jobs"]:
        for keys, what in ((("L2_force",), "F within 0.3 %"), (("L2_force", "err_e"), "F and e within 0.3 %")):
            found = [r for r in (cheapest(g, 0.003, keys) for g in groups(job["rows"]).values()) if r]
            if found:
                row = min(found, key=lambda r: r["cpu_s"])
                rows.append([f"solver: {JOBS.get(job['name'], job['name'])}, {what}", f"{number(row['cpu_s'])} CPU s\n{label(row)}, {row['cells']} cells",
                             f"F {100 * row['L2_force']:.2f} %, e {100 * row['err_e']:+.2g} %".replace("-", "−")])
    return rows


def write(page, study, path, commands):
    page.glance(glance(study))
    page.figure(picture(study), "solver",
                "Error against cost. Each line is one grid and precision, its points are growing resolutions. Grey: how far the reference "
                "itself is from the next coarser one; errors in it say no more than that. The error of e crosses zero, so single low points are luck; read "
                "the upper ones." + single_precision(study))
    for job in study["jobs"]:
        page.heading(JOBS.get(job["name"], job["name"]))
        reference = job["reference"]
        own = f"reference's own error: F {100 * reference['L2_force']:.2g} %, e {100 * abs(reference['err_e']):.2g} %"
        rows = []
        for name, group in groups(job["rows"]).items():
            cells = []
            for target in TARGETS:
                row = cheapest(group, target)
                cells.append("none" if row is None else f"{number(row['cpu_s'])} s\n{row['cells']} cells, e {100 * row['err_e']:+.2g} %".replace("-", "−"))
            rows.append([name, *cells])
        page.table(["cheapest run with error of F within", *[f"{100 * t:g} %" for t in TARGETS]], rows)
        page.origin(f"Second line: its resolution and its error of e; {own}. `none`: no resolution of this study reaches it.")
        page.table(["grid", "precision", "cells", "shifted grids", "points", "CPU s", "million updates/s", "F, L2 %", "F_max %", "e %",
                    "grid noise %", "energy error"],
                   [[r["grid"], r["precision"], r["cells"], r["grids"], r["points"], number(r["cpu_s"]), number(r["Mupd_s"]),
                     f"{100 * r['L2_force']:.3f}", f"{100 * r['err_force']:+.3f}", f"{100 * r['err_e']:+.3f}", f"{100 * r['ripple']:.3f}",
                     f"{r['energy']:.1e}"] for r in job["rows"]], fold=f"All {len(job['rows'])} runs")
    page.text("F, L2: deviation of the treated loading force over 0.05 to 1 δ_max; grid noise: rms of the raw over the treated force, less 1; "
              "energy error: what the energy balance lacks, over the energy put in.")
    quick = " (the quick version: few resolutions, a coarser reference)" if study.get("quick") else ""
    page.origin(f"`{path}`{quick}: made {study.get('created', '')} by commit `{study['git_hash']}` on {study['processor']}, one core.")
    if study.get("quick") or len(study["jobs"]) < len(JOBS):
        page.missing("The whole study, elastic impact included, is made by (ten CPU minutes)", commands)
