#!/usr/bin/python3
"""Silo: discharge of the published benchmark's silo against Beverloo, on any number of ranks.

    run.py [-o out/silo] [--seeds 3] [--ranks 2] [--full] [--quick]

A seed is a random cloud, the same for every model. Writes report.md, silo.csv and silo.png."""
import json
import math
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common"))
import one_sentence  # noqa: E402, F401
import numpy as np  # noqa: E402
import pictures, readings, sweep  # noqa: E401, E402
from spread import write_tables  # noqa: E402

# The particle and the orifice are the benchmark's in every size, so the rate is too; fewer particles: a narrower cylinder.
RADIUS, ORIFICE, DENSITY, BULK = 2e-3, 0.030, 2500.0, 1500.0
SIZES = {"full": dict(particles=100000, cylinder=0.100, fill=0.6, flow=5.0),
         "usual": dict(particles=20000, cylinder=0.060, fill=0.25, flow=0.6),
         "quick": dict(particles=250, cylinder=0.036, fill=0.06, flow=0.08)}

def beverloo(bulk=BULK):
    """0.58 rho_b sqrt(g) (D - 1.4 d)^2.5, kg/s (Beverloo et al. 1961)."""
    return 0.58 * bulk * math.sqrt(9.81) * (2 * ORIFICE - 1.4 * 2 * RADIUS)**2.5

def measure(folder, scene):
    s = readings.series(folder)
    if readings.lost(folder) or s["atoms"][0] != scene["particles"]:
        raise SystemExit(f"{folder}: particles were lost")
    t, passed, n = s["time"], s["passed"], scene["particles"]
    found = {"discharged share": float(passed[-1] / n), "largest kinetic energy while filling, J":
             float(np.max(s["kinetic"][passed == 0]))}
    steady = (passed > 0.15 * n) & (passed < 0.6 * n)
    if np.sum(steady) > 2:
        rate = np.polyfit(t[steady], passed[steady] * scene["mass"] / n, 1)[0]
        found.update({"discharge rate, kg/s": float(rate), "rate / Beverloo": float(rate / beverloo())})
    if not folder.name.startswith("hertz"):
        found["dissipated in normal contacts, J"] = float(s["plastic"][-1])
    seconds = sum(loop[0] for loop in readings.loops(folder))
    found["million particle-steps a second"] = float(np.sum(s["atoms"][1:] * np.diff(t)) / scene["dt"] / seconds / 1e6)
    return found

def draw_rates(axis, rates):
    """Mean and standard error of each model; `rates`: {model: one for each seed}."""
    for place, (model, values) in enumerate(rates.items()):
        error = np.std(values, ddof=1) / math.sqrt(len(values)) if len(values) > 1 else 0
        if values:
            axis.errorbar(place, np.mean(values), error, fmt="o", capsize=4, color=pictures.colour(model))
    axis.axhline(1, color="k", lw=0.7, ls="--")
    axis.text(len(rates) - 0.55, 1.003, "Beverloo", fontsize=8, ha="right")
    axis.set(xlim=(-0.5, len(rates) - 0.5), ylabel="discharge rate / Beverloo's", title="± standard error over the seeds")
    axis.set_xticks(range(len(rates)), rates)

def main(argv=None):
    parser = sweep.options(__doc__, "out/silo", seeds=3)
    parser.add_argument("--full", action="store_true", help="the benchmark's own 100000 spheres")
    args = parser.parse_args(argv)
    size = SIZES["quick" if args.quick else "full" if args.full else "usual"]
    dt = 2.5e-6 * args.stretch
    out, law, tables, curves = pathlib.Path(args.out), sweep.make_law(args, HERE / "materials.toml"), {}, {}
    for seed in range(1, args.seeds + 1):
        folder = out / f"scene-{seed}"
        subprocess.run([sys.executable, str(HERE.parent / "hopper/make_scene.py"), "-o", str(folder), "--half-angle", "45",
                        "--particles", str(size["particles"]), "--radius", str(RADIUS), "--density", str(DENSITY),
                        "--orifice", str(ORIFICE), "--cylinder", str(size["cylinder"]), "--drop", "0.004", "--seed", str(seed)],
                       check=True, stdout=subprocess.DEVNULL)
        scene = {**json.loads((folder / "scene.json").read_text()), "dt": dt}
        for model in args.models:
            name = sweep.label(args, model)
            done = sweep.run(args, HERE / "in.silo", model, out / f"{name}-{seed}-ranks{args.ranks}",
                             [folder / "cloud.data", folder / "hopper.stl"], law,
                             {"scene": folder, "dt": dt, "fill": round(size["fill"] / dt), "flow": round(size["flow"] / dt),
                              "every": max(1, round(2.5e-3 / dt))})
            tables.setdefault(name, []).append(measure(done, scene))
            curves.setdefault(name, []).append(readings.series(done))
    samples = write_tables(out, "Silo", f"{size['particles']} spheres, {args.seeds} seeds, {args.ranks} ranks. Beverloo: {beverloo():.3f} kg/s at a bulk density "
                           f"of {BULK:g} kg/m3.", tables)
    figure, axes = pictures.panels(2, 4.5)
    for m, runs in curves.items():
        n = min(len(s["time"]) for s in runs)
        pictures.band(axes[0], runs[0]["time"][:n], [s["atoms"][:n] for s in runs], m)
    axes[0].set(xlabel="time, s", ylabel="particles in the silo")
    axes[0].legend()
    draw_rates(axes[1], {m: [row["rate / Beverloo"] for row in rows if "rate / Beverloo" in row] for m, rows in tables.items()})
    pictures.save(figure, out / "silo.png")
    return samples

if __name__ == "__main__":
    main()
