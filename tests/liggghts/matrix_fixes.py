"""The matrix's features of particles: fixes (matrix_scene.py: what a part and @P mean)."""
from harness import plane_stl
from matrix_scene import RADIUS, Feature

HALF = "group half id 1:9\n"
HEAT = ("fix h1 all property/global thermalConductivity peratomtype 100.0 50.0\nfix h2 all property/global thermalCapacity peratomtype 10.0 20.0")
HOT = {"run": "run 0\ngroup hot id 1:5\nset group hot property/atom Temp 400.0\nrun 600"}


def fix(name, group="Fixes: forces and motion", **words):
    return Feature(group, name, **words)


def work(name, line, **words):
    """A fix that does work."""
    return fix(name, extra=line, conserved=False, **words)


MOTION = [
    work("fix adapt, diameter", "compute size all property/atom radius\nvariable grown atom 2.0*c_size*1.001\nfix grow all adapt 100 atom diameter v_grown"),
    work("fix addforce", "fix push half addforce 0.1 0.0 0.0", before_atoms="", more_walls=HALF, columns="f_push[1] f_push[2]"),
    work("fix aveforce", "fix push half aveforce 0.1 NULL NULL", more_walls=HALF, columns="f_push[1] f_push[2]"),
    work("fix buoyancy", "fix lift all buoyancy level 0.006 dim z density 1000"),
    work("fix deform", "fix shrink all deform 10 z vel -0.5 remap none", boundary="boundary p p p"),
    work("fix drag", "fix pull all drag 0.0 0.0 0.003 0.05 0.0001", columns="f_pull[1]"),
    work("fix dt/reset", "fix step all dt/reset 50 1e-8 2e-7 1e-6 units box", columns="f_step dt", alike=False, twin=True),
    work("fix efield", "fix field all efield 0.1 0.0 0.0"),
    fix("fix enforce2d (dimension 2)", extra="fix flat all enforce2d", first="dimension 2", boundary="boundary f f p", walls="fix floor all wall/gran @P primitive type 1 yplane -0.0018 @w",
        box="region box block -0.008 0.008 -0.008 0.008 -0.0005 0.0005 units box\ncreate_box 2 box", conserved=False, gravity="",
        atoms="create_atoms 1 single 0.0 0.0 0.0 units box\ncreate_atoms 2 single 0.0035 0.0 0.0 units box\nset type 1 diameter 0.0034 density 1500.0\n"
        "set type 2 diameter 0.0034 density 2500.0\nvelocity all set -1.0 -1.0 0.0\ngroup one id 1\nvelocity one set 1.0 -1.0 0.0"),
    work("fix freeze", "fix held half freeze", more_walls=HALF, columns="f_held[1] f_held[2] f_held[3]"),
    work("fix freeze, neigh_modify exclude of the frozen", "fix held half freeze\nneigh_modify exclude group half half", more_walls=HALF),
    fix("fix gravity changed by fix_modify / variable", gravity="variable g equal 9.81*(1+step)\nfix gravity all gravity v_g vector 0.0 0.0 -1.0", conserved=False),
    fix("fix gravity, chute", gravity="fix gravity all gravity 9.81 chute 24.0", conserved=False),
    work("fix lineforce", "fix line half lineforce 1.0 0.0 0.0", more_walls=HALF),
    work("fix planeforce", "fix plane half planeforce 1.0 0.0 0.0", more_walls=HALF),
    work("fix setforce", "fix set half setforce 0.0 0.0 0.0", more_walls=HALF, columns="f_set[1] f_set[2] f_set[3]"),
    work("fix momentum", "fix still all momentum 50 linear 1 1 0 angular"),
    work("fix move linear", "fix carry half move linear 1.0 0.0 0.0", more_walls=HALF + "group rest subtract all half", integrate="fix integrate rest nve/sphere"),
    work("fix move wiggle", "fix carry half move wiggle 0.0 0.0 0.0002 0.0002", more_walls=HALF + "group rest subtract all half",
         integrate="fix integrate rest nve/sphere"),
    work("fix move rotate", "fix carry half move rotate 0.0 0.0 0.0 0.0 0.0 1.0 0.01", more_walls=HALF + "group rest subtract all half",
         integrate="fix integrate rest nve/sphere"),
    fix("fix nve", integrate="fix integrate all nve", conserved=False),
    fix("fix nve/limit", integrate="fix integrate all nve/limit absolute 0.0001", conserved=False),
    fix("fix nve/noforce", integrate="fix integrate all nve/noforce", conserved=False),
    fix("fix nve/sphere update dipole / no words", integrate="fix integrate all nve/sphere"),
    fix("fix nve/asphere", integrate="fix integrate all nve/asphere", conserved=False, refused=""),
    fix("two groups, two nve/sphere", integrate="group a id 1:9\ngroup b id 10:18\nfix i1 a nve/sphere\nfix i2 b nve/sphere"),
    fix("fix rigid single", more_walls=HALF + "group rest subtract all half", integrate="fix body half rigid single\nneigh_modify exclude group half half\nfix integrate rest nve/sphere",
        columns="f_body[1][1] f_body[1][3]", conserved=False),
    fix("fix rigid group", more_walls="group a id 1 2\ngroup b id 5 6\ngroup rest subtract all a b",
        integrate="fix body all rigid group 2 a b force 1 on on on\nneigh_modify exclude group a a\nneigh_modify exclude group b b\nfix integrate rest nve/sphere",
        columns="f_body[1][1] f_body[2][3]", conserved=False),
    fix("fix rigid molecule", atom_style="atom_style hybrid granular molecular", more_walls="set group all mol 0\ngroup a id 1 2\nset group a mol 1\ngroup b id 5 6\n"
        "set group b mol 2\ngroup bodies union a b\ngroup rest subtract all bodies", conserved=False,
        integrate="fix body bodies rigid molecule\nneigh_modify exclude molecule bodies\nfix integrate rest nve/sphere"),
    fix("fix poems", integrate="group a id 1 2\nfix body a poems group 1 a", conserved=False),
    work("fix spring tether", "fix tie half spring tether 10.0 0.0 0.0 0.003 0.0", more_walls=HALF, columns="f_tie"),
    work("fix spring couple", "group rest subtract all half\nfix tie half spring couple rest 10.0 0.0 0.0 0.003 0.0", more_walls=HALF, columns="f_tie"),
    work("fix spring/self", "fix tie half spring/self 10.0", more_walls=HALF, columns="f_tie"),
    work("fix spring/rg", "fix tie half spring/rg 10.0 0.003", more_walls=HALF),
    work("fix viscous", "fix slow all viscous 0.001"),
]


def observer(name, line, **words):
    return Feature("Fixes: observers and properties", name, extra=line, **words)


OBSERVERS = [
    observer("fix ave/atom", "fix mean all ave/atom 1 50 100 vx fx c_rot1\n".replace(" c_rot1", ""), dump="f_mean[1] f_mean[2]"),
    observer("fix ave/correlate", "fix mean all ave/correlate 10 5 100 c_thermo_temp file mean.txt"),
    observer("fix ave/histo", "fix mean all ave/histo 10 5 100 -3.0 3.0 10 vx vy mode vector file mean.txt"),
    observer("fix ave/spatial", "fix mean all ave/spatial 10 5 100 z lower 0.002 vx density/mass file mean.txt units box"),
    observer("fix ave/time", "", more_output="fix mean all ave/time 10 5 100 c_rot c_height file mean.txt"),
    observer("fix ave/euler", "fix mean all ave/euler nevery 100 cell_size_relative 3.0 parallel yes", run="run 100\ndump euler all euler/vtk 200 euler*.vtk\nrun 500"),
    observer("fix ave/euler/stress", "fix mean all ave/euler/stress nevery 100 cell_size_relative 3.0 parallel no"),
    observer("fix continuum/weighted", "", before_atoms="fix mean all continuum/weighted kernel_radius 0.004 kernel_type Wendland compute stress", dump="f_stressTensor_[1] f_stressTensor_[3]"),
    observer("fix continuum/weighted, stress_strain", "", before_atoms="fix mean all continuum/weighted kernel_radius 0.004 kernel_type Wendland compute stress_strain", dump="f_stressTensor_[1] f_strainTensor_[3]"),
    observer("fix check/timestep/gran", "fix check all check/timestep/gran 50 0.1 0.1", columns="f_check[1] f_check[2] f_check[3]"),
    observer("fix check/timestep/gran, error yes", "fix check all check/timestep/gran 50 0.0001 0.0001 error yes", refused=""),
    observer("fix property/atom, scalar and vector", "fix s all property/atom smell scalar yes yes no 1.0\nfix u all property/atom wind vector yes no no 0.0 1.0 2.0", dump="f_s f_u[2]"),
    observer("fix property/global, vector and matrix", "fix v all property/global some vector 1.0 2.0 3.0\nfix m all property/global other matrix 2 1.0 2.0 3.0 4.0"),
    observer("fix property/atom/tracer", "region low block INF INF INF INF INF 0.003 units box\nfix mark all property/atom/tracer region_mark low mark_step 100 check_mark_every 10",
             columns="f_mark"),
    observer("fix property/atom/timetracer", "fix mark all property/atom/timetracer"),
    observer("fix property/atom/regiontracer/time", "region low block INF INF INF INF INF 0.003 units box\nfix mark all property/atom/regiontracer/time add_region low check_region_every 10", dump="f_mark[1]"),
    observer("fix store/force", "fix kept all store/force", dump="f_kept[1] f_kept[3]"),
    observer("fix store/state", "fix kept all store/state 0 xu yu zu vx", dump="f_kept[1] f_kept[4]"),
    observer("fix print", 'variable k equal ke\nfix say all print 100 "${k}" file said.txt screen no'),
    observer("fix heat/gran", "", more_properties=HEAT, more_walls="fix heat all heat/gran initial_temperature 300.0", **HOT, dump="f_Temp f_heatFlux f_heatSource", columns="f_heat"),
    observer("fix heat/gran/conduction, area_correction", "", more_properties=HEAT + "\nfix h3 all property/global youngsModulusOriginal peratomtype 9.1e10 7e11",
             more_walls="fix heat all heat/gran/conduction initial_temperature 300.0 area_correction yes", twin="plain", **HOT,
             dump="f_Temp f_heatFlux"),
    observer("fix heat/gran/conduction, contact_area projection", "", more_properties=HEAT,
             more_walls="fix heat all heat/gran/conduction initial_temperature 300.0 contact_area projection", **HOT, dump="f_Temp f_heatFlux"),
    observer("fix heat/gran/conduction, contact_area constant", "", more_properties=HEAT,
             more_walls="fix heat all heat/gran/conduction initial_temperature 300.0 contact_area constant 1e-7", **HOT, dump="f_Temp f_heatFlux"),
    observer("fix heat/gran/conduction, store_contact_data", "", more_properties=HEAT,
             more_walls="fix heat all heat/gran/conduction initial_temperature 300.0 store_contact_data yes", **HOT, dump="f_Temp f_heatFlux"),
    observer("fix heat/gran with heating_tracking", "", both="heating_tracking on heating_tangential_history on", more_properties=HEAT,
             more_walls="fix heat all heat/gran initial_temperature 300.0", dump="f_Temp f_heatFlux"),
    observer("fix transportequation/scalar", "", more_walls="fix salty all transportequation/scalar equation_id salt quantity salt default_value 1.0 flux_quantity saltFlux "
             "source_quantity saltSource capacity_quantity none", dump="f_salt"),
    observer("fix region/variable", "region r1 block -0.006 0.006 -0.006 0.006 0.0 0.01 units box\nregion r2 block -0.006 0.006 -0.006 0.006 0.0 0.008 units box\n"
             "fix where all region/variable n_regions 2 times 1e-5 1.0 regions r1 r2"),
    observer("fix diam/max", "fix largest all diam/max"),
    observer("fix_modify energy, virial", "fix_modify gravity energy yes"),
    observer("compute_modify", "compute_modify thermo_temp extra 0 dynamic yes"),
]

TEMPLATES = ("fix t1 all particletemplate/sphere 15485863 atom_type 1 density constant 1500 radius constant 0.0008\n"
             "fix t2 all particletemplate/sphere 15485867 atom_type 2 density constant 2500 radius constant 0.0006\n"
             "fix dist all particledistribution/discrete 32452843 2 t1 0.5 t2 0.5\n")
ABOVE = TEMPLATES + "region above block -0.006 0.006 -0.006 0.006 0.0072 0.0115 units box\n"
INSERT = "fix ins all insert/{} seed 32452867 distributiontemplate dist vel constant 0.0 0.0 -10.0 overlapcheck yes all_in yes {}"
FACE = {"face.stl": plane_stl(0.004, 0.0080)}
STREAM = ABOVE + "fix face all mesh/surface/planar file face.stl type 1\n"
SMALL = "timestep 1e-7"


def insertion(name, *lines, **words):
    return Feature("Insertion, templates, clumps", name, more_walls="\n".join(lines), **{"conserved": False, "alike": False, "time_step": SMALL, "run": "run 1200", **words})


CLUMP = f"{-RADIUS / 2} 0 0 {RADIUS}\n{RADIUS / 2} 0 0 {RADIUS}\n"
CLUMPS = ("fix t1 all particletemplate/multisphere 15485863 atom_type 1 density constant 1500 nspheres 2 ntry 10000 spheres file clump.txt scale 1.0 type 1\n"
          "fix dist all particledistribution/discrete 15485867 1 t1 1.0\nregion above block -0.007 0.007 -0.007 0.007 0.0 0.013 units box\n"
          "fix ins all insert/pack seed 32452843 distributiontemplate dist vel uniform 0. 0. -2.0 2.0 2.0 2.0 insert_every once overlapcheck yes all_in yes "
          "particles_in_region 20 region above")
IN_CLUMPS = dict(atoms="", files={"clump.txt": CLUMP}, time_step="timestep 2e-7", run="run 2000")

INSERTION = [
    insertion("insert/pack", ABOVE, INSERT.format("pack", "insert_every once particles_in_region 10 region above"), columns="f_ins[1] f_ins[2]"),
    insertion("insert/pack, repeated, volumefraction", ABOVE, INSERT.format("pack", "insert_every 200 volumefraction_region 0.03 region above")),
    insertion("insert/rate/region", ABOVE, INSERT.format("rate/region", "nparticles 20 particlerate 100000.0 insert_every 100 region above")),
    insertion("insert/stream", STREAM, INSERT.format("stream", "nparticles 20 particlerate 200000.0 insertion_face face extrude_length 0.003"), files=FACE),
    insertion("insert/stream with property/atom/tracer/stream", STREAM, INSERT.format("stream", "nparticles 20 particlerate 200000.0 insertion_face face extrude_length 0.003"),
              "fix mark all property/atom/tracer/stream mark_step 10 n_tracer 2 insert_stream ins every once", files=FACE),
    insertion("insert, set_property", "fix s all property/atom smell scalar yes yes no 1.0", ABOVE, INSERT.format("pack", "set_property smell 3.0 insert_every once particles_in_region 10 region above"), dump="f_s"),
    insertion("insert, overlapcheck no", ABOVE, INSERT.format("pack", "insert_every once particles_in_region 4 region above").replace("overlapcheck yes", "overlapcheck no"), twin=True),
    insertion("particledistribution/discrete/numberbased", ABOVE.replace("discrete", "discrete/numberbased"), INSERT.format("pack", "insert_every once particles_in_region 10 region above")),
    insertion("particledistribution/discrete/massbased", ABOVE.replace("discrete", "discrete/massbased"), INSERT.format("pack", "insert_every once particles_in_region 10 region above")),
    insertion("unfix of an insertion between runs", ABOVE, INSERT.format("pack", "insert_every once particles_in_region 10 region above"), run="run 300\nunfix ins\nrun 900"),
    insertion("fix multisphere", CLUMPS, integrate="fix integrate all multisphere", **IN_CLUMPS),
    insertion("fix multisphere and computes", CLUMPS, integrate="fix integrate all multisphere", columns="c_kem c_rotm c_most",
              extra="compute kem all ke/multisphere\ncompute rotm all erotate/multisphere\ncompute m all rigid property masstotal\ncompute most all reduce max c_m", **IN_CLUMPS),
    insertion("fix multisphere/break", CLUMPS, integrate="fix one all property/atom one scalar yes yes no 1.0\nfix integrate all multisphere/break allow_group_and_set yes trigger_threshold 0.5 trigger_timeStep 200 trigger_name f_one",
              **IN_CLUMPS),
    insertion("fix multisphere, a clump on a mesh", CLUMPS, integrate="fix integrate all multisphere",
              walls="fix cad all mesh/surface file plane.stl type 1\nfix floor all wall/gran @P mesh n_meshes 1 meshes cad @w", **IN_CLUMPS),
    insertion("particletemplate/multiplespheres", CLUMPS.replace("particletemplate/multisphere", "particletemplate/multiplespheres").replace(" type 1\n", "\n"),
              **{**IN_CLUMPS, "files": {"clump.txt": f"{-RADIUS} 0 0 {RADIUS}\n{RADIUS} 0 0 {RADIUS}\n"}}),
]


def together(name, **words):
    return Feature("Features together", name, **{"conserved": False, **words})


MESH = "fix cad all mesh/surface file plane.stl type 1 {}\nfix floor all wall/gran @P mesh n_meshes 1 meshes cad @w"
HEATED = dict(more_properties=HEAT, dump="f_Temp f_heatFlux")
TOGETHER = [
    together("heat/gran, moving mesh", walls=MESH.format(""), more_walls="fix heat all heat/gran initial_temperature 300.0\nfix move all move/mesh mesh cad wiggle amplitude "
             "0.0 0.0 0.0002 period 0.0002", **HEATED, **HOT),
    together("heat/gran, rolling friction, cohesion", models="tangential history cohesion sjkr2 rolling_friction epsd2", both="heating_tracking on",
             more_walls="fix heat all heat/gran initial_temperature 300.0", dump="f_Temp", **HOT,
             more_properties=HEAT + "\nfix c1 all property/global cohesionEnergyDensity peratomtypepair 2 1e5 1e5 1e5 1e5"),
    together("fix deform, periodic box, heat/gran", boundary="boundary p p p", box="region box block -0.0053 0.0053 -0.00525 0.00525 -0.001 0.0068 units box\ncreate_box 2 box",
             walls="", more_walls="fix heat all heat/gran initial_temperature 300.0\nfix shrink all deform 10 x vel -2.0 y vel -2.0", **HEATED, **HOT),
    together("fix rigid, fix freeze, a moving mesh", walls=MESH.format(""), more_walls="group ice id 17 18\ngroup solid id 1 2 4 5\ngroup rest subtract all solid\n"
             "fix move all move/mesh mesh cad linear 0.0 0.0 2.0\nfix held ice freeze", integrate="fix body solid rigid single\nneigh_modify exclude group solid solid\nfix integrate rest nve/sphere"),
    together("fix multisphere, moving mesh, heat/gran", walls=MESH.format(""), alike=False, **{**IN_CLUMPS, "run": "run 1500"},
             more_walls=CLUMPS + "\nfix heat all heat/gran initial_temperature 300.0\nfix move all move/mesh mesh cad linear 0.0 0.0 0.5",
             integrate="fix integrate all multisphere", **HEATED),
    together("insertion, massflow/mesh that deletes", alike=False, files=FACE, time_step=SMALL, run="run 1200", more_walls="fix face all mesh/surface/planar file face.stl type 1\n" + ABOVE +
             INSERT.format("pack", "insert_every 200 particles_in_region 10 region above") + "\nfix flow all massflow/mesh mesh face vec_side 0.0 0.0 -1.0 count once delete_atoms yes",
             columns="f_flow[1] f_flow[2]", more_output="thermo_modify lost ignore"),
    together("insertion, servo mesh", alike=False, time_step=SMALL, run="run 1200", files={"lid.stl": plane_stl(0.0075, 0.0125)},
             walls="fix cad all mesh/surface file plane.stl type 1\nfix lid all mesh/surface/stress/servo file lid.stl type 2 com 0.0 0.0 0.0125 ctrlPV force axis 0.0 0.0 1.0 "
             "target_val -1.0 vel_max 1.0 kp 5.0\nfix floor all wall/gran @P mesh n_meshes 2 meshes cad lid @w",
             more_walls=ABOVE + INSERT.format("pack", "insert_every once particles_in_region 10 region above"), columns="f_lid[3] f_lid[9]"),
    together("pair_style hybrid of two gran", pair="pair_style hybrid gran @P @p gran model hooke tangential off\npair_coeff 1 1 gran 1\npair_coeff 2 2 gran 1\npair_coeff 1 2 gran 2",
             more_properties="fix v1 all property/global characteristicVelocity scalar 2.0", twin="plain"),
    together("hertz in a hybrid beside the model", pair="pair_style hybrid gran @P @p gran model hertz tangential off\npair_coeff 1 1 gran 1\npair_coeff 2 2 gran 1\npair_coeff 1 2 gran 2", twin="plain"),
    together("respa, rolling friction", refused="does not call fix wall/gran", models="tangential history rolling_friction epsd2", conserved=True,
             time_step="run_style respa 2 2 pair 1\ntimestep 2e-7"),
    together("setforce, freeze, adapt, between runs", run="run 300\ngroup a id 1:9\nfix hold a setforce 0.0 0.0 0.0\nrun 150\nunfix hold\nfix ice a freeze\nrun 150"),
]

FEATURES = MOTION + OBSERVERS + INSERTION + TOGETHER
