#!/usr/bin/python3
"""Which observables differ between hertz, thornton and mpm, over all decks, from the runs' own CSV files.

    differences.py out [--write]      # --write: into examples/differences.csv

Welch's t test between every two models. Among so many tests some fall below 0.05 by chance: a difference is called significant
where p times the number of tests in the table is below 0.05 (Bonferroni), `perhaps` where only p is."""
import csv
import io
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE / "common"))
import one_sentence  # noqa: E402, F401
import marks, sweep  # noqa: E401, E402
from spread import read, resolved, welch  # noqa: E402

DECKS = ("drop", "packing", "heap", "compression", "hopper", "silo")
PAIRS = (("thornton", "hertz"), ("mpm", "hertz"), ("mpm", "thornton"))
# Observables that should not change: the margin within which two models are equal by two one-sided tests, each at 5 %.
UNCHANGED = (("packing", "solid fraction"), ("hopper", "discharge rate, kg/s"), ("hopper", "bulk density, kg/m3"), ("hopper", "energy dissipated while filling, J"),
             ("silo", "discharge rate, kg/s"))
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
    return f"yes, {change}, p = {p:.1g}" if p * tests < 0.05 else f"perhaps, {change}, p = {p:.2g}"


def table(out):
    """The CSV of all observables."""
    found = list(rows(out))
    tests = sum(all(m in f for m in pair) and welch(f[pair[0]], f[pair[1]]) is not None for _, _, f in found for pair in PAIRS)
    file = io.StringIO(f"# {tests} tests (Welch). Mean ± standard error of the seeds. yes: p times the number of tests is below 0.05; perhaps: only p is\n")
    file.seek(0, io.SEEK_END)
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(["deck", "seeds", "observable", *sweep.MODELS, *(f"{a} differs from {b}" for a, b in PAIRS), *(f"{a} and {b} equal within %" for a, b in PAIRS)])
    for deck, quantity, f in found:
        seeds = min(s.values.size for s in f.values())
        margins = [f"{100 * resolved(f[a], f[b]):.1f}" if (deck, quantity) in UNCHANGED and a in f and b in f else "" for a, b in PAIRS]
        writer.writerow([deck, seeds, quantity, *(str(f.get(m, "")) for m in sweep.MODELS), *(cell(f, pair, tests) for pair in PAIRS), *margins])
    return file.getvalue()


def main(argv=None):
    marks.command(__doc__, HERE / "differences.csv", None, table, argv)


if __name__ == "__main__":
    main()
