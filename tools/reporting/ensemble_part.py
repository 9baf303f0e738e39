"""Ensemble: one flow under the materials that a calibration leaves open (tools/ensemble): which observables depend on it.

Reads of each folder with an ensemble.csv (member and its material's numbers) the members' folders beside it: observables.csv
(quantity, value), else the table of an example deck, DECK.csv (model, seed, quantity, value)."""
import math
import pathlib
import tomllib

import numpy as np

from spread import student_tail

from . import files
from .files import Unreadable
from .page import number, plt

NAME = "ensemble.csv"
MATERIAL = "material.toml"
FEWEST = 5  # members below which nothing is said
SMALLEST_P = 0.05
PANELS = 4
COSTS = ("CPU time, s", "million particle-steps a second")


def numbers_of(path):
    """All numbers of a materials file: {"yield_stress": ..., "hardening.strain": ...}; of several materials with their names."""
    try:
        materials = tomllib.loads(pathlib.Path(path).read_text())["material"]
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError, KeyError) as error:
        raise Unreadable(path, f"no materials file ({error})") from None
    found = {}

    def collect(prefix, table):
        for key, value in table.items():
            if isinstance(value, dict):
                collect(f"{prefix}{key}.", value)
            elif isinstance(value, (int, float)) and not isinstance(value, bool):
                found[prefix + key] = float(value)
    for name, table in materials.items():
        collect("" if len(materials) == 1 else f"{name}.", table)
    return found


def ranks(values):
    """From 1 on; equal values share their mean rank."""
    values = np.asarray(values, dtype=float)
    return np.array([1 + np.sum(values < v) + 0.5 * (np.sum(values == v) - 1) for v in values])


def rank_correlation(a, b):
    """(Spearman's rho, its two-sided p by Student's t); None where one does not vary."""
    if len(a) < 3 or np.ptp(a) == 0 or np.ptp(b) == 0:
        return None
    rho = float(np.corrcoef(ranks(a), ranks(b))[0, 1])
    if abs(rho) > 1 - 1e-12:
        return math.copysign(1, rho), 0.0
    return rho, student_tail(rho * math.sqrt((len(a) - 2) / (1 - rho**2)), len(a) - 2)


def read_member(folder):
    """{quantity: [a value for each seed]}."""
    plain = folder / "observables.csv"
    tables = [plain] if plain.exists() else sorted(p for p in folder.glob("*.csv") if is_deck_table(p))
    found = {}
    for path in tables:
        for line, row in enumerate(files.read_csv(path, ("quantity", "value")), 2):
            found.setdefault(row["quantity"], []).append(files.to_number(path, line, "value", row["value"]))
    if not found:
        raise Unreadable(folder, "holds neither observables.csv nor a deck's table")
    return found


def is_deck_table(path):
    with open(path, encoding="utf-8", errors="replace") as file:
        return file.readline().strip() == "model,seed,quantity,value"


class Ensemble:
    """`parameters`: {name: values}, those that vary; `quantities`: {name: [seeds' values of each member]}."""

    def __init__(self, path):
        self.source, self.broken = path, []
        rows = files.read_csv(path, ("member",))
        names = [n for n in rows[0] if n != "member"]
        members, self.members = [], []
        for line, row in enumerate(rows, 2):
            try:
                members.append((read_member(path.parent / row["member"]),
                                {n: files.to_number(path, line, n, row[n]) for n in names if row[n]}))
                self.members.append(row["member"])
            except Unreadable as error:
                self.broken.append(error)
        common = [q for q in (members[0][0] if members else {}) if all(q in m for m, _ in members)]
        self.quantities = {q: [m[q] for m, _ in members] for q in common}
        self.parameters = {n: np.array([p[n] for _, p in members]) for n in names if all(n in p for _, p in members)}
        self.parameters = {n: v for n, v in self.parameters.items() if len(v) and np.ptp(v) > 0}

    def means(self, quantity):
        return np.array([np.mean(v) for v in self.quantities[quantity]])

    def correlations(self, quantity):
        return {n: rank_correlation(v, self.means(quantity)) for n, v in self.parameters.items()}


def band(values):
    """Quantiles between which 95 % lie."""
    return tuple(np.quantile(values, (0.025, 0.975)))


def feels(ensemble, quantity):
    """Parameter that the observable follows beyond chance: (name, rho) or None."""
    found = [(n, c[0]) for n, c in ensemble.correlations(quantity).items() if c and c[1] < SMALLEST_P]
    return max(found, key=lambda entry: abs(entry[1])) if found else None


def read_all(folder):
    """([Ensemble, ...], [Unreadable, ...])."""
    found, broken = [], []
    for path in sorted(files.find(folder, NAME)):
        try:
            ensemble = Ensemble(path)
        except Unreadable as error:
            broken.append(error)
            continue
        broken += ensemble.broken
        found.append(ensemble)
    return found, broken


def is_member(path, folder):
    """True if a file under `folder` belongs to a member."""
    return any((parent / NAME).exists() for parent in pathlib.Path(path).parents if folder in (parent, *parent.parents))


def row_of(ensemble, quantity):
    values = ensemble.means(quantity)
    low, high = band(values)
    mean = float(np.mean(values))
    share = f"{100 * (high - low) / abs(mean):.2g} %" if mean else "n/a"
    cells = [quantity, number(mean, 4), f"{number(low, 4)} to {number(high, 4)}", share]
    for found in ensemble.correlations(quantity).values():
        cells.append("n/a" if found is None else f"{found[0]:+.2f}" + (" *" if found[1] < SMALLEST_P else ""))
    return cells


def picture(ensemble, names):
    """Observables over the parameter that each follows most."""
    figure, axes = plt.subplots(1, len(names), figsize=(max(6.4, 3.2 * len(names)), 3.2), squeeze=False)
    for axis, quantity in zip(axes[0], names):
        parameter = feels(ensemble, quantity)[0]
        values = ensemble.means(quantity)
        low, high = band(values)
        axis.axhspan(low, high, color="tab:blue", alpha=0.12, lw=0)
        axis.plot(ensemble.parameters[parameter], values, "o", ms=4, color="tab:blue")
        axis.set(xlabel=parameter, title=quantity)
    return figure


def write(page, ensembles):
    for k, e in enumerate(ensembles, 1):
        title = e.source.parent.name
        page.heading(f"{title}: {len(e.members)} members")
        if len(e.members) < FEWEST or not e.parameters:
            page.text(f"{len(e.members)} members, {len(e.parameters)} parameters that vary: nothing can be said; {FEWEST} or more members are needed.")
            continue
        shown = [q for q in e.quantities if q not in COSTS]
        following = sorted((q for q in shown if feels(e, q)), key=lambda q: -abs(feels(e, q)[1]))
        tested = sum(c is not None for q in shown for c in e.correlations(q).values())
        if following:
            page.text("Feel the material's uncertainty: " + "; ".join(f"{q} ({feels(e, q)[0]}, {feels(e, q)[1]:+.2f})" for q in following) +
                      ". The others follow no parameter beyond chance.")
            page.figure(picture(e, following[:PANELS]), f"ensemble-{k}",
                        "Observables over the parameter that each follows most; the band holds 95 % of the members.")
        else:
            page.text("No observable follows a parameter beyond chance: the flow does not feel what the data leave open.")
        page.table(["observable", "mean", "95 % of members", "width / mean", *e.parameters],
                   [row_of(e, q) for q in shown])
        page.text(f"Under each parameter: Spearman's rank correlation; * p < {SMALLEST_P}. Of {tested} tested about {SMALLEST_P * tested:.1g} have a "
                  "star by chance.")
        low_high = "; ".join(f"{n} {number(v.min(), 4)} to {number(v.max(), 4)}" for n, v in e.parameters.items())
        page.text(f"From `{e.source}` and its members' folders; parameters: {low_high}.")
