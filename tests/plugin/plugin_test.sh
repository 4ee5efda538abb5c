#!/bin/bash
# One case of the plugin in the real meshlabserver, through a filter script.
#
#   plugin_test.sh CASE MESHLABSERVER MAKE_FILTER_SCRIPT TOOL SAMPLE
#
# TOOL     the command line tool.
# SAMPLE   NAME.off with NAME.refs and NAME.truth beside it.
# Exit 0 = passed, 1 = failed, 77 = cannot be run here.
set -euo pipefail

case=$1 meshlabserver=$2 make_filter_script=$3 tool=$4 sample=$5
command -v xvfb-run >/dev/null || { echo "skipped: xvfb-run is missing (apt-get install xvfb xauth)"; exit 77; }
[ -x "$meshlabserver" ] || { echo "skipped: meshlabserver is missing (apt-get install meshlab)"; exit 77; }
[ -f "$sample" ] || { echo "skipped: $sample is missing"; exit 77; }

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
export HOME=$work XDG_RUNTIME_DIR=$work
read -r a0 a1 l r < "${sample%.off}.refs"
refs=$a0,$a1,$l,$r

fail() {
  echo "FAILED: $*"
  cat log
  exit 1
}

# serve MESH [OPTION]...: runs the scripts *.mlx, in order, and saves out.ply
serve() {
  local mesh=$1 script scripts=()
  shift
  for script in *.mlx; do scripts+=(-s "$script"); done
  rc=0
  xvfb-run -a "$meshlabserver" -i "$mesh" -o out.ply "$@" "${scripts[@]}" >log 2>&1 || rc=$?
}

# script [--select V,V,...] [PARAMETER=VALUE]...: a filter script; each further one runs after those before it
script() { "$make_filter_script" "$@" > "$(printf '%03d.mlx' "$(find . -name '*.mlx' | wc -l)")"; }

# filter NAME 'PARAMETERS': a filter script of one stock filter
filter() {
  echo "<!DOCTYPE FilterScript><FilterScript><filter name=\"$1\">$2</filter></FilterScript>" \
    > "$(printf '%03d.mlx' "$(find . -name '*.mlx' | wc -l)")"
}

expect_success() {
  [ "$rc" -eq 0 ] || fail "meshlabserver returned $rc"
  [ -s out.ply ] || fail "no mesh was saved"
}

# expect_refusal TEXT: one line that says so, and no output of any kind
expect_refusal() {
  [ "$rc" -eq 255 ] || fail "meshlabserver returned $rc instead of 255"
  grep -q "Problem with filter: Intrinsic Symmetry" log || fail "it was not our filter that refused"
  grep -Eq -- "$1" log || fail "the message does not say: $1"
  [ ! -e out.ply ] || fail "a mesh was saved"
  [ -z "$(find . -name 'partners*')" ] || fail "partners were exported"
}

vertices() { awk 'NR == 2 { print $1 }' "$1"; }

# table FILE: the vertex lines of an ASCII PLY
table() { awk '/^element vertex/ { n = $3 } /^end_header/ { on = 1; next } on && seen++ < n' "$1"; }

# expect_csv MESH: contract of the CSV
expect_csv() {
  [ -s partners.csv ] || fail "no partners were exported"
  awk -F, -v n="$(vertices "$1")" '
    NR == 1 { if ($0 != "vertex,partner,fitness,side") exit bad = 1; next }
    NF != 4 || $1 != NR - 2 || $2 < -1 || $2 >= n || $3 < 0 || ($4 != -1 && $4 != 0 && $4 != 1) { exit bad = 1 }
    END { exit bad || NR != n + 1 }' partners.csv || fail "partners.csv is not as promised"
}

# Saves as ASCII with quality, colour and flags.
ascii=(-m vq vc vf sa)

case $case in
  selection)
    script --select "$refs" export_to=partners.csv
    serve "$sample" "${ascii[@]}"
    expect_success
    expect_csv "$sample"
    grep -Eq "References: ($a0,$a1|$a1,$a0),($l:$r|$r:$l)" log || fail "the roles of the selected vertices are wrong"
    grep -q "vertices matched" log || fail "no summary in the log"
    # x y z flags quality rgba, or in another order: find the columns by name
    awk '/^property/ && !/list/ { c[$3] = ++k } /^element face/ { exit }
         END { print c["flags"], c["quality"], c["red"], c["blue"] }' out.ply > columns
    read -r flags quality red blue < columns
    table out.ply | awk -v f="$flags" -v q="$quality" '{ print int($f / 32) % 2, $q }' > saved
    awk '$1 { print NR - 1 }' saved | sort > selected
    printf '%s\n' "$a0" "$a1" "$l" "$r" | sort | cmp -s - selected || fail "the selection was changed"
    tail -n +2 partners.csv | cut -d, -f3 | paste - saved | awk '{ d = $1 - $3; if (d < 0) d = -d }
      d > 1e-5 * (1 + $1) { exit 1 }' || fail "the quality is not the fitness"
    # The best vertex is blue, the worst is not.
    table out.ply | sort -g -k"$quality,$quality" | awk -v r="$red" -v b="$blue" '
      NR == 1 { if ($r != 0 || $b != 255) bad = 1 } { last = $b } END { exit bad || last == 255 }' ||
      fail "the colours do not follow the quality"
    ;;
  accuracy | automatic)
    if [ "$case" = accuracy ]; then script --select "$refs" export_to=partners.csv
    else script automatic=true export_to=partners.csv; fi
    serve "$sample"
    expect_success
    "$tool" score "$sample" "${sample%.off}.truth" partners.csv > score
    # 0.9 of the vertices near their partner: a front-back swap or a swap of the legs alone would be far below.
    awk '{ exit !($4 >= 0.9 && $6 == 1) }' score || fail "the partners are wrong: $(cat score)"
    ;;
  tool)
    # Coordinates in single precision, so that MeshLab and the tool read the same numbers.
    filter "Conditional Vertex Selection" '<Param type="RichString" name="condSelect" value="vi == 0"/>'
    serve "$sample"
    expect_success
    mv out.ply single.ply
    rm ./*.mlx
    for method in 0 1; do
      script "references=$refs" method=$method export_to=partners$method.csv
      "$tool" find single.ply --refs "$refs" --method $([ $method = 0 ] && echo joint || echo pairs) -o tool$method.csv
    done
    serve single.ply
    expect_success
    for method in 0 1; do
      cmp partners$method.csv tool$method.csv || fail "the filter and the tool differ for method $method"
    done
    ;;
  references)
    script --select "0,1,2" "references=$refs" export_to=partners.csv
    serve "$sample"
    expect_success
    expect_csv "$sample"
    grep -q "References: $a0,$a1,$l:$r" log || fail "the text did not rule over the selection"
    ;;
  attributes)
    script --select "$refs" export_to=partners.csv
    script export_to=partners.csv "references=$refs"  # attributes of a former run are replaced
    # The first use of a function filter in a process may read new attributes wrongly (a fault of 2020.09).
    for _ in 1 2; do
      filter "Per Vertex Quality Function" '<Param type="RichString" name="q" value="symmetry_partner*10+symmetry_side"/>
        <Param type="RichBool" name="normalize" value="false"/><Param type="RichBool" name="map" value="false"/>
        <Param type="RichBool" name="onselected" value="false"/>'
    done
    serve "$sample" -m vq sa
    expect_success
    tail -n +2 partners.csv | awk -F, '{ print $2 * 10 + $4 }' > expected
    table out.ply | awk '{ print $NF + 0 }' | cmp -s - expected || fail "the attributes are not what was exported"
    ;;
  export)
    for ending in json ply; do script "references=$refs" export_to=partners.$ending; done
    serve "$sample"
    expect_success
    [ -s partners.json ] && [ -s partners.ply ] || fail "partners were not exported"
    ;;
  same)
    for threads in 1 2; do script "references=$refs" threads=$threads export_to=partners$threads.csv; done
    serve "$sample"
    expect_success
    cmp partners1.csv partners2.csv || fail "the number of threads changed the result"
    ;;
  open)
    filter "Conditional Face Selection" '<Param type="RichString" name="condSelect" value="fi &lt; 20"/>'
    filter "Delete Selected Faces" ''
    script "references=$refs" export_to=partners.csv
    serve "$sample"
    expect_success
    expect_csv "$sample"
    ;;
  none | three | five)
    case $case in none) select= count=0 ;; three) select=$a0,$a1,$l count=3 ;; five) select=$refs,0 count=5 ;; esac
    script ${select:+--select "$select"} export_to=partners.csv
    serve "$sample"
    expect_refusal "select exactly four vertices.* $count are selected"
    ;;
  components | largest)
    awk 'NR == 1 { print } NR == 2 { n = $1; m = $2; print 2 * n, 2 * m, 0 }
         NR > 2 && NR <= 2 + n { v[NR - 2] = $0; print }
         NR > 2 + n && NF { f[++k] = $0 }
         END { for (i = 1; i <= n; ++i) { split(v[i], p, " "); print p[1] + 1000, p[2], p[3] }
               for (i = 1; i <= k; ++i) print f[i]
               for (i = 1; i <= k; ++i) { split(f[i], p, " "); print 3, p[2] + n, p[3] + n, p[4] + n } }' \
      "$sample" > two.off
    if [ "$case" = components ]; then
      script "references=$refs" export_to=partners.csv
      serve two.off
      expect_refusal "component"
    else
      script "references=$refs" export_to=partners.csv largest_component=true
      serve two.off
      expect_success
      expect_csv two.off
      [ "$(grep -c -- ',-1,.*,0$' partners.csv)" -ge "$(vertices "$sample")" ] || fail "the other component has partners"
    fi
    ;;
  empty)
    printf 'OFF\n0 0 0\n' > empty.off
    script automatic=true export_to=partners.csv
    serve empty.off
    expect_refusal "empty"
    ;;
  no_mesh)
    script automatic=true export_to=partners.csv
    rc=0
    xvfb-run -a "$meshlabserver" -o out.ply -s 000.mlx >log 2>&1 || rc=$?
    expect_refusal "there is no mesh"
    ;;
  points)
    printf 'ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n' \
      > points.ply
    printf '0 0 0\n1 0 0\n' >> points.ply
    script automatic=true export_to=partners.csv
    serve points.ply
    expect_refusal "no faces"
    ;;
  nan)
    filter "Per Vertex Geometric Function" '<Param type="RichString" name="x" value="vi == 5 ? 0/0 : x"/>
      <Param type="RichString" name="y" value="y"/><Param type="RichString" name="z" value="z"/>
      <Param type="RichBool" name="onselected" value="false"/>'
    script "references=$refs" export_to=partners.csv
    serve "$sample"
    expect_refusal "not finite"
    ;;
  range)
    script "references=0,1,2,$(vertices "$sample")" export_to=partners.csv
    serve "$sample"
    expect_refusal "$(vertices "$sample")"
    ;;
  option)
    script "references=$refs" joint_samples=-1 export_to=partners.csv
    serve "$sample"
    expect_refusal "samples.*-1"
    ;;
  weights)
    script "references=$refs" joint_weights=1,2,3 export_to=partners.csv
    serve "$sample"
    expect_refusal "weights must be six numbers.*got 1,2,3"
    ;;
  unwritable)
    script "references=$refs" export_to=nowhere/partners.csv
    serve "$sample"
    expect_refusal "nowhere/partners.csv"
    ;;
  ending)
    script "references=$refs" export_to=partners.xyz
    serve "$sample"
    expect_refusal "partners.xyz"
    ;;
  scripts)
    # The filter scripts beside the samples are what make_filter_script prints today.
    for given in "$(dirname "$sample")"/*.mlx; do
      read -r a0 a1 l r < "${given%.mlx}.refs"
      # A selection has no order, so it cannot say which way round a rotation goes.
      case $given in
        */trefoil* | */pinwheel*) "$make_filter_script" "references=$a0,$a1,$l,$r" symmetry=1 ;;
        *) "$make_filter_script" --select "$a0,$a1,$l,$r" ;;
      esac > now.mlx
      cmp "$given" now.mlx || { echo "$given is out of date"; touch stale; }
    done
    [ ! -e stale ] || exit 1
    ;;
  *)
    echo "no such case: $case"
    exit 2
    ;;
esac
