"""Runs over threads and ranks; each test has its line in CMakeLists.txt. No test looks at speed: the time limits are what a hang is recognised by, far
beyond what the test takes."""
import os
import random
import signal
import subprocess
import time
from pathlib import Path

import h5py
import numpy as np
import programs
from programs import MPIRUN, MPM, material
from pytest import mark

pytestmark = mark.usefixtures("here")
FARM_RANKS, LAW = (os.environ.get(f"GRANULAW_{name}") for name in ("FARM_RANKS", "LAW"))  # LAW: the one that nobody disturbed
CHEAP = material("powder", 1500, "2.73e9", 0.3, "100e6")  # E*/Y = 30: the cheapest law that yields, about 10 CPU s
HANG = 120  # s


def launched(ranks, *words):
    """The command on that many ranks; 0: without mpirun."""
    return ([MPIRUN, "-np", str(ranks)] if ranks else []) + list(map(str, words))


def run(ranks, *words, code=...):
    return programs.run(*launched(ranks, *words), code=code, timeout=HANG)


def own_lines(text):
    """Output of the program without the lines that mpirun adds."""
    return [line for line in text.splitlines() if line.startswith(("farm_ranks:", "mpm:"))]


def test_identical():
    """The outcomes are the same bits for any number of ranks and threads, cached or not, on every rank."""
    reference = None
    for ranks, threads in ((0, 1), (0, 3), (1, 1), (2, 1), (2, 2), (3, 1), (3, 2)):
        name = Path(f"{ranks}x{threads}")
        for cache in ([], ["--cache", "cache"]):  # the cache holds what the first such run has made
            run(ranks, FARM_RANKS, "batches", "--threads", threads, "--output", name, *cache, code=0)
            outputs = [name] + [Path(f"{name}.{rank}") for rank in range(1, ranks)]
            for output in outputs:
                found = output.read_bytes()
                reference = reference or found
                assert len(found) > 50_000 and found == reference, (output, cache)
                output.unlink()


def test_failing():
    """A run that fails is tried again on a finer grid, and its failure is an outcome: on any rank the same."""
    expected = ["[] [] 20", "[unstable at 1] [] 28", "[unstable at 1] [unstable at 1.4] 0", "[] [] 20",
                "made 4 retried 2 failed 1"]
    for ranks, threads in ((0, 2), (2, 1), (3, 1), (3, 2)):
        done = run(ranks, FARM_RANKS, "failing", "--threads", threads)
        assert done.returncode == 0 and done.stdout.splitlines() == expected, (ranks, done.stdout, done.stderr)


def test_trouble():
    """Whatever stops one rank stops all: one sentence, another exit code than 0, no hang."""
    for what, code, sentence in (("broken", 1, "rank 2: not enough memory"),
                                 ("stop-first", 130, "stopped by the user"),
                                 ("stop-last", 130, "rank 2: stopped"),
                                 ("stop-late", 130, "rank 2: stopped"),
                                 ("without", 1, "rank 2: not enough memory"),
                                 ("differ", 1, "MPI: rank 2 asks for other runs than rank 0"),
                                 ("alone", 1, "the last rank: has lost its disk")):
        done = run(3, FARM_RANKS, what, code=code)
        lines = own_lines(done.stderr)
        assert len(lines) == 1 and lines[0].startswith("farm_ranks: " + sentence), (what, done.stderr)


def alive(pid):
    try:
        return "\nState:\tZ" not in Path(f"/proc/{pid}/status").read_text()
    except (FileNotFoundError, ProcessLookupError):
        return False


def test_killed_rank():
    """kill -9 of one rank ends the others."""
    for victim in (0, 2):
        farm = subprocess.Popen(launched(3, FARM_RANKS, "endless"), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        pids = [int(farm.stdout.readline()) for _ in range(3)]
        time.sleep(0.5)  # into the batch
        assert all(map(alive, pids))
        os.kill(pids[victim], signal.SIGKILL)
        farm.communicate(timeout=HANG)
        assert farm.returncode != 0
        assert not any(map(alive, pids)), pids


def test_commands(monkeypatch):
    """mpm table runs on ranks; the other commands say in one sentence that they do not."""
    Path("m.toml").write_text(CHEAP)
    for words in (["info", "law.h5"], ["impact", "m.toml"]):
        done = run(2, MPM, *words)
        lines = own_lines(done.stderr)
        assert done.returncode == 1 and done.stdout == "", (words, done)
        assert len(lines) == 1 and "without mpirun" in lines[0] and "found 2 processes" in lines[0], (words, done.stderr)
    for words, code, wanted in ((["none.toml", "-o", "x.h5"], 1, "none.toml: no such file"),
                                (["m.toml"], 2, "--output is required"),
                                (["m.toml", "-o", "none/x.h5"], 1, "'none' does not exist"),
                                (["m.toml", "--no-atlas", "-o", "x.h5", "--cache", "m.toml/x"], 2, "--cache")):
        done = run(2, MPM, "table", *words)
        lines = own_lines(done.stderr)
        assert done.returncode == code and len(lines) == 1 and wanted in lines[0], (words, done.stderr)
    done = run(2, MPM, "table", "--help")
    assert done.returncode == 0 and done.stdout.count("Usage:") == 1, done.stdout
    monkeypatch.setenv("GRANULAW_ISA", "nonsense")
    done = run(2, MPM, "table", "m.toml", "--no-atlas", "-o", "x.h5")
    assert done.returncode == 1 and len(own_lines(done.stderr)) == 1 and "nonsense" in done.stderr, done.stderr


def payload(path):
    """Everything that the file holds, as bytes, but for the provenance and the checksum, which covers the provenance, too."""
    found = {}
    with h5py.File(path) as file:
        def visit(name, item):
            if name.split("/")[0] == "provenance":
                return
            if isinstance(item, h5py.Dataset):
                found[name] = np.asarray(item[()]).tobytes()
            found.update({f"{name}@{key}": np.asarray(value).tobytes() for key, value in item.attrs.items()})
        file.visititems(visit)
        found.update({f"@{key}": np.asarray(value).tobytes() for key, value in file.attrs.items() if key != "checksum"})
    return found


def table(output, *words):  # the law of tests/cli's test_table
    return [MPM, "table", "m.toml", "--no-atlas", "--depth", "0.15", "--inertia", "0.03", "--pair", "powder:wall", "--pair", "powder:powder", "-o", output, *words]


def kept_runs():
    return {p.name: p.stat().st_mtime_ns for p in Path("cache").glob("[!.]*.run")}  # one that is being written has another name


def kills(count, most_runs, ranks_of):
    """Builds on one cache are killed (-9) at random moments: each when it has kept up to `most_runs` new runs, and a
    moment later. The one that is left to end makes no finished run again and writes the undisturbed law."""
    Path("m.toml").write_text(CHEAP)
    seed = random.randrange(10**6)
    print("seed", seed)
    moments = random.Random(seed)
    killed = 0
    with h5py.File(LAW) as file:
        all_runs = int(file["provenance"].attrs["runs_made"]) + int(file["provenance"].attrs["runs_from_cache"])
    for k in range(count):
        ranks = ranks_of(k)
        left = all_runs - len(kept_runs())  # shared out, so that the last build to be killed has a run left, however fast they are
        wanted = len(kept_runs()) + moments.randint(0, min(most_runs, max(0, left - 1) // (count - k)))
        build = subprocess.Popen(launched(ranks, *table("law.h5", "--cache", "cache", "--jobs", "1" if ranks else "2")),
                                 stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while len(kept_runs()) < wanted and build.poll() is None:
            time.sleep(0.01)
        time.sleep(moments.uniform(0, 0.1))  # a run takes tenths of a second
        killed += build.poll() is None
        for pid in descendants(build.pid) + [build.pid]:  # mpirun's ranks and mpirun, at once
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
        build.wait()
        print(f"kill {k + 1} on {ranks or 'no'} ranks: {len(kept_runs())} runs kept")
    assert killed >= 0.6 * count, f"only {killed} builds were still alive when they were to be killed"
    kept = kept_runs()
    done = programs.run(*table("law.h5", "--cache", "cache"))
    print(done.stdout.splitlines()[-1])
    assert {name: made for name, made in kept_runs().items() if name in kept} == kept, "a finished run was made again"
    with h5py.File("law.h5") as file:
        notes = file["provenance"].attrs
        assert int(notes["runs_made"]) == len(kept_runs()) - len(kept) and int(notes["runs_from_cache"]) >= len(kept)
    law, undisturbed = payload("law.h5"), payload(LAW)
    assert len(law) > 20 and law == undisturbed, [k for k in law.keys() | undisturbed.keys() if law.get(k) != undisturbed.get(k)]


def descendants(pid):
    try:
        children = [int(p) for p in Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]
    except (FileNotFoundError, ProcessLookupError):
        return []
    return [d for child in children for d in descendants(child)] + children


def test_three_kills():
    kills(3, 4, lambda k: 0)


def test_ten_kills():
    kills(10, 1, lambda k: (0, 2, 3)[k % 3])
