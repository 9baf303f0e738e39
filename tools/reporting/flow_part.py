"""Flow: what each model gives for a deck's observables and what its runs cost, beside the unstretched `mpm` runs.

Reads what examples/*/run.py leave: DECK.csv (model, seed, quantity, value) and of each run, in MODEL-SEED[-ranksN], `log` and `cpu`."""
import math
import re

from spread import Sample

from . import files
from .ensemble_part import is_member
from .page import legend_below, plt, with_error

REFERENCE = "mpm"
DECKS = ("drop", "packing", "heap", "compression", "hopper", "silo")
# Observables of the picture, by the decks' own names.
OBSERVABLES = {"discharge rate": r"^discharge rate", "energy dissipated": r"^energy dissipated", "dissipated in normal contacts": r"^(dissipated|of it) in normal contacts",
               "heap angle": r"^angle, degrees", "packing fraction": r"^(solid fraction$|bulk density)", "stress": r"^stress at solid fraction 0\.7,",
               "restitution": r"^e on the wall at .* m/s"}
PANELS = 5  # of one deck's picture, at most
COLOURS = {"hertz": "0.35", "thornton": "tab:orange", "mpm": "tab:blue"}
OTHERS = ("tab:green", "tab:purple", "tab:red", "tab:brown", "tab:pink", "tab:olive", "tab:cyan")


class Cost:
    """Seconds of the runs of one model, and their time step, as far as the files give them."""

    def __init__(self):
        self.wall, self.cpu, self.steps = [], [], set()

    def read(self, folder):
        if (folder / "log").is_file():
            text = (folder / "log").read_text(errors="replace")
            loops = re.findall(r"^Loop time of (\S+) on ", text, re.M)
            self.wall += [sum(map(float, loops))] if loops else []
            self.steps |= {float(step) for step in re.findall(r"^timestep\s+([0-9.eE+-]+)\s*$", text, re.M)[-1:]}
        if (folder / "cpu").is_file():
            self.cpu.append(files.to_number(folder / "cpu", 1, "CPU seconds", (folder / "cpu").read_text().strip()))

    def cells(self):
        return [f"{1e6 * min(self.steps):g}" if len(self.steps) == 1 else "n/a", *[cell(Sample(s) if s else None) for s in (self.wall, self.cpu)]]


class Deck:
    """One deck's runs. `quantities`: {model: {quantity: Sample}}; `cost`: {model: Cost}; `folders`: {model: [of a run]}."""

    def __init__(self, name, title):
        self.name, self.title = name, title
        self.sources, self.quantities, self.cost, self.folders = [], {}, {}, {}

    @property
    def models(self):
        return sorted(self.quantities, key=lambda m: (("hertz", "thornton", "mpm", m.split("-")[0]).index(m.split("-")[0]), m.count("-"), len(m), m))

    def read(self, path):
        rows = files.read_csv(path, ("model", "seed", "quantity", "value"))
        values = {}
        for line, row in enumerate(rows, 2):
            values.setdefault(row["model"], {}).setdefault(row["quantity"], {})[row["seed"]] = files.to_number(path, line, "value", row["value"])
        for model, quantities in values.items():
            seeds = max((set(q) for q in quantities.values()), key=len)
            self.quantities[model] = {q: Sample(v.values()) for q, v in quantities.items() if set(v) == seeds}
            self.cost[model] = Cost()
            runs = [run for seed in sorted(seeds) for pattern in ("", "-ranks*") for run in sorted(path.parent.glob(f"{model}-{seed}{pattern}"))]
            self.folders[model] = [run for run in runs if (run / "done").exists()]
            for run in self.folders[model]:
                self.cost[model].read(run)
        self.sources.append(path)

    def seconds(self):
        """{model: Sample} of CPU seconds where all runs kept them, else of wall-clock; none: neither is known."""
        for which in ("cpu", "wall"):
            found = {m: getattr(self.cost[m], which) for m in self.models}
            if all(found.values()):
                return {m: Sample(s) for m, s in found.items()}
        return {}


def read_all(folder):
    """([Deck, ...], [Unreadable, ...]) of all that lies under `folder`. Folders NAME, NAME-stretchS and NAME-S are one deck's."""
    decks, broken = {}, []
    for path in sorted(p for deck in DECKS for p in files.find(folder, f"{deck}.csv") if not is_member(p, folder)):
        base = re.sub(r"-(stretch)?[\d.]+$", "", path.parent.name)
        title = base if base.startswith(path.stem) else f"{path.stem} ({base})"
        try:
            decks.setdefault((path.parent.parent, base, path.stem), Deck(path.stem, title)).read(path)
        except files.Unreadable as error:
            broken.append(error)
    found = [d for d in decks.values() if d.quantities]
    for deck in found:  # runs of one deck in two places are distinguished by their folders
        if sum(other.title == deck.title for other in found) > 1:
            deck.title = f"{deck.title} in {deck.sources[0].parent}"
    return found, broken


def deviation(a, b, quantity):
    """(deviation of a from b, its standard error or None, unit): of an angle in degrees, else in percent; None where it would be a fraction of 0."""
    known = a.error is not None and b.error is not None
    if re.search(r"angle.*degrees", quantity):
        return a.mean - b.mean, math.hypot(a.error, b.error) if known else None, "degrees"
    if b.mean == 0:
        return None
    return 100 * (a.mean / b.mean - 1), 100 * math.hypot(a.error / b.mean, b.error * a.mean / b.mean**2) if known else None, "%"


def words(model):
    """mpm-stretch10 -> `mpm` stretched by 10."""
    for pattern, text in ((r"(\w+)-stretch([\d.]+)$", r"\1, stretched by \2"), (r"(\w+)-softer([\d.]+)$", r"\1, E lowered, dt × \2"), (r"(.+)-decklaw$", r"\1, law for this deck only")):
        model = re.sub(pattern, text, model)
    return model


def observables(deck):
    """[(short name, the deck's name)] that at least two of its models have."""
    names = dict.fromkeys(q for m in deck.models for q in deck.quantities[m])
    common = [q for q in names if sum(q in deck.quantities[m] for m in deck.models) > 1]
    return [(short, name) for short, pattern in OBSERVABLES.items() for name in [q for q in common if re.search(pattern, q)][:None if short == "restitution" else 1]]


def picture(deck, names):
    """Deviation from the reference over seconds a run, a panel for each observable."""
    figure, axes = plt.subplots(1, len(names), figsize=(max(9.6, 3.2 * len(names)) if len(names) > 1 else 6.4, 3.5), squeeze=False, sharex=True)
    seconds, handles = deck.seconds(), {}
    for axis, (short, name) in zip(axes[0], names):
        base, unit = deck.quantities[REFERENCE].get(name), "%"
        for k, model in enumerate(deck.models):
            mine = deck.quantities[model].get(name)
            if not base or not mine or not (found := deviation(mine, base, name)):
                continue
            off, error, unit = found
            handles[words(model)] = axis.errorbar(seconds[model].mean, off, yerr=error if model != REFERENCE else None, xerr=seconds[model].error, fmt="o" if model == REFERENCE else "s",
                                                  color=COLOURS.get(model) or OTHERS[k % len(OTHERS)], capsize=2.5, lw=1)
        axis.axhline(0, color="tab:blue", lw=0.8)
        axis.set(title=short, ylabel=f"deviation from mpm, {unit}", xlabel="seconds a run")
        axis.margins(x=0.15, y=0.15)
        if max(s.mean for s in seconds.values()) > 4 * min(s.mean for s in seconds.values()):
            axis.set_xscale("log")
    legend_below(figure, list(handles.values()), list(handles), min(4, len(handles)))
    return figure


def cell(sample):
    return "n/a" if sample is None else with_error(sample.mean, sample.error)


def full_cell(deck, model, quantity):
    """Its value, and in a second line the deviation from the reference."""
    mine, base = deck.quantities[model].get(quantity), deck.quantities.get(REFERENCE, {}).get(quantity)
    found = mine and base and model != REFERENCE and deviation(mine, base, quantity)
    return cell(mine) + (f"\n{with_error(*found[:2], plus=True)} {found[2]}" if found else "")


def write_deck(page, deck, k):
    page.heading(deck.title[0].upper() + deck.title[1:])
    names, models = observables(deck), deck.models
    if REFERENCE not in deck.quantities:
        page.text(f"No unstretched `mpm` runs here: nothing to hold {', '.join(models)} against.")
    elif names and deck.seconds():
        page.figure(picture(deck, names[:PANELS]), f"flow-{k}-{deck.name}", "Deviation from the unstretched `mpm` against cost; ± one standard error over seeds.")
    page.table(["", *map(words, models)],
               [[head, *cells] for head, *cells in zip(("time step, µs", "wall-clock, s a run", "CPU, s a run"), *[deck.cost[m].cells() for m in models]) if set(cells) != {"n/a"}] +
               [[q, *[full_cell(deck, m, q) for m in models]] for q in dict.fromkeys(q for m in models for q in deck.quantities[m])])
    page.text("From " + ", ".join(f"`{s}`" for s in deck.sources) + "; ± is the standard error over seeds, where there are several.")


def write(page, decks):
    page.text("The reference is model `mpm` unstretched: the computed law. So a deviation here is what another law, or stretching, does to the flow, "
              "not an error against an experiment. `examples/differences.py` tests which of them chance explains.")
    for k, deck in enumerate(decks, 1):
        write_deck(page, deck, k)
