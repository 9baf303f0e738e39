"""Sentences of at most 25 words in pages and in the texts of `mpm`, and one term for one thing: pages use none of the house words that CONTRIBUTING.md replaces.

    test_voice.py                    checks: no fault is allowed
    test_voice.py list [RULE [PATH]] prints what is found, one place a line
"""
import re
import sys
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
WORDS = 25
QUOTES, QUOTED_WORDS = "docs/evidence/liggghts-matrix.md", 30  # its cells quote messages with their lists of allowed words
GLOSSARY, REPLACED = "docs/reference/glossary.md", "CONTRIBUTING.md"  # pages that may have the old words: other names in files; the list of them
# Of the first column of Words in CONTRIBUTING.md: terms that mean nothing else in this field. Its ordinary words (share, slow, flat) are not looked for.
TERMS = ("stated error", "flatness", "flattening", "foot", "Hertz share", "twin", "stand-in", "main plane", "inertia axis", "speed axis", "at no rate", "rate-free", "thick wall", "half ball", "the book(?!s)")
HOUSE = re.compile(rf"(?<![\w`-])(?:{'|'.join(TERMS)})s?(?![\w-])", re.IGNORECASE)
FENCE = re.compile(r"^([ ]*)(```+|~~~+).*?^\1\2\s*$|\$\$.*?\$\$|<!--.*?-->", re.MULTILINE | re.DOTALL)


def plain(text):
    """The text with one word in the place of code, formulas and links."""
    text = re.sub(r"``[^`]+``|`[^`\n]+`|\$[^$\n]+\$", "CODE", text)
    return re.sub(r"[*_]{1,2}(?=\S)|(?<=\S)[*_]{1,2}", "", re.sub(r"!?\[([^\]]*)\]\([^)\s]*\)", r"\1", text))


def paragraphs(text):
    """(line, text) of paragraphs, list items and cells of tables; no headings, no blocks of code."""
    found, open_ = [], None
    for number, line in enumerate(FENCE.sub(lambda m: "\n" * m[0].count("\n"), text).splitlines(), 1):
        if not line.strip() or re.match(r"#{1,6} |\s*\|?[-:| ]+\|?\s*$|<", line) or line.startswith("    ") and not open_:
            open_ = None
        elif line.lstrip().startswith("|"):
            found += [[number, cell] for cell in re.split(r"(?<!\\)\|", plain(line))[1:-1]]
            open_ = None
        elif open_ and not re.match(r"\s*(?:[-*+]|\d+\.)\s", line):
            open_[1] += " " + line.strip()
        else:
            open_ = [number, re.sub(r"^\s*(?:[-*+]|\d+\.)\s+", "", line)]
            found.append(open_)
    return [(number, plain(words)) for number, words in found]


def sentences(text):
    """An enumeration, five semicolons or five pieces of code in a row, is a list: its items count one by one, as one word."""
    text = re.sub(r"CODE(?:,? (?:and |or )?CODE){4,}", "CODE", text)
    text = re.sub(r"\b(e\.g|i\.e|cf|vs|approx|no|Fig|Eq|Sec|al|Dr)\.", r"\1", text.replace("; ", ". X ") if text.count("; ") > 4 else text)
    return re.split(r"(?<=[.!?])[\"')]*\s+(?=[\"'(]*(?:[A-Z0-9]|(?:[a-z]|mu|rho|mpm)\b))", text)


def words(text):
    return len(re.findall(r"[^\s\d|/=+<>*.,;:()-][^\s|]*|\d[^\s|]*", text))


def help_texts(text):
    """(line, text) of string literals that follow each other, joined. A blank line or an indented one ends a text."""
    literal = r'"(?:[^"\\\n]|\\.)*"'
    for match in re.finditer(rf"{literal}(?:\s*{literal})*", re.sub(r"(?m)^\s*//.*$", "", text)):
        whole = "".join(re.findall(r'"((?:[^"\\\n]|\\.)*)"', match[0]))
        for part in re.split(r"\\n\\n|\\n(?= {2,}|# )", whole):
            yield text.count("\n", 0, match.start()) + 1, plain(part.replace("\\n", " "))


def of_file(name, text):
    """(rule, line, excerpt) of each fault."""
    for line, part in (paragraphs if name.endswith(".md") else help_texts)(text):
        for sentence in sentences(part):
            if words(sentence) > (QUOTED_WORDS if name == QUOTES else WORDS):
                yield "long sentence", line, f"{words(sentence)} words: {sentence}"
        for match in HOUSE.finditer(part) if name.endswith(".md") and name not in (GLOSSARY, REPLACED) else ():
            yield "house word", line, f"{match[0]}: {part[:120]}"


def main():
    given = sys.argv[2:] if sys.argv[1:2] == ["list"] else []
    files = sorted({*TOP.glob("*.md"), *TOP.glob("docs/**/*.md"), *TOP.glob("examples/**/*.md"), TOP / "tests/README.md", *TOP.glob("tools/mpm/*.cpp")})
    replaced = (TOP / REPLACED).read_text().partition("## Words")[2]
    assert len(files) > 90 and all(re.search(term, replaced, re.IGNORECASE) for term in TERMS), (len(files), TERMS)
    for text, rule in (("Word " * 25 + "end.", "long sentence"), ("- " + "word\n  " * 26, "long sentence"), ("| a |\n|---|\n| " + "word " * 26 + "|", "long sentence"), ("| the foot |", "house word")):
        assert [found[0] for found in of_file("a.md", f"# A\n\n{text}\n")] == [rule], text
    assert [found[0] for found in of_file("a.cpp", 'f("' + "word " * 15 + '"\n  "' + "word " * 11 + '");\n')] == ["long sentence"]
    assert not list(of_file("a.md", "# A\n\n" + ("Word " * 24 + "end. ") * 2 + "See `the twin`.\n\n```\n" + "word " * 30 + "\n```\n"))
    found = [(rule, f"{path.relative_to(TOP)}:{line}", text) for path in files for rule, line, text in of_file(str(path.relative_to(TOP)), path.read_text())]
    for rule, place, text in found:
        if rule in (given[:1] or [rule]) and place.startswith("".join(given[1:2])):
            print(f"{place}: {rule}: {text}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
