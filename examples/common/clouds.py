"""Initial states: random clouds of spheres, and LIGGGHTS data files."""
import numpy as np


def random_cloud(count, radius, low, high, rng, periodic=(False, False, False), gap=1.02):
    """`count` centres at random in the box low..high (m), 2 * gap radii apart (random sequential addition)."""
    low, high = np.asarray(low, float), np.asarray(high, float)
    size = high - low
    if count * 4 / 3 * np.pi * (gap * radius)**3 > 0.3 * np.prod(size):
        raise SystemExit(f"random_cloud: {count} spheres of {radius} m fill more than 0.3 of the box {size}: enlarge it")
    cells = np.maximum((size / (2 * gap * radius)).astype(int), 1)
    wrap = np.asarray(periodic)
    taken, centres = {}, np.empty((count, 3))
    n = 0
    while n < count:
        p = rng.uniform(low, high)
        key = np.minimum(((p - low) / size * cells).astype(int), cells - 1)
        clear = True
        for shift in np.ndindex(3, 3, 3):
            near = key + np.array(shift) - 1
            near = tuple(np.where(wrap, near % cells, near))
            for q in taken.get(near, ()):
                away = p - q
                away -= np.where(wrap, size * np.round(away / size), 0)
                clear = clear and away @ away >= (2 * gap * radius)**2
        if clear:
            taken.setdefault(tuple(key), []).append(p)
            centres[n] = p
            n += 1
    return centres


def write_data(path, centres, radius, density, low, high, velocities=None, types=1):
    """Spheres in the box low..high; velocities in m/s, at rest without. radius, density, types: of each sphere, or one for all.
    The type behind the largest is the walls'."""
    radius, density, types = (np.broadcast_to(of, len(centres)) for of in (radius, density, types))
    with open(path, "w") as out:
        out.write(f"LIGGGHTS data file\n\n{len(centres)} atoms\n{max(types) + 1} atom types\n\n")
        for a, b, axis in zip(low, high, "xyz"):
            out.write(f"{a:.12g} {b:.12g} {axis}lo {axis}hi\n")
        out.write("\nAtoms\n\n")  # id, type, diameter, density, x, y, z
        for i, p in enumerate(centres, 1):
            out.write(f"{i} {types[i - 1]} {2 * radius[i - 1]:.12g} {density[i - 1]:.12g} {p[0]:.15g} {p[1]:.15g} {p[2]:.15g}\n")
        if velocities is not None:
            out.write("\nVelocities\n\n")  # id, vx, vy, vz, angular velocity
            for i, v in enumerate(velocities, 1):
                out.write(f"{i} {v[0]:.15g} {v[1]:.15g} {v[2]:.15g} 0 0 0\n")
