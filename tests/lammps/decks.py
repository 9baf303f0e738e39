"""Decks of one scene for LAMMPS and for LIGGGHTS: what differs between their languages."""
import re

COLUMNS = "x y z vx vy vz fx fy fz omegax omegay omegaz tqx tqy tqz"
FORMAT = " ".join(["%d"] + ["%.17g"] * len(COLUMNS.split()))


class Lammps:
    name = "lammps"

    @staticmethod
    def head(boundary="f f f", units="si", skin=1e-3):
        return (f"units {units}\natom_style sphere\natom_modify map array\nboundary {boundary}\nnewton off\ncomm_modify mode single vel yes\n"
                f"neighbor {skin!r} bin\nneigh_modify delay 0 every 1 check yes\n")

    @staticmethod
    def law(law, materials, words="", friction=0.0, tangential="history", damping=0.1, elastic_damping=0.001, moduli=()):
        """Pair style; `materials`: names of the types. `moduli`: youngs_modulus, poisson_ratio of each type, for LIGGGHTS."""
        return (f"pair_style granulaw {law} friction {friction!r} tangential {tangential} damping {damping!r} elastic_damping {elastic_damping!r} {words}\n"
                f"pair_coeff * * {' '.join(materials)}\n")

    @staticmethod
    def floor(words="", **_):
        return f"fix floor all wall/granulaw zplane 0.0 NULL {words}\n"

    gravity = "fix g all gravity 9.81 vector 0 0 -1\nfix i all nve/sphere\n"

    @staticmethod
    def spin(group, omega):
        return f"set group {group} omega {' '.join(map(repr, omega))}\n"


class Liggghts:
    name = "liggghts"

    @staticmethod
    def head(boundary="f f f", units="si", skin=1e-3):
        return (f"units {units}\nhard_particles yes\natom_style granular\natom_modify map array\nboundary {boundary}\nnewton off\ncommunicate single vel yes\n"
                f"neighbor {skin!r} bin\nneigh_modify delay 0 every 1 check yes\n")

    @staticmethod
    def law(law, materials, words="", friction=0.0, tangential="history", damping=0.1, elastic_damping=0.001, moduli=(), rolling=None):
        n = len(materials)
        return (f"fix p1 all property/global youngsModulus peratomtype {' '.join(repr(e) for e, _ in moduli)}\n"
                f"fix p2 all property/global poissonsRatio peratomtype {' '.join(repr(nu) for _, nu in moduli)}\n"
                f"fix p3 all property/global coefficientFriction peratomtypepair {n} {' '.join([repr(friction)] * n * n)}\n"
                f"fix p4 all property/global coefficientRollingFriction peratomtypepair {n} {' '.join([repr(rolling or 0.0)] * n * n)}\n"
                f"pair_style gran model mpm tangential {tangential} {'rolling_friction epsd2 ' if rolling else ''}law {law} materials {' '.join(materials)} "
                f"tangentialDampingRatio {damping!r} elasticDamping {elastic_damping!r} {words}\npair_coeff * *\n")

    @staticmethod
    def floor(words="", tangential="history", rolling=None, kind=1):
        return (f"fix floor all wall/gran model mpm tangential {tangential} {'rolling_friction epsd2 ' if rolling else ''}primitive type {kind} zplane 0.0 {words}\n")

    gravity = "fix g all gravity 9.81 vector 0 0 -1\nfix i all nve/sphere\n"

    @staticmethod
    def spin(group, omega):
        return "set group {} omegax {!r} omegay {!r} omegaz {!r}\n".format(group, *omega)


def dump(every=1, name="d.dump"):
    """Columns of every atom at full precision."""
    return f'dump d all custom {every} {name} id {COLUMNS}\ndump_modify d sort id format "{FORMAT}"\n'


def dump_line(engine, every=1, name="d.dump"):
    """`format` is `format line` in LAMMPS."""
    text = dump(every, name)
    return text.replace("format \"", "format line \"") if engine is Lammps else text


def frames(path):
    """[{step}, {id: [numbers]}] of a text dump."""
    found, lines = {}, path.read_text().splitlines()
    for k, line in enumerate(lines):
        if line.startswith("ITEM: TIMESTEP"):
            step = int(lines[k + 1])
        elif line.startswith("ITEM: NUMBER OF"):
            count = int(lines[k + 1])
        elif line.startswith("ITEM: ATOMS"):
            found[step] = {int(row.split()[0]): [float(w) for w in row.split()[1:]] for row in lines[k + 1:k + 1 + count]}
    return found


def data_file(path, atoms, box, types=1):
    """A file that both read: atoms (type, radius, density, x y z[, v]), box ((lo, hi), ...)."""
    text = f"atoms\n\n{len(atoms)} atoms\n{types} atom types\n\n"
    text += "".join(f"{lo!r} {hi!r} {axis}lo {axis}hi\n" for (lo, hi), axis in zip(box, "xyz"))
    text += "\nAtoms\n\n" + "".join(f"{k} {kind} {2 * r!r} {density!r} {x!r} {y!r} {z!r}\n" for k, (kind, r, density, x, y, z, *_) in enumerate(atoms, 1))
    text += "\nVelocities\n\n" + "".join(f"{k} {vx!r} {vy!r} {vz!r} 0 0 0\n" for k, (*_, vx, vy, vz) in enumerate(((*a, 0.0, 0.0, 0.0) if len(a) == 6 else a for a in atoms), 1))
    path.write_text(text)
    return path


def said(text, name):
    """Numbers behind each `print "NAME ..."`."""
    return [[float(w) for w in line.split()] for line in re.findall(rf"^{name} (.*)$", text, re.M)]
