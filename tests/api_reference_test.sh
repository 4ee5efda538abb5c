#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# api_reference_test.sh DOXYFILE: every public entity is documented, and one that is not would be found.
set -uo pipefail
doxyfile=$1
command -v doxygen > /dev/null && [ -e "$doxyfile" ] || { echo "skipped: doxygen is missing"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
run() { { cat "$doxyfile"; printf '%s\n' "OUTPUT_DIRECTORY = $work" "$@"; } | doxygen - > "$work/log" 2>&1; }
run || { cat "$work/log"; echo "FAILED: the API reference"; exit 1; }
for entity in find_symmetry TriangleMesh to_triangle_mesh StopReason bijectivity_weight; do
  grep -rqw $entity "$work"/html/*ga__symmetry*.html || { echo "FAILED: $entity is not in the reference"; exit 1; }
done
cat > "$work/undocumented.h" << END
namespace ga_symmetry {
int undocumented(int);
}
END
! run "INPUT += $work/undocumented.h" && grep -q "undocumented.*is not documented" "$work/log" ||
  { cat "$work/log"; echo "FAILED: an undocumented function is no error"; exit 1; }
echo "every public entity is documented"
