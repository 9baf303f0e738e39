#!/usr/bin/python3
"""Draws the pictures of docs/evidence/verification.md: pictures.py DATA_FOLDER PICTURE_FOLDER [NAME...]

DATA_FOLDER holds the CSV files of verification_data. Lines are what must hold (equations, references), points what
the solver computed. Prints the numbers that the page quotes.
"""
import argparse
import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

COLOURS = ["#0b5fa5", "#d1602a", "#3b8a3e", "#8a4fa3", "#8c6d1f", "#444444"]
plt.rcParams.update({"font.size": 9, "axes.grid": True, "grid.color": "0.9", "axes.axisbelow": True,
                     "axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False,
                     "lines.markersize": 4.5})


class Data:
    def __init__(self, folder):
        self.folder = pathlib.Path(folder)

    def __getitem__(self, name):
        path = self.folder / f"{name}.csv"
        if not path.exists():
            raise SystemExit(f"{path}: not found; verification_data {self.folder} writes it")
        return np.genfromtxt(path, delimiter=",", names=True, dtype=None, encoding="utf-8")


def panels(count, width=4.1, height=3.2):
    figure, axes = plt.subplots(1, count, figsize=(width * count, height), layout="constrained", squeeze=False)
    return figure, axes[0]


def order(cells, errors):
    """Order and its standard error, as fit_order in convergence.cpp."""
    (slope, _), covariance = np.polyfit(np.log(cells), np.log(np.abs(errors)), 1, cov="unscaled")
    x, y = np.log(cells), np.log(np.abs(errors))
    residual = np.sum((y - np.polyval(np.polyfit(x, y, 1), x)) ** 2)
    return -slope, np.sqrt(residual / (len(x) - 2) * covariance[0, 0])


def cells_axis(axes, ticks=(8, 12, 16, 24, 32)):
    axes.set(xscale="log", yscale="log", xlabel="cells across the contact block")
    axes.set_xticks(ticks, [str(t) for t in ticks])
    axes.minorticks_off()


def identities(data):
    d = data["identities"]
    figure, (a,) = panels(1, 6)
    for k, (name, text) in enumerate({"patch": "patch test: linear displacements, energy of every cell",
                                      "equilibrium": "uniform pressure: force left on inner nodes",
                                      "impulse": "impulse of the contact force = change of momentum",
                                      "mass": "mass of the sphere",
                                      "momentum": "sum of the internal forces"}.items()):
        a.plot(d["cells"], np.maximum(d[name], 1e-17), "o-", color=COLOURS[k], label=text, linewidth=0.8)
        print(f"  {name}: largest {d[name].max():.1e}")
    a.axhline(2.2e-16, color="black", linewidth=1)
    a.text(49, 2.6e-16, "one rounding", ha="right", fontsize=8)
    cells_axis(a, (6, 8, 12, 16, 24, 32, 48))
    a.set(ylabel="relative deviation", ylim=(5e-18, 1e-8))
    a.legend(fontsize=8, loc="upper left")
    return figure


def energy(data):
    d = data["energy"]
    figure, (a, b) = panels(2)
    layers = [d["kinetic"], d["elastic"], d["plastic"]]
    a.stackplot(d["time"], layers, labels=["kinetic", "elastic", "plastic (lost)"],
                colors=["#9ec3e0", "#f0c08e", "#b9665a"])
    a.axhline(1, color="black", linewidth=1)
    a.set(xlabel="time, R/c*", ylabel="share of the impact's energy", xlim=(0, d["time"][-1]), ylim=(0, 1.05))
    a.legend(loc="center right", frameon=True, fontsize=8)
    gap = sum(layers) - 1
    b.plot(d["time"], 100 * gap, ".", color=COLOURS[0], markersize=3)
    b.axhline(0, color="black", linewidth=1)
    b.set(xlabel="time, R/c*", ylabel="sum of the three, deviation from 1 (%)", xlim=(0, d["time"][-1]), ylim=(-0.1, 0.1))
    print(f"  largest gap {100 * np.abs(gap).max():.3f} %")
    return figure


def uniaxial(data):
    d = data["uniaxial"]
    figure, (a, b) = panels(2)
    rates = {"johnson-cook rate": ("Johnson–Cook", a), "cowper-symonds rate": ("Cowper–Symonds", a)}
    for k, law in enumerate(dict.fromkeys(d["law"][d["rate"] == 0])):
        s = d[d["law"] == law]
        a.plot(s["strain"], s["exact"] / 0.01, "-", color=COLOURS[k], linewidth=1)
        a.plot(s["strain"][::5], s["solver"][::5] / 0.01, "o", color=COLOURS[k], label=law, markersize=3)
        print(f"  {law}: largest deviation {np.abs(s['solver'] - s['exact']).max() / 0.01:.1e} Y")
    a.set(title="hardening laws", ylim=(0, 2.9))
    for k, law in enumerate(rates):
        for j, rate in enumerate(dict.fromkeys(d["rate"][d["law"] == law])):
            s = d[(d["law"] == law) & (d["rate"] == rate)]
            b.plot(s["strain"], s["exact"] / 0.01, "-", color=COLOURS[k], linewidth=1)
            b.plot(s["strain"][::5], s["solver"][::5] / 0.01, "os^"[j], color=COLOURS[k], markersize=3,
                   label=f"{rates[law][0]}, {rate:g} c*/R")
            print(f"  {law} {rate:g}: largest deviation {np.abs(s['solver'] - s['exact'])[1:].max() / 0.01:.1e} Y")
    b.set(title="rate laws (with Voce hardening)", ylim=(0, 5.3))
    for axes in (a, b):
        axes.set(xlabel="true strain (compression)", ylabel="true stress / Y", xlim=(0, 0.61))
    a.legend(fontsize=7.5, ncols=2, loc="lower right")
    b.legend(fontsize=7, ncols=2, loc="upper left", columnspacing=1)
    return figure


def pressure(data):
    d, centre = data["pressure"], data["pressure_centre"]
    figure, (a, b, c) = panels(3, 3.7)
    x = np.linspace(0, 1, 400)
    a.plot(x, np.sqrt(1 - x * x), color="black", linewidth=1, label="Hertz")
    chosen = d[(d["nu"] == 0.3) & (d["cells"] == 24) & (d["depth"] == 5e-4)]
    a.plot(chosen["r_over_a"], chosen["pressure"], "o", color=COLOURS[0], label="solver, δ = 0.0005 R", markersize=4)
    inside = chosen[chosen["r_over_a"] < 0.9]
    off = inside["pressure"] - inside["hertz"]
    print(f"  from Hertz at 5e-4 R, r < 0.9 a: rms {np.sqrt(np.mean(off**2)):.4f}, largest {np.abs(off).max():.4f}")
    a.set(xlabel="r/a", ylabel="pressure / p₀", title="ν = 0.3, 24 cells", xlim=(0, 1.4), ylim=(-0.03, 1.1))
    a.legend(loc="upper right")

    same = centre[centre["cells"] == 24]
    for k, nu in enumerate(dict.fromkeys(same["nu"])):
        s = same[same["nu"] == nu]
        line = np.linspace(0, 0.07, 2)
        b.plot(line, 200 / np.pi * (1 - 2 * nu) / (1 - nu) * line, color=COLOURS[k], linewidth=1)
        b.plot(s["a"], 100 * s["centre_excess"], "o", color=COLOURS[k], label=f"ν = {nu:g}")
        slope = np.polyfit(s["a"], s["centre_excess"], 1)[0]
        print(f"  nu {nu}: excess in the middle {slope:.3f} a/R, predicted {2 / np.pi * (1 - 2 * nu) / (1 - nu):.3f}")
    b.set(xlabel="a/R", ylabel="pressure in the middle / p₀ - 1 (%)", title="what Hertz neglects", xlim=(0, 0.07))
    b.legend(loc="upper left")

    series = d[(d["nu"] == 0.3) & (d["depth"] == 2e-3) & (d["r_over_a"] < 0.9)]
    cells = np.unique(series["cells"])
    rms = [np.sqrt(np.mean((s["pressure"] - s["moved_surface"]) ** 2))
           for s in (series[series["cells"] == n] for n in cells)]
    c.plot(cells, 100 * np.array(rms), "o", color=COLOURS[0])
    p, scatter = order(cells, rms)
    c.plot(cells, 100 * rms[4] * (cells[4] / cells) ** 2, color="black", linewidth=1, label="second order")
    print(f"  against the moved surface: {dict(zip(cells.tolist(), np.round(rms, 4).tolist()))}, order {p:.2f} +- {scatter:.2f}")
    cells_axis(c, (10, 14, 20, 28, 40))
    c.set(ylabel="rms deviation, % of p₀", title="δ = 0.002 R, moved surface")
    c.set_yticks([0.1, 0.2, 0.5, 1, 2], ["0.1", "0.2", "0.5", "1", "2"])
    c.legend()
    return figure


def onset(data):
    d, found, hits = data["axis"], data["onset"], data["impacts"]
    figure, (a, b, c) = panels(3, 3.7)
    for k, nu in enumerate(found["nu"]):
        s, o = d[d["nu"] == nu], found[k]
        a.plot(s["exact_von_mises"], -s["z_over_a"], "-", color=COLOURS[k], linewidth=1)
        a.plot(s["von_mises"], -s["z_over_a"], "o", color=COLOURS[k], markersize=2.8, label=f"ν = {nu:g}")
        a.plot(1 / o["exact_ratio"], -o["exact_depth"], "x", color="black", markersize=7)
        print(f"  nu {nu}: p0/Y {o['ratio']:.4f} ({o['exact_ratio']:.4f}, {100 * (o['ratio'] / o['exact_ratio'] - 1):+.2f} %), "
              f"depth {o['depth']:.3f} ({o['exact_depth']:.3f})")
    a.set(xlabel="von Mises stress on the axis / p₀", ylabel="depth z/a", ylim=(-2, 0), xlim=(0, 0.85))
    a.set_yticks([-2, -1.5, -1, -0.5, 0], ["2", "1.5", "1", "0.5", "0"])
    a.plot([], [], "x", color="black", label="largest, exact")
    a.legend(loc="lower right")
    fine = np.linspace(0, 0.48, 100)
    z = np.linspace(0.1, 1, 2000)[:, None]
    stress = 1 / (1 + z**2) * 1.5 - (1 + fine) * (1 - z * np.arctan(1 / z))
    b.plot(fine, 1 / stress.max(axis=0), color="black", linewidth=1, label="Hertz's field, exact")
    b.plot(found["nu"], found["ratio"], "o", color=COLOURS[0], label="solver (elastic press)")
    b.set(xlabel="Poisson's ratio", ylabel="p₀/Y at the onset of yield", xlim=(-0.02, 0.5))
    b.legend(loc="upper left")
    for k, nu in enumerate(found["nu"]):
        s = hits[hits["nu"] == nu]
        c.plot(s["v_over_onset"], 1e3 * s["largest_strain"], "o-", color=COLOURS[k], linewidth=0.8, label=f"ν = {nu:g}")
        above = s[s["largest_strain"] > 5e-5][:2]
        slope = (above["largest_strain"][1] - above["largest_strain"][0]) / (above["v_over_onset"][1] - above["v_over_onset"][0])
        print(f"  nu {nu}: impacts begin to yield at {above['v_over_onset'][0] - above['largest_strain'][0] / slope:.3f} of the "
              f"onset velocity, at depth {above['depth'][0]:.3f} a, {above['radius'][0]:.3f} a off the axis")
    c.axvline(1, color="black", linewidth=1)
    c.set(xlabel="impact velocity / exact onset velocity", ylabel="largest plastic strain left, 10⁻³")
    c.legend(loc="upper left")
    return figure


def convergence(data):
    d = data["convergence"]
    figure, (a, b, c) = panels(3, 3.7)
    plastic, elastic = d[d["job"] == "plastic"], d[d["job"] == "elastic"]
    pick = lambda s, phases: s[(s["phases"] == phases) & (s["cells"] < 36)]
    limit = plastic[plastic["phases"] == 8][0]
    one, four = pick(plastic, 1), pick(plastic, 4)
    a.plot(one["cells"], 100 * np.abs(one["e"] / limit["e"] - 1), "o", color="0.65", label="one grid", markerfacecolor="none")
    a.plot(four["cells"], 100 * four["spread"] / limit["e"], "s", color=COLOURS[1], label="spread of four shifted grids")
    a.plot(four["cells"], 100 * np.abs(four["e"] / limit["e"] - 1), "o", color=COLOURS[0], label="mean of the four")
    n = np.array([8, 32])
    a.plot(n, 2.6 * 8 / n, color="black", linewidth=1, label="first order")
    cells_axis(a)
    a.set(ylabel="deviation of e, %", title="e at V/V_y = 100", ylim=(0.01, 20))
    a.set_yticks([0.01, 0.1, 1, 10], ["0.01", "0.1", "1", "10"])
    a.legend(fontsize=7.5, loc="upper right")
    for name, values in (("spread of e", four["spread"]), ("one grid, e", one["e"] - limit["e"]), ("mean of four, e", four["e"] - limit["e"]),
                         ("mean of four, F", four["force"] - limit["force"]), ("one grid, F", one["force"] - limit["force"]), ("energy balance", four["energy_error"])):
        print("  plastic, %s: order %.2f +- %.2f; rms %.2e" % (name, *order(four["cells"], values), np.sqrt(np.mean(values**2))))

    b.plot(one["cells"], 100 * np.abs(one["force"] / limit["force"] - 1), "o", color="0.65", label="one grid", markerfacecolor="none")
    b.plot(four["cells"], 100 * np.abs(four["force"] / limit["force"] - 1), "o", color=COLOURS[0], label="mean of four, plastic")
    hertz = elastic[elastic["phases"] == 8][0]
    soft = pick(elastic, 4)
    b.plot(soft["cells"], 100 * np.abs(soft["force"] / hertz["force"] - 1), "^", color=COLOURS[2], label="mean of four, elastic")
    b.plot(n, 0.8 * (8 / n) ** 2, color="black", linewidth=1, label="second order")
    cells_axis(b)
    b.set(ylabel="deviation of the largest force, %", title="largest force", ylim=(1e-3, 20))
    b.set_yticks([0.001, 0.01, 0.1, 1, 10], ["0.001", "0.01", "0.1", "1", "10"])
    b.legend(fontsize=7.5, loc="upper right")
    print("  elastic, mean of four, F: order %.2f +- %.2f" % order(soft["cells"], soft["force"] - hertz["force"]))

    finest = plastic[plastic["cells"] == 64][0]
    off = np.abs(four["delta"] / finest["delta"] - 1)
    c.plot(four["cells"], 100 * off, "o", color=COLOURS[0], label="plastic")
    off_soft = np.abs(soft["delta"] / hertz["delta"] - 1)
    c.plot(soft["cells"], 100 * off_soft, "^", color=COLOURS[2], label="elastic")
    c.plot(n, 1.0 * (8 / n) ** 2, color="black", linewidth=1, label="second order")
    cells_axis(c)
    c.set(ylabel="deviation of the largest overlap, %", title="largest overlap", ylim=(0.005, 3))
    c.set_yticks([0.01, 0.1, 1], ["0.01", "0.1", "1"])
    c.legend(fontsize=7.5, loc="upper right")
    print("  overlap: plastic order %.2f +- %.2f, elastic %.2f +- %.2f" % (*order(four["cells"], off), *order(soft["cells"], off_soft)))
    at = lambda s, n: s[s["cells"] == n][0]
    for n in (8, 12, 16, 20, 24, 32):
        row = at(four, n)
        print(f"  {n} cells, four grids: e {100 * (row['e'] / limit['e'] - 1):+.3f} %, F {100 * (row['force'] / limit['force'] - 1):+.3f} %, "
              f"overlap {100 * (row['delta'] / finest['delta'] - 1):+.3f} %, spread {100 * row['spread'] / limit['e']:.2f} %")
    return figure


def step(data):
    swing, d = data["swing"], data["step"]
    figure, (free, a, b) = panels(3, 3.7)
    free.plot(swing["courant"], swing["swing"], "o", color=COLOURS[0], label="swing of the energy")
    free.plot(swing["courant"], swing["swing"][-1] * (swing["courant"] / swing["courant"][-1]) ** 2, color="black",
              linewidth=1, label="second order")
    free.set(xscale="log", yscale="log", xlabel="Courant number (limit 1)", ylabel="largest deviation of the energy",
             title="free vibration, 8 cells")
    free.set_xticks([0.1, 0.2, 0.4, 0.8], ["0.1", "0.2", "0.4", "0.8"])
    free.minorticks_off()
    free.legend()
    print(f"  swing {dict(zip(swing['courant'].tolist(), swing['swing'].tolist()))}")
    for axes, job, scale, text in ((a, "elastic", 1e6, "energy not accounted for, 10⁻⁶"),
                                   (b, "plastic", 1e4, "energy not accounted for, 10⁻⁴")):
        for k, cells in enumerate(np.unique(d["cells"])):
            s = d[(d["job"] == job) & (d["cells"] == cells)]
            axes.plot(s["courant"], scale * s["energy_error"], "o-", color=COLOURS[k], linewidth=0.8, label=f"{cells} cells")
            print(f"  {job}, {cells} cells: {dict(zip(s['courant'].tolist(), s['energy_error'].tolist()))}, e {s['e'].min():.6f} to {s['e'].max():.6f}")
        axes.set(xlabel="Courant number (limit 1)", ylabel=text, xlim=(0, 1), title=f"{job} impact")
        axes.set_ylim(0, 1.25 * axes.get_ylim()[1])
        axes.legend(fontsize=8, ncols=2, loc="upper left")
    return figure


def references(data):
    d = data["references"]
    figure, (a,) = panels(1, 7.4, 3.8)
    off = 100 * (d["solver"] / d["reference"] - 1)
    colours = {"force": COLOURS[0], "e": COLOURS[1], "residual": COLOURS[2], "impact e": COLOURS[3]}
    titles = {"force": "force, press", "e": "e, press", "residual": "residual overlap, press", "impact e": "e, free impact"}
    rows = {}
    for k, (case, quantity) in enumerate(zip(d["case"], d["quantity"])):
        y = rows.setdefault(case, len(rows))
        a.plot(off[k], -y, "o", color=colours[quantity], label=titles.pop(quantity, None))
        print(f"  {case}, {quantity}: {d['solver'][k]:.5g}, reference {d['reference'][k]:.5g}, {off[k]:+.2f} %")
    a.axvline(0, color="black", linewidth=1)
    a.axvspan(-0.5, 0.5, color="0.93", zorder=0)
    a.set_yticks([-y for y in rows.values()], list(rows), fontsize=8)
    a.set(xlabel="solver over reference, less one (%)", xlim=(-1.2, 1.2))
    a.legend(fontsize=8, loc="lower right", frameon=True)
    return figure


def main():
    pictures = {f.__name__: f for f in (identities, energy, uniaxial, pressure, onset, convergence, step, references)}
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("data")
    options.add_argument("pictures")
    options.add_argument("names", nargs="*", metavar="NAME", help=f"of {' '.join(pictures)}; all if none is named")
    options = options.parse_args()
    for name in options.names:
        if name not in pictures:
            options.error(f"no picture {name}; there are {' '.join(pictures)}")
    folder = pathlib.Path(options.pictures)
    folder.mkdir(parents=True, exist_ok=True)
    data = Data(options.data)
    for name in options.names or pictures:
        print(name)
        figure = pictures[name](data)
        figure.savefig(folder / f"{name}.png", dpi=100, metadata={"Software": None})
        plt.close(figure)


if __name__ == "__main__":
    main()
