#!/usr/bin/python3
"""Every command of LIGGGHTS that touches a contact, a particle or a wall, with mpm and thornton beside stock Hertz.

matrix.py [WORDS ...]   all features, or those whose group or name holds one of WORDS; exits 1 at a defect, or where docs/evidence/liggghts-matrix.csv has another outcome.
The environment is that of the other tests (CMakeLists.txt); matrix_scene.py has the scene, matrix_contacts.py, matrix_fixes.py and matrix_runs.py the features."""
import csv
import re
import sys
import time

import matrix_contacts
import matrix_fixes
import matrix_runs
from harness import LAUNCHER, worst
from matrix_compare import difference, run_all
from matrix_scene import Variant
from programs import ROOT

FEATURES = matrix_contacts.FEATURES + matrix_fixes.FEATURES + matrix_runs.FEATURES
MODELS = ("mpm", "thornton")
# mpm's elastic law is Hertz's formula from a table, 3e-6 off; a chain of two or three impacts makes some 1e-4 of it. thornton's is the formula itself.
TWIN = {"mpm": 1e-4, "thornton": 1e-9}
RANKS = 1e-6   # one rank against two: the order of sums, and two or three impacts
ENERGY = 1e-3  # of the energy at the start; velocity Verlet at 40 steps in the shortest contact

PLAIN, ENERGY_ON, STRETCH, ALL = (False, False), (False, True), (True, False), (True, True)
NAMES = {PLAIN: "plain", ENERGY_ON: "energy, contactMap", STRETCH: "stretch", ALL: "stretch, energy, contactMap"}
# Elastic: against Hertz with the same ranks and softness. Plastic and composed: finite, energy, one rank against two.
ELASTIC = {"mpm": ((PLAIN, 1), (PLAIN, 2), (ENERGY_ON, 2), (STRETCH, 1), (ALL, 2)),
           "thornton": ((PLAIN, 1), (PLAIN, 2), (ENERGY_ON, 1), (STRETCH, 2), (ALL, 1))}
PLASTIC = {"mpm": ((ALL, 1), (ALL, 2)), "thornton": ((ALL, 1), (ALL, 2))}
COMPOSED = {"mpm": ((ALL, 1), (ALL, 2)), "thornton": ()}
YIELDING = (("plastic", PLASTIC), ("composed", COMPOSED))
# outcome, worst first: its words in the table
OUTCOMES = {"DEFECT": "defect", "refused": "refused", "as hertz": "refused with hertz as well", "kept": "works where stock hertz loses histories",
            "runs": "runs, with other numbers than hertz", "same": "works as with hertz"}
with open(ROOT / "docs/evidence/liggghts-matrix.csv", newline="", encoding="utf-8") as table:
    STATED = {(row["group"], row["command or option"]): row["outcome"] for row in csv.DictReader(table)}

class Row:
    """Outcome of one feature under Hertz, mpm and thornton, each {words: where}; 'same' where nothing else is said."""

    def __init__(self, feature):
        self.feature, self.worst = feature, {"mpm": 0.0, "thornton": 0.0}
        self.found = {"mpm": [], "thornton": []}  # (outcome, where)
        self.waves = False  # whether they took energy from a composed run

    def run_all(self):
        """All runs of the feature, by variant: four processes where nothing ends one."""
        ours = [Variant(model, law, *words, ranks) for model in MODELS for law, cases in (("elastic", ELASTIC), *YIELDING)
                for words, ranks in cases[model]]
        stock = [Variant("hertz", "elastic", stretch, False, ranks) for stretch in (False, True) for ranks in (1, 2)]
        runs = {}
        for variants, program in ((stock, LAUNCHER if self.feature.kept else None), (ours, None)):
            for ranks in self.feature.ranks:
                runs.update(run_all(self.feature, [v for v in variants if v.ranks == ranks], program))
        if self.feature.kept:
            self.stock_loses(stock[0], runs[stock[0]])
        return runs

    def stock_loses(self, variant, kept):
        """Holds that stock LIGGGHTS differs from `kept`, Hertz in liggghts-mpm."""
        stock = run_all(self.feature, [variant])[variant]
        if not difference(stock.tables, kept.tables, TWIN["thornton"])[0]:
            for model in MODELS:
                self.note(model, "DEFECT: stock hertz is as hertz in liggghts-mpm: its feature is not `kept`", "elastic, plain, ranks 1")

    def outcome(self, run, stock):
        """Sentence about a run that ended with an error, or that shows what is no number; None: nothing."""
        if run.status == 0:
            wrong = run.not_numbers()
            if wrong and not (stock and stock.not_numbers()):
                return f"DEFECT: not a number in {wrong[0]}"
            return None
        sentence = run.sentence()
        if stock and stock.status != 0 and (sentence == stock.sentence() or sentence is None):
            return f"as hertz: {sentence}" if sentence else f"as hertz: ends with {stock.status} and no sentence" if stock.sentence() is None else \
                f"DEFECT: ends with {run.status} and no sentence; hertz: {stock.sentence()}"
        if sentence is None:
            return f"DEFECT: ends with status {run.status} and no sentence"
        wanted = self.feature.refused
        if stock and stock.status != 0 or wanted is not None and wanted in sentence:
            return f"refused: {sentence}"
        return f"DEFECT: refused: {sentence}"

    def examine(self):
        runs = self.run_all()
        plain = {ranks: runs["hertz", "elastic", False, False, ranks] for ranks in self.feature.ranks}
        alike = self.feature.alike and len(plain) == 2 and not states_apart(plain[1], plain[2])  # fix adapt: hertz's ranks differ as well
        for model in MODELS:
            for (stretch, energy), ranks in ELASTIC[model]:
                run = runs.get((model, "elastic", stretch, energy, ranks))
                if run is None:
                    continue
                stock = runs.get(("hertz", "elastic", stretch, False, ranks), plain[ranks])
                said = self.outcome(run, stock) or self.twin(model, run, stock, stretch) or self.energy(run, energy)
                self.note(model, said, f"elastic, {NAMES[stretch, energy]}, ranks {ranks}")
            for law, cases in YIELDING:
                self.examine_yielding(model, law, cases[model], runs, plain, alike)
        return self

    def examine_yielding(self, model, law, cases, runs, plain, alike):
        done = []
        for (stretch, energy), ranks in cases:
            run = runs.get((model, law, stretch, energy, ranks))
            if run is None:
                continue
            done.append(run)
            said = self.outcome(run, runs.get(("hertz", "elastic", stretch, False, ranks), plain[ranks])) or self.energy(run, energy)
            self.note(model, said, f"{law}, {NAMES[stretch, energy]}, ranks {ranks}")
        self.waves |= law == "composed" and any(row[2] > 0 for run in done for row in run.energies[-1:])
        if alike and len(done) == 2 and all(r.status == 0 for r in done):
            apart = states_apart(*done)
            one, two = (r.energies for r in done)
            if not apart and any(abs(a - b) > RANKS * abs(one[0][0]) for row, other in zip(one, two) for a, b in zip(row, other)):
                apart = f"energies {two[-1]}, hertz {one[-1]}"
            said = apart and "DEFECT: two ranks and one: " + apart.replace("hertz", "one rank")
            self.note(model, said, f"{law}, ranks 1 and 2")

    def twin(self, model, run, stock, stretch):
        if not self.feature.twin or stretch and self.feature.twin == "plain":
            return None
        if stock.status != 0:
            return f"DEFECT: runs where hertz ends: {stock.sentence()}"
        apart, worst = difference(run.tables, stock.tables, max(TWIN[model], self.feature.tolerance), self.feature.skip)
        self.worst[model] = max(self.worst[model], worst or 0.0)
        return apart and f"DEFECT: {apart}"

    def energy(self, run, wanted):
        """`wanted`: the deck prints energies."""
        if wanted and run.status == 0 and not run.energies:
            return "DEFECT: no energies"
        if not run.energies or not self.feature.conserved:
            return None
        held, lost, _ = run.energies[0]
        drift = worst(abs(a + b - held - lost) for a, b, _ in run.energies) / abs(held)
        return f"DEFECT: energy drifts by {drift:.2g} of its start" if not drift <= ENERGY else None

    def note(self, model, said, where):
        if said:
            self.found[model].append((said, where))

    def kind(self):
        """The worst outcome of either model."""
        found = [said for rows in self.found.values() for said, _ in rows]
        return next((kind for kind in list(OUTCOMES)[:3] if any(kind in said for said in found)), "kept" if self.feature.kept else "same" if self.feature.twin else "runs")

    def faults(self):
        """Defects, and a table that has another outcome of the feature."""
        shown = STATED.get((self.feature.group, re.sub(r"\s+", " ", self.feature.name))) == OUTCOMES[self.kind()]
        return [f"{model}: {said} [{where}]" for model, found in self.found.items() for said, where in found if said.startswith("DEFECT")] + \
            ([] if shown else [f"the table does not have it as '{OUTCOMES[self.kind()]}'"])

def states_apart(one, two):
    """Difference between the trajectory on two ranks and that on one; None: equal. A run without a trajectory is equal to none."""
    one, two = (run.tables.get("state.txt") for run in (one, two))
    return difference({"state": two}, {"state": one}, RANKS)[0] if one and two else "no state.txt"

def main():
    words, started, faults, radiating = sys.argv[1:], time.time(), 0, 0
    chosen = [f for f in FEATURES if not words or any(w in f"{f.group}: {f.name}" for w in words)]
    for feature in chosen:
        row = Row(feature).examine()
        radiating += row.waves
        for fault in row.faults():
            faults += 1
            print(f"FAULT: {feature.group}: {feature.name}: {fault}", flush=True)
        print(f"{feature.group}: {feature.name} [{', '.join(f'{v:.1e}' for v in row.worst.values())}; {time.time() - started:.0f} s]", flush=True)
    print(f"{len(chosen)} features, in {radiating} of which waves took energy, {time.time() - started:.0f} s, {faults} faults")
    if not words and radiating < len(chosen) / 2:
        sys.exit("matrix.py: waves took no energy from most features: the composed law does not radiate")
    sys.exit(1 if faults else 0)

if __name__ == "__main__":
    main()
