# SPDX-License-Identifier: GPL-3.0-or-later
# What an installed library has to fulfil. Sourced by install_test.sh and library_alone_test.sh, with $root the sources
# and $work a folder for what is made on the way.
fail() { echo "FAILED: $*"; exit 1; }
logged() { "$@" > "$work/log" 2>&1 || { cat "$work/log"; fail "$*"; }; }

install_to() { logged cmake --install "$1" --prefix "$2"; }  # BUILD PREFIX

# check_headers PREFIX: the public headers and no others, and none of them asks for another library.
check_headers() {
  diff <(cd "$root/core/include" && find . -name '*.h' | sort) <(cd "$1/include" && find . -type f | sort) ||
    fail "other headers are installed than the public ones"
  ! grep -rhE '^ *# *include *[<"]' "$1/include" | grep -vE '<[a-z_]+>|"ga_symmetry/[a-z_]+\.h"' ||
    fail "a public header includes more than the standard library and public headers"
}

# build_and_run_examples PREFIX VCGLIB SAMPLE.off [CMAKE_OPTION]...
build_and_run_examples() {
  local prefix=$1 vcglib=$2 sample=$3 example vertices rc
  shift 3
  vertices=$(awk 'NR == 2 { print $1 }' "$sample")
  for example in use_core read_file; do
    [ "$(wc -l < "$root/examples/$example/main.cpp")" -lt 30 ] || fail "the example $example is not short"
    logged cmake -S "$root/examples/$example" -B "$work/$example" -DCMAKE_PREFIX_PATH="$prefix" \
      -DVCGLIB_DIR="$vcglib" "$@"
    logged cmake --build "$work/$example"
  done
  ! grep -rlE 'include *<(vcg|wrap)/' "$root/examples/read_file" || fail "read_file includes vcglib"
  "$work/use_core/use_core" "$sample" > "$work/partners"
  [ "$(wc -l < "$work/partners")" = "$vertices" ] || fail "use_core: not a partner for every vertex"
  "$work/read_file/read_file" "$sample" "$work/partners.csv" > "$work/log" || fail "read_file does not run"
  cmp <(awk -F, 'NR > 1 { print $1, $2 }' "$work/partners.csv") "$work/partners" ||
    fail "the two examples find different partners"
  for example in use_core read_file; do
    rc=0
    "$work/$example/$example" missing.off "$work/missing.csv" 2> /dev/null || rc=$?
    [ $rc != 0 ] && [ ! -e "$work/missing.csv" ] || fail "$example: a missing file is not refused"
  done
}
