"""Statistics under `tangential plastic` of .5 mm granules among 5 mm balls over a plate that shakes: against the overlaps of every contact
at every step, as LIGGGHTS's own computes list them."""
import json
import math
import random

from harness import Deck, Material, properties
from programs import material, particle, table

R, POWDER, SIDE = (2.5e-3, 0.25e-3), Material("powder", 1500.0, 9.1e7, 0.3, 1e5), 10.2e-3
MODEL = "model mpm tangential plastic"
HISTORY = {"begun": "contacts_begun", "near": "contacts_near_table_edge", "past": "contacts_past_table", "beyond": "contact_steps_beyond_table"}


def bed():
    """Type (0 ball, 1 granule) and centre of each sphere; none touches another."""
    rng, spheres = random.Random(3), [(0, [(2 * (k >> c & 1) + 1) * SIDE / 4 for c in (0, 1)] + [(1.02 + 2.1 * (k >> 2)) * R[0]]) for k in range(8)]
    while len(spheres) < 308:
        at = [rng.uniform(R[1], SIDE - R[1]), rng.uniform(R[1], SIDE - R[1]), rng.uniform(1.1 * R[1], 5 * R[0])]
        if all(math.dist(at, other) > R[1] + R[kind] + 1e-5 for kind, other in spheres):
            spheres.append((1, at))
    return spheres


class TestVibratedBed(Deck):
    def steps(self, name):
        """Rows of each step of a dump but the first, which is of the set-up."""
        for text in (self.folder / name).read_text().split("ITEM: TIMESTEP")[2:]:
            yield [row.split() for row in text.splitlines()[9:]]

    def counted(self, name, pair_of, ends):
        """What the statistics count, from the overlaps over R*: contacts are (pair of types, who, overlap/R*)."""
        found, going = {}, {}
        for rows in [*self.steps(name), []]:
            now = {}
            for row in rows:
                pair, who, x = pair_of(row)
                if x > 0:
                    now[who] = (pair, max(x, now.get(who, (0, 0))[1]))  # of two triangles the deeper
            for who in [w for w in going if w not in now]:
                pair, x = going.pop(who)
                for key, limit in (("begun", 0), ("near", 0.9), ("past", 1)):
                    found[pair][key] += x > limit * ends[pair]
                found[pair]["largest"] = max(found[pair]["largest"], x)
            for who, (pair, x) in now.items():
                found.setdefault(pair, dict.fromkeys([*HISTORY, "largest"], 0))["beyond"] += x > ends[pair]
                going[who] = (pair, max(x, going.get(who, (pair, 0))[1]))
        return found

    def test_statistics_are_those_of_the_overlaps(self):
        spheres = bed()
        (self.folder / "bed.data").write_text(
            f"bed\n\n{len(spheres)} atoms\n2 atom types\n\n0 {SIDE} xlo xhi\n0 {SIDE} ylo yhi\n-0.002 0.04 zlo zhi\n\nAtoms\n\n" +
            "".join(f"{k + 1} {kind + 1} {2 * R[kind]} 1500 {x} {y} {z}\n" for k, (kind, (x, y, z)) in enumerate(spheres)))
        (self.folder / "plate.stl").write_text("solid p\n" + "".join(
            "facet normal 0 0 1\nouter loop\n" + "".join(f"vertex {x * SIDE} {y * SIDE} 0\n" for x, y in corners) + "endloop\nendfacet\n"
            for corners in (((0, 0), (1, 0), (1, 1)), ((0, 0), (1, 1), (0, 1)))) + "endsolid p\n")
        law = table("".join(material(name, 1500, 9.1e7, 0.3, 1e5) for name in ("ball", "granule")), "--depth", "0.02")
        self.run_deck(
            "units si\nhard_particles yes\natom_style granular\natom_modify map array\nboundary p p f\nnewton off\ncommunicate single vel yes\n"
            "read_data bed.data\nneighbor 0.0003 bin\nneigh_modify delay 0\n" + properties([POWDER, POWDER], 0.4) +
            f"pair_style gran {MODEL} law {law} materials ball granule beyondRange continue stats s.json\npair_coeff * *\n"
            f"fix m all mesh/surface file plate.stl type 1\nfix w all wall/gran {MODEL} mesh n_meshes 1 meshes m\n"
            "fix v all move/mesh mesh m wiggle amplitude 0. 0. 0.0007 period 0.004\nfix g all gravity 9.81 vector 0 0 -1\nfix i all nve/sphere\n"
            "timestep 1e-6\ncompute p all pair/gran/local id delta\ncompute q all wall/gran/local id delta\n"
            "dump p all local 1 pairs c_p[1] c_p[2] c_p[4]\ndump q all local 1 walls c_q[3] c_q[4]\n"
            'dump_modify p format "%.0f %.0f %.12g"\ndump_modify q format "%.0f %.12g"\nrun 12000\n')
        told = {(pair["kind"] == "particles", *pair["types"][:1 + (pair["kind"] == "particles")]): pair
                for pair in json.loads((self.folder / "s.json").read_text())["pairs"]}
        ends = {key: pair["overlap_over_radius_limit"] for key, pair in told.items()}
        kinds = [kind for kind, _ in spheres]

        def of_pair(row):
            i, j = sorted(int(w) - 1 for w in row[:2])
            a, b = sorted((kinds[i], kinds[j]))
            return (True, a + 1, b + 1), (i, j), float(row[2]) * (1 / R[a] + 1 / R[b])

        def of_wall(row):
            kind = kinds[int(row[0]) - 1]
            return (False, kind + 1), row[0], float(row[1]) / R[kind]

        found = {**self.counted("pairs", of_pair, ends), **self.counted("walls", of_wall, ends)}
        assert sorted(found) == sorted(told) and sum(one["past"] for one in found.values()) > 20
        for key, counts in found.items():
            assert abs(told[key]["overlap_over_radius_max"] - counts["largest"]) < 1e-9  # digits of statistics and dump
            assert {word: told[key][name] for word, name in HISTORY.items()} == {word: counts[word] for word in HISTORY}
