#!/usr/bin/python3
"""Error of a corrected pair law, made at equal radii, at other radii: pair_law_radii.py MPM OUT.csv (in an empty folder).

The corrected law reproduces the two bodies at equal radii. At another ratio it gives the pair rule's value, times
the correction at equal radii and the same I of the one body. So two-body impacts and the rule's replays determine its
error = (rule/two bodies at the ratio)/(rule/two bodies at equal radii) - 1. Some five CPU minutes; the rows of
docs/evidence/pairs.md and of tests/unit/reduction_error_test.cpp are in pair_law_radii.csv.
"""
import json
import os
import subprocess
import sys

RATIOS = [1, 2, 0.5, 4, 0.25, 10, 0.1]  # partner's radius over the yielding body's
MATERIALS = {"soft": (1000, 1e9, 1.0989e7), "elastic": (1000, 1e9, None), "stiff": (5200, 1e10, None),
             "harder": (1000, 1e9, 1.64835e7)}  # density, E, Y; E*/Y = 100 of soft
MPM, OUT = os.path.abspath(sys.argv[1]), sys.argv[2]


def name(material, ratio):
    return f"{material}{ratio:g}".replace(".", "_")


def mpm(*words):
    done = subprocess.run([MPM, *map(str, words)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout) if "--json" in words else None


with open("radii.toml", "w") as file:
    for material, (density, modulus, strength) in MATERIALS.items():
        file.write(f"[material.{material}]\ndensity = {density}\nyoungs_modulus = {modulus}\npoisson_ratio = 0.3\n")
        if strength:
            file.write(f"yield_stress = {strength}\n")
        for ratio in RATIOS:
            file.write(f'[particle.{name(material, ratio)}]\nradius = {1e-3 * ratio}\nmaterial = "{material}"\n')
pairs = [word for partner in ("elastic", "harder", "stiff") for word in ("--pair", f"soft:{partner}")]
mpm("table", "radii.toml", *pairs, "-o", "radii.h5")
with open(OUT, "w") as out:
    print("inertia,partner,radius_ratio,velocity,e_rule,e_two_bodies,force_rule,force_two_bodies,solver_error", file=out)
    for inertia in (1e-4, 2.5e-3):
        for ratio in RATIOS:
            for partner in ("elastic", "harder", "stiff"):
                replay = ["law", "radii.h5", "--pair", f"soft:{partner}", "--radius", 1e-3, "--radius2", 1e-3 * ratio,
                          "--json", "--velocity"]
                velocity = (inertia / mpm(*replay, 1)["inertia"]) ** 0.5
                rule = mpm(*replay, velocity)
                two = mpm("impact", "radii.toml", "--particle", name("soft", 1), "--against", name(partner, ratio),
                          "--velocity", velocity, "--json")
                print(inertia, partner, ratio, velocity, rule["e"], two["e"], rule["force_max_N"], two["force_max_N"],
                      two["error_estimate"], sep=",", file=out, flush=True)
