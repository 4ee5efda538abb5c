#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# One case of the plugin in the real meshlabserver, through a filter script.
#
#   plugin_test.sh CASE MESHLABSERVER MAKE_FILTER_SCRIPT TOOL SAMPLE
#
# TOOL     the command line tool.
# SAMPLE   NAME.off with NAME.refs and NAME.truth beside it.
# Exit 0 = passed, 1 = failed, 77 = cannot be run here.
set -euo pipefail

case=$1 meshlabserver=$2 make_filter_script=$3 tool=$4 sample=$5
on_screen=$(dirname "$(realpath "$0")")/../../scripts/on_screen
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
  "$on_screen" "$meshlabserver" -i "$mesh" -o out.ply "$@" "${scripts[@]}" >log 2>&1 || rc=$?
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
    # Where the quality is worse there is no more blue and no less red, but for rounding; all the blue to 0.05, none from
    # 0.1, no red to there, all the red from 0.15.
    table out.ply | sort -g -k"$quality,$quality" | awk -v q="$quality" -v r="$red" -v b="$blue" '
      NR > 1 && ($r < red - 2 || $b > blue + 2) { exit bad = 1 } { red = $r; blue = $b } NR == 1 { first = $r - $b }
      { wrong = ($q >= 0.15 ? $r < 253 : $q <= 0.1 ? $r > 2 : 0) || ($q <= 0.05 ? $b < 253 : $q >= 0.1 ? $b > 2 : 0) }
      wrong { exit bad = 1 }
      END { exit bad || red - blue <= first }' || fail "the colours do not follow the quality"
    ;;
  accuracy | automatic)
    if [ "$case" = accuracy ]; then script --select "$refs" export_to=partners.csv
    else script export_to=partners.csv; fi  # nothing selected, nothing given
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
    script --select "0,1,2" "references=$a0 $a1, $l $r" method=1 rank=2 export_to=partners.csv
    serve "$sample"
    expect_success
    expect_csv "$sample"
    grep -q "References: $a0,$a1,$l:$r" log || fail "the text did not rule over the selection"
    grep -q "rank does nothing with the method pairs" log || fail "an option is ignored without a word"
    ! grep -q "samples does nothing" log || fail "a default is not an option that was given"
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
  two | three | five)
    case $case in
      two) select=$a0,$a1 said="two vertices are selected: as References write [0-9]*,[0-9]* if both are on" ;;
      three) select=$a0,$a1,$l said="select four vertices.* 3 are selected" ;;
      five) select=$refs,0 said="select four vertices.* 5 are selected" ;;
    esac
    script --select "$select" export_to=partners.csv
    serve "$sample"
    expect_refusal "$said"
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
      expect_success
      expect_csv two.off
      grep -q "Surface: wrapped 2 parts" log || fail "what was done is not said"
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
    "$on_screen" "$meshlabserver" -o out.ply -s 000.mlx >log 2>&1 || rc=$?
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
  advanced)
    # As the command line's options; the weights and the population change the result, or nothing would be tested.
    filter "Conditional Vertex Selection" '<Param type="RichString" name="condSelect" value="vi == 0"/>'
    serve "$sample"
    expect_success
    mv out.ply single.ply
    rm ./*.mlx
    script "references=$refs" "advanced=joint_population=10, joint_distance_weight=0.5 joint_sites=150" export_to=partners0.csv
    script "references=$refs" method=1 "advanced=fitness=linear,pairs_mutation=0.05" export_to=partners1.csv
    script "references=$refs" export_to=partners2.csv
    serve single.ply
    expect_success
    "$tool" find single.ply --refs "$refs" --joint-population 10 --joint-distance-weight 0.5 --joint-sites 150 -o tool0.csv
    "$tool" find single.ply --refs "$refs" --method pairs --fitness linear --pairs-mutation 0.05 -o tool1.csv
    for method in 0 1; do cmp partners$method.csv tool$method.csv || fail "the advanced options are not the tool's"; done
    ! cmp -s partners0.csv partners2.csv || fail "the advanced options change nothing"
    ;;
  advanced_wrong)
    script "references=$refs" "advanced=joint_site=3" export_to=partners.csv
    serve "$sample"
    expect_refusal "advanced options must be key=value.* joint_sites, .* pairs_generations, got .joint_site=3"
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
  axis)
    script "references=$refs" generate_polyline_from_intrinsic_symmetry pairs=30
    serve "$sample" -m sa -o links.ply -l 1 -m vq vc sa -o axis.ply -l x -m vq vc sa
    expect_success
    [ "$(table links.ply | wc -l)" = 60 ] || fail "the links of 30 pairs have not 60 ends"
    # Every end is a vertex of the mesh.
    table out.ply | awk '{ print $1, $2, $3 }' | sort -u > vertices
    table links.ply | awk '{ print $1, $2, $3 }' | sort -u | comm -23 - vertices | grep -q . && fail "a link ends nowhere"
    grep -q "an axis of 1 line " log || fail "the axis is not one line: $(grep 'an axis of' log | head -n 1)"
    table axis.ply > axis
    # Points of the true axis: between vertices that are their own partners, or nearly.
    awk 'FILENAME == ARGV[1] && FNR == 2 { n = $1; next }
         FILENAME == ARGV[1] && FNR > 2 && FNR <= 2 + n { x[FNR - 3] = $1; y[FNR - 3] = $2; z[FNR - 3] = $3; next }
         FILENAME == ARGV[1] && FNR > 2 + n && NF {
           u1 = x[$3]-x[$2]; u2 = y[$3]-y[$2]; u3 = z[$3]-z[$2]; v1 = x[$4]-x[$2]; v2 = y[$4]-y[$2]; v3 = z[$4]-z[$2]
           area += sqrt((u2*v3-u3*v2)^2 + (u3*v1-u1*v3)^2 + (u1*v2-u2*v1)^2) / 2; next }
         FILENAME == ARGV[2] { d2 = (x[$1]-x[$2])^2 + (y[$1]-y[$2])^2 + (z[$1]-z[$2])^2
           if (d2 < area / n) { a[k] = (x[$1]+x[$2])/2; b[k] = (y[$1]+y[$2])/2; c[k++] = (z[$1]+z[$2])/2 } next }
         FILENAME == ARGV[3] { best = 1e30
           for (i = 0; i < k; ++i) { d2 = (a[i]-$1)^2 + (b[i]-$2)^2 + (c[i]-$3)^2; if (d2 < best) best = d2 }
           sum += sqrt(best); ++points }
         END { printf "%.4f %d\n", sum / points / sqrt(area), points }' "$sample" "${sample%.off}.truth" axis > error
    echo "axis: mean distance to the true one over sqrt(area), and points: $(cat error)"
    awk '{ exit !($1 <= 0.03 && $2 > 50) }' error || fail "the axis is wrong: $(cat error)"
    ;;
  mirror)
    # Each vertex' number as its colour; after mirroring, that of the vertex whose colour it took.
    script "references=$refs" export_to=partners.csv
    filter "Per Vertex Color Function" '<Param type="RichString" name="x" value="vi-256*rint(vi/256-0.498)"/>
      <Param type="RichString" name="y" value="rint(vi/256-0.498)"/><Param type="RichString" name="z" value="7"/>
      <Param type="RichString" name="a" value="255"/><Param type="RichBool" name="onselected" value="false"/>'
    script transfer_attributes_across_intrinsic_symmetry attribute=1 direction=0
    serve "$sample" -m vc sa
    expect_success
    table out.ply | awk '{ print $4 + 256 * $5 }' > taken
    tail -n +2 partners.csv | paste -d, - taken | awk -F, '
      { right[$1] = $4 == -1; partner[$1] = $2; taken[$1] = $5 }
      END { for (v in partner) if (taken[v] != v && !(right[v] && taken[v] == partner[v] && !right[partner[v]])) exit 1 }' ||
      fail "a colour was not taken from the partner on the left"
    # As right as the map itself: of the right vertices that were changed, nearly all took a colour from near the truth.
    { echo vertex,partner; awk '{ print NR - 1 "," $1 }' taken; } > taken.csv
    tail -n +2 partners.csv | paste -d, - taken | awk -F, '$5 != $1 { print $1 }' > changed
    awk 'NR == FNR { c[$1]; next } $1 in c' changed "${sample%.off}.truth" > changed.truth
    "$tool" score "$sample" changed.truth taken.csv > mirrored
    "$tool" score "$sample" changed.truth partners.csv > map
    echo "mirrored colours: $(cat mirrored)"
    [ "$(cut -d' ' -f1-4 mirrored)" = "$(cut -d' ' -f1-4 map)" ] || fail "mirrored: $(cat mirrored); the map: $(cat map)"
    awk '{ exit !($4 >= 0.9) }' mirrored || fail "the colours are not from the true partners: $(cat mirrored)"
    grep -q "Mirrored: $(wc -l < changed) vertices changed" log || fail "changed vertices are not counted"
    ;;
  mirror_selection | mirror_quality | mirror_custom)
    script "references=$refs" export_to=partners.csv
    case $case in
      mirror_selection)
        filter "Conditional Vertex Selection" '<Param type="RichString" name="condSelect" value="vi &lt; 300"/>'
        script transfer_attributes_across_intrinsic_symmetry attribute=0 direction=2
        ;;
      mirror_quality)
        filter "Per Vertex Quality Function" '<Param type="RichString" name="q" value="vi"/>
          <Param type="RichBool" name="normalize" value="false"/><Param type="RichBool" name="map" value="false"/>
          <Param type="RichBool" name="onselected" value="false"/>'
        script transfer_attributes_across_intrinsic_symmetry attribute=2 direction=3
        ;;
      mirror_custom)
        filter "Define New Per Vertex Attribute" '<Param type="RichString" name="name" value="weight"/>
          <Param type="RichString" name="expr" value="vi"/>'
        script transfer_attributes_across_intrinsic_symmetry attribute=3 custom_attribute=weight direction=1
        for _ in 1 2; do  # see below, attributes
          filter "Per Vertex Quality Function" '<Param type="RichString" name="q" value="weight"/>
            <Param type="RichBool" name="normalize" value="false"/><Param type="RichBool" name="map" value="false"/>
            <Param type="RichBool" name="onselected" value="false"/>'
        done
        ;;
    esac
    serve "$sample" -m vf vq sa
    expect_success
    awk '/^property/ && !/list/ { c[$3] = ++k } /^element face/ { exit } END { print c["flags"], c["quality"] }' out.ply > columns
    read -r flags quality < columns
    table out.ply | awk -v f="$flags" -v q="$quality" '{ print int($f / 32) % 2 "," $q + 0 }' > saved
    tail -n +2 partners.csv | paste -d, - saved | awk -F, -v case="$case" '
      { partner[NR - 1] = $2; side[NR - 1] = $4; selected[NR - 1] = $5; value[NR - 1] = $6 }
      END { for (v = 0; v < NR; ++v) { p = partner[v]
              if (case == "mirror_selection" && selected[v] != (p < 0 ? v < 300 : p < 300)) exit 1
              if (case == "mirror_quality" && value[v] != (p < 0 ? v : (v + p) / 2)) exit 1
              if (case == "mirror_custom" && value[v] != (side[v] == 1 && p >= 0 && side[p] != 1 ? p : v)) exit 1 } }' ||
      fail "the values are not those of the partners"
    ;;
  sculpt)
    # A second layer, the same mesh with a swollen left; what the filter makes of it is what the tool makes of it.
    filter "Conditional Vertex Selection" '<Param type="RichString" name="condSelect" value="vi == 0"/>'
    serve "$sample" -m sa
    expect_success
    mv out.ply before.ply
    rm ./*.mlx
    "$tool" find before.ply --refs "$refs" -o known.csv
    awk -v l="$l" 'BEGIN { k = 0 } !body { print; if ($2 == "vertex") n = $3; body = $1 == "end_header"; next }
      k < n { x[k] = $1; y[k] = $2; z[k] = $3; $1 = $2 = $3 = ""; rest[k++] = $0; if (k < n) next
        for (v = 0; v < n; ++v) {
          t = ((x[v]-x[l])^2 + (y[v]-y[l])^2 + (z[v]-z[l])^2) / 400; s = t < 1 ? 1 + 0.2 * (1 - t)^2 : 1
          printf "%.9g %.9g %.9g%s\n", x[l] + s*(x[v]-x[l]), y[l] + s*(y[v]-y[l]), z[l] + s*(z[v]-z[l]), rest[v] }
        next } { print }' before.ply > after.ply
    "$tool" mirror before.ply known.csv after.ply -o wanted.ply
    # The partners are read into the current layer, the last one; the original has none.
    script load_partners_of_intrinsic_symmetry partners_file=known.csv transfer_sculpt_across_intrinsic_symmetry before=0
    "$on_screen" "$meshlabserver" -i before.ply after.ply -o out.ply -l x -m sa -s 000.mlx > log 2>&1 || fail "meshlabserver failed"
    grep -q "Mirrored the sculpted shape: [1-9]" log || fail "nothing was mirrored"
    for file in before out wanted; do table $file.ply | awk '{ print $1, $2, $3 }' > $file; done
    paste -d' ' out wanted before | awk '{ d = ($1-$4)^2 + ($2-$5)^2 + ($3-$6)^2; if (d > 1e-6) exit 1
      moved += ($4-$7)^2 + ($5-$8)^2 + ($6-$9)^2 > 1 } END { exit !moved }' || fail "the filter and the tool differ"
    rm out.ply 000.mlx
    script load_partners_of_intrinsic_symmetry partners_file=known.csv transfer_sculpt_across_intrinsic_symmetry before=1
    "$on_screen" "$meshlabserver" -i before.ply after.ply -o out.ply -l x -m sa -s 000.mlx > log 2>&1 && fail "its own original"
    grep -q "the layer before sculpting is missing" log || fail "no word about the layer that was chosen"
    ;;
  mirror_nothing)
    script "references=$refs"
    script transfer_attributes_across_intrinsic_symmetry attribute=3 custom_attribute=weight
    serve "$sample"
    expect_refusal "no scalar attribute named .weight"
    ;;
  asymmetry)
    # A hump bends the surface more than it enlarges it.
    case $sample in *hump.off) measure=2 ;; *) measure=0 ;; esac
    script "references=$refs" export_to=partners.csv compute_asymmetry_per_vertex measure=$measure
    serve "$sample" -m vq vc sa
    expect_success
    grep -q "Asymmetry: -" log || fail "no negative values in the log"
    awk '/^property/ && !/list/ { c[$3] = ++k } /^element face/ { exit } END { print c["quality"], c["red"], c["blue"] }' \
      out.ply > columns
    read -r quality red blue < columns
    table out.ply | awk -v q="$quality" -v r="$red" -v b="$blue" '
      $q > 0 && $b > $r || $q < 0 && $r > $b { exit 1 }' || fail "the colours do not follow the sign"
    # A broken sample has a hump on the left, or no left hand: the vertices that this affects, on both sides.
    affected=${sample%.off}.affected
    if [ -f "$affected" ]; then
      table out.ply | awk -v q="$quality" '{ print $q }' | paste -d, - <(tail -n +2 partners.csv) | awk -F, '
        NR == FNR { c[$1]; next }
        $2 in c { inside += $1 * $5; ++m; next }
        { outside += $1 < 0 ? -$1 : $1; ++n }
        END { printf "%.3f %.3f\n", inside / m, outside / n }' "$affected" - > figures
      echo "asymmetry: left minus right where one side has more, mean size elsewhere: $(cat figures)"
      case $sample in *hump.off) sign=1 ;; *) sign=-1 ;; esac
      awk -v sign=$sign '{ exit !(sign * $1 > 2 * $2) }' figures || fail "it does not stand out: $(cat figures)"
    fi
    ;;
  samples)
    script generate_evenly_spaced_samples samples=40
    serve "$sample" -m vc sa -o points.ply -l x -m vc sa
    expect_success
    table out.ply | awk '{ print $1, $2, $3 }' | sort -u > vertices
    table points.ply | awk '{ print $1, $2, $3 }' | sort -u > points
    [ "$(wc -l < points)" = 40 ] || fail "not 40 different samples"
    comm -23 points vertices | grep -q . && fail "a sample is not a vertex"
    [ "$(table out.ply | awk '{ print $4, $5, $6 }' | sort -u | wc -l)" = 40 ] || fail "not 40 patches"
    ;;
  import)
    "$tool" find "$sample" --refs "$refs" -o given.csv
    script load_partners_of_intrinsic_symmetry partners_file=given.csv
    script generate_polyline_from_intrinsic_symmetry
    serve "$sample" -m vq sa
    expect_success
    tail -n +2 given.csv | cut -d, -f3 > given
    table out.ply | awk '{ print $NF }' | paste given - | awk '{ d = $1 - $2; if (d < 0) d = -d }
      d > 1e-5 * (1 + $1) { exit 1 }' || fail "the quality is not the imported fitness"
    ;;
  import_json)
    script "references=$refs" export_to=partners.json
    serve "$sample"
    expect_success
    mv partners.json given.json
    rm ./*.mlx out.ply
    script load_partners_of_intrinsic_symmetry partners_file=given.json
    serve "$sample"
    expect_success
    rm out.ply
    # One vertex moved.
    awk 'NR == 3 { $1 += 1 } { print }' "$sample" > moved.off
    serve moved.off
    expect_refusal "cannot read given.json: it is of another mesh"
    ;;
  import_other)
    # Of a mesh with as many vertices in another order: line v is that of vertex n-1-v.
    "$tool" find "$sample" --refs "$refs" -o given.csv
    { head -n 1 given.csv; tail -n +2 given.csv | tac | awk -F, -v OFS=, '{ $1 = NR - 1; print }'; } > other.csv
    script load_partners_of_intrinsic_symmetry partners_file=other.csv
    serve "$sample"
    expect_refusal "cannot use other.csv: the partners are not of this mesh"
    ;;
  import_missing)
    script load_partners_of_intrinsic_symmetry partners_file=nowhere.csv
    serve "$sample"
    expect_refusal "cannot read nowhere.csv"
    ;;
  absent)
    for name in generate_polyline_from_intrinsic_symmetry transfer_attributes_across_intrinsic_symmetry \
                compute_asymmetry_per_vertex; do
      rm -f ./*.mlx
      script $name
      serve "$sample"
      expect_refusal "this layer has no partners: run .*Find Partners"
    done
    ;;
  stale)
    script "references=$refs"
    filter "Conditional Vertex Selection" '<Param type="RichString" name="condSelect" value="vi == 100"/>'
    filter "Delete Selected Vertices" ''
    script generate_polyline_from_intrinsic_symmetry
    serve "$sample"
    expect_refusal "vertices have been removed or added since"
    ;;
  examples)
    # The example scripts run as they are, and are what make_filter_script prints today.
    here=$(dirname "$0")/../../examples/meshlabserver
    for given in "$here"/*.mlx; do
      name=$(basename "$given" .mlx)
      "$make_filter_script" --select "$refs" export_to=partners.csv "$name" \
        $([ "$name" != load_partners_of_intrinsic_symmetry ] || echo partners_file=partners.csv) > now.mlx
      cmp "$given" now.mlx || { echo "$given is out of date"; touch stale; }
      mv now.mlx 000.mlx
      serve "$sample"
      expect_success
      rm 000.mlx out.ply
    done
    [ ! -e stale ] || exit 1
    ;;
  parameters)
    "$make_filter_script" --parameters | cmp - "$(dirname "$0")/../../docs/parameters.md" ||
      { echo "docs/parameters.md is out of date: run make_filter_script --parameters"; exit 1; }
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
