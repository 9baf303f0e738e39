"""One site of the documentation for all tests of this folder. Skipped (77) where python3-sphinx or python3-myst-parser is absent."""
import importlib.util
import shutil

from programs import MPM, ROOT, run
from pytest import fixture, skip


@fixture(scope="session")
def book(tmp_path_factory):
    """(what Sphinx said, its site)."""
    if not shutil.which("sphinx-build") or not importlib.util.find_spec("myst_parser"):
        skip("the book needs Debian's python3-sphinx and python3-myst-parser")
    folder = tmp_path_factory.mktemp("book")
    words = "-q -W --keep-going -b html".split()
    return run("sphinx-build", *words, "-d", folder / "doctrees", "-D", f"granulaw_mpm={MPM}", ROOT / "docs", folder / "html", code=...), folder / "html"


@fixture
def site(book):
    return book[1]
