#!/usr/bin/python3
"""Section y = 0 of a three-dimensional run in the middle of its frames: section_picture.py FIELDS.h5 OUT.png

docs/theory/three-dimensions.png is made by
  mpm impact materials.toml --particle grain --velocity 60 --orientation 0,0.3,1 --resolution 8 --shifted-grids 1 --frames 12 --fields fields.xdmf
of an ellipsoid with half axes 0.8, 1, 1.4 mm, E = 0.91 GPa, nu = 0.3, Y = 10 MPa, 1000 kg/m^3."""
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "examples/common"))
import one_sentence  # noqa: E402, F401
import h5py
import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.collections import PolyCollection


def section(cells, start, now):
    """Which cells have a face in y = 0, and the deformed faces there, mm."""
    kept, faces = [], []
    for k, corners in enumerate(cells):
        inside = corners[np.abs(start[corners][:, 1]) < 1e-9]
        if len(inside) != 4:
            continue
        x = start[inside][:, [0, 2]]
        x = x - x.mean(0)
        faces.append(1e3 * now[inside][:, [0, 2]][np.argsort(np.arctan2(x[:, 1], x[:, 0]))])
        kept.append(k)
    return kept, faces


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    with h5py.File(sys.argv[1]) as file:
        frames = sorted(name for name in file if name.startswith("frame"))
        frame = file[frames[len(frames) // 2]]
        kept, faces = section(file["cells"][:], file["frame0000/position"][:], frame["position"][:])
        figure, axes = plt.subplots(1, 2, figsize=(9, 4.6))
        shown = (("equivalent_plastic_strain", "plastic strain", "magma_r", (0, 1.5), 1),
                 ("von_mises_stress", "von Mises stress, MPa", "cividis", (0, 10), 1e-6))
        for axis, (name, title, colours, limits, unit) in zip(axes, shown):
            cells = PolyCollection(faces, array=unit * frame[name][:][kept], cmap=colours, edgecolors=(0, 0, 0, 0.15), linewidths=0.3)
            cells.set_clim(*limits)
            axis.add_collection(cells)
            axis.autoscale()
            axis.set_aspect("equal")
            axis.set_title(title, fontsize=10)
            axis.set_xlabel("x, mm")
            figure.colorbar(cells, ax=axis, shrink=0.8)
        axes[0].set_ylabel("z, mm")
        figure.tight_layout()
        figure.savefig(sys.argv[2], dpi=100)


if __name__ == "__main__":
    main()
