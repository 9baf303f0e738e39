"""Each folder of the solver includes only headers of those above it in the table of docs/reference/source-tree.md."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
SOLVER = ROOT / "mpm_core" / "solver"


def folders(page):
    return re.findall(r"\| `mpm_core/solver/(\w+)` \|", page)


def upward(order, files):
    """Includes that point down the table; `files`: (folder, name, text)."""
    found = []
    for folder, name, text in files:
        for to in re.findall(r'#include "solver/(\w+)/', text):
            if order.index(to) > order.index(folder):
                found.append(f"{folder}/{name} includes a header of {to}/")
        if "solver/runs.hpp" in text and folder != order[-1]:
            found.append(f"{folder}/{name} includes runs.hpp")
    return found


def main():
    order = folders((ROOT / "docs/reference/source-tree.md").read_text())
    present = sorted(p.name for p in SOLVER.iterdir() if p.is_dir())
    assert sorted(order) == present, f"folders on the page: {order}, in the tree: {present}"
    assert upward(order, [(order[0], "x.hpp", f'#include "solver/{order[1]}/y.hpp"')]), "an upward include is not found"
    files = [(p.parent.name, p.name, p.read_text()) for p in SOLVER.glob("*/*.[ch]pp")]
    found = upward(order, files)
    assert not found, "\n".join(found)


if __name__ == "__main__":
    sys.exit(main())
