#!/usr/bin/python3
"""Draws the deformed body of a field series (mpm impact|press --fields NAME.xdmf): plot_fields.py NAME.h5 PICTURE.png

The section through the axis, mirrored to a whole body: equivalent plastic strain on the right, von Mises stress on
the left, at some moments between first touch and the end; under them the same near the contact. A second body or a
wall is drawn below, where it is. Lengths are in units of the first particle's largest radius.
"""
import argparse
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2] / "examples/common"))  # in the sources; else it lies beside
import one_sentence  # noqa: E402, F401
import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection
from PIL import Image


def draw(axes, frame, cells, name, side, scale, **style):
    position = frame["position"][:] / scale * [side, 1]
    shown = PolyCollection(position[cells], array=frame[name][:] * style.pop("factor", 1), edgecolors="face",
                           linewidths=0.3, rasterized=True, **style)
    axes.add_collection(shown)
    return shown


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("fields", help="NAME.h5 beside NAME.xdmf")
    options.add_argument("picture")
    options.add_argument("--moments", type=int, default=3, help="how many (default 3); the deepest is one of them")
    options = options.parse_args()

    if not h5py.is_hdf5(options.fields):
        raise SystemExit(f"{options.fields}: no such file, or not HDF5")
    with h5py.File(options.fields) as file:
        if file.attrs.get("format") not in ("granulaw-fields", b"granulaw-fields"):
            raise SystemExit(f"{options.fields}: not a field series of mpm impact or mpm press")
        cells = file["cells"][:]
        frames = [file[name] for name in sorted(n for n in file if n.startswith("frame"))]
        delta = np.array([f["delta"][()] for f in frames])
        deepest = int(delta.argmax())
        count = max(2, options.moments)
        # equal shares of the deepest overlap on the way in, then the end
        wanted = [int(np.abs(delta[:deepest + 1] - share * delta[deepest]).argmin())
                  for share in np.linspace(0, 1, count)[1:]] + [len(frames) - 1]
        start = frames[0]["position"][:]
        upper = start[:, 1] > 0
        radius = start[upper, 0].max()  # the first body lies above, a second one below
        two = start[:, 1].min() < 0
        reach = 3.0 * np.sqrt(delta[deepest] / radius)  # about twice the contact radius
        bottom = max(start[:, 1].min() / radius, -2.0) - 0.1
        strain = max(f["equivalent_plastic_strain"][:].max() for f in frames)
        stress = max(f["von_mises_stress"][:].max() for f in frames) * 1e-6

        figure, axes = plt.subplots(2, count, height_ratios=(2, 1.15), figsize=(2.6 * count, 5.0), layout="constrained")
        for column, k in enumerate(wanted):
            frame = frames[k]
            for row in (0, 1):
                a = axes[row, column]
                left = draw(a, frame, cells, "von_mises_stress", -1, radius, factor=1e-6, cmap="cividis", clim=(0, stress))
                right = draw(a, frame, cells, "equivalent_plastic_strain", 1, radius, cmap="magma_r", clim=(0, strain))
                if not two:
                    a.axhline(0, color="black", linewidth=1.2)
                a.set_aspect("equal")
                if row == 0:
                    a.set(xlim=(-1.1, 1.1), ylim=(bottom, start[:, 1].max() / radius + 0.1))
                    a.set_title(f"t = {frame['time'][()] * 1e6:.3g} µs, δ = {delta[k] / radius:.3g} R", fontsize=9)
                else:
                    a.set(xlim=(-reach, reach), ylim=((-1.2 if two else -0.04) * reach, 1.2 * reach))
                a.tick_params(labelsize=7)
        axes[1, 0].set_xlabel("r/R", fontsize=8)
        axes[1, 0].set_ylabel("z/R", fontsize=8)
        bar = dict(location="bottom", aspect=30, pad=0.02)
        split = max(1, count // 2)
        figure.colorbar(left, ax=axes[1, :split], **bar).set_label("von Mises stress (MPa), left halves", fontsize=8)
        figure.colorbar(right, ax=axes[1, split:], **bar).set_label("equivalent plastic strain, right halves", fontsize=8)
        figure.savefig(options.picture, dpi=100)
    if options.picture.endswith(".png"):  # a palette is enough, and a third of the size
        with Image.open(options.picture) as picture:
            small = picture.convert("RGB").quantize(256, dither=Image.Dither.NONE)
        small.save(options.picture, optimize=True)


if __name__ == "__main__":
    main()
