#!/usr/bin/python3
"""docs/evidence/trials.md from the tests themselves: trials_page.py DOCS_FOLDER (the target trials_page sets the environment).

Runs test_drop50, test_invariance (full: 10,000 steps), test_geometry and test_hard_cases (full: a million steps), keeps what they measured in
trials_rows/rows.jsonl and writes it. trials_page.py DOCS_FOLDER ROWS.jsonl makes the page from rows that are there."""
import json
import os
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).parent
RUNS = (("test_drop50.py",), ("test_invariance.py", "Forces", "Rejoin"), ("test_invariance.py", "full", "Collapse"),
        ("test_geometry.py",), ("test_hard_cases.py", "full"))

INTRO = """# Trials of the LIGGGHTS models

This page shows what the tests of `tests/liggghts` measured. Forces and trajectories must not depend on LIGGGHTS's bookkeeping: exchange between ranks, rebuilt lists, restarts. Each section says what its test asks for.

The law is the synthetic one of `tests/unit/synthetic_law.hpp` (E*/Y = 100), R = 1.7 mm. `hertz` (without damping) and `thornton_ning` are LIGGGHTS's own, at `contact_distance_factor 1.01`.
`cmake --build --preset release --target trials_page` makes the page.
"""

# table: (title, note, columns as (head, key))
TABLES = {
    "drop": ("Drops at 50 velocities", "One run; 50 steps in the shortest contact; every seventh drop is shown. `mpm law` is the tool's own "
             "integration. The tests ask for 0.005.", (("partner", "kind"), ("V m/s", "speed"), ("e, LIGGGHTS", "e"), ("e, mpm law", "law"))),
    "drop worst": (None, "", (("partner", "kind"), ("drops", "count"), ("largest error of e", "worst"))),
    "forces": ("Forces under exchange, rebuild and sorting", "27 spheres thrown together with friction; largest difference of any force component "
               "over 100 steps, over the largest force. Asked: 1e-12.", (("model", "model"), ("way", "way"), ("difference", "difference"))),
    "collapse": ("Collapse of 500 spheres", "From one restart file with open contacts, viscous damping off. Largest difference of any coordinate against the "
                 "first run, over R. Yardstick: the same when each sphere starts one unit in the last place beside. A run that differs in more "
                 "than the order of its sums would be far above.", (("model", "model"), ("steps", "steps"), ("way", "way"),
                                                                    ("difference/R", "difference"), ("yardstick/R", "yardstick"))),
    "rejoin": ("A pair that parts and meets again", "Second impact, after a first one with a plastic dent; e of a virgin contact at that speed is the law's.",
               (("gap/R", "gap"), ("neigh_modify", "neigh"), ("e of the second impact", "e"), ("virgin", "virgin"))),
    "flat": ("Flat meshes", "Largest difference of the force from the same contact on a plane without seams, and largest change in one step "
             "on the mesh and on the plane, over the largest force.",
             (("case", "case"), ("model", "model"), ("difference", "difference"), ("step, mesh", "jump"), ("step, plane", "jump_plane"))),
    "squeezed": ("Squeezed between a floor and a lid that comes down", "Largest change of force in one step against what the stiffness allows; share of the "
                 "lid's way that the sphere made (half: in the middle).",
                 (("model", "model"), ("largest force N", "force"), ("step N", "jump"), ("allowed N", "limit"), ("share", "moved"))),
    "curved": ("Curved mesh: new contacts", "A sphere along a trough of 2 degree strips of two triangles. Stock geometry starts a contact at every strip; ours "
               "begin no more (hertz: triangles that entered its list of wall contacts).", (("model", "model"), ("contacts begun", "contacts"), ("strips passed", "strips"), ("degrees", "degrees"))),
    "ridge": ("Convex edges of a mesh", "A sphere, pressed by 2 N, slides without friction at 10 m/s over the ridge where two planes meet. LIGGGHTS gives the edge to "
              "one of its two triangles: passing from that one to the other a contact begins at full depth beside the one that is there, the other way one vanishes at full "
              "depth. Gained: kinetic energy, height under the press, what contacts hold and have dissipated, after less before, over the elastic energy "
              "that the press alone holds; brought: what the contact statistics say of contacts that began overlapping (`f_ID[18]`). A hand-over of `delta_max` between the "
              "two planes would change none of it: the far contact begins at the depth that the near one has.",
              (("ridge, degrees", "degrees"), ("a contact", "way"), ("model", "model"), ("gained", "gained"), ("began overlapping", "contacts"), ("brought", "brought"))),
    "moving": ("Moving mesh", "The same impact seen from a mesh that comes up at the sphere.", (("model", "model"), ("mesh m/s", "mesh"), ("e", "e"))),
    "particles": ("Boundaries and bodies", "", (("case", "case"), ("model", "model"), ("e", "e"), ("expected", "expected"))),
    "insertion": ("Insertion while running, three sizes", "Largest growth of kinetic energy + dissipated energy between insertions (gives back what contacts held).",
                  (("particles", "particles"), ("contacts", "contacts"), ("growth", "gained"))),
    "steps": ("Steps in a contact", "e of one impact; hertz without damping should give 1.",
              (("partner", "kind"), ("V m/s", "speed"), ("steps", "steps"), ("e", "e"), ("law", "law"), ("hertz", "hertz"))),
    "ratios": ("Extreme ratios", "", (("case", "case"), ("model", "model"), ("V m/s", "speed"), ("e", "e"), ("law", "law"))),
    "rest": ("A bed comes down", "27 frictionless spheres thrown into a box at 1 m/s, no damping at all. Growth of kinetic + potential energy over the start's, and of "
             "the same + dissipated; kinetic energy (J) at the start, half-way, the end.",
             (("model", "model"), ("steps", "steps"), ("growth", "mechanical"), ("growth with dissipated", "gained"), ("start J", "kinetic_start"),
              ("half-way J", "kinetic_half"), ("end J", "kinetic_end"))),
    "default damping": ("A bed comes to rest", "The same thrown bed under 100 g with the default `elasticDamping`. Largest rise of the mechanical energy (kinetic + "
                        "gravity + held by contacts) above its least value so far, over what then moves or is held; kinetic energy in the last tenth of the "
                        "run over the start's; largest drift of mechanical energy + all work taken by contacts, over the start's kinetic energy.",
                        (("model", "model"), ("steps", "steps"), ("rise", "growth"), ("kinetic, end/start", "left"), ("drift", "drift"))),
    "at rest": ("A bed lies still", "Settled under 100 g with strong damping, written to a restart file, read with another damping. Largest rise of the mechanical "
                "energy over its value at the start; largest change of kinetic energy + energy held by contacts over what they hold.",
                (("model", "model"), ("elasticDamping", "damping"), ("steps", "steps"), ("rise", "growth"), ("motion", "moves"))),
    "shaken": ("A shaken bed", "", (("model", "model"), ("floor, peak m/s", "floor"), ("fastest sphere, up, m/s", "fastest"), ("kinetic J", "kinetic"))),
    "stops": ("What stops a run", "Under `thermo_modify lost ignore`. `fix granulaw/runaway`, which comes with the models, looks at every particle whenever "
              "neighbour lists are rebuilt and at every 100th step: a position or velocity that is no number, or a speed above one radius a step, "
              "ends the run.", (("ranks", "ranks"), ("the line", "line"))),
}


def cell(value):
    if value is None:
        return ""
    if isinstance(value, float):
        return f"{value:.2g}" if abs(value) < 1e-3 else f"{value:.5g}"
    return str(value).replace("|", "\\|")


def page(rows):
    text = [INTRO]
    for name, (title, note, columns) in TABLES.items():
        own = [row for row in rows if row["table"] == name]
        if not own:
            continue
        if title:
            text += [f"## {title}", ""]
        if note:
            text += [note, ""]
        text += ["| " + " | ".join(head for head, _ in columns) + " |", "|" + "---|" * len(columns)]
        text += ["| " + " | ".join(cell(row[key]) for _, key in columns) + " |" for row in own]
        text.append("")
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
        for run in RUNS:
            print(" ".join(run), flush=True)
            subprocess.run([sys.executable, str(HERE / run[0]), *run[1:]], check=True, env={**os.environ, "GRANULAW_TRIALS": str(folder)})
        lines = (folder / "rows.jsonl").read_text().splitlines()
    (Path(sys.argv[1]) / "trials.md").write_text(page([json.loads(line) for line in lines]))


if __name__ == "__main__":
    main()
