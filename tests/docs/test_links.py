"""Every relative link and anchor of the pages exists: docs, the top folder, examples, tests/README.md. Pages begin with a heading and what they are for. No network."""
import re
import unittest
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
FOLDERS = ("guide", "theory", "reference", "evidence", "develop", "project")
PAGES = sorted({*TOP.glob("*.md"), *TOP.glob("docs/*.md"), *(page for folder in FOLDERS for page in TOP.glob(f"docs/{folder}/**/*.md")),
                *TOP.glob("examples/**/README.md"), TOP / "tests/README.md"})
LINK = re.compile(r"\]\(([^)\s]+)\)")
FENCE = re.compile(r"^(```+).*?^\1\s*$", re.MULTILINE | re.DOTALL)
# A page of the documentation that a comment, a message or another page names by its path.
NAMED = re.compile(r"docs/[\w/-]+\.(?:md|png|json)\b")
SOURCES = ("mpm_core", "liggghts_plugin", "tools", "tests", "examples", "cmake", "docs")

def prose(page):
    """The text without fenced blocks, indented blocks and code in backquotes, where brackets are no links."""
    text = FENCE.sub("", page.read_text())
    text = re.sub(r"(?m)^    .*$", "", text)
    return re.sub(r"`[^`\n]*`", "", text)

def anchors(page):
    """Anchors of the headings, as GitHub and MyST make them."""
    found = set()
    for heading in re.findall(r"(?m)^#{1,6} +(.*?)\s*$", FENCE.sub("", page.read_text())):
        slug = re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")
        base, k = slug, 0
        while slug in found:
            k += 1
            slug = f"{base}-{k}"
        found.add(slug)
    return found

class Links(unittest.TestCase):
    def test_files_and_anchors(self):
        wrong, seen = [], 0
        for page in PAGES:
            for link in LINK.findall(prose(page)):
                if re.match(r"[a-z]+:", link):
                    continue
                seen += 1
                name, _, anchor = link.partition("#")
                target = (page.parent / name).resolve() if name else page
                if not target.exists():
                    wrong.append(f"{page.relative_to(TOP)}: {link}: no such file")
                elif anchor and anchor not in anchors(target):
                    wrong.append(f"{page.relative_to(TOP)}: {link}: no heading with this anchor")
        self.assertEqual(wrong, [])
        self.assertGreater(seen, 150)  # the pages were found

    def test_named_pages(self):
        """Comments and messages name pages by path: docs/reference/law-format.md."""
        wrong = []
        files = [TOP / "README.md", TOP / "CMakeLists.txt", *(f for folder in SOURCES for f in (TOP / folder).rglob("*") if f.is_file())]
        for path in files:
            if path.suffix in (".png", ".h5", ".json", ".csv", ".pyc", ".stl") or path.stat().st_size > 1_000_000:
                continue
            try:
                text = path.read_text()
            except UnicodeDecodeError:
                continue
            wrong += [f"{path.relative_to(TOP)}: {name}" for name in NAMED.findall(text) if not (TOP / name).exists()]
        self.assertEqual(wrong, [])

    def test_source_tree(self):
        """The tables of docs/reference/source-tree.md name every folder of sources, tools and tests, and no other."""
        page = "".join((TOP / f"docs/reference/{name}").read_text() for name in ("source-tree.md", "folders.csv", "test-folders.csv"))
        there = {str(f.relative_to(TOP)) for pattern in ("mpm_core/*/", "mpm_core/solver/*/", "tools/*/", "tests/*/") for f in TOP.glob(pattern)
                 if f.is_dir() and f.name != "__pycache__"}
        named = set(re.findall(r"`((?:mpm_core|tools|tests)(?:/\w+)+)`", page))
        self.assertEqual(there - named, set())
        self.assertEqual({n for n in named if not (TOP / n).exists()}, set())

    def test_every_page_says_what_it_is_for(self):
        for page in PAGES:
            lines = [line for line in page.read_text().splitlines() if line.strip()]
            self.assertTrue(lines[0].startswith("# "), page)
            self.assertFalse(lines[1].startswith(("|", "#", "```", "    ", "- ")), f"{page}: begins without a sentence")

if __name__ == "__main__":
    unittest.main()
