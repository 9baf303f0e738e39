"""Each folder of the solver, of characterise and of the plug-in includes only headers of those above it in docs/reference/folders.csv."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
TREES = {"mpm_core/solver": "solver", "mpm_core/characterise": "characterise", "liggghts_plugin": "liggghts_plugin"}  # folder: its name in an #include

def folders(page, tree):
    return re.findall(rf"(?m)^`{tree}/(\w+)`,", page)

def upward(order, name, files):
    """Includes that point down the table; `files`: (folder, file, text)."""
    return [f"{folder}/{file} includes a header of {to}/" for folder, file, text in files
            for to in re.findall(rf'#include "{name}/(\w+)/', text) if order.index(to) > order.index(folder)]

def main():
    page = (ROOT / "docs/reference/folders.csv").read_text()
    found = []
    for tree, name in TREES.items():
        order = folders(page, tree)
        present = sorted({p.parent.name for p in (ROOT / tree).glob("*/*.[ch]pp")})
        assert sorted(order) == present, f"folders on the page: {order}, in the tree: {present}"
        assert upward(order, name, [(order[0], "x.hpp", f'#include "{name}/{order[1]}/y.hpp"')]), "an upward include is not found"
        files = [(p.parent.name, p.name, p.read_text()) for p in (ROOT / tree).glob("*/*.[ch]pp")]
        found += upward(order, name, files)
        if name == "solver":
            found += [f"{folder}/{file} includes runs.hpp" for folder, file, text in files if "solver/runs.hpp" in text and folder != order[-1]]
    assert not found, "\n".join(found)

if __name__ == "__main__":
    sys.exit(main())
