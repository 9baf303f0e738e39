#!/usr/bin/python3
"""Which observables differ between hertz, thornton and mpm, over all decks, from the runs' own CSV files.

    differences.py out [--write]      # --write: into examples/README.md, between its marks

Welch's t test between every two models. Among so many tests some fall below 0.05 by chance: a difference is called significant
where p times the number of tests in the table is below 0.05 (Bonferroni), `perhaps` where only p is."""
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE / "common"))
import one_sentence  # noqa: E402, F401
import marks, sweep  # noqa: E401, E402
from spread import read, resolved, welch  # noqa: E402

DECKS = ("drop", "packing", "heap", "compression", "hopper", "silo")
PAIRS = (("thornton", "hertz"), ("mpm", "hertz"), ("mpm", "thornton"))
# Observables that the law does not change, by the pages, with the margin within which they count as equal. Chosen before the runs with
# more seeds: 5 % of a rate, less than Beverloo's formula is good to; 1 % of a density and of an energy.
UNCHANGED = (("packing", "solid fraction", 0.01), ("hopper", "discharge rate, kg/s", 0.05), ("hopper", "bulk density, kg/m3", 0.01),
             ("hopper", "energy dissipated while filling, J", 0.01), ("silo", "discharge rate, kg/s", 0.05))
SKIP = ("CPU", "particle-steps")  # cost is no observable of the flow


def rows(out):
    """(deck, quantity, {model: Sample}, seeds) of what was run."""
    for deck in DECKS:
        path = out / deck / f"{deck}.csv"
        if not path.exists():
            continue
        samples = read(path)
        models = [m for m in sweep.MODELS if m in samples]
        for quantity in dict.fromkeys(q for m in models for q in samples[m]):
            found = {m: samples[m][quantity] for m in models if quantity in samples[m]}
            if len(found) > 1 and not any(word in quantity for word in SKIP):
                yield deck, quantity, found


def cell(found, pair, tests):
    if not all(m in found for m in pair):
        return ""
    a, b = (found[m] for m in pair)
    p = welch(a, b)
    if p is None:
        return "one seed" if a.error is None or b.error is None else "no spread"
    change = f"{100 * (a.mean / b.mean - 1):+.1f} %" if b.mean else f"{a.mean - b.mean:+.2g}"
    if p >= 0.05:
        return f"no ({change}, p = {p:.2g})"
    return f"**yes**, {change}, p = {p:.1g}" if p * tests < 0.05 else f"perhaps, {change}, p = {p:.2g}"


def table(out):
    found = list(rows(out))
    tests = sum(all(m in f for m in pair) and welch(f[pair[0]], f[pair[1]]) is not None for _, _, f in found for pair in PAIRS)
    lines = [f"{tests} tests. Mean ± standard error of the seeds.", "",
             "| deck (seeds) | observable | " + " | ".join(sweep.MODELS) + " | " + " | ".join(f"{a} differs from {b}" for a, b in PAIRS) + " |",
             "|---|---|" + "---|" * (len(sweep.MODELS) + len(PAIRS))]
    alike = {}
    for deck, quantity, f in found:
        seeds = min(s.values.size for s in f.values())
        verdicts = [cell(f, pair, tests) for pair in PAIRS]
        if all(v == "" or v.startswith("no (") for v in verdicts):
            alike.setdefault(f"{deck} ({seeds})", []).append(quantity)
            continue
        lines.append(f"| {deck} ({seeds}) | {quantity} | " + " | ".join(str(f.get(m, "")) for m in sweep.MODELS) + " | " + " | ".join(verdicts) + " |")
    if alike:
        lines += ["", "No two models differ (p over 0.05) in:", ""]
        for deck, quantities in alike.items():
            lines += [f"- {deck}:", *(f"  - {quantity}" for quantity in quantities)]
    return "\n".join(lines + [""] + equivalence(found)) + "\n"


def equivalence(found):
    """Margin within which each observable that should not change is equal (two one-sided tests, each at 5 %)."""
    lines = ["| deck (seeds) | observable | margin | " + " | ".join(f"{a} and {b}" for a, b in PAIRS) + " |", "|---|---|---|" + "---|" * len(PAIRS)]
    for deck, quantity, margin in UNCHANGED:
        for name, what, f in found:
            if (name, what) == (deck, quantity):
                least = [resolved(f[a], f[b]) if a in f and b in f else None for a, b in PAIRS]
                cells = ["" if m is None else f"equal within {100 * m:.1f} %" if m <= margin else f"not resolved below {100 * m:.1f} %" for m in least]
                lines.append(f"| {deck} ({min(s.values.size for s in f.values())}) | {quantity} | {100 * margin:g} % | " + " | ".join(cells) + " |")
    return ["Observables that should not change, by two one-sided tests, each at 5 %:", "", *lines] if len(lines) > 2 else []


def main(argv=None):
    marks.command(__doc__, HERE / "README.md", "differences.py", table, argv)


if __name__ == "__main__":
    main()
