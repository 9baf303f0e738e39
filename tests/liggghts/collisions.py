"""Single collisions: the deck, and e as LIGGGHTS computes it."""
import harness
from harness import head, properties


def wall_deck(model, words, material, radius, speed, dt, wall="primitive type 1 zplane 0.0", wall_words="",
              tangential="history", before_wall=""):
    """A sphere flies at a wall at z = 0 and touches it 0.3 steps after the start (no special phase)."""
    z = radius + 0.3 * dt * speed
    return (head(half=20 * radius) + properties([material]) +
            f"pair_style gran model {model} tangential {tangential} {words}\npair_coeff * *\n{before_wall}"
            f"fix w all wall/gran model {model} tangential {tangential} {wall} {wall_words}\n"
            f"create_atoms 1 single {2.3 * radius} {-1.1 * radius} {z!r} units box\n"
            f"set group all diameter {2 * radius!r} density {material.density}\n"
            f"velocity all set 0.0 0.0 {-speed!r}\nfix i all nve/sphere\ntimestep {dt!r}\n"
            'thermo 100\nvariable v equal vcm(all,z)\n'
            "run 120\n"
            'print "SPEED ${v}"\n')


def pair_deck(model, words, materials, radii, speed, dt, tangential="history", extra="", run="run 120",
              ntypes=None):
    """Two spheres head-on along a slanted line, centre of mass at rest; types 1 and 2 where materials differ."""
    types = 1 if materials[0] is materials[1] else 2
    m = [harness.sphere_mass(r, mat.density) for r, mat in zip(radii, materials)]
    share = [m[1] / (m[0] + m[1]), m[0] / (m[0] + m[1])]
    axis = (0.6, 0.48, 0.64)  # unit vector that no axis of the box favours
    gap = radii[0] + radii[1] + 0.3 * dt * speed
    text = (head(types=types, half=20 * max(radii), extra=extra) + properties(list(materials)[:types]) +
            f"pair_style gran model {model} tangential {tangential} {words}\npair_coeff * *\n")
    for k, sign in ((0, 1.0), (1, -1.0)):
        position = " ".join(repr(-sign * a * share[k] * gap) for a in axis)
        velocity = " ".join(repr(sign * a * share[k] * speed) for a in axis)
        t = 1 if types == 1 else k + 1
        text += (f"create_atoms {t} single {position} units box\ngroup a{k} id {k + 1}\n"
                 f"set group a{k} diameter {2 * radii[k]!r} density {materials[k].density}\n"
                 f"velocity a{k} set {velocity}\n")
    text += f"fix i all nve/sphere\ntimestep {dt!r}\nthermo 1000\n"
    for c in "xyz":
        text += f"variable r{c} equal vcm(a1,{c})-vcm(a0,{c})\n"
    text += f"{run}\n"
    text += f'variable s equal {axis[0]}*v_rx+{axis[1]}*v_ry+{axis[2]}*v_rz\nprint "SPEED ${{s}}"\n'
    return text
