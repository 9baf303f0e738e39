"""(b) Law: table size and time of a lookup against the interpolation error, axes kept and dropped."""
from . import files
from .page import legend_below, number, plt

NAME = "law_size.json"  # of law_size_benchmark
KEYS = ("bytes", "nodes", "slices", "ratio_nodes", "ns_load", "ns_load_low", "ns_load_high", "ns_unload", "ns_unload_low", "ns_unload_high",
        "err_force", "err_e", "err_e_at_inertia_number")


def read(path):
    found = files.read_json(path, benchmark="law_size", rows=list, own_errors=dict, hertz=dict, git_hash=str, material=str)
    files.rows_with(path, found["rows"], KEYS)
    files.rows_with(path, [found["hertz"]], ("ns", "ns_low", "ns_high"))
    return found


def kind(row, full):
    if row["slices"] == 0:
        return "velocity axis dropped"
    return "velocity axis thinned" if row["slices"] < full["slices"] else "velocity axis kept"


def whole(rows):
    """The variant that is the file's own."""
    return max(rows, key=lambda r: (r["nodes"], r["slices"]))


COLOURS = {"velocity axis kept": "tab:blue", "velocity axis thinned": "tab:purple", "velocity axis dropped": "tab:orange"}


def picture(found):
    rows, full = found["rows"], whole(found["rows"])
    own = 100 * max(found["own_errors"].get("atlas_error_restitution", 0), found["own_errors"].get("solver_error_restitution", 0))
    figure, axes = plt.subplots(1, 2, figsize=(9.6, 3.7))
    for axis, key, what in zip(axes, ("err_force", "err_e"), ("force, over the loading force", "e, absolute")):
        seen = set()
        for row in rows:
            error = 100 * row[key]
            if error == 0:
                continue  # the law itself
            name = kind(row, full) + (", as stored" if row["evaluator"] == "curve" else ", as the plug-in reads it")
            stored = row["evaluator"] == "curve"
            axis.loglog(row["bytes"] / 1024, error, linestyle="", marker="o" if stored else "^", color=COLOURS[kind(row, full)],
                        markerfacecolor=None if stored else "white", label=None if name in seen else name)
            seen.add(name)
            if stored:
                axis.annotate(str(row["nodes"]) if row["slices"] in (0, full["slices"]) else f"{row['slices']} slice{'s'[:row['slices'] - 1]}",
                              (row["bytes"] / 1024, error), textcoords="offset points", xytext=(5, 2), fontsize=6.5, color="0.35")
        if own > 0 and key == "err_e":
            axis.axhline(own, color="0.5", lw=0.8)
            axis.annotate("the law's own stated error", (0.02, own), xycoords=("axes fraction", "data"), textcoords="offset points",
                          xytext=(0, -9), fontsize=7, color="0.4")
        axis.set(title="Force" if key == "err_force" else "Restitution", xlabel="kilobytes that a lookup may read", ylabel=f"error of {what}, %")
    handles, names = axes[0].get_legend_handles_labels()
    legend_below(figure, handles, names, 3)
    return figure


def glance(found):
    full, own, rows = whole(found["rows"]), found["own_errors"], []
    stated = 100 * max(own.get("solver_error_force", 0), own.get("atlas_error_force", 0))
    for r in found["rows"]:
        if r["evaluator"] == "fast" and r["nodes"] == full["nodes"] and r["slices"] in (0, full["slices"]):
            rows.append([f"law: lookup by the plug-in, {kind(r, full)}" if full["slices"] else "law: lookup by the plug-in",
                         f"{number(r['ns_load'])} ns loading, {number(r['ns_unload'])} ns unloading\nHertz's formula {number(found['hertz']['ns'])} ns; "
                         f"{r['bytes'] / 1024:.0f} kB", f"force {number(100 * r['err_force'], 2)} %, e {number(r['err_e'], 2)}\nbesides the law's own {stated:.2g} %"])
    return rows


def span(row, name):
    return f"{number(row[name])} ({number(row[name + '_low'])} to {number(row[name + '_high'])})"


def write(page, found, path):
    page.glance(glance(found))
    full, own = whole(found["rows"]), found["own_errors"]
    page.figure(picture(found), "law",
                f"One law ({found['material']}, {full['nodes']} nodes, {full['slices']} impact levels of {full['ratio_nodes']} nodes), thinned; errors "
                "against the law as the file has it, the largest over contacts of all sizes and speeds. Numbers at the points: nodes of the "
                "curve; the law itself has no error here and is left out. The plug-in lays every law out anew on octaves of the overlap, so its size does not fall with the nodes.")
    head = ["curve", "axis", "evaluated by", "kB", "ns, loading: median (range)", "ns, unloading", "force %", "e, absolute"]
    main, every = [], []
    for r in sorted(found["rows"], key=lambda r: (-r["slices"], -r["nodes"], r["evaluator"])):
        row = ([f"{r['nodes']} nodes", kind(r, full) + (f" ({r['slices']} impact levels)" if r["slices"] else ""),
                     "stored table" if r["evaluator"] == "curve" else "plug-in's", f"{r['bytes'] / 1024:.1f}", span(r, "ns_load"),
                     span(r, "ns_unload"), f"{100 * r['err_force']:.2g}", f"{r['err_e']:.1e}" if r["err_e"] else "0"])
        every.append(row)
        if r["nodes"] == full["nodes"] or (r["slices"] == full["slices"] and r["evaluator"] == "curve"):
            main.append(row)
    hertz = found["hertz"]
    main.append(["Hertz's formula", "", "", "0", f"{number(hertz['ns'])} ({number(hertz['ns_low'])} to {number(hertz['ns_high'])})",
                 "the same", "n/a", "n/a"])
    page.table(head, main)
    page.table(head, every, fold=f"All {len(every)} variants")
    stated = f"the solver's error (force {100 * own.get('solver_error_force', 0):.2g} %, e {100 * own.get('solver_error_restitution', 0):.2g} %)"
    if own.get("origin") == "atlas":
        stated += f" and the atlas's (force {100 * own.get('atlas_error_force', 0):.2g} %, e {own.get('atlas_error_restitution', 0):.2g} absolute)"
    page.text(f"A lookup gives force, stiffness and contact radius. What the law itself is wrong by comes on top: {stated}, as its "
              "certificate states.")
    dropped = next((r for r in found["rows"] if r["slices"] == 0 and r["nodes"] == full["nodes"]), None)
    if full["slices"] and dropped:
        page.text(f"Leaving the velocity axis out changes e by up to {dropped['err_e']:.2g}, at I = rho V²/Y = {dropped['err_e_at_inertia_number']:.2g}, and the "
                  f"force on its way by up to {100 * dropped['err_force']:.2g} % of the loading force. `mpm table --deck` keeps the axis only where the "
                  "deck is fast enough for it.")
    page.origin(f"`{path}`: law `{found.get('law', '')}`, commit `{found['git_hash']}`; CPU time, median and range of 15 rounds.")
