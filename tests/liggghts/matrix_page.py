"""docs/evidence/liggghts-matrix.md from the rows of matrix.py."""
import pathlib
import re

from matrix_known import KNOWN

INTRO = """# The matrix: LIGGGHTS's commands with the models mpm and thornton

This page says which of LIGGGHTS's commands work with the models `mpm` and `thornton`. Search it for your command. Each command of the manual that touches a contact, a particle or a wall is tried with both models
beside stock `hertz`.

{counts}

The test `liggghts_matrix` fails where an outcome turns into a defect that is not listed here. `cmake --build --preset release --target matrix_page` makes the page.
"""

HOW = """## How they are tried

Eighteen spheres (R = 1.7 mm, powder and glass) are thrown at each other over a floor, 600 steps of 0.2 us. A feature changes or adds some lines (`tests/liggghts/matrix_*.py`). Each feature runs {runs} times,
fewer where the plain deck is refused:

| runs | what must hold |
|---|---|
| elastic: plain; `energy on contactMap on`; `stretch 3`; all three; on 1 and 2 ranks | Without yield and damping both models are Hertz's law, and with `stretch S` Hertz's law with moduli divided by S^2.5. Thermo values, dumps and every file of the feature equal stock Hertz's of the same ranks: thornton within {thornton:g} of the largest value of the column, mpm within {mpm:g} (its law is a table, 3e-6 off) |
| elastic and plastic with `energy on` | kinetic + gravity + held + dissipated energy, with what waves took, is constant within {energy:g}, unless the feature does work |
| plastic, all three words, on 1 and 2 ranks; mpm also with composed pair laws and `waves on` | the run ends well; every value is a number; both ranks give the same trajectory within {ranks:g} |

Not tried: `fix external`, `couple/cfd` (they need a second program), `sph`, bonds, superquadrics (not of contacts of spheres, or not built), and commands that only move numbers about (`echo`, `group`, `variable`).

One feature: `python3 tests/liggghts/matrix.py WORDS` with the environment of the tests. It runs the features whose group or name holds one of the words.
"""

# outcome of a cell: title, what it says
KINDS = {
    "DEFECT": ("Defects", "Anything else than the outcomes below."),
    "refused": ("Refused", "Stock Hertz runs these features. The models refuse them with a sentence."),
    "as hertz": ("Refused with hertz as well", "LIGGGHTS refuses these features with every model."),
    "runs": ("Runs, with other numbers than hertz", "These work. Their numbers are not compared with Hertz's, which are others (history values, say)."),
    "same": ("Works as with hertz", "All comparisons of the [last section](#how-they-are-tried) hold."),
}
NOTES = """Two things hold with hertz as well. `delete_atoms` and `insert ... compress_tags yes` renumber particles while they touch: LIGGGHTS then loses the history of their contacts, so say `compress no`.
Heat flows through the overlap that LIGGGHTS sees: with `stretch S` it flows as with moduli S^2.5 times smaller.
"""


def plain(text):
    return re.sub(r"\s+", " ", text).replace("|", "\\|")


def kind_of(cell):
    return next(kind for kind in KINDS if kind in cell)


def kind_of_row(row):
    """The first of the kinds, worst first, that either model has."""
    return next(kind for kind in KINDS if kind in map(kind_of, row["cells"].values()))


def sentence(row):
    """What mpm says; thornton's outcome where it is of another kind. Within a kind the sentences differ in the model's name and in numbers only."""
    first, second = row["cells"].values()
    return plain(first) + (f"; thornton: {plain(second)}" if kind_of(second) != kind_of(first) else "")


def write(path, rows, limits):
    """rows: {"group", "name", "cells": {model: outcome}} in the order of the page."""
    models = list(rows[0]["cells"])
    counts = {kind: [sum(kind_of(row["cells"][model]) == kind for row in rows) for model in models] for kind in KINDS}
    table = ["| outcome | " + " | ".join(models) + " |", "|---|---|---|"]
    table += [f"| [{title[0].lower()}{title[1:]}](#{re.sub('[^a-z ]', '', title.lower()).replace(' ', '-')}) | " + " | ".join(map(str, counts[kind])) + " |"
              for kind, (title, _) in KINDS.items() if any(counts[kind])]
    text = [INTRO.format(counts="\n".join(table))]
    if KNOWN:
        text += ["## Known defects", "", "| feature | models | what is seen | why it stands |", "|---|---|---|---|"]
        text += [f"| {'all features' if name == '.*' else plain(name.replace('.*', '...'))} | {', '.join(who)} | {plain(part)} | {plain(why)} |" for name, who, part, why in KNOWN]
        text.append("")
    for kind, (title, what) in KINDS.items():
        own = [row for row in rows if kind_of_row(row) == kind]
        if not own:
            continue
        text += [f"## {title}", "", what, ""]
        groups = dict.fromkeys(row["group"] for row in own)
        if kind in ("runs", "same"):
            for group in groups:
                text += [f"**{plain(group)}.** " + "; ".join(plain(row["name"]) for row in own if row["group"] == group) + ".", ""]
        else:
            text += ["| group | feature | sentence of mpm |", "|---|---|---|"]
            text += [f"| {plain(row['group'])} | {plain(row['name'])} | {sentence(row).removeprefix(kind + ': ')} |" for row in own] + [""]
    pathlib.Path(path).write_text("\n".join(text) + "\n" + NOTES + "\n" + HOW.format(**limits))
