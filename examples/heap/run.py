#!/usr/bin/python3
"""Heap: the pile that a falling stream makes on a plate; its angle, radius and height.

    run.py [-o out/heap] [--seeds 5] [--quick]

A seed is another random stream, the same for every model. Writes report.md, heap.csv and heap.png."""
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common"))
import one_sentence  # noqa: E402, F401
import numpy as np  # noqa: E402
import clouds, pictures, readings, sweep  # noqa: E401, E402
from spread import write_tables  # noqa: E402

RADIUS, DENSITY = 3e-3, 920.0  # as materials.toml


def base_layer(radius):
    """Centres of the glued layer: a hexagonal lattice in the plane z = 0, a disc of this radius (m)."""
    a, n = 2.02 * RADIUS, int(radius / RADIUS)
    points = [(a * (i + 0.5 * (j % 2)), a * j * 3**0.5 / 2, 0.0) for i in range(-n, n) for j in range(-n, n)]
    return np.array([p for p in points if np.hypot(p[0], p[1]) < radius])


def prime_after(n):
    while any(n % k == 0 for k in range(2, int(n**0.5) + 1)):
        n += 1
    return n


def surface(bed):
    """Profile (r, height) of the pile about its own axis: highest top in each ring and quadrant, mean of the quadrants."""
    x, y = bed["x"] - np.median(bed["x"]), bed["y"] - np.median(bed["y"])
    r, top = np.hypot(x, y), bed["z"] + bed["radius"]
    ring = (r / (1.5 * RADIUS)).astype(int)
    quadrant = (x > 0) * 2 + (y > 0)
    profile = []
    for k in range(1, ring.max() + 1):
        tops = [np.max(top[(ring == k) & (quadrant == q)], initial=0.0) for q in range(4)]
        profile.append((1.5 * RADIUS * (k + 0.5), np.mean(tops)))
    return np.array(profile), r


def pile(folder, glued, base):
    """Free spheres on the base, and how many rolled off it."""
    bed = readings.dump(folder)
    free = bed["id"] > glued
    on = free & (np.hypot(bed["x"], bed["y"]) < base) & (bed["z"] > 0)  # below the plate there is room as well
    return {name: column[on] for name, column in bed.items()}, int(np.sum(free)), int(np.sum(free & ~on))


def measure(folder, particles, glued, base):
    s, (bed, free, off) = readings.series(folder), pile(folder, glued, base)
    if free != particles:
        raise SystemExit(f"{folder}: {particles - free} of {particles} spheres are missing: not inserted, or lost")
    profile, r = surface(bed)
    radius = float(np.percentile(r, 90))
    slope = profile[(profile[:, 0] > 0.2 * radius) & (profile[:, 0] < 0.9 * radius)]
    angle = np.degrees(np.arctan(-np.polyfit(slope[:, 0], slope[:, 1], 1)[0]))
    found = {"angle, degrees": float(angle), "radius that holds 90 %, m": radius,
             "height, m": float(np.max(bed["z"] + bed["radius"])), "mean height of the spheres, m": float(np.mean(bed["z"])),
             "share that rolled off the plate": off / particles,
             "coordination number": float(np.mean(bed["c_touch"])),
             "kinetic energy at the end / largest": float((s["kinetic"] + s["rotational"])[-1] / np.max(s["kinetic"]))}
    if not folder.name.startswith("hertz"):
        found["dissipated in normal contacts, J"] = float(s["plastic"][-1])
    return found


def main(argv=None):
    parser = sweep.options(__doc__, "out/heap")
    parser.add_argument("--particles", type=int)
    args = parser.parse_args(argv)
    particles = args.particles or (150 if args.quick else 800)
    rate = 1000 if args.quick else 2000  # spheres a second
    base = 0.05 if args.quick else 0.10  # m, radius of the glued layer
    dt = 6e-6 * args.stretch
    steps = round((particles / rate + (0.25 if args.quick else 0.6)) / dt)
    out, law, tables, profiles = pathlib.Path(args.out), sweep.make_law(args), {}, {}
    scene = out / "scene"
    scene.mkdir(parents=True, exist_ok=True)
    layer = base_layer(base)
    clouds.write_data(scene / "base.data", layer, RADIUS, DENSITY, (-1.4 * base, -1.4 * base, -6 * RADIUS),
                      (1.4 * base, 1.4 * base, 0.16))
    for seed in range(1, args.seeds + 1):
        for model in args.models:
            name = sweep.label(args, model)
            folder = sweep.run(args, HERE / "in.heap", model, out / f"{name}-{seed}", [scene / "base.data"], law,
                               {"scene": scene, "trough": 1.35 * base, "particles": particles, "rate": rate, "dt": dt, "steps": steps,
                                "every": max(1, round(6e-3 / dt)), "seed": prime_after(100003 * seed)})
            tables.setdefault(name, []).append(measure(folder, particles, len(layer), base))
            profiles.setdefault(name, []).append(surface(pile(folder, len(layer), base)[0])[0])
    samples = write_tables(out, "Heap", f"{particles} spheres at {rate} a second, {args.seeds} seeds.", tables)
    figure, axes = pictures.panels(1, 6, 3)
    for m, runs in profiles.items():
        n = min(len(p) for p in runs)
        pictures.band(axes[0], 1e3 * runs[0][:n, 0], [1e3 * p[:n, 1] for p in runs], m)
    axes[0].set(xlabel="distance from the axis, mm", ylabel="height, mm")
    axes[0].legend()
    pictures.save(figure, out / "heap.png")
    return samples


if __name__ == "__main__":
    main()
