"""mpm compact: formats of packings, keys of the answer, sentences about what cannot be used."""
from pathlib import Path

from pytest import approx, fixture, mark

from programs import answer, material, mpm

EDGE = 2.84
FCC = [(0, 0, 0), (0, .5, .5), (.5, 0, .5), (.5, .5, 0)]
PLACES = [tuple(1e-3 * EDGE * x for x in place) for place in FCC]
RUN = "--cells", "5", "--rate", "0.004", "--density", "0.8", "--friction", "0.2"


@fixture(autouse=True)
def files(here):
    Path("m.toml").write_text(material("powder", 1500, "10e9", 0.3, "100e6"))
    Path("two.toml").write_text(material("a", 1500, "10e9", 0.3, "100e6") + material("b", 3000, "30e9", 0.3, "300e6"))
    box = f"# box {1e-3 * EDGE} {1e-3 * EDGE} {1e-3 * EDGE}\n"
    Path("p.txt").write_text(box + "# x y z radius\n" + "".join(f"{x} {y} {z} 1e-3\n" for x, y, z in PLACES))
    Path("named.txt").write_text(box + "".join(f"{x} {y} {z} 1e-3 {name}\n" for (x, y, z), name in zip(PLACES, "abab")))


def test_keys():
    run = answer("compact", "p.txt", "m.toml", *RUN, "--json", "--contacts", "c.csv", "-o", "rows.csv")
    rows = len(run["density"])
    assert rows >= 4 and run["density"] == sorted(run["density"]) and run["density"][-1] == approx(0.8, abs=2e-3)
    for key in "stress_Pa", "stress_xx_Pa", "stress_yy_Pa", "stress_zz_Pa", "coordination", "work_J", "plastic_J":
        assert len(run[key]) == rows
    assert run["wall_force_N"] == [] and run["bodies"] == 4 and run["points"] > 1000 and run["cpu_s"] > 0
    assert run["stress_Pa"][-1] == approx((run["stress_xx_Pa"][-1] + run["stress_yy_Pa"][-1] + run["stress_zz_Pa"][-1]) / 3)
    assert run["coordination"][-1] == 12
    assert len(Path("rows.csv").read_text().splitlines()) == rows + 1
    contacts = [line.split(",") for line in Path("c.csv").read_text().splitlines()[1:]]
    last = [line for line in contacts if line[1] == contacts[-1][1]]
    assert len(last) == 24  # 12 of each of 4 spheres
    # the stress from the list of contacts: sum of force times distance, where every branch is about along its force
    box = run["box_m"][-1]
    assert sum(float(line[7]) * float(line[9]) for line in last) / (3 * box[0] * box[1] * box[2]) == approx(run["stress_Pa"][-1], rel=0.03)


def test_walls_and_materials():
    run = answer("compact", "named.txt", "two.toml", *RUN, "--json")
    assert run["bodies"] == 4
    Path("die.txt").write_text("# box 2.02e-3 2.02e-3 4.04e-3\n1.01e-3 1.01e-3 1.01e-3 1e-3\n1.01e-3 1.01e-3 3.02e-3 1e-3\n")
    run = answer("compact", "die.txt", "m.toml", "--box", "walls", "--cells", "5", "--rate", "0.002", "--density", "0.56", "--unload-to", "0.05", "--json")
    assert all(len(row) == 6 for row in run["wall_force_N"])
    assert {"load", "unload"} == set(run["branch"])
    lid, floor = [row[5] for row in run["wall_force_N"]], [row[4] for row in run["wall_force_N"]]
    assert lid[-1] <= 0.05 * max(lid)
    top = lid.index(max(lid))
    assert floor[top] == approx(lid[top], rel=0.2)  # two spheres in line vibrate


def test_liggghts_files():
    wanted = answer("compact", "p.txt", "m.toml", *RUN, "--json")
    edge = 1e-3 * EDGE
    atoms = "".join(f"{k + 1} 1 {x + 1} {y} {z} 1e-3\n" for k, (x, y, z) in enumerate(PLACES))
    frame = f"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n4\nITEM: BOX BOUNDS pp pp pp\n1 {1 + edge}\n0 {edge}\n0 {edge}\nITEM: ATOMS id type x y z radius\n"
    Path("x.dump").write_text(frame + atoms.replace(" 1e-3\n", " 9e-4\n") + frame + atoms)  # the last frame counts
    data = "LIGGGHTS data file\n\n4 atoms\n1 atom types\n\n"
    data += "".join(f"0 {edge} {d}lo {d}hi\n" for d in "xyz") + "\nAtoms\n\n"
    Path("x.data").write_text(data + "".join(f"{k + 1} 1 2e-3 1500 {x} {y} {z}\n" for k, (x, y, z) in enumerate(PLACES)))
    for file in "x.dump", "x.data":
        assert answer("compact", file, "m.toml", *RUN, "--json")["stress_Pa"] == approx(wanted["stress_Pa"], rel=1e-3)
    assert "--materials" in mpm("compact", "x.dump", "two.toml", *RUN, code=None).stderr
    assert answer("compact", "x.dump", "two.toml", "--materials", "b", *RUN, "--json")["stress_Pa"][-1] == approx(3 * wanted["stress_Pa"][-1], rel=0.02)


@mark.parametrize("text, part", [("", "is empty"), ("0 0 0 1e-3\n", "is no packing"), ("# box 1 1\n", "length of the box is missing"),
                                 ("# box 1 1 1\n0 0 0\n", ":2: the radius is missing"), ("# box 1 1 1\n0 0 x 1\n", ":2: the z is no number"),
                                 ("# box 1 1 1\n0 0 0 .1 iron\n", "no material 'iron'"), ("# box 1 1 1\n0 0 0 -1\n", "over 0"),
                                 ("# box 1 1 1\n", "holds no sphere"), ("# box 4 4 4\n1 1 1 1\n2.5 1 1 1\n", "spheres 1 and 2 overlap too much"),
                                 ("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ATOMS id x y z\n1 0 0 0\n", "no column radius")])
def test_files_that_cannot_be_used(text, part):
    Path("bad.txt").write_text(text)
    sentence = mpm("compact", "bad.txt", "m.toml", code=None).stderr
    assert part in sentence and sentence.count("\n") == 1


@mark.parametrize("words, part", [(["--box", "round"], "periodic"), (["--density", "0.5"], "--density"), (["--rate", "0"], "--rate"),
                                  (["--unload-to", "1"], "--unload-to"), (["--contacts", "c.txt"], "--contacts"), (["--cells", "3"], "--cells")])
def test_options_that_cannot_be_used(words, part):
    assert part in mpm("compact", "p.txt", "m.toml", *words, code=2).stderr


def test_words_that_do_not_fit_the_packing():
    assert "LIGGGHTS" in mpm("compact", "p.txt", "m.toml", "--materials", "powder", code=None).stderr
    assert mpm("compact", ".", "m.toml", code=None).stderr.startswith("mpm: .: cannot be read")


def test_checkpoint_is_removed():
    words = "compact", "p.txt", "m.toml", *RUN, "--json"
    assert answer(*words, "--checkpoint", "state", "--checkpoint-every", "0")["stress_Pa"] == answer(*words, "--jobs", "2")["stress_Pa"]
    assert not Path("state").exists()
