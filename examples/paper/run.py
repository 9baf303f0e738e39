#!/usr/bin/python3
"""A paper on the contact of spheres, computed again: F. Li, J. Pan, C. Sinka, Contact laws between solid particles, J. Mech.
Phys. Solids 57 (2009) 1194 to 1208.

    run.py [-o out/paper] [--quick]

Impacts and presses of one sphere by `mpm`, E*/Y = 100, nu = 0.3 unless a row says otherwise. Writes findings.csv (finding, quantity, case,
value) and paper.png. --quick: coarse grids and fewer cases, as the test runs it."""
import argparse
import csv
import json
import math
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common"))
import one_sentence  # noqa: E402, F401
import h5py  # noqa: E402
import numpy as np  # noqa: E402
from pictures import panels, save  # noqa: E402
from sweep import program  # noqa: E402

RADIUS, DENSITY, E_STAR = 1e-3, 1000.0, 1e9  # the material that a row does not name


def yield_velocity(e_star, y, density=DENSITY, factor=1.6):
    """Speed at which Hertz's largest pressure is factor Y."""
    return (math.pi / (2 * e_star))**2 * math.sqrt(2 / (5 * density)) * (factor * y)**2.5


class Laboratory:
    def __init__(self, out, quick):
        self.out, self.rows = out, []
        self.fine = ["--resolution", 10, "--shifted-grids", 2, "--no-estimate"] if quick else []
        self.coarse = ["--resolution", 6, "--no-estimate"] if quick else ["--no-estimate"]  # in three dimensions

    def note(self, finding, quantity, case, value):
        self.rows.append({"finding": finding, "quantity": quantity, "case": case, "value": f"{value:.5g}"})
        return value

    def mpm(self, *words):
        done = subprocess.run([program("mpm"), *map(str, words)], capture_output=True, text=True)
        if done.returncode:
            raise SystemExit(f"{' '.join(map(str, words))}: {done.stderr.strip()}")
        return done.stdout

    def body(self, name, e_over_y=100, nu=0.3, hardening=0.0, e_star=E_STAR, density=DENSITY, radius=RADIUS, more="", kind='material = "m"'):
        """A materials file with the particle p; e_over_y 0: elastic."""
        e = e_star * (1 - nu**2)
        lines = ["[material.m]", f"density = {density}", f"youngs_modulus = {e:.10g}", f"poisson_ratio = {nu}"]
        if e_over_y:
            lines.append(f"yield_stress = {e_star / e_over_y:.10g}")
        if hardening:
            lines.append(f'hardening = {{law = "linear", modulus = {hardening * e:.10g}}}')
        path = self.out / f"{name}.toml"
        path.write_text("\n".join(lines) + f"\n{more}\n[particle.p]\n{kind}\n" + (f"radius = {radius}\n" if radius else ""))
        return path

    def impact(self, body, speed, *words):
        return json.loads(self.mpm("impact", body, "--particle", "p", "--velocity", speed, "--json", *(words or self.fine)))

    def curve(self, body, name, *words):
        """Columns of a press's or an impact's trace, in R and E* R^2, loading and unloading."""
        trace = self.out / f"{name}.csv"
        self.mpm(*words[:1], body, "--particle", "p", *words[1:], *self.fine, "-o", trace)
        lines = [line for line in trace.read_text().splitlines() if not line.startswith("#")]
        rows = list(csv.DictReader(lines))
        return {key: np.array([float(r[key]) for r in rows]) for key in ("delta_m", "force_N", "contact_radius_m")}


def deepest(path):
    """Frame of the largest overlap of a field series: corners, displaced corners, cells, axial stress."""
    with h5py.File(path) as file:
        frames = sorted(n for n in file if n.startswith("frame"))
        k = max(frames, key=lambda n: file[n]["delta"][()])
        return {"start": file[frames[0]]["position"][:], "position": file[k]["position"][:], "cells": file["cells"][:],
                "stress": file[k]["axial_stress"][:], "delta": float(file[k]["delta"][()]), "force": float(file[k]["force"][()])}


def surface_pressure(f):
    """(r/R, pressure) of the cells with two nodes on the undeformed sphere's surface near the pole, now on the plane."""
    start = f["start"] / RADIUS
    on = (np.abs(np.hypot(start[:, 0], start[:, 1] - 1) - 1) < 1e-6)
    at = f["position"][:, 1] / RADIUS < 1e-6
    chosen = [(f["position"][c[on[c]]][:, 0].mean() / RADIUS, -s) for c, s in zip(f["cells"], f["stress"])
              if on[c].sum() == 2 and at[c[on[c]]].all()]
    return np.array(sorted(chosen))


def outline(f):
    start, now = f["start"] / RADIUS, f["position"] / RADIUS
    on = np.abs(np.hypot(start[:, 0], start[:, 1] - 1) - 1) < 1e-6
    order = np.argsort(start[on][:, 1])
    return now[on][order]


def profile_and_pressure(lab, axes, quick):
    """Figure 1: profile, pressure, force against overlap, elastic and plastic."""
    y = E_STAR / 100
    speed = 100 * yield_velocity(E_STAR, y)
    cases = [("elastic", 0, 5 * yield_velocity(E_STAR, y), "0.4"), ("E*/Y = 100", 100, speed, "tab:blue")]
    if not quick:
        cases.append(("E*/Y = 1000", 1000, 1000 * yield_velocity(E_STAR, E_STAR / 1000), "tab:orange"))
    for name, stiffness, v, colour in cases:
        y = E_STAR / (stiffness or 100)
        file = f"impact_{stiffness}"
        body = lab.body(file, stiffness)
        fields = lab.out / f"{file}.xdmf"
        trace = lab.curve(body, file, "impact", "--velocity", v, "--fields", fields)
        f = deepest(fields.with_suffix(".h5"))
        edge = outline(f)
        d = f["delta"] / RADIUS
        top = trace["delta_m"] > 0.97 * trace["delta_m"].max()
        widening = lab.note("profile", "a^2/(R delta)", f"{name}, delta/R = {d:.2g}", np.mean(trace["contact_radius_m"][top]**2 / trace["delta_m"][top]) / RADIUS)
        a = math.sqrt(widening * d)
        free = edge[(edge[:, 0] > a) & (edge[:, 1] < 0.5)]  # of the lower half
        sphere = 1 - d - np.sqrt(np.maximum(0, 1 - np.minimum(free[:, 0], 1)**2))  # the undeformed surface, moved down by delta
        near = free[:, 0] < 1.5 * a
        lab.note("profile", "sinking-in at r = 1.25 a, over delta", name, float(np.interp(1.25 * a, free[near, 0], (free[:, 1] - sphere)[near])) / d)
        axes[0].plot(edge[:, 0], edge[:, 1], color=colour, label=name)
        p = surface_pressure(f)
        p = p[p[:, 0] < a]
        scale = y if stiffness else 3 * f["force"] / RADIUS**2 / (2 * math.pi * a**2)
        axes[1].plot(p[:, 0] / a, p[:, 1] / scale, ".", color=colour, label=name + (", over Y" if stiffness else ", over Hertz's largest"))
        inner = p[:, 0] < 0.9 * a
        if not stiffness:
            s = np.linspace(0, 1, 100)
            axes[1].plot(s, np.sqrt(1 - s**2), color="k", lw=0.7, label="Hertz")
            off = p[inner, 1] / scale - np.sqrt(1 - (p[inner, 0] / a)**2)
            lab.note("pressure", "rms deviation from Hertz's pressure within 0.9 a, over the largest", name, np.sqrt(np.mean(off**2)))
        else:
            for low, high in ((0, 0.3), (0.3, 0.6), (0.6, 0.9)):
                some = (p[:, 0] >= low * a) & (p[:, 0] < high * a)
                lab.note("pressure", "mean pressure over Y", f"{name}, r/a {low:g} to {high:g}", p[some, 1].mean() / y)
        most = trace["delta_m"].max()
        hertz = 4 / 3 * E_STAR * RADIUS**2 * (most / RADIUS)**1.5
        lab.note("force", "largest force over Hertz's at the largest overlap", f"{name}, delta/R = {d:.2g}", trace["force_N"][top].mean() / hertz)
        axes[2].plot(trace["delta_m"] / most, trace["force_N"] / hertz, color=colour, lw=1, label=name)
    x = np.linspace(0, 1, 100)
    axes[2].plot(x, x**1.5, color="k", lw=0.7, ls=":", label="Hertz")
    axes[0].set(xlim=(0, 0.7), ylim=(0, 0.4), aspect="equal", xlabel="r/R", ylabel="z/R", title="profile")
    axes[1].set(xlabel="r/a", ylabel="pressure", title="contact pressure", xlim=(0, 1.05), ylim=(0, None))
    axes[2].set(xlabel="overlap over the largest", ylabel="F over Hertz's at the largest overlap", title="force")
    for axis in axes[:3]:
        axis.legend(fontsize=7)


def onset(lab):
    """Yield begins where Hertz's largest pressure reaches C(nu) Y; C = 1.613 at nu = 0.3."""
    exact = {0.0: 1.299, 0.3: 1.613, 0.45: 1.806}
    y = E_STAR / 100
    for nu, c in exact.items():
        body = lab.body(f"onset_{nu}", 100, nu)
        true = yield_velocity(E_STAR, y, factor=c)
        lab.note("onset", "onset velocity over V_y (1.6 Y)", f"nu = {nu:g}, Hertz", true / yield_velocity(E_STAR, y))
        for share in (0.95, 1.05):
            strain = lab.impact(body, share * true)["plastic_strain_max"]
            lab.note("onset", "plastic strain", f"nu = {nu:g}, {share:g} of the onset velocity", strain)


def collapse(lab, axis, quick):
    """e for one E*/Y and V/V_y but other stiffness, density and radius; e over V/V_y for some E*/Y; Poisson's ratio."""
    for name, e_star, density, radius in (("wax", 1e8, 920.0, 3e-3), ("steel-like", 2.2e11, 7800.0, 5e-4)):
        y = e_star / 100
        body = lab.body(name, 100, e_star=e_star, density=density, radius=radius)
        lab.note("collapse", "e at V/V_y = 100, E*/Y = 100", f"E* = {e_star:g} Pa, rho = {density:g} kg/m3, R = {radius:g} m",
                 lab.impact(body, 100 * yield_velocity(e_star, y, density))["e"])
    speeds = {30: (2, 5, 10, 20), 100: (2, 5, 20, 100), 1000: (5, 30, 100, 1000)}
    for stiffness, ratios in speeds.items():
        body, law = lab.body(f"law_{stiffness}", stiffness), lab.out / f"law_{stiffness}.h5"
        lab.mpm("table", body, "--pair", "m:wall", "-o", law)
        v_y = yield_velocity(E_STAR, E_STAR / stiffness)
        e = [json.loads(lab.mpm("law", law, "--pair", "m:wall", "--radius", RADIUS, "--velocity", v * v_y, "--json"))["e"] for v in ratios]
        for v, one in zip(ratios, e):
            lab.note("collapse", "e of the law", f"E*/Y = {stiffness}, V/V_y = {v}", one)
        axis.plot(ratios, e, "o-", ms=3, lw=1, label=f"E*/Y = {stiffness}")
    for nu in (0.0, 0.3, 0.45):
        body, law = lab.body(f"nu_{nu}", 100, nu), lab.out / f"nu_{nu}.h5"
        lab.mpm("table", body, "--pair", "m:wall", "-o", law)
        v = 100 * yield_velocity(E_STAR, E_STAR / 100)
        lab.note("collapse", "e of the law at V/V_y = 100, E*/Y = 100", f"nu = {nu:g}",
                 json.loads(lab.mpm("law", law, "--pair", "m:wall", "--radius", RADIUS, "--velocity", v, "--json"))["e"])
    axis.set(xscale="log", xlabel="V/V_y", ylabel="e", title="restitution")
    axis.legend(fontsize=7)
    grid = lab.body("updated", 100)
    v = 20 * yield_velocity(E_STAR, E_STAR / 100)
    lab.note("method", "e at V/V_y = 20", "mapped grid", lab.impact(grid, v)["e"])
    words = ["--grid", "updated", "--no-estimate", *(["--resolution", 8, "--shifted-grids", 1] if quick else [])]
    lab.note("method", "e at V/V_y = 20", "updated grid: moving points", lab.impact(grid, v, *words)["e"])


def hardening(lab):
    v = 100 * yield_velocity(E_STAR, E_STAR / 100)
    for h in (0.0, 0.01, 0.1):
        found = lab.impact(lab.body(f"hardening_{h}", 100, hardening=h), v)
        lab.note("hardening", "e at V/V_y = 100", f"H/E = {h:g}", found["e"])
        lab.note("hardening", "largest force/(Y R^2)", f"H/E = {h:g}", found["force_max_N"] / (E_STAR / 100 * RADIUS**2))


def heterogeneous(lab, quick):
    """A soft skin on a hard core; an ellipsoid hit at its pole and at its side beside spheres of the same curvature."""
    y, e = E_STAR / 100, E_STAR * 0.91
    v = 20 * yield_velocity(E_STAR, y)
    core = f"[material.core]\ndensity = {DENSITY}\nyoungs_modulus = {3 * e}\npoisson_ratio = 0.3\n"
    for thickness in (0.3, 0.1, 0.03):
        kind = f'material = "core"\nlayers = [{{material = "m", thickness = {thickness * RADIUS}}}]'
        found = lab.impact(lab.body(f"skin_{thickness}", 100, more=core, kind=kind), v)
        lab.note("layered", "e at V/V_y = 20 of the skin", f"elastic core of 3 E, skin of {thickness:g} R", found["e"])
    lab.note("layered", "e at V/V_y = 20 of the skin", "the skin's material alone", lab.impact(lab.body("skin_alone", 100), v)["e"])
    axes = (1e-3, 1e-3, 1.5e-3)
    shape = f'material = "m"\nshape = {{kind = "ellipsoid", axes = [{axes[0]}, {axes[1]}, {axes[2]}]}}'
    body = lab.body("ellipsoid", 100, radius=None, kind=shape)
    for name, direction in (("pole", "0,0,1"), ("side", "1,0,0")):
        found = lab.impact(body, v, *lab.coarse, "--orientation", direction)
        lab.note("irregular", "e at V/V_y = 20", f"ellipsoid 1 : 1 : 1.5, hit at its {name}", found["e"])
    ball = lab.body("ball", 100, radius=None, kind='material = "m"\nshape = {kind = "sphere", radius = 1e-3}')
    lab.note("irregular", "e at V/V_y = 20", "sphere, three dimensions",
             lab.impact(ball, v, *lab.coarse, "--orientation", "0,0,1")["e"])


def main(argv=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--out", type=pathlib.Path, default=pathlib.Path("out/paper"))
    parser.add_argument("--quick", action="store_true")
    words = parser.parse_args(argv)
    words.out.mkdir(parents=True, exist_ok=True)
    lab = Laboratory(words.out, words.quick)
    figure, axes = panels(4, 3.6, 3.2)
    profile_and_pressure(lab, axes, words.quick)
    onset(lab)
    collapse(lab, axes[3], words.quick)
    hardening(lab)
    heterogeneous(lab, words.quick)
    save(figure, words.out / "paper.png")
    with (words.out / "findings.csv").open("w") as file:
        writer = csv.DictWriter(file, list(lab.rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(lab.rows)
    for row in lab.rows:
        print("  ".join(row.values()))
    return lab.rows


if __name__ == "__main__":
    main()
