"""Flow: wall-clock and time step against the deviation of what a flow is measured by, from the unstretched `mpm` runs.

Reads what examples/*/run.py leave: DECK.csv (model, seed, quantity, value) and of each run, in MODEL-SEED[-ranksN], `log`, `cpu` and
`screen`; and the hopper report of tools/demo (report.csv: quantity, unit, model, value, standard_error)."""
import math
import pathlib
import re

from spread import Sample, welch

from . import files
from .ensemble_part import is_member
from .page import legend_below, number, plt, with_error

REFERENCE = "mpm"
DECKS = ("drop", "packing", "heap", "compression", "hopper", "silo")
# Observables of the flow part, by the decks' own names; all other quantities of a deck stand in its second
# table.
OBSERVABLES = (("discharge rate", r"^discharge rate"), ("energy dissipated", r"^energy dissipated"),
               ("dissipated in normal contacts", r"^(dissipated in normal contacts|of it in normal contacts)"),
               ("heap angle", r"^angle, degrees"), ("packing fraction", r"^(solid fraction$|bulk density)"),
               ("stress", r"^stress at solid fraction 0\.7,"), ("restitution", r"^e on the wall at .* m/s"))
PANELS = 5  # of one deck's picture, at most
COSTS = ("CPU time, s", "million particle-steps a second", "wall-clock per particle-step, dense, median")
COLOURS = {"hertz": "0.35", "thornton": "tab:orange", "mpm": "tab:blue"}
OTHERS = ("tab:green", "tab:purple", "tab:red", "tab:brown", "tab:pink", "tab:olive", "tab:cyan")
MARKERS = "sD^vP*Xp"


class Single:
    """A value with the standard error that its own run gives (None: none known), as the hopper report of tools/demo states it."""

    def __init__(self, mean, error):
        self.mean, self.error, self.values = mean, error, [mean]


def differs(a, b):
    """True, False, or None where a spread is missing or 0: Welch's test on seeds, p < 0.05; of single runs 1.96 standard errors."""
    if a.error is None or b.error is None:
        return None
    if isinstance(a, Sample) and isinstance(b, Sample):
        p = welch(a, b)
        return None if p is None else p < 0.05
    return abs(a.mean - b.mean) > 1.96 * math.hypot(a.error, b.error)


def unit_of(quantity):
    """Text of a deviation: an angle's in degrees (a fraction of an angle says nothing), else percent of the reference."""
    return "degrees" if re.search(r"angle.*degrees", quantity) else "%"


def deviation(a, b, unit):
    """(deviation of a from b, its standard error or None); None where it would be a fraction of 0."""
    if unit != "%":
        return a.mean - b.mean, None if a.error is None or b.error is None else math.hypot(a.error, b.error)
    if b.mean == 0:
        return None
    spread = None if a.error is None or b.error is None else 100 * math.hypot(a.error / b.mean, b.error * a.mean / b.mean**2)
    return 100 * (a.mean / b.mean - 1), spread


class Cost:
    """Times of the runs of one model: seconds and time step, as far as the files give."""

    def __init__(self):
        self.wall, self.cpu, self.steps, self.ranks = [], [], set(), set()

    def read(self, folder):
        log = folder / "log"
        if log.is_file():
            text = log.read_text(errors="replace")
            loops = re.findall(r"^Loop time of (\S+) on (\d+) procs", text, re.M)
            if loops:
                self.wall.append(sum(float(seconds) for seconds, _ in loops))
                self.ranks.add(int(loops[-1][1]))
            step = re.findall(r"^timestep\s+([0-9.eE+-]+)\s*$", text, re.M)
            if step:
                self.steps.add(float(step[-1]))
        if (folder / "cpu").is_file():
            self.cpu.append(files.to_number(folder / "cpu", 1, "CPU seconds", (folder / "cpu").read_text().strip()))

    @property
    def dt(self):
        return self.steps.copy().pop() if len(self.steps) == 1 else None

    def seconds(self, which):
        found = self.cpu if which == "CPU" else self.wall
        return Sample(found) if found else None


class Deck:
    """One deck's runs. `quantities`: {model: {quantity: Sample or Single}}; `cost`: {model: Cost}; `stopped`: sentences of failed runs."""

    def __init__(self, name, title):
        self.name, self.title = name, title
        self.sources, self.quantities, self.cost, self.stopped, self.folders = [], {}, {}, {}, {}
        self.within = False  # spreads are those within single runs

    @property
    def models(self):
        order = lambda m: ({"hertz": 0, "thornton": 1, "mpm": 2}.get(m.split("-")[0], 3), len(m.split("-")), re.sub(r"[\d.]+$", "", m),
                           float(re.search(r"([\d.]+)$", m).group(1)) if re.search(r"[\d.]+$", m) else 0)
        return sorted(self.quantities, key=order)

    def clock(self):
        """'CPU' if every model's runs kept it, else 'wall-clock'; None: neither is known."""
        for which in ("CPU", "wall-clock"):
            if all(m in self.cost and self.cost[m].seconds(which) for m in self.models):
                return which
        return None


def words(model):
    """mpm-stretch10 -> `mpm` stretched by 10."""
    stretch, softer = re.match(r"(\w+)-stretch([\d.]+)$", model), re.match(r"(\w+)-softer([\d.]+)$", model)
    if model.endswith("-decklaw"):
        return f"{model[:-8]}, law for this deck only"
    return f"{stretch[1]}, stretched by {stretch[2]}" if stretch else f"{softer[1]}, E lowered, dt × {softer[2]}" if softer else model


def read_example(decks, path):
    """Adds a DECK.csv to `decks`. Folders NAME, NAME-stretchS and NAME-S are one deck's."""
    rows = files.read_csv(path, ("model", "seed", "quantity", "value"))
    folder = path.parent
    base = re.sub(r"-(stretch)?[\d.]+$", "", folder.name)
    key = (str(folder.parent), base, path.stem)
    deck = decks.setdefault(key, Deck(path.stem, base if base.startswith(path.stem) else f"{path.stem} ({base})"))
    values = {}
    for line, row in enumerate(rows, 2):
        value = files.to_number(path, line, "value", row["value"])
        values.setdefault(row["model"], {}).setdefault(row["quantity"], {})[row["seed"]] = value
    for model, quantities in values.items():
        seeds = max((set(q) for q in quantities.values()), key=len)
        deck.quantities[model] = {q: Sample(v.values()) for q, v in quantities.items() if set(v) == seeds}
        cost = deck.cost[model] = Cost()
        for seed in sorted(seeds):
            for run in sorted(folder.glob(f"{model}-{seed}")) + sorted(folder.glob(f"{model}-{seed}-ranks*")):
                if (run / "done").exists():
                    cost.read(run)
                    deck.folders.setdefault(model, []).append(run)
    deck.sources.append(path)
    find_stopped(deck, folder)


def find_stopped(deck, folder):
    """Runs that LIGGGHTS or the plug-in ended with a sentence: the first of each model."""
    for screen in sorted(folder.glob("*/screen")):
        model = re.sub(r"-\d+(-ranks\d+)?$", "", screen.parent.name)
        if (screen.parent / "done").exists() or model in deck.stopped:
            continue
        error = re.search(r"^ERROR[^:\n]*: (.+)$", screen.read_text(errors="replace"), re.M)
        if error:
            deck.stopped[model] = error[1].strip()


def read_demo(decks, path):
    """Adds the hopper report of tools/demo: one run a model, spreads from within it."""
    rows = files.read_csv(path, ("quantity", "unit", "model", "value", "standard_error"))
    folder = path.parent.parent
    deck = decks[(str(folder), "demo", "hopper")] = Deck("hopper", f"hopper of tools/demo ({folder.name})")
    deck.within = True
    for line, row in enumerate(rows, 2):
        if row["value"] == "":
            continue
        error = row["standard_error"]
        name = row["quantity"] + (f", {row['unit']}" if row["unit"] else "")
        deck.quantities.setdefault(row["model"], {})[name] = Single(
            files.to_number(path, line, "value", row["value"]),
            None if error == "" else files.to_number(path, line, "standard_error", error))
    for model in deck.quantities:
        deck.cost[model] = Cost()
        deck.cost[model].read(folder / model)
        deck.folders[model] = [folder / model]
    deck.sources.append(path)


def read_all(folder):
    """([Deck, ...], [Unreadable, ...]) of all that lies under `folder`."""
    decks, broken = {}, []
    found = [p for deck in DECKS for p in files.find(folder, f"{deck}.csv") if not is_member(p, folder)]
    for path in sorted(found):
        try:
            read_example(decks, path)
        except files.Unreadable as error:
            broken.append(error)
    for path in sorted(files.find(folder, "report.csv")):
        try:
            read_demo(decks, path)
        except files.Unreadable as error:
            broken.append(error)
    for (parent, base, stem), deck in decks.items():  # a stretch that was stopped left no table
        for other in sorted(pathlib.Path(parent).glob(f"{base}-*")):
            if re.fullmatch(r"-(stretch)?[\d.]+", other.name[len(base):]) and not (other / f"{stem}.csv").exists():
                find_stopped(deck, other)
    found = [d for d in decks.values() if d.quantities]
    for deck in found:  # runs of one deck in two places are distinguished by their folders
        if sum(other.title == deck.title for other in found) > 1:
            deck.title = f"{deck.title} in {deck.sources[0].parent}"
    return found, broken


def observables(deck):
    """[(short name, the deck's name)] that at least two of its models have."""
    names = list(dict.fromkeys(q for m in deck.quantities.values() for q in m))
    found = []
    for short, pattern in OBSERVABLES:
        matching = [q for q in names if re.search(pattern, q)]
        for name in matching if short == "restitution" else matching[:1]:
            if sum(name in deck.quantities[m] for m in deck.models) > 1:
                found.append((re.sub(r"^e on the wall", "e", name) if short == "restitution" else short, name))
    return found


def picture(deck, names):
    """Deviation from the reference over seconds a run, a panel for each observable."""
    which = deck.clock()
    count = len(names)
    figure, axes = plt.subplots(1, count, figsize=(max(9.6, 3.2 * count) if count > 1 else 6.4, 3.5), squeeze=False, sharex=True)
    ticks = sorted(deck.cost[m].seconds(which).mean for m in deck.models)
    for axis, (short, name) in zip(axes[0], names):
        base = deck.quantities[REFERENCE].get(name)
        if base is None:
            continue
        unit = unit_of(name)
        scale = 1 if unit != "%" else 100 / abs(base.mean) if base.mean else 0
        if base.error is not None:
            own = scale * base.error
            axis.axhspan(-own, own, color="tab:blue", alpha=0.12, lw=0)
        axis.axhline(0, color="tab:blue", lw=0.8)
        for k, model in enumerate(deck.models):
            if name not in deck.quantities[model] or not deviation(deck.quantities[model][name], base, unit):
                continue
            sample = deck.quantities[model][name]
            off, _ = deviation(sample, base, unit)
            own = None if sample.error is None or model == REFERENCE else scale * sample.error
            seconds = deck.cost[model].seconds(which)
            dt = deck.cost[model].dt
            axis.errorbar(seconds.mean, off, yerr=own, xerr=seconds.error, fmt=MARKERS[k % len(MARKERS)] if model != REFERENCE else "o",
                          color=COLOURS.get(model) or OTHERS[k % len(OTHERS)], capsize=2.5, lw=1,
                          label=words(model) + (f", dt {1e6 * dt:g} µs" if dt else ""))
        axis.set(title=short, ylabel=f"deviation from mpm, {unit}", xlabel=f"{which} seconds a run")
        axis.margins(x=0.15, y=0.15)
        if ticks[-1] > 4 * ticks[0]:
            axis.set_xscale("log")
    handles = {}
    for axis in axes[0]:
        for handle, text in zip(*axis.get_legend_handles_labels()):
            handles.setdefault(text, handle)
    texts = [t for m in deck.models for t in handles if t.split(", dt ")[0] == words(m)]
    legend_below(figure, [handles[t] for t in texts], texts, min(4, len(texts)))
    return figure


def cell(sample):
    return "n/a" if sample is None else with_error(sample.mean, sample.error)


def against(sample, base, quantity):
    """Deviation, its standard error, and whether it is significant."""
    if sample is None or base is None:
        return ""
    unit = unit_of(quantity)
    found = deviation(sample, base, unit)
    if found is None:
        return ""
    verdict = {None: "no verdict", True: "**significant**", False: "not significant"}[differs(sample, base)]
    return f"{with_error(*found, plus=True)} {unit}, {verdict}"


def two_lines(first, second):
    return first + ("\n" + second if second else "")


def cost_cells(deck, model):
    """Time step, wall-clock and CPU seconds a run, wall-clock over the reference's."""
    cost, base = deck.cost[model], deck.cost.get(REFERENCE)
    wall, cpu = cost.seconds("wall-clock"), cost.seconds("CPU")
    which = "CPU" if cpu and base and base.seconds("CPU") else "wall-clock"
    mine, other = cost.seconds(which), base.seconds(which) if base else None
    ratio = "n/a"
    if mine and other and other.mean:
        value = mine.mean / other.mean
        spread = None if mine.error is None or other.error is None else value * math.hypot(mine.error / mine.mean, other.error / other.mean)
        ratio = "1" if model == REFERENCE else with_error(value, spread) if spread is not None else number(value)
    return [f"{1e6 * cost.dt:g}" if cost.dt else "n/a", cell(wall), cell(cpu), ratio]


def write_deck(page, deck, k):
    """Number of deviations that were tested."""
    page.heading(deck.title[0].upper() + deck.title[1:])
    names, models = observables(deck), deck.models
    base = deck.quantities.get(REFERENCE)
    seeds = sorted({len(next(iter(q.values())).values) for q in deck.quantities.values() if q}) or [0]
    spread = ("from the spread within one run: windows of the flow, particles" if deck.within else
              "one seed: no spread is known" if seeds[-1] < 2 else f"{seeds[-1]} seeds" if seeds[0] == seeds[-1] else
              f"{seeds[0]} to {seeds[-1]} seeds; of one seed no spread is known")
    if base is None:
        page.text(f"No unstretched `mpm` runs here: nothing to hold {', '.join(models)} against.")
    elif names and deck.clock():
        page.figure(picture(deck, names[:PANELS]), f"flow-{k}-{deck.name}",
                    f"Deviation from the unstretched `mpm` against cost; ± one standard error ({spread}); the band is the reference's own.")
    costs = {m: cost_cells(deck, m) for m in models}
    kept = [k for k in range(4) if any(c[k] != "n/a" for c in costs.values())]
    head = ["time step, µs", "wall-clock, s a run", "CPU, s a run", "cost / mpm's"]
    head = ["model", *[head[k] for k in kept], *[name for _, name in names]]
    rows = []
    for model in models:
        row = [words(model), *[costs[model][k] for k in kept]]
        for _, name in names:
            mine = deck.quantities[model].get(name)
            off = "reference" if model == REFERENCE else against(mine, base and base.get(name), name)
            row.append(two_lines(cell(mine), off.replace(", ", "\n")))  # narrow, or the page is too
        rows.append(row)
    page.table(head, rows)
    for model, sentence in deck.stopped.items():
        if model not in models:
            page.text(f"**Stopped.** {words(model)}: {sentence}.")
    shown = {name for _, name in names}
    rest = [q for q in dict.fromkeys(q for m in models for q in deck.quantities[m]) if q not in shown]
    if rest:
        full = lambda m, q: two_lines(cell(deck.quantities[m].get(q)), "" if m == REFERENCE or q.startswith(COSTS) else
                                      against(deck.quantities[m].get(q), base and base.get(q), q))
        page.table(["quantity", *[words(m) for m in models]], [[q, *[full(m, q) for m in models]] for q in rest],
                   title=f"{len(rest)} other quantit{'ies' if len(rest) > 1 else 'y'} of this deck")
    page.text("From " + ", ".join(f"`{s}`" for s in deck.sources) + f"; ± is the standard error, {spread}.")
    return sum("significant" in cell for row in rows for cell in row)


def write(page, decks):
    page.text("The reference is model `mpm` unstretched: the computed law. So a deviation here is what another law, or stretching, does to the flow, "
              "not an error against an experiment. Cost: CPU seconds where every run kept them, else wall-clock, which says little on a machine with "
              "other work.")
    tested = sum(write_deck(page, deck, k) for k, deck in enumerate(decks, 1))
    if tested:
        page.text(f"{tested} of these differences have a spread and were tested (Welch's t test on the seeds, p < 0.05; 1.96 standard errors "
                  f"where one run gives the spread): about {0.05 * tested:.1g} would be called significant by chance alone.")
