#!/usr/bin/python3
"""Writes the manual pages mpm.1, mpm-COMMAND.1 and liggghts-mpm.1, each from the program's own help.

    make_manual.py FOLDER --version VERSION [--mpm PROGRAM] [--liggghts PROGRAM --models models.list]"""
import argparse
import gzip
import pathlib
import re
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2] / "examples/common"))
import one_sentence  # noqa: E402, F401
import help_text  # noqa: E402

EXIT_STATUS = [("0", "done"), ("1", "a file cannot be used: one sentence on stderr says why"),
               ("2", "the command line cannot be understood, or what an option says cannot be used"), ("130", "stopped by Ctrl-C")]
ENVIRONMENT = [("GRANULAW_ATLAS", "the atlas to use in place of the one that came with the program"),
               ("XDG_CACHE_HOME", "the folder in which finished runs are kept, under granulaw/runs (default: ~/.cache)")]
LAUNCHER = """LIGGGHTS with the normal models {models} of Granulaw. It reads the same decks and takes the same options as
.BR liggghts (1);
a deck chooses a model with
.B pair_style gran model mpm
and
.BR "fix wall/gran model mpm" ,
and names the law file that
.BR mpm-table (1)
made. The stock binary runs the models, too, when
.I libgranulaw_liggghts.so
is preloaded (LD_PRELOAD)."""


def roff(text):
    """Plain words: no request at the start of a line, no hyphenation mark."""
    escaped = text.replace("\\", "\\e").replace("-", "\\-")
    return re.sub(r"^([.'])", r"\\&\1", escaped, flags=re.M)


def literal(lines):
    return "\n".join([".EX", *map(roff, lines), ".EE"])


def prose(lines):
    """Lines that begin with two spaces keep their form."""
    blocks = []
    for line in lines:
        kind = "literal" if line.startswith("  ") else "text" if line else "gap"
        if not blocks or blocks[-1][0] != kind:
            blocks.append((kind, []))
        blocks[-1][1].append(line)
    shape = {"literal": literal, "text": lambda text: roff("\n".join(text)), "gap": lambda _: ".PP"}
    return "\n".join(shape[kind](text) for kind, text in blocks)


def sentence_of(entry):
    """Meaning of the entry, and the note in its head."""
    parts = [entry.text]
    if entry.required:
        parts.append("Required.")
    if entry.allowed and entry.allowed not in entry.text:
        parts.append(f"Allowed: {entry.allowed}.")
    if entry.default:
        parts.append(f"Default: {entry.default}.")
    if entry.needs:
        parts.append(f"Needs {entry.needs}.")
    if entry.excludes:
        parts.append(f"Not with {entry.excludes}.")
    return parts[0] if len(parts) == 1 else " ".join([parts[0].rstrip(".") + ".", *parts[1:]])


def listed(entries):
    lines = []
    for entry in entries:
        names = ", ".join(rf"\fB{roff(name)}\fR" for name in entry.names)
        value = rf" \fI{entry.value}\fR" + (" ..." if entry.several else "") if entry.value else ""
        lines += [".TP", names + value, roff(sentence_of(entry))]
    return "\n".join(lines)


def pairs(rows):
    return "\n".join(f".TP\n.B {roff(name)}\n{roff(text)}" for name, text in rows)


def page(name, version, summary, sections):
    """`sections`: (heading, roff); those without text are left out."""
    parts = [f'.TH {name.upper()} 1 "" "granulaw {version}" "Granulaw"', ".SH NAME", rf"{roff(name)} \- {roff(summary)}"]
    for heading, text in sections:
        parts += [f".SH {heading}", text] if text else []
    return "\n".join(parts) + "\n"


def first_sentence(text):
    return re.split(r"(?<=[.?])\s", text, maxsplit=1)[0].rstrip(".")


def synopsis(usage):
    words = usage.split(" ")
    return " ".join(rf"\fI{roff(word)}\fR" if word.strip("[]").isupper() else rf"\fB{roff(word)}\fR" for word in words)


def references(names):
    return ",\n".join(f".BR {roff(name)} (1)" for name in names).replace(",\n", " ,\n")


def mpm_pages(program, version):
    """(name, page) of the tool and of each of its commands."""
    whole = help_text.read(program)
    commands = [entry.names[0] for entry in whole.subcommands]
    summary = whole.description[0].removeprefix("mpm: ").rstrip(".")
    subcommands = "\n".join(f".TP\n.BR mpm\\-{entry.names[0]} (1)\n{roff(first_sentence(entry.text))}" for entry in whole.subcommands)
    yield "mpm", page("mpm", version, summary, [
        ("SYNOPSIS", synopsis(whole.usage)), ("DESCRIPTION", prose(whole.description[1:])), ("COMMANDS", subcommands),
        ("OPTIONS", listed(whole.options)), ("EXIT STATUS", pairs(EXIT_STATUS)), ("ENVIRONMENT", pairs(ENVIRONMENT)),
        ("SEE ALSO", references(["liggghts-mpm", *(f"mpm-{name}" for name in commands)]))])
    for command in commands:
        one = help_text.read(program, command)
        examples = literal(one.examples) if one.examples else ""
        yield f"mpm-{command}", page(f"mpm-{command}", version, first_sentence(" ".join(one.description)), [
            ("SYNOPSIS", synopsis(one.usage)), ("DESCRIPTION", prose(one.description)), ("ARGUMENTS", listed(one.positionals)),
            ("OPTIONS", listed(one.options)), ("EXAMPLES", examples), ("EXIT STATUS", pairs(EXIT_STATUS)),
            ("SEE ALSO", references(["mpm", "liggghts-mpm"]))])


def launcher_page(program, version, models):
    """LIGGGHTS lists its options as "-in filename                : read input from file, not stdin (-i)", and then ends with 1."""
    lines = re.findall(r"^(-\S+)(?: (.*?))? +: (.*)$", help_text.said_by(program, "-log", "none", "-help", success=1), flags=re.M)
    if not lines:
        raise SystemExit(f"make_manual.py: {program} -help lists no options")
    options = "\n".join(rf".TP{chr(10)}\fB{roff(name)}\fR \fI{roff(value)}\fR{chr(10)}{roff(text)}" for name, value, text in lines)
    names = " and ".join(line.split()[0] for line in models.read_text().splitlines() if line and line[0] != "#")
    return page("liggghts-mpm", version, f"LIGGGHTS with the contact models {names}", [
        ("SYNOPSIS", r"\fBliggghts\-mpm \-in\fR \fIDECK\fR [\fIOPTIONS\fR]" "\n.br\n"
                     r"\fBmpirun \-np\fR \fIN\fR \fBliggghts\-mpm \-in\fR \fIDECK\fR [\fIOPTIONS\fR]"),
        ("DESCRIPTION", LAUNCHER.format(models=names)), ("OPTIONS", options),
        ("FILES", pairs([("/usr/share/granulaw/examples", "decks to start from, where the Debian package put them")])),
        ("SEE ALSO", references(["mpm", "mpm-table", "mpm-plan", "liggghts"]))])


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("folder", type=pathlib.Path)
    options.add_argument("--version", required=True)
    options.add_argument("--mpm")
    options.add_argument("--liggghts")
    options.add_argument("--models", type=pathlib.Path)
    options = options.parse_args()

    pages = list(mpm_pages(options.mpm, options.version)) if options.mpm else []
    if options.liggghts:
        pages.append(("liggghts-mpm", launcher_page(options.liggghts, options.version, options.models)))
    options.folder.mkdir(parents=True, exist_ok=True)
    for name, text in pages:
        # no time in it: the same sources give the same bytes
        (options.folder / f"{name}.1.gz").write_bytes(gzip.compress(text.encode(), 9, mtime=0))


main()
