"""The manual pages and the completion of the build say what the program's help says."""
import gzip
import os
import pathlib
import re
import shutil

from programs import mpm, run
from pytest import mark, skip

MADE = pathlib.Path(os.environ["GRANULAW_OF_HELP"])  # tools/package in the build


def help_of(*words):
    return mpm(*words, "--help").stdout


def commands():
    return re.findall(r"^  ([a-z]+) ", help_of().partition("Subcommands:")[2], flags=re.M)


def options(*words):
    """Long names: at the start of an entry, several behind commas."""
    heads = re.findall(r"^  (-[^ \n]*)", help_of(*words), flags=re.M)
    return {re.sub(r"\{.*", "", name) for head in heads for name in head.split(",") if name.startswith("--")}


class TestManual:
    def text_of(self, name):
        page = gzip.decompress((MADE / f"man1/{name}.1.gz").read_bytes()).decode()
        if shutil.which("groff"):
            assert run("groff", "-man", "-ww", "-z", "-Tutf8", "-k", input=page).stderr == "", name
        return page.replace("\\-", "-")

    def test_each_command_has_its_page(self):
        assert len(commands()) > 10  # eleven and more; none: the help was not read
        for command in commands():
            page = self.text_of(f"mpm-{command}")
            for option in options(command):
                assert rf"\fB{option}\fR" in page
            assert "(1)\n" in self.text_of("mpm").partition(f"mpm-{command} ")[2]

    @mark.parametrize("command", commands())
    def test_each_option_says_what_it_is_for(self, command):
        page = self.text_of(f"mpm-{command}")
        for name, text in re.findall(r"^\.TP\n(.*)\n(.*)$", page, flags=re.M):
            assert re.search(r"\w\w", text), f"{command}: {name}"
            assert "   " not in name, f"{command}: a head that swallowed its text"

    def test_no_path_of_the_builder(self):
        assert "~/.cache/granulaw/runs" in self.text_of("mpm-table")

    def test_launcher(self):
        if not (MADE / "man1/liggghts-mpm.1.gz").exists():
            skip("built without the plug-in")
        page = self.text_of("liggghts-mpm")
        for word in (r"\fB-in\fR", r"\fB-var\fR", r"\fB-log\fR", "mpm and thornton"):
            assert word in page


class TestCompletion:
    def offered(self, *words, folder="."):
        """Completions that a Tab behind the last of `words` offers."""
        script = f'. "{MADE}/mpm.bash"; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _mpm; printf "%s\\n" "${{COMPREPLY[@]}}"'
        shown = run("bash", "-c", script, "bash", *words, cwd=folder, code=...)
        assert shown.stderr == "", words
        return set(shown.stdout.split("\n")) - {""}

    def test_commands(self):
        assert self.offered("mpm", "") == {*commands(), *options()}
        assert self.offered("mpm", "ta") == {"table"}

    @mark.parametrize("command", commands())
    def test_options_are_those_of_the_help(self, command):
        assert self.offered("mpm", command, "--") == options(command), command

    @mark.parametrize("command, option", (("impact", "--grid"), ("press", "--support"), ("impact", "--precision")))
    def test_words_stand_in_the_help(self, command, option):
        words = self.offered("mpm", command, option, "")
        assert len(words) > 1
        said = re.search(rf"^  {option} TEXT +(.*)", help_of(command), flags=re.M).group(1)
        for word in words:
            assert word in said

    def test_files_and_names(self, folder):
        for name in ("two words.toml", "law.h5", "in.hopper"):
            (folder / name).touch()
        (folder / "sub").mkdir()
        (folder / "m.toml").write_text("[material.wax]\n[particle.pellet]\nmaterial = 'wax'\n[[particle.grain.layers]]\n")
        at = lambda *words: self.offered("mpm", *words, folder=folder)
        assert at("table", "") == {"two words.toml", "m.toml", "sub"}
        assert at("table", "two") == {"two words.toml"}
        assert at("law", "") == {"law.h5", "sub"}
        assert at("plan", "in") == {"in.hopper"}
        assert at("impact", "m.toml", "--particle", "p") == {"pellet"}
        assert at("impact", "m.toml", "--wall", "") == {"wax"}
        assert at("impact", "m.toml", "--velocity", "") == set()
