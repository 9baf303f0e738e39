"""The matrix's features of contacts: models and keywords of the pair style, of walls, of meshes (matrix_scene.py: what a part and @P mean)."""
import matrix_scene
from harness import plane_stl
from matrix_scene import RADIUS, Feature

SECOND = "fix second all wall/gran @P primitive type 2 {} @w"
MESH_WALL = "fix floor all wall/gran @P mesh n_meshes 1 meshes cad @w"
MESH = "fix cad all mesh/surface file plane.stl type 1 {}\n" + MESH_WALL
STRESS = "fix cad all mesh/surface/stress file plane.stl type 1 {}\n" + MESH_WALL
ROLLING = ("fix r1 all property/global coefficientRollingViscousDamping peratomtypepair 2 0.2 0.2 0.2 0.2\n"
           "fix r2 all property/global coefficientRollingStiffness peratomtypepair 2 0.1 0.1 0.1 0.1\n"
           "fix r4 all property/global coeffRollingStiffness peratomtypepair 2 0.1 0.1 0.1 0.1")
EPSD3 = ROLLING.replace("coefficientRollingStiffness peratomtypepair", "unused peratomtypepair") + "\nfix r5 all property/global rollingStiffness scalar 10.0"
COHESION = "fix c1 all property/global cohesionEnergyDensity peratomtypepair 2 1e5 1e5 1e5 1e5"
LIQUID = ("fix l1 all property/global surfaceLiquidContentInitial scalar 0.01\nfix l2 all property/global surfaceTension scalar 0.072\n"
          "fix l3 all property/global fluidViscosity scalar 0.001\nfix l4 all property/global contactAngle peratomtype 0.1 0.1\n"
          "fix l5 all property/global minSeparationDistanceRatio scalar 1.01\nfix l6 all property/global maxSeparationDistanceRatio scalar 1.1\n"
          "fix l7 all property/global maxLiquidContent scalar 0.1")


def pair(name, models="tangential history", **words):
    return Feature("Contact models and their keywords", name, models, **words)


PAIR = [
    pair("tangential history"),
    pair("tangential off", "tangential off"),
    pair("tangential no_history", "tangential no_history", damped=True),
    pair("damping from coefficientRestitution", damped=True),
    pair("tangential tan_luding", "tangential tan_luding", refused="", more_properties=(
        "fix t1 all property/global FluidViscosity peratomtypepair 2 .3 .3 .3 .3\n"
        "fix t2 all property/global coeffFrictionStiffness peratomtypepair 2 .3 .3 .3 .3\nfix t3 all property/global FrictionViscosity peratomtypepair 2 .3 .3 .3 .3")),
    pair("rolling_friction cdt", "tangential history rolling_friction cdt"),
    pair("rolling_friction epsd", "tangential history rolling_friction epsd", more_properties=ROLLING),
    pair("rolling_friction epsd, torsionTorque on", "tangential history rolling_friction epsd", both="torsionTorque on", more_properties=ROLLING),
    pair("rolling_friction epsd2", "tangential history rolling_friction epsd2"),
    pair("rolling_friction epsd3", "tangential history rolling_friction epsd3", more_properties=EPSD3, refused=""),
    pair("rolling_friction luding", "tangential history rolling_friction luding", more_properties=ROLLING, refused=""),
    pair("cohesion sjkr", "tangential history cohesion sjkr", more_properties=COHESION),
    pair("cohesion sjkr2", "tangential history cohesion sjkr2", more_properties=COHESION),
    pair("cohesion sjkr2, rolling_friction epsd2", "tangential history cohesion sjkr2 rolling_friction epsd2", more_properties=COHESION),
    pair("cohesion easo/capillary/viscous", "tangential history cohesion easo/capillary/viscous", more_properties=LIQUID, refused=""),
    # With the moduli that a stretch stands for stock hertz itself differs between one rank and two, by a quarter of a coordinate: its liquid bridges part at other times.
    pair("cohesion washino/capillary/viscous", "tangential history cohesion washino/capillary/viscous", more_properties=LIQUID, twin="plain"),
    pair("surface default", "tangential history surface default"),
    pair("surface multicontact", "tangential history surface multicontact", refused="",
         more_walls="fix mc all multicontact/halfspace\n"),
    pair("tangential_damping off", both="tangential_damping off"),
    pair("limitForce on", both="limitForce on"),
    pair("heating_tracking on", both="heating_tracking on"),
    pair("heating_tangential_history on", both="heating_tangential_history on"),
    pair("computeElasticPotential on", both="computeElasticPotential on", refused=""),
    pair("computeDissipatedEnergy on", both="computeDissipatedEnergy on", twin=False),
    pair("tangential_reduce on (a word of easo)", both="tangential_reduce on", refused=""),
    pair("an unknown keyword", both="gnalitude on", refused="unknown keyword"),
    pair("pair_style before create_box", before_pair="", first="", **{
        "box": "pair_style gran @P @p\nregion box block -0.01 0.01 -0.008 0.008 -0.002 0.014 units box\ncreate_box 2 box", "pair": "pair_coeff * *"}),
    pair("walls before pair_style", refused="put it behind", pair="", gravity="pair_style gran @P @p\npair_coeff * *\nfix gravity all gravity 9.81 vector 0.0 0.0 -1.0",
         walls="fix floor all wall/gran @P primitive type 1 zplane 0.0 @f"),
    pair("pair_style given twice", pair="pair_style gran @P @p\npair_coeff * *\npair_style gran @P @p\npair_coeff * *"),
    pair("walls only: pair_style hertz", pair="pair_style gran model hertz tangential history\npair_coeff * *",
         walls="fix floor all wall/gran @P primitive type 1 zplane 0.0 @f", conserved=False, twin="plain"),
    pair("pairs only: hertz walls", walls="fix floor all wall/gran model hertz tangential history primitive type 1 zplane 0.0", conserved=False, twin="plain"),
    pair("pair_style none", pair="pair_style none", atom_modify="atom_modify map array sort 0 0", walls="fix floor all wall/gran @P primitive type 1 zplane 0.0 @f", conserved=False),
    pair("pair_style hybrid gran", pair="pair_style hybrid gran @P @p\npair_coeff * * gran"),
    pair("pair_style hybrid/overlay gran soft", pair="pair_style hybrid/overlay gran @P @p soft 0.001\npair_coeff * * gran\npair_coeff * * soft 0.0",
         conserved=False),
]


def wall(name, **words):
    return Feature("Walls (fix wall/gran)", name, **words)


FLOOR = "fix floor all wall/gran @P primitive type 1 zplane 0.0 {} @w"
NEAR = "neighbor 0.0004 bin\nneigh_modify delay 0"  # stock hertz with contact_distance_factor 1.01 takes the root of a negative area at walls: no number
HEAT = ("fix h1 all property/global thermalConductivity peratomtype 100.0 50.0\nfix h2 all property/global thermalCapacity peratomtype 10.0 20.0")
STORED = "fix floor all wall/gran @P primitive type 1 zplane 0.0 {} @w"
CYLINDER = "fix tube all wall/gran @P primitive type 2 {} @w"
WALL = [
    wall("primitive xplane, yplane", more_walls=SECOND.format("xplane -0.00525") + "\nfix third all wall/gran @P primitive type 1 yplane 0.00525 @w"),
    wall("primitive zcylinder", more_walls=CYLINDER.format("zcylinder 0.00662 0.0 0.0")),
    wall("primitive xcylinder", more_walls=CYLINDER.format("xcylinder 0.0059 0.0 0.004")),
    wall("primitive ycylinder", more_walls=CYLINDER.format("ycylinder 0.0059 0.004 0.0")),
    wall("zcylinder with a sphere on its axis", more_walls=CYLINDER.format("zcylinder 0.00662 0.0 0.0"),
         before_atoms="create_atoms 1 single 0.0 0.0 0.012 units box\nset group all diameter 0.0034 density 1500.0"),
    # not conserved: the wall's force turns round at the axis, within a step
    wall("a sphere that fills a zcylinder", conserved=False, more_walls=CYLINDER.format("zcylinder 0.00169 0.0 0.0"), walls="", gravity="", before_atoms="",
         atoms=f"create_atoms 1 single 0.0 0.0 0.005 units box\nset group all diameter {2 * RADIUS!r} density 1500.0\nvelocity all set 0.0 0.0 -1.0"),
    wall("shear", walls=FLOOR.format("shear x 1.0"), conserved=False),
    wall("shear of a zcylinder", more_walls=CYLINDER.format("zcylinder 0.00662 0.0 0.0 shear x 1.0"), conserved=False),
    wall("store_force yes", walls=STORED.format("store_force yes"), dump="f_force_floor[1] f_force_floor[2] f_force_floor[3]"),
    wall("store_force_contact yes", walls=STORED.format("store_force_contact yes")),
    wall("store_force_contact_every 10", walls=STORED.format("store_force_contact yes store_force_contact_every 10")),
    wall("store_force_contact_stress yes", walls=STORED.format("store_force_contact_stress yes")),
    wall("track_energy", walls=STORED.format("track_energy")),
    wall("temperature (fix heat/gran)", neighbor=NEAR, walls=STORED.format("temperature 400.0"), more_properties=HEAT,
         more_walls="fix heat all heat/gran initial_temperature 300.0", dump="f_Temp f_heatFlux", columns="f_heat"),
    wall("temperature, contact_area overlap", neighbor=NEAR, walls=STORED.format("temperature 400.0 contact_area overlap"), more_properties=HEAT,
         more_walls="fix heat all heat/gran/conduction initial_temperature 300.0", dump="f_Temp f_heatFlux"),
    wall("temperature, contact_area projection", neighbor=NEAR, walls=STORED.format("temperature 400.0 contact_area projection"), more_properties=HEAT,
         more_walls="fix heat all heat/gran/conduction initial_temperature 300.0", dump="f_Temp f_heatFlux"),
    wall("temperature, contact_area constant", neighbor=NEAR, walls=STORED.format("temperature 400.0 contact_area constant 1e-7"), more_properties=HEAT,
         more_walls="fix heat all heat/gran/conduction initial_temperature 300.0", dump="f_Temp f_heatFlux"),
    wall("two floors at one height", more_walls=SECOND.format("zplane 0.0")),
    wall("a wall for one group", walls="group first id 1:9\nfix floor first wall/gran @P primitive type 1 zplane 0.0 @w"),
    wall("unfix, and a wall anew, between runs", run="run 300\nunfix floor\nfix floor all wall/gran @P primitive type 1 zplane 0.0 @w\nrun 300", conserved=False),
    wall("a wall added between runs", walls="", run="run 100\nfix floor all wall/gran @P primitive type 1 zplane 0.0 @w\nrun 500", conserved=False),
    wall("the model's words before the wall's", walls="fix floor all wall/gran @P @w primitive type 1 zplane 0.0", refused="must stand before"),
    wall("fix wall/reflect", more_walls="fix reflect all wall/reflect zlo 0.002 units box", conserved=False),
    wall("fix wall/region", more_walls="fix bounds all wall/region box harmonic 100.0 1.0 0.003", columns="f_bounds", conserved=False),
]


SERVO = 1e-2  # a controller that pushes with what it measures makes more of a difference than a collision


def mesh(name, **words):
    return Feature("Meshes", name, **words)


def lid(extra):
    """A second plane, above, that can move: one fix wall/gran takes both."""
    return ("fix cad all mesh/surface file plane.stl type 1\nfix lid all " + extra +
            "\nfix floor all wall/gran @P mesh n_meshes 2 meshes cad lid @w")


LID = lid("mesh/surface file lid.stl type 2")
LID_FILE = {"lid.stl": plane_stl(0.0075, 0.00695)}
MESH_STRESS = ("f_cad[1] f_cad[2] f_cad[3] f_cad[4] f_cad[5] f_cad[6]")


def moving(name, style, **words):
    return mesh("fix move/mesh " + name, walls=LID, files=LID_FILE, conserved=False, more_walls="fix move all move/mesh mesh lid " + style,
                columns="f_lid[1] f_lid[2] f_lid[3]" if words.pop("centre", False) else "", **words)


MESHES = [
    mesh("mesh/surface", walls=MESH.format("")),
    mesh("mesh/surface/planar", walls=MESH.format("").replace("mesh/surface", "mesh/surface/planar", 1)),
    mesh("scale, move, rotate", walls=MESH.format("scale 0.9 move 0.0 0.0 0.0001 rotate axis 1.0 0.0 0.0 angle 1.0"), conserved=True),
    mesh("curvature, precision, heal", walls=MESH.format("heal auto_remove_duplicates precision 1e-9 curvature 10.0")),
    mesh("temperature (fix heat/gran)", neighbor=NEAR, walls=MESH.format("temperature 400.0"), more_properties=HEAT,
         more_walls="fix heat all heat/gran initial_temperature 300.0", dump="f_Temp f_heatFlux"),
    mesh("surface_vel", walls=MESH.format("surface_vel 1.0 0.0 0.0"), conserved=False),
    mesh("surface_ang_vel", walls=MESH.format("surface_ang_vel origin 0.0 0.0 0.0 axis 0.0 0.0 1.0 omega 100.0"), conserved=False),
    mesh("mesh/surface/stress", walls=STRESS.format("reference_point 0.0 0.0 0.0"), columns=MESH_STRESS),
    mesh("mesh/surface/stress, wear finnie", walls=STRESS.format("wear finnie"), columns=MESH_STRESS,
         more_properties="fix w1 all property/global k_finnie peratomtypepair 2 1.0 1.0 1.0 1.0",
         more_output="dump surface all mesh/gran/VTK 200 mesh*.vtk stress wear cad"),
    mesh("mesh/surface/stress/servo, force", tolerance=SERVO, run="run 300", walls=lid("mesh/surface/stress/servo file lid.stl type 2 com 0.0 0.0 0.00695 ctrlPV force axis 0.0 0.0 1.0 "
                                                      "target_val -1.0 vel_max 1.0 kp 5.0"), files=LID_FILE, conserved=False,
         columns="f_lid[1] f_lid[2] f_lid[3] f_lid[7] f_lid[8] f_lid[9]"),
    mesh("mesh/surface/stress/servo, mode auto", tolerance=SERVO, run="run 300", walls=lid("mesh/surface/stress/servo file lid.stl type 2 com 0.0 0.0 0.00695 ctrlPV force axis 0.0 0.0 1.0 "
                                                          "target_val -1.0 vel_max 1.0 ratio 0.01 mode auto"), files=LID_FILE, conserved=False,
         columns="f_lid[1] f_lid[2] f_lid[3] f_lid[7] f_lid[8] f_lid[9]"),
    mesh("mesh/surface/stress/servo, torque", tolerance=SERVO, run="run 300", walls=lid("mesh/surface/stress/servo file lid.stl type 2 com 0.0 0.0 0.00695 ctrlPV torque axis 0.0 0.0 1.0 "
                                                       "target_val 0.001 vel_max 1.0 kp 5.0"), files=LID_FILE, conserved=False),
    moving("linear", "linear 0.0 0.0 -2.0"),
    moving("linear/variable", "linear/variable v_zero v_zero v_down", before_pair="variable zero equal 0.0\nvariable down equal -2.0"),
    moving("wiggle", "wiggle amplitude 0.0 0.0 -0.0002 period 0.0002"),
    moving("riggle", "riggle origin 0.0 0.0 0.00695 axis 1.0 0.0 0.0 period 0.0002 amplitude 1.0"),
    moving("rotate", "rotate origin 0.0 0.0 0.00695 axis 0.0 0.0 1.0 period 0.01"),
    moving("rotate/variable", "rotate/variable origin 0.0 0.0 0.00695 axis 0.0 0.0 1.0 omega v_turn", before_pair="variable turn equal 500.0"),
    moving("viblin", "viblin axis 0.0 0.0 1.0 order 2 amplitude 0.0001 0.0001 phase 0.0 0.3 period 0.0002 0.0001"),
    moving("vibrot", "vibrot origin 0.0 0.0 0.00695 axis 0.0 0.0 1.0 order 2 amplitude 0.05 0.02 phase 0.0 0.3 period 0.0002 0.0001"),
    mesh("two meshes of two types in one wall", walls=LID, files=LID_FILE),
    mesh("two mesh walls", walls=LID.replace("n_meshes 2 meshes cad lid", "n_meshes 1 meshes cad") +
         "\nfix top all wall/gran @P mesh n_meshes 1 meshes lid @w", files=LID_FILE, refused="More than one wall of type 'mesh'"),
    mesh("a mesh and a primitive wall", walls=LID.replace("n_meshes 2 meshes cad lid", "n_meshes 1 meshes lid"), files=LID_FILE,
         more_walls=SECOND.format("zplane 0.0")),
    mesh("store_force yes", walls=MESH.format("").replace("@w", "store_force yes @w"), dump="f_force_floor[1] f_force_floor[2] f_force_floor[3]"),
    mesh("store_force_contact yes", walls=MESH.format("").replace("@w", "store_force_contact yes @w")),
    mesh("store_force_contact_stress yes", walls=MESH.format("").replace("@w", "store_force_contact_stress yes @w")),
    mesh("extrude_planar", walls="fix base all mesh/surface file plane.stl type 1 extrude_planar 0.0015\nrun 0\nfix sides all mesh/surface fix base type 1\n"
         "fix floor all wall/gran @P mesh n_meshes 2 meshes base sides @w"),
    mesh("fix massflow/mesh", walls=FLOOR.format("") + "\nfix face all mesh/surface/planar file face.stl type 1",
         files={"face.stl": plane_stl(0.0075, 0.0035)}, more_walls="fix flow all massflow/mesh mesh face vec_side 0.0 0.0 -1.0 count multiple",
         columns="f_flow[1] f_flow[2] f_flow[3] f_flow[4]"),
    mesh("fix massflow/mesh, delete_atoms yes", walls=FLOOR.format("") + "\nfix face all mesh/surface/planar file face.stl type 1",
         files={"face.stl": plane_stl(0.0075, 0.0035)}, conserved=False, columns="f_flow[1] f_flow[2]",
         more_walls="fix flow all massflow/mesh mesh face vec_side 0.0 0.0 -1.0 count once delete_atoms yes"),
    mesh("fix massflow/mesh/sieve", walls=FLOOR.format("") + "\nfix face all mesh/surface/planar file face.stl type 1",
         files={"face.stl": plane_stl(0.0075, 0.0035)}, conserved=False, columns="f_flow[1] f_flow[2]", alike=False,
         more_walls="fix flow all massflow/mesh/sieve mesh face point_at_outlet 0.0 0.0 -0.001 count once sieveSize 0.002 sieveSpacing 0.0025 "
         "sieveStiffness 1e4 sieveDamping 1.0"),
    mesh("module liquidtransfer", walls=MESH.format("wall_thickness 0.001 initial_liquid_content 1e-9").replace("mesh/surface", "mesh/surface/liquidtransfer", 1)),
]

def own(name, **words):
    return Feature("The models' own words and fixes", name, **words)


def only_ours(line, stock=""):
    """A part that stock hertz does not know."""
    return lambda variant: stock if variant.model == "hertz" else line


def other_walls(variant):
    """Walls of the other of the two models."""
    if variant.model == "hertz":
        return FLOOR.format("")
    other = "thornton" if variant.model == "mpm" else "mpm"
    words = matrix_scene.law_words(variant) if other == "mpm" else ""
    return f"fix floor all wall/gran model {other} tangential history primitive type 1 zplane 0.0 {words} wall deformable"


AGAIN = "run 300\npair_style gran @P @p {}\npair_coeff * *\nrun 300"
OWN = [
    own("tangentialStiffness computed", own="tangentialStiffness computed"),
    own("beyondRange (mpm), stats FILE", own="stats found.json", skip=("found.json",)),
    own("fix granulaw/stats of the deck", before_atoms=only_ours("fix books all granulaw/stats file found.json every 100"), skip=("found.json",), conserved=False,
        output=lambda variant: matrix_scene.output_lines(Feature("", ""), variant).replace("f_granulaw", "f_books")),
    own("unfix of fix granulaw/stats between runs", conserved=False, run=only_ours("run 300\nunfix own\nunfix granulaw\nrun 300", "run 300\nrun 300"),
        output=lambda variant: matrix_scene.output_lines(Feature("", ""), variant) + ("" if variant.energy else "\nfix own all print 600 OWN")),
    own("unfix of fix granulaw/runaway between runs", run=only_ours("run 300\nunfix granulaw_runaway\nrun 300", "run 300\nrun 300")),
    own("walls of the other model", walls=other_walls, tolerance=1e-4),
    own("energy on from the second run on", refused="put it behind", run=lambda variant: AGAIN.format("" if variant.model == "hertz" or variant.energy else "energy on contactMap on"), conserved=False),
    own("law and materials repeated at the wall", walls=FLOOR.format("").replace("@w", "@f")),
    own("stretch at the wall only", walls=lambda variant: FLOOR.format("") + ("" if variant.model == "hertz" or variant.stretch else " stretch 2"), twin=False),
    own("timestep 0", time_step="timestep 0.0", conserved=False),
    own("spinning spheres", more_walls="set group all omegax 1000.0 omegay -500.0 omegaz 300.0"),
    own("fast impacts", more_walls="variable fast atom 8.0*sin(17*id)\nvelocity all set v_fast v_fast NULL", time_step="timestep 5e-8"),
]

FEATURES = OWN + PAIR + WALL + MESHES
