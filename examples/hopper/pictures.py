"""Pictures of a hopper run: curves, and the particles cut open."""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import measures

COLOURS = {"hertz": "0.35", "thornton": "tab:orange", "mpm": "tab:blue"}  # of examples/common/pictures.py


def curves(runs, scene, path):
    figure, ((decay, mass), (rate, overlap)) = plt.subplots(2, 2, figsize=(9.5, 6.4))
    for model, run in runs.items():
        s, colour = run.series, COLOURS[model]
        closed = s["time"] <= run.opened
        decay.semilogy(s["time"][closed], (s["kinetic"] + s["rotational"])[closed], color=colour, label=model)
        mass.plot(s["time"] - run.opened, s["passed"] * scene["mass"] / scene["particles"], color=colour, label=model)
        rate.plot(*[v - (run.opened if k == 0 else 0) for k, v in enumerate(measures.discharge_windows(run, scene["mass"]))],
                  "o-", ms=3, color=colour, label=model)
        if run.stats:
            for side, style in (("pair", "-"), ("wall", "--")):
                h = run.stats[side]["largest_overlap_over_radius"]
                overlap.loglog(h["lower_edge"], np.maximum(h["count"], 0.5), style, color=colour, label=f"{model}, {side}")
    decay.set(xlabel="time, s", ylabel="kinetic energy, J", title="filling")
    mass.set(xlabel="time since opening, s", ylabel="mass discharged, kg", xlim=(0, None), title="discharge")
    rate.set(xlabel="time since opening, s", ylabel="rate, kg/s", ylim=(0, None), title="rate in windows")
    overlap.set(xlabel="largest overlap/R* of a contact", ylabel="contacts", title="overlaps (plug-in's contact statistics)", xlim=(1e-6, None))
    for axes in (decay, mass, rate, overlap):
        axes.grid(alpha=0.3)
        if axes.get_legend_handles_labels()[0]:
            axes.legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(path, dpi=90)
    plt.close(figure)

def render(bed, extent, pixels_per_metre, top_speed):
    """The half behind the plane y = 0 seen along +y, each sphere shaded, coloured by speed."""
    (x0, x1), (z0, z1) = extent
    shape = (int((z1 - z0) * pixels_per_metre), int((x1 - x0) * pixels_per_metre))
    image, depth = np.ones(shape + (3,)), np.full(shape, np.inf)
    speed = np.sqrt(bed["vx"]**2 + bed["vy"]**2 + bed["vz"]**2)
    colours = plt.get_cmap("viridis")(np.clip(speed / top_speed, 0, 1))[:, :3]
    for k in np.flatnonzero(bed["y"] >= 0):
        r = bed["radius"][k] * pixels_per_metre
        cx, cz = (bed["x"][k] - x0) * pixels_per_metre, (bed["z"][k] - z0) * pixels_per_metre
        i0, i1 = max(int(cz - r), 0), min(int(cz + r) + 2, shape[0])
        j0, j1 = max(int(cx - r), 0), min(int(cx + r) + 2, shape[1])
        if i0 >= i1 or j0 >= j1:
            continue
        zz, xx = np.mgrid[i0:i1, j0:j1]
        nx, nz = (xx - cx) / r, (zz - cz) / r
        left = 1.0 - nx**2 - nz**2
        ny = np.sqrt(np.maximum(left, 0))
        distance = bed["y"][k] * pixels_per_metre - ny * r
        patch = depth[i0:i1, j0:j1]
        seen = (left > 0) & (distance < patch)
        light = 0.35 + 0.65 * np.clip(-0.4 * nx + 0.55 * nz + 0.73 * ny, 0, 1)
        image[i0:i1, j0:j1][seen] = (light[..., None] * colours[k])[seen]
        patch[seen] = distance[seen]
    return image

def particles(runs, scene, path, top_speed=1.0):
    """Each model while filling, at rest, and while flowing; the same clock for all."""
    half, wall = 1.1 * scene["cylinder"], (scene["cylinder"] - scene["orifice"])
    cone = wall / np.tan(np.radians(scene["half_angle_deg"]))
    moments = ((0.13, "filling, {:.2f} s"), (None, "full, at rest"), (0.30, "open for {:.2f} s"))
    figure, axes = plt.subplots(1, len(runs) * len(moments), figsize=(1.75 * len(runs) * len(moments), 3.9),
                                squeeze=False, gridspec_kw=dict(wspace=0.03))
    extent = ((-half, half), (-0.035, 0.185))
    column = 0
    for moment, words in moments:
        for model, run in runs.items():
            if moment is None:
                step, shown = measures.bed_step(run), 0
            else:
                wanted = (moment / run.dt) + (run.fill_steps if "open" in words else 0)
                step = min(run.dump_steps(), key=lambda s: abs(s - wanted))
                shown = step * run.dt - (run.opened if "open" in words else 0)
            ax = axes[0, column]
            ax.imshow(render(run.dump(step), extent, 1700, top_speed), origin="lower", extent=(*extent[0], *extent[1]))
            for sign in (-1, 1):
                ax.plot([sign * scene["orifice"], sign * scene["cylinder"], sign * scene["cylinder"]],
                        [0, cone, extent[1][1]], color="0.3", lw=1.2)
            ax.set_title(f"{model}\n{words.format(shown)}", fontsize=8)
            ax.set(xlim=extent[0], ylim=extent[1])
            ax.axis("off")
            column += 1
    scale = plt.cm.ScalarMappable(norm=plt.Normalize(0, top_speed), cmap="viridis")
    bar = figure.colorbar(scale, ax=list(axes[0]), orientation="vertical", fraction=0.008, pad=0.005)
    bar.set_label("speed, m/s", fontsize=8)
    bar.ax.tick_params(labelsize=7)
    figure.savefig(path, dpi=80, bbox_inches="tight")
    plt.close(figure)
