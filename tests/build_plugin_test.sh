#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# scripts/build_plugin: what it refuses, and where the plugin is installed by the layouts of MeshLab and PyMeshLab. Only
# configured, not built; the programs' library is stood in for by a file.
#
#   GA_SYMMETRY_MESHLAB_SOURCES=TREE[:TREE]... tests/build_plugin_test.sh
#
# Exit 0 = passed, 1 = failed, 77 = no tree of 2022 or later is given (what is refused was tested).
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "FAILED: $*"; exit 1; }
refused() {
  local words=$1
  shift
  ! "$root/scripts/build_plugin" "$@" > "$work/out" 2> "$work/err" || fail "$* was not refused"
  [ "$(wc -l < "$work/err")" -eq 1 ] && grep -q -- "$words" "$work/err" || fail "$*: $(cat "$work/err")"
}
refused "git clone" "$work" --pymeshlab
mkdir -p "$work/tree/src" && echo 2025.07 > "$work/tree/ML_VERSION"
refused "submodule update" "$work/tree" --pymeshlab
mkdir -p "$work/tree/src/vcglib/vcg"
refused "--library" "$work/tree"
refused "does not exist" "$work/tree" --library "$work/libmeshlab-common.so"
refused "no option --fast" "$work/tree" --fast
mkdir -p "$work/tree/src/common" && touch "$work/tree/src/common/interfaces.h"
refused "2020.09 or older" "$work/tree" --pymeshlab

tested=0
IFS=: read -r -a trees <<< "${GA_SYMMETRY_MESHLAB_SOURCES:-}"
for tree in "${trees[@]}"; do
  [ ! -e "$tree/src/common/interfaces.h" ] || continue
  tested=1
  for layout in lib/meshlab lib; do
    prefix=$work/prefix/$layout.d
    mkdir -p "$prefix/$layout"
    touch "$prefix/$layout/libmeshlab-common.so"
    cmake -S "$root" -B "$work/build" --fresh -DGA_SYMMETRY_PLUGIN=ON -DBUILD_TESTING=OFF -DGA_SYMMETRY_TOOL=OFF \
      -DGA_SYMMETRY_COMPARISON=OFF -DMESHLAB_SOURCE_DIR="$(realpath "$tree")" \
      -DMESHLAB_COMMON_LIBRARY="$prefix/$layout/libmeshlab-common.so" > "$work/log" 2>&1 || fail "$(tail -n 5 "$work/log")"
    grep -q "CMAKE_INSTALL_PREFIX:PATH=$prefix\$" "$work/build/CMakeCache.txt" || fail "another prefix than $prefix"
    grep -q "{CMAKE_INSTALL_PREFIX}/$layout/plugins" "$work/build/filter_ga_symmetry/cmake_install.cmake" ||
      fail "the plugin would not be installed in $layout/plugins"
  done
done
[ $tested = 1 ] || { echo "skipped: set GA_SYMMETRY_MESHLAB_SOURCES to source trees of MeshLab 2022 or later"; exit 77; }
