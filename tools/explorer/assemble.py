"""assemble.py SOURCES MODULE.wasm ATLAS.numbers OUTPUT VERSION: writes OUTPUT/index.html and OUTPUT/explorer.js.

The module and the atlas become text in the script, since browsers refuse to load other files from a file:// page.
"""
import base64
import sys
import zlib
from pathlib import Path

sources, module, atlas, output = map(Path, sys.argv[1:5])
version = sys.argv[5]


def as_text(data):
    return base64.b64encode(zlib.compress(data, 9)).decode()


def shuffled(data, size=8):
    """First bytes of all doubles, then their second bytes, and so on: neighbours resemble each other."""
    return b"".join(data[k::size] for k in range(size))


def read(name):
    return (sources / name).read_text()


output.mkdir(parents=True, exist_ok=True)
script = "\n".join(['"use strict";', f'const MODULE_TEXT = "{as_text(module.read_bytes())}";',
                    f'const ATLAS_TEXT = "{as_text(shuffled(atlas.read_bytes()))}";',
                    f'const VERSION = "{version}";', *(read(name) for name in ("loader.js", "materials.js", "picture.js", "page.js"))])
(output / "explorer.js").write_text(script)
(output / "index.html").write_text(read("page.html").replace("/* page.css */", read("page.css")))
