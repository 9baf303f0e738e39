"""One voice: short sentences, a noun first, one term for one thing, in pages, comments and texts that the programs print.

    test_voice.py                    checks: no fault is allowed
    test_voice.py list [RULE [PATH]] prints what is found, one place a line
    test_voice.py count              prints words, sentences and the count of each rule
"""
import re
import sys
import unittest
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
WORDS = 25  # the longest sentence of a page
# Cells of this page quote messages of the models and of LIGGGHTS, with their lists of allowed words.
QUOTES, QUOTED_WORDS = "docs/evidence/liggghts-matrix.md", 30
# The glossary defines terms and may name the words that it replaces; these files hold the words as the rules' examples.
GLOSSARY = "docs/reference/glossary.md"
UNCHECKED = {"tests/docs/test_voice.py"}
# Keys of files and options, which messages name as they are.
NAMES = re.compile(r"--var scene|out/scene|, told;|\bfoot\b(?= of each| \(|,)")
OPENING = r"(?:What|Of|Whether)\b"
OPENING_COMMENT = r"(?:What|Of|Whether|Where|How)\b"
THINGS = r"(?:laws?|files?|tables?|data|contacts?|models?|solvers?|programs?|bod(?:y|ies)|spheres?|particles?|runs?|atlas|codes?|numbers?|they|it|that|which)"
# House word: term of the table in the glossary.
HOUSE = {
    r"tells?|told|tellable": "determine, identify, distinguish, print",
    THINGS + r" (?:knows?|sees?|feels?|forgets?|asks?|answers?)": "contain, cover, depend on, require, reset, return",
    r"knows no\w*|feels?|felt|forgets?|forgot(?:ten)?": "contain, cover, depend on, require, reset",
    r"pairs? by runs": "two-body law",
    r"stated errors?|honest(?:ly|y)?": "error bound (law), error estimate (run)",
    r"flatness|flattenings?": "pressure uniformity, overlap per sphere",
    r"(?:the|an?|its|this|each|every|of|their|same|whose|by|in|no|largest|smallest|size|Hertz) shares?": "fraction, size ratio, part",
    r"foot": "Hertz coefficient A",
    r"twins?|stand-ins?": "equivalent sphere",
    r"slices? of (?:the|an?) (?:law|axis)": "row of the velocity axis",
    r"(?:inertia|speed) ax[ei]s": "velocity axis",
    r"main planes?": "reference set (nu = 0.3)",
    r"rate-free|at no rate": "rate-independent",
    r"thick walls?|half balls?": "deformable wall",
    r"the book|this book": "the documentation",
    r"the issue(?:'s)?": "required; the reason of a bound stands beside it",
}
# In pages and messages only: in code these are names, or plain words.
HOUSE_TEXT = {
    r"scenes?|laborator(?:y|ies)": "deck, simulation, test case, synthetic data set",
    r"claims?|claimed": "error bound (law), error estimate (run)",
    r"thrown (?:at|against|on|onto|into|together|by)|throws? (?:the|a) bod(?:y|ies)": "impact, collision",
}
# Terms with one meaning: pages of the rule, uses outside the meaning, the word for them. Glossary and quoted tables of names are not checked.
USERS = r"README|docs/index|docs/guide/(?:first-flow|plan|limits|when-it-stops|pairs|report|install|clusters|particle-laws|yield-stress|calibrate)|examples/"
SIMULATIONS = r"docs/guide/(?:first-flow|plan|report)|docs/reference/(?:pair_gran|fix_granulaw)|docs/evidence/flows|examples/"
TERMS = (
    # own: what belongs to the reader, or the project ("of our own")
    (r".", r"(?<!your )(?<!our )own(?! words and fixes)", "single-body law, corrected law, default; or delete it"),
    # body: of the solver; users have particles
    (USERS, r"(?<!rigid )(?<!two-)(?<!single-)bod(?:y|ies)(?! of revolution)", "particle"),
    # length: a distance in metres
    (r".", r"lengths? of (?:the |an? )?(?:time )?steps?|(?:lists?|arrays?|spans?|files?|tables?) of (?:equal |the same |one )?lengths?|lengths? of (?:the |an? )?(?:list|array|span|file|table)s?",
     "time step, size"),
    # level: none; the axis of a law has rows
    (r".", r"levels?", "row of the velocity axis"),
    # run: of the solver; LIGGGHTS has simulations, and its command `run`
    (SIMULATIONS, r"(?:the|an?|every|each|any|this|whole|one|after|before) runs?(?! of (?:the solver|both bodies|that shape))", "simulation"),
    # shape: geometry in three dimensions
    (r".", r"(?:law|unloading|loading|curve|pressure|force) shapes?|shapes? of (?:the |an? |its |this |each )?(?:law|curve|unloading|loading|pressure|force)s?",
     "normalised law, unloading curve, pressure profile"),
)


def any_of(patterns):
    return re.compile(r"(?<![\w`-])(?:" + "|".join(patterns) + r")(?![\w-])", re.IGNORECASE)


HOUSE_ANY, HOUSE_CODE = any_of([*HOUSE, *HOUSE_TEXT]), any_of(HOUSE)
ONE_MEANING = [(re.compile(where), any_of([uses]), term) for where, uses, term in TERMS]

FENCE = re.compile(r"^([ ]*)(```+|~~~+).*?^\1\2\s*$", re.MULTILINE | re.DOTALL)


def pages():
    found = {*TOP.glob("docs/**/*.md"), *TOP.glob("examples/**/*.md"), TOP / "tests/README.md"}
    return sorted(found | {f for f in TOP.glob("*.md")})


def sources():
    kinds = ("*.cpp", "*.hpp", "*.h", "*.c", "*.py", "*.cmake", "CMakeLists.txt", "*.sh")
    folders = ("mpm_core", "liggghts_plugin", "tools", "tests", "examples", "cmake", "docs")
    files = {f for folder in folders for kind in kinds for f in (TOP / folder).rglob(kind)}
    return sorted(f for f in files | {TOP / "CMakeLists.txt"} if str(f.relative_to(TOP)) not in UNCHECKED)


def plain(text):
    """The text of a page with one word in the place of code, formulas and links."""
    text = re.sub(r"<!--.*?-->", "", text, flags=re.DOTALL)
    text = re.sub(r"\$\$.*?\$\$", " ", text, flags=re.DOTALL)
    text = re.sub(r"``[^`]+``|`[^`\n]+`|\$[^$\n]+\$", "CODE", text)
    text = re.sub(r"!?\[([^\]]*)\]\([^)\s]*\)", r"\1", text)
    return re.sub(r"[*_]{1,2}(?=\S)|(?<=\S)[*_]{1,2}", "", text)


def paragraphs(text):
    """Paragraphs, list items and cells of tables: (line, kind, text); no headings, no blocks of code."""
    blank = lambda m: "\n" * m.group(0).count("\n")
    lines = re.sub(r"\$\$.*?\$\$", blank, FENCE.sub(blank, text), flags=re.DOTALL).splitlines()
    found, open_, listed = [], None, False
    for number, line in enumerate(lines, 1):
        item = re.match(r"\s*(?:[-*+]|\d+\.)\s+(.*)", line)
        if not line.strip():
            open_ = None
        elif re.match(r"#{1,6} |\s*\|?[-:| ]+\|?\s*$|<", line):
            open_, listed = None, False
        elif line.lstrip().startswith("|"):
            found += [(number, "cell", plain(cell).strip()) for cell in re.split(r"(?<!\\)\|", plain(line))[1:-1]]
            open_ = None
        elif item:
            open_, listed = [number, "item", item[1]], True
            found.append(open_)
        elif open_:
            open_[2] += " " + line.strip()
        elif not line.startswith("    ") or listed:
            listed = line.startswith("  ") and listed
            open_ = [number, "paragraph", line.strip()]
            found.append(open_)
    return [(number, kind, plain(words)) for number, kind, words in found]


def sentences(text):
    """Sentences of a paragraph. An enumeration, five semicolons or five pieces of code in a row, is a list: its items count one by one, as one word."""
    text = re.sub(r"CODE(?:,? (?:and |or )?CODE){4,}", "CODE", text)
    if text.count("; ") > 4:
        text = text.replace("; ", ". X ")
    text = re.sub(r"\b(e\.g|i\.e|cf|vs|approx|no|Fig|Eq|Sec|al|Dr)\.", r"\1", text)
    return [s for s in re.split(r"(?<=[.!?])[\"')]*\s+(?=[\"'(]*(?:[A-Z0-9]|(?:[a-z]|mu|rho|mpm)\b))", text) if s.strip()]


def words(text):
    return len(re.findall(r"[^\s\d|/=+<>*.,;:()-][^\s|]*|\d[^\s|]*", text))


def question(text):
    return sentences(text)[0].rstrip().endswith("?")


def of_page(name, text):
    """(rule, line, excerpt) of each fault of a page."""
    for line, kind, content in paragraphs(text):
        longest = QUOTED_WORDS if kind == "cell" and name == QUOTES else WORDS
        for sentence in sentences(content):
            if words(sentence) > longest:
                yield "long sentence", line, f"{words(sentence)} words: {sentence}"
        if re.search(r"\b[Tt]his page\b", content):
            yield "this page", line, content[:120]
        if kind != "cell" and re.match(OPENING, content) and not question(content):
            yield "headless paragraph", line, content[:120]
        if name != GLOSSARY:
            for match in HOUSE_ANY.finditer(content):
                yield "house word in a page", line, f"{match.group(0)}: {content[max(0, match.start() - 50):match.end() + 30]}"
            for where, uses, term in ONE_MEANING:
                for match in uses.finditer(content) if where.match(name) else ():
                    yield "term outside its meaning", line, f"{match.group(0)} ({term}): {content[max(0, match.start() - 50):match.end() + 30]}"


def comments(name, text):
    """(line, text) of each block of comment lines, comment after code and docstring."""
    if name.endswith((".py", ".cmake", ".txt", ".sh")):
        mark, found = "#", [(text.count("\n", 0, m.start()) + 1, m[2]) for m in re.finditer(r'(?m)^[ ]*(?:[rf])?("""|\'\'\')(.*?)\1', text, re.DOTALL)] if name.endswith(".py") else []
    else:
        mark, found = "//", [(text.count("\n", 0, m.start()) + 1, re.sub(r"(?m)^\s*\* ?", "", m[1])) for m in re.finditer(r"/\*+!?<?(.*?)\*/", text, re.DOTALL)]
    open_ = None
    for number, line in enumerate(text.splitlines(), 1):
        whole = re.match(rf"\s*{mark}+[!/#]?<?\s?(.*)", line)
        # After code: not in a string, so an even number of quotes stands before it.
        after = None if whole else next((m for m in re.finditer(rf"\s{mark}+[!/]?<?\s(.*)", line) if line[:m.start()].count('"') % 2 == 0 and line[:m.start()].count("'") % 2 == 0), None)
        if whole and open_ is not None:
            found[open_] = (found[open_][0], found[open_][1] + " " + whole[1])
        elif whole:
            open_ = len(found)
            found.append((number, whole[1]))
        else:
            open_ = None
            if after:
                found.append((number, after[1]))
    return found


def messages(text):
    """(line, text) of string literals with at least three words: help and messages."""
    for number, line in enumerate(text.splitlines(), 1):
        if re.match(r"\s*//", line):
            continue
        for match in re.finditer(r'"((?:[^"\\]|\\.)*)"', line):
            if len(match[1].split()) >= 3:
                yield number, match[1]


def help_texts(text):
    """(line, text) of string literals that follow each other, joined: texts of options and messages whole. A blank line or an indented one ends a text."""
    literal = r'"(?:[^"\\\n]|\\.)*"'
    for match in re.finditer(rf"{literal}(?:\s*{literal})*", re.sub(r"(?m)^\s*//.*$", "", text)):
        whole = "".join(re.findall(r'"((?:[^"\\\n]|\\.)*)"', match[0]))
        for part in re.split(r"\\n\\n|\\n(?= {2,}|# )", whole):
            yield text.count("\n", 0, match.start()) + 1, part.replace("\\n", " ").replace('\\"', '"')


def of_source(name, text):
    """(rule, line, excerpt) of each fault in the comments and messages of a source."""
    for line, comment in comments(name, text):
        if re.match(r"\W*" + OPENING_COMMENT, comment) and not question(comment):
            yield "headless comment", line, comment.strip()[:120]
        for match in HOUSE_CODE.finditer(comment):
            yield "house word in a comment", line, f"{match.group(0)}: {comment[max(0, match.start() - 50):match.end() + 30]}"
    if name.startswith("tools/mpm/") and name.endswith(".cpp"):
        for line, part in help_texts(text):
            for sentence in sentences(plain(part)):
                if words(sentence) > WORDS:
                    yield "long sentence in help", line, f"{words(sentence)} words: {sentence}"
    if name.endswith((".cpp", ".hpp")) and not name.startswith("tests/"):
        for line, message in messages(text):
            if re.match(OPENING, message):
                yield "headless message", line, message[:120]
            for match in HOUSE_ANY.finditer(NAMES.sub("", message)):
                yield "house word in a message", line, f"{match.group(0)}: {message[:120]}"


RULES = ("long sentence", "long sentence in help", "this page", "term outside its meaning", "headless paragraph", "headless comment", "headless message",
         "house word in a page", "house word in a comment", "house word in a message")


def faults():
    """[(rule, file, line, excerpt), ...] of the tree."""
    found = []
    for check, files in ((of_page, pages()), (of_source, sources())):
        for path in files:
            name = str(path.relative_to(TOP))
            found += [(rule, name, line, excerpt) for rule, line, excerpt in check(name, path.read_text())]
    return found


class BadTexts(unittest.TestCase):
    """Each rule finds its fault, and nothing in a good text."""

    def rules(self, check, name, text):
        return sorted({rule for rule, *_ in check(name, text)})

    def test_page(self):
        for text, rule in (("# A\n\n" + "Word " * 25 + "end.\n", "long sentence"),
                           ("# A\n\n| a |\n|---|\n| " + "word " * 26 + "|\n", "long sentence"),
                           ("# A\n\n- " + "word\n  " * 26 + "\n", "long sentence"),
                           ("# A\n\nThis page shows a law.\n", "this page"),
                           ("# A\n\nWhat a law is.\n", "headless paragraph"),
                           ("# A\n\n- Whether it holds.\n", "headless paragraph"),
                           ("# A\n\nThe law knows its speed.\n", "house word in a page"),
                           ("# A\n\nData that tell the\nmodulus.\n", "house word in a page"),
                           ("# A\n\n| a |\n|---|\n| the foot |\n", "house word in a page"),
                           ("# A\n\nThe law has its own end.\n", "term outside its meaning"),
                           ("# A\n\nArrays of equal length.\n", "term outside its meaning"),
                           ("# A\n\nEach level of the axis.\n", "term outside its meaning"),
                           ("# A\n\nThe shape of the unloading.\n", "term outside its meaning")):
            self.assertEqual(self.rules(of_page, "a.md", text), [rule], text)

    def test_terms_of_some_pages(self):
        """Users have particles and simulations; a page of theory has bodies and runs."""
        for name, text in (("docs/guide/plan.md", "# A\n\nOne body yields.\n"), ("examples/drop/README.md", "# A\n\nAfter a run of the deck.\n")):
            self.assertEqual(self.rules(of_page, name, text), ["term outside its meaning"], text)
            self.assertEqual(self.rules(of_page, "docs/theory/law.md", text), [])
        self.assertEqual(self.rules(of_page, "docs/guide/plan.md", "# A\n\nA body of revolution, a rigid body, new runs, and runs of the solver. The `run` begins.\n"), [])

    def test_source(self):
        for name, text, rule in (("a.hpp", "int a;\n// What a is.\nint b;\n", "headless comment"),
                                 ("a.hpp", "int a; // Of the mean.\n", "headless comment"),
                                 ("a.cpp", "/** Whether it\n * holds. */\n", "headless comment"),
                                 ("a.py", 'def a():\n    """What a is."""\n', "headless comment"),
                                 ("a.cmake", "# Where it lies.\n", "headless comment"),
                                 ("a.hpp", "// The twin of\n// a law.\n", "house word in a comment"),
                                 ("a.cpp", 'f("What it is for");\n', "headless message"),
                                 ("a.cpp", 'f("the law of the twin");\n', "house word in a message"),
                                 ("tools/mpm/a.cpp", 'f("' + "word " * 15 + '"\n  "' + "word " * 11 + '");\n', "long sentence in help")):
            self.assertEqual(self.rules(of_source, name, text), [rule], text)

    def test_good(self):
        page = ("# What it is\n\n" + "Word " * 24 + "end. " + "Word " * 24 + "end.\n\nWhat is a law?\n\nSee `the twin that tells the share`.\n\n"
                "```\nWhat a twin tells.\n```\n\nThe unknown fraction is identified. You know LIGGGHTS. Your own deck; lengths in m; a shape in three dimensions.\n")
        self.assertEqual(self.rules(of_page, "a.md", page), [])
        self.assertEqual(self.rules(of_page, GLOSSARY, "# A\n\nTwin: equivalent sphere.\n"), [])
        self.assertEqual(self.rules(of_source, "a.cpp", '// Force in newton.\n// Of the contact.\nf("https://a.b // What"); g("told");\n'), [])


class Tree(unittest.TestCase):
    def test_no_fault(self):
        found = faults()
        self.assertFalse(found, "\n" + "\n".join(f"{name}:{line}: {rule}: {excerpt}" for rule, name, line, excerpt in found[:400]))
        self.assertGreater(len(pages()), 60)
        self.assertGreater(len(sources()), 500)


if __name__ == "__main__":
    if sys.argv[1:2] == ["list"]:
        for rule, name, line, excerpt in faults():
            if (len(sys.argv) < 3 or sys.argv[2] == rule) and (len(sys.argv) < 4 or name.startswith(sys.argv[3])):
                print(f"{name}:{line}: {rule}: {excerpt}")
    elif sys.argv[1:2] == ["count"]:
        texts = [content for page in pages() for _, _, content in paragraphs(page.read_text())]
        lengths = [words(s) for t in texts for s in sentences(t)]
        print(f"{len(pages())} pages, {sum(map(words, texts))} words of prose and tables, {len(lengths)} sentences and cells")
        found = faults()
        for rule in RULES:
            print(f"{rule}: {sum(f[0] == rule for f in found)}")
    else:
        unittest.main()
