"""(b) Law: size and time of a lookup with the velocity axis and without it, and what leaving it out costs."""
import math

from . import files
from .page import number

NAME = "law_size.json"  # of law_size_benchmark
KEYS = ("bytes", "nodes", "slices", "ratio_nodes", "ns_load", "ns_load_low", "ns_load_high", "ns_unload", "ns_unload_low", "ns_unload_high",
        "err_force", "err_e", "err_e_at_inertia_number")


def read(path):
    found = files.read_json(path, benchmark="law_size", rows=list, own_errors=dict, hertz=dict, git_hash=str, material=str)
    files.rows_with(path, found["rows"], KEYS)
    files.rows_with(path, [found["hertz"]], ("ns", "ns_low", "ns_high"))
    return found


def kind(row):
    return "velocity axis kept" if row["slices"] else "velocity axis dropped"


def whole(rows):
    """The variant that is the file's own."""
    return max(rows, key=lambda r: r["slices"])


def glance(found):
    full, own, rows = whole(found["rows"]), found["own_errors"], []
    stated = 100 * math.hypot(own.get("solver_error_force", 0), own.get("atlas_error_force", 0))
    for r in found["rows"]:
        rows.append([f"law: lookup by the plug-in, {kind(r)}" if full["slices"] else "law: lookup by the plug-in",
                     f"{number(r['ns_load'])} ns loading, {number(r['ns_unload'])} ns unloading\nHertz's formula {number(found['hertz']['ns'])} ns; "
                     f"{r['bytes'] / 1024:.0f} kB", f"force {number(100 * r['err_force'], 2)} %, e {number(r['err_e'], 2)}\nbesides the law's own {stated:.2g} %"])
    return rows


def span(row, name):
    return f"{number(row[name])} ({number(row[name + '_low'])} to {number(row[name + '_high'])})"


def write(page, found, path):
    page.glance(glance(found))
    full, own = whole(found["rows"]), found["own_errors"]
    rows = [[kind(r), f"{r['bytes'] / 1024:.1f}", span(r, "ns_load"), span(r, "ns_unload"), f"{100 * r['err_force']:.2g}",
             f"{r['err_e']:.1e}" if r["err_e"] else "0"] for r in found["rows"]]
    hertz = found["hertz"]
    rows.append(["Hertz's formula", "0", f"{number(hertz['ns'])} ({number(hertz['ns_low'])} to {number(hertz['ns_high'])})", "the same", "n/a", "n/a"])
    page.text(f"One law ({found['material']}, {full['nodes']} nodes, {full['slices']} impact levels of {full['ratio_nodes']} nodes); errors against "
              "the law as the file has it, the largest over contacts of all sizes and speeds.")
    page.table(["law", "kB", "ns, loading: median (range)", "ns, first step after a reversal", "force %", "e, absolute"], rows)
    stated = f"the solver's error (force {100 * own.get('solver_error_force', 0):.2g} %, e {100 * own.get('solver_error_restitution', 0):.2g} %)"
    if own.get("origin") == "atlas":
        stated += f" and the atlas's (force {100 * own.get('atlas_error_force', 0):.2g} %, e {own.get('atlas_error_restitution', 0):.2g} absolute)"
    page.text(f"A lookup gives force, stiffness and contact radius. What the law itself is wrong by comes on top: {stated}, as its "
              "certificate states.")
    dropped = next((r for r in found["rows"] if r["slices"] == 0), None)
    if full["slices"] and dropped:
        page.text(f"Leaving the velocity axis out changes e by up to {dropped['err_e']:.2g}, at I = rho V²/Y = {dropped['err_e_at_inertia_number']:.2g}, and the "
                  f"force on its way by up to {100 * dropped['err_force']:.2g} % of the loading force. `mpm table --deck` keeps the axis only where the "
                  "deck is fast enough for it.")
    page.origin(f"`{path}`: law `{found.get('law', '')}`, commit `{found['git_hash']}`; CPU time, median and range of 15 rounds.")
