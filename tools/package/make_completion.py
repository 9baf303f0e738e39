#!/usr/bin/python3
"""Writes the completion of `mpm` for bash, from the program's own help.

    make_completion.py FILE --mpm PROGRAM"""
import argparse
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2] / "examples/common"))
import one_sentence  # noqa: E402, F401
import help_text  # noqa: E402

# Which files a positional argument names; of a deck no ending is agreed on.
ENDINGS = {"MATERIALS": "toml", "LAW": "h5", "DECK": "", "DATA": "csv"}
# Words of the materials file's headings [particle.NAME] and [material.NAME].
HEADINGS = {"--particle": "particle", "--against": "particle", "--wall": "material", "--indenter": "material"}
WORDS = {"--grid": "mapped rectilinear tartan updated rectilinear-3d", "--precision": "double single", "--support": "free midplane",
         "--fit": "youngs_modulus yield_stress hardening_modulus saturation_stress strain strength exponent offset", "--planes": "pair cube die bcc fcc"}
NOTHING = ("--pair", "--var", "--materials", "--prior", "--bounds", "--name", "--guess", "--known", "--speeds", "--displacements", "--shape")  # free text
NUMBERS = ("INT", "UINT", "FLOAT")

SCRIPT = """\
# Completion of mpm for bash, made from `mpm --help` by tools/package/make_completion.py.

_mpm_options()
{
  case $1 in
@OPTIONS@
  esac
}

# Value behind an option or at the place of an argument: files, files:ENDING, heading:KIND, words:WORDS,
# nothing.
_mpm_value()
{
  case $1:$2 in
@VALUES@
  esac
}

_mpm_files()
{
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen -d -- "$2"; compgen -f -X "${1:+!*.$1}" -- "$2" | while IFS= read -r name; do
    [[ -d $name ]] || printf '%s\\n' "$name"; done)
}

# Names of the headings [KIND.NAME] in the first .toml file of the command line.
_mpm_headings()
{
  local word
  for word in "${COMP_WORDS[@]}"; do
    if [[ $word == *.toml && -r $word ]]; then
      sed -n "s/^ *\\[$1\\.\\([A-Za-z0-9_-]*\\).*/\\1/p" "$word" | sort -u
      return
    fi
  done
}

_mpm()
{
  local word=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]} value
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    mapfile -t COMPREPLY < <(compgen -W "@COMMANDS@ $(_mpm_options)" -- "$word")
    return
  fi
  if [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(_mpm_options "$command")" -- "$word")
    return
  fi
  value=$(_mpm_value "$command" "$previous")
  [[ -n $value ]] || value=$(_mpm_value "$command" argument)
  case $value in
    files) _mpm_files '' "$word" ;;
    files:*) _mpm_files "${value#files:}" "$word" ;;
    heading:*) mapfile -t COMPREPLY < <(compgen -W "$(_mpm_headings "${value#heading:}")" -- "$word") ;;
    words:*) mapfile -t COMPREPLY < <(compgen -W "${value#words:}" -- "$word") ;;
  esac
}

complete -F _mpm mpm
"""


def long_names(entry):
    return [name for name in entry.names if name.startswith("--")]


def value_of(entry):
    """What _mpm_value says of an option; empty: it takes none."""
    if not entry.value:
        return ""
    name = entry.names[-1]
    if entry.value in NUMBERS or name in NOTHING:
        return "nothing"
    if entry.allowed.startswith("{"):
        return "words:" + entry.allowed.strip("{}").replace(",", " ")
    if name in WORDS:
        return f"words:{WORDS[name]}"
    return f"heading:{HEADINGS[name]}" if name in HEADINGS else "files"


def value_rows(command, one):
    rows = [f"    {'|'.join(f'{command}:{name}' for name in entry.names)}) echo '{value_of(entry)}' ;;"
            for entry in one.options if entry.value]
    for entry in one.positionals:
        ending = ENDINGS[entry.names[0]]
        rows.append(f"    {command}:argument) echo '{'files:' + ending if ending else 'files'}' ;;")
    return rows


def script(program):
    whole = help_text.read(program)
    commands = {entry.names[0]: help_text.read(program, entry.names[0]) for entry in whole.subcommands}
    offered = {"": whole, **commands}
    options = [f"    {command or repr('')}) echo '{' '.join(n for entry in one.options for n in long_names(entry))}' ;;"
               for command, one in offered.items()]
    values = [row for command, one in commands.items() for row in value_rows(command, one)]
    return (SCRIPT.replace("@OPTIONS@", "\n".join(options)).replace("@VALUES@", "\n".join(values))
            .replace("@COMMANDS@", " ".join(commands)))


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("file", type=pathlib.Path)
    options.add_argument("--mpm", required=True)
    options = options.parse_args()
    options.file.parent.mkdir(parents=True, exist_ok=True)
    options.file.write_text(script(options.mpm))


main()
