"""Common parts of the trials: models side by side, dumps, and rows for docs/evidence/trials.md.

With GRANULAW_TRIALS=FOLDER a test also writes what it measured to FOLDER/rows.jsonl (trials_page.py makes the page)."""
import json
import os
import pathlib

from harness import Deck


class Trial(Deck):
    def record(self, table, **row):
        """One row of one table of the page. Without GRANULAW_TRIALS nothing happens."""
        folder = os.environ.get("GRANULAW_TRIALS")
        if folder:
            with open(pathlib.Path(folder) / "rows.jsonl", "a") as rows:
                rows.write(json.dumps({"table": table, **row}) + "\n")

    def last_frame(self, name="end.dump"):
        """Columns of the last frame of a text dump by particle id: {id: [numbers]}."""
        return self.frames(name)[-1]

    def frames(self, name):
        found, lines = [], (self.folder / name).read_text().splitlines()
        for k, line in enumerate(lines):
            if line.startswith("ITEM: NUMBER OF"):
                count = int(lines[k + 1])
            elif line.startswith(("ITEM: ATOMS", "ITEM: ENTRIES")):
                rows = [row.split() for row in lines[k + 1:k + 1 + count]]
                found.append({int(row[0]): [float(w) for w in row[1:]] for row in rows})
        return found


DUMP = 'dump {name} all custom {every} {name}.dump id {what}\ndump_modify {name} format "{format}"\n'


def dump(what, every=1, name="end"):
    """A dump of the columns `what` (all of them numbers) at full precision, id first."""
    return DUMP.format(name=name, every=every, what=what, format=" ".join(["%d"] + ["%.17g"] * len(what.split())))
