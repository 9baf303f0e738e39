"""docs/evidence/liggghts-matrix.md from the rows of matrix.py."""
import pathlib
import re

from matrix_between import COMMANDS
from matrix_between import rows as between_rows
from matrix_known import KNOWN

INTRO = """# The matrix: LIGGGHTS's commands with the models mpm and thornton

Search for your command. Of {count} commands, options and situations, {same} work under `mpm` and `thornton` as with stock `hertz`. A refused one stops the simulation with a message.

{counts}

The test `liggghts_matrix` checks these outcomes. `cmake --build --preset release --target matrix_page` makes the page.
"""

HOW = """## How they are tried

Eighteen spheres (R = 1.7 mm, powder and glass) collide over a floor, 600 steps of 0.2 us. Each command or option changes or adds some lines (`tests/liggghts/matrix_*.py`). It runs {runs} times with both models beside stock `hertz`, fewer if the plain deck is refused:

| runs | what must hold |
|---|---|
| elastic: plain; `energy on contactMap on`; `stretch 3`; all three; on 1 and 2 ranks | Without yield and damping both models are Hertz's law, and with `stretch S` Hertz's law with moduli divided by S^2.5. Thermo values, dumps and every file equal those of stock Hertz on as many ranks. Tolerance: thornton {thornton:g} of the largest value of the column, mpm {mpm:g} (its law is a table, 3e-6 off) |
| elastic and plastic with `energy on` | The sum of kinetic energy, gravity, energy held, energy dissipated and energy that waves took is constant within {energy:g}, unless the command does work |
| plastic, all three words, on 1 and 2 ranks; mpm also with composed pair laws and `waves on` | The run ends well; every value is a number; both ranks give the same trajectory within {ranks:g} |

Not tried: `fix external` and `couple/cfd`, which need a second program; `sph`, bonds and superquadrics, which are not contacts of spheres or not built.

`python3 tests/liggghts/matrix.py WORDS`, with the environment of the tests, tries those whose group or name contains a word.
"""

# outcome of a cell: title, what it says
KINDS = {
    "DEFECT": ("Defects", "Anything else than the outcomes below."),
    "refused": ("Refused", "The message is that of mpm; thornton's differs in the model's name. With stock Hertz these work, or crash."),
    "as hertz": ("Refused with hertz as well", "LIGGGHTS refuses these with every model, or crashes."),
    "kept": ("Works where stock hertz loses histories", "Stock LIGGGHTS gives the histories of contacts to other pairs here, or writes them one step old; `liggghts-mpm` does not, with hertz either. "
             "All comparisons of the [last section](#how-they-are-tried) hold, with hertz in `liggghts-mpm`."),
    "runs": ("Runs, with other numbers than hertz", "Their numbers differ from Hertz's by nature (history values, for instance), so they are not compared."),
    "same": ("Works as with hertz", "All comparisons of the [last section](#how-they-are-tried) hold."),
}
NOTES = """With every model heat flows through the geometric overlap ([heat](../reference/pair_gran_model_mpm.md#heat)). With `stretch S` it flows as with moduli S^2.5 times smaller.
"""
BETWEEN = """## Between two runs

A pressed bed of 64 spheres is stopped, one or several commands follow, and it goes on. Its state is then that of the unbroken simulation within 1e-9: mpm and thornton, 1 and 2 ranks, {count} rows. So it is with a restart file written behind each command and read on the other number of ranks. Tests: `liggghts_between_runs`, `liggghts_between_runs_thorough`.

Tried: {tried}.

| not between two runs | commands |
|---|---|
{others}
"""
# Characters of a sentence that the page shows: the rest lists what is allowed, as the run does.
SHOWN = 240


def plain(text):
    return re.sub(r"\s+", " ", text).replace("|", "\\|")


def kind_of(cell):
    return next(kind for kind in KINDS if kind in cell)


def kind_of_row(row):
    """The first of the kinds, worst first, that either model has."""
    return next(kind for kind in KINDS if kind in map(kind_of, row["cells"].values()))


def sentence(row, kind):
    """Outcome of mpm; thornton's where it is of another kind. Within a kind the sentences differ in the model's name and in numbers only."""
    first, second = row["cells"].values()
    text = plain(first) + (f"; thornton: {plain(second)}" if kind_of(second) != kind_of(first) else "")
    text = text.removeprefix(kind + ": ").removeprefix("ERROR: ")
    text = re.sub(r"ends with -(\d+) and no sentence", r"crashes without a sentence (signal \1)", text)
    return text if len(text) <= SHOWN else text[:SHOWN].rsplit(" ", 1)[0] + " ..."


def by_sentence(rows, kind):
    """{(group, sentence): names}: what stops with the same words stands on one line."""
    found = {}
    for row in rows:
        found.setdefault((row["group"], sentence(row, kind)), []).append(row["name"])
    return found


def between_runs():
    """The section of what stands between two runs."""
    others = {}
    for command, what in COMMANDS.items():
        if isinstance(what, str):
            others.setdefault(what, []).append(f"`{command}`")
    tried = ", ".join(f"`{command}`" for command, what in COMMANDS.items() if not isinstance(what, str))
    return BETWEEN.format(count=len(between_rows()), tried=tried, others="\n".join(f"| {why} | {', '.join(names)} |" for why, names in others.items()))


def write(path, rows, limits):
    """rows: {"group", "name", "cells": {model: outcome}} in the order of the page."""
    models = list(rows[0]["cells"])
    counts = {kind: [sum(kind_of(row["cells"][model]) == kind for row in rows) for model in models] for kind in KINDS}
    table = ["| outcome | " + " | ".join(models) + " |", "|---|---|---|"]
    table += [f"| [{title[0].lower()}{title[1:]}](#{re.sub('[^a-z ]', '', title.lower()).replace(' ', '-')}) | " + " | ".join(map(str, counts[kind])) + " |"
              for kind, (title, _) in KINDS.items() if any(counts[kind])]
    text = [INTRO.format(count=len(rows), same=min(counts["same"]), counts="\n".join(table))]
    if KNOWN:
        text += ["## Known defects", "", "| command or option | models | what is seen | why it stands |", "|---|---|---|---|"]
        text += [f"| {'all' if name == '.*' else plain(name.replace('.*', '...'))} | {', '.join(who)} | {plain(part)} | {plain(why)} |" for name, who, part, why in KNOWN]
        text.append("")
    for kind, (title, what) in KINDS.items():
        own = [row for row in rows if kind_of_row(row) == kind]
        if not own:
            continue
        text += [f"## {title}", "", what, ""]
        groups = dict.fromkeys(row["group"] for row in own)
        if kind in ("kept", "runs", "same"):
            for group in groups:
                text += [f"**{plain(group)}.** " + "; ".join(plain(row["name"]) for row in own if row["group"] == group) + ".", ""]
        else:
            text += ["| group | command or option | sentence |", "|---|---|---|"]
            text += [f"| {plain(group)} | {plain('; '.join(names))} | {said} |" for (group, said), names in by_sentence(own, kind).items()] + [""]
    pathlib.Path(path).write_text("\n".join(text) + "\n" + NOTES + "\n" + between_runs() + "\n" + HOW.format(**limits))
