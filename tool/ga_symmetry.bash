# Bash completion of ga_symmetry: commands, options and their choices, all as its --help says.
_ga_symmetry() {
  local tool=$1 word=$2 previous=$3 help choices
  COMPREPLY=()
  if [[ $COMP_CWORD -eq 1 ]]; then
    help=$("$tool" --help 2>/dev/null)
    mapfile -t COMPREPLY < <(compgen -W "$(awk '/^Subcommands:/ { on = 1; next } /^$/ { on = 0 } on { print $1 }' <<< "$help") --help --version" -- "$word")
    return
  fi
  help=$("$tool" "${COMP_WORDS[1]}" --help 2>/dev/null)
  if [[ $previous == --* ]]; then
    choices=$(awk -v option="$previous" '$1 == option && $2 ~ /\|/ { gsub(/\|/, " ", $2); print $2 }' <<< "$help")
    if [[ -n $choices ]]; then
      mapfile -t COMPREPLY < <(compgen -W "$choices" -- "$word")
      return
    fi
  fi
  if [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(grep -oE -- '^ +(-[a-z],)?--[a-z-]+' <<< "$help" | grep -oE -- '--[a-z-]+')" -- "$word")
  else
    compopt -o default 2>/dev/null  # files
  fi
}
complete -F _ga_symmetry ga_symmetry
