#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The tool gives the same bytes whichever release of vcglib compiles it: that of this build against others.
#
#   GA_SYMMETRY_VCGLIBS=DIRECTORY[:DIRECTORY]... tests/vcglib_test.sh TOOL
#
# A DIRECTORY holds vcg/ and wrap/. Exit 0 = the same, 1 = not, 77 = none are given.
set -euo pipefail
[ -n "${GA_SYMMETRY_VCGLIBS:-}" ] ||
  { echo "skipped: set GA_SYMMETRY_VCGLIBS to directories of vcglib, separated by colons"; exit 77; }
root=$(cd "$(dirname "$0")/.." && pwd)
tool=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
IFS=: read -r -a directories <<< "$GA_SYMMETRY_VCGLIBS"
for directory in "${directories[@]}"; do
  echo "== $directory"
  rm -rf "$work/build"
  cmake -S "$root" -B "$work/build" -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=OFF -DGA_SYMMETRY_PLUGIN=OFF \
    -DGA_SYMMETRY_COMPARISON=OFF -DVCGLIB_DIR="$(realpath "$directory")" > "$work/log" 2>&1 &&
    cmake --build "$work/build" -j "$(nproc)" --target ga_symmetry_tool > "$work/log" 2>&1 ||
    { cat "$work/log"; exit 1; }
  "$root/scripts/same_bytes" "$tool" "$work/build/tool/ga_symmetry"
done
