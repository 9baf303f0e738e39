"""Sphinx builds the documentation without a warning, and the site needs no network."""
import re


def test_no_warning(book):
    assert book[0].returncode == 0, book[0].stderr[-3000:]


def test_nothing_is_loaded_from_elsewhere(site):
    """Scripts, styles and pictures are files of the site (links to follow may lead elsewhere)."""
    pages = list(site.rglob("*.html"))
    assert len(pages) > 30
    for page in pages:
        text = page.read_text()
        for source in re.findall(r'(?:<script[^>]* src|<img[^>]* src|<link[^>]* rel="stylesheet"[^>]* href)="([^"]+)"', text):
            assert not re.match(r"(?:https?:)?//", source), f"{page}: {source}"
            file = (page.parent / re.split(r"[?#]", source)[0]).resolve()
            # without libjs-mathjax the equations stay TeX
            assert file.exists() or "mathjax" in source, f"{page}: {source} is not in the site"


def test_search_and_options(site):
    assert "restitution" in (site / "searchindex.js").read_text()
    assert "--damage-number" in (site / "reference/commands.html").read_text()
