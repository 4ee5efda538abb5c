#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The library alone is configured and built where nothing is found that it can do without, installed, and used.
#
#   library_alone_test.sh VCGLIB SAMPLE.off
set -euo pipefail
vcglib=$1 sample=$2
root=$(realpath "$(dirname "$0")/..")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
. "$root/tests/installed_library.sh"
absent=()
for package in CLI11 spectra Qt5 MeshLab GTest rapidcheck benchmark Doxygen Python3; do
  absent+=(-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON)
done
# Unoptimised: it is to be built, not to be fast.
quick=(-DCMAKE_BUILD_TYPE= -DCMAKE_CXX_FLAGS=-O0)
! command -v ccache > /dev/null || quick+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
# Without GA_SYMMETRY_BENCH, which follows the comparison.
logged env SOURCE_DATE_EPOCH=86400 cmake -S "$root" -B "$work/all" "${absent[@]}" -DVCGLIB_DIR="$vcglib" \
  -DGA_SYMMETRY_TOOL=OFF -DGA_SYMMETRY_PLUGIN=OFF -DGA_SYMMETRY_COMPARISON=OFF -DBUILD_TESTING=OFF
grep -q "  Fri, 02 Jan 1970 00:00:00 +0000$" "$work/all/debian/changelog" ||
  fail "the package's date is not SOURCE_DATE_EPOCH"
! cmake -S "$root" -B "$work/tool" "${absent[@]}" -DVCGLIB_DIR="$vcglib" > "$work/log" 2>&1 ||
  fail "the tool is configured without CLI11: nothing was absent"

cd "$root"
logged cmake --preset library -B "$work/build" "${absent[@]}" "${quick[@]}" -DVCGLIB_DIR="$vcglib"
logged cmake --build "$work/build"
install_to "$work/build" "$work/usr"
[ ! -e "$work/usr/bin" ] || fail "a program is installed"
[ -z "$(find "$work/usr/lib" -name '*.so')" ] || fail "a plugin is installed"
check_headers "$work/usr"
cd "$work"

# read_file without Eigen, too.
build_and_run_examples "$work/usr" "$vcglib" "$sample"
logged cmake -S "$root/examples/read_file" -B "$work/bare" -DCMAKE_PREFIX_PATH="$work/usr" "${absent[@]}" \
  -DCMAKE_DISABLE_FIND_PACKAGE_Eigen3=ON

# Within another project it is the library alone.
mkdir "$work/parent"
cat > "$work/parent/CMakeLists.txt" << END
cmake_minimum_required(VERSION 3.25)
project(parent CXX)
add_subdirectory($root ga_symmetry)
add_executable(program $root/examples/read_file/main.cpp)
target_link_libraries(program PRIVATE ga_symmetry::core)
END
logged cmake -S "$work/parent" -B "$work/parent/build" "${absent[@]}" -DVCGLIB_DIR="$vcglib"
echo "built, installed and used"
