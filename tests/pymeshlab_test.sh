#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs the PyMeshLab examples on a sample, then pymeshlab_test.py. The plugin must be the one for the PyMeshLab that
# python3 imports (scripts/build_plugin), and not be installed there:
#
#   GA_SYMMETRY_PYMESHLAB_PLUGIN=libfilter_ga_symmetry.so tests/pymeshlab_test.sh
#
# Exit 0 = passed, 1 = failed, 77 = cannot be run here.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
for example in "$root"/examples/pymeshlab/*.py; do
  python3 -c 'import ast, sys; ast.parse(open(sys.argv[1]).read())' "$example" || { echo "FAILED: $example does not parse"; exit 1; }
done
python3 -c 'import pymeshlab' 2> /dev/null || { echo "skipped: python3 cannot import pymeshlab"; exit 77; }
[ -n "${GA_SYMMETRY_PYMESHLAB_PLUGIN:-}" ] ||
  { echo "skipped: set GA_SYMMETRY_PYMESHLAB_PLUGIN to the plugin built for this PyMeshLab"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
sample=$root/sample_meshes/person_wave
references=$(tr ' ' ',' < "$sample.refs")
python3 "$root/examples/pymeshlab/mirror_color.py" "$GA_SYMMETRY_PYMESHLAB_PLUGIN" "$sample.off" "$references" out.ply
grep -q symmetry_partner out.ply || { echo "FAILED: the partners were not saved"; exit 1; }
for script in "$root"/examples/meshlabserver/*.mlx; do
  rm -f out.ply
  python3 "$root/examples/pymeshlab/run_script.py" "$GA_SYMMETRY_PYMESHLAB_PLUGIN" "$sample.off" "$script" out.ply
  [ -s out.ply ] || { echo "FAILED: $script"; exit 1; }
done
if python3 -c 'import matplotlib' 2> /dev/null; then
  python3 "$root/examples/pymeshlab/walk_through.py" "$GA_SYMMETRY_PYMESHLAB_PLUGIN" "$sample.off" .
  [ -s walk_through.png ] && grep -aq symmetry_partner walk_through.ply || { echo "FAILED: walk_through.py"; exit 1; }
fi
python3 "$root/tests/pymeshlab_test.py"
