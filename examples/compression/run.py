#!/usr/bin/python3
"""Compression: uniaxial, in a frictionless die, to overlaps where pair laws end.

    run.py [-o out/compression] [--seeds 5] [--quick]

Writes report.md, compression.csv and compression.png."""
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common"))
sys.path.append(str(HERE.parent / "hopper"))
import one_sentence  # noqa: E402, F401
import numpy as np  # noqa: E402
import clouds, pictures, readings, sweep  # noqa: E401, E402
from make_scene import write_stl  # noqa: E402
from spread import write_tables  # noqa: E402

RADIUS, DENSITY = 3e-3, 920.0  # as materials.toml
SPEED = 0.2                    # m/s of the lid: rho V^2/Y = 4e-5, far from inertia
FRACTIONS = (0.60, 0.65, 0.70, 0.75, 0.80)  # volume of the spheres / volume of the die, where stresses are read
OVERLAP = 0.1  # overlap of a sphere over R (half the overlap): beyond it no single pair law holds (docs/evidence/pairs.md)


def measure(folder, die):
    s = readings.series(folder)
    if readings.lost(folder):
        raise SystemExit(f"{folder}: particles were lost")
    height = die["lid"] - SPEED * s["time"]
    curve = {"fraction": die["volume"] / (die["side"]**2 * height), "stress": np.abs(s["force"]) / die["side"]**2,
             "overlap": s["pair_overlap"] / (2 * RADIUS), "beyond": s["beyond"]}
    found = {}
    for f in FRACTIONS:
        if curve["fraction"][-1] >= f:
            found[f"stress at solid fraction {f}, Pa"] = float(np.interp(f, curve["fraction"], curve["stress"]))
            found[f"largest overlap per sphere/R at {f}"] = float(np.interp(f, curve["fraction"], curve["overlap"]))
    pressed = curve["fraction"] > 0.5  # before: the fall
    for name, reached in (("overlap per sphere/R = 0.1", curve["overlap"] > OVERLAP), ("the end of the law's table", curve["beyond"] > 0)):
        where = np.flatnonzero(reached & pressed)
        if len(where):
            found[f"solid fraction at {name}"] = float(curve["fraction"][where[0]])
    return found, curve


def main(argv=None):
    parser = sweep.options(__doc__, "out/compression")
    parser.add_argument("--particles", type=int)
    args = parser.parse_args(argv)
    particles = args.particles or (60 if args.quick else 300)
    side = 2 * RADIUS * (3.5 if args.quick else 6)
    volume = particles * 4 / 3 * np.pi * RADIUS**3
    inner = 1.05 * RADIUS  # clear of the walls
    top = inner + 1.02**3 * volume / (0.27 * (side - 2 * inner)**2)  # of the cloud; it is at rest when the lid has come down to it
    low = volume / ((0.78 if args.quick else 0.85) * side**2)
    dt = 3e-6 * args.stretch
    die = {"side": side, "lid": top + RADIUS, "volume": volume}
    steps = round((die["lid"] - low) / SPEED / dt)
    out, law, tables, curves = pathlib.Path(args.out), sweep.make_law(args), {}, {}
    for seed in range(1, args.seeds + 1):
        scene = out / f"scene-{seed}"
        scene.mkdir(parents=True, exist_ok=True)
        centres = clouds.random_cloud(particles, RADIUS, (inner,) * 3, (side - inner, side - inner, top), np.random.default_rng(seed))
        edge = 0.2 * RADIUS
        clouds.write_data(scene / "cloud.data", centres, RADIUS, DENSITY, (-2 * RADIUS,) * 3,
                          (side + 2 * RADIUS, side + 2 * RADIUS, top + 4 * RADIUS))
        a, b, c, d = (np.array(p + (die["lid"],)) for p in ((-edge, -edge), (side + edge, -edge), (side + edge, side + edge), (-edge, side + edge)))
        write_stl(scene / "lid.stl", "lid", [(a, c, b), (a, d, c)])
        for model in args.models:
            name = sweep.label(args, model)
            folder = sweep.run(args, HERE / "in.compression", model, out / f"{name}-{seed}",
                               [scene / "cloud.data", scene / "lid.stl"], law,
                               {"scene": scene, "dt": dt, "side": side, "press": steps,
                                "speed": SPEED, "every": max(1, round(1e-3 / dt)),
                                **({"behind": "beyondRange continue"} if model == "mpm" else {})}, "beyondRange continue")
            found, curve = measure(folder, die)
            tables.setdefault(name, []).append(found)
            curves.setdefault(name, []).append(curve)
    samples = write_tables(out, "Compression", f"{particles} spheres, {args.seeds} seeds.", tables)
    figure, axes = pictures.panels(2)
    for m, runs in curves.items():
        grid = np.linspace(0.55, min(c["fraction"][-1] for c in runs), 200)
        pictures.band(axes[0], grid, [np.interp(grid, c["fraction"], c["stress"]) / 1e6 for c in runs], m)
        pictures.band(axes[1], grid, [np.interp(grid, c["fraction"], c["overlap"]) for c in runs], m)
    axes[1].axhline(OVERLAP, color="tab:red", lw=0.8)
    axes[0].set(xlabel="volume of spheres / volume of die", ylabel="stress, MPa")
    axes[1].set(xlabel="volume of spheres / volume of die", ylabel="largest flattening / R")
    axes[0].legend()
    pictures.save(figure, out / "compression.png")
    return samples


if __name__ == "__main__":
    main()
