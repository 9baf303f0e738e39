#!/usr/bin/python3
"""Compression: uniaxial, in a frictionless die, to overlaps where pair laws end; and of a packing beside resolved spheres.

    run.py [-o out/compression] [--seeds 5] [--quick]

Writes report.md, compression.csv, packing.csv, compression.png and packing.png."""
import copy
import csv
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
CONFINED = "mpm, confinement on"
PACKING = HERE.parent / "benchmark" / "bed_30.txt"            # x y z R over R, in a periodic box
RESOLVED = np.array([(0.63, 0.0794), (0.68, 0.1772), (0.73, 0.2909), (0.78, 0.4077), (0.83, 0.5507), (0.88, 0.7321), (0.93, 1.0018),
                     (0.98, 1.4591)]).T  # solid fraction and stress over Y by mpm compact, 12 cells a diameter (docs/evidence/packings.md)
MODULUS, YIELD_STRESS, FIRST, LAST = 91e6 / (1 - 0.3**2), 1e6, 0.58, 1.005  # E* and Y of wax, Pa; solid fractions of the packing
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


def models_of(args):
    """Names in tables and pictures, their models, and what sweep.run has to know."""
    for model in args.models:
        yield sweep.label(args, model), model, {}, ""
    if "mpm" in args.models and args.stretch == 1:
        yield CONFINED, "mpm", {"map": "off"}, " confinement on"


def press_packing(args, out, law):
    """Solid fraction and stress over Y under each model, to full density."""
    rate, step = 1e-3 * np.sqrt(MODULUS / DENSITY) / RADIUS, (0.2 if args.quick else 0.05) * RADIUS / np.sqrt(MODULUS / DENSITY)
    places = np.loadtxt(PACKING)[:, :3]
    volume = len(places) * 4 / 3 * np.pi * RADIUS**3
    side = (volume / FIRST)**(1 / 3)
    clouds.write_data(out / "packing.data", places * RADIUS % side, RADIUS, DENSITY, (0, 0, 0), (side, side, side))
    steps = round((1 - (FIRST / LAST)**(1 / 3)) / rate / step)
    plain = copy.copy(args)
    plain.stretch = 1.0
    found = {}
    for name, model, words, more in models_of(plain):
        folder = sweep.run(plain, HERE / "in.packing", model, out / f"packing-{name.split(', ')[-1].replace(' ', '-')}", [out / "packing.data"], law,
                           {"scene": out, "dt": step, "rate": rate, "press": steps, "spheres": volume, **words}, "beyondRange continue" + more)
        found[name] = np.loadtxt(folder / "series.csv", delimiter=",", skiprows=1).T / [[1.0], [YIELD_STRESS]]
    with open(out / "packing.csv", "w") as file:
        file.write("# mean stress over the yield stress, over 0.01 of the solid fraction\n")
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["solid fraction", "resolved", *found])
        for at, stress in RESOLVED.T:
            table.writerow([at, stress] + [f"{curve[1][abs(curve[0] - at) <= 0.005].mean():.4g}" for curve in found.values()])
    return found


def draw_packing(found, out):
    pictures.COLOURS[CONFINED] = pictures.COLOURS["mpm"]
    figure, (ax,) = pictures.panels(1, 5, 3.6)
    window = np.ones(15) / 15
    for m, (filled, stress) in found.items():
        pictures.band(ax, np.convolve(filled, window, "valid"), [np.convolve(stress, window, "valid")], m, line="--" if m == CONFINED else "-")
    ax.plot(*RESOLVED, "ko", ms=4, label="resolved spheres (solver)")
    ax.set(xlabel="solid fraction", ylabel="mean stress / yield stress", ylim=(0, 1.25 * RESOLVED.max()))
    ax.legend(fontsize=8)
    pictures.save(figure, out / "packing.png")


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
    deep = sweep.make_law(args, words=("--depth", "0.5"), name="deep.h5")
    for seed in range(1, args.seeds + 1):
        scene = out / f"scene-{seed}"
        scene.mkdir(parents=True, exist_ok=True)
        centres = clouds.random_cloud(particles, RADIUS, (inner,) * 3, (side - inner, side - inner, top), np.random.default_rng(seed))
        edge = 0.2 * RADIUS
        clouds.write_data(scene / "cloud.data", centres, RADIUS, DENSITY, (-2 * RADIUS,) * 3,
                          (side + 2 * RADIUS, side + 2 * RADIUS, top + 4 * RADIUS))
        a, b, c, d = (np.array(p + (die["lid"],)) for p in ((-edge, -edge), (side + edge, -edge), (side + edge, side + edge), (-edge, side + edge)))
        write_stl(scene / "lid.stl", "lid", [(a, c, b), (a, d, c)])
        for name, model, words, more in models_of(args):
            folder = sweep.run(args, HERE / "in.compression", model, out / f"{name.split(', ')[-1].replace(' ', '-')}-{seed}",
                               [scene / "cloud.data", scene / "lid.stl"], deep if more else law,
                               {"scene": scene, "dt": dt, "side": side, "press": steps,
                                "speed": SPEED, "every": max(1, round(1e-3 / dt)),
                                **({"behind": "beyondRange continue"} if model == "mpm" else {}), **words}, "beyondRange continue" + more)
            found, curve = measure(folder, die)
            tables.setdefault(name, []).append(found)
            curves.setdefault(name, []).append(curve)
    samples = write_tables(out, "Compression", f"{particles} spheres, {args.seeds} seeds.", tables)
    pictures.COLOURS[CONFINED] = pictures.COLOURS["mpm"]
    figure, axes = pictures.panels(2)
    for m, runs in curves.items():
        grid, line = np.linspace(0.55, min(c["fraction"][-1] for c in runs), 200), "--" if m == CONFINED else "-"
        pictures.band(axes[0], grid, [np.interp(grid, c["fraction"], c["stress"]) / 1e6 for c in runs], m, line=line)
        pictures.band(axes[1], grid, [np.interp(grid, c["fraction"], c["overlap"]) for c in runs], m, line=line)
    axes[1].axhline(OVERLAP, color="black", lw=0.8, ls=":")
    axes[1].text(0.85, OVERLAP, "laws of one contact end here", ha="right", va="bottom", fontsize=9)
    axes[0].set(xlabel="volume of spheres / volume of die", ylabel="stress on the lid, MPa")
    axes[1].set(xlabel="volume of spheres / volume of die", ylabel="largest overlap of a sphere / R")
    axes[0].legend()
    pictures.save(figure, out / "compression.png")
    draw_packing(press_packing(args, out, deep), out)
    return samples


if __name__ == "__main__":
    main()
