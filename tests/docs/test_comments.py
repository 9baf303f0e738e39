"""Comments of the C and C++ sources name files that exist."""
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
NAME = re.compile(r"(?<![\w/.<*-])\w[\w/.-]*\.(?:hpp|cpp|h|c|py|md|csv)\b")
# files of LIGGGHTS, and what programs write
OTHERS = {"fix_insert_stream.h", "granular_styles.h", "_model.h", "global_properties.h", "math_extra_liggghts_superquadric.cpp", "conversion.md"}


def endings(paths):
    """Every name by which a path may be called: itself, and each of its ends."""
    return {"/".join(parts[k:]) for parts in (path.split("/") for path in paths) for k in range(len(parts))}


def unknown(text, known):
    """Names of files in the comments of a source that no file has; capitals stand for any word."""
    comments = (line.split("//", 1)[1] for line in text.splitlines() if "//" in line)
    return [name for comment in comments for name in NAME.findall(comment)
            if name not in known and name not in OTHERS and not re.search("[A-Z]{2}", name)]


def main():
    listed = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True).stdout.split()
    known = endings(listed)
    assert unknown("int a;  // see flow/none.hpp", known) == ["flow/none.hpp"], "a name that no file has is not found"
    found = [f"{path}: {name}" for path in listed if path.endswith((".hpp", ".cpp", ".h", ".c"))
             for name in unknown((ROOT / path).read_text(errors="replace"), known)]
    assert not found, "\n".join(found)


if __name__ == "__main__":
    sys.exit(main())
