#!/bin/bash
# Installs into a folder of its own, and builds and runs the example program against that.
#
#   install_test.sh BUILD_DIRECTORY VCGLIB SAMPLE.off
set -euo pipefail
build=$1 vcglib=$2 sample=$3
example=$(dirname "$0")/../examples/use_core
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "FAILED: $*"; exit 1; }
cmake --install "$build" --prefix "$work/usr" > "$work/log" || { cat "$work/log"; fail "cmake --install"; }
for file in bin/ga_symmetry share/man/man1/ga_symmetry.1.gz share/bash-completion/completions/ga_symmetry \
            share/ga_symmetry/sample_meshes/person_wave.off share/ga_symmetry/comparison_plots.py share/doc/ga-symmetry/examples; do
  [ -e "$work/usr/$file" ] || fail "$file is not installed"
done
"$work/usr/bin/ga_symmetry" --version
[ "$(wc -l < "$example/main.cpp")" -lt 30 ] || fail "the example is not short"
cmake -S "$example" -B "$work/example" -DCMAKE_PREFIX_PATH="$work/usr" -DVCGLIB_DIR="$vcglib" > "$work/log" 2>&1 &&
  cmake --build "$work/example" > "$work/log" 2>&1 || { cat "$work/log"; fail "the example does not build"; }
"$work/example/use_core" "$sample" > "$work/partners"
[ "$(wc -l < "$work/partners")" = "$(awk 'NR == 2 { print $1 }' "$sample")" ] || fail "not a partner for every vertex"
rc=0
"$work/example/use_core" missing.off || rc=$?
[ $rc = 2 ] || fail "a missing file is not refused"
echo "the example was built and run"
