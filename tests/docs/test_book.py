"""Sphinx builds the documentation without a warning, and the site needs no network. Skipped (77) where python3-sphinx or python3-myst-parser is absent."""
import importlib.util
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

DOCS = Path(__file__).resolve().parents[2] / "docs"

if not shutil.which("sphinx-build") or not importlib.util.find_spec("myst_parser"):
    print("skipped: the book needs Debian's python3-sphinx and python3-myst-parser")
    sys.exit(77)


class Book(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = cls.enterClassContext(tempfile.TemporaryDirectory())
        cls.site = Path(folder) / "html"
        command = ["sphinx-build", "-q", "-W", "--keep-going", "-b", "html", "-d", folder + "/doctrees"]
        if os.environ.get("GRANULAW_MPM"):
            command += ["-D", "granulaw_mpm=" + os.environ["GRANULAW_MPM"]]
        cls.run_ = subprocess.run([*command, str(DOCS), str(cls.site)], capture_output=True, text=True)

    def test_no_warning(self):
        self.assertEqual(self.run_.returncode, 0, self.run_.stderr[-3000:])

    def test_nothing_is_loaded_from_elsewhere(self):
        """Scripts, styles and pictures are files of the site (links to follow may lead elsewhere)."""
        pages = list(self.site.rglob("*.html"))
        self.assertGreater(len(pages), 30)
        for page in pages:
            text = page.read_text()
            for source in re.findall(r'(?:<script[^>]* src|<img[^>]* src|<link[^>]* rel="stylesheet"[^>]* href)="([^"]+)"', text):
                self.assertFalse(re.match(r"(?:https?:)?//", source), f"{page}: {source}")
                file = (page.parent / re.split(r"[?#]", source)[0]).resolve()
                # without libjs-mathjax the equations stay TeX
                self.assertTrue(file.exists() or "mathjax" in source, f"{page}: {source} is not in the site")

    def test_search_and_options(self):
        self.assertIn("restitution", (self.site / "searchindex.js").read_text())
        if os.environ.get("GRANULAW_MPM"):
            self.assertIn("--damage-number", (self.site / "reference/commands.html").read_text())


if __name__ == "__main__":
    unittest.main()
