"""The table of mpm_core/calibrate/kind/hardness_table.hpp from the indentations of granulaw_hardness_study.

    hardness_table.py docs/evidence/hardness.csv -o mpm_core/calibrate/kind/hardness_table.hpp
    prints the checks of docs/evidence/hardness.md as well
"""
import argparse
import csv
from math import log, pi, radians, sin, tan

import numpy as np

PROJECTED = sin(radians(68))  # of the pyramid's sloping area
FRICTION = 0.15
OF_TABLE = FRICTION, 0.3, 12  # friction, Poisson's ratio and cells of the pyramids that the table is of
STIFFNESSES = 15, 25, 45, 80, 150, 300, 700, 2000
EXPONENTS = 0.1, 0.25, 0.5  # of the table: no metal is known not to harden
PLACES = 0.25, 0.4, 0.55  # of the ball: a/R


def read(path):
    with open(path) as file:
        return [{k: v if k == "indenter" else float(v) for k, v in row.items()} for row in csv.DictReader(file)]


def vickers(rows):
    """{(exponent, stiffness): hardness over flow stress} by a smooth surface through the pyramids, and their residuals: force and depth are smooth from
    one material to the next, the place of the corner is read off markers."""
    own = [r for r in rows if r["indenter"] == "pyramid" and (r["friction"], r["poisson_ratio"], r["cells"]) == OF_TABLE]
    terms = lambda r: [log(r["stiffness"] / 150)**k * r["exponent"]**m for k, m in ((0, 0), (1, 0), (2, 0), (3, 0), (0, 1), (1, 1), (2, 1), (0, 2))]
    matrix, found = np.array([terms(r) for r in own]), np.log([PROJECTED * r["pressure"] for r in own])
    surface = np.linalg.lstsq(matrix, found, rcond=None)[0]
    at = lambda n, k: np.exp(np.dot(surface, terms({"stiffness": k, "exponent": n})))
    return {(n, k): at(n, k) for n in EXPONENTS for k in STIFFNESSES}, matrix @ surface - found


def brinell(rows):
    """{place: {exponent: pressures over flow stress at STIFFNESSES}} by parabolas over a/R, and their residuals."""
    own = [r for r in rows if r["indenter"] == "ball"]
    stiffnesses = sorted({r["stiffness"] for r in own})
    found, residuals = {u: {} for u in PLACES}, []
    for n in sorted({r["exponent"] for r in own}):
        along = {u: [] for u in PLACES}
        for k in stiffnesses:
            places, pressures = zip(*((r["place"], r["pressure"]) for r in own if (r["stiffness"], r["exponent"]) == (k, n)))
            parabola = np.polyfit(places, np.log(pressures), 2)
            residuals += list(np.polyval(parabola, places) - np.log(pressures))
            for u in PLACES:
                # the stiffness is over the flow stress at 0.2 a/R, not at 8 %
                along[u].append((-log(flow(k, n, 0.2 * u)), np.polyval(parabola, u)))
        for u in PLACES:
            found[u][n] = np.exp(np.interp(np.log(stiffnesses), *zip(*along[u])))
    return stiffnesses, found, residuals


def flow(stiffness, n, strain):
    """Flow stress of the study's power law, E* = 1, nu = 0.3."""
    e, low, high = 0.91, 1e-12, 1 / stiffness
    for _ in range(200):
        y = (low * high) ** 0.5
        low, high = (y, high) if y * (1 + e * 0.08 / y) ** n < 1 / stiffness else (low, y)
    return low * (1 + e * strain / low) ** n if n else 1 / stiffness


def table(exponents, values):
    return "{{" + ",\n      ".join("{" + ", ".join(f"{v:.3f}" for v in values[n]) + "}" for n in exponents) + "}}"


def logarithms(values):
    return f"{{{', '.join(f'{log(v):.4f}' for v in values)}}},  // ln of {', '.join(f'{v:g}' for v in values)}"


def header(of_pyramid, of_ball):
    ball_stiffnesses, planes, _ = of_ball
    pyramid = {n: [of_pyramid[n, k] for k in STIFFNESSES] for n in EXPONENTS}
    exponents = "{" + ", ".join(f"{n:g}" for n in EXPONENTS) + "}"
    balls = ",\n     ".join(table(EXPONENTS, planes[u]) for u in PLACES)
    return f"""#pragma once

#include <array>
#include <cstddef>

namespace granulaw {{

// Made by tests/validation/hardness_table.py from indentations by the solver (docs/evidence/hardness.md).

/// Over the logarithmic slope of the flow curve and the logarithm of the stiffness, E* over the flow stress.
template <std::size_t Exponents, std::size_t Stiffnesses, std::size_t Places = 1>
struct HardnessTable
{{
  std::array<double, Exponents> exponents;
  std::array<double, Stiffnesses> log_stiffnesses;
  std::array<double, Places> places;  ///< a/R of a ball
  std::array<std::array<std::array<double, Stiffnesses>, Exponents>, Places> values;
}};

/// Vickers hardness over the flow stress at 8 %; friction {FRICTION}.
inline constexpr HardnessTable<{len(EXPONENTS)}, {len(STIFFNESSES)}> vickers_table{{
    {exponents},
    {logarithms(STIFFNESSES)}
    {{0}},
    {{{{{table(EXPONENTS, pyramid)}}}}}}};

/// Mean pressure under a ball over the flow stress at 0.2 a/R; no friction.
inline constexpr HardnessTable<{len(EXPONENTS)}, {len(ball_stiffnesses)}, {len(PLACES)}> brinell_table{{
    {exponents},
    {logarithms(ball_stiffnesses)}
    {{{', '.join(f'{u:g}' for u in PLACES)}}},
    {{{{{balls}}}}}}};

}}  // namespace granulaw
"""


def sneddon(rows):
    """Elastic cones over Sneddon's force with the factor of Hay, Bolshakov and Pharr (J. Mater. Res. 14, 1999)."""
    for r in rows:
        if r["indenter"] != "cone" or r["stiffness"]:
            continue
        c, nu = 1 / tan(radians(r["angle"])), r["poisson_ratio"]
        s = c * (1 - 2 * nu) / (4 * (1 - nu))
        gamma = pi * (pi / 4 + 0.15483073 * s) / (pi / 2 - 0.83119312 * s) ** 2
        print(f"elastic cone {r['angle']:g} degrees, nu {nu:g}: {r['pressure']:.4f} of Sneddon, {r['pressure'] / gamma:.4f} with Hay's factor {gamma:.4f}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("rows")
    parser.add_argument("-o", "--output")
    given = parser.parse_args()
    rows = read(given.rows)
    sneddon(rows)
    of_pyramid, residuals = vickers(rows)
    print(f"pyramid: residuals of {len(residuals)} about the surface {100 * residuals.std():.1f} %, largest {100 * np.abs(residuals).max():.1f} %")
    key = lambda r: (r["friction"], r["poisson_ratio"], r["cells"])
    for r in rows:
        if r["indenter"] == "pyramid" and key(r) != OF_TABLE:
            of = next(t for t in rows if t["indenter"] == "pyramid" and key(t) == OF_TABLE and (t["exponent"], t["stiffness"]) == (r["exponent"], r["stiffness"]))
            force, corner = r["pressure"] * r["spread"]**2 / (of["pressure"] * of["spread"]**2), r["spread"] / of["spread"]
            print(f"pyramid {r['exponent']:g} {r['stiffness']:g}: friction {r['friction']:g}, nu {r['poisson_ratio']:g}, {r['cells']:g} cells: "
                  f"force {100 * (force - 1):+.1f} %, corner {100 * (corner - 1):+.1f} % of the table's row")
    for n in EXPONENTS:
        print(f"Vickers {n:g}: " + ", ".join(f"{k:g}: {of_pyramid[n, k]:.3f}" for k in STIFFNESSES))
    of_ball = brinell(rows)
    residuals = 100 * np.array(of_ball[2])
    print(f"ball: residuals of {len(residuals)} places about parabolas {residuals.std():.1f} %, largest {np.abs(residuals).max():.1f} %")
    for u in PLACES:
        for k, at in enumerate(of_ball[0]):
            print(f"ball a/R {u:g}, {at:g}: " + ", ".join(f"{n:g}: {v[k]:.3f}" for n, v in of_ball[1][u].items()))
    if given.output:
        with open(given.output, "w") as file:
            file.write(header(of_pyramid, of_ball))


main()
