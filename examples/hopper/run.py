#!/usr/bin/python3
"""Hopper: filling and discharge under each contact law with several seeds, and under stretched and softened laws.

    run.py [-o out/hopper] [--seeds 4] [--quick]
    run.py -o out/hopper-stiff --material stiff --models mpm --stretches 3 10 30 --softer 3 10 30

A seed is a random cloud, the same for every variant. `mpm-stretchS`: the law F(delta/S)/S, time step times S. `mpm-softerS`: what one does
without: Young's modulus over S^2.5, which makes Hertz's contact and so the time step S times longer; its law is computed anew. `mpm-decklaw`: a law for the range that `mpm plan` finds.
Writes report.md, hopper.csv and hopper.png after every seed."""
import json
import pathlib
import re
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common"))
sys.path.append(str(HERE))
import one_sentence  # noqa: E402, F401
import numpy as np  # noqa: E402
import measures, pictures, readings, sweep  # noqa: E401, E402
from runs import Run  # noqa: E402
from spread import markdown, tabulate  # noqa: E402

MATERIALS = {"wax": dict(file="materials.toml", E=91e6, Y=1e6, e=0.55, dt=6e-6),
             "stiff": dict(file="stiff.toml", E=1.82e9, Y=2e6, e=0.35, dt=1.8e-6)}  # dt: about 25 steps in the shortest contact
# Smaller than the demo's hopper, so that several seeds are cheap; the bed is 1.5 times as high as the orifice is wide.
# The stiff one falls less deep: overlaps that may be stretched 10 times.
SIZES = {"wax": dict(particles=500, orifice=0.015, cylinder=0.030, drop=0.06, packing=0.25, fill=0.32, flow=0.80),
         "stiff": dict(particles=400, orifice=0.015, cylinder=0.030, drop=0.012, packing=0.28, fill=0.24, flow=0.64),
         "quick": dict(particles=200, orifice=0.024, cylinder=0.050, drop=0.03, packing=0.25, fill=0.24, flow=0.39)}


class Variant:
    def __init__(self, model, stretch=1.0, softer=1.0, deck_law=False):
        self.model, self.stretch, self.softer, self.deck_law = model, stretch, softer, deck_law
        self.name = model + (f"-stretch{stretch:g}" if stretch != 1 else "") + (f"-softer{softer:g}" if softer != 1 else "") + \
            ("-decklaw" if deck_law else "")

    @property
    def gain(self):
        return self.stretch * self.softer


def soft_law(args, material, softer):
    """(law, material name) of the material with E over softer^2.5; where it yields only beyond what a law covers, it is elastic."""
    source = (HERE / material["file"]).read_text()
    path = pathlib.Path(args.out) / f"softer{softer:g}.toml"
    was, now = f"youngs_modulus = {material['E'] / 1e6:g}e6", f"youngs_modulus = {material['E'] / softer**2.5!r}"
    if was not in source:
        raise SystemExit(f"{material['file']}: no line `{was}`")
    path.write_text(source.replace(was, now))
    try:
        return sweep.make_law(args, path, name=f"softer{softer:g}.h5"), args.material
    except sweep.Refused as end:
        if not any(words in str(end) for words in ("yields too late", "a tenth of E*")):
            raise
        sweep.say(f"E over {softer:g}^2.5: {end}: taken as elastic")
        return None, "elastic"


def measure(folder, model, scene):
    run = Run(str(folder), model)
    if run.lost() or run.series["atoms"][0] != scene["particles"]:
        raise SystemExit(f"{folder}: particles were lost")
    f = measures.filling(run)
    density, rate = measures.bulk_density(run, scene), measures.discharge_rate(run, scene["mass"], np.random.default_rng(1))
    found = {}
    if rate:
        found["discharge rate, kg/s"] = rate.value
        if density:
            found["rate / Beverloo"] = rate.value / measures.beverloo(density, scene)
    if density:
        found["bulk density, kg/m3"] = density.value
    found.update({"coordination number": measures.coordination(run).value,
                  "bed height, m": measures.bed_height(run).value, "peak kinetic energy while filling, J": f["peak"],
                  "energy dissipated while filling, J": f["dissipated"]})
    kinetic, closed = run.series["kinetic"] + run.series["rotational"], int(np.sum(run.series["time"] <= run.opened + 0.5 * run.dt))
    decay = {level: readings.decay(run.series["time"], kinetic, level, closed) for level in (1e-1, 1e-2, 1e-3)}
    found.update({f"time from the peak to {level:g} of it, s": t for level, t in decay.items() if t is not None})
    if run.stats:
        found["plastic share while filling"] = f["plastic"] / f["dissipated"]
        for side in ("pair", "wall"):
            found[f"largest impact speed, {side}, m/s"] = run.stats[side]["impact_speed_max_m_per_s"]
            found[f"largest overlap/R*, {side}"] = run.stats[side]["overlap_over_radius_max"]
    found["left behind, share"] = run.series["atoms"][-1] / scene["particles"]
    found["CPU time, s"] = sweep.cpu(folder)
    return found


def variants(args):
    return [Variant(m) for m in args.models] + [Variant("mpm", stretch=s) for s in args.stretches] + \
           [Variant("mpm", softer=s) for s in args.softer] + [Variant("mpm", deck_law=True)] * args.deck_law


def main(argv=None):
    parser = sweep.options(__doc__, "out/hopper", seeds=4)
    parser.add_argument("--material", choices=list(MATERIALS), default="wax", help="default wax; stiff: E*/Y = 1000")
    parser.add_argument("--stretches", type=float, nargs="*", default=[], metavar="S")
    parser.add_argument("--softer", type=float, nargs="*", default=[], metavar="S")
    parser.add_argument("--deck-law", action="store_true", help="also a law of what this deck can reach: mpm table --deck")
    args = parser.parse_args(argv)
    if args.stretch != 1:
        args.stretches.append(args.stretch)
        args.stretch = 1.0
    material, size, out = MATERIALS[args.material], SIZES["quick" if args.quick else args.material], pathlib.Path(args.out)
    out.mkdir(parents=True, exist_ok=True)
    law = sweep.make_law(args, HERE / material["file"])
    laws = {v.name: soft_law(args, material, v.softer) for v in variants(args) if v.softer != 1}
    tables, samples, stopped = {}, {}, {}
    for seed in range(1, args.seeds + 1):
        folder = out / f"scene-{seed}"
        subprocess.run([sys.executable, str(HERE / "make_scene.py"), "-o", str(folder), "--particles", str(size["particles"]),
                        *[w for k in ("orifice", "cylinder", "drop", "packing") for w in (f"--{k}", str(size[k]))], "--seed", str(seed)],
                       check=True, stdout=subprocess.DEVNULL)
        scene = json.loads((folder / "scene.json").read_text())
        if args.deck_law:  # the clouds of all seeds are equally high
            words = ["--deck", str(HERE / "in.hopper"), "--var", "model", "mpm", "--var", "scene", str((out / "scene-1").resolve())]
            laws["mpm-decklaw"] = sweep.make_law(args, HERE / material["file"], words, "decklaw.h5"), args.material
        for v in variants(args):
            dt = material["dt"] * v.gain
            fill, every = 4 * round(size["fill"] / dt / 4), max(1, round(1.5e-3 / dt))
            file, name = laws.get(v.name, (law, args.material))
            if v.name in stopped:
                continue
            try:
                done = sweep.run(args, HERE / "in.hopper", v.model, out / f"{v.name}-{seed}", [folder / "cloud.data", folder / "hopper.stl"],
                                 file or law, {"scene": folder, "dt": dt, "fill": fill, "flow": round(size["flow"] / dt), "every": every,
                                               "pictures": fill // 4, "E": material["E"] / v.softer**2.5, "Y": material["Y"],
                                               "e": material["e"], "material": name},
                                 f"stretch {v.stretch:g}" if v.stretch != 1 else "")
            except sweep.Refused as end:  # overlaps beyond what a stretched law can mean, moduli that LIGGGHTS takes for a slip
                why = re.search(r"'stretch \S+' takes.*|youngsModulus >= .*?SI units", str(end))
                if not why:
                    raise
                stopped[v.name] = why.group()
                continue
            tables.setdefault(v.name, []).append(measure(done, v.model, scene))
        samples = report(out, args, size, tables, stopped)
    return samples


def report(out, args, size, tables, stopped):
    samples = tabulate(tables, out / "hopper.csv")
    seeds = len(next(iter(tables.values())))
    text = f"# Hopper\n\n{size['particles']} spheres of {args.material}, {seeds} seeds; ±: standard error.\n\n"
    steps = ", ".join(f"{v.name} {MATERIALS[args.material]['dt'] * v.gain:g}" for v in variants(args))
    text += f"Time steps, s: {steps}.\n\n"
    models = {m: s for m, s in samples.items() if m in sweep.MODELS}
    if len(models) > 1:
        text += markdown(models) + "\n"
    if len(models) < len(samples):
        changed = {m: s for m, s in samples.items() if m not in models or m == "mpm"}
        text += markdown(changed, "mpm") + "\n"
    text += "".join(f"{name} was stopped: {why}\n\n" for name, why in stopped.items())
    (out / "report.md").write_text(text + "![hopper](hopper.png)\n")
    picture(out, tables)
    return samples


def picture(out, tables):
    figure, axes = pictures.panels(2)
    for name, runs in tables.items():
        series = [readings.series(out / f"{name}-{k + 1}") for k in range(len(runs))]
        grid = np.linspace(0, min(s["time"][-1] for s in series), 400)
        pictures.band(axes[0], grid, [np.interp(grid, s["time"], s["kinetic"] + s["rotational"]) + 1e-12 for s in series], name, log=True)
        pictures.band(axes[1], grid, [np.interp(grid, s["time"], s["passed"]) for s in series], name)
    axes[0].set(xlabel="time, s", ylabel="kinetic energy, J", ylim=(1e-7, None))
    axes[1].set(xlabel="time, s", ylabel="particles passed")
    axes[0].legend(fontsize=7)
    pictures.save(figure, out / "hopper.png")


if __name__ == "__main__":
    main()
