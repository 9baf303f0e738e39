#!/usr/bin/python3
"""Closed formulas of the literature beside the computed law: docs/evidence/formulas.csv and formulas.png.

    formulas.py --mpm build/release/tools/mpm/mpm -o docs/evidence

A sphere without hardening on a rigid wall, E*/Y of 30, 100 and 1000, nu = 0.3, without inertia (I = 0). The law is `mpm table --damage-number 0`;
e, largest force and overlap, contact time are `mpm law --json` at V/V_y (V_y: the yield velocity with p_y = 1.6 Y, base/scales.hpp).

Formulas, F over the overlap d of a sphere of the mass m and radius R:
  Hertz       F = 4/3 E* sqrt(R) d^1.5, e = 1
  Thornton    J. Appl. Mech. 64 (1997) 383, with p_y of 1.6, 2.5 and 2.8 Y (docs/reference/pair_gran_model_thornton.md)
  rigid-plastic  after Johnson, Contact Mechanics (1985), section 11.5: mean pressure p_d = 3 Y on a^2 = 2 R d while loading, and the
              elastic work of a Hertz contact with that force and radius comes back: W_e = 3 F^2/(10 E* a), e^2 = W_e/(m V^2/2)
  Jackson and Green  J. Tribology 127 (2005) 343: F alone (tests/validation/published/jackson_green_2005.csv)
  Jackson, Green and Marghitu  Nonlinear Dynamics (2010): e alone (tests/validation/published/jackson_green_marghitu_2010.csv)
"""
import argparse
import csv
import json
import math
import subprocess
import tempfile
from pathlib import Path

import numpy as np

NU, RADIUS, DENSITY, YIELD = 0.3, 1e-3, 1000.0, 1e6
MASS = 4 / 3 * math.pi * RADIUS**3 * DENSITY
STIFFNESSES = (30, 100, 1000)
SPEEDS = {30: (1.5, 2, 5, 10, 20), 100: (2, 5, 10, 20, 50, 100), 1000: (2, 5, 10, 30, 100, 300, 1000)}  # V/V_y: as far as overlaps stay below 0.2 R
OVERLAPS = {30: (0.02, 0.05, 0.1, 0.2), 100: (0.002, 0.005, 0.01, 0.02, 0.05, 0.1), 1000: (1e-4, 5e-4, 1e-3, 5e-3, 0.02, 0.05)}
FACTORS = (1.6, 2.5, 2.8)
FITTED = 100  # E*/Y from which the fits of Jackson and Green are shown; their materials have 138 to 1061


class Thornton:
    """His sphere on a rigid wall, p_y = factor Y."""

    def __init__(self, e_star, factor):
        self.e_star, self.pressure = e_star, factor * YIELD
        self.onset = (math.pi * self.pressure / (2 * e_star))**2 * RADIUS
        self.onset_force = 4 / 3 * e_star * math.sqrt(RADIUS) * self.onset**1.5

    def loading(self, d):
        return np.where(d <= self.onset, 4 / 3 * self.e_star * math.sqrt(RADIUS) * np.minimum(d, self.onset)**1.5,
                        self.onset_force + math.pi * self.pressure * RADIUS * (d - self.onset))

    def impact(self, speed):
        """e, largest force, contact time: loading by quadrature, unloading is Hertz of another radius."""
        energy = MASS * speed**2 / 2
        at_onset = 0.4 * self.onset_force * self.onset
        if energy <= at_onset:
            raise ValueError("below yield")
        slope = math.pi * self.pressure * RADIUS
        plastic = (-self.onset_force + math.sqrt(self.onset_force**2 + 2 * slope * (energy - at_onset))) / slope
        deepest, top = self.onset + plastic, self.onset_force + slope * plastic
        edge = math.sqrt((2 * top + self.onset_force) / (2 * math.pi * self.pressure))
        elastic = top / (4 / 3 * self.e_star * edge)
        back = 0.4 * top * elastic
        # d = deepest sin(angle) takes the root out of dt = dd/v
        angle = (np.arange(4000) + 0.5) / 4000 * math.pi / 2
        d = deepest * np.sin(angle)
        work = np.where(d <= self.onset, 0.4 * self.loading(d) * d,
                        at_onset + (d - self.onset) * (self.onset_force + 0.5 * slope * (d - self.onset)))
        there = np.sum(deepest * np.cos(angle) / np.sqrt(2 * np.maximum(energy - work, 1e-300) / MASS)) * math.pi / 2 / 4000
        # at u of the elastic overlap u^2.5 of the work is left: the time back is 1.4716 elastic/(rebound speed)
        u = np.sin(angle)
        home = np.sum(np.cos(angle) / np.sqrt(1 - u**2.5)) * math.pi / 2 / 4000 * elastic / math.sqrt(2 * back / MASS)
        return math.sqrt(back / energy), top, there + home


def rigid_plastic_e(e_star, speed):
    pressure, energy = 3 * YIELD, MASS * speed**2 / 2
    d = math.sqrt(energy / (math.pi * pressure * RADIUS))  # F = 2 pi R p d
    force, a = 2 * math.pi * RADIUS * pressure * d, math.sqrt(2 * RADIUS * d)
    return min(1.0, math.sqrt(3 * force**2 / (10 * e_star * a) / energy))


def jackson_green_force(e_star, d):
    c, e = 1.295 * math.exp(0.736 * NU), e_star * (1 - NU**2)
    critical = (math.pi * c * YIELD / (2 * e_star))**2 * RADIUS
    force = 4 / 3 * (RADIUS / e_star)**2 * (math.pi * c * YIELD / 2)**3
    x = d / critical
    if x <= 1.9:
        return force * x**1.5
    a = math.sqrt(RADIUS * d * (x / 1.9)**(0.14 * math.exp(23 * YIELD / e)))
    if a / RADIUS > 0.412:
        return math.nan  # beyond their fit of the hardness
    hardness = 2.84 * (1 - math.exp(-0.82 * (a / RADIUS)**-0.7))
    return force * (math.exp(-x**(5 / 12) / 4) * x**1.5 + 4 * hardness / c * (1 - math.exp(-x**(5 / 9) / 25)) * x)


def jackson_green_marghitu_e(e_star, speed):
    c = 1.295 * math.exp(0.736 * NU)
    critical = (math.pi / (2 * e_star))**2 * math.sqrt(8 * math.pi * RADIUS**3 / (15 * MASS)) * (c * YIELD)**2.5
    v, s = speed / critical, c * YIELD / e_star
    return 1 - 0.0361 * s**-0.114 * math.log(v) * (v - 1)**(9.5 * s) if v > 1 else 1.0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--mpm", required=True)
    parser.add_argument("-o", "--output", required=True, type=Path)
    words = parser.parse_args()
    run = lambda *what: subprocess.run([words.mpm, *map(str, what)], check=True, capture_output=True, text=True).stdout  # noqa: E731
    rows, curves = [], {}
    with tempfile.TemporaryDirectory() as folder:
        for stiffness in STIFFNESSES:
            e_star = stiffness * YIELD
            v_y = (math.pi / (2 * e_star))**2 * math.sqrt(2 / (5 * DENSITY)) * (1.6 * YIELD)**2.5
            materials, law = Path(folder, "m.toml"), Path(folder, "law.h5")
            materials.write_text(f'[material.m]\ndensity = {DENSITY}\nyoungs_modulus = {e_star * (1 - NU**2)}\npoisson_ratio = {NU}\n'
                                 f'yield_stress = {YIELD}\n[particle.p]\nmaterial = "m"\nradius = {RADIUS}\n')
            run("table", materials, "--pair", "m:wall", "--damage-number", 0, "--depth", 0.2, "-o", law)
            run("export", law, "--pair", "m:wall", "--effective-radius", RADIUS, "--points", 2000, "-o", Path(folder, "law.csv"))
            lines = [line for line in Path(folder, "law.csv").read_text().splitlines() if not line.startswith("#")]
            table = list(csv.DictReader(lines))
            overlap, force = (np.array([float(r[name]) for r in table]) for name in ("overlap_m", "force_N"))
            curves[stiffness] = (e_star, v_y, overlap, force)
            own = lambda d: float(np.interp((d * RADIUS)**0.25, overlap**0.25, force))  # noqa: E731
            for d in OVERLAPS[stiffness]:
                f = own(d)
                row = {"E*/Y": stiffness, "quantity": "force", "at": f"{d:g}", "law": f"{f / (YIELD * RADIUS**2):.5g}",
                       "Hertz": f"{4 / 3 * e_star * RADIUS**2 * d**1.5 / f:.3f}"}
                row |= {f"Thornton {k}": f"{float(Thornton(e_star, k).loading(np.array(d * RADIUS))) / f:.3f}" for k in FACTORS}
                row["rigid-plastic"] = f"{2 * math.pi * 3 * YIELD * RADIUS**2 * d / f:.3f}"
                row["Jackson-Green"] = f"{jackson_green_force(e_star, d * RADIUS) / f:.3f}" if stiffness >= FITTED else ""
                rows.append(row)
            for ratio in SPEEDS[stiffness]:
                speed = ratio * v_y
                ours = json.loads(run("law", law, "--pair", "m:wall", "--radius", RADIUS, "--velocity", speed, "--json"))
                formulas = {k: Thornton(e_star, k) for k in FACTORS}
                for quantity, key, place in (("e", "e", 0), ("largest force", "force_max_N", 1), ("contact time", "contact_time_s", 2)):
                    value = ours[key]
                    row = {"E*/Y": stiffness, "quantity": quantity, "at": f"{ratio:g}", "law": f"{value:.5g}"}
                    for k, formula in formulas.items():
                        elastic = 0.5 * MASS * speed**2 <= 0.4 * formula.onset_force * formula.onset
                        if elastic:
                            row[f"Thornton {k}"] = "1" if place == 0 else ""
                        else:
                            their = formula.impact(speed)[place]
                            row[f"Thornton {k}"] = f"{their:.4f}" if place == 0 else f"{their / value:.3f}"
                    if place == 0:
                        row["rigid-plastic"] = f"{rigid_plastic_e(e_star, speed):.4f}"
                        row["Jackson-Green"] = f"{jackson_green_marghitu_e(e_star, speed):.4f}" if stiffness >= FITTED else ""
                    rows.append(row)
    words.output.mkdir(parents=True, exist_ok=True)
    columns = ["E*/Y", "quantity", "at", "law", "Hertz", *(f"Thornton {k}" for k in FACTORS), "rigid-plastic", "Jackson-Green"]
    with (words.output / "formulas.csv").open("w") as file:
        file.write("# force: at = overlap/R, law = F/(Y R^2), formulas over the law. e: at = V/V_y, values. largest force, contact time: law in N and s, formulas over the law.\n")
        writer = csv.DictWriter(file, columns, lineterminator="\n", restval="")
        writer.writeheader()
        writer.writerows(rows)
    draw(words.output / "formulas.png", rows, curves)


def draw(path, rows, curves):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(2, 3, figsize=(13, 7.6))
    colours = {1.6: "tab:orange", 2.5: "tab:red", 2.8: "tab:purple"}
    for column, stiffness in enumerate(STIFFNESSES):
        e_star, v_y, overlap, force = curves[stiffness]
        axis = axes[0][column]
        d = np.linspace(1e-5, max(OVERLAPS[stiffness]), 400) * RADIUS
        unit = YIELD * RADIUS**2
        axis.plot(d / RADIUS, np.interp(d, overlap, force) / unit, color="tab:blue", lw=2, label="law")
        for k, colour in colours.items():
            axis.plot(d / RADIUS, Thornton(e_star, k).loading(d) / unit, color=colour, label=f"Thornton, {k} Y")
        if stiffness >= FITTED:
            axis.plot(d / RADIUS, [jackson_green_force(e_star, x) / unit for x in d], color="k", ls="--", label="Jackson and Green")
        axis.plot(d / RADIUS, 2 * math.pi * 3 * YIELD * RADIUS * d / unit, color="tab:gray", ls=":", label="rigid-plastic, 3 Y")
        axis.set_title(f"E*/Y = {stiffness}", fontsize=10)
        axis.set_xlabel("overlap/R")
        axis.set_ylabel("F/(Y R²)")
        axis = axes[1][column]
        own = [r for r in rows if r["E*/Y"] == stiffness and r["quantity"] == "e"]
        at = [float(r["at"]) for r in own]
        axis.plot(at, [float(r["law"]) for r in own], color="tab:blue", lw=2, marker="o", ms=4, label="law")
        for k, colour in colours.items():
            axis.plot(at, [float(r[f"Thornton {k}"]) for r in own], color=colour, label=f"Thornton, {k} Y")
        if stiffness >= FITTED:
            axis.plot(at, [float(r["Jackson-Green"]) for r in own], color="k", ls="--", label="Jackson, Green and Marghitu")
        axis.plot(at, [float(r["rigid-plastic"]) for r in own], color="tab:gray", ls=":", label="rigid-plastic, 3 Y")
        axis.set_xscale("log")
        axis.set_xlabel("V/V_y")
        axis.set_ylabel("e")
    for axis in axes.flat:
        axis.grid(True, alpha=0.2)
        axis.legend(fontsize=6)
    figure.tight_layout()
    figure.savefig(path, dpi=110)


if __name__ == "__main__":
    main()
