"""A better pair rule, tried out: a pair's curve composed of its two bodies' own curves (docs/pairs.md).

Each body sees a rigid flat that cuts it at its own share of the overlap: with radii R_s, R_h of the bodies as
they meet the flat, 1/R_s + 1/R_h = 1/R*; both have the same force and contact radius, so the same mean pressure;
overlaps, residual overlaps and unloading works add. Exact where the present rule is: like pairs, the rigid wall,
Hertz. Two corrections for bodies whose true radius is not that of the flat's sphere:
  - a centre comes nearer by k F/(E* R) less, k = 0.45;
  - the hardness falls with a/R as in Jackson and Green (2005), blended in from the onset of yield on.
"""
import h5py
import numpy as np

K = 0.45


class Body:
    """Dimensionless curve of a law file, or (no file) an elastic sphere; E* in units of the yielding body's."""

    def __init__(self, path=None, e_star=1.0):
        self.e_star, self.elastic, self.end = e_star, path is None, 0.3
        if self.elastic:
            return
        with h5py.File(path) as file:
            body = next(iter(file["bodies"].values()))
            self.curve = {key: value[()] for key, value in body["curve"].items()}
            m = {key: value[()] for key, value in body["material"].items()}
        self.e_over_y = m["youngs_modulus"] / (1 - m["poisson_ratio"] ** 2) / m["yield_stress"]
        self.onset, self.end = float(self.curve["onset"]), 0.999 * self.curve["s_end"] ** 4

    def _value(self, name, x):
        v, slope = self.curve[name], self.curve[name + "_slope"]
        h = self.curve["s_end"] / (len(v) - 1)
        k = np.minimum((x**0.25 / h).astype(int), len(v) - 2)
        t = x**0.25 / h - k
        return ((1 - t) ** 2 * ((1 + 2 * t) * v[k] + t * h * slope[k])
                + t**2 * ((3 - 2 * t) * v[k + 1] - (1 - t) * h * slope[k + 1]))

    def force(self, x):  # of a sphere of radius 1
        ratio = 1 + 1.5 * K * np.sqrt(x) if self.elastic else self._value("force_ratio", x)
        return 4 / 3 * self.e_star * x**1.5 * ratio

    def radius(self, x):
        return np.sqrt(x) * (1 if self.elastic else self._value("radius_ratio", x))

    def pressure(self, x):
        return self.force(x) / (np.pi * self.radius(x) ** 2)

    def residual(self, x):
        return 0 * x if self.elastic else np.where(x <= self.onset, 0, self._value("residual_ratio", x))

    def unloading_work(self, x):
        """Given back, over F_m (x_m - x_r)."""
        return 0.4 + 0 * x if self.elastic else (11 - 2 * self._value("exponent", x)) / 21 + self._value("foot", x) * 2 / 105

    def softer(self, x, a, flat, true):
        """Hardness at a/true over that at a/flat, where the body is plastic."""
        if self.elastic:
            return 1 + 0 * x
        geometry = [1 - np.exp(-0.82 * np.maximum(a / r, 1e-3) ** -0.7) for r in (true, flat)]
        return (geometry[0] / geometry[1]) ** np.clip(np.log10(np.maximum(1, x / self.onset)) / 2, 0, 1)


def curve_of(force, overlap, given_back):
    work = 0.4 * force[0] * overlap[0] + np.concatenate(
        [[0], np.cumsum(0.5 * (force[1:] + force[:-1]) * np.diff(overlap))])
    return {"work": work, "force": force, "given_back": given_back}


def composed(s, h, radius_ratio, count=1500):
    x_s = np.geomspace(1e-6, s.end, count)
    grid = np.geomspace(1e-10, h.end, 8000)
    curvature = 1 + 1 / radius_ratio
    low, high = np.full(count, 1.0000001 / curvature), np.full(count, 1e4 / curvature)
    for _ in range(60):  # the flat's share: bisection for equal pressures
        r_s = np.sqrt(low * high)
        a, r_h = r_s * s.radius(x_s), 1 / np.maximum(curvature - 1 / r_s, 1e-12)
        x_h = np.exp(np.interp(np.log(a / r_h), np.log(h.radius(grid)), np.log(grid)))
        p = s.pressure(x_s) * s.softer(x_s, a, r_s, 1.0)
        higher = h.pressure(x_h) * h.softer(x_h, a, r_h, radius_ratio) < p
        low, high = np.where(higher, r_s, low), np.where(higher, high, r_s)
    force = np.pi * a**2 * p
    finite = -K * force * ((1 - 1 / r_s) / s.e_star + (1 / radius_ratio - 1 / r_h) / h.e_star)
    back = [force * r * x * (1 - b.residual(x)) * b.unloading_work(x) for b, x, r in ((s, x_s, r_s), (h, x_h, r_h))]
    return curve_of(force, r_s * x_s + r_h * x_h + finite, back[0] + back[1] + 0.5 * force * finite)


def present(s, stiffness, radius_ratio):
    x = np.geomspace(1e-6, s.end, 1500)
    lam, r_eff = (1 + 1 / stiffness) ** 2, 1 / (1 + 1 / radius_ratio)
    force, overlap = s.force(x) * lam * r_eff**2, lam * r_eff * x
    return curve_of(force, overlap, force * overlap * (1 - s.residual(x)) * s.unloading_work(x))


def impact(curve, energy):
    back = np.interp(energy, curve["work"], curve["given_back"])
    return np.interp(energy, curve["work"], curve["force"]), np.sqrt(min(1.0, back / energy))


def rule_over_composed(row, laws):
    """(force, e) by the present rule over the composed one, less 1, of a row of pairs.csv; None: no law for it."""
    if row["group"] == "press" or row["nu"] != 0.3 or not np.isfinite(row["radius_ratio"]):
        return None
    stiffness, ratio = row["stiffness_ratio"], row["radius_ratio"]

    def body(e_over_y, e_star):
        if e_over_y == 0:
            return Body(None, e_star)
        for path in laws:
            found = Body(path, e_star)
            if abs(found.e_over_y / e_over_y - 1) < 0.01:
                return found
        return None

    s, h = body(row["E_over_Y"], 1.0), body(row["partner_E_over_Y"], stiffness)
    if s is None or h is None:
        return None
    lam, r_eff = (1 + 1 / stiffness) ** 2, 1 / (1 + 1 / ratio)
    share = 1 / (1 + 1 / (ratio**3 * row["density_ratio"]))  # m*/m_s
    density = share / (lam**2 * r_eff**3)
    v = row["V_over_Vy"] * (np.pi / 2) ** 2 * np.sqrt(0.4 / density) * (1.6 / row["E_over_Y"]) ** 2.5
    energy = 0.5 * 4 / 3 * np.pi * share * v**2
    now, better = impact(present(s, stiffness, ratio), energy), impact(composed(s, h, ratio), energy)
    return now[0] / better[0] - 1, now[1] / better[1] - 1
