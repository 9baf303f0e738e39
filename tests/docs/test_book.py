"""Sphinx builds the documentation without a warning, and the site needs no network. Skipped (77) where python3-sphinx or python3-myst-parser is absent."""
import importlib.util
import re
import shutil

from programs import MPM, ROOT, run
from pytest import fixture, skip

if not shutil.which("sphinx-build") or not importlib.util.find_spec("myst_parser"):
    skip("the book needs Debian's python3-sphinx and python3-myst-parser", allow_module_level=True)


class TestBook:
    @fixture(autouse=True, scope="class")
    def _site(self, request, tmp_path_factory):
        folder = tmp_path_factory.mktemp("book")
        request.cls.site = folder / "html"
        request.cls.done = run("sphinx-build", "-q", "-W", "--keep-going", "-b", "html", "-d", folder / "doctrees", "-D", f"granulaw_mpm={MPM}", ROOT / "docs", folder / "html",
                               code=...)

    def test_no_warning(self):
        assert self.done.returncode == 0, self.done.stderr[-3000:]

    def test_nothing_is_loaded_from_elsewhere(self):
        """Scripts, styles and pictures are files of the site (links to follow may lead elsewhere)."""
        pages = list(self.site.rglob("*.html"))
        assert len(pages) > 30
        for page in pages:
            text = page.read_text()
            for source in re.findall(r'(?:<script[^>]* src|<img[^>]* src|<link[^>]* rel="stylesheet"[^>]* href)="([^"]+)"', text):
                assert not re.match(r"(?:https?:)?//", source), f"{page}: {source}"
                file = (page.parent / re.split(r"[?#]", source)[0]).resolve()
                # without libjs-mathjax the equations stay TeX
                assert file.exists() or "mathjax" in source, f"{page}: {source} is not in the site"

    def test_search_and_options(self):
        assert "restitution" in (self.site / "searchindex.js").read_text()
        assert "--damage-number" in (self.site / "reference/commands.html").read_text()
