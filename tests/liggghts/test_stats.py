"""fix granulaw/stats: the start-up table, counts for each pair of types, the edge of the table, files every N steps."""
import json
import math
import re

from pytest import approx, mark
import gas
from collisions import pair_deck, wall_deck
from harness import GLASS, POWDER, Deck, head, properties, sphere_mass

RADIUS = 1.7e-3


class TestStats(Deck):
    def test_pairs_apart(self):
        """Powder hits powder, glass and the floor at three known speeds: each line of the contact statistics holds its own."""
        speeds = {"powder": 0.4, "glass": 0.7, "floor": 1.1}
        deck = head(types=2, half=20 * RADIUS) + properties([POWDER, GLASS])
        deck += (f"pair_style gran model mpm tangential off law {self.law} materials powder glass stats s.json\n"
                 "pair_coeff * *\nfix w all wall/gran model mpm tangential off primitive type 1 zplane 0.0\n")
        dt, k = 1.2e-8, 0
        places = [(1, -10, 5, speeds["powder"], 0), (1, -10, 7.0001, 0.0, 0), (1, 0, 5, speeds["glass"], 0),
                  (2, 0, 7.0001, 0.0, 0), (1, 10, 1.0001, 0.0, -speeds["floor"])]
        for t, x, z, up, down in places:
            k += 1
            material = (POWDER, GLASS)[t - 1]
            deck += (f"create_atoms {t} single {x * RADIUS!r} 0 {z * RADIUS!r} units box\ngroup a{k} id {k}\n"
                     f"set group a{k} diameter {2 * RADIUS!r} density {material.density}\nvelocity a{k} set 0 0 {up + down}\n")
        text = self.run_deck(deck + f"fix i all nve/sphere\ntimestep {dt}\nrun 4000\nrun 10\n")
        stats = json.loads((self.folder / "s.json").read_text())
        found = {(p["kind"], *p["types"]): p for p in stats["pairs"]}
        for key, speed, names in ((("particles", 1, 1), speeds["powder"], ["powder", "powder"]),
                                  (("particles", 1, 2), speeds["glass"], ["powder", "glass"]),
                                  (("rigid wall", 1, 1), speeds["floor"], ["powder", "wall"])):
            pair = found[key]
            assert pair["materials"] == names
            assert (pair["contacts_begun"], pair["contacts_ended"]) == (1, 1), key
            for end in ("min", "max"):  # nothing acts before first touch
                assert pair[f"impact_speed_{end}_m_per_s"] / speed == approx(1.0, abs=1e-9), str(key)
            low, deep = pair["overlap_over_radius_min"], pair["overlap_over_radius_max"]
            assert low <= deep  # the lower edge of the bin that the one contact is in, eight a decade
            assert deep < low * 10**(1 / 8)
            assert pair["contacts_near_table_edge"] == 0
        assert found["particles", 2, 2]["contacts_begun"] == 0
        assert found["particles", 2, 2]["impact_speed_min_m_per_s"] is None
        # I = rho V^2/Y: the rigid wall's partner takes all of the speed, one of a like pair half
        for key, share in ((("rigid wall", 1, 1), 1.0), (("particles", 1, 1), 0.5)):
            speed = share * found[key]["impact_speed_max_m_per_s"]
            assert found[key]["inertia_number_max"] / (POWDER.density * speed**2 / POWDER.yield_stress) == approx(1.0, abs=1e-9)
        total = sum(p["normal_dissipation_J"] for p in stats["pairs"])
        assert total / (stats["pair"]["normal_dissipation_J"] + stats["wall"]["normal_dissipation_J"]) == approx(1.0, abs=1e-9)
        # once in the log for two runs, with one line for each pair that can meet: 11, 12, 22, floor 1, floor 2
        assert text.count("granulaw contact laws") == 1
        table = text[text.index("granulaw contact laws"):].splitlines()
        assert sum(str(self.law) in line for line in table[2:7]) == 5, table[:8]
        assert sum("reduced" in line for line in table[2:7]) == 1

    @mark.parametrize("model", ("mpm", "mpm with axis", "thornton"))
    def test_what_one_collision_lost(self, model):
        """Dissipated = kinetic energy before - after, of wall and pair: 500 steps a contact, whose error in e is 2e-4 of the loss."""
        self.fixture("write", self.law, *(["axis"] if "axis" in model else []))
        name, mass = model.split()[0], sphere_mass(RADIUS, POWDER.density)
        words = (f"law {self.law} materials powder " if name == "mpm" else "") + "elasticDamping off"
        show = 'variable d equal f_granulaw\nprint "LOST ${s} ${d}"\n'
        decks = (wall_deck(name, words, POWDER, RADIUS, 1.0, 1.2e-8).replace("run 120", "run 2500") + "variable s equal v_v\n" + show,
                 pair_deck(name, words, (POWDER, POWDER), (RADIUS, RADIUS), 1.0, 1.2e-8, run="run 2500") + show)
        for m_eff, (e, lost) in zip((mass, mass / 2), self.run_each(decks, "LOST")):
            assert e < 0.95
            assert lost / (0.5 * m_eff * (1 - e * e)) == approx(1.0, abs=2e-4)

    def test_onset_speed_is_where_restitution_leaves_one(self):
        deck = wall_deck("mpm", f"law {self.law} materials powder stats s.json", POWDER, RADIUS, 1.0, 2e-8)
        self.run_deck(deck)
        onset = json.loads((self.folder / "s.json").read_text())["pairs"][-1]["onset_speed_m_per_s"]
        m = sphere_mass(RADIUS, POWDER.density)
        below, above = (self.fixture("mpm", self.law, "powder", "wall", RADIUS, m, f * onset)[0] for f in (0.999, 1.05))
        assert below == approx(1.0, abs=1e-6)  # the replay's own step error
        assert above < 1 - 1e-4

    def test_start_table(self):
        """Lines of the log about the powder on a wall before the run: its law's errors and limits, number for number."""
        m = sphere_mass(RADIUS, POWDER.density)
        for words, error in ((("runs", 3), "F_max 1.2 %, e 3.4 %"), (("atlas", 3), "F_max 5.6 %, e 0.078"), (("atlas", 0), "F_max 5.6 %, e 0.078"),
                             (("composed", 3), "F_max 1.2 %, e 3.4 %"), (("composed", 0), "F_max 5.6 %, e 0.078")):
            self.fixture("write", self.law, "certificate", *words)
            deck = wall_deck("mpm", f"law {self.law} materials powder stats s.json", POWDER, RADIUS, 1.0, 2e-8)
            text = self.run_deck(deck)
            rows = [line for line in text.splitlines() if "1 powder - wall 1 wall" in line]
            assert len(rows) == 1, text[-2000:]
            law, found = rows[0].split(str(self.law))
            assert found == "; " + error
            info = next(p for p in json.loads((self.folder / "s.json").read_text())["pairs"] if p["kind"] == "rigid wall")
            numbers = [float(w) for w in law.split()[-6:-1]]  # then `mpm` and the path
            # four digits
            for value, exact in zip(numbers, (POWDER.e_star / POWDER.yield_stress, info["overlap_over_radius_limit"], 0.002,
                                              info["onset_speed_m_per_s"], info["overlap_over_radius_limit_of_time_step"])):
                assert value / exact == approx(1.0, abs=5.1e-4), rows[0]

    def test_a_path_that_cannot_be_written_stops_before_the_first_step(self):
        deck = wall_deck("mpm", f"law {self.law} materials powder stats @path", POWDER, RADIUS, 1.0, 2e-8)
        for path, sentence in (("/proc/stats.json", "the folder '/proc' cannot be written to"), ("none/s.json", "the folder 'none' does not exist"),
                               (".", "is a folder, not a file"), ("/dev/full", "'/dev/full' is no regular file")):
            text = self.run_deck(deck.replace("@path", path), expect_failure=True)
            assert "pair_style gran: stats: " in text
            assert sentence in text
            assert "granulaw contacts" not in text

    def test_file_of_a_run_that_stops_at_a_number_that_is_none(self):
        deck = wall_deck("mpm", f"law {self.law} materials powder stats s.json", POWDER, RADIUS, 1.0, 2e-8)
        push = 'variable bad equal "(1e308*10)-(1e308*10)"\nfix push all addforce v_bad 0 0\n'
        first, last = deck.split("fix i all")
        text = self.run_deck(f"{first}{push}fix i all{last}", expect_failure=True)
        assert "is not a number" in text
        stats = json.loads((self.folder / "s.json").read_text())
        assert "is not a number" in stats["stopped"]
        assert stats["series"]["kinetic_J"][-1] is None and stats["series"]["time_s"][-1] > 0

    @mark.parametrize("squeeze, contacts, particles", ((0.09, 0, 0), (0.11, 2, 1)))
    def test_contacts_of_a_squeezed_sphere(self, squeeze, contacts, particles):
        """One sphere between two walls, flattened on both sides: by a tenth of its radius no law of one contact holds."""
        z = (1 - squeeze) * RADIUS
        deck = head(half=20 * RADIUS) + properties([POWDER])
        deck += (f"pair_style gran model mpm tangential history law {self.law} materials powder beyondRange continue stats s.json\npair_coeff * *\n"
                 f"fix low all wall/gran model mpm tangential history primitive type 1 zplane 0.0\n"
                 f"fix high all wall/gran model mpm tangential history primitive type 1 zplane {2 * z!r}\n"
                 f"create_atoms 1 single 0 0 {z!r} units box\nset group all diameter {2 * RADIUS!r} density {POWDER.density}\n"
                 "fix i all nve/sphere\ntimestep 1e-9\nrun 1\n")
        text = self.run_deck(deck)
        stats = json.loads((self.folder / "s.json").read_text())
        assert (stats["contacts_over_a_tenth_of_radius"], stats["particles_with_several_of_them"]) == (contacts, particles)
        assert (f"{contacts} contacts flattened a body by more than a tenth of its radius; {particles} particles had several" in text) == (contacts > 0)
        assert ("WARNING: granulaw: contacts left what a law of one contact covers" in text) == (contacts > 0)

    def test_sizes_off_the_laws_are_warned_of(self):
        """powder:powder has laws at radii 1:1, 1:3 and on a deformable wall."""
        self.fixture("write", self.law, "by_size", "composed")
        for ratio in (1, 2, 3):
            deck = head(half=20 * RADIUS) + properties([POWDER])
            deck += f"pair_style gran model mpm tangential history law {self.law} materials powder stats s.json\npair_coeff * *\n"
            for k, (x, radius) in enumerate(((-10, RADIUS), (10, ratio * RADIUS)), 1):
                deck += (f"create_atoms 1 single {x * RADIUS!r} 0 0 units box\ngroup a{k} id {k}\n"
                         f"set group a{k} diameter {2 * radius!r} density {POWDER.density}\n")
            text = self.run_deck(deck + "fix i all nve/sphere\ntimestep 1e-9\nrun 1\n")
            rule = json.loads((self.folder / "s.json").read_text())["pairs"][0]["rule"]
            # two particles of unlike size in one type: every fraction between theirs and one half may come
            warned = re.findall(r"WARNING: granulaw: R_i/\(R_i \+ R_j\) of types 1 and 1 is up to (\S+) off", text)
            assert len(warned) == int(ratio > 1), text[-2000:]
            if ratio == 1:
                assert rule == "single"
            else:
                assert float(warned[0]) == approx(0.125, abs=5e-4)  # half-way between the laws at 1/2 and 1/4

    def test_edge_of_the_table(self):
        """The law's table ends at 0.1 R on the wall: contacts that stop short of 0.09, between, and beyond."""
        m = sphere_mass(RADIUS, POWDER.density)
        def depth(v):
            return self.fixture("mpm", self.law, "powder", "wall", RADIUS, m, v)[2] / RADIUS
        for target, near, past in ((0.085, 0, 0), (0.095, 1, 0), (0.103, 1, 1)):
            low, high = 1.0, 100.0
            for _ in range(40):
                middle = math.sqrt(low * high)
                low, high = (middle, high) if depth(middle) < target else (low, middle)
            deck = wall_deck("mpm", f"law {self.law} materials powder stats s.json", POWDER, RADIUS, low, 1e-8)
            text = self.run_deck(deck.replace("run 120", "run 3000"))
            wall = json.loads((self.folder / "s.json").read_text())["wall"]
            assert wall["overlap_over_radius_max"] == approx(target, abs=2e-3 * target)  # the step's error
            assert (wall["contacts_near_table_edge"], wall["contacts_past_table"]) == (near, past), target
            assert ("deeper than 90 %" in text) == (near == 1)
            assert (wall["contact_steps_beyond_table"] > 0) == (past == 1)

    def test_energies_over_time(self):
        """The series of a gas: from its first state to its last, what was lost is what the contacts took; the same by two ranks."""
        gas.data_file(self.folder / "gas.data")
        model = gas.model(f"law {self.law} materials powder tangentialDampingRatio 0 stats s.json energy on")
        found = []
        for ranks in (1, 2):
            self.run_deck(gas.start() + model + gas.MOVE + gas.OUTPUT + "run 2000\nrun 2000\n", ranks=ranks)
            stats = json.loads((self.folder / "s.json").read_text())
            series = stats["series"]
            assert {len(column) for column in series.values()} == {len(series["time_s"])}
            assert 200 <= len(series["time_s"]) <= 400
            assert series["time_s"][0] == 0
            assert series["time_s"][-1] / stats["time_s"] == approx(1, abs=1e-5)  # six digits
            assert set(series["particles"]) == {series["particles"][0]}
            taken = stats["pair"]["normal_dissipation_J"] + stats["wall"]["normal_dissipation_J"]
            assert series["normal_dissipation_J"][-1] / taken == approx(1, abs=1e-5)
            total = [sum(series[name][k] for name in ("kinetic_J", "rotational_J", "normal_dissipation_J", "wave_dissipation_J", "elastic_J",
                                                      "other_work_J")) for k in (0, -1)]
            # six digits of each term; the time step's own error is smaller (test_energy.py)
            assert total[1] / total[0] == approx(1, abs=2e-5)
            assert series["kinetic_J"][-1] < 0.99 * series["kinetic_J"][0]
            pair = stats["pair"]
            assert sum(pair["impact_speed"]["count"]) == pair["contacts_begun"] > 100
            assert sum(pair["largest_overlap_over_radius"]["count"]) == pair["contacts_ended"]
            assert stats["wall"]["contacts_begun"] == 0
            assert not list(self.folder.glob("*.tmp.*"))
            found.append(series)
        for name, column in found[0].items():  # of a chaotic gas: before rounding grows
            for a, b in zip(column[:50], found[1][name][:50]):
                assert a == approx(b, abs=1e-5 * abs(a) + 1e-30), name

    def test_every(self):
        deck = wall_deck("mpm", f"law {self.law} materials powder", POWDER, RADIUS, 1.0, 2e-8)
        write = "fix s all granulaw/stats every 50 file s.json\nrun 120 every 60 \"shell cp s.json at_${n}.json\"\n"
        self.run_deck(deck.replace("run 120", "variable n equal step\n" + write))
        assert json.loads((self.folder / "s.json").read_text())["step"] == 120
        assert (self.folder / "at_60.json").exists()
        for words, sentence in (("every 5", "needs 'file FILE'"), ("every 0 file s.json", "1 or more, found '0'"),
                                ("evry 5", "allowed is: file FILE, every N")):
            text = self.run_deck(deck.replace("run 120", f"fix s all granulaw/stats {words}\nrun 1"), expect_failure=True)
            assert sentence in text

    def mapped_gas(self, parts, ranks=1, words="contactMap on"):
        """The gas in so many runs, each but the first from the restart file of the one before: kinetic energy, counts."""
        gas.data_file(self.folder / "gas.data")
        model = gas.model(f"law {self.law} materials powder tangentialDampingRatio 0 stats s.json {words}")
        body = model + gas.MOVE + gas.OUTPUT + f"run {4000 // parts}\n" + gas.PRINT + "write_restart half.restart\n"
        begin = gas.start()
        for _ in range(parts):
            text = self.run_deck(begin + body, ranks=ranks)
            begin = gas.start(read="read_restart half.restart")
        return self.result(text, "GAS")[0], json.loads((self.folder / "s.json").read_text())["pair"]

    def test_contact_map(self):
        """Its sums are the histograms of the contacts that ended; the same by two ranks and through a restart."""
        energy, off = self.mapped_gas(1, words="")
        assert "contact_map" not in off
        found, whole = self.mapped_gas(1)
        assert found == energy  # counting changes nothing
        both = whole["contact_map"]
        assert whole["contacts_ended"] > 50
        by_overlap = dict(zip(both["overlap_lower_edge"], map(sum, zip(*both["count"]))))
        overlaps = whole["largest_overlap_over_radius"]
        assert {e: c for e, c in by_overlap.items() if c} == {e: c for e, c in zip(overlaps["lower_edge"], overlaps["count"]) if c}
        begun = dict(zip(whole["impact_speed"]["lower_edge"], whole["impact_speed"]["count"]))
        ended = dict(zip(both["speed_lower_edge"], map(sum, both["count"])))
        for edge, count in ended.items():
            assert count <= begun.get(edge, 0)
        assert sum(ended.values()) == whole["contacts_ended"]
        # faster contacts go deeper: the means of the fastest and the slowest row that hold five
        rows = [r for r in both["count"] if sum(r) >= 5]
        means = [sum(k * c for k, c in enumerate(r)) / sum(r) for r in (rows[0], rows[-1])]
        assert means[1] > means[0] + 1
        assert self.mapped_gas(1, ranks=2)[1]["contact_map"] == both
        assert self.mapped_gas(2)[1]["contact_map"] == both

    def test_contact_map_holds_the_one_contact(self):
        deck = wall_deck("mpm", f"law {self.law} materials powder stats s.json contactMap on", POWDER, RADIUS, 1.0, 2e-8)
        self.run_deck(deck.replace("run 120", "run 3000"))
        wall = json.loads((self.folder / "s.json").read_text())["wall"]
        found = wall["contact_map"]
        assert found["count"] == [[1]]
        for edge, value in ((found["speed_lower_edge"][0], wall["impact_speed_max_m_per_s"]),
                            (found["overlap_lower_edge"][0], wall["overlap_over_radius_max"])):
            assert edge <= value * (1 + 1e-5)  # edges have six digits
            assert edge * 10**(1 / 8) > value * (1 - 1e-5)
