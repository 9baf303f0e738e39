"""Which one-line faults a C++ source offers, and which of them a seed picks.

A rule finds places in the text of function bodies. Comments, strings, preprocessor lines, messages, checks that only
refuse bad input (`if (...) fail(...)`) and declarations offer none.
"""
import dataclasses
import hashlib
import random
import re
from pathlib import Path

FOLDERS = ("mpm_core/solver", "mpm_core/contact", "mpm_core/law", "mpm_core/characterise", "liggghts_plugin", "tools/deck", "tools/mpm")
BELOW = {"mpm_core/characterise": ("mpm_core/atlas", "mpm_core/calibrate"),
         "tools/mpm": ("mpm_core/material_file", "mpm_core/run_files")}  # libraries that belong to a folder's turn
KINDS = ("sign", "factor", "off by one", "branch", "swap")
NOT_BUILT = ("register_hertz.cpp",)  # a yardstick of the benchmarks

MESSAGES = re.compile(r"\b(?:fail|misread|fmt::print|fmt::format|printable|add_option|add_flag|add_subcommand|static_assert|assert|"
                      r"error->all|error->one|error->warning|warn|std::printf|std::fprintf)\s*\(")
TWINS = [("i", "j"), ("a", "b"), ("x", "y"), ("r", "z"), ("low", "high"), ("lower", "upper"), ("first", "second"),
         ("first", "last"), ("before", "after"), ("radius", "radius2"), ("load", "unload"), ("ur_i", "uz_i"), ("vr_i", "vz_i"),
         ("fr_i", "fz_i"), ("min", "max"), ("radius_min", "radius_max"), ("front", "back"), ("delta", "delta_max"),
         ("name_a", "name_b"), ("from", "to"), ("left", "right"), ("sin", "cos"), ("dr", "dz"), ("mass_i", "mass_j")]
TWIN_OF = {one: [b if a == one else a for a, b in TWINS if one in (a, b)] for pair in TWINS for one in pair}


@dataclasses.dataclass(frozen=True)
class Fault:
    folder: str
    kind: str
    path: str  # of the file, from the top folder
    line: int
    before: str  # the whole line
    after: str
    named: bool = False  # chosen by hand

    @property
    def id(self):
        text = "\n".join((self.path, self.before.strip(), self.after.strip()))
        return hashlib.sha256(text.encode()).hexdigest()[:12]


def closing(text, start):
    """Index of the bracket that closes the one at `start`; the last character if none does."""
    pairs = {"(": ")", "{": "}", "[": "]"}
    opened, closed, depth = text[start], pairs[text[start]], 0
    for k in range(start, len(text)):
        depth += (text[k] == opened) - (text[k] == closed)
        if depth == 0:
            return k
    return len(text) - 1


def blank(text, begin, end):
    return text[:begin] + re.sub(r"[^\n]", " ", text[begin:end]) + text[end:]


def code_only(text):
    """The source with everything blanked that is no code; same length, same lines."""
    token = re.compile(r'//[^\n]*|/\*.*?\*/|R"\((?:.*?)\)"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'|^[ \t]*#(?:[^\n]*\\\n)*[^\n]*',
                       re.S | re.M)
    text = token.sub(lambda m: re.sub(r"[^\n]", " ", m[0]), text)
    for m in list(MESSAGES.finditer(text)):
        if text[m.end() - 1] == "(":  # not inside another message
            text = blank(text, m.start(), closing(text, m.end() - 1) + 1)
    return text


def bodies(code):
    """For each character, whether it lies inside a function."""
    inside, stack = bytearray(len(code)), []
    for k, c in enumerate(code):
        if c == "{":
            head = code[max(0, k - 200):k].rstrip()
            body = bool(stack and stack[-1]) or bool(
                re.search(r"(\)|\bconst|\bnoexcept|\boverride|\belse|\bdo|\btry|->\s*[\w:<>&*, ]+)$", head))
            stack.append(body)
        elif c == "}" and stack:
            stack.pop()
        inside[k] = bool(stack and stack[-1])
    return inside


def arguments(line, start):
    """End of the operand that begins at `start`: the next , ; ? : or ) outside brackets. None: it goes on in the next line."""
    depth = 0
    for k in range(start, len(line)):
        c = line[k]
        depth += (c in "([{") - (c in ")]}")
        if depth < 0 or (depth == 0 and (c in ",;?" or line[k:k + 3] == " : ")):
            return k
    return None


def put(line, m, text, group=0):
    return line[:m.start(group)] + text + line[m.end(group):]


def signs(line, code, _near):
    if '"' in line:  # strings are joined by +
        return
    for m in re.finditer(r"(?<=[\w)\]]) ([+-]) (?=[\w(\-])(?!1\])", code):
        yield put(line, m, "-" if m[1] == "+" else "+", 1)
    for m in re.finditer(r" ([+-])= ", code):
        yield put(line, m, "-" if m[1] == "+" else "+", 1)
    for m in re.finditer(r"(?:[(\[{,?=:] ?|return )(-)(?=[A-Za-z_(])(?!>)", code):
        yield put(line, m, "", 1)


def factors(line, code, _near):
    in_index = [(m.start(), closing(code, m.start())) for m in re.finditer(r"(?<=[\w)\]])\[", code)]
    for m in re.finditer(r" ([*/]) (?=[\w(\-])", code):
        if not any(a < m.start() < b for a, b in in_index) and '"' not in line and "size_t" not in code:
            yield put(line, m, " * 1.01 " + ("* " if m[1] == "*" else "/ "))
    for m in re.finditer(r"(?<= [*/]=) (?=\w)|(?<= [+-]=) (?=[A-Za-z_(])", code):
        if '"' not in line:
            yield put(line, m, " 1.01 * ")
    declared = re.match(r"\s*(?:(?:const )?double )?[\w.>\[\]\"*-]+ =", line)
    for m in re.finditer(r"(?<=[\w)\] ]) = (?=[A-Za-z_][\w.:]+(?:\([\w, .]*\))?(?:->\w+)?;)(?!nullptr|true|false|new\b|std::move)", code):
        if declared:
            yield put(line, m, " = 1.01 * ")


def off_by_one(line, code, _near):
    if re.search(r"\bfor \(", code):
        for m in re.finditer(r"; [\w.]+ (<=?) ", code):
            yield put(line, m, "<=" if m[1] == "<" else "<", 1)
        for m in re.finditer(r"\bfor \([^;]* = (0|1);", code):
            yield put(line, m, "1" if m[1] == "0" else "0", 1)
    for m in re.finditer(r"(?<=[\w)\]])\[(\w+)( [+-] 1)?\]", code):
        if m[2]:
            yield put(line, m, "", 2)
        elif m[1] in "01":
            yield put(line, m, "1" if m[1] == "0" else "0", 1)
        elif not m[1].isdigit():
            yield put(line, m, m[1] + " + 1", 1)
    for m in re.finditer(r"(?<=[\w)\]])( [+-] 1)(?![\d.\w\]])", code):
        yield put(line, m, "", 1)


def branches(line, code, near):
    for m in re.finditer(r"\bif (?:constexpr )?\(", code):
        end = closing(code, m.end() - 1)
        if end >= len(code) - 1 and not code.rstrip().endswith(")"):
            continue
        rest = line[end + 1:].strip(" {")
        if re.match(r"(?:return )?(?:fail|misread|throw)\b", rest or near.strip()) or "constexpr" in m[0]:
            continue
        yield line[:m.end()] + "!(" + line[m.end():end] + ")" + line[end:]
        if ";" not in code[m.end():end]:
            yield line[:m.end()] + "false && (" + line[m.end():end] + ")" + line[end:]
    for m in re.finditer(r" \? ", code):
        middle = arguments(code, m.end())
        if middle is None or code[middle:middle + 3] != " : ":
            continue
        end = arguments(code, middle + 3)
        if end is not None:
            yield line[:m.end()] + line[middle + 3:end] + " : " + line[m.end():middle] + line[end:]
    for m in re.finditer(r" (&&|\|\|) ", code):
        yield put(line, m, "||" if m[1] == "&&" else "&&", 1)


def swaps(line, code, near):
    for m in re.finditer(r"\bstd::(min|max)\(", code):
        yield put(line, m, "max" if m[1] == "min" else "min", 1)
    if re.search(r"(?<![\w)\]])\[[^\]]", code):  # what a lambda captures
        return
    for m in re.finditer(r"\b\w+\b", code):
        declared = re.search(r"[\w>&*\]] $", code[:m.start()]) and not re.search(r"\b(?:return|else) $", code[:m.start()])
        if declared or code[max(0, m.start() - 5):m.start()] == "std::":
            continue
        for twin in TWIN_OF.get(m[0], ()):
            if re.search(rf"\b{twin}\b", near):
                yield put(line, m, twin)
    for m in re.finditer(r"(?<=[\w>])\((\w+), (\w+)\)", code):
        if m[1] != m[2]:
            yield put(line, m, f"({m[2]}, {m[1]})")


RULES = dict(zip(KINDS, (signs, factors, off_by_one, branches, swaps)))


def faults_of(text, folder, path):
    """Every fault that the rules find in one source."""
    code = code_only(text)
    inside = bodies(code)
    lines, plain = text.split("\n"), code.split("\n")
    start = 0
    for number, (line, bare) in enumerate(zip(lines, plain)):
        first = start + len(bare) - len(bare.lstrip())
        begin, start = start, start + len(bare) + 1
        whole = bare.strip()
        if not whole or not inside[min(first, len(inside) - 1)] or re.match(r"(using|typedef|template|case|public|private)\b", whole):
            continue
        # what the same function may hold: the lines about it; of a condition, the next line
        about = "\n".join(plain[max(0, number - 12):number + 6])
        following = lines[number + 1] if number + 1 < len(lines) else ""
        for kind, rule in RULES.items():
            for after in rule(line, bare, following if kind == "branch" else about):
                if after != line:
                    yield Fault(folder, kind, path, number + 1, line, after)


def sources(top, folder):
    return sorted(p for one in (folder, *BELOW.get(folder, ())) for p in (Path(top) / one).rglob("*") if p.suffix in (".cpp", ".hpp") and p.name not in NOT_BUILT)


def picked(top, seed, count, only=None):
    """`count` faults by turns from each folder and of each kind, no two in one line. A larger count begins with the same ones."""
    decks = {}
    for folder in FOLDERS:
        every = [f for p in sources(top, folder)
                 for f in faults_of(p.read_text(), folder, p.relative_to(top).as_posix())]
        for kind in KINDS:
            deck = [f for f in every if f.kind == kind]
            random.Random(f"{seed}/{folder}/{kind}").shuffle(deck)
            decks[folder, kind] = deck
    chosen, lines = [], set()
    turns = [(FOLDERS[(k + t) % len(FOLDERS)], KINDS[t]) for k in range(len(FOLDERS)) for t in range(len(KINDS))]
    while len(chosen) < count and any(decks.values()):
        for turn in turns:
            deck = decks[turn]
            while deck and (deck[-1].path, deck[-1].before.strip()) in lines:
                deck.pop()
            if deck and len(chosen) < count:
                fault = deck.pop()
                chosen.append(fault)
                lines.add((fault.path, fault.before.strip()))
    return [f for f in chosen if only is None or f.folder == only]


# By hand: (kind, file, a part of one line, what it becomes).
NAMED = [
    ("factor", "mpm_core/law/replay.cpp", "const double work = 0.5 * (", "const double work = 0.505 * ("),
    ("factor", "mpm_core/contact/unloading.hpp", "(11.0 - 2.0 * exponent) / 21.0", "1.01 * (11.0 - 2.0 * exponent) / 21.0"),
    ("sign", "mpm_core/solver/contact/node_plane.cpp", "* (least - v);", "* (least + v);"),
    ("factor", "mpm_core/contact/pair.hpp", "return {e_star_yielding, 1.0 + e_star_yielding", "return {e_star_yielding, 1.0 + 1.01 * e_star_yielding"),
    ("swap", "tools/deck/speeds.cpp", "f.top = is_new ? top : std::max(f.top, top);", "f.top = is_new ? top : std::min(f.top, top);"),
]


def named(top):
    for kind, path, old, new in NAMED:
        lines = (Path(top) / path).read_text().split("\n")
        where = [k for k, line in enumerate(lines) if old in line]
        if len(where) != 1:
            raise SystemExit(f"tools/faults: {path} holds '{old}' {len(where)} times, once is needed: mend NAMED in tools/faulting/rules.py")
        line = lines[where[0]]
        folder = next(f for f in FOLDERS if path.startswith(f + "/"))
        yield Fault(folder, kind, path, where[0] + 1, line, line.replace(old, new), named=True)
