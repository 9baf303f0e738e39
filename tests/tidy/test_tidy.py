"""clang-tidy on the product's sources that changed since a commit (default: the last but one), by the checks of .clang-tidy.

    test_tidy.py SOURCE BUILD [COMMIT]

First a file with a known defect: a run that does not name it has proven nothing. Exit 0: no finding; 1: findings; 77: no clang-tidy, or no history.
"""
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

PRODUCT = ("mpm_core/", "liggghts_plugin/", "engines/", "tools/")


def changed(source, commit):
    """Sources of the product that differ from the commit; None without one."""
    done = subprocess.run(["git", "-C", str(source), "diff", "--name-only", "--diff-filter=d", commit], capture_output=True, text=True)
    if done.returncode:
        return None
    # sub_models: sources that are compiled in another tree
    return sorted(f for f in done.stdout.split() if f.startswith(PRODUCT) and f.endswith(".cpp") and "/sub_models/" not in f)


def write_commands(build, folder):
    """The build's compile commands, also of each file that it compiles in a group."""
    commands = json.loads((build / "compile_commands.json").read_text())
    for one in list(commands):
        if "/Unity/" in one["file"]:
            members = re.findall(r'^#include "(.*)"$', pathlib.Path(one["file"]).read_text(), flags=re.M)
            commands += [{**one, "file": member, "command": one["command"].replace(one["file"], member)} for member in members]
    (folder / "compile_commands.json").write_text(json.dumps(commands))


def tidy(*words):
    return subprocess.run(["clang-tidy", "--quiet", *map(str, words)], capture_output=True, text=True)


def main():
    source, build = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
    if not shutil.which("clang-tidy"):
        print("skipped: clang-tidy is not installed (tools/setup --tidy)")
        return 77
    files = changed(source, sys.argv[3] if len(sys.argv) > 3 else "HEAD~1")
    if files is None:
        print("skipped: git has no commit to compare with")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        bad = pathlib.Path(folder) / "bad.cpp"
        bad.write_text("#include <string>\nbool f(std::string s) { return s == s; }\n")
        if "misc-redundant-expression" not in tidy(f"--config-file={source / '.clang-tidy'}", bad, "--", "-std=c++20").stdout:
            print("clang-tidy does not name the defect of a known bad file")
            return 1
        write_commands(build, pathlib.Path(folder))
        failed = 0
        for file in files:
            done = tidy("-p", folder, source / file)
            failed += done.returncode != 0
            print(f"{file}: {'findings' if done.returncode else 'clear'}\n{done.stdout}{done.stderr if done.returncode else ''}", flush=True)
    print(f"{len(files)} files, {failed} with findings")
    return 1 if failed else 0


sys.exit(main())
