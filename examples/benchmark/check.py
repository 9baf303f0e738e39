#!/usr/bin/python3
"""Compares answers of any code with the reference of elastic-plastic contacts, and prints the table.

    check.py ANSWERS.csv ... [--most U] [--cases]

A file of answers has the columns case,quantity,at,value, with the rows of reference.csv; rows may be missing. The table has each deviation over the
reference in %, and in brackets over the reference's uncertainty. --most U: exit status 1 if an answer is off by more than U uncertainties, or has no number.
--cases: one row a case, with the largest deviation of each code."""
import argparse
import csv
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "common"))
import one_sentence  # noqa: E402, F401

HERE = pathlib.Path(__file__).resolve().parent

def read(path):
    """{(case, quantity, at): row}."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    try:
        found = {(r["case"], r["quantity"], r["at"]): {k: float(r[k]) for k in r if k in ("value", "uncertainty")} for r in rows}
    except (KeyError, TypeError, ValueError) as error:
        raise SystemExit(f"check.py: {path}: the columns are case,quantity,at,value, with numbers in the last: {error}") from None
    if len(found) != len(rows):
        raise SystemExit(f"check.py: {path}: a row stands twice")
    return found

def main(argv=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("answers", nargs="+")
    parser.add_argument("--most", type=float)
    parser.add_argument("--cases", action="store_true")
    args = parser.parse_args(argv)
    reference = read(HERE / "reference.csv")
    codes = {pathlib.Path(path).stem: read(path) for path in args.answers}
    for name, rows in codes.items():
        if unknown := sorted(set(rows) - set(reference)):
            raise SystemExit(f"check.py: {name}: no such row in the reference: {', '.join(unknown[0])}")
    before = "| case | " if args.cases else "| case | quantity | at | reference | "
    print(before + " | ".join(codes) + " |\n|" + "---|" * (before.count("|") - 1 + len(codes)))
    worst = dict.fromkeys(codes, 0.0)
    for case in dict.fromkeys(key[0] for key in reference) if args.cases else ():
        off = {name: [100 * (rows[k]["value"] / row["value"] - 1) for k, row in reference.items() if k[0] == case and k in rows] for name, rows in codes.items()}
        print(f"| {case} | " + " | ".join(f"{max(x, key=abs):+.1f} %" if x else "" for x in off.values()) + " |")
    for key, row in reference.items():
        cells = []
        for name, rows in codes.items():
            if key not in rows:
                cells.append("")
                continue
            off = rows[key]["value"] - row["value"]
            times = abs(off) / row["uncertainty"]
            worst[name] = math.inf if math.isnan(times) else max(worst[name], times)
            cells.append("no number" if math.isnan(times) else f"{100 * off / row['value']:+.1f} % ({times:.1f})")
        if not args.cases:
            print(f"| {key[0]} | {key[1]} | {key[2]} | {row['value']:.4g} ± {row['uncertainty']:.1g} | " + " | ".join(cells) + " |")
    print("| answers within 3 uncertainties | " + ("" if args.cases else "| | | ") +
          " | ".join(f"{sum(abs(r['value'] - reference[k]['value']) <= 3 * reference[k]['uncertainty'] for k, r in rows.items())} of {len(rows)}" for rows in codes.values()) + " |")
    if args.most is not None and (wrong := {n: w for n, w in worst.items() if not w <= args.most}):
        print("check.py: " + "; ".join(f"{n} is off by up to {w:.3g} uncertainties" for n, w in wrong.items()), file=sys.stderr)
        return 1
    return 0

if __name__ == "__main__":
    sys.exit(main())
