"""docs/liggghts-matrix.md from the rows of matrix.py."""
import pathlib
import re

from matrix_known import KNOWN

INTRO = """# The matrix: LIGGGHTS's commands with the models mpm and thornton

Each command of LIGGGHTS's manual that touches a contact, a particle or a wall, tried with both models beside stock `hertz`. Made by
`cmake --build --preset release --target matrix_page`; the test `liggghts_matrix` fails where an outcome turns into a defect that is not listed here.

The scene: eighteen spheres (R = 1.7 mm, powder and glass) thrown at each other over a floor, 600 steps of 0.2 us; a feature changes or adds some lines
(`tests/liggghts/matrix_*.py`). Each feature runs {runs} times:

| runs | what must hold |
|---|---|
| elastic: plain; `energy on contactMap on`; `stretch 3`; all three; on 1 and 2 ranks | Without yield and damping both models are Hertz's law, and with `stretch S` Hertz's law with moduli divided by S^2.5. Thermo values, dumps of particles, contacts and meshes and every file that the feature writes equal stock Hertz's of the same ranks: thornton within {thornton:g} of the largest value of the column, mpm within {mpm:g} (its law is a table, 3e-6 off) |
| elastic and plastic with `energy on` | kinetic + gravity + held + dissipated energy is constant within {energy:g}, unless the feature does work |
| plastic, all three words, on 1 and 2 ranks | the run ends well; no value that is no number; both ranks give the same trajectory within {ranks:g} |

| outcome | meaning |
|---|---|
| same | all of the above |
| runs | the same without the comparison with Hertz, whose numbers are others (history values, say) |
| refused: SENTENCE | the run ends with this sentence |
| as hertz: SENTENCE | stock Hertz is refused as well |
| DEFECT | anything else |

{counts}
"""


def plain(text):
    return re.sub(r"\s+", " ", text).replace("|", "\\|")


def write(path, rows, limits):
    kinds = {}
    for row in rows:
        for model in row.found:
            kind = row.cell(model).split(":")[0].split(" [")[0]
            kinds.setdefault(kind, {}).setdefault(model, 0)
            kinds[kind][model] += 1
    counts = ["| outcome | " + " | ".join(rows[0].found) + " |", "|---|---|---|"]
    counts += [f"| {kind} | " + " | ".join(str(each.get(model, 0)) for model in rows[0].found) + " |" for kind, each in sorted(kinds.items())]
    text = [INTRO.format(counts="\n".join(counts), **limits)]
    if KNOWN:
        text += ["## Known defects", "", "| feature | models | what is seen | why it stands |", "|---|---|---|---|"]
        text += [f"| {'all' if name == '*' else plain(name)} | {', '.join(models)} | {plain(part)} | {plain(why)} |" for name, models, part, why in KNOWN] + [""]
    group = None
    for row in rows:
        if row.feature.group != group:
            group = row.feature.group
            text += [f"## {group}", "", "| feature | mpm | thornton |", "|---|---|---|"]
        cells = [plain(row.cell(model)) for model in row.found]
        text.append(f"| {plain(row.feature.name)} | {cells[0]} | {'the same' if cells[1] == cells[0] and len(cells[0]) > 40 else cells[1]} |")
        following = rows[rows.index(row) + 1:][:1]
        if not following or following[0].feature.group != group:
            text.append("")
    pathlib.Path(path).write_text("\n".join(text).rstrip("\n") + "\n")
