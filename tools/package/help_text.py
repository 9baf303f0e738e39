"""Texts of `mpm --help` and `mpm COMMAND --help`, as data: the source of the manual pages and of the shell completion."""
import dataclasses
import os
import re
import subprocess

TEXT_COLUMN = 30  # of CLI11's help: names before it, what they mean from it on


@dataclasses.dataclass
class Entry:
    """An option, a positional argument or a subcommand."""
    names: list
    value: str = ""    # TEXT, FLOAT, INT or UINT; empty: a flag, or a subcommand
    allowed: str = ""  # "a number over 0"
    default: str = ""
    several: bool = False
    required: bool = False
    needs: str = ""
    excludes: str = ""
    text: str = ""


@dataclasses.dataclass
class Help:
    description: list  # lines; those that begin with two spaces are literal
    examples: list
    usage: str
    positionals: list
    options: list
    subcommands: list


def said_by(program, *words, success=0):
    """Output of `program words`. "~" stands for the home folder, so that no default holds a path of whoever builds."""
    environment = {k: v for k, v in os.environ.items() if k != "XDG_CACHE_HOME"} | {"HOME": "~"}
    done = subprocess.run([program, *words], capture_output=True, text=True, env=environment, stdin=subprocess.DEVNULL)
    if done.returncode != success:
        raise SystemExit(f"{program} {' '.join(words)} ended with {done.returncode}: {(done.stdout + done.stderr)[-500:]}")
    return done.stdout


def read(program, *command):
    lines = said_by(program, *command, "--help").splitlines()
    start = next(k for k, line in enumerate(lines) if line.startswith("Usage: "))
    description, examples = split_examples(lines[:start])
    sections = dict(split_sections(lines[start + 1:]))
    return Help(description, examples, lines[start].removeprefix("Usage: "),
                *[[parse(*head_and_text(entry)) for entry in split_entries(sections.get(name, []))]
                  for name in ("Positionals", "Options")],
                [Entry([head], text=text) for head, text in map(head_and_text, split_entries(sections.get("Subcommands", [])))])


def split_examples(lines):
    """(description, commands): the commands follow the word "Example:" to the end."""
    whole = "\n".join(lines)
    description, _, examples = whole.partition("Example: ")
    return description.rstrip().splitlines(), [line.strip() for line in examples.splitlines() if line.strip()]


def split_sections(lines):
    """(name, lines) of each part under a heading such as "Options:"."""
    name, part = None, []
    for line in [*lines, "End:"]:
        if re.fullmatch(r"[A-Z][a-z]+:", line):
            if name:
                yield name, part
            name, part = line[:-1], []
        elif line:
            part.append(line)


def split_entries(lines):
    """Lists of lines: a head, then lines that stand in the text's column."""
    entries = []
    for line in lines:
        if line.startswith(" " * TEXT_COLUMN):
            entries[-1].append(line)
        else:
            entries.append([line])
    return entries


def head_and_text(entry):
    """(names with their properties, text in one line). A head that reaches the text's column has a line to itself."""
    first = entry[0]
    shared = len(first) > TEXT_COLUMN and first[TEXT_COLUMN - 1] == " " and (first[TEXT_COLUMN - 2] == " " or len(entry) == 1)
    head, texts = (first[:TEXT_COLUMN], [first[TEXT_COLUMN:]]) if shared else (first, [])
    return head.strip(), " ".join(line.strip() for line in [*texts, *entry[1:]])


def parse(head, text):
    """`--frames INT:a whole number from 2 to 10000=40 REQUIRED Needs: --fields` in its parts."""
    head, excludes = cut(head, " Excludes: ")
    head, needs = cut(head, " Needs: ")
    head, required = head.removesuffix(" REQUIRED"), head.endswith(" REQUIRED")
    head, several = re.subn(r" (\.\.\.|x \d+)$", "", head)  # any number of words, or so many
    names, _, kind = head.partition(" ")
    matched = re.fullmatch(r"([A-Z]*)(?::(.*?))?(?:=(.*))?", kind)
    if not matched:
        raise SystemExit(f"help_text.py: cannot read '{head}' in the help of mpm")
    value, allowed, default = (part or "" for part in matched.groups())
    return Entry(re.sub(r"\{.*?\}", "", names).split(","), value, allowed, default, bool(several), required, needs, excludes, text)


def cut(head, mark):
    before, _, after = head.partition(mark)
    return before, after
