#!/usr/bin/python3
"""Draws a contact law: plot_law.py LAW.h5 PICTURE. Called by `mpm plot`.

Left, force against overlap with unloading branches; right, e against V/V_y, Thornton (1997) beside it.
Dimensionless, one colour a material.
"""
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2] / "examples/common"))  # in the sources; else it lies beside
import one_sentence  # noqa: E402, F401
import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np


def hermite(nodes, value, slope, x):
    """Cubic Hermite with slopes d/dx: as the law library evaluates (docs/reference/law-format.md)."""
    k = np.clip(np.searchsorted(nodes, x, "right") - 1, 0, len(nodes) - 2)
    h = nodes[k + 1] - nodes[k]
    t = (x - nodes[k]) / h
    return ((1 + 2 * t) * (1 - t) ** 2 * value[k] + t * (1 - t) ** 2 * h * slope[k]
            + t * t * (3 - 2 * t) * value[k + 1] + t * t * (t - 1) * h * slope[k + 1])


class Body:
    def __init__(self, group):
        material, curve = group["material"], group["curve"]
        self.e_star = material["youngs_modulus"][()] / (1 - material["poisson_ratio"][()] ** 2)
        self.yield_stress = material["yield_stress"][()] if "yield_stress" in material else np.inf
        self.onset = curve["onset"][()] if "onset" in curve else np.inf
        self.end = curve["end"][()]
        self.curve = {name: curve[name][:] for name in curve if curve[name].shape}
        k = np.arange(len(self.curve["force"]))
        self.nodes = (self.onset if np.isfinite(self.onset) else 1) * (1 + k % 8 / 8) * 2.0 ** (k // 8 - curve["octaves"][()])

    def of(self, name, x):
        """A column at x; kept, span and hertz_share begin at the onset."""
        value = self.curve[name]
        return hermite(self.nodes[-len(value):], value, self.curve[name + "_slope"], np.asarray(x))

    def loading(self, x):
        """F/(4/3 E* R^2)."""
        return self.of("force", x)

    def works(self):
        """x, loading work and returned work, in 4/3 E* R^3."""
        x = np.linspace(0, self.end ** 0.25, 4001)[1:] ** 4
        force = self.loading(x)
        loaded = x[0] * force[0] / 2.5 + np.concatenate([[0], np.cumsum(0.5 * (force[1:] + force[:-1]) * np.diff(x))])
        return x, loaded, loaded * np.where(x > self.onset, self.of("kept", np.maximum(x, self.onset)), 1)

    def unloading(self, x_m, u, work):
        """F/F_m after a reversal at x_m whose work of loading is `work`, u from 0 at the residual overlap to 1."""
        a = self.of("hertz_share", x_m)
        n = 5.5 - 10.5 * self.of("kept", x_m) * work / (self.loading(x_m) * x_m * self.of("span", x_m)) + 0.2 * a
        return a * u ** 1.5 + (5 - 2 * a - 2 * n) * u ** 2 + (a + 2 * n - 4) * u ** 2.5


def thornton(v):
    x = 1 / np.maximum(v, 1)
    e = np.sqrt(6 * np.sqrt(3) / 5) * np.sqrt(1 - x * x / 6) * (x / (x + 2 * np.sqrt(1.2 - 0.2 * x * x))) ** 0.25
    return np.where(v > 1, e, 1.0)


def main(law, picture):
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4.2))
    with h5py.File(law) as file:
        for colour, name in enumerate(file["bodies"]):
            body, c = Body(file["bodies"][name]), f"C{colour}"
            x = np.linspace(0, body.end ** 0.25, 400)[1:] ** 4
            scale = 4 / 3 * body.e_star / (body.yield_stress if np.isfinite(body.yield_stress) else body.e_star)
            label = f"{name}" + (f", E*/Y = {body.e_star / body.yield_stress:.0f}" if np.isfinite(body.yield_stress) else ", elastic")
            left.plot(x, scale * body.loading(x), c, label=label)
            if not np.isfinite(body.onset):
                continue
            deep, loaded, returned = body.works()
            for x_m in np.array([0.15, 0.4, 0.7, 1.0]) * x[-1]:
                span = float(body.of("span", x_m)) * x_m
                u = np.linspace(0, 1, 100)
                left.plot(x_m - span * (1 - u), scale * float(body.loading(x_m)) * body.unloading(x_m, u, np.interp(x_m, deep, loaded)), c, lw=0.8)
            # kinetic energy 2/3 pi rho R^3 V^2 = 4/3 E* R^3 loaded; rho V_y^2 = (pi/2)^4 (2/5) 1.6^5 Y^5/E*^4
            v_y = np.sqrt((np.pi / 2) ** 4 * 0.4 * 1.6 ** 5 * (body.yield_stress / body.e_star) ** 5)
            right.plot(np.sqrt(2 / np.pi * loaded) / v_y, np.sqrt(returned / loaded), c, label=label)
    v = np.geomspace(0.5, max(right.get_xlim()[1], 100), 400)
    right.plot(v, thornton(v), "k--", lw=1, label="Thornton 1997")
    right.set(xscale="log", xlim=(0.5, v[-1]), ylim=(0, 1.05), xlabel="V / $V_y$", ylabel="coefficient of restitution e")
    left.set_title("Force: loading, and unloading from four overlaps", fontsize=10)
    right.set_title("Restitution of impacts on a rigid wall", fontsize=10)
    left.set(xlabel="overlap / R", ylabel="force / (Y R²)", xlim=(0, None), ylim=(0, None))
    for axis in (left, right):
        axis.grid(alpha=0.3)
        axis.legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(picture, dpi=150)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2])
