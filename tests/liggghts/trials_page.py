#!/usr/bin/python3
"""docs/evidence/trials.md from the tests themselves: trials_page.py DOCS_FOLDER (the target trials_page sets the environment).

Runs test_restitution, test_drop50, test_invariance (full: 10,000 steps), test_geometry and test_hard_cases (full: a million steps), keeps what they measured in
trials_rows/rows.jsonl and writes it. trials_page.py DOCS_FOLDER ROWS.jsonl makes the page from rows that are there."""
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).parent
QUICK = ("test_restitution.py", "test_drop50.py", "test_invariance.py::TestForces", "test_invariance.py::TestRejoin", "test_geometry.py")
FULL = ("test_invariance.py::TestCollapse", "test_hard_cases.py")

INTRO = """# Trials of the LIGGGHTS models

Forces and trajectories of the models `mpm` and `thornton` do not depend on LIGGGHTS's bookkeeping: ranks, neighbour lists, restarts, meshes, moving walls. Every trial is within the limit of its test:

`mpm` follows the synthetic law of `tests/unit/synthetic_law.hpp` (E*/Y = 100), R = 1.7 mm. `hertz` (without damping) and `thornton_ning` are stock models, at `contact_distance_factor 1.01`.
`cmake --build --preset release --target trials_page` makes the page.
"""

OURS = ("mpm", "thornton")


def worst(key, own=lambda row: row["model"] in OURS):
    """The largest |row[key]| of our models' rows; not a number where one is none."""
    return lambda rows: float(np.max([abs(row[key]) for row in rows if own(row)]))


def farthest(key, law, own=lambda row: True):
    """The largest |e - law|."""
    return lambda rows: float(np.max([abs(row[key] - row[law]) for row in rows if own(row) and row[law] is not None]))


# rows of the first table: a table below, what is measured, the test's limit, the largest value of our models
SUMMARY = (
    ("drop worst", "50 drops on a wall, 50 pairs: difference of e from the integration of the law", "0.005", worst("worst", own=lambda row: True)),
    ("forces", "exchange, rebuild, sorting: difference of a force, over the largest force", "1e-12", worst("difference")),
    ("collapse", "1, 2, 4 ranks, restarts, rebuilds: difference of a position, over R", "100 times the yardstick", worst("difference")),
    ("rejoin", "a pair that meets again: difference of e from a virgin pair", "1 %", farthest("e", "virgin")),
    ("flat", "a flat mesh: difference of the force from that of a plane, over the largest force", "1e-9", worst("difference")),
    ("squeezed", "a sphere between floor and lid: change of force in a step, over what the stiffness allows", "1",
     lambda rows: max(row["jump"] / row["limit"] for row in rows if row["model"] in OURS)),
    ("curved", "a curved trough: contacts begun, less strips passed", "2",
     lambda rows: max(row["contacts"] - row["strips"] for row in rows if row["model"] in OURS)),
    ("ridge", "a ridge of a mesh: energy gained, less what the statistics name", "0.05",
     lambda rows: max(row["gained"] - row["brought"] for row in rows if row["model"] in OURS)),
    ("moving", "a mesh that moves: difference of e from a mesh at rest", "0.1 %",
     lambda rows: max(abs(row["e"] - rest["e"]) for row in rows for rest in rows if rest["model"] == row["model"] and rest["mesh"] == 0)),
    ("particles", "frozen spheres, rigid bodies, periodic boundaries: difference of e from the expected one", "1 %", farthest("e", "expected")),
    ("insertion", "insertion while running: growth of energy between insertions", "0.02", worst("gained", own=lambda row: True)),
    ("steps", "50 steps a contact: difference of e from the law", "0.001", farthest("e", "law", lambda row: row["steps"] == 50)),
    ("ratios", "moduli 1:1000, radii 1:10: difference of e from the law", "0.3 %", farthest("e", "law")),
    ("rest", "a bed without damping: growth of energy, over the start's", "1e-3", worst("gained")),
    ("default damping", "a bed that comes to rest: rise of the mechanical energy", "1e-3", worst("growth")),
    ("at rest", "a bed that lies still: motion", "1e-9", worst("moves")),
    ("shaken", "a shaken floor: fastest sphere over the floor's speed", "6", lambda rows: max(row["fastest"] / row["floor"] for row in rows if row["model"] in OURS)),
)


def list_of(*columns):
    """The rows as they are; columns: (head, key)."""
    return lambda rows: [[head for head, _ in columns]] + [[cell(row[key]) for _, key in columns] for row in rows]


def grid_of(lines, across, *values, last=()):
    """A line for each combination of `lines` (head, key), a column for each of `across` and of `values` (head, key); `last`: columns of the line's first row."""
    def make(rows):
        heads = list(dict.fromkeys(row[across] for row in rows))
        found = {}
        for row in rows:
            found.setdefault(tuple(row[key] for _, key in lines), {})[row[across]] = row
        table = [[head for head, _ in lines] + [f"{head} {cell(column)}".strip() for head, _ in values for column in heads] + [head for head, _ in last]]
        for own, by_column in found.items():
            first = next(iter(by_column.values()))
            table.append([cell(value) for value in own] + [cell(by_column[c][key]) if c in by_column else "" for _, key in values for c in heads] +
                         [cell(first[key]) for _, key in last])
        return table
    return make


def both_orders(rows):
    """Pairs that were run in either order, side by side: the second run is the first with the bodies exchanged."""
    table = [["case", "model", "V m/s", "e", "e, bodies exchanged", "law"]]
    for one, other in zip(rows[::2], rows[1::2]):
        table.append([cell(one[key]) for key in ("case", "model", "speed", "e")] + [cell(other["e"]), cell(one["law"])])
    return table


def by_yardstick(rows):
    table = grid_of((("way", "way"),), "model", ("", "difference"))(rows)
    return table + [["*yardstick*"] + [cell(next(row["yardstick"] for row in rows if row["model"] == model)) for model in table[0][1:]]]


def of_each_kind(rows):
    """One rank's lines; of those that differ in numbers only, the first."""
    kinds = {}
    for row in rows:
        if row["ranks"] == 1:
            kinds.setdefault(re.sub(r"\(.*?\)|[-+.\de]*\d", "#", row["line"]), row["line"])
    return [["message"]] + [[f"`{cell(line)}`"] for line in kinds.values()]


# table: title, note, how its rows are shown
TABLES = {
    "drop worst": ("Drops at 50 velocities", "Drops of 0.03 to 12 m/s, with 50 time steps in the shortest contact.",
                   list_of(("partner", "kind"), ("drops", "count"), ("largest error of e", "worst"))),
    "forces": ("Forces under exchange, rebuild and sorting", "27 spheres collide with friction. Largest difference of a force component over 100 steps, over the largest force:", grid_of((("way", "way"),), "model", ("", "difference"))),
    "collapse": ("Collapse of 500 spheres", "All runs start from one restart file with open contacts, without viscous damping, and go on for 10,000 steps. Largest difference "
                "of a coordinate from the first run, over R. In the *yardstick* each sphere is moved by one unit in the last place. A lost history "
                "lies far above it, as stock `thornton_ning` shows on several ranks.", by_yardstick),
    "rejoin": ("A pair that parts and meets again", "After a first impact with a plastic dent the second contact begins as a virgin one, whatever the neighbour list still holds.",
               list_of(("gap/R", "gap"), ("neigh_modify", "neigh"), ("e of the second impact", "e"), ("virgin", "virgin"))),
    "flat": ("Flat meshes", "A sphere crosses the seams between triangles. *Difference*: of the force from that on a plane. *Step*: largest change of force in "
            "one time step. Both over the largest force.",
             list_of(("case", "case"), ("model", "model"), ("difference", "difference"), ("step, mesh", "jump"), ("step, plane", "jump_plane"))),
    "squeezed": ("Squeezed between a floor and a lid that comes down", "*Share*: way of the sphere over the lid's; half in the middle.",
                 list_of(("model", "model"), ("largest force N", "force"), ("largest change in a step N", "jump"), ("allowed by the stiffness N", "limit"), ("share", "moved"))),
    "curved": ("Curved mesh: new contacts", "A sphere moves along a trough of 2 degree strips, each of two triangles. LIGGGHTS starts a contact at every strip; the models "
              "begin no more. Under hertz: triangles that entered its list of wall contacts.",
               list_of(("model", "model"), ("contacts begun", "contacts"), ("strips passed", "strips"), ("degrees", "degrees"))),
    "ridge": ("Convex edges of a mesh", "A convex edge may add or take energy, with every model, because LIGGGHTS gives the edge to one of its two triangles. A sphere "
             "under a press of 2 N slides without friction at 10 m/s over the ridge where two planes meet. On the way from the triangle that "
             "owns the edge a second contact begins at full depth. On the way back a contact vanishes at full depth.\n\n*Gained* is the energy "
             "after the ridge less that before, over the elastic energy that the press alone holds. It counts kinetic energy, height under the "
             "press, and elastic and dissipated energy of contacts. *Brought* is the energy of contacts that began overlapping "
             "(`f_granulaw[18]`): it names what a ridge adds.",
              grid_of((("ridge, degrees", "degrees"), ("a contact", "way")), "model", ("gained,", "gained"), last=(("brought, mpm", "brought"),))),
    "moving": ("Moving mesh", "The same impact on a mesh that moves towards the sphere: e at each speed of the mesh, m/s.", grid_of((("model", "model"),), "mesh", ("", "e"))),
    "particles": ("Boundaries and bodies", "The expected e is the law's or, across the boundary, that of the same pair inside. The clump has none: it turns.", list_of(("case", "case"), ("model", "model"), ("e", "e"), ("expected", "expected"))),
    "insertion": ("Insertion while running, three sizes", "*Growth* is the largest rise of kinetic plus dissipated energy between insertions. Contacts return elastic energy.",
                  list_of(("particles", "particles"), ("contacts", "contacts"), ("growth", "gained"))),
    "steps": ("Steps in a contact", "e of one impact under mpm at 10, 20, 50 and 100 steps a contact. The error falls with the square of the step.",
              grid_of((("partner", "kind"), ("V m/s", "speed"), ("law", "law")), "steps", ("", "e"))),
    "ratios": ("Extreme ratios", "Each pair is computed in both orders of its particles.", both_orders),
    "rest": ("A bed comes down", "27 frictionless spheres enter a box at 1 m/s, without damping. *Growth* is the largest rise of kinetic plus potential energy over "
            "the start's, without and with the dissipated energy.",
             list_of(("model", "model"), ("steps", "steps"), ("growth", "mechanical"), ("growth with dissipated", "gained"), ("kinetic energy: start J", "kinetic_start"),
                     ("half-way J", "kinetic_half"), ("end J", "kinetic_end"))),
    "default damping": ("A bed comes to rest", "The same bed settles under 100 g with the default `elasticDamping`. *Rise* is the largest rise of the mechanical energy (kinetic, "
                       "gravity, elastic) above its least value so far, over the kinetic and elastic energy then. *Kinetic* is that of the last tenth of "
                       "the run over the start's. *Drift* is the change of mechanical energy + all work that contacts took, over the start's kinetic "
                       "energy.", list_of(("model", "model"), ("steps", "steps"), ("rise", "growth"), ("kinetic, end/start", "left"), ("drift", "drift"))),
    "at rest": ("A bed lies still", "A bed settled under 100 g with strong damping starts again with another damping. *Rise* is that of the mechanical energy over its "
               "value at the start. *Motion* is the largest change of kinetic and elastic energy, over the elastic energy.",
                list_of(("model", "model"), ("elasticDamping", "damping"), ("steps", "steps"), ("rise", "growth"), ("motion", "moves"))),
    "shaken": ("A shaken bed", "The floor shakes at 1 kHz by 0.2 mm.",
               list_of(("model", "model"), ("floor, peak m/s", "floor"), ("fastest sphere, up, m/s", "fastest"), ("kinetic J", "kinetic"))),
    "stops": ("Messages that stop a run", "Under `thermo_modify lost ignore` LIGGGHTS drops a lost particle without a message. `fix granulaw/runaway` ends the run instead, "
             "on one rank as on two.", of_each_kind),
}


def cell(value):
    if value is None:
        return ""
    if isinstance(value, float):
        return f"{value:.2g}" if abs(value) < 1e-3 else f"{value:.5g}"
    return str(value).replace("|", "\\|")


def markdown(table):
    return [f"| {' | '.join(row)} |" for row in table[:1]] + ["|" + "---|" * len(table[0])] + [f"| {' | '.join(row)} |" for row in table[1:]] + [""]


def anchor(title):
    return "".join(c for c in title.lower() if c.isalnum() or c in " -_").replace(" ", "-")


def page(rows):
    own = {name: [row for row in rows if row["table"] == name] for name in TABLES}
    text = [INTRO]
    text += markdown([["trial", "limit", "largest found"]] + [[f"[{what}](#{anchor(TABLES[name][0])})", asked, f"{found(own[name]):.2g}"]
                                                      for name, what, asked, found in SUMMARY if own[name]])
    for name, (title, note, show) in TABLES.items():
        if own[name]:
            text += [f"## {title}", "", *([note, ""] if note else []), *markdown(show(own[name]))]
    return "\n".join(text)


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit("trials_page.py DOCS_FOLDER [ROWS.jsonl]")
    if len(sys.argv) == 3:
        lines = Path(sys.argv[2]).read_text().splitlines()
    else:
        folder = Path("trials_rows").resolve()
        folder.mkdir(exist_ok=True)
        (folder / "rows.jsonl").unlink(missing_ok=True)
        for tests, more in ((QUICK, {}), (FULL, {"GRANULAW_FULL": "1"})):
            print(" ".join(tests), flush=True)
            subprocess.run([sys.executable, "-m", "pytest", *(str(HERE / test) for test in tests)], check=True, env={**os.environ, "GRANULAW_TRIALS": str(folder), **more})
        lines = (folder / "rows.jsonl").read_text().splitlines()
    (Path(sys.argv[1]) / "trials.md").write_text(page([json.loads(line) for line in lines]))


if __name__ == "__main__":
    main()
