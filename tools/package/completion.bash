# Completion of mpm for bash: commands and options, as --help prints them; behind these files.
_mpm()
{
  local word=${COMP_WORDS[COMP_CWORD]} help
  help=$("${COMP_WORDS[0]}" "${COMP_WORDS[@]:1:COMP_CWORD > 1}" --help 2>/dev/null)
  COMPREPLY=()
  if [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(sed -n 's/^  \(-[^ {]*\).*/\1/p' <<< "$help" | tr , '\n')" -- "$word")
  elif ((COMP_CWORD == 1)); then
    mapfile -t COMPREPLY < <(compgen -W "$(sed -n '/^Commands /,$ s/^  \([a-z][a-z]*\) .*/\1/p' <<< "$help")" -- "$word")
  fi
}
complete -o default -F _mpm mpm
