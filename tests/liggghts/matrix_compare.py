"""Runs one deck of the matrix and reads all that it wrote; compares two runs number by number."""
import functools
import os
import pathlib
import re
import signal
import subprocess
import tempfile

import matrix_scene
from harness import FIXTURE, LAUNCHER, MPIRUN

STOCK = os.environ.get("GRANULAW_STOCK", "liggghts")
LIMIT = 60  # s
NOTHING = 1e-9  # the largest value of a column that counts as zero: torques of no friction, N m
BINARY = (".restart", ".h5", ".own", ".log", ".deck", ".png", ".jpg", ".ppm", ".bin", ".cite")
NOT_A_NUMBER = re.compile(r"(?<![A-Za-z_])[-+]?(nan|inf)(?![A-Za-z_])", re.I)

LAWS = {"powder.h5": (), "composed.h5": ("composed",)}  # file, words of law_fixture


@functools.cache
def law_folder():
    """Folder of the synthetic laws, written once."""
    folder = pathlib.Path(tempfile.mkdtemp(prefix="granulaw-matrix-law-"))
    for name, words in LAWS.items():
        subprocess.run([FIXTURE, "write", str(folder / name), *words], check=True)
    return folder


class Run:
    """status, text (what was printed), tables: {name: rows of words} of each file and of the thermo output, energies: rows of energy.own."""

    def __init__(self, status, text, folder, given):
        self.status, self.text = status, text
        self.tables = {"thermo": thermo(folder / "liggghts.log")}
        self.energies = []
        if (folder / "energy.own").exists():
            lines = (folder / "energy.own").read_text().splitlines()
            self.energies = [[float(w) for w in line.split()] for line in lines if not line.startswith("#")]
        for path in sorted(folder.rglob("*")):
            if path.is_file() and not path.is_symlink() and path.name not in given and path.suffix not in BINARY:
                self.tables[str(path.relative_to(folder))] = rows(path)

    def sentence(self):
        """The line that refused the run; None if there is no such line."""
        found = [line for line in self.text.splitlines() if line.startswith("ERROR")]
        if not found:
            return None
        return re.sub(r"^ERROR on proc \d+:", "ERROR:", re.sub(r"\s*\([^()]*\.(cpp|hpp|h):\d+\)", "", found[0]))

    def not_numbers(self):
        return [name for name, lines in self.tables.items() if any(NOT_A_NUMBER.search(" ".join(line)) for line in lines)]


def run_all(feature, variants, program=None):
    """{variant: Run} of variants on equally many ranks and of one program; left out: that of the model. One process, `clear` between the decks; where one ends it, the rest in another.
    Where the first deck of a model ends it, the model's others are left out. A program that is named gets a process for each deck: `clear` takes
    liggghts-mpm's classes from Hertz, which does not bring them again."""
    result, left = {}, list(variants)
    with tempfile.TemporaryDirectory(prefix="granulaw-matrix-") as name:
        top = pathlib.Path(name)
        given = matrix_scene.files(feature)
        for k, variant in enumerate(variants):
            folder = top / str(k)
            folder.mkdir()
            for file, text in given.items():
                (folder / file).write_text(text)
            for law in LAWS:
                (folder / law).symlink_to(law_folder() / law)
            (folder / "in.deck").write_text("log liggghts.log\n" + matrix_scene.deck(feature, variant))
        while left:
            numbers = [variants.index(v) for v in left][:1 if feature.alone or program else None]
            (top / "in.all").write_text("clear\n".join(f"print \"DECK {k}\"\nshell cd {k}\ninclude in.deck\nlog none\nshell cd ..\n" for k in numbers))
            status, text, last_words = process(top, variants[0], program or (STOCK if variants[0].model == "hertz" else LAUNCHER))
            shown = re.split(r"^DECK (\d+)$", text, flags=re.M)
            shown = dict(zip(map(int, shown[1::2]), shown[2::2]))
            ended = max(shown, default=numbers[0]) if status != 0 else None
            for k in numbers:
                if ended is None or k <= ended:
                    bad = k == ended
                    result[variants[k]] = Run(status if bad else 0, shown.get(k, "") + (last_words if bad else ""), top / str(k), {*given, "in.deck"})
                    left.remove(variants[k])
                    if bad and not any(v.model == variants[k].model for v in variants[:k]):  # the plain deck ends: so will the model's others
                        left = [v for v in left if v.model != variants[k].model]
                        break
    return result


def process(top, variant, program):
    command = ["stdbuf", "-oL", program, "-in", "in.all", "-log", "none"]  # by lines: else the last ones are lost with MPI_Abort
    if variant.ranks > 1:
        command = [MPIRUN, "--oversubscribe", "--bind-to", "none", "--mca", "mpi_yield_when_idle", "1", "-np", str(variant.ranks)] + command
    with open(top / "stdout", "w") as out, open(top / "stderr", "w") as errors:
        running = subprocess.Popen(command, stdout=out, stderr=errors, cwd=top, start_new_session=True,
                                   env={**os.environ, "OMPI_MCA_orte_tmpdir_base": str(top)})
        try:
            status = running.wait(timeout=LIMIT)
        except subprocess.TimeoutExpired:
            os.killpg(running.pid, signal.SIGKILL)  # mpirun and its ranks
            running.wait()
            status = "late"
    return status, (top / "stdout").read_text(errors="backslashreplace"), (top / "stderr").read_text(errors="backslashreplace")


def rows(path):
    text = path.read_bytes().decode("ascii", "backslashreplace")
    text = re.sub(r"\b0x[0-9a-f]+\b", "ADDRESS", text)  # LIGGGHTS's XML names arrays by their address
    found = (re.split(r'[\s"<>=]+', line.strip()) for line in text.splitlines())
    return [[word for word in words if word] for words in found if any(words)]


def thermo(log):
    """Rows of thermo values, and of `print "OUT ..."`."""
    found, reading = [], False
    for line in (log.read_text(errors="backslashreplace").splitlines() if log.exists() else []):
        if line.startswith("Step "):
            reading = True
        elif line.startswith("Loop time"):
            reading = False
        elif line.startswith("OUT "):
            found.append(line.split())
        elif reading and line.split() and all(number(w) is not None for w in line.split()):
            found.append(line.split())
    return found


def number(word):
    try:
        return float(word)
    except ValueError:
        return None


def in_order(table):
    """Rows of a dump's `ITEM: ENTRIES` sorted, as the order of contacts is nobody's."""
    result, block, sorting = [], [], False
    for row in table + [["ITEM:"]]:
        if row[0] == "ITEM:":
            result += sorted(block, key=lambda r: [round(number(w) or 0.0, 6) for w in r if re.fullmatch(r"-?\d+", w)]) if sorting else block
            block, sorting = [], row[1:2] == ["ENTRIES"]
            result.append(row)
        else:
            block.append(row)
    return result[:-1]


def difference(tables, wanted, tolerance, skip=()):
    """Difference of two runs by more than `tolerance` of the largest value of a column: a sentence, else None; and the largest difference."""
    worst = 0.0
    for name in sorted(wanted.keys() | tables.keys()):
        if any(re.fullmatch(pattern, name) for pattern in skip):
            continue
        if name not in tables or name not in wanted:
            return f"{name}: written by {'hertz' if name in wanted else 'this model'} only", None
        ours, stock = in_order(tables[name]), in_order(wanted[name])
        if [len(r) for r in ours] != [len(r) for r in stock]:
            return f"{name}: {len(ours)} lines, hertz {len(stock)}", None
        scale = {}
        for row in stock:
            for k, word in enumerate(row):
                value = number(word)
                if value is not None:
                    scale[len(row), k] = max(scale.get((len(row), k), 0.0), abs(value))
        for line, (a, b) in enumerate(zip(ours, stock)):
            for k, (x, y) in enumerate(zip(a, b)):
                if x == y:
                    continue
                x_number, y_number = number(x), number(y)
                if x_number is None or y_number is None:
                    return f"{name}, line {line + 1}: '{x}', hertz '{y}'", None
                apart = abs(x_number - y_number) / max(scale[len(b), k], NOTHING)
                if not apart <= tolerance:
                    return f"{name}, line {line + 1}, column {k + 1}: {x}, hertz {y}", apart
                worst = max(worst, apart)
    return None, worst
