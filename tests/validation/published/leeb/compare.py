#!/usr/bin/python3
"""Rebound testers (Leeb) against the law: yield stress by the rebound over that by hardness or tensile strength.

    tests/validation/published/leeb/compare.py --mpm build/release/tools/mpm/mpm -o docs/evidence/published
    tests/validation/published/leeb/compare.py --mpm ... -o ... --direct     seven steels by the solver as well (5 CPU minutes)

Writes leeb.csv, and prints the table of docs/evidence/leeb.md. Nothing is tuned: E 210 GPa, nu 0.29, 7850 kg/m3.
"""
import argparse
import csv
import json
import math
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
STEEL = ["--density", "7850", "--youngs-modulus", "210e9", "--poisson-ratio", "0.29"]
BODY = {"D": (5.45e-3, 2.05, 1.5e-3), "C": (3.1e-3, 1.4, 1.5e-3), "G": (20e-3, 3.0, 2.5e-3)}  # kg, m/s, m, as mpm calibrate --leeb has
FALL = 2 * 9.81 * 1e-3         # m2/s2: the coil is 1 mm above the surface
STRAIN = 0.04                  # plastic, of the static flow stress
# case, HLD, strength and exponent of Swift's law (MPa), offset, Johnson and Cook's C: as the hardness and class of the steel ask
DIRECT = [("HB 249", 530, 1180, 0.10, 0.00316, 0.014), ("HB 388", 650, 1798, 0.08, 0.00566, 0.014), ("HB 570", 760, 2631, 0.05, 0.00995, 0.012),
          ("Rm 374", 350, 630, 0.20, 0.00070, 0.022), ("Rm 780", 522, 1205, 0.15, 0.00231, 0.022), ("Rm 844", 540, 1119, 0.08, 0.00338, 0.014),
          ("Rm 1875", 738, 2357, 0.06, 0.00843, 0.014)]
SOLID = """[material.wc]
density = 14900
youngs_modulus = 625e9
poisson_ratio = 0.22
[material.steel]
density = 7850
youngs_modulus = 210e9
poisson_ratio = 0.29
yield_stress = {}
{}
[particle.ball]
radius = 1.5e-3
material = "wc"
"""


def rows_of(name):
    with open(HERE / name) as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


class Tool:
    def __init__(self, mpm, folder):
        self.mpm, self.folder = mpm, Path(folder)

    def json(self, *words):
        run = subprocess.run([self.mpm, *words, "--json"], capture_output=True, text=True)
        if run.returncode:
            sys.exit(f"leeb: {' '.join(words)}: {run.stderr}")
        return json.loads(run.stdout)

    def yield_stress(self, column, value, *words):
        """Pa, and the answer, of one value of a kind of measurement."""
        data = self.folder / "data.csv"
        data.write_text(f"{column}\n{value}\n")
        answer = self.json("calibrate", str(data), *STEEL, "--radius", "1", "--fit", "yield_stress", *words)
        return answer["parameters"]["yield_stress"]["value"], answer

    def materials(self, yield_stress, more=""):
        path = self.folder / "steel.toml"
        path.write_text(SOLID.format(yield_stress, more))
        return str(path)

    def restitution(self, yield_stress, device, compliance=0):
        """e of the device on a perfectly plastic steel, by the law."""
        law = str(self.folder / "law.h5")
        subprocess.run([self.mpm, "table", self.materials(yield_stress), "--pair", "wc:steel", "-o", law], check=True, capture_output=True)
        mass, velocity, radius = BODY[device]
        more = ["--impact-body-compliance", str(compliance)] if compliance else []
        return self.json("law", law, "--pair", "wc:steel", "--radius", str(radius), "--radius2", "inf", "--velocity", str(velocity),
                         "--impact-body-mass", str(mass), *more)["e"]

    def direct(self, yield_stress, more, compliance=0):
        mass, velocity, _ = BODY["D"]
        body = ["--impact-body-compliance", str(compliance)] if compliance else []
        return self.json("impact", self.materials(yield_stress, more), "--particle", "ball", "--wall", "steel", "--velocity", str(velocity),
                         "--impact-body-mass", str(mass), "--resolution", "16", "--no-estimate", *body)["e"]


def at_surface(hl, velocity=2.05):
    return math.sqrt((hl / 1000) ** 2 * (velocity ** 2 - FALL) + FALL) / velocity


def flow_stress(row):
    """Pa, at STRAIN, of sigma = K strain^n whose tensile strength is given (Considere)."""
    n = float(row["exponent"])
    return 1e6 * float(row["Rm_MPa"]) * (math.e * STRAIN / n) ** n


def hardness_yield(tool, row):
    column = {"HB": "brinell_30_hardness_Pa", "HV": "hardness_Pa"}[row["scale"]]
    return tool.yield_stress(column, float(row["hardness"]) * 9.80665e6)[0]


def class_of(row):
    """Of the table: steels by ranges of Brinell hardness, or by name."""
    if row["set"] != "conversions":
        return row["set"]
    low = max(edge for edge in (0, 250, 350, 450, 550) if float(row["hardness"]) >= edge)
    return {0: "conversions, HB below 250", 550: "conversions, HB over 550"}.get(low, f"conversions, HB {low} to {low + 100}")


def compared(tool):
    """One dict a row: the set, what was given, e and yield stress measured and computed."""
    for name, given, static in [("hardness.csv", lambda r: f"{r['scale']} {r['hardness']}", lambda r: hardness_yield(tool, r)),
                                ("tensile.csv", lambda r: f"{r['class']}, Rm {r['Rm_MPa']} MPa", flow_stress)]:
        for row in rows_of(name):
            device = row.get("device", "D")
            rebound, answer = tool.yield_stress("leeb_hardness", row["HL"], "--leeb", device)
            y, flow = static(row), answer["static_flow_stress"]
            yield {"set": class_of(row), "device": device, "given": given(row), "HL": row["HL"], "static_Pa": f"{y:.4g}",
                   "e_measured": f"{at_surface(float(row['HL']), BODY[device][1]):.4f}", "e_law": f"{tool.restitution(y, device):.4f}",
                   "e_law_body_1e-9": f"{tool.restitution(y, device, 1e-9):.4f}", "rebound_Pa": f"{rebound:.4g}", "rebound_over_static": f"{rebound / y:.3f}",
                   "stated_Pa": f"{flow['value']:.4g}", "low95_Pa": f"{flow['low95']:.4g}", "high95_Pa": f"{flow['high95']:.4g}"}


def table(rows):
    print("| set | n | law - measured, e | with a body of 1e-9 m/N | rebound/static | static within the stated interval | within 15 % |\n|---|---|---|---|---|---|---|")
    for name in dict.fromkeys(r["set"] for r in rows):
        own = [{k: float(r[k]) for k in r if k not in ("set", "device", "given")} for r in rows if r["set"] == name]
        off = [r["e_law"] - r["e_measured"] for r in own]
        body = [r["e_law_body_1e-9"] - r["e_measured"] for r in own]
        ratio = [r["rebound_over_static"] for r in own]
        inside = sum(r["low95_Pa"] <= r["static_Pa"] <= r["high95_Pa"] for r in own)
        near = sum(abs(r["stated_Pa"] / r["static_Pa"] - 1) <= 0.15 for r in own)
        print(f"| {name} | {len(own)} | {statistics.mean(off):+.3f} ({min(off):+.3f} to {max(off):+.3f}) | {statistics.mean(body):+.3f} | "
              f"{statistics.mean(ratio):.3f} (sd {statistics.stdev(ratio):.3f}) | {inside} of {len(own)} | {near} |")


def devices(tool):
    print("\n| block | " + " | ".join(r["device"] for r in rows_of("devices.csv")) + " |\n|---|---|---|---|---|")
    for block in ("hard", "soft"):
        stresses = [tool.yield_stress("leeb_hardness", r[block], "--leeb", r["device"])[0] for r in rows_of("devices.csv")]
        print(f"| {block} | " + " | ".join(f"{y / 1e6:.0f} MPa" + (f" ({y / stresses[0] - 1:+.1%})" if y != stresses[0] else "") for y in stresses) + " |")


def direct(tool):
    print("\n| steel | measured | perfectly plastic | hardening | and rate | and a body of 1e-9 m/N | left |\n|---|---|---|---|---|---|---|")
    for case, hl, strength, exponent, offset, c in DIRECT:
        measured = at_surface(hl)
        y0 = strength * offset ** exponent
        flow = strength * (offset + STRAIN) ** exponent
        swift = f'hardening = {{law = "swift", strength = {strength}e6, exponent = {exponent}, offset = {offset}}}'
        rate = swift + f'\nrate = {{law = "johnson-cook", coefficient = {c}, reference_rate = 1e-3}}'
        es = [tool.direct(flow * 1e6, ""), tool.direct(y0 * 1e6, swift), tool.direct(y0 * 1e6, rate), tool.direct(y0 * 1e6, rate, 1e-9)]
        print(f"| {case} (n {exponent}, C {c}) | {measured:.3f} | " + " | ".join(f"{e:.3f}" for e in es) + f" | {measured - es[-1]:+.3f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--mpm", default="mpm")
    parser.add_argument("-o", "--output", required=True)
    parser.add_argument("--direct", action="store_true")
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        tool = Tool(asked.mpm, folder)
        rows = list(compared(tool))
        with open(Path(asked.output) / "leeb.csv", "w", newline="") as file:
            writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)
        table(rows)
        devices(tool)
        if asked.direct:
            direct(tool)


if __name__ == "__main__":
    main()
