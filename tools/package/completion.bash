# Completion of mpm for bash. Before it stand the words of `mpm --help`, which `mpm --write-pages` writes: _mpm_first, _mpm_options COMMAND, and
# _mpm_value COMMAND OPTION: files, files:ENDING, heading:KIND, words:WORDS, nothing.

_mpm_files()
{
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen -d -- "$2"; compgen -f -X "${1:+!*.$1}" -- "$2" | while IFS= read -r name; do
    [[ -d $name ]] || printf '%s\n' "$name"; done)
}

# Names of the headings [KIND.NAME] in the first .toml file of the command line.
_mpm_headings()
{
  local word
  for word in "${COMP_WORDS[@]}"; do
    if [[ $word == *.toml && -r $word ]]; then
      sed -n "s/^ *\[$1\.\([A-Za-z0-9_-]*\).*/\1/p" "$word" | sort -u
      return
    fi
  done
}

_mpm()
{
  local word=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]} value
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    mapfile -t COMPREPLY < <(compgen -W "$_mpm_first" -- "$word")
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
