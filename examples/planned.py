#!/usr/bin/python3
"""Speeds that `mpm plan DECK` predicts beside those that the deck's runs visited (stats.json), for every example that was run.

    planned.py out [--write]      # --write: into examples/planned.csv

Largest speeds over all seeds; "yielding body": ratio of its speeds (half a like pair's, a wall's own)."""
import csv
import io
import json
import pathlib
import shlex
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE / "common"))
import one_sentence  # noqa: E402, F401
import marks, sweep  # noqa: E401, E402

def variables(command):
    """The deck and {name: value} of `-var name value...`."""
    words, found, name = shlex.split(command), {}, None
    deck = words[words.index("-in") + 1]
    for word in words[words.index("-log") + 2:]:
        if word == "-var":
            name = ""
        elif name == "":
            name = word
            found[name] = []
        else:
            found[name].append(word)
    return deck, {k: " ".join(v) for k, v in found.items()}


def words_of(folder):
    """The deck of a run, and the words that give `mpm plan` its variables; paths from the folder where the runs were started."""
    deck, given = variables((folder / "command").read_text())
    words = []
    for name, value in given.items():
        path = pathlib.Path(value)
        words += ["--var", name, str(path.resolve()) if path.exists() else value or " "]
    return deck, words


def planned(folder):
    """{"pair": m/s, "wall": m/s} by `mpm plan`."""
    deck, words = words_of(folder)
    command = [sweep.program("mpm"), "plan", deck, "--json", *words]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(f"{' '.join(command)}\n{done.stderr}")
    plan = json.loads(done.stdout)
    speeds = {"pair": 0.0, "wall": 0.0}
    for p in plan["pairs"]:
        side = "wall" if p["wall"] else "pair"
        speeds[side] = max(speeds[side], p["speed_max_m_per_s"])
    return speeds, plan


def quantile(contacts, share):
    """Speed that this fraction of a side's contacts does not exceed, of its statistics: evenly in ln(speed) within a bin; 0 of none."""
    largest, seen = contacts["impact_speed_max_m_per_s"] or 0.0, contacts["impact_speed"]
    left = share * sum(seen["count"])
    for low, count in zip(seen["lower_edge"], seen["count"]):
        if count and left <= count:
            return min(largest, low * 10 ** (left / count / seen["bins_per_decade"]))
        left -= count
    return largest


def visited(folders, share=1.0):
    """{"pair": m/s, "wall": m/s} that this fraction of the contacts of each run did not exceed."""
    speeds = {"pair": 0.0, "wall": 0.0}
    for folder in folders:
        stats = json.loads((folder / "stats.json").read_text())
        for side in speeds:
            speeds[side] = max(speeds[side], quantile(stats[side], share))
    return speeds


def body(speeds):
    """Speed of the yielding body: each of a like pair has half the relative speed."""
    return max(speeds["pair"] / 2, speeds["wall"])


def compare(deck, share=1.0):
    """(model, number of runs, planned, visited, the plan) of each model's finished runs in the folder `deck`."""
    runs = [f for f in sorted(deck.glob("*-[0-9]*")) if (f / "done").exists() and (f / "stats.json").exists()]
    for model in sweep.MODELS:
        mine = [f for f in runs if f.name.startswith(f"{model}-") and f.name[len(model) + 1].isdigit()]
        if mine:
            bounds = [planned(f) for f in mine]
            yield model, len(mine), {side: max(b[side] for b, _ in bounds) for side in ("pair", "wall")}, visited(mine, share), bounds[0][1]


def table(out):
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(["deck", "model", "runs", "pairs planned m/s", "pairs visited m/s", "walls planned m/s", "walls visited m/s", "ratio of the yielding particle"])
    for deck in sorted(p for p in out.iterdir() if p.is_dir()):
        for model, runs, bound, seen, plan in compare(deck):
            writer.writerow([deck.name, model, runs, *(f"{speeds[side]:.3g}" for side in bound for speeds in (bound, seen)), f"{body(bound) / body(seen):.2f}"])
            for key in ("asks_for", "not_followed"):
                for what in plan[key]:
                    writer.writerow([deck.name, model, f"{key.replace('_', ' ')}: {what}"])
    return file.getvalue()


def main(argv=None):
    marks.command(__doc__, HERE / "planned.csv", None, table, argv)


if __name__ == "__main__":
    main()
