"""Runs a deck under each contact model and seed; a finished run is kept, a killed one begins again."""
import argparse
import csv
import hashlib
import os
import pathlib
import resource
import shlex
import shutil
import subprocess
import sys
import time

COMMON = pathlib.Path(__file__).resolve().parent
ROOT = COMMON.parents[1]
WAX = ROOT / "examples" / "hopper" / "materials.toml"
MODELS = ("hertz", "thornton", "mpm")


def options(description, out, seeds=5):
    """The options that all examples share."""
    parser = argparse.ArgumentParser(description=description.strip().splitlines()[0])
    parser.add_argument("-o", "--out", default=out, metavar="DIR", help=f"default: {out}")
    parser.add_argument("--models", nargs="+", choices=MODELS, default=list(MODELS))
    parser.add_argument("--seeds", type=int, default=seeds, help=f"runs of each model, default {seeds}")
    parser.add_argument("--ranks", type=int, default=1, help="MPI ranks")
    parser.add_argument("--stretch", type=float, default=1.0, help="of model mpm: contacts this much longer")
    parser.add_argument("--law", help="law file; default: mpm table makes it")
    tangential_options(parser)
    parser.add_argument("--quick", action="store_true", help="the small version that the tests run")
    return parser


def tangential_options(parser):
    parser.add_argument("--tangential", choices=("history", "plastic"), default="history", help="of model mpm")
    parser.add_argument("--energy", action="store_true", help="of model mpm: books the elastic energy and the work of friction, too")


def program(name):
    """On the PATH, else in build/release."""
    found = shutil.which(name)
    built = next((p for p in (ROOT / "build/release").rglob(name) if p.is_file() and os.access(p, os.X_OK)), None)
    if not found and not built:
        raise SystemExit(f"{name}: not on the PATH and not in build/release: build it first (README.md)")
    return found or str(built)


def digest(*things):
    """Hash of files (paths that exist) and words."""
    sum_ = hashlib.sha256()
    for thing in things:
        path = pathlib.Path(str(thing))
        sum_.update(path.read_bytes() if path.is_file() else str(thing).encode())
    return sum_.hexdigest()[:32]


def make_law(args, materials=WAX, words=(), name="law.h5"):
    """Path of the law file of `materials` (None if mpm is not asked for). Raises Refused with what `mpm table` said."""
    if args.law or "mpm" not in args.models:
        return args.law
    os.makedirs(args.out, exist_ok=True)
    law = pathlib.Path(args.out) / name
    mark, recipe = law.with_suffix(".recipe"), digest(materials, *words, program("mpm"))
    if not law.exists() or not mark.exists() or mark.read_text() != recipe:
        done = subprocess.run([program("mpm"), "table", str(materials), "-o", str(law), *words], stdout=subprocess.DEVNULL,
                              stderr=subprocess.PIPE, text=True)
        if done.returncode:
            raise Refused(done.stderr.strip())
        mark.write_text(recipe)
    return str(law)


class Refused(SystemExit):
    """A program ended with an error; str() is its last words."""


def run(args, deck, model, folder, inputs=(), law=None, variables=None, more=""):
    """Runs `deck` under `model` in `folder` unless that was done with the same inputs. Returns the folder.

    The deck finds -var model, out, common, law and those of `variables`; `more`: further words of model mpm."""
    folder = pathlib.Path(folder)
    words = {"model": model, "out": folder, "common": COMMON, **(variables or {})}
    if model == "mpm":
        words["law"] = law
        if args.stretch != 1:
            more += f" stretch {args.stretch:g}"
        if args.energy:
            more += " energy on"
        if args.tangential != "history":
            words["tangential"] = args.tangential
        words.update({"more": more.strip()} if more else {})
    launcher = program("liggghts" if model == "hertz" else "liggghts-mpm")
    beside = pathlib.Path(launcher).resolve().parent  # as built; as installed
    plugin = [p / "libgranulaw_liggghts.so" for p in (beside, beside.parent / "lib") if (p / "libgranulaw_liggghts.so").exists()]
    recipe = digest(deck, *sorted(COMMON.glob("*.in")), *inputs, *plugin, args.ranks,
                    *[f"{k}={digest(v) if k == 'law' else v}" for k, v in words.items() if k not in ("out", "common")])
    done = folder / "done"
    if done.exists() and done.read_text() == recipe:
        return folder
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    # line by line: LIGGGHTS ends in MPI_Abort, and with it the sentence that says why
    command = ["stdbuf", "-oL", launcher, "-in", str(deck), "-log", str(folder / "log")]
    if args.ranks > 1:
        command = ["mpirun", "--oversubscribe", "-np", str(args.ranks)] + command
    for name, value in words.items():
        command += ["-var", name, str(value)]
    (folder / "command").write_text(shlex.join(command) + "\n")
    environment = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMP_NUM_THREADS": "1"}
    start = told = time.monotonic()
    used = cpu_of_children()
    with open(folder / "screen", "w") as screen:
        process = subprocess.Popen(command, stdout=screen, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL, env=environment)
        try:
            while process.poll() is None:
                time.sleep(0.05)
                if time.monotonic() - told > 15:
                    told = time.monotonic()
                    say(f"{folder.name}: at {moment(folder)} s of its own time after {told - start:.0f} s")
        finally:
            if process.poll() is None:
                process.terminate()
    if process.returncode:
        tail = (folder / "screen").read_text(errors="replace")[-1500:]
        raise Refused(f"{' '.join(command)}\nfailed ({process.returncode}):\n{tail}")
    used = cpu_of_children() - used
    (folder / "cpu").write_text(f"{used:.2f}\n")  # s; the wall-clock of a shared machine says little
    done.write_text(recipe)
    say(f"{folder.name}: {time.monotonic() - start:.1f} s, {used:.1f} s of CPU")
    return folder


def cpu_of_children():
    """s, user and system, of all finished children of this process."""
    sum_ = resource.getrusage(resource.RUSAGE_CHILDREN)
    return sum_.ru_utime + sum_.ru_stime


def cpu(folder):
    """s of CPU that the run in `folder` took."""
    return float((pathlib.Path(folder) / "cpu").read_text())


def moment(folder):
    """Last time in series.csv; LIGGGHTS flushes it row by row."""
    try:
        with open(folder / "series.csv") as file:
            return list(csv.reader(file))[-1][0]
    except (OSError, IndexError):
        return "0"


def label(args, model):
    return f"mpm-stretch{args.stretch:g}" if model == "mpm" and args.stretch != 1 else model


def say(text):
    print(text, file=sys.stderr, flush=True)
