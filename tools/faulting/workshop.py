"""A scratch copy of the tree under build/faults, in which faults are put, built and tested; never in the working tree."""
import contextlib
import hashlib
import json
import os
import re
import resource
import shutil
import signal
import subprocess
import time
from pathlib import Path

# -O1: half the time of compiling. The kernels keep the -O3 of their target.
CONFIGURE = ("-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_FLAGS_RELEASE=-O1", "-DGRANULAW_BUILD_BENCHMARKS=OFF", "-DGRANULAW_UNITY=OFF")
MEMORY = 12 << 30  # bytes of address space: a faulty loop may ask for all there is
BUILD_LIMIT = 1800.0  # s

# Programs of unit tests, each file of which mirrors a header.
UNITS = ("granulaw_unit", "granulaw_contact_unit", "granulaw_calibrate_unit", "granulaw_plugin_unit", "granulaw_atlas_unit")
# Stages: what is built, which labels of ctest are run.
STAGES = {
    "unit": ((*UNITS, "granulaw_hostile_law", "read_law_replay", "read_materials_replay"), ("unit",)),
    "verification": (("granulaw_verification", "granulaw_restart", "granulaw_allocations"), ("verification",)),
    "cli": (("mpm",), ("cli", "hardcases")),
    "liggghts": (("liggghts-mpm", "granulaw_plugin", "law_fixture", "mpm"), ("liggghts",)),
    "rest": (("liggghts-mpm", "granulaw_plugin", "law_fixture", "mpm", "farm_ranks"), ("mpi", "examples", "hopper")),
}
# Stages whose programs hold the code of a folder, in the order to run them: those before the battery, those after it.
REACH = {
    "mpm_core/solver": (("verification", "unit", "cli"), ("rest",)),
    "mpm_core/contact": (("unit", "cli"), ("liggghts", "rest")),
    "mpm_core/law": (("unit", "cli"), ("liggghts", "rest")),
    "mpm_core/characterise": (("unit", "cli"), ("rest",)),
    "liggghts_plugin": (("liggghts",), ("unit", "rest")),
    "tools/deck": (("unit", "cli"), ("liggghts", "rest")),
    "tools/mpm": (("cli", "unit"), ("liggghts", "rest")),
}
# Libraries that the unit test of one file of a folder needs at most.
MIRRORED = {
    "mpm_core/solver": ("solver", "base"),
    "mpm_core/contact": ("contact",),
    "mpm_core/law": ("law", "contact", "base"),
    "mpm_core/characterise": ("characterise", "calibrate", "atlas", "farm", "solver", "law", "contact", "base"),
    "liggghts_plugin": ("plugin_core",),
    "tools/deck": ("deck", "law", "contact", "base"),
    "tools/mpm": ("mpm_parts", "material_file", "run_files", "deck", "characterise", "farm", "solver", "law", "contact", "base"),
}
NO_CODE = ("faults.rules", "farm.solver_hash", "report.report", "liggghts_copy_to_src", "install.consumer", "docs.links", "docs.book")  # they run none of the seven folders
CHEAP = 2.0  # s; tests up to it come before the battery
FAIR = 20.0  # s; up to it they are run where the battery shows no change, too


class Broken(Exception):
    """The sound tree itself cannot be used."""


def run(command, limit, cwd=None, env=None, log=None):
    """(exit status or None at the limit, output). The whole process group ends with it."""
    def alone():
        os.setsid()
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    with open(log, "w+b") if log else open(os.devnull, "w+b") as out:
        child = subprocess.Popen([str(w) for w in command], cwd=cwd, env=env, stdin=subprocess.DEVNULL, stdout=out, stderr=subprocess.STDOUT,
                                 preexec_fn=alone)
        try:
            status = child.wait(timeout=limit)
        except subprocess.TimeoutExpired:
            status = None
        finally:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(child.pid, signal.SIGKILL)
            child.wait()
        out.seek(0)
        return status, out.read().decode(errors="replace") if log else ""


class Test:
    def __init__(self, entry):
        properties = {p["name"]: p["value"] for p in entry.get("properties", [])}
        self.name, self.command = entry["name"], entry.get("command", [])
        self.labels = properties.get("LABELS", [])
        self.folder = properties.get("WORKING_DIRECTORY")
        self.environment = dict(word.split("=", 1) for word in properties.get("ENVIRONMENT", []))
        self.needs = set(properties.get("FIXTURES_REQUIRED", []))
        self.gives = set(properties.get("FIXTURES_SETUP", []))
        self.skipped = properties.get("SKIP_RETURN_CODE")
        self.seconds = 0.0


class Workshop:
    def __init__(self, top, jobs, say):
        self.top, self.jobs, self.say = Path(top), jobs, say
        self.home = self.top / "build" / "faults"
        self.source, self.build = self.home / "source", self.home / "build"
        self.temporary = self.home / "tmp"
        self.env = {**os.environ, "CCACHE_DIR": str(self.home / "ccache"), "TMPDIR": str(self.temporary),
                    "XDG_CACHE_HOME": str(self.temporary / "cache"), "OMPI_ALLOW_RUN_AS_ROOT": "1",
                    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMP_NUM_THREADS": "1"}
        self.tests = {}

    def clean(self):
        shutil.rmtree(self.temporary, ignore_errors=True)
        self.temporary.mkdir(parents=True)

    def copy_tree(self):
        """The scratch copy is made what the working tree is now; files that are alike keep their date, so that ninja rests."""
        words = ["git", "-C", self.top, "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
        listed = subprocess.run([str(w) for w in words], capture_output=True, check=True).stdout.decode().split("\0")
        names = {n for n in listed if n and (self.top / n).is_file()}
        for name in names:
            from_, to = self.top / name, self.source / name
            if not to.is_file() or to.read_bytes() != from_.read_bytes():
                to.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(from_, to)
        for path in self.source.rglob("*"):
            if path.is_file() and path.relative_to(self.source).as_posix() not in names:
                path.unlink()

    def prepare(self):
        """A sound build, the list of quick tests, and what each takes."""
        self.clean()
        self.source.mkdir(parents=True, exist_ok=True)
        self.copy_tree()
        launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
        self.say("configures the scratch copy")
        log = self.home / "build.log"
        status, text = run(["cmake", "-S", self.source, "-B", self.build, *CONFIGURE, *launcher], 600, env=self.env, log=log)
        if status != 0:
            raise Broken(f"the scratch copy cannot be configured: see {log}\n{text[-2000:]}")
        self.say("builds the sound tree (the first time some twenty minutes)")
        problem = self.make(sorted({t for targets, _ in STAGES.values() for t in targets}), 7200)
        if problem:
            raise Broken(f"the sound tree does not build: see {log}\n{problem[-2000:]}")
        self.list_tests()
        self.time_tests()

    def make(self, targets, limit=BUILD_LIMIT):
        """None, or what the build said as it failed."""
        status, text = run(["ninja", "-C", self.build, "-j", self.jobs, *targets], limit, env=self.env, log=self.home / "build.log")
        return None if status == 0 else text or "took too long"

    def fingerprint(self):
        """Hash of everything that is compiled or decides what the battery runs."""
        hasher = hashlib.sha256()
        for folder in ("mpm_core", "tools", "liggghts_plugin", "cmake"):
            for path in sorted(p for p in (self.source / folder).rglob("*") if p.is_file()):
                hasher.update(path.relative_to(self.source).as_posix().encode() + b"\0" + path.read_bytes())
        return hasher.hexdigest()

    def mirror(self, fault):
        """The unit tests of the faulty file's own *_test.cpp, without compiling the others: verdict and by, or None.

        A header of the law is in most of the unit tests; its own test says most.
        """
        stem = Path(fault.path).stem + "_test"
        own = None
        for unit in UNITS:
            said = subprocess.run(["ninja", "-C", str(self.build), "-t", "commands", unit], capture_output=True, text=True).stdout
            words = said.strip().splitlines()[-1].split() if said else []
            own = next((w for w in words if w.endswith(f"/{stem}.cpp.o") and f"/{unit}.dir/" in w), None)
            if own and "-o" in words:
                break
        else:
            return None
        ours = [w for w in words if w.endswith(".a") and not w.startswith("/")]
        libraries = [w for w in ours if any(w.endswith(f"granulaw_{n}.a") for n in MIRRORED[fault.folder])]
        problem = self.make([own, *libraries])
        if problem:
            return "not compiled", problem
        program = self.temporary / stem
        compiler = next(w for w in words if w.endswith("++"))
        rest = words[words.index("-o") + 2:]
        rest = rest[:rest.index("&&")] if "&&" in rest else rest
        stale = [w for w in ours if w not in libraries]  # not built just now
        status, _ = run([compiler, own, *(w for w in rest if w not in stale), "-o", program], 300, cwd=self.build, env=self.env, log=self.home / "build.log")
        if status != 0:
            return None  # it needs another's objects: the whole stage follows
        status, text = run([program, "--gtest_fail_fast", "--gtest_filter=-*Slow.*"], 120, env=self.env, log=self.home / "mirror.log")
        if status == 0:
            return None
        failed = re.search(r"\[  FAILED  \] ([\w./]+)", text)
        return "caught", failed[1] if failed else stem

    def list_tests(self):
        done = subprocess.run(["ctest", "--test-dir", str(self.build), "-LE", "slow", "--show-only=json-v1"], capture_output=True, text=True,
                              env=self.env, check=True)
        tests = [Test(t) for t in json.loads(done.stdout)["tests"]]
        self.tests = {t.name: t for t in tests if t.command and t.name not in NO_CODE}

    def time_tests(self):
        """Each test once on the sound tree; kept in sound.json. A test that fails there is left out, and named."""
        file = self.home / "sound.json"
        try:
            known = json.loads(file.read_text())
        except (OSError, ValueError):
            known = {}
        fresh = [t for t in self.in_order(self.tests) if not known.get(t.name)]
        for k, test in enumerate(fresh):
            self.say(f"times the sound tree's tests: {k + 1} of {len(fresh)}, {test.name}")
            start = time.monotonic()
            passed = self.passes(test, 900)
            known[test.name] = time.monotonic() - start if passed else 0.0
            file.write_text(json.dumps(known, indent=1))
        for name, test in list(self.tests.items()):
            test.seconds = known[name]
            if not known[name]:
                self.say(f"{name} fails on the sound tree: left out", lasting=True)
                del self.tests[name]

        for stage in ("unit", "verification"):  # the same, many in one process
            failed = self.first_failure(self.stage_tests(stage, CHEAP), lambda name: self.say(f"the sound tree, {name}"))
            if failed:
                raise Broken(f"{failed} fails on the sound tree when it runs in one process with others: see {self.home}/tests.log")

    def in_order(self, tests):
        """Cheapest first; one that needs a fixture after the test that makes it."""
        makers = {g: t for t in self.tests.values() for g in t.gives}
        def key(test):
            cost = max([test.seconds] + [makers[n].seconds for n in test.needs if n in makers])
            return cost, bool(test.needs), test.name
        return sorted((self.tests[t] for t in tests), key=key)

    def stage_tests(self, stage, most):
        """Those that take up to `most` seconds, with what they need."""
        labels = set(STAGES[stage][1])
        cost = {t.name: max([t.seconds] + [m.seconds for m in self.tests.values() if m.gives & t.needs]) for t in self.tests.values()}
        return self.in_order([t.name for t in self.tests.values() if labels & set(t.labels) and cost[t.name] <= most])

    def passes(self, test, limit):
        status, _ = run(test.command, limit, cwd=test.folder, env={**self.env, **test.environment})
        return status == 0 or (test.skipped is not None and status == int(test.skipped))

    def filter_of(self, test):
        """The name of a GoogleTest case within its program; None: another kind of test."""
        words = [w for w in test.command if w.startswith("--gtest_filter=")]
        return words[0].split("=", 1)[1] if words else None

    def first_failure(self, tests, say):
        """The name of the first test that fails. Cases of one program run in one process, up to FAIR seconds together."""
        while tests:
            group, name = [tests[0]], self.filter_of(tests[0])
            if name:
                for test in tests[1:]:
                    if test.command[0] == group[0].command[0] and test.environment == group[0].environment \
                            and sum(t.seconds for t in group) + test.seconds < FAIR:
                        group.append(test)
            tests = [t for t in tests if t not in group]
            say(f"{group[0].name}" + (f" and {len(group) - 1} more" if group[1:] else ""))
            if not group[1:]:
                if not self.passes(group[0], self.limit_of(group[0])):
                    return group[0].name
                continue
            command = [group[0].command[0], "--gtest_filter=" + ":".join(map(self.filter_of, group)), "--gtest_fail_fast"]
            status, text = run(command, max(30.0, 5 * sum(t.seconds for t in group)), cwd=group[0].folder, env={**self.env, **group[0].environment},
                               log=self.home / "tests.log")
            if status != 0:
                told = re.findall(r"\[  FAILED  \] ([\w./]+)", text) or re.findall(r"\[ RUN      \] ([\w./]+)", text)[-1:]
                return told[0] if told else group[0].name
        return None

    def limit_of(self, test):
        """Five times what it took sound: beyond, it hangs. (Other work on the machine may slow it.)"""
        return max(15.0, 5 * test.seconds)

    @contextlib.contextmanager
    def fault(self, fault):
        """The scratch file with the fault in it; on leaving, as it was."""
        path = self.source / fault.path
        whole = path.read_text()
        lines = whole.split("\n")
        if lines[fault.line - 1] != fault.before:
            raise Broken(f"{fault.path}:{fault.line} is not what it was")
        lines[fault.line - 1] = fault.after
        path.write_text("\n".join(lines))
        try:
            yield
        finally:
            path.write_text(whole)
            self.clean()
