#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# manual_test.sh TOOL MANUAL COMPLETION: the manual page and the completion know every command and option of --help.
set -euo pipefail
tool=$1 manual=$2
. "$3"
failed=0
fail() { echo "FAILED: $*"; failed=1; }
complete_words() {  # what would be offered after these words
  COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
  _ga_symmetry "$tool" "${!#}" "${@: -2:1}"
  echo " ${COMPREPLY[*]} "
}
plain=$(sed 's/\\-/-/g' "$manual")
commands=$("$tool" --help | awk '/^Subcommands:/ { on = 1; next } /^$/ { on = 0 } on { print $1 }')
[ "$(wc -w <<< "$commands")" -ge 7 ] || fail "the commands are not read"
for command in $commands; do
  grep -q "^\.SS $command$" <<< "$plain" || fail "the manual lacks the command $command"
  [[ $(complete_words ga_symmetry "") == *" $command "* ]] || fail "$command is not completed"
  help=$("$tool" "$command" --help)
  page=$(awk -v command="$command" '/^\.S/ { on = $2 == command } on' <<< "$plain")
  for option in $(grep -oE '^ +(-[a-z],)?--[a-z-]+' <<< "$help" | grep -oE -- '--[a-z-]+'); do
    grep -Eq -- "^\.B .*$option( |$)" <<< "$page" || fail "the manual of $command lacks $option"
    [[ $(complete_words ga_symmetry "$command" "$option") == *" $option "* ]] || fail "$command $option is not completed"
  done
done
[[ $(complete_words ga_symmetry find --method "") == " joint pairs " ]] || fail "choices are not completed"
if command -v man > /dev/null && command -v groff > /dev/null; then
  warnings=$(LC_ALL=C.UTF-8 MANWIDTH=120 man --warnings -l "$manual" 2>&1 > /dev/null)
  [ -z "$warnings" ] || fail "man says: $warnings"
fi
exit $failed
