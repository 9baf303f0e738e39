#!/usr/bin/python3
"""No script shows its user a traceback: a missing module, file or folder, a failed program, is one sentence and a non-zero exit."""
import os
import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPTS = [p for folder in ("tools", "examples", "docs") for p in sorted((ROOT / folder).rglob("*"))
           if p.is_file() and p.read_bytes()[:18] == b"#!/usr/bin/python3"]
MODULES = ("numpy", "h5py", "matplotlib", "PIL")


def run(*words, **environment):
    return subprocess.run(["/usr/bin/python3", *map(str, words)], capture_output=True, text=True, stdin=subprocess.DEVNULL,
                          env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1", **environment})


class Scripts(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="granulaw-sentence-")))

    def test_each_has_it(self):
        self.assertGreater(len(SCRIPTS), 25)
        for path in SCRIPTS:
            self.assertIn("import one_sentence", path.read_text(), path)

    def test_a_missing_module(self):
        """Also of the scripts that another Python than Debian's runs."""
        for name in MODULES:
            (self.folder / f"{name}.py").write_text(f"raise ModuleNotFoundError(\"No module named '{name}'\", name='{name}')\n")
        for path in SCRIPTS:
            with self.subTest(path.relative_to(ROOT)):
                done = run(path, "--help", PYTHONPATH=str(self.folder))
                self.assertNotIn("Traceback", done.stderr)
                if any(f"import {name}" in path.read_text() for name in MODULES):
                    self.assertEqual(done.returncode, 1)
                    self.assertRegex(done.stderr, r"^\S+: /usr/bin/python3 has no module '\w+': use /usr/bin/python3 and install python3-\w+\n$")

    def test_files_and_folders(self):
        """Each line: the words of a command, and words of its sentence."""
        nowhere = self.folder / "no" / "where"
        (self.folder / "scene").mkdir()
        for words, sentence in (
                (("tools/report", "--from", self.folder, "-o", "/proc/report"), "report: /proc/report: No such file or directory"),
                (("tools/mpm/plot_fields.py", nowhere, "x.png"), "no such file"),
                (("examples/planned.py", nowhere), f"{nowhere}: no such folder"),
                (("examples/differences.py", nowhere), f"{nowhere}: no such folder"),
                (("examples/hopper/report.py", nowhere, "-o", self.folder), str(nowhere)),
                (("examples/hopper/make_scene.py", "-o", "/proc/scene"), "/proc/scene: No such file or directory"),
                (("examples/irregular/make_grain.py", "-o", "/proc/grain"), "/proc/grain"),
                (("examples/silo/ranks.py", nowhere), str(nowhere))):
            with self.subTest(" ".join(map(str, words))):
                done = run(ROOT / words[0], *words[1:])
                self.assertNotEqual(done.returncode, 0)
                self.assertNotIn("Traceback", done.stderr)
                self.assertIn(sentence, done.stderr)
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)

    def test_what_else_may_happen(self):
        for line, sentence in (("import subprocess; subprocess.run(['false'], check=True)", "`false` failed (1)"),
                               ("raise KeyboardInterrupt", "interrupted"), ("raise MemoryError", "not enough memory"),
                               ("{}['key']", "unexpected KeyError in <string>, line 1: 'key' (GRANULAW_TRACEBACK=1 shows the whole)")):
            words = ("-c", f"import sys; sys.path.insert(0, {str(ROOT / 'examples/common')!r}); import one_sentence; {line}")
            done = run(*words)
            self.assertNotEqual(done.returncode, 0)
            self.assertEqual(done.stderr, f"-c: {sentence}\n")
            self.assertIn("Traceback", run(*words, GRANULAW_TRACEBACK="1").stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
