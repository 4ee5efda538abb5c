#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# score_test.sh TOOL SAMPLES SHARED: `ga_symmetry score` and the scorer of partner maps agree to 1e-3, where there is one.
set -euo pipefail
tool=$1 samples=$2 shared=$3
[ -f "$shared/score/score.cpp" ] || { echo "skipped: there is no scorer in $shared"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
${CXX:-g++} -O2 -std=c++17 "$shared/score/score.cpp" -o "$work/score"

# compare MESH TRUTH RESULT
compare() {
  "$work/score" "$@" > "$work/theirs"
  "$tool" score "$@" > "$work/ours"
  paste -d ' ' "$work/theirs" "$work/ours" | awk -v what="$1" '{
    for (i = 2; i <= NF / 2; i += 2) { d = $i - $(i + NF / 2); if (d < -1e-3 || d > 1e-3) bad = 1 } }
    bad { print "FAILED: " what ": " $0; exit 1 }'
}
# results MESH: a map that was found, and one that is scattered and lacks partners.
results() {
  "$tool" find "$1" --quiet --joint-samples 30 --joint-population 10 --joint-generations 2 --largest-component -o "$work/found.csv"
  awk -F, 'NR == 1 { print; next } { p[NR - 2] = $2 } END { n = NR - 1
    for (v = 0; v < n; ++v) print v "," (v % 3 ? (v * 17) % n : v % 2 ? -1 : p[v]) ",0,0" }' "$work/found.csv" > "$work/mixed.csv"
}
for mesh in "$samples"/person_dance.off "$samples"/person_wave_scan.off "$shared"/dev_meshes/wolf1.off; do
  [ -f "$mesh" ] || continue
  results "$mesh"
  for map in found mixed; do compare "$mesh" "${mesh%.off}.truth" "$work/$map.csv"; done
done
echo "agree"
