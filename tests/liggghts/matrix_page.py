"""docs/evidence/liggghts-matrix.md from the rows of matrix.py."""
import pathlib
import re

from matrix_known import KNOWN

INTRO = """# The matrix: LIGGGHTS's commands with the models mpm and thornton

This page shows which of LIGGGHTS's commands work with the models `mpm` and `thornton`. Each command of the manual that touches a contact, a particle or a wall was tried with both models beside stock `hertz`.
`same` means that it works as with hertz. What is refused stands in the first table, all features in the last part.

`cmake --build --preset release --target matrix_page` makes the page. The test `liggghts_matrix` fails where an outcome turns into a defect that is not listed here.

The scene: eighteen spheres (R = 1.7 mm, powder and glass) thrown at each other over a floor, 600 steps of 0.2 us; a feature changes or adds some lines
(`tests/liggghts/matrix_*.py`). Each feature runs {runs} times (fewer where the plain deck is refused):

| runs | what must hold |
|---|---|
| elastic: plain; `energy on contactMap on`; `stretch 3`; all three; on 1 and 2 ranks | Without yield and damping both models are Hertz's law, and with `stretch S` Hertz's law with moduli divided by S^2.5. Thermo values, dumps of particles, contacts and meshes and every file that the feature writes equal stock Hertz's of the same ranks: thornton within {thornton:g} of the largest value of the column, mpm within {mpm:g} (its law is a table, 3e-6 off) |
| elastic and plastic with `energy on` | kinetic + gravity + held + dissipated energy, with what waves took, is constant within {energy:g}, unless the feature does work |
| plastic, all three words, on 1 and 2 ranks; mpm also with composed pair laws and `waves on` | the run ends well; no value that is no number; both ranks give the same trajectory within {ranks:g} |

| outcome | meaning |
|---|---|
| same | all of the above |
| runs | the same without the comparison with Hertz, whose numbers are others (history values, say) |
| refused: SENTENCE | the run ends with this sentence |
| as hertz: SENTENCE | stock Hertz is refused as well |
| DEFECT | anything else |

Not tried: `fix external`, `couple/cfd` (they need a second program), `sph`, bonds, superquadrics (not of contacts of spheres, or not built), and what only moves numbers about
(`echo`, `group`, `variable` beyond their use here). `delete_atoms` and `insert ... compress_tags yes` renumber particles while they touch: LIGGGHTS then loses the history of their
contacts, of hertz as well; say `compress no`. Heat flows through the overlap that LIGGGHTS sees: with `stretch S` it flows as if the moduli were S^2.5 times smaller.

One feature: `python3 tests/liggghts/matrix.py WORDS` with the environment of the tests; features whose group or name holds one of the words are run.

{counts}
"""


def plain(text):
    return re.sub(r"\s+", " ", text).replace("|", "\\|")


def line(row, group=""):
    first, second = (plain(cell) for cell in row["cells"].values())
    return f"| {group}{plain(row['name'])} | {first} | {'the same words' if second == first and len(first) > 40 else second} |"


def write(path, rows, limits):
    """rows: {"group", "name", "cells": {model: outcome}} in the order of the page."""
    models = list(rows[0]["cells"])
    kinds = {}
    for row in rows:
        for model, cell in row["cells"].items():
            kind = next(k for k in ("DEFECT", "refused", "as hertz", "same", "runs") if k in cell)
            kinds.setdefault(kind, dict.fromkeys(models, 0))[model] += 1
    counts = ["| outcome | " + " | ".join(models) + " |", "|---|---|---|"]
    counts += [f"| {kind} | " + " | ".join(str(each[model]) for model in models) + " |" for kind, each in sorted(kinds.items())]
    text = [INTRO.format(counts="\n".join(counts), **limits)]
    if KNOWN:
        text += ["## Known defects", "", "| feature | models | what is seen | why it stands |", "|---|---|---|---|"]
        text += [f"| {'all features' if name == '.*' else plain(name.replace('.*', '...'))} | {', '.join(who)} | {plain(part)} | {plain(why)} |" for name, who, part, why in KNOWN]
        text.append("")
    text += ["## Refused", "", "Features that stock Hertz runs and these models refuse.", "", "| group | feature | " + " | ".join(models) + " |", "|---|---|---|---|"]
    text += [line(row, f"{plain(row['group'])} | ") for row in rows if any(cell.startswith("refused") for cell in row["cells"].values())]
    text += ["", "## All features"]
    group = None
    for row in rows:
        if row["group"] != group:
            text += ["", f"### {row['group']}", "", "| feature | " + " | ".join(models) + " |", "|---|---|---|"]
            group = row["group"]
        text.append(line(row))
    pathlib.Path(path).write_text("\n".join(text) + "\n")
