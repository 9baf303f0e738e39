"""The matrix's dimension between two runs: what every command of the manual does to the histories of open contacts.

A bed pressed between walls runs on as if it had not been stopped: 64 spheres of two materials in a box of five primitive walls and a mesh as
its lid, with friction, without damping. COMMANDS has every command of the manual ("List of all commands"), with lines that leave the bed as it
is, or the reason why it cannot stand between two runs. A pair of lines names two ways to the same bed: they must agree."""
import math

from harness import GLASS, POWDER, plane_stl
from matrix_runs import COMPUTES

RADIUS = 1.7e-3
SPACING = 0.996 * 2 * RADIUS  # pressed: overlaps of 0.4 % of the diameter, beyond the yield of powder
SIDE = 4
HALF = SIDE / 2 * SPACING
TOP = SIDE * SPACING
STEP = 1e-7        # s; 80 steps in the shortest contact
BEFORE, AFTER = 100, 150
ROOM = HALF + 2 * RADIUS

FIRST = "units si\nhard_particles yes\natom_style granular\natom_modify map array\nboundary f f f\nnewton off\ncommunicate single vel yes\nprocessors * 1 1\n"
NEIGHBOR = "neighbor 0.0004 bin\nneigh_modify delay 0\n"


def lid_stl():
    """A plane of two triangles whose common edge runs between the spheres: on such an edge stock LIGGGHTS depends on the order of the triangles, which ranks change."""
    a, b, c, d = ((x * 2.5 * SPACING, (y * 2.5 + 0.5) * SPACING, TOP) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)))
    facets = ["facet normal 0 0 1\nouter loop\n" + "".join("vertex {:.9g} {:.9g} {:.9g}\n".format(*v) for v in triangle) + "endloop\nendfacet\n" for triangle in ((a, b, c), (a, c, d))]
    return "solid lid\n" + "".join(facets) + "endsolid lid\n"


FILES = {"lid.stl": lid_stl(), "far.stl": plane_stl(RADIUS, TOP + 6 * RADIUS), "include.deck": "variable included equal 1\n"}
COLUMNS = "id type x y z vx vy vz omegax omegay omegaz"
FORM = " ".join(["%d %d"] + ["%.17g"] * (len(COLUMNS.split()) - 2))


def words(model, more=""):
    law = "law powder.h5 materials powder glass " if model == "mpm" else ""
    return "" if model == "hertz" else f"{law}elasticDamping off tangential_damping off {more}"


def properties():
    kinds = (POWDER, GLASS)
    return ("fix p1 all property/global youngsModulus peratomtype " + " ".join(repr(m.youngs_modulus) for m in kinds) +
            "\nfix p2 all property/global poissonsRatio peratomtype " + " ".join(repr(m.poisson_ratio) for m in kinds) +
            "\nfix p3 all property/global yieldStress peratomtype " + " ".join(repr(m.yield_stress) for m in kinds) +
            "\nfix p4 all property/global coefficientFriction peratomtypepair 2 0.3 0.2 0.2 0.4"
            "\nfix p6 all property/global coefficientRestitution peratomtypepair 2 1.0 1.0 1.0 1.0\n")


def rules(model, wall_model=None, more="", mesh=True):
    """Everything that must be said again behind read_restart. `mesh`: of the lid; else it is a plane, as `neighbor ... nsq` needs."""
    wall_model = wall_model or model
    own = words(wall_model) if wall_model != model else ""
    wall = f"wall/gran model {wall_model} tangential history"
    ours = "wall deformable" if wall_model != "hertz" else "tangential_damping off"
    text = properties() + f"pair_style gran model {model} tangential history {words(model, more) or 'tangential_damping off'}\npair_coeff * *\n"
    for name, plane in (("floor", "zplane 0.0"), ("west", f"xplane {-HALF!r}"), ("east", f"xplane {HALF!r}"), ("south", f"yplane {-HALF!r}"), ("north", f"yplane {HALF!r}")):
        text += f"fix {name} all {wall} primitive type 1 {plane} {own}{ours}\n"
    lid = "mesh n_meshes 1 meshes cad" if mesh else f"primitive type 2 zplane {TOP!r}"
    return text + ("fix cad all mesh/surface file lid.stl type 2\n" f"fix lid all {wall} {lid} {own}{ours}\n" f"fix i all nve/sphere\ntimestep {STEP!r}\nthermo_modify lost error\n")


def spheres():
    lines = []
    for k in range(SIDE**3):
        cell = (k % SIDE, k // SIDE % SIDE, k // SIDE**2)
        x = [(c + 0.5 - SIDE / 2) * SPACING + 0.002 * RADIUS * math.sin(17.0 * k + 5.0 * a) for a, c in enumerate(cell)]
        lines.append(f"create_atoms {k % 2 + 1} single {x[0]!r} {x[1]!r} {x[2] + SIDE / 2 * SPACING!r} units box")
    for kind, material in ((1, POWDER), (2, GLASS)):
        lines.append(f"set type {kind} diameter {2 * RADIUS!r} density {material.density!r}")
    lines += [f"variable {c}start atom 1.0*sin({k}*id+{k})" for c, k in (("x", 37.1), ("y", 91.7), ("z", 53.3))]
    return "\n".join(lines) + "\nvelocity all set v_xstart v_ystart v_zstart\n"


def bed():
    return (FIRST + f"region box block {-ROOM!r} {ROOM!r} {-ROOM!r} {ROOM!r} {-2 * RADIUS!r} {TOP + 16 * RADIUS!r} units box\ncreate_box 2 box\n" + NEIGHBOR)


def state(file):
    return f'write_dump all custom {file} {COLUMNS} modify sort id format "{FORM}"\n'


def start(model, **more):
    return bed() + rules(model, **more) + spheres()


def again(model, restart, **more):
    return FIRST + f"read_restart {restart}\n" + NEIGHBOR + rules(model, **more)


# computes that LIGGGHTS refuses with every gran model, or between two runs
REFUSED = ("gran/local", "coord/gran", "group/group", "property/local", "voronoi")
OWN_COMPUTES = [feature for feature in COMPUTES if not {"walls", "atom_style", "more_properties"} & set(feature.parts)
                and not any(word in feature.name for word in REFUSED)]
NOWHERE = f"{3 * RADIUS!r} {3 * RADIUS!r} {TOP + 12 * RADIUS!r}"  # above the lid
LOWEST = "group low id 1:5\n"
TEMPLATE = ("fix t1 all particletemplate/sphere 15485863 atom_type 1 density constant 1500 radius constant 0.0008\n"
            "fix dist all particledistribution/discrete 32452843 1 t1 1.0\n"
            f"region above block {-2 * RADIUS!r} {2 * RADIUS!r} {-2 * RADIUS!r} {2 * RADIUS!r} {TOP + 8 * RADIUS!r} {TOP + 14 * RADIUS!r} units box\n"
            "fix ins all insert/pack seed 32452867 distributiontemplate dist vel constant 0. 0. 0. overlapcheck yes all_in yes {} region above\n")

# command: why it cannot stand between two runs (a sentence), or rows of lines; a pair of lines are two ways to one bed
COMMANDS = {
    "atom_modify": ["atom_modify sort 1 0.004", "atom_modify sort 0 0.0"],
    "atom_style": "before the box",
    "bond_coeff": "no bonds are built",
    "bond_style": "no bonds are built",
    "boundary": "before the box",
    "box": "before the box",
    "change_box": [f"change_box all z final {-2 * RADIUS!r} {TOP + 20 * RADIUS!r} units box", f"change_box all x final {-1.3 * ROOM!r} {1.3 * ROOM!r} units box"],
    "clear": "ends the simulation",
    "communicate": ["communicate single cutoff 0.008 vel yes", "communicate multi vel yes"],
    "compute": [f.parts["extra"] for f in OWN_COMPUTES if f.parts.get("extra")] + ["compute c all contact/atom\nuncompute c"],
    "compute_modify": ["compute_modify thermo_temp extra 0 dynamic yes"],
    "create_atoms": [f"create_atoms 1 single {NOWHERE} units box\ngroup new id 65\nset group new diameter 0.003 density 1500.0"],
    "create_box": "before the box",
    "delete_atoms": [("delete_atoms group low compress yes", "delete_atoms group low compress no"),
                     ("delete_atoms group low compress yes\ndelete_atoms group top compress yes", "delete_atoms group low compress no\ndelete_atoms group top compress no"),
                     ("delete_atoms group top compress yes", "delete_atoms group top compress no"),
                     ("delete_atoms overlap 0.0001 all all compress yes", ""),
                     (f"delete_atoms group top compress no\ncreate_atoms 1 single {NOWHERE} units box\ngroup new id 60\nset group new diameter 0.003 density 1500.0",
                      "delete_atoms group top compress no")],
    "delete_bonds": "no bonds are built",
    "dielectric": ["dielectric 1.0"],
    "dimension": "before the box",
    "displace_atoms": ["displace_atoms all move 0.0 0.0 0.0 units box", "group none id 1\ndisplace_atoms none move 0.0 0.0 0.0 units box"],
    "dump": ["dump d all custom 100 d.txt id x vx", "dump d all custom 100 d.txt id x\nundump d"],
    "dump_modify": ["dump d all custom 100 d.txt id x\ndump_modify d first yes every 50"],
    "echo": ["echo none"],
    "fix": ["fix mean all ave/time 10 5 50 c_thermo_temp", "fix mean all ave/atom 1 50 50 vx", "fix mean all ave/histo 10 5 50 -3.0 3.0 10 vx mode vector",
            "fix mean all ave/spatial 10 5 50 z lower 0.002 vx units box", "fix mean all ave/euler nevery 50 cell_size_relative 3.0 parallel yes",
            "fix check all check/timestep/gran 50 0.9 0.9", "fix s all property/atom smell scalar yes yes no 1.0",
            "fix v all property/global some vector 1.0 2.0", "fix kept all store/force", "fix kept all store/state 0 xu vx", "fix push all addforce 0.0 0.0 0.0",
            "fix slow all viscous 0.0", "fix set all setforce NULL NULL NULL", "fix g all gravity 0.0 vector 0.0 0.0 -1.0", 
            f"variable d equal {2 * RADIUS!r}\nfix same all adapt 10 atom diameter v_d", "fix largest all diam/max",
            "fix up all wall/gran @WALL primitive type 1 zplane 0.026 @OURS", "fix other all mesh/surface file far.stl type 2",
            "unfix i\nfix i all nve/sphere", "region low block INF INF INF INF INF 0.003 units box\nfix mark all property/atom/tracer region_mark low mark_step 10 check_mark_every 10",
            "variable k equal ke\nfix say all print 50 \"${k}\" screen no",
            TEMPLATE.format("insert_every once particles_in_region 4"),
            TEMPLATE.format("insert_every 100 particles_in_region 2"),
            ("delete_atoms group low compress no\n" + TEMPLATE.format("compress_tags yes insert_every once particles_in_region 4"), "delete_atoms group low compress no"),
            "fix move all move/mesh mesh cad linear 0.0 0.0 0.0", "fix pull all drag 0.0 0.0 0.0 0.0 0.0001"],
    "fix_modify": ["fix_modify i energy yes"],
    "group": ["group some id 1:9\ngroup others subtract all some"],
    "if": ['if "1 > 0" then "print YES" else "print NO"'],
    "include": ["include include.deck"],
    "info": ["info system"],
    "jump": ["jump SELF here\nprint never\nlabel here"],
    "label": ["label somewhere"],
    "lattice": ["lattice none 1.0"],
    "log": ["log other.log"],
    "mass": "spheres have densities",
    "neigh_modify": ["neigh_modify one 1000", "neigh_modify page 200000", "neigh_modify one 1000 page 10000", "neigh_modify page 200000\nneigh_modify page 300000",
                     "write_restart other.restart\nneigh_modify page 200000", "delete_atoms group none\nneigh_modify one 3000", "neigh_modify one 5000 page 50000",
                     "neigh_modify every 1 delay 0 check no", "neigh_modify binsize 0.002", "neigh_modify contact_distance_factor 1.05",
                     "neigh_modify delay 5", "neigh_modify once no", "neigh_modify exclude group none none"],
    "neigh_settings": "unknown to this LIGGGHTS",
    "neighbor": ["neighbor 0.001 bin", "neighbor 0.0004 nsq\nwrite_restart other.restart\nneighbor 0.0004 bin"],
    "neighbor_skin": "unknown to this LIGGGHTS",
    "newton": "before the box",
    "next": ["variable n loop 2\nnext n"],
    "orient": "unknown to this LIGGGHTS",
    "origin": "unknown to this LIGGGHTS",
    "pair_coeff": ["pair_coeff * *"],
    "pair_style": "deletes the fix that holds all histories of pairs",
    "partition": ["partition yes 1 print HERE"],
    "print": ['print "HERE"'],
    "processors": "before the box",
    "quit": "ends the simulation",
    "read_data": "before the box",
    "read_dump": ["write_dump all custom own.txt id type x y z radius vx vy vz modify format \"%d %d %.17g %.17g %.17g %.17g %.17g %.17g %.17g\"\nread_dump own.txt @NOW x y z radius vx vy vz box no"],
    "read_restart": "before the box",
    "region": ["region there sphere 0.0 0.0 0.0 0.001 units box"],
    "replicate": "LIGGGHTS refuses it where fixes hold values of particles",
    "reset_timestep": ["reset_timestep 0"],
    "restart": ["restart 100 a.restart b.restart"],
    "run": ["run 0", "run 0\nrun 0"],
    "run_style": ["run_style verlet"],
    "set": ["set group all image 0 0 0", f"set group all diameter {2 * RADIUS!r}", "set atom 3 type 1", "set group none type 1"],
    "shell": ["shell true"],
    "thermo": ["thermo 10"],
    "thermo_modify": ["thermo_modify norm no"],
    "thermo_style": ["thermo_style custom step ke"],
    "timestep": [f"timestep {STEP!r}"],
    "uncompute": ["compute c all rdf 10\nuncompute c"],
    "undump": ["dump d all custom 100 d.txt id\nundump d"],
    "unfix": ["fix s all property/atom smell scalar yes yes no 1.0\nunfix s"],
    "units": "before the box",
    "variable": ["variable a equal ke"],
    "velocity": ["velocity all set 0.0 0.0 0.0 sum yes units box"],
    "write_data": ["write_data other.data"],
    "write_dump": ["write_dump all custom other.txt id x"],
    "write_restart": ["write_restart other.restart", "write_restart other.restart\nwrite_restart other.restart"],
}
GROUPS = f"region nothing sphere 0.0 0.0 {TOP + 14 * RADIUS!r} 0.0001 units box\ngroup none region nothing\ngroup top id 60:64\n{LOWEST}"


def rows():
    """(command, lines, lines that they must agree with)."""
    found = []
    for command, what in COMMANDS.items():
        if isinstance(what, str):
            continue
        for lines in what:
            found.append((command, *(lines if isinstance(lines, tuple) else (lines, ""))))
    return found
