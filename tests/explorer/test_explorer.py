"""test_explorer.py PAGE MPM [--cases N] [--seed N] [--launcher PROGRAM]: the interactive page in Chromium against `mpm table` and `mpm law --json`.

Bodies agree to 1e-9 (another compiler and another C library round differently). Composed pairs agree to 1e-5: there rounding decides how often
a search goes on, and e moves by 4e-6 when E changes by one part in 1e15.
"""
import argparse
import json
import math
import os
import random
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from browser import Browser, missing

EXAMPLES = Path(__file__).resolve().parents[2] / "examples/calibrate"
LATER = "await new Promise((done) => setTimeout(done, 600));"  # fit and bed follow a change after 120 ms
NUMBERS = ("e", "force_max_N", "delta_max_m", "delta_residual_m", "contact_time_s", "work_load_J", "work_unload_J", "error_estimate", "error_force",
           "error_restitution", "damage_number", "damage_number_max", "size_distance")
WORDS = ("needs_velocity_axis", "beyond_velocity_axis", "below_velocity_axis", "law_kind")


def log_uniform(r, low, high):
    return math.exp(r.uniform(math.log(low), math.log(high)))


def random_material(r, name, elastic=False):
    youngs, nu = log_uniform(r, 1e7, 5e11), r.uniform(0, 0.49)
    e_star = youngs / (1 - nu * nu)
    material = {"name": name, "density": log_uniform(r, 200, 15000), "youngs_modulus": youngs, "poisson_ratio": nu}
    if not elastic:
        material["yield_stress"] = e_star / log_uniform(r, 25, 4000)
        material["hardening_modulus"] = r.choice([0, 0, r.uniform(0, 0.05)]) * material["yield_stress"] * 0.9
    return material


def random_case(r):
    """A request, its speed from below first yield to beyond the law."""
    first = random_material(r, "body", r.random() < 0.05)
    radius = log_uniform(r, 1e-5, 1e-1)
    kind = r.choice(["wall", "wall", "like", "sphere", "sphere", "thick", "thick like"])
    if kind in ("wall", "like"):
        partner = kind
    else:
        partner = {"radius": math.inf if kind.startswith("thick") else radius * log_uniform(r, 0.2, 5)}
        if kind != "thick like":
            partner["material"] = random_material(r, "partner", r.random() < 0.2)
    end = math.sqrt(first.get("yield_stress", first["youngs_modulus"] / 100) / first["density"])
    return {"material": first, "radius": radius, "partner": partner, "speed": end * log_uniform(r, 1e-4, 0.3)}


def toml_of(material):
    lines = [f"[material.{material['name']}]"] + [f"{key} = {material[key]!r}" for key in ("density", "youngs_modulus", "poisson_ratio", "yield_stress") if key in material]
    if material.get("hardening_modulus", 0) > 0:
        lines.append(f"hardening = {{law = \"linear\", modulus = {material['hardening_modulus']!r}}}")
    return "\n".join(lines) + "\n"


def by_mpm(mpm, case, folder):
    """The object of `mpm law --json`, or {"problem": sentence}. The law file has the pair of the request and its ratio of radii."""
    first, partner = case["material"], case["partner"]
    materials, options, sizes = [first], ["--no-thick-walls"], []
    if isinstance(partner, str):
        other = "wall" if partner == "wall" else first["name"]
    else:
        if "material" in partner:
            materials.append(partner["material"])
        other = materials[-1]["name"]
        if math.isinf(partner["radius"]):
            options = []
        else:
            ratio = case["radius"] / partner["radius"]
            options += ["--radius-ratio", repr(max(1.0, min(10.0, max(ratio, partner["radius"] / case["radius"]))))]
        sizes = ["--radius2", repr(partner["radius"])]
    (folder / "materials.toml").write_text("\n".join(map(toml_of, materials)))
    pair = f"{first['name']}:{other}"
    for words in (["table", "materials.toml", "--pair", pair, *options, "-o", "law.h5"],
                  ["law", "law.h5", "--pair", pair, "--radius", repr(case["radius"]), *sizes, "--velocity", repr(case["speed"]), "--json"]):
        done = subprocess.run([mpm, *words], cwd=folder, capture_output=True, text=True)
        if done.returncode != 0:
            return {"problem": done.stderr.strip().splitlines()[-1].removeprefix("mpm: ")}
    return json.loads(done.stdout)


def to_page(case):
    """JSON for the page: infinity is a radius there, None here."""
    return json.loads(json.dumps(case).replace("Infinity", "null"))


def without_source(sentence):
    return re.sub(r"^(materials\.toml:\d+: |law\.h5: |law: )", "", sentence)


def difference(page, mpm):
    """Largest relative difference of any number, and the keys whose words differ."""
    if "problem" in page or "problem" in mpm:
        same = without_source(page.get("problem", "")) == without_source(mpm.get("problem", ""))
        return (0.0, []) if same else (math.inf, [str(page), str(mpm)])
    words = [key for key in WORDS if page[key] != mpm[key]]
    worst = 0.0
    for key in NUMBERS:
        a, b = page[key], mpm[key]
        if (a is None) != (b is None):
            words.append(key)
        elif a is not None and a != b:
            relative = abs(a - b) / max(abs(a), abs(b))
            worst = worst if relative <= worst else relative  # one that is no number stays
    return worst, words


class Failures(list):
    def check(self, good, sentence):
        if not good:
            self.append(sentence)


def compare(browser, mpm, count, seed, failures):
    r = random.Random(seed)
    cases = [random_case(r) for _ in range(count)]
    answers = browser.run("const all = []; for (const case_ of args[0]) all.push(await granulaw.law(case_)); return all;", [to_page(c) for c in cases])
    worst, refused = {"bodies": 0.0, "pairs": 0.0}, 0
    same = 0
    with tempfile.TemporaryDirectory() as name:
        for case, answer in zip(cases, answers):
            if "not in the atlas" in answer.get("problem", ""):  # there mpm table runs the solver, for minutes
                refused += 1
                continue
            expected = by_mpm(mpm, case, Path(name))
            found, words = difference(answer, expected)
            kind = "pairs" if isinstance(case["partner"], dict) else "bodies"
            worst[kind] = worst[kind] if found <= worst[kind] else found
            same += found == 0 and not words
            failures.check(not words and found <= (1e-5 if kind == "pairs" else 1e-9), f"{kind}: {found:.2g} {words} in {json.dumps(case)}")
    print(f"{count} collisions: {same} the same in every digit; largest relative difference of a number: bodies {worst['bodies']:.2g}, "
          f"pairs {worst['pairs']:.2g}; {refused} materials outside the atlas")
    failures.check(refused <= 0.1 * count, "too many materials are outside the atlas")
    refusals = sum("problem" in a for a in answers)
    failures.check(refusals < 0.4 * count, f"{refusals} of {count} refused")


def refusals(browser, mpm, failures):
    """Numbers that `mpm` refuses, in its words."""
    base = {"material": {"name": "wax", "density": 920, "youngs_modulus": 91e6, "poisson_ratio": 0.3, "yield_stress": 1e6}, "radius": 3e-3, "partner": "wall", "speed": 1.0}
    changes = [{"density": 0}, {"density": -3}, {"density": 0.01}, {"youngs_modulus": 5}, {"poisson_ratio": 0.5}, {"poisson_ratio": -0.1}, {"yield_stress": 20e6}, {"yield_stress": 0.5},
               {"hardening_modulus": 1e9}]
    cases = [{**base, "material": {**base["material"], **change}} for change in changes]
    cases += [{**base, "radius": 0}, {**base, "radius": 1e4}, {**base, "speed": 0}, {**base, "speed": 1e7}, {**base, "speed": 1e3}]
    answers = browser.run("const all = []; for (const case_ of args[0]) all.push(await granulaw.law(case_)); return all;", [to_page(c) for c in cases])
    with tempfile.TemporaryDirectory() as name:
        for case, answer in zip(cases, answers):
            expected = without_source(by_mpm(mpm, case, Path(name)).get("problem", "mpm takes it"))
            found = without_source(answer.get("problem", "the page takes it"))
            failures.check(found == expected, f"refused otherwise: '{found}' and '{expected}'")
    outside = browser.run("return granulaw.law(args[0])", {**base, "material": {**base["material"], "yield_stress": 9e6}})
    failures.check("is not in the atlas" in outside.get("problem", ""), f"outside the atlas: {outside}")


def use(browser, page, failures):
    """Fields, slider keys, drag, keep, links, damaged links, downloads."""
    settle = "await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));"
    sentence = "return document.getElementById('sentence').textContent"

    def type_in(field, text):
        browser.run(f"const f = document.getElementById(args[0]); f.value = args[1]; f.dispatchEvent(new Event('change')); {settle}", field, text)

    def speed():
        return browser.run("return new URLSearchParams(location.hash.slice(1).split('~')[0]).get('V')")

    for text, value in (("2 m/s", 2), ("250 mm/s", 0.25), ("1,5", 1.5), ("1e0", 1)):
        type_in("speed", text)
        failures.check(float(speed()) == value, f"'{text}' is {speed()}")
    type_in("fall", "5 cm")
    failures.check(abs(float(speed()) / math.sqrt(2 * 9.81 * 0.05) - 1) < 1e-5, f"a fall of 5 cm gives {speed()} m/s")
    failures.check(browser.run("return document.getElementById('fall').value") == "50 mm", "the height of fall is not shown")
    type_in("speed", "1")
    type_in("speed", "fast")
    failures.check(browser.run("return document.getElementById('speed').getAttribute('aria-invalid')") == "true" and float(speed()) == 1, "a bad field changed the speed")
    type_in("speed", "1 m/s")
    failures.check("rebounds" in browser.run(sentence) and browser.run("return document.getElementById('verdict').className") == "good", f"wax: {browser.run(sentence)}")
    type_in("yield_stress", "never")
    failures.check("nothing yields" in browser.run(sentence), f"elastic: {browser.run(sentence)}")
    type_in("yield_stress", "20 MPa")
    failures.check(browser.run("return document.getElementById('verdict').className") == "bad" and "No law" in browser.run(sentence), f"Y of E*/5: {browser.run(sentence)}")
    type_in("yield_stress", "1 MPa")
    type_in("speed", "3 m/s")
    failures.check(browser.run("return document.getElementById('verdict').className") in ("good", "fair"), "3 m/s is refused")
    type_in("speed", "1")

    browser.run(f"document.getElementById('keep').click(); {settle}")
    box = browser.run("document.getElementById('speeds').scrollIntoView({block: 'center'}); const b = document.getElementById('speeds').getBoundingClientRect();"
                      "const h = document.getElementById('handle').getBoundingClientRect(); return [b.left, b.top, b.width, b.height, h.left + h.width / 2, h.top + h.height / 2]")
    browser.drag((box[4], box[5]), (box[4] - 0.2 * box[2], box[5]))
    browser.run(settle)
    failures.check(0 < float(speed()) < 0.5, f"a drag to the left left the speed at {speed()}")
    failures.check(browser.run("return document.querySelectorAll('#numbers .kept').length") == 7, "the kept state has no numbers")
    link = browser.run("return location.href")
    numbers = browser.run("return document.getElementById('numbers').textContent")
    browser.open("about:blank")
    browser.open(link)
    browser.run(f"await granulaw.ready; {settle}")
    failures.check(browser.run("return document.getElementById('numbers').textContent") == numbers, "a link opens another state")
    browser.open("about:blank")
    browser.open(f"{page}#name=%3Cb%3Ex&E=oops&V=-1&with=moon&Y=1e6")
    browser.run(f"await granulaw.ready; {settle}")
    failures.check("damaged: E, V, with" in browser.run(sentence), f"damaged link: {browser.run(sentence)}")

    browser.open("about:blank")
    browser.open(page)
    browser.run(f"await granulaw.ready; {settle}")
    for name, beginning in (("materials.toml", "# a soft wax"), ("in.deck", "# mpm table"), ("curves.csv", "time_s,overlap_m,force_N"), ("law.json", "{")):
        browser.run(f"document.getElementById('tab-' + args[0]).click(); document.getElementById('download').click(); {settle}", name)
        failures.check(browser.downloaded(name).startswith(beginning), f"{name} begins with {browser.downloaded(name)[:40]!r}")
    browser.run("document.querySelector('[data-svg=loop]').click()")
    failures.check(browser.downloaded("loop.svg").startswith("<svg"), "loop.svg is no picture")
    failures.check(browser.run("return [...document.querySelectorAll('input, select')].filter((c) => !c.labels?.length && !c.getAttribute('aria-label')).length") == 0, "a control has no label")


def deck_commands(browser, mpm, failures):
    """The commands in the deck's first lines, run with the file that the page wrote, give the page's numbers."""
    files = {name: browser.downloaded(name) for name in ("materials.toml", "in.deck", "law.json")}
    with tempfile.TemporaryDirectory() as name:
        (Path(name) / "materials.toml").write_text(files["materials.toml"])
        table, law = (line[2:].split() for line in files["in.deck"].splitlines()[:2])
        for words in (table, law + ["--json"]):
            done = subprocess.run([mpm, *words[1:]], cwd=name, capture_output=True, text=True)
            failures.check(done.returncode == 0, f"{' '.join(words)}: {done.stderr}")
    if done.returncode == 0:
        found, words = difference(json.loads(files["law.json"]), json.loads(done.stdout))
        failures.check(found <= 1e-9 and not words, f"the commands of the deck differ by {found} {words}")


def deck_run(browser, mpm, launcher, failures):
    """LIGGGHTS runs the lines of the deck without a warning. Its start-up table has the page's speed of first yield, and its step is short enough to the law's end."""
    files = {name: browser.downloaded(name) for name in ("materials.toml", "in.deck")}
    limits = browser.run("return granulaw.explore({material: {name: 'wax', density: 920, youngs_modulus: 91e6, poisson_ratio: 0.3, yield_stress: 1e6}, radius: 3e-3,"
                         " partner: 'wall', speed: 1}).limits")
    lines = files["in.deck"].splitlines()
    deck = ["atom_style granular", "boundary f f f", "newton off", "communicate single vel yes", "units si", "region box block -0.03 0.03 -0.03 0.03 -0.005 0.15 units box",
            "create_box 1 box", "neighbor 0.002 bin", "neigh_modify delay 0", *lines[3:], "create_atoms 1 single 0 0 0.0045", "set type 1 diameter 0.006 density 920",
            "fix motion all nve/sphere", "run 2"]
    with tempfile.TemporaryDirectory() as name:
        (Path(name) / "materials.toml").write_text(files["materials.toml"])
        (Path(name) / "in.deck").write_text("\n".join(deck) + "\n")
        subprocess.run([mpm, *lines[0][2:].split()[1:]], cwd=name, check=True, capture_output=True)
        done = subprocess.run([launcher, "-in", "in.deck"], cwd=name, capture_output=True, text=True)
    said = done.stdout + done.stderr
    failures.check(done.returncode == 0 and "WARNING" not in said, f"the deck: {said[-800:]}")
    row = re.search(r"1 wax - wall 1 wall +single +(.*?)  mpm", said)
    if row is None:
        return failures.append(f"no row of the wall in {said[-800:]}")
    _, deepest, _, onset, step_to = map(float, row[1].split())
    failures.check(onset == float(f"{limits['yield_speed']:.4g}") and step_to == deepest, f"start-up table {row[1]}, page {limits}")


def drop_tests(browser, page, mpm, failures):
    """The fit is that of `mpm calibrate`: by the function, and by the command that the page writes after rows were pasted. 1e-6: a search ends within 1e-7."""
    data = (EXAMPLES / "drops.csv").read_text()
    grain = {"name": "grain", "density": 1540, "youngs_modulus": 3.2e9, "poisson_ratio": 0.25}
    steel = {"name": "steel", "density": 7850, "youngs_modulus": 200e9, "poisson_ratio": 0.3, "yield_stress": 1e9}
    options = ["drops.csv", "--radius", "1e-3", "--density", "1540", "--poisson-ratio", "0.25", "--youngs-modulus", "3.2e9", "--fit", "yield_stress", "--json"]

    def by_command(folder, *words):
        done = subprocess.run([mpm, "calibrate", *words], cwd=folder, capture_output=True, text=True)
        return json.loads(done.stdout) if done.returncode == 0 else {"problem": done.stderr.strip().splitlines()[-1].removeprefix("mpm: ")}

    def agree(found, expected, what):
        if "problem" in found or "problem" in expected:
            return failures.append(f"{what}: {found}, {expected}")
        a, b = found["parameters"]["yield_stress"], expected["parameters"]["yield_stress"]
        worst = max(abs(a[key] / b[key] - 1) for key in ("value", "low68", "high68", "low95", "high95"))
        failures.check(worst <= 1e-6 and a["told"] == b["told"] and found["verdict"] == expected["verdict"], f"{what}: {a}, {found['verdict']}; mpm calibrate {b}, {expected['verdict']}")
        return worst

    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "drops.csv").write_text(data)
        (folder / "materials.toml").write_text(toml_of(steel))
        worst = []
        for partner, words in (("wall", []), ("like", ["--partner", "like"]), ({"material": steel, "radius": None}, ["--wall", "steel", "--materials", "materials.toml"])):
            found = browser.run("return granulaw.calibrate(args[0])", {"data": data, "material": grain, "radius": 1e-3, "partner": partner})
            worst.append(agree(found, by_command(folder, *options, *words), f"drops on {partner}"))
        bad = browser.run("return granulaw.calibrate(args[0])", {"data": data.replace("velocity_m_per_s", "velocity"), "material": grain, "radius": 1e-3, "partner": "wall"})
        (folder / "drops.csv").write_text(data.replace("velocity_m_per_s", "velocity"))
        expected = by_command(folder, *options)
        failures.check(bad.get("problem", "").split(": ", 1)[-1] == expected["problem"].split(": ", 1)[-1], f"a bad header: {bad}, {expected}")

        # pasted as people write: spaces, a decimal comma; then the command of the tab drops.csv
        rows = [line.split(",") for line in data.splitlines() if line and not line.startswith("#")][1:]
        browser.open("about:blank")
        browser.open(f"{page}#name=grain&E=3.2e9&nu=0.25&Y=5e7&H=0&rho=1540&R=0.001&with=wall&V=1")
        browser.run(f"await granulaw.ready; const box = document.getElementById('drops'); box.value = args[0]; box.dispatchEvent(new Event('input')); {LATER}",
                    "\n".join(" ".join(row[:2]).replace(".", ",") for row in rows))
        said = browser.run("return document.getElementById('fitted').textContent")
        browser.run(f"document.getElementById('tab-drops.csv').click(); document.getElementById('download').click(); {LATER}")
        file = browser.downloaded("drops.csv")
        (folder / "drops.csv").write_text(file)
        command = file.splitlines()[0].split()
        failures.check(command[:3] == ["#", "mpm", "calibrate"], f"no command in {file[:200]}")
        expected = by_command(folder, *command[3:], "--json")
        failures.check(said.startswith(expected.get("verdict", "?")), f"'{said}', mpm calibrate says '{expected}'")
        browser.run(f"document.getElementById('take').click(); {LATER}")
        taken = float(browser.run("return new URLSearchParams(location.hash.slice(1)).get('Y')"))
        failures.check(abs(taken / expected["parameters"]["yield_stress"]["value"] - 1) < 1e-3, f"Y taken: {taken}")
        failures.check(browser.run("return document.querySelectorAll('#speeds .dot.data').length") == len(rows), "the drops are not in the picture")
    print(f"drop tests: largest relative difference of Y and its intervals from mpm calibrate {max(worst):.2g}")


def bed(browser, mpm, launcher, failures):
    """The bed's numbers are those of `mpm plan` and `mpm stretch` for a deck of the same bodies, whose floor LIGGGHTS reads."""
    wax = {"name": "wax", "density": 920, "youngs_modulus": 91e6, "poisson_ratio": 0.3, "yield_stress": 1e6}
    lactose = {"name": "lactose", "density": 1540, "youngs_modulus": 24.1e9, "poisson_ratio": 0.12, "yield_stress": 180e6}
    worst = 0.0
    for partner, second, speed in (("wall", None, 1.0), ({"material": lactose, "radius": 1.5e-3}, lactose, 2.0), ({"material": lactose, "radius": None}, lactose, 0.5), ("like", None, 0.01)):
        found = browser.run("return granulaw.bed(args[0])", {"material": wax, "radius": 3e-3, "partner": partner, "speed": speed, "bed_height": 0.2})
        if "problem" in found:
            failures.append(f"bed: {found}")
            continue
        types, materials = (2 if second else 1), [wax] + ([second] if second else [])
        sphere = second and partner["radius"]
        each = lambda key: " ".join(repr(m[key]) for m in materials)
        wall = "2 zplane 0.0 wall deformable" if second and not sphere else "1 zplane 0.0"
        deck = ["atom_style granular", "boundary f f f", "newton off", "communicate single vel yes", "units si", "region box block -0.1 0.1 -0.1 0.1 -0.01 0.2 units box",
                f"create_box {types} box", "neighbor 0.002 bin", "neigh_modify delay 0", "hard_particles yes",
                f"fix m1 all property/global youngsModulus peratomtype {each('youngs_modulus')}", f"fix m2 all property/global poissonsRatio peratomtype {each('poisson_ratio')}",
                f"fix m3 all property/global coefficientFriction peratomtypepair {types} {' '.join(['0.3'] * types**2)}",
                f"pair_style gran model mpm tangential history law law.h5 materials {' '.join(m['name'] for m in materials)}", "pair_coeff * *",
                f"fix floor all wall/gran model mpm tangential history primitive type {wall}", "fix g all gravity 9.81 vector 0 0 -1", "timestep 1e-6",
                "create_atoms 1 single 0 0 0.02", "create_atoms 1 single 0.03 0 0.02", "set type 1 diameter 0.006 density 920",
                *(["create_atoms 2 single 0 0.03 0.02", "set type 2 diameter 0.003 density 1540"] if sphere else []), "fix i all nve/sphere", "run 1"]
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "in.deck").write_text("\n".join(deck) + "\n")
            (folder / "materials.toml").write_text("\n".join(map(toml_of, materials)))
            said = {}
            for command, words in (("plan", []), ("soften", ["--fill-height", "0.2"])):
                done = subprocess.run([mpm, command, "in.deck", "--materials-file", "materials.toml", "--speed", repr(speed), *words, "--json"], cwd=folder, capture_output=True, text=True,
                                      env={**os.environ, "GRANULAW_LAUNCHER": launcher})
                if done.returncode:
                    failures.append(f"mpm {command}: {done.stderr[-400:]}")
                    return
                said[command] = json.loads(done.stdout)
        pairs = {(*sorted(p["materials"]), p["wall"]): p for p in said["plan"]["pairs"]}
        mine = {(*sorted(p["materials"]), p["wall"]): p for p in found["pairs"]}
        failures.check(set(pairs) == set(mine), f"pairs of the bed {sorted(mine)}, of the plan {sorted(pairs)}")
        numbers = [(mine[k][key], pairs[k][key]) for k in set(pairs) & set(mine) for key in ("onset_speed_m_per_s", "damage_number_max", "overlap_over_radius_max", "time_step_s")]
        numbers.append((found["time_step_s"], said["plan"]["time_step_s"]["advised"]))
        # the deck's own step may be the smaller one, the bed has none: both steps over their plan's
        numbers += [(found["soften"][key], said["soften"][key]) for key in ("stretch", "overlap_over_radius", "static_load_over_yield_load")]
        for a, b in numbers:
            if a != b:
                worst = max(worst, abs(a - b) / max(abs(a), abs(b)) if a is not None and b is not None else math.inf)
        failures.check(found["soften"]["bound_by"] == said["soften"]["bound_by"] and found["beyond_laws"] == said["plan"]["beyond_laws"] and
                       all(mine[k]["needs_table"] == pairs[k]["needs_table"] for k in set(pairs) & set(mine)), f"bed {found}; {said}")
    failures.check(worst <= 1e-9, f"the bed differs from plan and soften by {worst:.2g}")
    print(f"bed: largest relative difference from mpm plan and mpm stretch {worst:.2g}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("page", type=Path)
    parser.add_argument("mpm")
    parser.add_argument("--cases", type=int, default=30)
    parser.add_argument("--seed", type=int, default=55)
    parser.add_argument("--launcher", help="liggghts-mpm: it runs the deck that the page wrote")
    arguments = parser.parse_args()
    if why := missing():
        print(f"skipped: {why}")
        return 77
    if not arguments.page.exists():
        print(f"skipped: {arguments.page} was not built; cmake --build build/release --target explorer")
        return 77
    mpm, page, failures = str(Path(arguments.mpm).resolve()), arguments.page.resolve().as_uri(), Failures()
    with Browser() as browser:
        browser.open(page)
        browser.run("await granulaw.ready")
        use(browser, page, failures)
        deck_commands(browser, mpm, failures)
        if arguments.launcher:
            deck_run(browser, mpm, str(Path(arguments.launcher).resolve()), failures)
            bed(browser, mpm, str(Path(arguments.launcher).resolve()), failures)
        drop_tests(browser, page, mpm, failures)
        refusals(browser, mpm, failures)
        compare(browser, mpm, arguments.cases, arguments.seed, failures)
        others = [url for url in browser.requests() if not url.startswith(("file:", "data:", "blob:", "about:", "chrome:"))]
        failures.check(not others, f"requests: {others[:3]}")
        complaints = browser.complaints()
        failures.check(not complaints, f"errors of the page: {complaints[:3]}")
    for failure in failures:
        print(f"FAILED: {failure}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
