"""The scene of the matrix (matrix.py): spheres of two materials thrown at each other over a floor. A feature changes some of its lines.

A deck is a row of parts, in the order of PARTS. Within a part @M stands for the model's name, @P for the models of pairs and walls, @p and @w
for the model's own words behind a pair style and behind a wall, @f for all words that a wall needs without a pair style of the model."""
import collections
import math
import random

from harness import GLASS, POWDER, plane_stl

RADIUS = 1.7e-3
LAW_FILES = {"elastic": "powder.h5", "plastic": "powder.h5", "composed": "composed.h5"}
STEP = 2e-7     # s; 40 steps in the shortest contact
SPEED = 2.0     # m/s
STRETCH = 3.0
RESTITUTION = 0.5  # of the damped equivalent sphere

# model: hertz, mpm, thornton. law: elastic (the equivalent sphere of Hertz), plastic, or composed (plastic with composed pair laws, waves on). stretch, energy: whether the deck says so.
Variant = collections.namedtuple("Variant", "model law stretch energy ranks")

PARTS = ("units", "hard", "atom_style", "atom_modify", "boundary", "newton", "communicate", "processors", "first", "box", "neighbor",
         "properties", "more_properties", "before_pair", "pair", "before_atoms", "atoms", "walls", "gravity", "more_walls", "integrate", "time_step",
         "extra", "output", "more_output", "run", "end")

DEFAULT = {
    "units": "units si", "hard": "hard_particles yes", "atom_style": "atom_style granular", "atom_modify": "atom_modify map array",
    "boundary": "boundary f f f", "newton": "newton off", "communicate": "communicate single vel yes",
    "box": "region box block -0.01 0.01 -0.008 0.008 -0.002 0.014 units box\ncreate_box 2 box",
    "neighbor": "neighbor 0.0004 bin\nneigh_modify delay 0 contact_distance_factor 1.01",
    "pair": "pair_style gran @P @p\npair_coeff * *",
    "walls": "fix floor all wall/gran @P primitive type 1 zplane 0.0 @w",
    "gravity": "fix gravity all gravity 9.81 vector 0.0 0.0 -1.0",
    "integrate": "fix integrate all nve/sphere",
    "time_step": f"timestep {STEP!r}",
    "run": "run 600",
}
MODELS = "tangential history"


class Feature:
    """One line of the matrix. `parts` replaces lines of the scene; the other arguments say what can be asked of it.

    models: the models behind `model NAME`. columns, dump: further thermo values and columns of the dump of particles. files: what the deck
    reads, {name: text}. equivalent sphere: compare with Hertz number by number; "plain": not with `stretch`. conserved: energy is conserved but for the contacts' losses. alike: one rank
    and two give the same trajectory. refused: part of the sentence that refuses it. damped: the equivalent sphere has e = 0.5. skip: files not compared.
    kept: stock LIGGGHTS loses or shifts the contacts' histories here; the reference is Hertz in liggghts-mpm, which keeps them.
    both: words behind the pair style and behind each wall. own: words behind the pair style of
    mpm and thornton alone. alone: each deck in a process of its own. tolerance: at least this one. ranks: on which it runs."""

    def __init__(self, group, name, models=MODELS, columns="", dump="", files=None, twin=True, conserved=True, alike=True, refused=None,
                 damped=False, skip=(), both="", own="", alone=False, kept=False, tolerance=0.0, ranks=(1, 2), **parts):
        unknown = set(parts) - set(PARTS)
        assert not unknown, f"{name}: no such part: {unknown}"
        self.group, self.name, self.models, self.columns, self.dump = group, name, models, columns, dump
        self.files, self.twin, self.conserved, self.alike, self.refused = files or {}, twin, conserved, alike, refused
        self.damped, self.skip, self.both, self.own, self.alone, self.kept, self.tolerance, self.ranks, self.parts = \
            damped, tuple(skip), both, own, alone, kept, tolerance, ranks, parts


def sphere_lines(length=1.0, density=1.0):
    """Two layers of 3 by 3 spheres, alternately of both types, jittered; velocities from their ids."""
    rng = random.Random(3)
    lines, spacing = [], 2.03 * RADIUS
    for k in range(18):
        cell = (k % 3 - 1, k // 3 % 3 - 1, k // 9)
        x = [c * spacing + rng.uniform(-0.01, 0.01) * RADIUS for c in cell]
        x[2] += 1.015 * RADIUS
        lines.append(f"create_atoms {k % 2 + 1} single {x[0] * length!r} {x[1] * length!r} {x[2] * length!r} units box")
    for kind, material in ((1, POWDER), (2, GLASS)):
        lines.append(f"set type {kind} diameter {2 * RADIUS * length * (1.0 if kind == 1 else 0.95)!r} density {material.density * density!r}")
    waves = " ".join(f"v_{c}start" for c in "xyz")
    lines += [f"variable {c}start atom {SPEED * length!r}*sin({k}*id+{k})" for c, k in (("x", 37.1), ("y", 91.7), ("z", 53.3))]
    return "\n".join(lines + [f"velocity all set {waves}"])


def property_lines(variant, damped, pressure=1.0):
    softer = STRETCH**2.5 if variant.model == "hertz" and variant.stretch else 1.0  # F(d/S)/S of Hertz's law
    kinds = (POWDER, GLASS)
    limit = [1e20 if variant.law == "elastic" else m.yield_stress for m in kinds]
    e = RESTITUTION if damped else 1.0
    return "\n".join((
        "fix p1 all property/global youngsModulus peratomtype " + " ".join(repr(m.youngs_modulus / softer * pressure) for m in kinds),
        "fix p2 all property/global poissonsRatio peratomtype " + " ".join(repr(m.poisson_ratio) for m in kinds),
        "fix p3 all property/global yieldStress peratomtype " + " ".join(repr(y * pressure) for y in limit),
        "fix p4 all property/global coefficientFriction peratomtypepair 2 0.3 0.2 0.2 0.4",
        "fix p5 all property/global coefficientRollingFriction peratomtypepair 2 0.1 0.1 0.1 0.1",
        f"fix p6 all property/global coefficientRestitution peratomtypepair 2 {e} {e} {e} {e}"))


def law_words(variant):
    return f"law {LAW_FILES[variant.law]} materials " + ("elastic elastic" if variant.law == "elastic" else "powder glass")


def words(variant, damped):
    """The model's own words: of a pair style, of a wall beside one, of a wall alone."""
    if variant.model == "hertz":
        both = "limitForce on" if damped else ""
        return both, both, both
    loss = -math.log(RESTITUTION) / math.hypot(math.log(RESTITUTION), math.pi)
    law = ""
    if variant.model == "mpm":
        law = law_words(variant) + " "
    damping = f"elasticDamping restitution tangentialDampingRatio {math.sqrt(5 / 6) * loss!r}" if damped else \
        "elasticDamping off tangentialDampingRatio 0"
    stretched = f" stretch {STRETCH:g}" if variant.stretch else ""
    observed = " energy on contactMap on" if variant.energy else ""
    return law + damping + stretched + observed, "wall deformable", law + damping + stretched + " wall deformable"


def output_lines(feature, variant):
    """Thermo values and a dump that are compared; with `energy on` also the energies, in energy.own."""
    columns = "id type x y z vx vy vz omegax omegay omegaz fx fy fz tqx tqy tqz radius mass " + feature.dump
    form = " ".join(["%d %d"] + ["%.14g"] * (len(columns.split()) - 2))
    lines = ["compute rot all erotate/sphere", "variable height atom 9.81*mass*z", "compute height all reduce sum v_height",
             f"thermo_style custom step atoms ke c_rot {feature.columns}", "thermo 100",
             "thermo_modify norm no lost error format float %.12g",
             f"dump state all custom 100 state.txt {columns}", f'dump_modify state sort id format "{form}"']
    if variant.model != "hertz" and variant.energy:
        lines += ["variable held equal ke+c_rot+c_height+f_granulaw[14]", "variable lost equal f_granulaw+f_granulaw[15]-f_granulaw[18]+f_granulaw[19]",
                  "variable waves equal f_granulaw[19]", 'fix own all print 50 "${held} ${lost} ${waves}" file energy.own screen no']
    return "\n".join(lines)


def deck(feature, variant):
    parts = dict(DEFAULT)
    parts["properties"] = property_lines(variant, feature.damped)
    parts["atoms"] = sphere_lines()
    parts["output"] = output_lines(feature, variant)
    parts.update({name: made(variant) if callable(made) else made for name, made in feature.parts.items()})
    pair, wall, alone = (f"{own} {feature.both}".strip() for own in words(variant, feature.damped))
    if variant.model != "hertz" and feature.own:
        pair = f"{pair} {feature.own}"
    text = "\n".join(parts[name] for name in PARTS if parts.get(name)) + "\n"
    text = text.replace("@ALL", text.split("@ALL")[0].replace("clear", "log liggghts.log append"))
    for sign, stands in (("@P", f"model {variant.model} {feature.models}"), ("@M", variant.model), ("@p", pair), ("@w", wall), ("@f", alone)):
        text = text.replace(sign, stands)
    return text


def files(feature):
    return {"plane.stl": plane_stl(half=0.0075), **feature.files}
