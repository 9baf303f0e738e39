"""Samples of several seeds: mean, spread, and whether two of them differ (Welch's t test)."""
import csv
import math

import numpy as np


def decimals(error):
    """Decimals of a mean: those of the first digit of its standard error."""
    return max(0, -math.floor(math.log10(error)))


class Sample:
    """Values of one quantity, one a seed."""

    def __init__(self, values):
        self.values = np.asarray(list(values), dtype=float)
        if self.values.size == 0:
            raise ValueError("a sample needs one value at least")

    @property
    def mean(self):
        return float(np.mean(self.values))

    @property
    def deviation(self):
        """Sample standard deviation, or None with a single value."""
        return float(np.std(self.values, ddof=1)) if self.values.size > 1 else None

    @property
    def error(self):
        """Standard error of the mean, or None with a single value."""
        return None if self.deviation is None else self.deviation / math.sqrt(self.values.size)

    def __str__(self):
        if not self.error:
            return f"{self.mean:.4g}" + ("" if self.error is None else " ± 0")
        digits = decimals(self.error)
        return f"{self.mean:.{digits}f} ± {self.error:.{digits}f}" if digits <= 5 else f"{self.mean:.4g} ± {self.error:.1g}"


def student_tail(t, dof):
    """Two-sided P(|T| > t) of Student's t: with t = sqrt(dof) tan(x) its density becomes cos(x)^(dof-1)."""
    angles = np.linspace(math.atan(abs(t) / math.sqrt(dof)), math.pi / 2, 4001)
    whole = np.linspace(0, math.pi / 2, 4001)
    area = lambda x: float(np.trapz(np.cos(x).clip(0)**(dof - 1), x))
    return area(angles) / area(whole)


def welch(a, b):
    """p of `the two means are equal` (Welch 1947), None where a spread is missing or 0."""
    if a.error is None or b.error is None:
        return None
    variance = a.error**2 + b.error**2
    if variance == 0:
        return 1.0 if a.mean == b.mean else None
    dof = variance**2 / (a.error**4 / (a.values.size - 1) + b.error**4 / (b.values.size - 1))
    return student_tail((a.mean - b.mean) / math.sqrt(variance), dof)


def student_quantile(share, dof):
    """t with P(T > t) = share."""
    low, high = 0.0, 1e4
    for _ in range(60):
        t = (low + high) / 2
        low, high = (t, high) if student_tail(t, dof) > 2 * share else (low, t)
    return high


def resolved(a, b):
    """Least margin, over b's mean, at which two one-sided t tests, each at 5 %, call the two means equal (Schuirmann 1987):
    |difference| + t_0.95 standard errors. A difference below it is not resolved. None where a spread is missing."""
    if a.error is None or b.error is None or b.mean == 0:
        return None
    variance = a.error**2 + b.error**2
    if variance == 0:
        return abs(a.mean / b.mean - 1)
    dof = variance**2 / (a.error**4 / (a.values.size - 1) + b.error**4 / (b.values.size - 1))
    return (abs(a.mean - b.mean) + student_quantile(0.05, dof) * math.sqrt(variance)) / abs(b.mean)


def verdict(a, b):
    """A cell for a table: the change from b to a, and whether it is significant (p < 0.05)."""
    p = welch(a, b)
    change = f"{100 * (a.mean / b.mean - 1):+.1f} %" if b.mean else f"{a.mean - b.mean:+.3g}"
    if p is None:
        return f"{change}, {'one seed' if a.error is None or b.error is None else 'no spread'}: no verdict"
    return f"{change}, {'significant' if p < 0.05 else 'not significant'} (p = {p:.2g})"


def tabulate(tables, path):
    """tables[model]: of each seed, a dict of quantities. Writes them all to `path` (CSV: model, seed, quantity, value) and returns
    samples[model][quantity] for `markdown`; a quantity that some seed did not reach has no sample."""
    with open(path, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["model", "seed", "quantity", "value"])
        writer.writerows([m, k + 1, q, v] for m, runs in tables.items() for k, run in enumerate(runs) for q, v in run.items())
    return {m: {q: Sample(run[q] for run in runs) for q in runs[0] if all(q in run for run in runs)} for m, runs in tables.items()}


def read(path):
    """samples[model][quantity] of a file that `tabulate` wrote."""
    values = {}
    with open(path) as file:
        for row in csv.DictReader(file):
            values.setdefault(row["model"], {}).setdefault(row["quantity"], []).append(float(row["value"]))
    most = {m: max(map(len, q.values())) for m, q in values.items()}
    return {m: {q: Sample(v) for q, v in quantities.items() if len(v) == most[m]} for m, quantities in values.items()}


def markdown(samples, base="hertz"):
    """Table of {model: {quantity: Sample}}: value ± standard error, and each model's verdict against `base`."""
    models = list(samples)
    others = [m for m in models if m != base and base in samples]
    lines = ["| quantity | " + " | ".join(models + [f"{m} against {base}" for m in others]) + " |",
             "|---|" + "---|" * (len(models) + len(others))]
    for quantity in dict.fromkeys(q for m in models for q in samples[m]):
        cells = [str(samples[m].get(quantity, "n/a")) for m in models]
        cells += [verdict(samples[m][quantity], samples[base][quantity])
                  if quantity in samples[m] and quantity in samples[base] else "" for m in others]
        lines.append(f"| {quantity} | " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def write_tables(out, title, lead, tables, base="hertz"):
    """NAME.csv and report.md of a deck in the folder `out`, NAME being the title in small letters; NAME.png is the caller's.
    Verdicts are against `base`. Returns the samples of `tabulate`."""
    name = title.lower()
    samples = tabulate(tables, out / f"{name}.csv")
    (out / "report.md").write_text(f"# {title}\n\n{lead} ±: standard error.\n\n{markdown(samples, base)}\n![{name}]({name}.png)\n")
    return samples
