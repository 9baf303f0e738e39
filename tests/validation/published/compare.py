#!/usr/bin/python3
"""Published measurements and finite elements beside the laws and presses of this project, with nothing tuned.

    compare.py --mpm build/release/tools/mpm/mpm -o FOLDER [SET.csv ...]
    compare.py --mpm ... --check docs/evidence/published/compared.csv     laws alone, against the stored rows: seconds
    compare.py --table docs/evidence/published/compared.csv               the table of stored rows

Writes FOLDER/compared.csv (each row of each set: published, computed, ratio), FOLDER/table.md (a line for each set, the largest
disagreement first) and a picture of each set. Without SET: all sets beside this file. About five minutes of CPU time.

A set is a CSV file: lines `# key: value`, then columns. A quantity of the material may be a key (the same in every row) or a column:
  density_kg_m3, youngs_modulus_Pa, poisson_ratio, yield_stress_Pa, hardening_modulus_Pa, radius_m (1 mm without it)
  flat_youngs_modulus_Pa, flat_poisson_ratio, flat_density_kg_m3   an elastic flat (without them the flat is rigid)
Where: delta_over_R (displacement of the plane against the centre), a_over_R (contact radius) or speed_m_s.
Published: F_over_YR2, a_over_R, pressure_over_Y (force over pi a^2 Y), F_over_Hertz, e. A column `case` names rows of another origin.
Keys: title, source, read (where the numbers were read), kind (finite elements, experiment, ...), inputs, caution,
  compute: law     a free sphere on the rigid wall      (mpm table, mpm export)
           press   a sphere between planes              (mpm press --support midplane)
           pair    a sphere on the elastic flat         (mpm table of the pair, mpm export)
           impact  a collision at the speed of the row  (mpm law)
  allowed QUANTITY: relative difference (of e: absolute) that published and computed error explain, and the reason
"""
import argparse
import csv
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
INPUTS = {"density_kg_m3": "density", "youngs_modulus_Pa": "youngs_modulus", "poisson_ratio": "poisson_ratio",
          "yield_stress_Pa": "yield_stress", "hardening_modulus_Pa": "hardening_modulus", "radius_m": "radius",
          "flat_youngs_modulus_Pa": "flat_youngs_modulus", "flat_poisson_ratio": "flat_poisson_ratio",
          "flat_density_kg_m3": "flat_density"}
PLACES = ("delta_over_R", "speed_m_s")
QUANTITIES = ("F_over_YR2", "a_over_R", "pressure_over_Y", "F_over_Hertz", "e")
RESOLVED = 0.15  # part of a press's overlaps that counts: its cells suit the last contact, below they are too wide
NAMES = {"F_over_YR2": "force", "F_over_Hertz": "force", "a_over_R": "contact radius", "pressure_over_Y": "mean pressure", "e": "e"}
MEANING = {"law": "free sphere on a rigid wall, law", "press": "sphere between planes, solver", "pair": "sphere on the flat, law",
           "impact": "collision, law"}

class Set:
    """One published set: its keys and its rows."""

    def __init__(self, path):
        self.name = path.stem
        self.keys, lines = {}, []
        for line in path.read_text().splitlines():
            if line.startswith("#"):
                key, _, value = line[1:].partition(":")
                self.keys[key.strip()] = value.strip()
            elif line.strip():
                lines.append(line)
        for key in ("title", "source", "kind", "read", "inputs", "compute"):
            if key not in self.keys:
                sys.exit(f"{path}: the line '# {key}: ...' is missing")
        self.rows = list(csv.DictReader(lines))
        if not self.rows:
            sys.exit(f"{path}: no rows")
        unknown = [c for c in self.rows[0] if c not in (*INPUTS, *PLACES, *QUANTITIES, "case")]
        if unknown:
            sys.exit(f"{path}: unknown column '{unknown[0]}'; allowed: {', '.join((*INPUTS, *PLACES, *QUANTITIES, 'case'))}")
        self.ways = [way.strip() for way in self.keys["compute"].split(",")]
        for way in self.ways:
            if way not in MEANING:
                sys.exit(f"{path}: compute: unknown '{way}'; allowed: {', '.join(MEANING)}")

    def body(self, row):
        """The material and radius of a row, as a tuple that groups rows."""
        found = {}
        for column, name in INPUTS.items():
            text = row.get(column, self.keys.get(column))
            if text:
                found[name] = float(text)
        for needed in ("density", "youngs_modulus", "poisson_ratio"):
            if needed not in found:
                sys.exit(f"{self.name}.csv: '{needed}' stands neither in the head nor in a column")
        found.setdefault("radius", 1e-3)
        return tuple(sorted(found.items()))

    def groups(self):
        bodies = {}
        for row in self.rows:
            bodies.setdefault(self.body(row), []).append(row)
        return bodies

    def place(self):
        """The column that says where: the overlap, the speed, or the contact radius of a set that has no overlap."""
        columns = self.rows[0]
        return next(c for c in (*PLACES, "a_over_R") if c in columns)

    def quantities(self):
        return [q for q in QUANTITIES if q in self.rows[0] and q != self.place()]

    def allowed(self, quantity):
        text = self.keys.get(f"allowed {quantity}", "")
        return float(text.partition(":")[0]) if text else None

class Solver:
    """mpm, in a folder for its files."""

    def __init__(self, program, folder):
        self.program, self.folder = str(program), Path(folder)

    def __call__(self, *words):
        done = subprocess.run([self.program, *map(str, words)], capture_output=True, text=True)
        if done.returncode != 0:
            raise RuntimeError(f"{' '.join(map(str, words))}: {done.stderr.strip()}")
        return done.stdout

    def materials(self, body):
        lines = ["[material.m]", f"density = {body['density']}", f"youngs_modulus = {body['youngs_modulus']}",
                 f"poisson_ratio = {body['poisson_ratio']}"]
        if "yield_stress" in body:
            lines.append(f"yield_stress = {body['yield_stress']}")
        if body.get("hardening_modulus"):
            lines.append(f"hardening = {{ law = \"linear\", modulus = {body['hardening_modulus']} }}")
        if "flat_youngs_modulus" in body:
            lines += ["[material.flat]", f"density = {body.get('flat_density', body['density'])}",
                      f"youngs_modulus = {body['flat_youngs_modulus']}", f"poisson_ratio = {body['flat_poisson_ratio']}"]
        lines += ["[particle.p]", "material = \"m\"", f"radius = {body['radius']}"]
        path = self.folder / "materials.toml"
        path.write_text("\n".join(lines) + "\n")
        return path

def e_star(body):
    """E* of sphere and flat, Pa; a flat without a modulus is rigid."""
    soft = (1 - body["poisson_ratio"]**2) / body["youngs_modulus"]
    if "flat_youngs_modulus" in body:
        soft += (1 - body["flat_poisson_ratio"]**2) / body["flat_youngs_modulus"]
    return 1 / soft

def exported(solver, file, pair, radius):
    """Overlap/R, force in N and contact radius/R of a law, rows even in overlap^(1/4)."""
    out = solver.folder / "law.csv"
    flat = [] if pair == "m:wall" else ["--radius-ratio", "inf"]
    solver("export", file, "--pair", pair, "--effective-radius", radius, *flat, "--points", 2000, "-o", out)
    lines = [line for line in out.read_text().splitlines() if not line.startswith("#")]
    rows = list(csv.DictReader(lines))
    return (np.array([float(r["overlap_m"]) for r in rows]) / radius, np.array([float(r["force_N"]) for r in rows]),
            np.array([float(r["contact_radius_m"]) for r in rows]) / radius)

def curve_of(solver, way, body, depth):
    """Overlap/R, force in N and contact radius/R of the body by one of the ways, up to the overlap/R `depth`."""
    materials, radius = solver.materials(body), body["radius"]
    if way == "press":
        out = solver.folder / "press.csv"
        solver("press", materials, "--particle", "p", "--depth", depth, "--support", "midplane", "-o", out)
        rows = list(csv.DictReader(line for line in out.read_text().splitlines() if not line.startswith("#")))
        rows = [r for r in rows if r["branch"] == "load"]
        return (np.array([float(r["delta_m"]) for r in rows]) / radius, np.array([float(r["force_N"]) for r in rows]),
                np.array([float(r["contact_radius_m"]) for r in rows]) / radius)
    file = solver.folder / "law.h5"
    pair = "m:flat" if way == "pair" else "m:wall"
    # overlaps of the file are those of R*, which is R on a flat
    solver("table", materials, "--pair", pair, "--depth", depth, "--damage-number", 0, "-o", file)
    return exported(solver, file, pair, radius)

def window(x, f, at, share=0.04):
    """A press's value at an overlap: a straight line through the rows within 4 % of it, which the contact edge's steps scatter about."""
    near = np.abs(x / at - 1) < share
    if near.sum() < 4:
        return float(np.interp(at, x, f))
    return float(np.polyval(np.polyfit(x[near] - at, f[near], 1), 0))

def computed(curve, way, body, place, at, quantity):
    """One quantity by one of the ways at overlap/R `at`, or where the contact radius is `at`; None beyond the curve."""
    x, force, radius = curve
    if place == "a_over_R":
        if at > radius.max():
            return None
        at = float(x[np.argmax(radius >= at)])
    if not 0 < at <= x.max() * (1 + 1e-9):
        return None
    if way == "press" and at < RESOLVED * x.max():
        return None
    value = window if way == "press" else (lambda u, f, v: float(np.interp(v**0.25, u**0.25, f)))
    f, a, strength = value(x, force, at), value(x, radius, at), body.get("yield_stress", math.nan)
    r = body["radius"]
    return {"F_over_YR2": f / (strength * r**2), "a_over_R": a, "pressure_over_Y": f / (math.pi * (a * r)**2 * strength),
            "F_over_Hertz": f / (4 / 3 * e_star(body) * r**2 * at**1.5)}[quantity]

def impact(solver, body, file, speed):
    partner = ["--pair", "m:flat", "--radius2", "inf"] if "flat_youngs_modulus" in body else ["--pair", "m:wall"]
    return json.loads(solver("law", file, *partner, "--radius", body["radius"], "--velocity", speed, "--json"))["e"]

def jobs(published, ends):
    """(way, overlap/R to go to) of a body; a press whose rows span more than it resolves is made twice, the second to an eighth."""
    deepest = min(1.02 * max(ends), 0.5) if published.place() == "delta_over_R" else 0.05
    for way in published.ways:
        yield way, deepest
        if way == "press" and min(ends) < RESOLVED * deepest and published.place() == "delta_over_R":
            yield way, deepest / 8

def compare(solver, published):
    """Rows (set, case, quantity, way, place, at, published, computed, ratio) of a set, and sentences about what is not computed."""
    out, left, done = [], [], set()
    place = published.place()
    for body_items, rows in published.groups().items():
        body = dict(body_items)
        ends = [float(r[place]) for r in rows]
        for way, depth in jobs(published, ends):
            curve = file = None
            try:
                if way == "impact":
                    file = solver.folder / "impact.h5"
                    pair = "m:flat" if "flat_youngs_modulus" in body else "m:wall"
                    slow = [] if "flat_youngs_modulus" in body else ["--damage-number", 0]
                    solver("table", solver.materials(body), "--pair", pair, "-o", file, *slow)
                else:
                    curve = curve_of(solver, way, body, depth)
            except RuntimeError as problem:
                left.append(f"{published.name}, {MEANING[way]}: {problem}")
                continue
            for row, at in zip(rows, ends):
                if (way, published.name, body_items, at) in done:
                    continue
                for quantity in published.quantities():
                    if way == "impact":
                        ours = impact(solver, body, file, at)
                    else:
                        ours = computed(curve, way, body, place, at, quantity)
                    if ours is None or not math.isfinite(ours):
                        continue
                    theirs = float(row[quantity])
                    stiffness = "" if "yield_stress" not in body else f"{e_star(body) / body['yield_stress']:.4g}"
                    out.append({"set": published.name, "case": row.get("case", ""), "E*/Y": stiffness, "quantity": quantity, "way": way,
                                "place": place, "at": f"{at:.6g}", "published": f"{theirs:.6g}", "computed": f"{ours:.6g}",
                                "ratio": f"{ours / theirs:.5f}", "difference": f"{ours - theirs:.5f}"})
                    if way == "press":
                        done.add((way, published.name, body_items, at))
        print(f"{published.name}: {len(out)} numbers", file=sys.stderr, flush=True)
    return out, left

def summary(sets, rows):
    """A line for each set, quantity and way: how many, range and median of the ratio, share within what is allowed."""
    lines = []
    for published in sets:
        for quantity in published.quantities():
            for way in published.ways:
                own = [r for r in rows if (r["set"], r["quantity"], r["way"]) == (published.name, quantity, way)]
                if not own:
                    continue
                absolute = quantity == "e"
                values = [float(r["difference"] if absolute else r["ratio"]) for r in own]
                off = [abs(v) if absolute else abs(v - 1) for v in values]
                bound = published.allowed(quantity)
                inside = sum(o <= bound for o in off) if bound else None
                lines.append((max(off) / bound if bound else 0, published, quantity, way, values, bound, inside))
    return sorted(lines, key=lambda line: -line[0])

def table(lines):
    out = ["| set | kind | quantity | computed by | points | computed/published | median | allowed | within |", "|---|---|---|---|---|---|---|---|---|"]
    for _, published, quantity, way, values, bound, inside in lines:
        absolute = quantity == "e"
        span = f"{min(values):+.3f} to {max(values):+.3f}" if absolute else f"{min(values):.3f} to {max(values):.3f}"
        median = f"{np.median(values):+.3f}" if absolute else f"{np.median(values):.3f}"
        out.append(f"| `{published.name}` | {published.keys['kind']} | {quantity} | {MEANING[way]} | {len(values)} | {span} | {median} | "
                   + (f"{bound:g} | {inside} of {len(values)} |" if bound else "not stated | |"))
    return "\n".join(out) + "\n"

def check(path, sets, rows):
    """Ends with 1 where a computed number differs from the stored one. The atlas is the same, so only rounding may: 1e-3."""
    key = lambda r: tuple(r[k] for k in ("set", "case", "E*/Y", "quantity", "way", "at"))  # noqa: E731
    ways = {published.name: published.ways for published in sets}
    with open(path) as file:
        stored = {key(r): float(r["computed"]) for r in csv.DictReader(file) if r["way"] in ways.get(r["set"], ())}
    found = {key(r): float(r["computed"]) for r in rows}
    wrong = [f"{k}: {words}" for keys, words in ((found.keys() - stored.keys(), "not stored"), (stored.keys() - found.keys(), "not computed"))
             for k in sorted(keys)]
    wrong += [f"{k}: {found[k]:g}, stored {stored[k]:g}" for k in sorted(found.keys() & stored.keys()) if not abs(found[k] / stored[k] - 1) <= 1e-3]
    for line in wrong:
        print(line)
    print(f"{len(found)} numbers, {len(wrong)} differ from {path}")
    sys.exit(1 if wrong or not found else 0)

def draw(path, published, rows):
    if len(rows) < 3:  # the table has them
        return
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    quantities = published.quantities()
    figure, axes = plt.subplots(1, len(quantities), figsize=(4.6 * len(quantities) + 3, 3.8), squeeze=False)
    marks = {"law": "o", "press": "s", "pair": "D", "impact": "^"}
    for axis, quantity in zip(axes[0], quantities):
        own = [r for r in rows if r["quantity"] == quantity]
        bodies = sorted({r["E*/Y"] for r in own}, key=lambda t: float(t or 0))
        for k, stiffness in enumerate(bodies):
            for way in published.ways:
                some = [r for r in own if r["E*/Y"] == stiffness and r["way"] == way]
                if some:
                    shown = "difference" if quantity == "e" else "ratio"
                    axis.plot([float(r["at"]) for r in some], [float(r[shown]) for r in some], marks[way], ms=4, color=f"C{k}",
                              mfc="w" if way == "law" else f"C{k}", label=f"{MEANING[way]}" + (f", E*/Y {stiffness}" if stiffness else ""))
        bound, middle = published.allowed(quantity), 0 if quantity == "e" else 1
        if bound:
            axis.axhspan(middle - bound, middle + bound, color="0.92", label="allowed")
        axis.axhline(middle, color="k", lw=0.6)
        axis.set_xlabel({"delta_over_R": "overlap/R", "speed_m_s": "speed, m/s", "a_over_R": "contact radius/R"}[published.place()])
        axis.set_ylabel(NAMES[quantity] + (", computed less published" if quantity == "e" else ", computed over published"))
        if len(own) > 2 and max(float(r["at"]) for r in own) > 20 * min(float(r["at"]) for r in own):
            axis.set_xscale("log")
    axes[0][-1].legend(*axes[0][0].get_legend_handles_labels(), fontsize=8, loc="center left", bbox_to_anchor=(1, 0.5))
    figure.suptitle(published.keys["title"], fontsize=10)
    figure.tight_layout()
    figure.savefig(path, dpi=110)
    plt.close(figure)

def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--mpm", help="the program mpm")
    parser.add_argument("-o", "--output", help="folder to write into")
    parser.add_argument("--check", metavar="CSV", help="compare what laws give with these stored rows")
    parser.add_argument("--table", metavar="CSV", help="print the table of these stored rows, with -o draw their pictures; compute nothing")
    parser.add_argument("--no-pictures", action="store_true")
    parser.add_argument("sets", nargs="*", type=Path, help="sets (default: all beside this file)")
    words = parser.parse_args()
    sets = [Set(path) for path in words.sets or sorted(HERE.glob("*.csv"))]
    if words.table:
        with open(words.table) as file:
            rows = list(csv.DictReader(file))
        print(table(summary(sets, rows)), end="")
        for published in sets if words.output else []:
            draw(Path(words.output) / f"{published.name}.png", published, [r for r in rows if r["set"] == published.name])
        return
    if not words.mpm or not (words.output or words.check):
        parser.error("--mpm and one of -o, --check are needed")
    if words.check:
        for published in sets:
            published.ways = [way for way in published.ways if way != "press"]
    rows, left = [], []
    with tempfile.TemporaryDirectory() as folder:
        solver = Solver(words.mpm, folder)
        for published in sets:
            found, sentences = compare(solver, published)
            rows += found
            left += sentences
            if words.output and not words.no_pictures and found:
                Path(words.output).mkdir(parents=True, exist_ok=True)
                draw(Path(words.output) / f"{published.name}.png", published, found)
    if words.check:
        check(words.check, sets, rows)
    out = Path(words.output)
    out.mkdir(parents=True, exist_ok=True)
    with (out / "compared.csv").open("w") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    print(table(summary(sets, rows)), end="")
    for sentence in left:
        print(f"not computed: {sentence}")

if __name__ == "__main__":
    main()
