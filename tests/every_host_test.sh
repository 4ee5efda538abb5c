#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Every filter in every MeshLab there is, on every mesh given. All must export the partners that the tool finds, to the
# byte, and say the same of the rest; every window must show what each filter did, and a sheet of its pictures is kept
# for each mesh, to be looked at.
#
#   tests/every_host_test.sh TOOL MAKE_FILTER_SCRIPT PICTURES MESH...
#
# GA_SYMMETRY_MESHLABSERVER      the meshlabserver of MeshLab 2020.09, which also rewrites the meshes in single precision
# GA_SYMMETRY_MESHLABS           MeshLabs with a window, separated by blanks
# GA_SYMMETRY_PYMESHLAB_PLUGIN   the plugin for the PyMeshLab that python3 imports
#
# Exit 0 = passed, 1 = failed, 77 = cannot be run here.
set -euo pipefail
if [ $# -lt 4 ]; then
  sed -n '3,13s/^# \{0,1\}//p' "$0" >&2
  exit 2
fi
root=$(cd "$(dirname "$0")/.." && pwd)
server=${GA_SYMMETRY_MESHLABSERVER:-} windows=${GA_SYMMETRY_MESHLABS:-} plugin=${GA_SYMMETRY_PYMESHLAB_PLUGIN:-}
[ -x "$server" ] || { echo "skipped: set GA_SYMMETRY_MESHLABSERVER"; exit 77; }
if [ -z "${GA_SYMMETRY_SCREEN:-}" ]; then
  GA_SYMMETRY_SCREEN=1 exec xvfb-run -a -s "-screen 0 1280x900x24" "$0" "$@"
fi
tool=$(realpath "$1") make_filter_script=$(realpath "$2") pictures=$(realpath "$3")
mkdir -p "$pictures"
meshes=()
for mesh in "${@:4}"; do meshes+=("$(realpath "$mesh")"); done
settings=$(mktemp -d)
. "$root/scripts/window.sh"
trap 'stop_window; rm -rf "$settings"' EXIT
cd "$settings"
failed=0
fail() {
  echo "FAILED: $*"
  failed=1
}

# said LOG: what the filters say of their results
said() {
  sed 's/^LOG: [12] //' "$1" | grep -E '^(doubtful|the map|Surface|References|Found|Asymmetry|Mirrored|Imported|Samples|Drawn)'
}

# same HOST: what a host did is what the tool and the first host did
same() {
  cmp -s "partners.$1.csv" partners.csv || fail "$name: the partners of $1 are not the tool's"
  said "log.$1" > "said.$1"
  # Imported twice, mirrored twice: attributes and a sculpt.
  [ "$(grep -Ec '^(Found|Asymmetry|Mirrored|Imported|Samples|Drawn)' "said.$1")" = 8 ] || fail "$name: not every filter ran in $1"
  diff said "said.$1" || fail "$name: $1 says something else"
}

# rewrite MESH OUT [OPTION]...: as MeshLab writes it, in single precision
rewrite() { "$server" -i "$1" -o "$2" "${@:3}" > log 2>&1 || { cat log && exit 1; }; }

# What is done after the search: on that mesh, then on its sculpted copy. In this order, as the last makes layers.
filters="compute_asymmetry_per_vertex transfer_attributes_across_intrinsic_symmetry attribute=1 generate_evenly_spaced_samples
  load_partners_of_intrinsic_symmetry partners_file=partners.csv generate_polyline_from_intrinsic_symmetry"
sculpt="load_partners_of_intrinsic_symmetry partners_file=partners.csv transfer_sculpt_across_intrinsic_symmetry before=0"

for mesh in "${meshes[@]}"; do
  name=$(basename "$mesh" .off)
  rm -f ./*.csv ./*.ply log.* said*
  rewrite "$mesh" ascii.ply -m sa
  # The sculpted copy: swollen about its first vertex.
  awk 'BEGIN { k = 0 } !body { print; if ($2 == "vertex") n = $3; body = $1 == "end_header"; next }
    k < n { x[k] = $1; y[k] = $2; z[k] = $3; $1 = $2 = $3 = ""; rest[k++] = $0; if (k < n) next
      for (v = 0; v < n; ++v) for (i = 0; i < 3; ++i) {
        c = i == 0 ? x[v] : i == 1 ? y[v] : z[v]
        if (v == 0 || c < low[i]) low[i] = c
        if (v == 0 || c > high[i]) high[i] = c }
      r = ((high[0]-low[0])^2 + (high[1]-low[1])^2 + (high[2]-low[2])^2) / 50
      for (v = 0; v < n; ++v) {
        t = ((x[v]-x[0])^2 + (y[v]-y[0])^2 + (z[v]-z[0])^2) / r; s = t < 1 ? 1 + 0.3 * (1 - t)^2 : 1
        printf "%.9g %.9g %.9g%s\n", x[0] + s*(x[v]-x[0]), y[0] + s*(y[v]-y[0]), z[0] + s*(z[v]-z[0]), rest[v] }
      next } { print }' ascii.ply > swollen.ply
  rewrite ascii.ply before.ply
  rewrite swollen.ply after.ply
  "$tool" find before.ply --quiet -o partners.csv

  "$make_filter_script" export_to=partners.server.csv $filters > find.mlx
  "$make_filter_script" $sculpt > sculpt.mlx
  "$server" -i before.ply -o server.ply -s find.mlx 2> log.server > /dev/null || fail "$name: meshlabserver"
  "$server" -i before.ply after.ply -o sculpted.ply -s sculpt.mlx 2>> log.server > /dev/null || fail "$name: meshlabserver, the sculpt"
  said log.server > said
  same server

  if [ -n "$plugin" ]; then
    sed 's/partners.server.csv/partners.pymeshlab.csv/' find.mlx > python.mlx
    python3 - "$plugin" > log.pymeshlab 2>&1 << 'PYTHON' || fail "$name: PyMeshLab"
import sys
import pymeshlab
pymeshlab.load_plugin(sys.argv[1])
for files, script in ((["before.ply"], "python.mlx"), (["before.ply", "after.ply"], "sculpt.mlx")):
    meshes = pymeshlab.MeshSet(verbose=True)
    for file in files:
        meshes.load_new_mesh(file)
    meshes.load_filter_script(script)
    meshes.apply_filter_script()
PYTHON
    same pymeshlab
  fi

  number=0
  for program in $windows; do
    host=window$((++number))
    start before.ply
    # Where the buttons of the files are, above the dialogs' lower edges.
    case $(xdotool getwindowname "$window") in *2020*) to_find=310 to_import=94 ;; *) to_find=245 to_import=216 ;; esac
    shown=() before=
    step() {
      filter "$1"
      case $1 in
        "Find Partners") choose_file $((width - 60)) $((height - to_find)) "$settings/partners.$host.csv" ;;
        "Import Partners") choose_file $((width - 60)) $((height - to_import)) "$settings/partners.csv" ;;
      esac
      apply
      shown+=("$settings/$((${#shown[@]} + 10)).png")
      import -silent -window root "${shown[-1]}"
      close
      # The view, without what changes by itself below; an import shows what was found before.
      now=$(import -silent -window root -crop 850x620+5+75 rgb:- | cksum)
      [ "$now" != "$before" ] || [ "$1" = "Import Partners" ] || fail "$name: $host does not show what $1 did"
      before=$now
    }
    for each in "Find Partners" "Asymmetry" "Mirror Attributes" "Evenly Spaced Samples" "Import Partners" "Show Pairs and Axis"; do
      step "$each"
    done
    cp log "log.$host"
    start before.ply after.ply
    step "Import Partners"
    step "Mirror Sculpt"
    cat log >> "log.$host"
    stop_window
    montage "${shown[@]}" -tile 4x -geometry 640x450+2+2 "$pictures/$name.$host.png"
    same $host
  done
  echo "$name: $(grep -c . said) lines, $(cat said.* | grep -c '^Found') hosts"
done
exit $failed
