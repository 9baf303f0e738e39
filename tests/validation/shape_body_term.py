#!/usr/bin/python3
"""Does the body behind the contact explain what a sphere's law is wrong by in e?

    shape_body_term.py MATERIALS.toml PARTICLE CERTIFICATE.csv      the last from mpm shape ... -o CERTIFICATE.csv

Far from its contact a sphere of radius R is stiffer than a half-space: its centre comes nearer by k F/(E* R) less, k = 0.45
(docs/evidence/solver-accuracy.md, two bodies). That holds for the law's sphere, of the local radius R = sqrt(R' R''). In a body
whose centre is the height L above the wall it is k F/(E* L), so the body stores

    dW = k F^2/(2 E*) (1/R - 1/L)

more than the law's sphere, and gives it back: e^2 becomes e^2 + (1 - e^2) dW/W, W the energy of the mass that resists.
The table has e of the law, what the solver finds beyond it, what dW predicts, and what is left. For ellipsoids and superquadrics
of one material.
"""
import csv
import math
import sys
import tomllib

K = 0.45


def beta(x, y):
    return math.gamma(x) * math.gamma(y) / math.gamma(x + y)


def norm(x, y, n):
    return (x**n + y**n) ** (1 / n)


def body(shape):
    """Volume, and the height of the centre above a wall in a direction; an ellipsoid is a superquadric of exponents 2."""
    a, b, c = shape["axes"]
    n1, n2 = shape.get("exponents", (2, 2))
    e1, e2 = 2 / n1, 2 / n2
    volume = 2 * a * b * c * e1 * e2 * beta(e1 / 2, e1 + 1) * beta(e2 / 2, e2 / 2 + 1)
    m1, m2 = n1 / (n1 - 1), n2 / (n2 - 1)  # of the dual norm
    return volume, lambda x, y, z: norm(norm(abs(a * x), abs(b * y), m2), abs(c * z), m1)


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    with open(sys.argv[1], "rb") as file:
        declared = tomllib.load(file)
    particle = declared["particle"][sys.argv[2]]
    if particle.get("shape", {}).get("kind") not in ("ellipsoid", "superquadric"):
        sys.exit(f"shape_body_term.py: '{sys.argv[2]}' is no ellipsoid and no superquadric")
    material = declared["material"][particle["material"]]
    e_star = material["youngs_modulus"] / (1 - material["poisson_ratio"] ** 2)
    volume, height = body(particle["shape"])
    with open(sys.argv[3]) as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    print("   direction          R mm   L mm    e of the law   solver   predicted   left")
    found, left = [], []
    for row in rows:
        if row["contact"] != "curved":
            continue
        direction = [float(row[f"direction_{axis}"]) for axis in "xyz"]
        radius, centre = math.sqrt(float(row["sharper_radius_m"]) * float(row["flatter_radius_m"])), height(*direction)
        energy = 0.5 * material["density"] * volume * float(row["effective_mass_share"]) * float(row["velocity_m_per_s"]) ** 2
        e, force = float(row["law_restitution"]), float(row["law_force_max_N"])
        share = K * force**2 / (2 * e_star) * (1 / radius - 1 / centre) / energy
        predicted = math.sqrt(max(0.0, e**2 + (1 - e**2) * share)) - e
        found.append(float(row["restitution"]) - e)
        left.append(found[-1] - predicted)
        print("%6.2f%6.2f%6.2f%8.2f%7.2f%13.3f%+12.3f%+11.3f%+9.3f" % (*direction, 1e3 * radius, 1e3 * centre, e, found[-1], predicted, left[-1]))
    rms = [math.sqrt(sum(x * x for x in values) / len(values)) for values in (found, left)]
    print(f"{len(found)} directions: e of the law off by {rms[0]:.3f} (rms), with the body behind the contact by {rms[1]:.3f}")


if __name__ == "__main__":
    main()
