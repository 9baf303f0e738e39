#!/usr/bin/python3
"""Pull-off force of elastic spheres under an attraction that falls linearly over a range, for docs/theory/adhesion.md.

    tests/validation/cohesive_zone.py TABOR [TABOR ...]

Half-space, R = E* = 1. Prints Tabor's number, the zone 1.46 w E*/sigma_0^2 over the contact radius at the pull-off force of Johnson, Kendall
and Roberts, and the pull-off force over 1.5 pi w R. Sneddon's transform P(t) of the pressure is (delta - t^2)/2 within the contact edge a, and
beyond it - int r sigma/sqrt(r^2 - t^2) dr over the zone a..c. The gap is 2/pi int_a^r (t^2 - delta + 2 P)/sqrt(r^2 - t^2) dt.
The stress sigma is linear by r^2 between nodes; it is continuous at a and ends at c.
"""
import sys

import numpy as np

POINT, WEIGHT = np.polynomial.legendre.leggauss(24)
POINT = 0.5 * (POINT + 1)


def within(a, c, strength, reach, nodes=40):
    """Stress at the end c of a zone that begins at a, and the force."""
    y = np.linspace(0, 1, nodes + 1)
    rho = a * a + (c * c - a * a) * 0.5 * y * (1 + y * (3 - 2 * y))

    def transform(t2):
        """- P(t) by the stress at the nodes."""
        t2 = np.asarray(t2)[:, None]
        low, high = (np.sqrt(np.maximum(r, t2) - t2) for r in (rho[None, :-1], rho[None, 1:]))
        of_one = high - low
        of_rho = (high**3 - low**3) / 3 + t2 * of_one
        rows = np.zeros((len(t2), nodes + 1))
        rows[:, :-1] += (rho[1:] * of_one - of_rho) / np.diff(rho)
        rows[:, 1:] += (of_rho - rho[:-1] * of_one) / np.diff(rho)
        return rows

    edge = transform([a * a])[0]
    gap, by_stress = np.zeros(nodes + 1), np.zeros((nodes + 1, nodes + 1))
    for k in range(1, nodes + 1):
        r, first = np.sqrt(rho[k]), np.arcsin(min(a / np.sqrt(rho[k]), 1))
        weight = (np.pi / 2 - first) * 3 * POINT * (1 - POINT) * WEIGHT
        t2 = (r * np.sin(first + (np.pi / 2 - first) * POINT**2 * (3 - 2 * POINT)))**2
        gap[k] = 2 / np.pi * weight @ (t2 - a * a)
        by_stress[k] = 4 / np.pi * (edge * weight.sum() - weight @ transform(t2))
    stress = np.linalg.solve(np.eye(nodes + 1) + strength / reach * by_stress, strength * (1 - gap / reach))
    inside = a * (a * a - 2 * edge @ stress) - a**3 / 3
    outside = (c - a) * WEIGHT @ transform((a + (c - a) * POINT)**2) @ stress
    return stress[-1], 2 * inside - 2 * outside


def force(a, strength, reach):
    low, step = a, 0.1 * reach / strength
    while within(a, low + step, strength, reach)[0] > 0:
        low, step = low + step, 1.3 * step
    high = low + step
    for _ in range(40):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if within(a, middle, strength, reach)[0] > 0 else (low, middle)
    return within(a, high, strength, reach)[1]


for tabor in map(float, sys.argv[1:]):
    work = 1e-6
    reach = (work * work)**(1 / 3) / tabor
    strength, usual = 2 * work / reach, (9 * np.pi * work / 8)**(1 / 3)
    low, high = 0.4 * usual, 1.1 * usual
    for _ in range(16):  # golden section
        first, second = low + 0.381966 * (high - low), high - 0.381966 * (high - low)
        low, high = (low, second) if force(first, strength, reach) < force(second, strength, reach) else (first, high)
    print(f"{tabor:g} {1.46 * work / strength**2 / usual:.4f} {-force(0.5 * (low + high), strength, reach) / (1.5 * np.pi * work):.4f}")
