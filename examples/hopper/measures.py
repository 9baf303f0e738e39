"""Numbers of one hopper run, each with its spread where the run itself can give one."""
import math

import numpy as np

GRAVITY = 9.81  # m/s^2, as in in.hopper
WINDOW = 0.04   # s, one window of the discharge: about 140 particles


class Value:
    """A number with its standard error; `error` None: one number of one deterministic run, no spread known."""

    def __init__(self, value, error=None):
        self.value, self.error = value, error

    def differs(self, other):
        """True, False, or None where a spread is missing: two-sided 95 %."""
        if self.error is None or other.error is None:
            return None
        return abs(self.value - other.value) > 1.96 * math.hypot(self.error, other.error)


def discharge_windows(run, mass):
    """Rates (kg/s) in windows of the steady part: from 15 to 75 % of the particles passed."""
    t, passed = run.series["time"], run.series["passed"]
    total = run.series["atoms"][0]
    steady = t[(passed >= 0.15 * total) & (passed <= 0.75 * total)]
    if len(steady) < 3:
        return np.array([]), np.array([])
    edges = np.arange(steady[0], steady[-1] + 1e-12, WINDOW)
    counts = np.diff(np.interp(edges, t, passed))
    return 0.5 * (edges[1:] + edges[:-1]), counts * mass / total / WINDOW


def discharge_rate(run, mass, rng):
    """Mean of the windows; its error by bootstrap over blocks of two neighbouring windows (they are correlated)."""
    _, rates = discharge_windows(run, mass)
    if len(rates) < 4:
        return None
    blocks = [rates[i:i + 2] for i in range(len(rates) - 1)]
    picks = rng.integers(0, len(blocks), size=(4000, len(rates) // 2))
    means = np.array([np.mean(np.concatenate([blocks[k] for k in row])) for row in picks])
    return Value(float(np.mean(rates)), float(np.std(means)))


def bulk_density(run, scene):
    """kg/m^3 of the filled bed, away from walls and surface: centres counted in an inner cone and cylinder. None of a
    bed too shallow to have such an inside."""
    bed = run.dump(bed_step(run))
    d = 2 * scene["radius"]
    r, z = np.hypot(bed["x"], bed["y"]), bed["z"]
    slope = math.tan(math.radians(scene["half_angle_deg"]))
    low, high = 1.5 * d, np.percentile(z, 95) - 2 * d
    if high <= low:
        return None
    heights = np.linspace(low, high, 400)
    limit = lambda zz: np.minimum(scene["orifice"] + slope * zz, scene["cylinder"]) - 1.5 * d
    inside = (z > low) & (z < high) & (r < limit(z))
    volume = np.trapezoid(np.pi * limit(heights)**2, heights) if hasattr(np, "trapezoid") else \
        np.trapz(np.pi * limit(heights)**2, heights)
    count = int(np.sum(inside))
    # the count of a dense bed fluctuates less than Poisson: this error is on the safe side
    density = count * scene["mass"] / scene["particles"] / volume
    return Value(density, density / math.sqrt(max(count, 1)))


def beverloo(density, scene, k=1.4, c=0.58):
    """Beverloo, Leniger and van de Velde (1961), flat bottom: C rho_b sqrt(g) (D - k d)^2.5, kg/s; None without a density."""
    if density is None:
        return None
    return c * density.value * math.sqrt(GRAVITY) * (2 * scene["orifice"] - k * 2 * scene["radius"])**2.5


def bed_step(run):
    """Last dump before the orifice opens."""
    return max(s for s in run.dump_steps() if s <= run.fill_steps)


def coordination(run):
    """Touching particle pairs a particle (geometric overlap > 0), walls not counted; error over particles."""
    touch = run.dump(bed_step(run))["c_touch"]
    return Value(float(np.mean(touch)), float(np.std(touch) / math.sqrt(len(touch))))


def bed_height(run):
    """Mean over eight sectors of the highest particle's top (m); error over the sectors."""
    bed = run.dump(bed_step(run))
    sector = np.floor((np.arctan2(bed["y"], bed["x"]) + np.pi) / (2 * np.pi) * 8).astype(int) % 8
    tops = np.array([np.max((bed["z"] + bed["radius"])[sector == k]) for k in range(8) if np.any(sector == k)])
    return Value(float(np.mean(tops)), float(np.std(tops, ddof=1) / math.sqrt(len(tops))))


def filling(run):
    """The closed system before opening: energies in J, times in s. Keys: dissipated, plastic, peak, to_1e-2, ..."""
    s = run.series
    closed = s["time"] <= run.opened + 0.5 * run.dt
    kinetic = s["kinetic"] + s["rotational"]
    energy = kinetic + s["potential"]
    last = np.flatnonzero(closed)[-1]
    peak = int(np.argmax(np.where(closed, kinetic, 0)))
    result = {"dissipated": energy[0] - energy[last], "initial": energy[0], "plastic": s["plastic"][last],
              "peak": kinetic[peak], "peak_time": s["time"][peak]}
    for level in (1e-1, 1e-2, 1e-3, 1e-4):
        below = np.flatnonzero(closed & (np.arange(len(kinetic)) > peak) & (kinetic < level * kinetic[peak]))
        result[level] = s["time"][below[0]] - s["time"][peak] if len(below) else None
    return result
