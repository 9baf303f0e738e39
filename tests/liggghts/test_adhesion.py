"""`cohesion dent`: adhesion that grows with the dent, on walls, pairs and meshes, across gaps, ranks and restarts."""
import math
import random

from pytest import approx, fixture, mark
from harness import Deck, Material, dump, head, plane_stl, properties, sphere_mass
from programs import MPM, ROOT, answer, run

GLASS = Material("glass", 2500.0, 70e9, 0.2, 1e30)
POWDER = Material("powder", 1500.0, 9.1e9, 0.3, 1e8)
TOML = "".join(f"[material.{m.name}]\ndensity = {m.density}\nyoungs_modulus = {m.youngs_modulus}\npoisson_ratio = {m.poisson_ratio}\n" +
               (f"yield_stress = {m.yield_stress}\n" if m.yield_stress < 1e20 else "") for m in (GLASS, POWDER))
STYLE = "model mpm tangential history cohesion dent"
WORDS = "elasticDamping off tangentialDampingRatio 0"
SHORT = "fix w2 all property/global adhesionRange scalar 1e-12\n"  # the limit of Johnson, Kendall and Roberts


def sticking_speed(material, radius, work):
    """Johnson, Kendall and Roberts, from first touch on: the energy is 7.09 (w^5 R^4/E*^2)^(1/3)."""
    return math.sqrt(2 * 7.09 * (work**5 * radius**4 / material.e_star**2)**(1 / 3) / sphere_mass(radius, material.density))


def snap_overlap(material, radius, work):
    """m, below 0 in JKR: 0.75 (pi^2 w^2 R/E*^2)^(1/3)."""
    return 0.75 * (math.pi**2 * work**2 * radius / material.e_star**2)**(1 / 3)


class TestAdhesion(Deck):
    @fixture(autouse=True, scope="class")
    def _laws(self, tmp_path_factory):
        folder = tmp_path_factory.mktemp("laws")
        (folder / "two.toml").write_text(TOML)
        run(MPM, "table", folder / "two.toml", *(w for p in ("glass:glass", "glass:wall", "powder:powder", "powder:wall") for w in ("--pair", p)), "-o", folder / "two.h5")
        type(self).two = folder / "two.h5"

    def models(self, material, work, words=WORDS, wall="primitive type 1 zplane 0.0", extra="", law=None):
        text = properties([material], 0.3) + f"fix w1 all property/global workOfAdhesion peratomtypepair 1 {work!r}\n{extra}"
        text += f"pair_style gran {STYLE} law {law or self.two} materials {material.name} {words}\npair_coeff * *\n"
        return text + (f"fix w all wall/gran {STYLE} {wall} {words}\n" if wall else "")

    def thrown(self, material, radius, work, speed, dt, steps, wall="primitive type 1 zplane 0.0", before="", more=""):
        """A sphere at a wall; its speed after it."""
        return (head(half=20 * radius) + before + self.models(material, work, wall=wall) + f"create_atoms 1 single {0.3 * radius!r} {0.2 * radius!r} {radius * (1 + 1e-9)!r} units box\n"
                f"set group all diameter {2 * radius!r} density {material.density}\nvelocity all set 0 0 {-speed!r}\nfix i all nve/sphere\ntimestep {dt!r}\n{more}"
                f'variable v equal vcm(all,z)\nthermo 100000\nrun {steps}\nprint "SPEED ${{v}}"\n')

    def test_elastic_spheres_stick_below_jkr_speed(self):
        """Within 0.2 % of it. W = 1.4e-9: the sphere's finite size counts for a/R = 2.7e-3, less than a fifth of that."""
        radius, work = 1e-3, 0.1
        v_s, way = sticking_speed(GLASS, radius, work), snap_overlap(GLASS, radius, work)
        decks = [self.thrown(GLASS, radius, work, f * v_s, way / v_s / 1000, 40000, before=SHORT) for f in (0.998, 1.002)]
        sticks, leaves = (v for (v,) in self.run_each(decks, "SPEED"))
        assert leaves == approx(v_s * math.sqrt(1.002**2 - 1), rel=0.5) and leaves > 0
        # it is still there: it swings
        assert abs(sticks) < v_s
        (late,), = self.run_each([self.thrown(GLASS, radius, work, 0.998 * v_s, way / v_s / 1000, 40500, before=SHORT)], "SPEED")
        assert late != approx(sticks, rel=1e-3)

    def test_pull_off_is_jkr(self):
        """The largest pull of a sphere that is drawn off, 3/2 pi w R, within 0.1 %; across the gap, at a wall and between two."""
        radius, work = 1e-3, 0.1
        way = snap_overlap(GLASS, radius, work)
        deck = (head(half=20 * radius) + self.models(GLASS, work, extra=SHORT) +
                f"create_atoms 1 single 0 0 {radius - 0.1 * way!r} units box\nset group all diameter {2 * radius!r} density {GLASS.density}\n"
                f"fix m all move linear 0 0 {way!r}\ntimestep 1e-3\ncompute z all reduce min fz\nthermo_style custom step c_z\n"
                'variable f equal c_z\nvariable k loop 1200\nlabel next\nrun 1 post no\nprint "PULL ${f}"\nnext k\njump in.deck next\n')
        pulls = [f for (f,) in self.results(self.run_deck(deck), "PULL")]
        assert -min(pulls) == approx(1.5 * math.pi * work * radius, rel=1e-3)
        assert pulls[-1] == 0  # it has snapped off
        # at no overlap 8/9 of it; two steps of the way about that
        assert -pulls[100] == approx(4 / 3 * math.pi * work * radius, rel=0.02)
        assert -pulls[50] == approx(4 / 3 * math.pi * work * radius, rel=0.1)

    def test_e_of_plastic_impacts_is_that_of_mpm_law(self):
        radius, work = 100e-6, 0.02
        for speed in (0.01, 0.3):
            law = answer("law", self.two, "--pair", "powder:wall", "--radius", repr(radius), "--velocity", repr(speed), "--work-of-adhesion", repr(work), "--adhesion-range", "0.6e-9", "--json")
            dt = law["contact_time_s"] / 2000
            (found,), = self.run_each([self.thrown(POWDER, radius, work, speed, dt, 5000).replace("fix w1", "fix w2 all property/global adhesionRange scalar 0.6e-9\nfix w1")], "SPEED")
            free = answer("law", self.two, "--pair", "powder:wall", "--radius", repr(radius), "--velocity", repr(speed), "--json")["e"]
            assert 0 < law["e"] < free - 1e-4 and not law["sticks"]
            assert found / speed == approx(law["e"], abs=2e-3)  # 2000 steps a contact here, 20,000 there

    def test_what_is_lost_is_booked(self):
        """Of a sphere that leaves its dent: kinetic energy is lost to plastic strain and adhesion, and no other work is left."""
        radius, work, speed = 100e-6, 0.02, 0.3
        values = ("d equal f_granulaw", "o equal f_granulaw[15]", "a equal f_granulaw[22]")
        more = "".join(f"variable {v}\n" for v in values) + "thermo_style custom step f_granulaw f_granulaw[15] f_granulaw[22]\n"
        deck = self.thrown(POWDER, radius, work, speed, 2e-10, 15000, before="fix w2 all property/global adhesionRange scalar 0.6e-9\n", more=more)
        deck = deck.replace(f"materials powder {WORDS}", f"materials powder {WORDS} energy on").replace('"SPEED ${v}"', '"SPEED ${v} ${d} ${o} ${a}"')
        (after, plastic, other, adhesion), = self.run_each([deck], "SPEED")
        lost = 0.5 * sphere_mass(radius, POWDER.density) * (speed**2 - after**2)
        assert plastic + adhesion == approx(lost, rel=1e-3)
        assert abs(other) < 0.02 * adhesion  # the snaps fall into a step
        assert adhesion > 1e-4 * plastic

    def test_a_mesh_is_a_plane(self):
        radius, work, speed = 100e-6, 0.02, 0.3
        (self.folder / "plane.stl").write_text(plane_stl(half=10 * radius))
        more = "fix w2 all property/global adhesionRange scalar 0.6e-9\n"
        mesh = more + "fix cad all mesh/surface file plane.stl type 1\n"
        speeds = self.run_each([self.thrown(POWDER, radius, work, speed, 1e-9, 2000, wall=wall, before=before)
                                for wall, before in (("primitive type 1 zplane 0.0", more), ("mesh n_meshes 1 meshes cad", mesh))], "SPEED")
        assert speeds[0][0] == approx(speeds[1][0], rel=1e-6) and speeds[0][0] > 0

    def test_clumps_and_stretched_contacts_lose_what_a_sphere_loses(self):
        """A clump that is a sphere leaves the wall at its speed; so does a contact under `stretch`, which keeps every energy."""
        radius, work, speed = 100e-6, 0.02, 0.3
        sphere = self.thrown(POWDER, radius, work, speed, 1e-9, 12000, before="fix w2 all property/global adhesionRange scalar 0.6e-9\n")
        (self.folder / "clump.txt").write_text(f"0 0 0 {radius!r}\n0 0 0 {0.2 * radius!r}\n")  # the second lies within the first: too small for this range, but it touches nothing
        m, begin, end = sphere_mass(radius, POWDER.density), sphere.index("create_atoms"), sphere.index("timestep")
        clump = (f"fix t0 all particletemplate/multisphere 15485863 atom_type 1 density constant {POWDER.density} nspheres 2 ntry 200000 spheres file clump.txt scale 1.0 type 1 "
                 f"mass {m!r} inertia_tensor {0.4 * m * radius**2!r} 0. 0. {0.4 * m * radius**2!r} 0. {0.4 * m * radius**2!r} use_density\n"
                 "fix d all particledistribution/discrete 32452843 1 t0 1.0\n"
                 f"region r block {-radius!r} {radius!r} {-radius!r} {radius!r} {1.001 * radius!r} {1.021 * radius!r} units box volume_limit 1e-30\n"
                 f"fix ins all insert/pack seed 32452867 distributiontemplate d insert_every once overlapcheck yes orientation template vel constant 0. 0. {-speed!r} "
                 "region r particles_in_region 1 ntry_mc 10000\nfix i all multisphere allow_group_and_set yes\n")
        free = sphere.replace("peratomtypepair 1 0.02", "peratomtypepair 1 0.0")
        speeds = [v for (v,) in self.run_each([sphere, free, sphere[:begin] + clump + sphere[end:] + "run 1\n", sphere.replace(WORDS, WORDS + " stretch 5")], "SPEED")]
        assert speeds[0] < speeds[1] - 1e-4 * speed  # adhesion takes a part
        assert speeds[2] == approx(speeds[0], abs=2e-5 * speed)  # steps of the fall shift the snap by one
        assert speeds[3] == approx(speeds[0], abs=2e-5 * speed)  # five times the steps

    def bed(self, work, cohesion=STYLE, steps=3000):
        """Spheres that fall onto a floor."""
        rng, radius = random.Random(3), 1.7e-3
        atoms = "".join(f"create_atoms 1 single {(k % 3 + 0.5 + rng.uniform(-0.1, 0.1)) * 2.3 * radius!r} {(k // 3 % 3 + 0.5) * 2.3 * radius!r} {(k // 9 + 0.5) * 2.3 * radius!r} units box\n" for k in range(27))
        models = self.models(POWDER, work).replace(STYLE, cohesion)
        return (head(half=20 * radius) + models + atoms + f"set group all diameter {2 * radius!r} density 1500\nvelocity all set 0.1 0 -1\nfix g all gravity 2000 vector 0 0 -1\n"
                f"fix i all nve/sphere\ntimestep 1e-7\n{dump('x y z vx vy vz', steps)}run {steps}\n")

    def test_no_work_is_no_adhesion_to_the_bit(self):
        ends = []
        for cohesion in (STYLE, "model mpm tangential history"):
            self.run_deck(self.bed(0.0, cohesion))
            ends.append(self.last_frame())
        assert ends[0] == ends[1]

    def gas(self, ranks, split=0):
        """Plastic spheres at random, of which some stick: the ledger closes."""
        rng, radius, side, work = random.Random(5), 20e-6, 4, 0.15
        box = side * 2.6 * radius
        atoms, velocities = [], []
        for k in range(side**3):
            cell = (k % side, k // side % side, k // side**2)
            atoms.append(f"{k + 1} 1 {2 * radius!r} {POWDER.density} " + " ".join(repr((c + 0.5 + rng.uniform(-0.1, 0.1)) * 2.6 * radius) for c in cell))
            velocities.append(f"{k + 1} " + " ".join(repr(rng.uniform(-0.3, 0.3)) for _ in range(3)) + " 0 0 0")
        (self.folder / "gas.data").write_text(f"gas\n\n{side**3} atoms\n1 atom types\n\n0 {box!r} xlo xhi\n0 {box!r} ylo yhi\n0 {box!r} zlo zhi\n\nAtoms\n\n" +
                                              "\n".join(atoms) + "\n\nVelocities\n\n" + "\n".join(velocities) + "\n")
        models = (self.models(POWDER, work, words=WORDS + " energy on", wall="", extra="fix w2 all property/global adhesionRange scalar 1.6e-9\n") + "fix i all nve/sphere\ntimestep 1e-9\n"
                  "compute rot all erotate/sphere\nvariable e equal ke+c_rot\nvariable s equal f_granulaw[14]\nvariable d equal f_granulaw\nvariable o equal f_granulaw[15]\nvariable a equal f_granulaw[22]\n"
                  "thermo_style custom step ke c_rot f_granulaw f_granulaw[14] f_granulaw[15] f_granulaw[22]\nthermo 1000\nthermo_modify norm no lost error\n")
        show = 'print "ENERGY ${e} ${s} ${d} ${o} ${a}"\n'
        start = head(read="read_data gas.data", boundary="p p p", skin=0.4 * radius)
        if not split:
            return self.results(self.run_deck(start + models + "run 0\n" + show + "run 40000\n" + show + dump("x y z", 1) + "run 0\n", ranks=ranks), "ENERGY")
        self.run_deck(start + models + f"run {split}\nwrite_restart half.restart\n", ranks=ranks)
        again = head(read="read_restart half.restart", boundary="p p p", skin=0.4 * radius)
        return self.results(self.run_deck(again + models + f"run {40000 - split}\n" + show + dump("x y z", 1) + "run 0\n", ranks=ranks), "ENERGY")

    @mark.parametrize("ranks", (1, 2))
    def test_a_sticky_gas_closes_its_ledger(self, ranks):
        before, after = self.gas(ranks)
        _, _, normal, _, adhesion = after
        assert sum(after) == approx(before[0], rel=1e-3)
        assert adhesion > 0.005 * before[0]
        assert normal > 0

    def test_a_restart_goes_on(self):
        """While pairs stick: to the rounding of a restart file's sums."""
        whole = self.gas(1)[-1]
        end = self.last_frame()
        again = self.gas(1, split=20000)[-1]
        assert again == approx(whole, rel=1e-6)
        assert max(abs(a - b) for k in end for a, b in zip(end[k], self.last_frame()[k])) < 1e-9 * 20e-6 * 1000

    def test_a_new_work_of_adhesion_holds_from_the_next_run_on(self):
        """A sphere on its way out of a dent: another value between two runs gives the force of one that had it all along."""
        radius, other = 100e-6, "unfix w1\nfix w1 all property/global workOfAdhesion peratomtypepair 1 0.01\n"

        def lifted(work, between):
            deck = self.thrown(POWDER, radius, work, 0, 1e-9, 1000).replace(f"{radius * (1 + 1e-9)!r} units", f"{0.98 * radius!r} units")
            deck = deck.replace("fix i all nve/sphere", "fix m all move linear 0 0 0.71\ncompute f all reduce sum fz\nvariable f equal c_f\nthermo_style custom step c_f")
            return deck.replace('print "SPEED ${v}"', f'{between}run 1\nprint "FORCE ${{f}}"')

        kept, changed, low = (f for (f,) in self.run_each((lifted(0.02, ""), lifted(0.02, other), lifted(0.01, "")), "FORCE"))
        assert changed == low != approx(kept, rel=0.01)

    def test_refusals(self):
        radius = 100e-6
        deck = self.thrown(POWDER, radius, 0.02, 0.5, 1e-10, 10)
        self.refused(deck.replace("tangential history", "tangential plastic"), "do not go together", "tangential history")
        self.refused(self.thrown(POWDER, radius, 0.055, 0.5, 1e-10, 10), "contact pressure", "least adhesion range")
        self.refused(self.thrown(POWDER, radius, 2.0, 0.5, 1e-10, 10), "no range is accepted")
        self.refused(self.thrown(POWDER, radius, -1.0, 0.5, 1e-10, 10), "workOfAdhesion", "0 or more")
        self.refused(deck.replace("fix w1", "fix w2 all property/global adhesionRange scalar 1e-6\nfix w1"), "Tabor", "at most")
        self.refused(deck.replace("fix wall", "fix nothing").replace("cohesion dent primitive", "cohesion sjkr primitive")
                     .replace("fix w1", "fix w3 all property/global cohesionEnergyDensity peratomtypepair 1 1e3\nfix w1"), "choose one of them")
        self.refused(deck.replace(WORDS, WORDS + " beyondRange crush"), "is not made for 'beyondRange crush'")
        grain = self.thrown(POWDER, 100e-6, 0.01, 0.5, 1e-9, 10).replace("fix i all", "fix g all gravity 9.81 vector 0 0 -1\nfix i all")
        self.refused(grain.replace(WORDS, WORDS + " stretch 1000"), "pull-off force", "stretch")

    def test_the_example(self):
        """Slow spheres stick, fast ones leave as mpm law says."""
        example = ROOT / "examples" / "sticking"
        run(MPM, "table", example / "materials.toml", "--pair", "powder:powder", "--pair", "powder:wall", "-o", self.folder / "sticking.h5")
        text = self.run_deck((example / "in.sticking").read_text())
        speeds = self.results(text, "SPEEDS")
        assert len(speeds) == 8
        for before, after, height in speeds:
            law = answer("law", self.folder / "sticking.h5", "--pair", "powder:wall", "--radius", "100e-6", "--velocity", repr(before), "--work-of-adhesion", "0.02", "--adhesion-range", "0.6e-9", "--json")
            assert height < 1e-8 if law["sticks"] else after / before == approx(law["e"], abs=0.01)
        assert [height > 1e-8 for before, after, height in speeds] == [False] * 3 + [True] * 5
