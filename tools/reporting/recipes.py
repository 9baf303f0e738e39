"""The commands that make what the report reads: shown where it is missing, run by --make."""
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
PYTHON = "/usr/bin/python3"
MPM = "build/release/tools/mpm/mpm"


def solver(out, quick):
    return ["cmake --build --preset release --target granulaw_cost_study",
            f"build/release/tests/study/granulaw_cost_study {out}/solver/cost.json" + (" quick" if quick else "")]


def law(out, quick):
    return ["cmake --build --preset release --target mpm law_size_benchmark",
            f"{MPM} table examples/hopper/materials.toml -o {out}/law/wax.h5",
            f"build/release/tests/benchmarks/law_size_benchmark {out}/law/wax.h5 -o {out}/law/law_size.json"]


def stretched(deck, out, factors, words):
    """A deck's run.py keeps one stretch a folder."""
    return [f"{PYTHON} examples/{deck}/run.py -o {out}/{deck}-stretch{s} --models mpm --stretch {s}{words}" for s in factors]


def deck(name, out, quick=False):
    """One deck under all models and stretches; name "demo": tools/demo."""
    words = " --quick --seeds 2" if quick else ""
    if name == "demo":
        return ["tools/demo --fresh"]
    if name == "hopper":  # its run.py takes all stretches at once
        return [f"{PYTHON} examples/hopper/run.py -o {out}/hopper --stretches 3{'' if quick else ' 10 30'}{words}"]
    return [f"{PYTHON} examples/{name}/run.py -o {out}/{name}{words}", *stretched(name, out, (3,) if quick else (3, 10, 30), words)]


def flow(out, quick):
    commands = ["cmake --build --preset release --target mpm liggghts-mpm"]
    for name in ("packing", "hopper") if quick else ("packing", "heap", "hopper", "silo"):
        if (ROOT / "examples" / name / "run.py").exists():
            commands += deck(name, out, quick)
    return commands


def hard_cases(out, quick):
    return ["cmake --build --preset release --target mpm", "tools/hard_cases" + (f" --quick -o {out}/hard-cases" if quick else "")]


PARTS = {"solver": solver, "law": law, "flow": flow, "hard cases": hard_cases}


def make(out, quick, say):
    """Runs every command; one that fails is named and the rest go on. Returns those that failed."""
    failed = []
    for folder in ("solver", "law"):
        pathlib.Path(out, folder).mkdir(parents=True, exist_ok=True)
    for part, commands in PARTS.items():
        if quick and part == "hard cases":
            continue  # docs/hard-cases.json comes with the tree
        for command in commands(out, quick):
            say(f"{part}: {command}")
            words = command.split()
            done = subprocess.run(words if "/" not in words[0] or words[0].startswith("/") else [str(ROOT / words[0]), *words[1:]], cwd=ROOT,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL, text=True, errors="replace")
            if done.returncode:
                failed.append(command)
                say("    failed: " + (done.stdout.strip().splitlines() or ["no word said"])[-1])
                if command.startswith("cmake"):
                    break
    return failed
