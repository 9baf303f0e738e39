"""Map of (V/V_on, delta/R*) in which the contacts of the flow lived, within the range of their law: from the plug-in's stats.json. V_on: the speed at
which yield begins. Of decks that are no example also the energies over time and the speeds."""
import math

import numpy as np
from matplotlib.colors import LogNorm

from . import files
from .ensemble_part import is_member
from .page import legend_below, number, plt

BINS = 8  # a decade, as the plug-in counts
MOST_RUNS = 12  # of decks that are no example
ENERGIES = {"kinetic_J": "kinetic", "rotational_J": "rotation", "elastic_J": "elastic, in contacts", "normal_dissipation_J": "taken by normal contacts",
            "wave_dissipation_J": "taken by waves", "other_work_J": "taken by friction and the like"}


class Contacts:
    """All contacts of one kind of pair in one deck's runs. Speeds in V/V_on (of a body that does not yield: in m/s), overlaps over R*."""

    def __init__(self, key, entry):
        self.kind, self.materials = key
        self.onset, self.limit = entry.get("onset_speed_m_per_s"), entry.get("overlap_over_radius_limit")
        self.yields = self.onset is not None and self.limit is not None
        self.unit = self.onset if self.yields else 1.0  # m/s
        self.fastest = None  # speed at which the law's range of damage numbers ends
        self.begun = self.beyond = self.beyond_axis = self.below_axis = 0.0
        self.speed, self.overlap = {}, {}
        self.joint, self.mapped = {}, True  # (bin of speed, of overlap): contacts that ended; of every run, or not at all
        self.speed_max = self.overlap_max = 0.0

    def add(self, entry, path):
        files.rows_with(path, [entry], ("contacts_begun", "contact_steps_beyond_table"))
        self.begun += entry["contacts_begun"]
        self.beyond += entry["contact_steps_beyond_table"]
        self.beyond_axis += entry.get("contacts_beyond_speed_axis") or 0
        self.below_axis += entry.get("contacts_below_speed_axis") or 0
        fastest = (entry["impact_speed_max_m_per_s"] or 0) / self.unit
        if self.yields and entry.get("damage_number_limit") and entry.get("damage_number_max"):  # I goes as V^2
            self.fastest = fastest * math.sqrt(entry["damage_number_limit"] / entry["damage_number_max"])
        self.speed_max = max(self.speed_max, fastest)
        self.overlap_max = max(self.overlap_max, entry["overlap_over_radius_max"] or 0)
        for into, name in ((self.speed, "impact_speed"), (self.overlap, "largest_overlap_over_radius")):
            histogram = entry.get(name)
            if not isinstance(histogram, dict) or len(histogram.get("lower_edge", [])) != len(histogram.get("count", [0])):
                raise files.Unreadable(path, f"'{name}' is no histogram with as many edges as counts")
            for edge, count in zip(histogram["lower_edge"], histogram["count"]):
                if count:
                    bin_ = round(BINS * math.log10(edge))
                    into[bin_] = into.get(bin_, 0) + count

        self.add_map(entry, path)

    def add_map(self, entry, path):
        found = entry.get("contact_map")
        self.mapped = self.mapped and found is not None
        if not found:
            return
        try:
            speeds, overlaps = ([round(BINS * math.log10(e)) for e in found[f"{w}_lower_edge"]] for w in ("speed", "overlap"))
            fits = len(found["count"]) == len(speeds) and all(len(row) == len(overlaps) for row in found["count"])
        except (KeyError, TypeError, ValueError):
            fits = False
        if not fits:
            raise files.Unreadable(path, "'contact_map' is no table with as many rows and columns as edges")
        for speed, row in zip(speeds, found["count"]):
            for overlap, count in zip(overlaps, row):
                if count:
                    self.joint[speed, overlap] = self.joint.get((speed, overlap), 0) + count

    def plane(self):
        """(edges in V/V_y, edges in overlap/R*, counts); None: the plug-in did not count the two together."""
        if not self.mapped or not self.joint:
            return None
        low, high = ([f(k[axis] for k in self.joint) for axis in (0, 1)] for f in (min, max))
        counts = np.zeros((high[1] - low[1] + 1, high[0] - low[0] + 1))
        for (speed, overlap), count in self.joint.items():
            counts[overlap - low[1], speed - low[0]] = count
        edges = [np.array([10**(b / BINS) for b in range(low[axis], high[axis] + 2)]) for axis in (0, 1)]
        return edges[0] / self.unit, edges[1], counts

    def histogram(self, which):
        """(edges, counts), edges in V/V_on or overlap/R*."""
        counts = self.speed if which == "speed" else self.overlap
        bins = range(min(counts), max(counts) + 1)
        edges = np.array([10**(b / BINS) for b in [*bins, bins[-1] + 1]])
        return edges / (self.unit if which == "speed" else 1.0), np.array([counts.get(b, 0) for b in bins])

    def quantile(self, which, part):
        edges, counts = self.histogram(which)
        place = np.cumsum(counts) / np.sum(counts)
        k = int(np.searchsorted(place, part))
        before = place[k - 1] if k else 0.0
        found = float(edges[k] * (edges[k + 1] / edges[k])**((part - before) / (place[k] - before)))
        return min(found, (self.speed_max if which == "speed" else self.overlap_max) or found)

    def elastic_share(self):
        """Fraction of the contacts that were slower than the onset of yield (the bin of the onset is cut in proportion)."""
        edges, counts = self.histogram("speed")
        if not self.yields:
            return 1.0
        parts = np.clip(np.log(1 / edges[:-1]) / np.log(edges[1:] / edges[:-1]), 0, 1)
        return float(np.sum(parts * counts) / np.sum(counts))


def add_run(kinds, path, stats):
    """Adds one run's pairs to `kinds`: {(kind, materials): Contacts}."""
    if not isinstance(stats.get("pairs"), list):
        raise files.Unreadable(path, "has no 'pairs'")
    for entry in stats["pairs"]:
        if isinstance(entry, dict) and entry.get("contacts_begun"):
            key = (entry["kind"], tuple(entry["materials"]))
            kinds.setdefault(key, Contacts(key, entry)).add(entry, path)


def sorted_kinds(kinds):
    return sorted(kinds.values(), key=lambda c: -c.begun)


def read(decks):
    """({deck title: [Contacts, ...]}, [Unreadable, ...]) of the unstretched `mpm` runs."""
    found, broken = {}, []
    for deck in decks:
        kinds = {}
        try:
            for run in deck.folders.get("mpm", []):
                path = run / "stats.json"
                if not path.exists():
                    continue
                add_run(kinds, path, files.read_json(path))
        except files.Unreadable as error:
            broken.append(error)
            continue
        if kinds:
            found[deck.title] = sorted_kinds(kinds)
    return found, broken


class Run:
    """One run of a deck that is no example: `kinds` of its contacts, `series` of its energies."""

    def __init__(self, path, title):
        self.path, self.title = path, title
        stats = files.read_json(path)
        if not isinstance(stats.get("series"), dict):
            raise files.Unreadable(path, "has no 'series'")
        kinds = {}
        add_run(kinds, path, stats)
        self.kinds = sorted_kinds(kinds)
        self.series = stats["series"]
        columns = [c for c in self.series.values() if isinstance(c, list)]
        for column in columns:  # null: a number that was none, where the run stopped
            column[:] = [math.nan if v is None else v for v in column]
        if "time_s" not in self.series or len(columns) != len(self.series) or len({len(c) for c in columns}) != 1:
            raise files.Unreadable(path, "'series' is no table with columns of one length")


def is_statistics(path):
    """True of a file of the plug-in, whatever its name."""
    try:
        with open(path, encoding="utf-8") as file:
            beginning = file.read(400)
        return '"granulaw_version"' in beginning and '"time_step_used_s"' in beginning
    except (OSError, UnicodeDecodeError):
        return False


def read_own(folder, decks):
    """([Run, ...], number of runs left out, [Unreadable, ...]): files that `stats FILE` wrote in runs of the user's own decks."""
    examples = {run.resolve() for deck in decks for runs in deck.folders.values() for run in runs}
    paths = [p for p in files.find_ending(folder, ".json") if not is_member(p, folder) and p.parent.resolve() not in examples and
             not (p.parent / "command").exists() and is_statistics(p)]
    found, broken = [], []
    for path in paths[:MOST_RUNS]:
        try:
            found.append(Run(path, str(path.relative_to(folder))))
        except files.Unreadable as error:
            broken.append(error)
    return found, len(paths[MOST_RUNS:]), broken


def name_of(contacts):
    return "between particles" if contacts.kind == "particles" else f"at the {contacts.kind}"


def draw_law(middle, contacts, x_low, x_high, y_low):
    """End of the law, and onset of yield."""
    end = contacts.fastest or x_high
    middle.set_facecolor("#efe9e4")
    middle.fill_between([x_low, end], y_low, contacts.limit, color="white", lw=0)
    middle.plot([x_low, end, end], [contacts.limit, contacts.limit, y_low], color="tab:red", lw=1, label="end of the law")
    middle.axvspan(x_low, 1, color="tab:green", alpha=0.08, lw=0)
    middle.plot([1, 1], [y_low, contacts.limit], color="tab:green", lw=0.9, linestyle="--", label="onset of yield")


def draw(figure, contacts, title):
    """One map: in the middle the plane, above and to the right what the plug-in counted."""
    grid = figure.add_gridspec(2, 2, width_ratios=(4, 1), height_ratios=(1, 3.4))
    middle = figure.add_subplot(grid[1, 0])
    top, right = figure.add_subplot(grid[0, 0], sharex=middle), figure.add_subplot(grid[1, 1], sharey=middle)
    speed, speeds = contacts.histogram("speed")
    overlap, overlaps = contacts.histogram("overlap")
    x_low, x_high = 0.5 * speed[0], 3 * max(speed[-1], contacts.fastest or 0)
    y_low, y_high = max(0.5 * overlap[0], 1e-9), 3 * max(overlap[-1], contacts.limit or 0)
    if contacts.yields:
        draw_law(middle, contacts, x_low, x_high, y_low)
    plane = contacts.plane()
    if plane:
        v, x, counts = plane
        middle.pcolormesh(v, x, np.ma.masked_equal(counts, 0), cmap="Blues", norm=LogNorm(0.3, max(counts.max(), 1)))
    else:
        middle.axvspan(contacts.quantile("speed", 0.005), contacts.quantile("speed", 0.995), color="tab:blue", alpha=0.10, lw=0)
        middle.axhspan(contacts.quantile("overlap", 0.005), contacts.quantile("overlap", 0.995), color="tab:blue", alpha=0.10, lw=0,
                       label="99 % of the contacts, each way")
    middle.plot([contacts.speed_max], [contacts.overlap_max], marker="+", color="tab:blue", ms=9, mew=1.6, linestyle="", label="largest V, largest δ")
    middle.set(xscale="log", yscale="log", xlim=(x_low, x_high), ylim=(y_low, y_high), xlabel="approach speed at first touch, " + ("$V/V_{on}$" if contacts.yields else "m/s"),
               ylabel="largest overlap, $\\delta/R^*$")
    top.stairs(np.maximum(speeds, 0.3), speed, fill=True, color="tab:blue", alpha=0.55, baseline=0.3)
    right.stairs(np.maximum(overlaps, 0.3), overlap, fill=True, color="tab:blue", alpha=0.55, baseline=0.3, orientation="horizontal")
    top.set(yscale="log", ylabel="contacts", title=title, ylim=(0.5, None))
    right.set(xscale="log", xlabel="contacts", xlim=(0.5, None))
    top.tick_params(labelbottom=False)
    right.tick_params(labelleft=False)
    return middle


def picture(all_contacts):
    count = min(len(all_contacts), 2)
    figure = plt.figure(figsize=(4.8 * count + 0.2, 4.6))
    parts = figure.subfigures(1, count, squeeze=False)[0]
    for part, contacts in zip(parts, all_contacts):
        axis = draw(part, contacts, f"{name_of(contacts)}: {contacts.begun:,.0f}".replace(",", "\u2009"))
    handles, labels = axis.get_legend_handles_labels()
    legend_below(figure, handles, labels, 3)
    return figure


def prefixed(values, unit):
    """(factor, "mJ"): so that the largest of `values` is 1 to 1000."""
    top = max((abs(v) for v in values if math.isfinite(v)), default=0)
    step = min(max(math.floor(math.log10(top) / 3), -4), 2) if top > 0 else 0
    return 1000.0**-step, {-4: "p", -3: "n", -2: "µ", -1: "m", 0: "", 1: "k", 2: "M"}[step] + unit


def picture_of_run(run):
    """Energies over time, the fastest particle, and the speeds at which contacts began."""
    figure, (energies, speed, axis) = plt.subplots(1, 3, figsize=(12.4, 3.4))
    time = run.series["time_s"]
    factor, unit = prefixed([v for name in ENERGIES for v in run.series.get(name, [])], "J")
    for name, text in ENERGIES.items():
        if any(run.series.get(name, [])):
            energies.plot(time, [factor * v for v in run.series[name]], label=text)
    energies.set(title="Energies", xlabel="time, s", ylabel=f"energy, {unit}", ylim=(0, None))
    energies.legend()
    speed.plot(time, run.series["fastest_particle_m_per_s"])
    speed.set(title="Fastest particle", xlabel="time, s", ylabel="speed, m/s", ylim=(0, None))
    for k, c in enumerate(run.kinds):
        edges, counts = c.histogram("speed")
        axis.stairs(counts, edges * c.unit, color=f"C{k}", label=f"{' - '.join(c.materials)}, {c.kind}")
        if c.yields:
            axis.axvline(c.onset, color=f"C{k}", linestyle="--", lw=0.9)
    axis.set(title="Approach speeds", xscale="log", yscale="log", xlabel="approach speed at first touch, m/s", ylabel="contacts begun")
    axis.set_ylim(0.5, 4 ** len(run.kinds) * axis.get_ylim()[1])  # room for the legend
    if run.kinds:
        axis.legend(loc="upper left")
    return figure


def write_runs(page, runs, left_out):
    """Part for the user's own decks."""
    for k, run in enumerate(runs, 1):
        page.heading(run.title)
        page.figure(picture_of_run(run), f"run-{k}", f"Run of `{run.path}`. Dashed: the speed at which yield begins, between the smallest particles.")
    if left_out:
        page.text(f"{left_out} older runs are left out. Name their folder with --from to see them.")


def write(page, found):
    page.text("Each contact has a speed at first touch and a largest overlap, counted in eight bins a decade: the bars above and beside each map. "
              "Blue in the map: contacts that ended, by both (`contactMap on`; runs without it show only how far the two reach, each for itself). "
              "White: what the law was computed for. Overlaps that speed alone does not explain come from static load and from several contacts at once.")
    rows = []
    for k, (deck, kinds) in enumerate(found.items(), 1):
        page.figure(picture(kinds), f"contacts-{k}", f"Contacts of {deck}" + (f": the two kinds of {len(kinds)} with most contacts." if len(kinds) > 2 else "."))
        for c in kinds:
            share = c.elastic_share()
            unit = "" if c.yields else " m/s"
            rows.append([deck, f"{'-'.join(c.materials)}, {c.kind}", f"{c.begun:.0f}", *[number(c.quantile("speed", p)) + unit for p in (0.5, 0.995)],
                         number(c.speed_max) + unit, number(c.fastest) if c.fastest else "not stated", f"{100 * share:.0f} %",
                         *[number(c.quantile("overlap", p)) for p in (0.5, 0.995)], number(c.overlap_max), number(c.limit) if c.limit else "no end", f"{c.beyond:.0f}",
                         f"{c.beyond_axis:.0f}", f"{c.below_axis:.0f}"])
    page.table(["deck", "pair", "contacts", "V/V_on: median", "99.5 %", "largest", "law to", "below onset", "δ/R*: median", "99.5 %", "largest",
                "law to", "steps beyond it", "too fast for it", "too slow for it"], rows)
    page.text("Quantiles are read from bins a third of their value wide: good to about 15 %. V_on: the speed at which yield begins between the smallest bodies; "
              "steps beyond it: contact-steps at overlaps beyond the table; too fast for it: contacts that began faster than its velocity axis goes; too slow for it: than the "
              "axis of a rate-dependent law begins. From the `stats.json` of each run (`fix granulaw/stats`).")
