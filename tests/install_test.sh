#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs into a folder of its own, and builds and runs the example programs against that.
#
#   install_test.sh BUILD_DIRECTORY VCGLIB SAMPLE.off
set -euo pipefail
build=$1 vcglib=$2 sample=$3
root=$(realpath "$(dirname "$0")/..")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
. "$root/tests/installed_library.sh"
install_to "$build" "$work/usr"
for file in bin/ga_symmetry share/man/man1/ga_symmetry.1.gz share/bash-completion/completions/ga_symmetry \
            share/ga_symmetry/sample_meshes/person_wave.off share/doc/ga-symmetry/examples; do
  [ -e "$work/usr/$file" ] || fail "$file is not installed"
done
if "$work/usr/bin/ga_symmetry" --help | grep compare > /dev/null; then
  for file in report.py tables.py plots.py report.html.j2; do
    [ -e "$work/usr/share/ga_symmetry/comparison/$file" ] || fail "$file is not installed"
  done
fi
"$work/usr/bin/ga_symmetry" --version
check_headers "$work/usr"
build_and_run_examples "$work/usr" "$vcglib" "$sample"

# The snippet of the README is what the example does, with names of files in place of arguments.
snippet=$(sed -n '/^```cpp$/,/^```$/p' "$root/README.md" | sed '/^```/d')
[ "$(wc -l <<< "$snippet")" -ge 5 ] || fail "the README has no snippet"
while read -r line; do
  line=${line/\"body.ply\"/argv[1]} line=${line/\"partners.csv\"/argv[2]}
  [ -z "$line" ] || grep -qF -- "$line" "$root/examples/read_file/main.cpp" ||
    fail "the README says what the example does not: $line"
done <<< "$snippet"
echo "the examples were built and run"
