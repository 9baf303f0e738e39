"""The commands that make what the report reads: shown where it is missing, run by --make."""
import pathlib
import re
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
PYTHON = "/usr/bin/python3"
MPM = "build/release/tools/mpm/mpm"


def solver(out, quick):
    return ["cmake --build --preset release --target granulaw_cost_study",
            f"build/release/tests/validation/granulaw_cost_study {out}/solver/cost.json" + (" quick" if quick else "")]


def law(out, quick):
    return ["cmake --build --preset release --target mpm law_size_benchmark",
            f"{MPM} table examples/hopper/materials.toml -o {out}/law/wax.h5",
            f"build/release/tests/benchmarks/law_size_benchmark {out}/law/wax.h5 -o {out}/law/law_size.json"]


def stretched(deck, out, factors, words):
    """A deck's run.py keeps one stretch a folder."""
    return [f"{PYTHON} examples/{deck}/run.py -o {out}/{deck}-stretch{s} --models mpm --stretch {s}{words}" for s in factors]


def deck(name, out, quick=False, seeds=None):
    """One deck under all models, and stretched; name "demo": tools/demo. `seeds`: None: as many as the deck has by itself."""
    words = " --quick --seeds 2" if quick else f" --seeds {seeds}" if seeds else ""
    if name == "demo":
        return ["tools/demo --fresh"]
    run = f"{PYTHON} examples/{name}/run.py -o {out}/{name}{words}"
    if name == "hopper":  # its run.py takes all stretches at once
        stiff = f"{PYTHON} examples/hopper/run.py -o {out}/hopper-stiff --material stiff --models mpm --stretches 3 10 30 --softer 3 10 30{words}"
        return [run + " --stretches 3"] if quick else [run + " --deck-law", stiff]
    if name == "compression":  # pressed too deep for any stretch
        return [run]
    return [run, *stretched(name, out, (3,) if quick else (3, 10, 30), words)]


DECKS = ("drop", "packing", "heap", "compression", "hopper", "silo")


def flow(out, quick, seeds=None, decks=None):
    names = decks or (("packing", "hopper") if quick else DECKS)
    return ["cmake --build --preset release --target mpm liggghts-mpm", *[line for name in names for line in deck(name, out, quick, seeds)]]


def hard_cases(out, quick):
    return ["cmake --build --preset release --target mpm", f"tools/hard_cases{' --quick' if quick else ''} -o {out}/hard-cases"]


PARTS = {"solver": solver, "law": law, "flow": flow, "hard cases": hard_cases}


def call(command):
    """(exit code, what it said) of a command, run from the top folder."""
    words = command.split()
    if "/" in words[0] and not words[0].startswith("/"):
        words[0] = str(ROOT / words[0])
    try:
        done = subprocess.run(words, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL, text=True, errors="replace")
    except OSError as error:  # not built
        return 1, f"{words[0]}: {error.strerror}"
    return done.returncode, done.stdout


def make(out, quick, say, seeds=None, decks=None):
    """Runs every command; one that fails is named and the rest go on. Returns those that failed. What takes minutes
    keeps its finished runs itself. A stretched run that the plug-in stops is an answer, not a failure: the page gives its sentence."""
    failed = []
    for folder in ("solver", "law"):
        pathlib.Path(out, folder).mkdir(parents=True, exist_ok=True)
    for part, commands in PARTS.items():
        if quick and part == "hard cases":
            continue  # docs/evidence/hard-cases.json comes with the tree
        for command in commands(out, quick, seeds, decks) if part == "flow" else commands(out, quick):
            say(f"{part}: {command}")
            code, said = call(command)
            stopped = re.search(r"'stretch \S+' takes.*", said)
            if code and stopped and "--stretch " in command:
                say(f"    stopped: {stopped.group()}")
            elif code:
                failed.append(command)
                say("    failed: " + (said.strip().splitlines() or ["no word said"])[-1])
                if command.startswith("cmake"):
                    break
    return failed
