#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# instructions_test.sh TOOL SAMPLES FLAGS [--update]: three fixed runs take as many instructions as in
# instructions.txt, within 10 %. Unlike seconds they are the same on a busy machine. A change that is meant to cost more
# writes the file anew with --update, and says in its commit why. Counted by valgrind, for the compiler and the flags
# that the file names; others skip.
set -euo pipefail
tool=$1 samples=$2
read -r -a flags <<< "$3"
build="$(${CXX:-g++} -dumpmachine) $(${CXX:-g++} -dumpfullversion) ${flags[*]}"
stored=$(dirname "$(realpath "$0")")/instructions.txt
command -v valgrind > /dev/null || { echo "skipped: there is no valgrind"; exit 77; }
[ "${4:-}" = --update ] || [ "$(head -1 "$stored")" = "$build" ] ||
  { echo "skipped: counts are stored for $(head -1 "$stored"), this is $build"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# count NAME ARGUMENT...: of `find` on one thread
count() {
  valgrind --tool=callgrind --callgrind-out-file=/dev/null "$tool" find "${@:2}" --threads 1 --quiet \
    -o "$work/$1.csv" > "$work/$1.log" 2>&1 || { cat "$work/$1.log"; echo "FAILED: $1 did not run"; exit 1; }
  echo "$1 $(awk '/Collected/ { print $NF }' "$work/$1.log")" > "$work/$1.count"
}
small=(--joint-samples 40 --joint-sites 100 --joint-population 20)
count whole "$samples/animal_graze.off" "${small[@]}" &
count references "$samples/person_wave_low_poly.off" --refs "$(tr ' ' , < "$samples/person_wave_low_poly.refs")" "${small[@]}"
count rotation "$samples/trefoil_bend.off" --symmetry rotation "${small[@]}"
wait $!
cat "$work"/{whole,references,rotation}.count > "$work/counts"
if [ "${4:-}" = --update ]; then
  { echo "$build"; cat "$work/counts"; } > "$stored"
  exit
fi
awk 'NR == FNR { if (FNR > 1) stored[$1] = $2; next }
  !($1 in stored) || $2 !~ /^[0-9]+$/ { print "FAILED: no count of " $1; bad = 1; next }
  { ratio = $2 / stored[$1]; printf "%s: %.2f billion instructions, %.3f of the stored\n", $1, $2 / 1e9, ratio }
  ratio > 1.1 || ratio < 0.9 { print "FAILED: " $1 ": off by more than 10 %; if it is meant, run with --update"; bad = 1 }
  END { exit bad || FNR != 3 }' "$stored" "$work/counts"
