"""The documentation: one HTML site that needs no network. Built by Sphinx with MyST from Debian's packages:

    apt-get install python3-sphinx python3-myst-parser libjs-mathjax
    cmake --build build/release --target book      # build/release/book/html/index.html

Without CMake: sphinx-build -b html docs FOLDER. `-D granulaw_mpm=PATH` adds the options of every command to the reference,
`-D granulaw_explorer=FOLDER` the interactive page.
"""
import re
import shutil
import subprocess
from pathlib import Path

from sphinx.search.en import SearchEnglish

HERE = Path(__file__).resolve().parent
MATHJAX = Path("/usr/share/javascript/mathjax")

project = "Granulaw"
author = "The Granulaw developers"
copyright = author
release = re.search(r"project\(granulaw VERSION ([\d.]+)", (HERE.parent / "CMakeLists.txt").read_text())[1]

extensions = ["myst_parser", "sphinx.ext.mathjax"]
source_suffix = {".md": "markdown"}
exclude_patterns = []
root_doc = "index"

myst_enable_extensions = ["dollarmath"]
myst_dmath_double_inline = True
# Anchors of headings as GitHub makes them.
myst_heading_anchors = 4

html_theme = "alabaster"
html_theme_options = {"description": "Contact laws by the material point method, for LIGGGHTS", "fixed_sidebar": True,
                      "page_width": "min(96vw, 1500px)", "sidebar_width": "260px", "show_powered_by": False,
                      "font_family": "sans-serif", "code_font_size": "0.85em"}
html_sidebars = {"**": ["about.html", "searchbox.html", "navigation.html"]}
html_title = f"Granulaw {release}"
html_copy_source = False
html_show_sphinx = False
html_static_path = ["_static"]
html_css_files = ["book.css"]
html_search_scorer = str(HERE / "search_scorer.js")
# Titles keep the apostrophe that a reader types into the search.
smartquotes = False
# A question is searched by the words that say what it is about.
SearchEnglish.stopwords |= {"how", "do", "does", "i", "my", "me", "can", "may", "what", "which", "when", "where", "why", "should", "have", "has", "use", "from",
                            "mean", "know", "s", "t", "you", "your"}
# Pygments has no LIGGGHTS; an indented block is shown as it is.
highlight_language = "none"

# MathJax is copied into the site (copy_mathjax), because the documentation is read without a network.
mathjax_path = "mathjax/MathJax.js?config=TeX-AMS_SVG-full"
# MyST marks each page to be left alone but for its elements of class "math".
myst_update_mathjax = False
mathjax2_config = {"tex2jax": {"inlineMath": [["\\(", "\\)"]], "displayMath": [["\\[", "\\]"]], "processRefs": False,
                               "processEnvironments": False, "ignoreClass": "mathjax_ignore", "processClass": "math"},
                   "SVG": {"font": "TeX", "linebreaks": {"automatic": True, "width": "52em"}},
                   "showMathMenu": False, "messageStyle": "none"}
# Part of MathJax's 54 MB that the pages load: TeX input and SVG output, which needs no font files: browsers
# refuse those of file:// pages.
MATHJAX_PARTS = ("MathJax.js", "config/TeX-AMS_SVG-full.js", "extensions", "jax/input/TeX", "jax/element", "jax/output/SVG/jax.js",
                 "jax/output/SVG/config.js", "jax/output/SVG/autoload", "jax/output/SVG/fonts/TeX", "localization/en")


def copy_mathjax(app, exception):
    """The site's own MathJax. Without Debian's libjs-mathjax the equations stay TeX, and the build says so."""
    if exception is not None or app.builder.name != "html":
        return
    if not MATHJAX.is_dir():
        from sphinx.util import logging
        logging.getLogger(__name__).info(f"{MATHJAX} is not there: equations will be shown as TeX; apt-get install libjs-mathjax")
        return
    target = Path(app.outdir) / "_static/mathjax"
    for part in MATHJAX_PARTS:
        source = MATHJAX / part
        if source.is_dir():
            shutil.copytree(source, target / part, dirs_exist_ok=True)
        elif source.is_file():
            (target / part).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source, target / part)


def link_examples(app, docname, source):
    """Pages link to ../../examples and examples to ../../docs, as the tree has them; the documentation has the examples within (the link docs/examples)."""
    to_root = "../" * docname.count("/")
    source[0] = re.sub(r"\]\((?:\.\./)+examples/", f"]({to_root}examples/", source[0])
    source[0] = re.sub(r"\]\((?:\.\./)+docs/", f"]({to_root}", source[0])


def help_of(mpm, *words):
    text = subprocess.run([mpm, *words, "--help"], capture_output=True, text=True, check=True).stdout.rstrip()
    return text.replace(str(Path.home()), "~")


def commands_of(mpm):
    """Names of all commands: the lines of `mpm --help` behind "Commands" that begin two spaces in."""
    return re.findall(r"^  (\w+)", help_of(mpm).split("Commands ", 1)[1], re.MULTILINE)


def add_options(app, docname, source):
    """The page of the commands ends with what each says to --help."""
    if docname != "reference/commands" or not app.config.granulaw_mpm:
        return
    parts = [f"## mpm {name}\n\n```text\n{help_of(app.config.granulaw_mpm, name)}\n```\n" for name in commands_of(app.config.granulaw_mpm)]
    source[0] += "\n" + "\n".join(parts)


def link_explorer(app, docname, source):
    """The guide to the interactive page begins with a link to it, where it was built."""
    if docname == "guide/explorer" and app.config.granulaw_explorer:
        source[0] = source[0].replace("\n\n", '\n\n<p><a href="../_static/explorer/index.html">Open the explorer</a></p>\n\n', 1)


def copy_explorer(app, exception):
    if exception is None and app.builder.name == "html" and app.config.granulaw_explorer:
        shutil.copytree(app.config.granulaw_explorer, Path(app.outdir) / "_static/explorer", dirs_exist_ok=True)


def setup(app):
    app.add_config_value("granulaw_explorer", "", "env")
    app.add_config_value("granulaw_mpm", "", "env")
    app.connect("source-read", add_options)
    app.connect("source-read", link_examples)
    app.connect("source-read", link_explorer)
    app.connect("build-finished", copy_mathjax)
    app.connect("build-finished", copy_explorer)
