"""A small battery of commands whose numbers show if a fault changes any result: sound and faulty outputs are compared.

The commands are those of the tests and examples: the quick rows of tools/hard_cases, laws of examples/mixture, LIGGGHTS's tutorials, and the
examples' own quick runs. Times, rates, hashes and paths are left out; numbers may differ by a relative 1e-9 (rounding of sums in another order).
"""
import importlib.machinery
import importlib.util
import json
import math
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROUNDING = 1e-9
LIMIT = 240.0  # s a command
IGNORED = ("cpu_s", "point_updates_per_s", "seconds", "loop_time_s", "version", "git_hash", "solver_id", "time_s_wall")
TOP = Path(__file__).resolve().parents[2]
TUTORIALS = Path("/usr/share/doc/liggghts/examples/LIGGGHTS/Tutorials_public")  # of Debian's liggghts-doc
BEAD = "[material.bead]\ndensity = 2500\nyoungs_modulus = 5e9\npoisson_ratio = 0.3\nyield_stress = 25e6\n"

LAWS = {
    "table": "mpm table examples/mixture/materials.toml -o {out}/law.h5",
    "info": "mpm info {out}/law.h5",
    "export": "mpm export {out}/law.h5 -o {out}/t.csv --points 60",
    "law, slow": "mpm law {out}/law.h5 --pair mcc:wall --velocity 0.2 --radius 2e-3 --json",
    "law, fast": "mpm law {out}/law.h5 --pair mcc:mcc --velocity 3 --radius 2e-3 --radius2 1e-3 --json",
    "law, unlike": "mpm law {out}/law.h5 --pair lactose:mcc --velocity 2 --radius 2e-3 --radius2 1e-3",
    "table, runs": "mpm table tools/hard_cases.toml --no-atlas --depth 0.05 --damage-number 0.01 --jobs 1 --cache {out}/runs --pair ey30:wall -o {out}/runs.h5",
    "info, runs": "mpm info {out}/runs.h5",
    "check": "mpm check {out}/runs.h5 --impacts 1 --seed 3",
    "calibrate": "mpm calibrate examples/calibrate/drops.csv --radius 1e-3 --density 1540 --youngs-modulus 3.2e9 --fit yield_stress --json",
    "refused": "mpm impact tools/hard_cases.toml --particle ey31 --velocity 1",
    "fixture": "law_fixture mpm {out}/law.h5 mcc lactose 1e-3 1e-5 3",
    "thornton": "law_fixture thornton 3e9 1.6e8 1e-3 1e-5 3",
}
# Names of the commands whose programs hold the code of a folder (and of those that make their files).
OF = {
    "mpm_core/solver": "impact|press",
    "mpm_core/contact": "table$|info$|export|law|fixture|thornton|run",
    "mpm_core/law": "table$|info$|export|law|fixture|thornton|run",
    "mpm_core/characterise": "table|info|export|law|calibrate",
    "liggghts_plugin": "run|plan",
    "tools/deck": "plan|stretch",
    "tools/mpm": "(?!.*runs|run )",
}


def commands(top=TOP):
    """{name: command}, to be run in the top folder of a tree."""
    loader = importlib.machinery.SourceFileLoader("hard_cases", str(top / "tools/hard_cases"))
    hard_cases = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    sys.modules["hard_cases"] = hard_cases  # dataclasses look there
    loader.exec_module(hard_cases)
    rows = [case for case in hard_cases.cases() if case.quick and not case.refused]
    found = {f"{case.words.split()[0]}, {case.name}": hard_cases.command_of(case, case.resolutions[0]) for case in rows}
    found["press"] = hard_cases.command_of(hard_cases.Case("", "", hard_cases.press("ey30", 0.03, "--phases 1")), 8) + " -o {out}/t.csv"
    found |= LAWS
    for deck in sorted(TUTORIALS.glob("*/in.*")):
        words = f"{deck} --materials-file {{out}}/bead.toml --speed 2 --json"
        found |= {f"plan {deck.name}": f"mpm plan {words}", f"stretch {deck.name}": f"mpm stretch {words}"}
    return found | {f"run {name}": f"/usr/bin/python3 examples/{name}/run.py --quick -o {{out}}/{name}" for name in ("drop", "packing")}


def plain(value):
    """JSON without what time or the build decides."""
    if isinstance(value, dict):
        return {k: plain(v) for k, v in value.items() if k not in IGNORED}
    return [plain(v) for v in value] if isinstance(value, list) else value


def told(text):
    """Lines that depend on the run's numbers alone."""
    try:
        return json.dumps(plain(json.loads(text)), indent=0)
    except ValueError:
        return "\n".join(line for line in text.splitlines() if not re.search(r"CPU|\bcommit\b|version|\d s\b|hash|solver|built|date|created|checksum|cpu_s|ranks|particle-steps", line))


def run(tools, folder, env, say, of=""):
    """Output of each command whose name begins so (a pattern): printed and written. `tools`: {program: path}."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / "bead.toml").write_text(BEAD)
    env = {**env, "PATH": ":".join([*{str(Path(p).parent) for p in tools.values()}, env.get("PATH", "")])}
    chosen = {name: command for name, command in commands().items() if re.match(of, name)}
    found = {}
    for k, (name, command) in enumerate(chosen.items()):
        say(f"battery: {k + 1} of {len(chosen)}, {name}")
        program, *words = command.format(out=folder).split()
        try:
            done = subprocess.run([tools.get(program, TOP / program), *words], cwd=TOP, env=env, capture_output=True, text=True, errors="replace", stdin=subprocess.DEVNULL,
                                  timeout=LIMIT)
            text = f"exit {done.returncode}\n" + told(done.stdout) + "\n" + told(done.stderr)
        except subprocess.TimeoutExpired:
            text = "no end"
        outputs = [folder / "t.csv", *folder.glob("*/*.csv"), *folder.glob("*/*/stats.json")]
        for output in sorted(p for p in outputs if p.exists()):
            text += f"\n{output.name}\n" + told(output.read_text(errors="replace"))
            output.unlink()
        found[name] = text.replace(str(folder), "")
    return found


def differing(sound, faulty):
    """Names of the commands whose numbers or words differ."""
    return [name for name in faulty if not alike(sound[name], faulty[name])]


def alike(a, b):
    if a == b:
        return True
    one, two = (re.split(r"[\s,:;\"=\[\]{}()]+", t) for t in (a, b))
    return len(one) == len(two) and all(x == y or close(x, y) for x, y in zip(one, two))


def close(x, y):
    try:
        return math.isclose(float(x), float(y), rel_tol=ROUNDING, abs_tol=1e-300)
    except ValueError:
        return False
