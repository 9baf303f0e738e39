"""Outputs of single contacts and of pairs of types: compute pair/gran/local and wall/gran/local, f_ID[row][column],
computeDissipatedEnergy, contacts that begin overlapping."""
import json
import math

from pytest import approx, mark
from collisions import pair_deck, wall_deck
from harness import GLASS, POWDER, Deck, head, plane_stl, properties, sphere_mass

RADIUS = 1.7e-3
DT = 2e-8
MODELS = ("mpm", "thornton")


def thornton_radius(r_eff, share, delta, largest):
    """Contact radius on the way out after yield; `share` of E* that the pair has: 1 on a rigid wall, 1/2 between like spheres."""
    hertz, p_y = 4 / 3 * POWDER.e_star * share, 1.6 * POWDER.yield_stress
    d_y = (math.pi * p_y / (2 * POWDER.e_star * share))**2 * r_eff
    f_y = hertz * math.sqrt(r_eff) * d_y**1.5
    f_m = f_y + math.pi * p_y * r_eff * (largest - d_y)
    edge = math.sqrt((2 * f_m + f_y) / (2 * math.pi * p_y))
    elastic = f_m / (hertz * edge)
    return edge * math.sqrt((delta - (largest - elastic)) / elastic)


class TestOutputs(Deck):
    def words(self, model, more="", names="powder"):
        return (f"law {self.law} materials {names} " if model == "mpm" else "") + "elasticDamping off " + more

    def rows(self, name="rows.dump"):
        """The last frame of a local dump that holds a contact, of those with a radius one that still carries force."""
        frames, lines = [], (self.folder / name).read_text().splitlines()
        for k, line in enumerate(lines):
            if line == "ITEM: NUMBER OF ENTRIES":
                count = int(lines[k + 1])
            elif line.startswith("ITEM: ENTRIES") and count:
                frames.append([[float(w) for w in row.split()] for row in lines[k + 1:k + 1 + count]])
        return [f for f in frames if len(f[0]) < 7 or f[0][4] > 0][-1]

    @mark.parametrize("kind", ("pair", "wall"))
    @mark.parametrize("model", MODELS)
    def test_columns_of_single_contacts(self, model, kind):
        """contactRadius, largestOverlap and dissipatedEnergy stand behind LIGGGHTS's own columns; on the way out of an impact they are
        the law's: of the present overlap, of the largest one, and what the contact statistics have."""
        make = "wall/gran/local" if kind == "wall" else "pair/gran/local"
        ours = (f"compute c all {make} delta id contactRadius largestOverlap dissipatedEnergy\n"
                "dump d all local 10 rows.dump c_c[1] c_c[2] c_c[3] c_c[4] c_c[5] c_c[6] c_c[7]\n"
                'dump_modify d format "%.12g %.12g %.12g %.12g %.12g %.12g %.12g"\nvariable l equal f_granulaw\n')
        if kind == "wall":
            (self.folder / "plane.stl").write_text(plane_stl())
            deck = wall_deck(model, self.words(model), POWDER, RADIUS, 3.0, DT, wall="mesh n_meshes 1 meshes cad",
                             before_wall="fix cad all mesh/surface file plane.stl type 1\n")
            r_eff, partner = RADIUS, "wall"
        else:
            deck = pair_deck(model, self.words(model), (POWDER, POWDER), (RADIUS, RADIUS), 3.0, DT)
            r_eff, partner = RADIUS / 2, "powder"
        run = 'run 900\nprint "LOSS ${l}"\n'
        text = self.run_deck(deck.replace("run 120", ours + run))
        loss = self.result(text, "LOSS")[0]
        (*ids, delta, a, largest, dissipated), = self.rows()
        assert sorted(int(i) for i in ids)[-1] == (2 if kind == "pair" else 1)
        assert delta < largest
        assert delta > 0
        if model == "mpm":
            expected = self.fixture("radius", self.law, "powder", partner, r_eff, delta, largest, 0)[0]
            assert a / expected == approx(1.0, abs=1e-5)  # text of the dump
        else:
            assert a / thornton_radius(r_eff, 1 if kind == "wall" else 0.5, delta, largest) == approx(1.0, abs=1e-9)
        assert dissipated / loss == approx(1.0, abs=1e-9)

    def test_words_alone_and_of_other_models(self):
        deck = pair_deck("mpm", self.words("mpm"), (POWDER, POWDER), (RADIUS, RADIUS), 3.0, DT)
        ours = "compute c all pair/gran/local largestOverlap\ndump d all local 10 rows.dump c_c[1] c_c[2] c_c[3] c_c[4]\n"
        self.run_deck(deck.replace("run 120", ours + "run 50"))
        (*ids, periodic, largest), = self.rows()
        assert (sorted(ids), periodic) == ([1, 2], 0)
        assert largest > 0
        one = "fix p6 all property/global coefficientRestitution peratomtypepair 1 1.0\nfix p1"
        walls = f"fix w all wall/gran model mpm tangential history primitive type 1 zplane -0.01 {self.words('mpm')}\n"
        hertz = pair_deck("hertz", "", (POWDER, POWDER), (RADIUS, RADIUS), 3.0, DT).replace("fix p1", one).replace("create_atoms", walls + "create_atoms", 1)
        text = self.run_deck(hertz.replace("run 120", ours + "run 50"), expect_failure=True)
        assert "are known of contacts of the models mpm and thornton" in text

    @mark.parametrize("ranks", (1, 2))
    def test_pairs_of_types_in_thermo(self, ranks):
        """f_granulaw[row][column]: rows 1-1, 1-2, 2-2, then the walls of each type."""
        deck = pair_deck("mpm", self.words("mpm", names="powder glass"), (POWDER, GLASS), (RADIUS, RADIUS), 2.0, 5e-8, run="run 600")
        names = [f"f_granulaw[{r}][{c}]" for r in range(1, 8) for c in (1, 2, 3, 5)]
        out = "".join(f"variable q{k} equal {n}\n" for k, n in enumerate(names))
        text = self.run_deck(deck + out + 'print "ROWS ' + " ".join(f"${{q{k}}}" for k in range(len(names))) + '"\n'.replace("\n", "\n"),
                             ranks=ranks)
        values = self.result(text, "ROWS")
        rows = [values[4 * k:4 * k + 4] for k in range(7)]
        for k, row in enumerate(rows):
            assert row[0] == (1 if k == 1 else 0), rows
        assert rows[1][1] == 1  # it has ended
        assert rows[1][2] > 0
        assert rows[1][3] == approx(2.0, abs=1e-6)

    @mark.parametrize("model", MODELS)
    def test_compute_dissipated_energy(self, model):
        """LIGGGHTS's own property dissipated_energy of each particle, out of the statistics."""
        deck = wall_deck(model, self.words(model, "computeDissipatedEnergy on"), POWDER, RADIUS, 1.0, DT)
        out = ("compute e all reduce sum f_dissipated_energy_[1]\nvariable e equal c_e\nvariable l equal f_granulaw\n"
               "thermo_style custom step c_e f_granulaw\n")
        text = self.run_deck(deck.replace("run 120", out + "run 1500") + 'print "LOSS ${e} ${l}"\n')
        speed = self.result(text, "SPEED")[0]
        lost = 0.5 * sphere_mass(RADIUS, POWDER.density) * (1 - speed**2)
        dissipated, statistics = self.result(text, "LOSS")
        assert dissipated / statistics == approx(1.0, abs=1e-9)
        assert dissipated / lost == approx(1.0, abs=1e-3)  # 200 steps a contact: the step's error

    @mark.parametrize("model", MODELS)
    def test_energies_of_particles_that_came_since_the_last_run(self, model):
        """So many come that all arrays move, and the energies are asked for before the next run."""
        deck = wall_deck(model, self.words(model, "energy on"), POWDER, RADIUS, 1.0, DT)
        more = ("lattice sc 0.002\nregion some block -0.03 0.03 -0.03 0.03 0.005 0.03 units box\ncreate_atoms 1 region some\n"
                f"set region some diameter 0.0015 density {POWDER.density}\nvariable held equal f_granulaw[14]\n"
                'print "HELD ${held}"\nwrite_dump all custom new.txt id f_granulaw[1] f_granulaw[2] modify sort id\n')
        text = self.run_deck(deck.replace("run 120", "run 120\n" + more))
        rows = [line.split() for line in (self.folder / "new.txt").read_text().splitlines() if len(line.split()) == 3 and line[0].isdigit()]
        assert len(rows) > 10000
        assert float(rows[0][1]) > 0  # it is in contact
        assert float(rows[0][1]) / self.result(text, "HELD")[0] == approx(1.0, abs=1e-4)  # six digits are written
        assert {(held, lost) for _, held, lost in rows[1:]} == {("0", "0")}

    def test_energies_follow_their_particles(self):
        """Three spheres that lost different energies on a floor: one is deleted, numbers change, a file is written and read on other ranks."""
        places = (-0.01, 0.0, 0.01)
        for model in MODELS:
            for ranks in (1, 2):
                words = self.words(model, "energy on")
                style = (properties([POWDER]) + f"pair_style gran model {model} tangential off {words}\npair_coeff * *\n"
                         f"fix w all wall/gran model {model} tangential off primitive type 1 zplane 0.0\nfix i all nve/sphere\ntimestep {DT!r}\n")
                atoms = "".join(f"create_atoms 1 single {x!r} 0 {1.001 * RADIUS!r} units box\nset atom {k} vz {-k}\n" for k, x in enumerate(places, 1))
                dump = "write_dump all custom {} x f_granulaw[2] modify format \"%.9g %.9g\"\n"
                deck = (head(half=20 * RADIUS) + style.replace("fix i", f"{atoms}set group all diameter {2 * RADIUS!r} density {POWDER.density}\nfix i") +
                        "run 1500\n" + dump.format("before.txt") + "group one id 1\ndelete_atoms group one compress yes\n" + dump.format("after.txt") +
                        "write_restart kept.restart\n")
                self.run_deck(deck, ranks=ranks)
                self.run_deck(head(half=20 * RADIUS, read="read_restart kept.restart") + style + "run 0\n" + dump.format("read.txt"), ranks=3 - ranks)
                found = {}
                for name in ("before.txt", "after.txt", "read.txt"):
                    lines = (self.folder / name).read_text().partition("ITEM: ATOMS")[2].splitlines()[1:]
                    found[name] = {round(float(x), 6): float(energy) for x, energy in map(str.split, lines)}
                lost = [found["before.txt"][x] for x in places]
                assert 0 < lost[0] < lost[1] < lost[2], lost
                for name in ("after.txt", "read.txt"):
                    assert found[name] == {x: found["before.txt"][x] for x in places[1:]}, (model, ranks, name)

    def test_types_that_change_in_contact(self):
        """`set type` while two spheres touch: the contact is open, and ends once: in the row of the types with which it last grew."""
        count = "".join(f"variable b{r} equal f_granulaw[{r}][1]\nvariable e{r} equal f_granulaw[{r}][2]\n" for r in (1, 2, 3))
        show = 'print "ROWS ${b1} ${e1} ${b2} ${e2} ${b3} ${e3}"\n'
        for model in MODELS:
            for ranks in (1, 2):
                deck = pair_deck(model, self.words(model, "contactMap on", "powder powder"), (POWDER, POWDER), (RADIUS, RADIUS), 2.0, DT)
                deck = deck.replace("create_box 1", "create_box 2").replace(properties([POWDER]), properties([POWDER, POWDER]))
                text = self.run_deck(deck.replace("run 120", f"{count}run 120\nset atom 1 type 2\nrun 30\n{show}run 2000\n{show}"), ranks=ranks)
                touching, parted = self.results(text, "ROWS")
                assert touching == [1, 0, 0, 0, 0, 0]
                assert (parted[0::2], parted[1] + parted[3], parted[5]) == ([1, 0, 0], 1, 0), (model, ranks)

    @mark.parametrize("model", MODELS)
    def test_contacts_that_begin_overlapping(self, model):
        """Two spheres put into each other, and none that moved there: counted, with what they brought; the balance closes with it."""
        for depth in (1e-4, 0.02):  # below yield, and beyond
            x = (1 - depth / 2) * RADIUS
            deck = (head(half=20 * RADIUS) + properties([POWDER]) +
                    f"pair_style gran model {model} tangential off {self.words(model, 'energy on stats s.json')}\npair_coeff * *\n"
                    f"create_atoms 1 single {-x!r} 0 0 units box\ncreate_atoms 1 single {x!r} 0 0 units box\n"
                    f"set group all diameter {2 * RADIUS!r} density {POWDER.density}\nfix i all nve/sphere\ntimestep {DT!r}\n"
                    "variable k equal ke\nvariable n equal f_granulaw[17]\nvariable b equal f_granulaw[18]\nvariable l equal f_granulaw\n"
                    'variable s equal f_granulaw[14]\nthermo_style custom step ke\nthermo_modify norm no\nrun 1500\n'
                    'print "BROUGHT ${n} ${b} ${k} ${s} ${l}"\n')
            text = self.run_deck(deck)
            count, brought, kinetic, stored, dissipated = self.result(text, "BROUGHT")
            assert (count, dissipated) == (1, 0)
            assert (kinetic + stored) / brought == approx(1.0, abs=1e-3)  # the step's error
            assert "1 contacts began deeper than the motion of a step can bring them" in text
            stats = json.loads((self.folder / "s.json").read_text())["pair"]
            assert stats["contacts_begun_overlapping"] == 1
        text = self.run_deck(pair_deck(model, self.words(model), (POWDER, POWDER), (RADIUS, RADIUS), 5.0, DT))
        assert "began deeper" not in text
