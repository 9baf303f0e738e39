"""A box of colliding spheres: many contacts that begin, end and begin again."""
import random

from harness import POWDER, head, properties

RADIUS = 1.7e-3
SIDE = 5          # spheres along an edge
SPACING = 1.12    # of their diameter
BOX = SIDE * SPACING * 2 * RADIUS


def data_file(path, seed=7, speed=3.0):
    """A jittered lattice with random velocities up to `speed` m/s in each direction, without overlaps."""
    rng = random.Random(seed)
    n = SIDE**3
    step = SPACING * 2 * RADIUS
    jitter = 0.5 * (SPACING - 1) * 2 * RADIUS * 0.5
    atoms, velocities = [], []
    for k in range(n):
        cell = (k % SIDE, k // SIDE % SIDE, k // SIDE**2)
        x = [(c + 0.5) * step + rng.uniform(-jitter, jitter) for c in cell]
        v = [rng.uniform(-speed, speed) for _ in range(3)]
        atoms.append(f"{k + 1} 1 {2 * RADIUS!r} {POWDER.density} " + " ".join(map(repr, x)))
        velocities.append(f"{k + 1} " + " ".join(map(repr, v)) + " 0 0 0")
    path.write_text(f"gas\n\n{n} atoms\n1 atom types\n\n" +
                    "".join(f"0 {BOX!r} {c}lo {c}hi\n" for c in "xyz") +
                    "\nAtoms\n\n" + "\n".join(atoms) + "\n\nVelocities\n\n" + "\n".join(velocities) + "\n")


def start(extra="", neigh="delay 0", read="read_data gas.data"):
    return head(read=read, boundary="p p p", skin=0.0004, extra=extra, neigh=neigh)


def model(words, tangential="history", friction=0.3, name="mpm"):
    return (properties([POWDER], friction) +
            f"pair_style gran model {name} tangential {tangential} {words}\npair_coeff * *\n")


MOVE = "fix i all nve/sphere\ntimestep 2e-7\n"
OUTPUT = ("compute rot all erotate/sphere\nvariable k equal ke+c_rot\nvariable d equal f_granulaw\n"
          "variable np equal f_granulaw[3]\nvariable om equal f_granulaw[7]\n"
          "thermo_style custom step ke c_rot f_granulaw\nthermo 1000\nthermo_modify norm no\n")
PRINT = 'print "GAS ${k} ${d} ${np} ${om}"\n'
