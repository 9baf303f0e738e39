#!/usr/bin/python3
"""Drop test: restitution against speed on a wall, in pairs and obliquely, under three contact laws.

    run.py [-o out/drop] [--seeds 5] [--quick]     # 5 seeds, about 10 s, and a minute of the solver
    run.py -o out/drop-stiff --material stiff --models mpm --stretch 10

A collision has no chance in it but the phase of its first touch in the time step: that is what the seeds vary.
Writes report.md, collisions.csv, drop.csv and drop.png."""
import csv
import json
import math
import os
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common"))
import one_sentence  # noqa: E402, F401
import numpy as np  # noqa: E402
import clouds, pictures, readings, sweep  # noqa: E401, E402
from spread import Sample, tabulate  # noqa: E402

RADIUS, DENSITY, NU, MU, E_HERTZ = 3e-3, 920.0, 0.3, 0.4, 0.55  # as contact.in and hopper/*.toml
# dt, s: about 70 steps in the shortest contact
MATERIALS = {"wax": dict(file="materials.toml", E=91e6, Y=1e6, dt=2e-6), "stiff": dict(file="stiff.toml", E=1820e6, Y=2e6, dt=6e-7)}
DEEPEST = 0.2  # stretched overlap/R*: only collisions below it are tried under --stretch
NORMAL_SPEED = 0.5  # m/s, of the oblique impacts

def collisions(quick):
    """[(kind, speed normal to the contact m/s, angle deg)]; rho V^2/Y <= 0.008, where the law's velocity axis serves."""
    speeds = np.geomspace(0.01, 3.0, 6 if quick else 25)
    angles = (10, 40, 60, 75) if quick else range(5, 85, 5)
    return [("wall", v, 0.0) for v in speeds] + [("pair", v, 0.0) for v in speeds] + \
           [("oblique", NORMAL_SPEED, float(a)) for a in angles]

def write_scene(folder, cases, dt, rng):
    """Each collision in a cell of its own; first touch 0.3 to 1.3 steps after the start."""
    os.makedirs(folder, exist_ok=True)
    centres, velocities, first = [], [], []
    side = math.ceil(math.sqrt(len(cases)))
    for k, (kind, speed, angle) in enumerate(cases):
        x, y = 10 * RADIUS * (k % side), 10 * RADIUS * (k // side)
        gap = rng.uniform(0.3, 1.3) * dt * speed
        first.append(len(centres) + 1)
        if kind == "pair":
            z = 30 * RADIUS
            centres += [(x, y, z - RADIUS - gap / 2), (x, y, z + RADIUS + gap / 2)]
            velocities += [(0, 0, speed / 2), (0, 0, -speed / 2)]
        else:
            centres.append((x, y, RADIUS + gap))
            velocities.append((speed * math.tan(math.radians(angle)), 0, -speed))
    wide = 10 * RADIUS * side
    clouds.write_data(folder / "collisions.data", centres, RADIUS, DENSITY, (-wide, -wide, -3 * RADIUS),
                      (2 * wide, 2 * wide, 60 * RADIUS), velocities)
    return first

def outcome(after, case, first):
    """{e, and for oblique impacts the tangential speed and the surface speed of the spin, m/s}."""
    kind, speed, angle = case
    i = first - 1
    if kind == "pair":
        return {"e": (after["vz"][i + 1] - after["vz"][i]) / speed}
    return {"e": after["vz"][i] / speed, "tangential": after["vx"][i], "spin": after["omegay"][i] * RADIUS}

def thornton_e(speed, material):
    """Thornton 1997, eq. 41, for the wall; a like pair at twice the speed is the same collision."""
    e_star = material["E"] / (1 - NU**2)
    v_y = (math.pi / (2 * e_star))**2 * math.sqrt(2 / (5 * DENSITY)) * (1.6 * material["Y"])**2.5
    x = v_y / speed
    return 1.0 if x >= 1 else (math.sqrt(6 * math.sqrt(3) / 5) * math.sqrt(1 - x * x / 6)
                               * (x / (x + 2 * math.sqrt(1.2 - 0.2 * x * x)))**0.25)

def collide(case, law, name):
    """One collision of the law itself, outside LIGGGHTS: what `mpm law` says."""
    kind, speed, _ = case
    pair = f"{name}:{name}" if kind == "pair" else f"{name}:wall"
    done = subprocess.run([sweep.program("mpm"), "law", law, "--pair", pair, "--radius", str(RADIUS), "--velocity",
                           repr(float(speed)), "--json"], check=True, capture_output=True, text=True)
    return json.loads(done.stdout)

def expected(model, case, law, args):
    """e by the model itself: `mpm law`, the closed form, the constant."""
    kind, speed, _ = case
    if model == "thornton":
        return thornton_e(speed / 2 if kind == "pair" else speed, MATERIALS[args.material])
    return E_HERTZ if model == "hertz" else collide(case, law, args.material)["e"]

def shallow(case, law, args):
    """True if the stretched overlap stays below DEEPEST."""
    radius = RADIUS / 2 if case[0] == "pair" else RADIUS
    return args.stretch == 1 or args.stretch * collide(case, law, args.material)["delta_max_m"] / radius < DEEPEST

def oblique_beside(quick):
    """{law: (angles, tangential speed kept)} of the oblique impacts by `mpm oblique`: `tangential plastic`, and the solver, in some minutes."""
    found = {}
    for law, angles in (("plastic", range(5, 85, 5)), ("solver", () if quick else (10, 25, 40, 55, 70))):
        found[law] = list(angles), [json.loads(subprocess.run(
            [sweep.program("mpm"), "oblique", HERE.parent / "hopper/materials.toml", "--particle", "pellet", "--velocity", str(NORMAL_SPEED), "--angle", str(angle),
             "--friction", str(MU), "--tangential", law, "--resolution", "8", "--json"], check=True, capture_output=True, text=True).stdout)["e_tangential"] for angle in angles]
    return found

def main(argv=None):
    parser = sweep.options(__doc__, "out/drop")
    parser.add_argument("--material", choices=list(MATERIALS), default="wax", help="default wax; stiff: E*/Y = 1000")
    args = parser.parse_args(argv)
    if args.stretch != 1 and args.models != ["mpm"]:
        parser.error("--stretch is of model mpm: give --models mpm")
    material, out = MATERIALS[args.material], pathlib.Path(args.out)
    law = sweep.make_law(args, HERE.parent / "hopper" / material["file"])
    cases = [case for case in collisions(args.quick) if shallow(case, law, args)]
    dt, steps = material["dt"] * args.stretch, 600
    rows = []
    samples = {}  # model -> case number -> {quantity: [a value for each seed]}
    for seed in range(1, args.seeds + 1):
        scene = out / f"scene-{seed}"
        first = write_scene(scene, cases, dt, np.random.default_rng(seed))
        for model in args.models:
            name = sweep.label(args, model)
            folder = sweep.run(args, HERE / "in.drop", model, out / f"{name}-{seed}", [scene / "collisions.data"], law,
                               {"scene": scene, "dt": dt, "steps": steps, "E": material["E"], "Y": material["Y"],
                                "material": args.material})
            after = readings.dump(folder)
            for k, case in enumerate(cases):
                for quantity, value in outcome(after, case, first[k]).items():
                    samples.setdefault(name, {}).setdefault(k, {}).setdefault(quantity, []).append(value)
    for name, by_case in samples.items():
        model = name.split("-")[0]
        for k, case in enumerate(cases):
            e, own = Sample(by_case[k]["e"]), expected(model, case, law, args)
            row = {"model": name, "kind": case[0], "normal_speed": case[1], "angle": case[2], "e": e.mean,
                   "e_deviation": e.deviation, "e_expected": own}
            if case[0] == "oblique":
                row.update({q: Sample(by_case[k][q]).mean for q in ("tangential", "spin")})
                # gross sliding: the impulse ratio is mu all along (rigid-body dynamics, no other input)
                row["slides"] = math.tan(math.radians(case[2])) > 3.5 * MU * (1 + e.mean)
                row["tangential_sliding"] = case[1] * (math.tan(math.radians(case[2])) - MU * (1 + e.mean))
                row["spin_sliding"] = 2.5 * MU * (1 + e.mean) * case[1]
            rows.append(row)
    names = ["model", "kind", "normal_speed", "angle", "e", "e_deviation", "e_expected", "tangential", "spin", "slides",
             "tangential_sliding", "spin_sliding"]
    with open(out / "collisions.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, names)
        writer.writeheader()
        writer.writerows(rows)
    tabulate(selection(samples, cases, args.seeds), out / "drop.csv")
    report(out, rows, args)
    return rows

def selection(samples, cases, seeds):
    """A few collisions of every model and seed that represent the rest, for the table over all examples."""
    wall = [k for k, c in enumerate(cases) if c[0] == "wall"]
    chosen = {}
    for target in (0.1, 0.3, 1.0, 3.0):
        k = min(wall, key=lambda k: abs(math.log(cases[k][1] / target)))
        chosen[f"e on the wall at {cases[k][1]:.3g} m/s"] = (k, "e", 1.0)
    oblique = [k for k, c in enumerate(cases) if c[0] == "oblique"]
    if oblique:
        k = min(oblique, key=lambda k: abs(cases[k][2] - 40))
        chosen[f"tangential speed kept at {cases[k][2]:g} degrees"] = (k, "tangential", cases[k][1] * math.tan(math.radians(cases[k][2])))
    return {m: [{name: by_case[k][quantity][seed] / unit for name, (k, quantity, unit) in chosen.items()} for seed in range(seeds)]
            for m, by_case in samples.items()}

def report(out, rows, args):
    models = list(dict.fromkeys(r["model"] for r in rows))
    lines = ["# Drop test", "", f"{args.seeds} seeds (phases of the first touch in the time step); largest deviations.", "",
             "| model | e in LIGGGHTS less e of the model, wall | pair | spread of e by phase | "
             "gross sliding: tangential speed | spin |", "|---|---|---|---|---|---|"]
    for m in models:
        mine = [r for r in rows if r["model"] == m]
        worst = {k: max((abs(r["e"] - r["e_expected"]) for r in mine if r["kind"] == k), default=math.nan) for k in ("wall", "pair")}
        slide = [r for r in mine if r.get("slides")]
        part = lambda q: max((abs(r[q] / r[q + "_sliding"] - 1) for r in slide), default=math.nan)
        spread = f"{max(r['e_deviation'] for r in mine):.1g}" if args.seeds > 1 else "one seed"
        lines.append(f"| {m} | {worst['wall']:.1g} | {worst['pair']:.1g} | {spread} | "
                     f"{100 * part('tangential'):.2g} % | {100 * part('spin'):.2g} % |")
    lines += ["", "| normal speed, m/s | " + " | ".join(f"{m}, wall | {m}, pair" for m in models) + " |",
              "|---|" + "---|---|" * len(models)]
    for v in sorted({r["normal_speed"] for r in rows if r["kind"] == "wall"}):
        cell = lambda m, k: next((f"{r['e']:.4f}" for r in rows if (r["model"], r["kind"], r["normal_speed"]) == (m, k, v)), "")
        lines.append(f"| {v:.4g} | " + " | ".join(f"{cell(m, 'wall')} | {cell(m, 'pair')}" for m in models) + " |")
    (out / "report.md").write_text("\n".join(lines) + "\n\n![drop](drop.png)\n")

    figure, axes = pictures.panels(3)
    beside = oblique_beside(args.quick) if args.material == "wax" and args.stretch == 1 else {"plastic": ([], []), "solver": ([], [])}
    for m in models:
        for ax, kind in zip(axes, ("wall", "pair")):
            mine = [r for r in rows if (r["model"], r["kind"]) == (m, kind)]
            x = [r["normal_speed"] for r in mine]
            ax.plot(x, [r["e"] for r in mine], "o", ms=3, color=pictures.colour(m), label=m)
            ax.plot(x, [r["e_expected"] for r in mine], "-", lw=0.8, color=pictures.colour(m))
            ax.set(xscale="log", xlabel="approach speed, m/s", ylabel="e", title={"wall": "on the wall", "pair": "two spheres"}[kind])
        mine = [r for r in rows if (r["model"], r["kind"]) == (m, "oblique")]
        axes[2].plot([r["angle"] for r in mine], [r["tangential"] / (NORMAL_SPEED * math.tan(math.radians(r["angle"])))
                                                  for r in mine], "o-", ms=3, lw=0.8, color=pictures.colour(m), label=m)
    axes[2].plot(*beside["plastic"], "--", lw=1.2, color=pictures.colour("mpm"), label="mpm, tangential plastic")
    axes[2].plot(*beside["solver"], "ko", ms=5, label="solver")
    axes[2].set(xlabel="impact angle from the normal, degrees", ylabel="tangential speed after / before", title=f"oblique on the wall, {NORMAL_SPEED} m/s normal")
    axes[2].legend(fontsize=7)
    axes[0].legend()
    pictures.save(figure, out / "drop.png")

if __name__ == "__main__":
    main()
