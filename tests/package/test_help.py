"""The manual pages and the completion say what the program's help says."""
import gzip
import os
import pathlib
import re
import shutil

from programs import MPM, ROOT, mpm, run
from pytest import mark, skip

MADE = pathlib.Path(os.environ["GRANULAW_OF_HELP"])  # tools/package in the build


def help_of(*words):
    return mpm(*words, "--help").stdout


def commands():
    return re.findall(r"^  ([a-z]+) ", help_of().partition("Commands ")[2], flags=re.M)


def options(*words, ends="--"):
    """Names: at the start of an entry, several behind commas."""
    heads = re.findall(r"^  (-[^ \n{]*)", help_of(*words), flags=re.M)
    return {name for head in heads for name in head.split(",") if name.startswith(ends)}


class TestManual:
    def text_of(self, name):
        path = MADE / f"man1/{name}.1.gz"
        if not path.exists():
            skip("built without help2man or the plug-in")
        page = gzip.decompress(path.read_bytes()).decode()
        if shutil.which("groff"):
            assert run("groff", "-man", "-ww", "-z", "-Tutf8", "-k", input=page).stderr == "", name
        return page.replace("\\-", "-")

    @mark.parametrize("command", commands())
    def test_each_command_has_its_page(self, command):
        page = self.text_of(f"mpm-{command}")
        assert re.search(rf"^mpm-{command} - \w.*[^.]$", page, flags=re.M)
        for option in options(command):
            assert re.search(rf"^\.[TH]P\n.*{option}\b.*\n.*\w\w", page, flags=re.M), option
        assert re.search(rf"^\.TP\n{command}\n\w", self.text_of("mpm"), flags=re.M)

    def test_no_path_of_the_builder(self):
        assert "~/.cache/granulaw/runs" in self.text_of("mpm-table")

    def test_launcher(self):
        page = self.text_of("liggghts-mpm")
        for word in (r"\fB-in\fR", r"\fB-var\fR", r"\fB-log\fR", "mpm and thornton"):
            assert word in page


class TestCompletion:
    def offered(self, *words):
        """Completions that a Tab behind the last of `words` offers, beside files."""
        script = f'. "{ROOT}/tools/package/completion.bash"; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _mpm; printf "%s\\n" "${{COMPREPLY[@]}}"'
        shown = run("bash", "-c", script, "bash", MPM, *words)
        assert shown.stderr == "", words
        return set(shown.stdout.split("\n")) - {""}

    def test_commands(self):
        assert self.offered("") == set(commands())
        assert self.offered("ta") == {"table"}
        assert self.offered("--") == options()

    @mark.parametrize("command", commands())
    def test_options_are_those_of_the_help(self, command):
        assert self.offered(command, "-") == options(command, ends="-")
        assert self.offered(command, "--j") == options(command, ends="--j")

    def test_files(self):
        """Nothing is offered where a file is expected: the shell offers its files."""
        assert self.offered("table", "m") == set()
