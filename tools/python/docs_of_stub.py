"""docs_of_stub.py STUB: C++ with the docstrings of a stub file by name ("Pair.force"), so that help() and editors say the same."""
import ast
import json
import sys


def docstrings(body, prefix=""):
    for node in body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            text = ast.get_docstring(node)
            if text and not node.name.startswith("_"):
                yield prefix + node.name, text
            if isinstance(node, ast.ClassDef):
                yield from docstrings(node.body, node.name + ".")


stub = ast.parse(open(sys.argv[1], encoding="utf-8").read())
print("#include \"doc.hpp\"\n#include <stdexcept>\nconst char* doc(std::string_view name)\n{")
for name, text in docstrings(stub.body):
    print(f"  if (name == {json.dumps(name)}) return {json.dumps(text)};")
print("  throw std::logic_error(std::string(name) + \" is not in __init__.pyi\");\n}")
