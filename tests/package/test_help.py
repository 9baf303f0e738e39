#!/usr/bin/python3
"""The manual pages and the completion say what the program's help says.

    test_help.py MPM FOLDER_OF_tools/package_IN_THE_BUILD Manual|Completion"""
import gzip
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

MPM, MADE = sys.argv[1], pathlib.Path(sys.argv[2])


def help_of(*words):
    return subprocess.run([MPM, *words, "--help"], capture_output=True, text=True, check=True).stdout


def commands():
    return re.findall(r"^  ([a-z]+) ", help_of().partition("Subcommands:")[2], flags=re.M)


def options(*words):
    """Long names: at the start of an entry, several behind commas."""
    heads = re.findall(r"^  (-[^ \n]*)", help_of(*words), flags=re.M)
    return {re.sub(r"\{.*", "", name) for head in heads for name in head.split(",") if name.startswith("--")}


class Manual(unittest.TestCase):
    def text_of(self, name):
        page = gzip.decompress((MADE / f"man1/{name}.1.gz").read_bytes()).decode()
        if shutil.which("groff"):
            shown = subprocess.run(["groff", "-man", "-ww", "-z", "-Tutf8", "-k"], input=page, capture_output=True, text=True)
            self.assertEqual((shown.returncode, shown.stderr), (0, ""), name)
        return page.replace("\\-", "-")

    def test_each_command_has_its_page(self):
        self.assertGreater(len(commands()), 10)  # eleven and more; none: the help was not read
        for command in commands():
            page = self.text_of(f"mpm-{command}")
            for option in options(command):
                self.assertIn(rf"\fB{option}\fR", page)
            self.assertIn("(1)\n", self.text_of("mpm").partition(f"mpm-{command} ")[2])

    def test_each_option_says_what_it_is_for(self):
        for command in commands():
            page = self.text_of(f"mpm-{command}")
            for name, text in re.findall(r"^\.TP\n(.*)\n(.*)$", page, flags=re.M):
                self.assertRegex(text, r"\w\w", f"{command}: {name}")
                self.assertNotIn("   ", name, f"{command}: a head that swallowed its text")

    def test_no_path_of_the_builder(self):
        self.assertIn("~/.cache/granulaw/runs", self.text_of("mpm-table"))

    def test_launcher(self):
        if not (MADE / "man1/liggghts-mpm.1.gz").exists():
            self.skipTest("built without the plug-in")
        page = self.text_of("liggghts-mpm")
        for word in (r"\fB-in\fR", r"\fB-var\fR", r"\fB-log\fR", "mpm and thornton"):
            self.assertIn(word, page)


class Completion(unittest.TestCase):
    def offered(self, *words, folder="."):
        """Completions that a Tab behind the last of `words` offers."""
        script = f'. "{MADE}/mpm.bash"; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _mpm; printf "%s\\n" "${{COMPREPLY[@]}}"'
        shown = subprocess.run(["bash", "-c", script, "bash", *words], capture_output=True, text=True, cwd=folder)
        self.assertEqual(shown.stderr, "", words)
        return set(shown.stdout.split("\n")) - {""}

    def test_commands(self):
        self.assertEqual(self.offered("mpm", ""), {*commands(), *options()})
        self.assertEqual(self.offered("mpm", "ta"), {"table"})

    def test_options_are_those_of_the_help(self):
        for command in commands():
            self.assertEqual(self.offered("mpm", command, "--"), options(command), command)

    def test_words_stand_in_the_help(self):
        for command, option in (("impact", "--grid"), ("press", "--support"), ("impact", "--precision")):
            words = self.offered("mpm", command, option, "")
            self.assertGreater(len(words), 1)
            said = re.search(rf"^  {option} TEXT +(.*)", help_of(command), flags=re.M).group(1)
            for word in words:
                self.assertIn(word, said)

    def test_files_and_names(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("two words.toml", "law.h5", "in.hopper"):
                (pathlib.Path(folder) / name).touch()
            (pathlib.Path(folder) / "sub").mkdir()
            (pathlib.Path(folder) / "m.toml").write_text("[material.wax]\n[particle.pellet]\nmaterial = 'wax'\n[[particle.grain.layers]]\n")
            at = lambda *words: self.offered("mpm", *words, folder=folder)
            self.assertEqual(at("table", ""), {"two words.toml", "m.toml", "sub"})
            self.assertEqual(at("table", "two"), {"two words.toml"})
            self.assertEqual(at("law", ""), {"law.h5", "sub"})
            self.assertEqual(at("plan", "in"), {"in.hopper"})
            self.assertEqual(at("impact", "m.toml", "--particle", "p"), {"pellet"})
            self.assertEqual(at("impact", "m.toml", "--wall", ""), {"wax"})
            self.assertEqual(at("impact", "m.toml", "--velocity", ""), set())


unittest.main(argv=[sys.argv[0], sys.argv[3]])
