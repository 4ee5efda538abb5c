#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Compiles the plugin against the headers of other MeshLab releases, float and double; nothing is linked or run.
#
#   GA_SYMMETRY_MESHLAB_SOURCES=TREE[:TREE]... tests/compile_check.sh
#
# TREE is a release's source tree with its vcglib. Exit 0 = compiles, 1 = does not, 77 = no trees are given.
set -euo pipefail
[ -n "${GA_SYMMETRY_MESHLAB_SOURCES:-}" ] ||
  { echo "skipped: set GA_SYMMETRY_MESHLAB_SOURCES to MeshLab source trees, separated by colons"; exit 77; }
root=$(cd "$(dirname "$0")/.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0
IFS=: read -r -a trees <<< "$GA_SYMMETRY_MESHLAB_SOURCES"
for tree in "${trees[@]}"; do
  tree=$(realpath "$tree")
  version=$(cat "$tree/ML_VERSION")
  build=$work/$version
  for double in OFF ON; do
    # 2020.09 is always float.
    [ $double = OFF ] || [ ! -e "$tree/src/common/interfaces.h" ] || continue
    scalar=$([ $double = ON ] && echo double || echo float)
    if cmake -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O0 -DBUILD_TESTING=OFF \
         -DCMAKE_COMPILE_WARNING_AS_ERROR=ON -DGA_SYMMETRY_PLUGIN=ON -DMESHLAB_SOURCE_DIR="$tree" \
         -DMESHLAB_DOUBLE=$double -DMESHLAB_COMMON_LIBRARY=/dev/null > "$work/log" 2>&1 &&
       cmake --build "$build" -j "$(nproc)" --target ga_symmetry_filters > "$work/log" 2>&1; then
      echo "MeshLab $version, $scalar: compiles"
    else
      echo "MeshLab $version, $scalar: FAILED"
      tail -n 40 "$work/log"
      failed=1
    fi
  done
done
exit $failed
