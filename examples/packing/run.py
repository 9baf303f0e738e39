#!/usr/bin/python3
"""Packing: a cloud settles under gravity; decay of kinetic energy, packing fraction, coordination number.

    run.py [-o out/packing] [--seeds 5] [--quick]

A seed is a random cloud, the same for every model. Writes report.md, packing.csv and packing.png."""
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common"))
import one_sentence  # noqa: E402, F401
import numpy as np  # noqa: E402
import clouds, pictures, readings, sweep  # noqa: E401, E402
from spread import write_tables  # noqa: E402

RADIUS, DENSITY = 3e-3, 920.0  # as materials.toml


def cap(height, radius):
    """Volume of a sphere below a plane `height` over its centre."""
    h = np.clip(height + radius, 0, 2 * radius)
    return np.pi * h**2 * (radius - h / 3)


def solid_fraction(bed, side):
    """Mean over the middle of the bed, two diameters off floor and surface, spheres cut exactly; overlaps counted twice."""
    z, r = bed["z"], bed["radius"]
    low, high = 4 * RADIUS, np.percentile(z, 95) - 4 * RADIUS
    if high - low < 2 * RADIUS:
        raise SystemExit(f"the bed is {np.max(z):.4f} m high: too shallow for a solid fraction; take more particles")
    return float(np.sum(cap(high - z, r) - cap(low - z, r)) / (side**2 * (high - low)))


def measure(folder, side, particles):
    s, bed = readings.series(folder), readings.dump(folder)
    if readings.lost(folder) or s["atoms"][0] != particles:
        raise SystemExit(f"{folder}: particles were lost")
    kinetic = s["kinetic"] + s["rotational"]
    energy = kinetic + s["potential"]
    peak = int(np.argmax(kinetic))
    inside = (bed["z"] > 4 * RADIUS) & (bed["z"] < np.percentile(bed["z"], 95) - 4 * RADIUS)
    found = {"peak kinetic energy, J": kinetic[peak], "solid fraction": solid_fraction(bed, side),
             "coordination number, inside": float(np.mean(bed["c_touch"][inside])),
             "rattlers (fewer than 4 contacts), inside": float(np.mean(bed["c_touch"][inside] < 4)),
             "energy dissipated, J": energy[0] - energy[-1],
             "kinetic energy at the end / peak": kinetic[-1] / kinetic[peak]}
    for level in (1e-1, 1e-2, 1e-3, 1e-4, 1e-5):
        time = readings.decay(s["time"], kinetic, level)
        if time is not None:
            found[f"time from the peak to {level:g} of it, s"] = time
    if not folder.name.startswith("hertz"):
        found["of it in normal contacts"] = s["plastic"][-1] / found["energy dissipated, J"]
    return found


def main(argv=None):
    parser = sweep.options(__doc__, "out/packing")
    parser.add_argument("--particles", type=int)
    args = parser.parse_args(argv)
    particles = args.particles or (150 if args.quick else 2000)
    side = 2 * RADIUS * (4 if args.quick else 10)
    dt = 6e-6 * args.stretch
    steps = round((0.25 if args.quick else 0.5) / dt)
    out, law, tables, curves = pathlib.Path(args.out), sweep.make_law(args), {}, {}
    for seed in range(1, args.seeds + 1):
        scene = out / f"scene-{seed}"
        scene.mkdir(parents=True, exist_ok=True)
        top = RADIUS * 4 + particles * 4 / 3 * np.pi * RADIUS**3 / (0.25 * side**2)
        if not (scene / "cloud.data").exists() or f"\n{particles} atoms" not in (scene / "cloud.data").read_text():
            centres = clouds.random_cloud(particles, RADIUS, (0, 0, 3 * RADIUS), (side, side, top),
                                          np.random.default_rng(seed), (True, True, False))
            clouds.write_data(scene / "cloud.data", centres, RADIUS, DENSITY, (0, 0, -RADIUS), (side, side, top + 2 * RADIUS))
        for model in args.models:
            name = sweep.label(args, model)
            folder = sweep.run(args, HERE / "in.packing", model, out / f"{name}-{seed}", [scene / "cloud.data"], law,
                               {"scene": scene, "dt": dt, "steps": steps, "every": max(1, round(1.5e-3 / dt))})
            tables.setdefault(name, []).append(measure(folder, side, particles))
            curves.setdefault(name, []).append(readings.series(folder))
    samples = write_tables(out, "Packing", f"{particles} spheres, {args.seeds} seeds.", tables)
    figure, axes = pictures.panels(2)
    for m, runs in curves.items():
        n = min(len(s["time"]) for s in runs)
        pictures.band(axes[0], runs[0]["time"][:n], [(s["kinetic"] + s["rotational"])[:n] for s in runs], m, log=True)
        pictures.band(axes[1], runs[0]["time"][:n], [s["coordination"][:n] for s in runs], m)
    axes[0].set(xlabel="time, s", ylabel="kinetic energy, J")
    axes[1].set(xlabel="time, s", ylabel="coordination number, all particles")
    axes[0].legend()
    pictures.save(figure, out / "packing.png")
    return samples


if __name__ == "__main__":
    main()
