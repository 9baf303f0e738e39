"""The matrix's features of output and of the run: computes, dumps, neighbour settings, boundaries, units, run forms, restarts."""

import matrix_scene
from matrix_scene import Feature

BARE = {"neighbor": "neighbor 0.0004 bin\nneigh_modify delay 0"}  # with a contact_distance_factor hertz lists spheres near a wall
LOCAL = "dump local all local 100 local.txt {}"


def compute(name, line, **words):
    return Feature("Computes", "compute " + name, extra=line, **words)


def pair_local(keyword, values, **words):
    columns = " ".join(f"c_l[{k + 1}]" for k in range(6 * 0, values))
    return compute(f"pair/gran/local {keyword}", f"compute l all pair/gran/local {keyword}",
                   more_output=f"{LOCAL.format(columns if values > 1 else 'c_l')}\ndump_modify local format \"{' '.join(['%.12g'] * values)}\"", **words)


def wall_local(keyword, values, **words):
    columns = " ".join(f"c_l[{k + 1}]" for k in range(values))
    return compute(f"wall/gran/local {keyword}", f"compute l all wall/gran/local {keyword}", **{
        **BARE,
        "walls": "fix cad all mesh/surface file plane.stl type 1\nfix floor all wall/gran @P mesh n_meshes 1 meshes cad @w",
        "more_output": f"{LOCAL.format(columns if values > 1 else 'c_l')}\ndump_modify local format \"{' '.join(['%.12g'] * values)}\"", **words})


HEATED = dict(more_properties="fix h1 all property/global thermalConductivity peratomtype 100.0 50.0\nfix h2 all property/global thermalCapacity peratomtype 10.0 20.0",
              more_walls="fix heat all heat/gran/conduction initial_temperature 300.0", run="run 0\ngroup hot id 1:5\nset group hot property/atom Temp 400.0\nrun 600", **BARE)

COMPUTES = [
    pair_local("pos", 6), pair_local("vel", 6), pair_local("id", 3), pair_local("id force", 6), pair_local("id force_normal", 6), pair_local("id force_tangential", 6),
    pair_local("id torque", 6), pair_local("id torque_normal", 6), pair_local("id torque_tangential", 6), pair_local("id contactArea", 4),
    pair_local("id delta", 4), pair_local("id contactPoint", 6), pair_local("id ms_id", 5),
    pair_local("id history", 4, twin=False), pair_local("id heatFlux", 4, **HEATED),
    wall_local("pos", 6), wall_local("vel", 6), wall_local("id", 3), wall_local("id force", 6), wall_local("id force_normal force_tangential", 9), wall_local("id torque", 6),
    wall_local("id contactArea", 4), wall_local("id delta", 4), wall_local("id contactPoint", 6), wall_local("id history", 4, twin=False),
    wall_local("id heatFlux", 4, **{**HEATED, "walls": "fix cad all mesh/surface file plane.stl type 1 temperature 400.0\nfix floor all wall/gran @P mesh n_meshes 1 meshes cad @w"}),
    compute("contact/atom", "compute n all contact/atom\ncompute total all reduce sum c_n", dump="c_n", columns="c_total"),
    compute("contact/atom/gran (hertz counts pairs that have just parted)", "compute n all contact/atom/gran", dump="c_n", twin=False),
    compute("coord/atom", "compute n all coord/atom 0.0036", dump="c_n"),
    compute("coord/gran", "compute n all coord/gran", dump="c_n"),
    compute("cluster/atom", "compute n all cluster/atom 0.003", dump="c_n"),
    compute("centro/atom", "compute n all centro/atom 6", dump="c_n"),
    compute("cna/atom", "compute n all cna/atom 0.003", dump="c_n"),
    compute("com", "compute n all com", columns="c_n[1] c_n[2] c_n[3]"),
    compute("displace/atom", "compute n all displace/atom", dump="c_n[4]"),
    compute("erotate, erotate/sphere/atom", "compute n all erotate/sphere/atom\ncompute m all erotate", dump="c_n", columns="c_m"),
    compute("group/group", "group a id 1:9\ngroup b id 10:18\ncompute n a group/group b", columns="c_n c_n[1] c_n[2] c_n[3]"),
    compute("gyration", "compute n all gyration", columns="c_n c_n[1]"),
    compute("ke, ke/atom", "compute n all ke\ncompute m all ke/atom", columns="c_n", dump="c_m"),
    compute("msd", "compute n all msd", columns="c_n[4]"),
    compute("nparticles/tracer/region", "region low block INF INF INF INF INF 0.004 units box\nfix mark all property/atom/tracer region_mark low mark_step 100 check_mark_every 10\n"
            "compute n all nparticles/tracer/region region_count low tracer mark", columns="c_n[1] c_n[2]"),
    compute("pe, pe/atom", "compute n all pe\ncompute m all pe/atom", columns="c_n", dump="c_m"),
    compute("pressure", "compute n all pressure thermo_temp virial", columns="c_n[1] c_n[2] c_n[3] c_n[4] c_n[5] c_n[6]"),
    compute("property/atom", "compute n all property/atom radius mass omegax", dump="c_n[1] c_n[2] c_n[3]"),
    compute("property/local", "compute n all property/local natom1 natom2", more_output=LOCAL.format("c_n[1] c_n[2]")),
    compute("rdf", "compute n all rdf 10\nfix mean all ave/time 100 1 100 c_n file mean.txt mode vector"),
    compute("reduce/region", "region low block INF INF INF INF INF 0.004 units box\ncompute n all reduce/region low ave vx fx", columns="c_n[1] c_n[2]"),
    compute("reduce of pair/gran/local", "compute l all pair/gran/local delta\ncompute n all reduce max c_l[1]", columns="c_n"),
    compute("slice", "compute c all com\ncompute n all slice 1 3 1 c_c", columns="c_n[1]"),
    compute("stress/atom", "compute n all stress/atom\ncompute m all stress/atom pair", dump="c_n[1] c_n[2] c_n[3] c_n[4] c_m[5] c_m[6]"),
    compute("stress/atom with fix virial of walls", "compute n all stress/atom virial", dump="c_n[3]"),
    compute("temp", "compute n all temp", columns="c_n"),
    compute("voronoi/atom", "compute n all voronoi/atom", dump="c_n[1]"),
    compute("atom/molecule, com/molecule", "compute n all com/molecule", atom_style="atom_style hybrid granular molecular"),
]


def dump(name, line, **words):
    return Feature("Dumps", "dump " + name, more_output=line, **words)


DUMPS = [
    dump("custom", "dump d all custom 200 d.txt id type mol x y z xs ys zs xu yu zu ix iy iz vx vy vz fx fy fz q mux omegax angmomx tqx radius diameter mass density".replace(" mol", "").replace(" q mux", "").replace(" angmomx", "")),
    dump("custom of history and energies", "dump d all custom 200 d.txt id f_floor", refused=None),
    dump("custom/vtk", "dump d all custom/vtk 300 d*.vtk id type x y z vx vy vz fx fy fz radius"),
    dump("custom/vtk, xml", "dump d all custom/vtk 300 d*.vtp id type x y z vx vy vz radius"),
    dump("custom/vtm", "dump d all custom/vtm 300 d*.vtm particle_properties id type x y z vx vy vz radius"),
    dump("atom/vtk", "dump d all atom/vtk 300 d*.vtk"),
    dump("local/gran/vtk", "compute l all pair/gran/local pos id force torque delta contactArea\ndump d all local/gran/vtk 200 d*.vtk l"),
    dump("local/gran/vtk with history", "compute l all pair/gran/local pos vel id force history\ndump d all local/gran/vtk 200 d*.vtp l", twin=False),
    dump("local/gran/vtk of walls", "compute l all wall/gran/local pos id force\ndump d all local/gran/vtk 200 d*.vtk l", **BARE,
         walls="fix cad all mesh/surface file plane.stl type 1\nfix floor all wall/gran @P mesh n_meshes 1 meshes cad @w"),
    dump("mesh/stl", "dump d all mesh/stl 200 d*.stl", walls="fix cad all mesh/surface file plane.stl type 1\nfix floor all wall/gran @P mesh n_meshes 1 meshes cad @w"),
    dump("mesh/vtk", "dump d all mesh/vtk 200 d*.vtk cad id", walls="fix cad all mesh/surface file plane.stl type 1\nfix floor all wall/gran @P mesh n_meshes 1 meshes cad @w"),
    dump("mesh/gran/VTK stress", "dump d all mesh/gran/VTK 200 d*.vtk stress cad",
         walls="fix cad all mesh/surface/stress file plane.stl type 1\nfix floor all wall/gran @P mesh n_meshes 1 meshes cad @w"),
    dump("mesh/vtm", "dump d all mesh/vtm 200 d*.vtm meshes all", walls="fix cad all mesh/surface file plane.stl type 1\nfix floor all wall/gran @P mesh n_meshes 1 meshes cad @w"),
    dump("decomposition/vtk", "dump d all decomposition/vtk 200 d*.vtk"),
    dump("image", "dump d all image 600 d*.ppm type type size 64 64"),
    dump("xyz", "dump d all xyz 200 d.xyz"),
    dump("custom with dump_modify thresh, region, every", "region low block INF INF INF INF INF 0.004 units box\ndump d all custom 100 d.txt id vx fx\ndump_modify d thresh vz < 0.0 region low sort id first yes"),
    dump("undump, write_dump", "dump d all custom 100 d.txt id x\nundump d\n", end="write_dump all custom w.txt id x vx fx modify sort id"),
]


def neighbor(name, line, **words):
    return Feature("Neighbour lists", name, neighbor=line, **words)


FACTOR = "neigh_modify delay 0 contact_distance_factor 1.01"
NEIGHBOR = [
    neighbor("neighbor nsq", f"neighbor 0.0004 nsq\n{FACTOR}"),
    neighbor("neighbor multi", f"neighbor 0.0004 multi\n{FACTOR}", refused=""),
    neighbor("a small skin", f"neighbor 0.00001 bin\n{FACTOR}"),
    neighbor("no skin", f"neighbor 0.0 bin\n{FACTOR}"),
    neighbor("a large skin", f"neighbor 0.003 bin\n{FACTOR}"),
    neighbor("neigh_modify delay 10", "neighbor 0.0004 bin\nneigh_modify delay 10 every 5 contact_distance_factor 1.01"),
    neighbor("neigh_modify every 1 check no", "neighbor 0.0004 bin\nneigh_modify delay 0 every 1 check no contact_distance_factor 1.01"),
    neighbor("neigh_modify once yes", "neighbor 0.003 bin\nneigh_modify delay 0 once yes contact_distance_factor 1.01"),
    neighbor("neigh_modify one 5000 page 50000", "neighbor 0.0004 bin\nneigh_modify delay 0 one 5000 page 50000 contact_distance_factor 1.01"),
    neighbor("neigh_modify one 5000 page 50000, rolling_friction epsd2", "neighbor 0.0004 bin\nneigh_modify delay 0 one 5000 page 50000 contact_distance_factor 1.01",
             models="tangential history rolling_friction epsd2"),
    neighbor("neigh_modify one 200 page 10000", "neighbor 0.0004 bin\nneigh_modify delay 0 one 200 page 10000 contact_distance_factor 1.01"),
    neighbor("neigh_modify binsize", f"neighbor 0.0004 bin\n{FACTOR} binsize 0.002"),
    neighbor("contact_distance_factor 1.3", "neighbor 0.0004 bin\nneigh_modify delay 0 contact_distance_factor 1.3"),
    neighbor("contact_distance_factor not given", "neighbor 0.0004 bin\nneigh_modify delay 0"),
    Feature("Neighbour lists", "exclude type 1 2", extra="neigh_modify exclude type 1 2"),
    Feature("Neighbour lists", "exclude group", extra="group a id 1:9\nneigh_modify exclude group a a"),
    Feature("Neighbour lists", "exclude molecule", atom_style="atom_style hybrid granular molecular", more_walls="set group all mol 1", extra="neigh_modify exclude molecule all"),
    Feature("Neighbour lists", "exclude set between runs", run="run 300\ngroup a id 1:9\nneigh_modify exclude group a a\nrun 300", conserved=False),
    Feature("Neighbour lists", "include group", atom_modify="atom_modify map array first all", extra="neigh_modify include all"),
]


def frame(name, **words):
    return Feature("Units, atoms, boundaries, processors", name, **words)


def cgs(variant):
    return matrix_scene.property_lines(variant, False, pressure=10.0)


CUBE = "region box block -0.01 0.01 -0.008 0.008 -0.002 0.014 units box\ncreate_box 2 box"
NARROW = CUBE.replace("-0.01 0.01 -0.008 0.008", "-0.0053 0.0053 -0.00525 0.00525")
FRAMES = [
    frame("units cgs", units="units cgs", box="region box block -1.0 1.0 -0.8 0.8 -0.2 1.4 units box\ncreate_box 2 box", neighbor="neighbor 0.04 bin\n" + FACTOR,
          properties=cgs, atoms=matrix_scene.sphere_lines(100.0, 1e-3), gravity="fix gravity all gravity 981.0 vector 0.0 0.0 -1.0", conserved=False),
    frame("units lj", units="units lj", refused="units"),
    frame("units micro", units="units micro", refused="units"),
    frame("units real", units="units real", refused=""),
    frame("atom_style sphere", atom_style="atom_style sphere"),
    frame("atom_style hybrid granular molecular", atom_style="atom_style hybrid granular molecular"),
    frame("atom_style hybrid sphere bond/gran (absent)", atom_style="atom_style hybrid granular bond/gran", refused=""),
    frame("atom_style superquadric (absent)", atom_style="atom_style superquadric", refused=""),
    frame("atom_style sph", atom_style="atom_style sph", refused=""),
    frame("atom_style atomic", atom_style="atom_style atomic", refused=""),
    frame("atom_modify map hash", atom_modify="atom_modify map hash"),
    frame("atom_modify sort 100", atom_modify="atom_modify map array sort 100 0.004"),
    frame("atom_modify sort 1", atom_modify="atom_modify map array sort 1 0.004"),
    frame("without atom_modify map", atom_modify=""),
    frame("boundary p p p", boundary="boundary p p p", walls="", box=NARROW.replace("-0.002 0.014", "-0.001 0.0068"), conserved=True, gravity=""),
    frame("boundary p p f, walls", boundary="boundary p p f", box=NARROW),
    frame("boundary m m m", boundary="boundary m m m"),
    frame("boundary s s s", boundary="boundary s s s"),
    frame("boundary fm, lost ignore", boundary="boundary f f fm", more_output="thermo_modify lost ignore"),
    frame("a sphere that leaves, thermo_modify lost ignore", more_output="thermo_modify lost ignore", conserved=False,
          more_walls="group one id 18\nvelocity one set 0.0 0.0 200.0"),
    frame("a sphere that leaves, thermo_modify lost error", conserved=False, refused="", more_walls="group one id 18\nvelocity one set 0.0 0.0 200.0"),
    frame("a triclinic box (on two ranks stock LIGGGHTS does not end)", ranks=(1,), alone=True, box="region box prism -0.01 0.01 -0.008 0.008 -0.002 0.014 0.001 0.0 0.0 units box\ncreate_box 2 box"),
    frame("newton on", newton="newton on", refused=""),
    frame("communicate single vel no", communicate="communicate single vel no", refused=None),
    frame("communicate multi vel yes", communicate="communicate multi vel yes"),
    frame("communicate cutoff", communicate="communicate single vel yes\ncommunicate single cutoff 0.006 vel yes"),
    frame("communicate group", communicate="communicate single group all vel yes"),
    frame("processors 1 * 1", processors="processors 1 * 1"),
    frame("processors * * * grid, numa", processors="processors * * * map xyz"),
    frame("no hard_particles", hard="", refused=""),
    frame("soft_particles yes", hard="soft_particles yes", refused=""),
    frame("package, suffix (absent)", first="suffix on", refused=None),
    frame("dielectric, dimension 3, lattice", first="dimension 3\nlattice none 1.0\ndielectric 1.0"),
    frame("mass (atoms without density)", extra="mass 1 1.0", refused=""),
    frame("change_box", run="run 300\nchange_box all z final -0.002 0.015 units box\nrun 300"),
]


def run(name, **words):
    return Feature("Runs", name, **words)


RUNS = [
    run("run N upto", run="run 300 upto\nrun 600 upto"),
    run("run N every M", run='run 600 every 100 "print HERE"'),
    run("run pre no post no", run="run 300 post no\nrun 300 pre no post no"),
    run("run start stop", run="run 600 start 0 stop 1000"),
    run("run 0, twice", run="run 0\nrun 0\nrun 600"),
    run("run_time", run="run_time 1.2e-4"),
    run("a split run", run="run 1\nrun 299\nrun 300"),
    run("run_style verlet", time_step="run_style verlet\ntimestep 2e-7"),
    run("run_style respa 2 2 pair 1", refused="does not call fix wall/gran", time_step="run_style respa 2 2 pair 1\ntimestep 4e-7", run="run 300"),
    run("run_style respa 2 2 pair 2", refused="does not call fix wall/gran", time_step="run_style respa 2 2 pair 2\ntimestep 2e-7"),
    run("minimize", run="minimize 1e-4 1e-6 10 100", refused="", conserved=False),
    run("timestep changed between runs", run="run 300\ntimestep 1e-7\nrun 300"),
    run("reset_timestep", run="run 300\nreset_timestep 0\nrun 300"),
    run("delete_atoms", kept=True, run="run 300\nregion low block INF INF INF INF INF 0.003 units box\ndelete_atoms region low\nrun 300", conserved=False, alike=False),
    run("delete_atoms compress no", run="run 300\nregion low block INF INF INF INF INF 0.003 units box\ndelete_atoms region low compress no\nrun 300", conserved=False),
    run("delete_atoms overlap", kept=True, run="run 300\ndelete_atoms overlap 0.003 all all\nrun 300", conserved=False, alike=False),
    run("displace_atoms", run="run 300\ndisplace_atoms all move 0.0 0.0 0.0005 units box\nrun 300", conserved=False),
    run("rotate", run="run 300\nrotate 0.0 0.0 0.004 30.0 0.0 0.0 1.0\nrun 300", conserved=False),
    run("set between runs: diameter, density, type", run="run 300\nset atom 3 diameter 0.003 density 1600.0\nset atom 4 type 1\nrun 300", conserved=False),
    run("velocity between runs", run="run 300\nvelocity all scale 1.0 temp NULL\nrun 300".replace("velocity all scale 1.0 temp NULL", "velocity all set 0.0 0.0 -1.0"), conserved=False),
    run("velocity ramp, zero", run="run 300\nvelocity all ramp vx 0.0 1.0 z 0.0 0.008 units box\nvelocity all zero linear\nrun 300", conserved=False, alike=False),
    run("create_atoms between runs", run="run 300\ncreate_atoms 1 single 0.0 0.0 0.011 units box\ngroup new id 19\nset group new diameter 0.003 density 1500.0\nrun 300", conserved=False),
    run("replicate", boundary="boundary f f p", walls="", gravity="replicate 1 1 2 offset 0.0 0.0 0.008 shift 0.0 0.0 0.0", conserved=False, alike=False),
    run("clear and again", run="run 10\nclear\n@ALL", end="run 590"),
    run("variables, if, jump, loops", run="variable n loop 3\nlabel again\nrun 100\nnext n\njump in.deck again\nif \"1 > 0\" then \"run 300\"", alone=True),
    run("log, echo, shell, print, info", run="echo none\nlog none\nshell true\ninfo system\nlog liggghts.log append\nrun 600", twin=True),
    run("group and region styles", before_atoms="region c1 cylinder z 0.0 0.0 0.004 0.0 0.01 units box\nregion c2 sphere 0.0 0.0 0.004 0.003 units box\nregion c3 union 2 c1 c2\n"
        "region c4 cone z 0.0 0.0 0.001 0.004 0.0 0.01 units box\nregion c5 intersect 2 c1 c2\nregion c6 plane 0.0 0.0 0.0 0.0 0.0 1.0 units box",
        more_walls="group g region c3\ngroup h dynamic all\n".replace("group h dynamic all\n", "")),
    run("two spheres at one place", more_walls="create_atoms 1 single 0.0 0.0 0.011 units box\ncreate_atoms 1 single 0.0 0.0 0.011 units box\ngroup new id 19 20\n"
        "set group new diameter 0.003 density 1500.0\n", conserved=False, refused=""),
    run("no particles", atoms="", atom_modify="atom_modify map array sort 0 0", conserved=False),
    run("one particle", atoms="create_atoms 1 single 0.0 0.0 0.0018 units box\nset group all diameter 0.0034 density 1500.0\nvelocity all set 0.3 0.0 -1.0"),
    run("thermo_style one, multi", more_output="thermo_style one\nthermo_style multi\nthermo_modify norm no lost error"),
    run("pair_coeff with numbers", pair="pair_style gran @P @p\npair_coeff 1 1 1.0", refused=""),
    run("pair_style changed between runs", run="run 300\npair_style gran @P @p\npair_coeff * *\nrun 300", conserved=False),
    run("partition", run="partition yes 1 print HERE\nrun 600"),
    run("a sphere between rigid plates", atoms="create_atoms 1 single 0.0 0.0 0.00169 units box\nset group all diameter 0.0034 density 1500.0",
        more_walls="fix top all wall/gran @P primitive type 1 zplane 0.00338 @w"),
]

# The words that must be repeated behind read_restart: everything that is not in the file.
AGAIN = "\n{properties}\n{more}pair_style gran @P @p\npair_coeff * *\n{walls}\nfix gravity all gravity 9.81 vector 0.0 0.0 -1.0\nfix integrate all nve/sphere\ntimestep 2e-7\n"
AFTER = "compute rot all erotate/sphere\nthermo_style custom step atoms ke c_rot\nthermo 100\nthermo_modify norm no format float %.12g\n" \
        "dump state all custom 100 after.txt id type x y z vx vy vz fx fy fz tqx tqy tqz\n" \
        "dump_modify state sort id format \"%d %d %.14g %.14g %.14g %.14g %.14g %.14g %.14g %.14g %.14g %.14g %.14g %.14g\"\nrun 300\n"
START = "clear\nunits si\nhard_particles yes\natom_style granular\natom_modify map array\nboundary f f f\nnewton off\ncommunicate single vel yes\n"
FLOOR = "fix floor all wall/gran @P primitive type 1 zplane 0.0 @w"
MESH_FLOOR = "fix cad all mesh/surface file plane.stl type 1\nfix floor all wall/gran @P mesh n_meshes 1 meshes cad @w"


def again(read, floor=FLOOR, before="run 300\nwrite_restart half.restart\n", start=START, more="", **change):
    """A run, a restart file, and the rest of the run from it."""
    def text(variant):
        lines = before + start + read + "\nneighbor 0.0004 bin\nneigh_modify delay 0 contact_distance_factor 1.01" + AGAIN.format(
            properties=matrix_scene.property_lines(variant, False), walls=floor, more=more) + AFTER
        for old, new in change.get("swap", ()):
            head, tail = lines.split("clear\n")
            lines = head + "clear\n" + tail.replace(old, new)
        return lines
    return text


def restart(name, **words):
    return Feature("Restarts and data files", name, **{"conserved": False, **words})


RESTARTS = [
    restart("write_restart, read_restart", run=again("read_restart half.restart")),
    restart("read_restart, mesh wall", walls=MESH_FLOOR, run=again("read_restart half.restart", MESH_FLOOR)),
    restart("restart N a b", kept=True, run=again("read_restart b.restart", before="restart 150 a.restart b.restart\nrun 300\n")),
    restart("restart N file.*", kept=True, run=again("read_restart half.300.restart", before="restart 150 half.*.restart\nrun 300\n")),
    restart("read_restart without pair_style", run="run 300\nwrite_restart half.restart\n" + START + "read_restart half.restart\ntimestep 2e-7\nrun 100", refused=""),
    restart("read_restart, rolling_friction epsd2", models="tangential history rolling_friction epsd2", run=again("read_restart half.restart")),
    restart("read_restart, another tangential model", run=again("read_restart half.restart", swap=(("@P", "model @M tangential off"),)), refused=""),
    restart("read_restart, another number of history values", models="tangential off", run=again("read_restart half.restart", swap=(("@P", "model @M tangential history"),)), refused=""),
    restart("read_restart, another wall id", run=again("read_restart half.restart", FLOOR.replace("fix floor", "fix ground"))),
    restart("write_data, read_data", run=again("read_data half.data", before="run 300\nwrite_data half.data\n"), skip=("half.data",)),
    restart("read_dump", run="dump d all custom 100 d.txt id type x y z radius vx vy vz\nrun 300\nrun 50\nread_dump d.txt 300 x y z radius vx vy vz box no\nrun 300"),
    restart("read_restart with heat/gran", more_properties="fix h1 all property/global thermalConductivity peratomtype 100.0 50.0\nfix h2 all property/global thermalCapacity peratomtype 10.0 20.0",
            more_walls="fix heat all heat/gran initial_temperature 300.0", dump="f_Temp",
            run=again("read_restart half.restart", more="fix h1 all property/global thermalConductivity peratomtype 100.0 50.0\n"
                      "fix h2 all property/global thermalCapacity peratomtype 10.0 20.0\nfix heat all heat/gran initial_temperature 300.0\n", before="run 0\ngroup hot id 1:5\nset group hot property/atom Temp 400.0\nrun 300\nwrite_restart half.restart\n")),
]

FEATURES = COMPUTES + DUMPS + NEIGHBOR + FRAMES + RUNS + RESTARTS
