"""No script shows its user a traceback: a missing module, file or folder, a failed program, is one sentence and a non-zero exit."""
import re

import programs
from programs import ROOT
from pytest import mark

SCRIPTS = [p for folder in ("tools", "examples", "docs") for p in sorted((ROOT / folder).rglob("*"))
           if p.is_file() and p.read_bytes()[:18] == b"#!/usr/bin/python3"]
MODULES = ("numpy", "h5py", "matplotlib", "PIL")


def run(*words, code=..., **environment):
    return programs.run("/usr/bin/python3", *words, code=code, env=environment)


def test_each_has_it():
    assert len(SCRIPTS) > 25
    for path in SCRIPTS:
        assert "import one_sentence" in path.read_text(), path


@mark.parametrize("path", SCRIPTS, ids=lambda path: str(path.relative_to(ROOT)))
def test_a_missing_module(path, folder):
    """Also of the scripts that another Python than Debian's runs."""
    for name in MODULES:
        (folder / f"{name}.py").write_text(f"raise ModuleNotFoundError(\"No module named '{name}'\", name='{name}')\n")
    done = run(path, "--help", PYTHONPATH=str(folder))
    assert "Traceback" not in done.stderr
    if any(f"import {name}" in path.read_text() for name in MODULES):
        assert done.returncode == 1
        assert re.search(r"^\S+: /usr/bin/python3 has no module '\w+': use /usr/bin/python3 and install python3-\w+\n$", done.stderr)


def test_files_and_folders(folder):
    """Each line: the words of a command, and words of its sentence."""
    nowhere = folder / "no" / "where"
    (folder / "scene").mkdir()
    (folder / "hopper.csv").write_text("model,seed,quantity,value\nmpm,1,rate,1\n")
    for words, sentence in (
            (("tools/report", "--from", folder, "-o", "/proc/report"), "report: /proc/report: No such file or directory"),
            (("tools/mpm/plot_fields.py", nowhere, "x.png"), "no such file"),
            (("examples/planned.py", nowhere), f"{nowhere}: no such folder"),
            (("examples/differences.py", nowhere), f"{nowhere}: no such folder"),
            (("examples/hopper/report.py", nowhere, "-o", folder), str(nowhere)),
            (("examples/hopper/make_scene.py", "-o", "/proc/scene"), "/proc/scene: No such file or directory"),
            (("examples/irregular/make_grain.py", "-o", "/proc/grain"), "/proc/grain"),
            (("examples/silo/ranks.py", nowhere), str(nowhere))):
        said = run(ROOT / words[0], *words[1:], code=None).stderr
        assert "Traceback" not in said and sentence in said and len(said.splitlines()) == 1, (words, said)


@mark.parametrize("line, sentence", (("import subprocess; subprocess.run(['false'], check=True)", "`false` failed (1)"),
                                     ("raise KeyboardInterrupt", "interrupted"), ("raise MemoryError", "not enough memory"),
                                     ("{}['key']", "unexpected KeyError in <string>, line 1: 'key' (GRANULAW_TRACEBACK=1 shows the whole)")))
def test_what_else_may_happen(line, sentence):
    words = ("-c", f"import sys; sys.path.insert(0, {str(ROOT / 'examples/common')!r}); import one_sentence; {line}")
    assert run(*words, code=None).stderr == f"-c: {sentence}\n"
    assert "Traceback" in run(*words, GRANULAW_TRACEBACK="1").stderr
