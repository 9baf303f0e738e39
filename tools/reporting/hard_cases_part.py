"""The hard cases of the solver: tools/hard_cases."""
from . import files
from .page import number

NAME = "hard-cases.json"


def read(path):
    found = files.read_json(path, mpm=str, runs=dict)
    if not isinstance(found.get("rows"), list):
        raise files.Unreadable(path, "has no 'rows': an older tools/hard_cases made it; call it again")
    for k, row in enumerate(found["rows"], 1):
        if not isinstance(row, dict) or not all(isinstance(row.get(key), str) for key in ("name", "stress", "verdict", "command")):
            raise files.Unreadable(path, f"row {k}: expected 'name', 'stress', 'verdict' and 'command'")
    return found


def percent(value):
    return "" if value is None else f"{100 * value:+.1f} %"


def small(value):
    return "" if value is None else f"{value:.0e}"


def write(page, found, path):
    rows = found["rows"]
    failed = [r["name"] for r in rows if r["verdict"].startswith("FAILED")]
    refused = [r["name"] for r in rows if r["verdict"].startswith("refused")]
    energy = max((r["energy_error"] for r in rows if r.get("energy_error") is not None), default=None)
    page.glance([[f"hard cases of the solver: {len(rows)}", f"{sum(r.get('cpu_s') or 0 for r in rows):.0f} CPU s in all",
                  f"{len(failed)} failed, {len(refused)} refused" + (f"\nenergy error at most {energy:.0e}" if energy is not None else "")]])
    page.text(f"{len(rows)} cases: {len(rows) - len(failed) - len(refused)} stable with their energy balance closed, {len(refused)} refused with a "
              f"sentence, {len(failed)} failed" + (": **" + "**, **".join(failed) + "**." if failed else "."))
    page.table(["case", "stressed by", "e", "from grid to grid", "deviation from reference", "reference", "energy error", "δ_max/R", "steps",
                "CPU s", "verdict"],
               [[r["name"], r["stress"], "" if r.get("e") is None else f"{r['e']:.4f}", percent(r.get("change")), percent(r.get("deviation")),
                 r.get("reference", ""), small(r.get("energy_error")), "" if r.get("depth") is None else f"{r['depth']:.3g}",
                 "" if r.get("steps") is None else str(r["steps"]), "" if r.get("cpu_s") is None else number(r["cpu_s"], 2), r["verdict"]]
                for r in rows], fold=f"All {len(rows)} cases")
    page.origin(f"`{path}`, made with {found['mpm']}; from grid to grid: what the coarser grid does to e; CPU seconds of a shared machine, to be "
                "read to a factor of two. Each row is one command: `tools/hard_cases --commands` prints it.")
