"""The results of tools/faults in words: a table for the terminal, a page for docs."""
import csv
from collections import Counter

from faulting.rules import FOLDERS, KINDS

VERDICTS = ("caught", "survived", "no change seen", "not compiled")


def score(results):
    """(caught, all that change a result)."""
    count = Counter(r["verdict"] for r in results)
    return count["caught"], count["caught"] + count["survived"]


def counts(results, key, names):
    count = Counter((r[key], r["verdict"]) for r in results)
    return [(name, [count[name, v] for v in VERDICTS]) for name in names if any(count[name, v] for v in VERDICTS)]


def total(results):
    count = Counter(r["verdict"] for r in results)
    return ("all", [count[v] for v in VERDICTS])


def table(results):
    rows = counts(results, "kind", KINDS) + counts(results, "folder", FOLDERS) + [total(results)]
    lines = [f"{'':24}" + "".join(f"{v:>16}" for v in VERDICTS)]
    lines += [f"{name:24}" + "".join(f"{n:>16}" for n in numbers) for name, numbers in rows]
    for verdict in VERDICTS[1:3]:
        for r in (r for r in results if r["verdict"] == verdict):
            lines += [f"{verdict}: {r['file']}:{r['line']}", f"    {r['before']}", f"    {r['after']}"]
            lines += [f"    changes {', '.join(r['changed'])}"] if r["changed"] else []
    caught, changing = score(results)
    lines.append(f"{caught} of {changing} faults that change a result are caught")
    return "\n".join(lines)


def change(before, after):
    """Difference between the two lines, with its surroundings up to a word's end on both sides."""
    start = 0
    while start < min(len(before), len(after)) and before[start] == after[start]:
        start += 1
    end = 0
    while end < min(len(before), len(after)) - start and before[-1 - end] == after[-1 - end]:
        end += 1
    start, end = max(0, start - 24), max(0, end - 24)
    cut = lambda t: ("..." if start else "") + t[start:len(t) - end].strip() + ("..." if end else "")
    return cut(before), cut(after)


def write_uncaught(results, path):
    """CSV of the faults that no test caught; `note`: the outputs of the battery that changed."""
    with path.open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["verdict", "kind", "file", "line", "with_the_fault", "note"])
        for verdict in ("survived", "no change seen"):
            for r in sorted((r for r in results if r["verdict"] == verdict), key=lambda r: (FOLDERS.index(r["folder"]), r["file"], r["line"])):
                writer.writerow([verdict, r["kind"] + (" (by hand)" if r["named"] else ""), r["file"], *change(r["before"], r["after"]),
                                 ", ".join(r.get("changed", []))])


def summary(results, seed, picked):
    """What stands between the marks of the page. `picked`: how many faults there are, done or not."""
    caught, changing = score(results)
    return (f"**{caught} of the {changing} faults that change a result are caught ({100 * caught / max(1, changing):.0f} %).** "
            f"Seed {seed}, {sum(r['named'] for r in results)} faults chosen by hand; {len(results)} of {picked} are done.\n")
