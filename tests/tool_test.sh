#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# tool_test.sh TOOL: the command line tool's exit codes, outputs and messages.
set -uo pipefail
tool=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0

fail() {
  echo "FAILED: $*"
  [[ -s err ]] && sed 's/^/    stderr: /' err
  failures=$((failures + 1))
}
# expect STATUS ARGUMENT...: runs the tool, its output in out and err.
expect() {
  local wanted=$1 status
  shift
  "$tool" "$@" >out 2>err </dev/null
  status=$?
  [[ $status == "$wanted" ]] || fail "ga_symmetry $*: exit $status instead of $wanted"
}
says() { grep -q -- "$1" "${2:-err}" || fail "\"$1\" is not in ${2:-err}"; }
one_line() { [[ $(wc -l <err) == 1 ]] || fail "the message is not one line"; }
no_file() { for f in "$@"; do [[ ! -e $f ]] || fail "$f was written"; done; }

# body RINGS SEGMENTS [SHIFT]: a sphere with a head, a foot and two arms, mirrored in x, as vertices and faces.
body() {
  awk -v n="$1" -v m="$2" -v at="${3:-0}" 'function bump(a, b, c, h) {
      return h * exp(15 * ((a*x + b*y + c*z) / sqrt(a*a + b*b + c*c) - 1)) }
    function put(s, t, u, r) { x = s; y = t; z = u
      r = 1 + bump(0,0,1,1) + bump(0,-.5,-3,2) + bump(2,0,.6,1.1) + bump(-2,0,.6,1.1)
      printf "v %.9g %.9g %.9g\n", x*r + at, y*r, z*r }
    BEGIN { pi = atan2(0, -1)
      for (i = 1; i <= n; ++i) for (j = 0; j < m; ++j) { p = pi*i/(n+1); q = 2*pi*j/m
        put(sin(p)*cos(q), sin(p)*sin(q), cos(p)) }
      put(0, 0, 1); put(0, 0, -1)
      for (j = 0; j < m; ++j) { k = (j+1) % m
        print "f", n*m, j, k; print "f", n*m+1, (n-1)*m+k, (n-1)*m+j
        for (i = 0; i < n-1; ++i) { a = i*m+j; b = i*m+k
          print "f", a, a+m, b+m; print "f", a, b+m, b } } }'
}
to_off() {
  awk '$1 == "v" {v[nv++] = $2 " " $3 " " $4} $1 == "f" {f[nf++] = "3 " $2 " " $3 " " $4}
    END {print "OFF"; print nv, nf, 0; for (i = 0; i < nv; ++i) print v[i]; for (i = 0; i < nf; ++i) print f[i]}'
}
rings=24 segments=32 vertices=$((24 * 32 + 2))
body $rings $segments | to_off >body.off
head=$((rings * segments)) foot=$((rings * segments + 1))
left=$((8 * segments)) right=$((8 * segments + segments / 2))
refs=$head,$foot,$left,$right
# Fewer than the defaults: this is a test of the tool, not of the search.
quick=(--joint-samples 30 --joint-population 10 --joint-generations 3)

expect 0 --help
says "find" out
expect 0 find --help
says "Examples" out
says "--refs" out
expect 0 score --help
expect 0 --version
grep -Eq '^ga_symmetry [0-9]+\.[0-9]+\.[0-9]+$' out || fail "no version"

expect 2
expect 2 seek body.off
expect 2 find
expect 2 find body.off --no-such-option
expect 2 find body.off --method slow
says "must be joint or pairs"
expect 2 find body.off --fitness cubic
expect 2 find body.off --symmetry glide
expect 2 find body.off --seed -1
expect 2 find body.off --seed x
expect 2 find body.off --threads -1
expect 2 find body.off --threads 1000
expect 2 find body.off --refs 1,2,3
one_line
expect 2 find body.off --refs 1,2,3,x
expect 2 find body.off --refs "$head,$foot,$left,$vertices" -o a.csv
one_line
expect 2 find body.off -o a.txt
says "must end in .csv, .json or .ply"
expect 2 find body.off --method pairs -o a.csv
# What would do nothing is refused where it is given, be it the default.
for option in "--rank 2" "--joint-samples 100" "--proxy off" --no-noise-filter; do
  expect 2 find body.off --method pairs --refs "$refs" $option -o a.csv
  says "${option% *}: does nothing with the method pairs"
  one_line
done
expect 2 find body.off --fitness linear -o a.csv
says "--fitness: does nothing with the method joint"
expect 2 find body.off --joint-reference-weight 2 -o a.csv
says "--joint-reference-weight: does nothing without references"
for option in "--symmetry rotation" "--rank 2" "--method pairs"; do
  expect 2 find body.off --list $option
  says "${option% *}: does nothing when symmetries are listed"
done
expect 2 find body.off --list --redo
expect 2 find body.off --rank 31
says "--rank: must be a whole number, 1 to 30, got"
expect 2 find body.off --joint-samples 400 -o a.csv
says "joint_sites must be at least joint_samples"
expect 2 score body.off
no_file a.csv a.txt

expect 1 find missing.off -o a.csv
one_line
says "missing.off"
printf 'OFF\n4 4 0\n0 0 0\n' >cut.off
expect 1 find cut.off -o a.csv
one_line
says "cut.off"
: >empty.ply
expect 1 find empty.ply -o a.csv
says "empty"
printf 'OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n' >points.off
expect 1 find points.off -o a.csv
one_line
expect 1 find body.off -o good.csv -o missing/a.csv
one_line
says "no folder"
no_file a.csv good.csv

{ body 12 16; body 12 16 10 | awk '$1 == "f" {print "f", $2+194, $3+194, $4+194; next} 1'; } | to_off >two.off
expect 0 find two.off "${quick[@]}" -o parts.csv
[[ $(wc -l <parts.csv) == 389 ]] || fail "parts.csv has not a row for every vertex"
! grep -q ',-1,' parts.csv || fail "a vertex of some part has no partner"
expect 0 find two.off "${quick[@]}"
says "surface .*wrapped 2 parts" out
expect 0 find two.off "${quick[@]}" --largest-component -o two.csv
says "warning: .*largest"
[[ $(wc -l <two.csv) == 389 ]] || fail "two.csv has not a row for every vertex"
expect 0 find two.off "${quick[@]}" --largest-component --quiet -o two.csv
[[ ! -s err ]] || fail "--quiet is not quiet"

echo old >kept.csv
expect 1 find points.off -o kept.csv
[[ $(cat kept.csv) == old ]] || fail "a failed run changed an existing file"

expect 0 find body.off --refs "$refs" "${quick[@]}"
for word in symmetry references pairs matched "mean fitness" generations seconds; do says "^$word" out; done
[[ ! -s err ]] || fail "something on stderr that is not a terminal"
expect 0 find body.off "${quick[@]}"
says "^symmetry *reflection" out

expect 0 find body.off --refs "$refs" "${quick[@]}" -o a.csv -o a.json -o a.ply
[[ ! -s out ]] || fail "a summary although files were asked for"
[[ $(head -n1 a.csv) == vertex,partner,fitness,side ]] || fail "wrong header of the CSV"
[[ $(wc -l <a.csv) == $((vertices + 1)) ]] || fail "the CSV has not a row for every vertex"
awk -F, 'NR > 1 && ($1 != NR-2 || $2 < -1 || $3 < 0 || $4 < -1 || $4 > 1 || NF != 4) {exit 1}' a.csv ||
  fail "a row of the CSV breaks the contract"
[[ $(head -n1 a.ply) == ply ]] || fail "no PLY"
expect 0 find a.ply --refs "$refs" "${quick[@]}" -o again.csv
expect 0 find body.off --refs "$refs" "${quick[@]}" --threads 1 -o b.csv -o b.json -o b.ply
expect 0 find body.off --refs "$refs" "${quick[@]}" --threads 2 -o c.csv -o c.json -o c.ply
expect 0 find body.off --refs "$head $foot, $left $right" "${quick[@]}" -o blanks.csv
cmp -s a.csv blanks.csv || fail "references with blanks give other bytes"
for ending in csv json ply; do
  cmp -s a.$ending b.$ending && cmp -s a.$ending c.$ending || fail "the same seed gives other bytes: $ending"
done
for fitness in squared linear; do
  expect 0 find body.off --refs "$refs" --method pairs --fitness $fitness --pairs-samples 100 -o pairs.csv
done

# The mirror image of ring i, segment j is segment m/2 - j.
awk -v n=$rings -v m=$segments 'BEGIN {for (i = 0; i < n; ++i) for (j = 0; j < m; ++j)
  print i*m+j, i*m + (m + m/2 - j) % m; print n*m, n*m; print n*m+1, n*m+1}' >truth
{ echo vertex,partner; tr ' ' , <truth; } >truth.csv
expect 0 score body.off truth truth.csv
says "^mean 0.0000 corr 1.0000 coverage 1.0000 involution 1.0000 lines $vertices\$" out
expect 0 score body.off truth a.csv
says "coverage" out
expect 1 score body.off missing truth.csv
expect 1 score body.off truth two.csv
one_line

# What stands on a result.
expect 0 find body.off --refs "$refs" "${quick[@]}" --summary json -o a.csv
python3 -c 'import json; s = json.load(open("out")); assert s["kind"] == "reflection" and s["matched"] > 0 and s["seconds"]' ||
  fail "no JSON summary"
expect 0 find body.off --refs "$refs" "${quick[@]}" --summary text -o a.csv
says "^mean fitness" out
expect 2 find body.off --summary yaml
{ echo vertex,partner,fitness,side
  awk -v head=$head -v foot=$foot '{ print $1 "," $2 ",0.01," ($1 == $2 ? 0 : $1 < $2 ? 1 : -1) }' truth; } >known.csv
# A side is a side of the body: left is where x > 0.
awk -F'[ ,]' 'NR == FNR { if (FNR > 2 && FNR <= 772) x[FNR - 3] = $1; next }
  FNR > 1 { $4 = x[$1] > 1e-9 ? 1 : x[$1] < -1e-9 ? -1 : 0 } { print }' OFS=, body.off known.csv >sided.csv
mv sided.csv known.csv
expect 0 pairs body.off known.csv --count 20
[[ $(head -n1 out) == vertex,partner,fitness && $(wc -l <out) == 21 ]] || fail "not 20 pairs"
awk -F, 'NR == FNR { if (FNR > 1) { p[$1] = $2; s[$1] = $4 } next } FNR > 1 && (p[$1] != $2 || s[$1] != 1) { exit 1 }' \
  known.csv out || fail "a pair that is none"
expect 0 pairs body.off known.csv --count 20 -o links.ply
grep -q "^element edge 20$" links.ply || fail "not 20 links"
expect 0 axis body.off known.csv
[[ $(head -n1 out) == line,x,y,z,fitness ]] || fail "wrong header of the axis"
awk -F, 'NR > 1 { sum += $2 < 0 ? -$2 : $2; ++n; last = $2 "," $3 "," $4 } NR == 2 { first = last }
  END { exit !(n > 50 && sum / n < 0.05 && first == last) }' out || fail "the axis is not where x = 0, or is not closed"
expect 0 axis body.off known.csv -o axis.ply
grep -q "^element edge" axis.ply || fail "no axis lines"
expect 0 asymmetry body.off known.csv --threads 1
[[ $(wc -l <out) == $((vertices + 1)) ]] || fail "not a value for every vertex"
awk -F, 'NR > 1 { sum += $2 < 0 ? -$2 : $2 } END { print sum / (NR - 1) > "mean"; exit !(sum / (NR - 1) < 0.03) }' out || fail "a symmetric body, whose triangles are not, is asymmetric by $(cat mean)"
expect 0 asymmetry body.off known.csv --measure curvature --radius 0.2 -o difference.ply
expect 2 asymmetry body.off known.csv --radius 0
one_line
expect 0 samples body.off --count 30
[[ $(awk -F, '$1 == $3' out | wc -l) == 30 && $(wc -l <out) == $((vertices + 1)) ]] || fail "not 30 samples"
expect 0 samples body.off -o patches.ply
expect 2 samples body.off --count 100000
expect 2 samples body.off -o patches.xyz
one_line
{ echo arm,vertex,leg; for ((v = 0; v < vertices; ++v)); do echo $v,$v,0.5; done; } >weights.csv
expect 0 mirror body.off known.csv weights.csv -o mirrored.csv
says "vertices changed, 0 kept"
awk -F, 'NR == FNR { if (FNR > 1) { p[$1] = $2; s[$1] = $4 } next } FNR == 1 { if ($0 != "vertex,arm,leg") exit 1; next }
  $2 != (s[$1] == -1 ? p[$1] : $1) || $3 != 0.5 { exit 1 }' known.csv mirrored.csv || fail "weights are not the partners'"
expect 0 mirror body.off known.csv mirrored.csv --direction swap -o again.csv
cmp -s mirrored.csv again.csv || fail "mirrored weights are not symmetric"
# Sculpted shape: x and y of one side's vertices grow by a tenth, and so do those of the other.
awk -F, 'NR > 1 { print $1, $4 }' known.csv > sides
awk 'FILENAME == "sides" { side[$1] = $2; next } FNR <= 2 { if (FNR == 2) n = $1; print; next }
  FNR <= n + 2 && side[FNR - 3] == 1 { print 1.1 * $1, 1.1 * $2, $3; next } { print }' sides body.off > sculpted.off
expect 0 mirror body.off known.csv sculpted.off -o both.ply
awk 'FILENAME == "both.ply" { if (body && k < n) { x[k] = $1; y[k] = $2; ++k } if ($2 == "vertex") n = $3
    if (/^end_header/) body = 1; next }
  FILENAME == "sides" { side[$1] = $2; next }
  FNR > 2 && FNR <= n + 2 && side[FNR - 3] == -1 { off += sqrt((x[FNR-3] - 1.1*$1)^2 + (y[FNR-3] - 1.1*$2)^2)
    size += 0.1 * sqrt($1^2 + $2^2) } END { exit !(size > 0 && off < 0.1 * size) }' both.ply sides body.off ||
  fail "what was sculpted on one side is not on the other"
expect 2 mirror body.off known.csv sculpted.off -o a.csv
expect 2 mirror body.off known.csv sculpted.off
expect 1 mirror body.off known.csv other.off -o a.ply
expect 2 mirror body.off known.csv weights.csv --direction up
expect 2 mirror body.off known.csv weights.csv -o a.ply
echo vertex,w >short.csv
expect 1 mirror body.off known.csv short.csv
one_line
for command in pairs axis asymmetry; do
  expect 1 $command body.off truth.csv
  says "lacks the columns"
  expect 1 $command two.off known.csv
  one_line
  expect 0 $command --help
  says "Examples" out
done
expect 1 pairs body.off known.csv -o missing/a.csv
no_file missing/a.csv

# Many meshes: a folder, and more.
body 12 16 | to_off >small.off
mkdir scans more
cp small.off scans/b.off
cp small.off scans/a.OFF
cp cut.off scans/cut.off
echo "$((12 * 16)) $((12 * 16 + 1)) $((4 * 16)) $((4 * 16 + 8))" >more/c,1.refs
cp small.off "more/c,1.off"
echo notes >scans/notes.txt
expect 2 find scans
expect 2 find scans -o a.csv
one_line
expect 2 find small.off body.off -o a.csv -o b.csv
expect 2 find scans -o results --summary json
expect 2 find scans -o results --format xyz
expect 2 find scans -o results --threads 1000
says "--threads: must be a whole number, 0 to 256, got"
expect 2 find scans -o results --method pairs
expect 2 find small.off -o a.csv --redo
expect 2 find small.off --format csv
expect 2 find small.off --refs 1,2,3,4 --refs-files
expect 1 find more/../missing.off -o results/missing/
no_file results/missing/missing.csv
rm -r results
mkdir nothing
expect 1 find nothing -o results
says "no mesh in nothing"
expect 2 find scans more small.off scans/b.off -o results
says "scans/b.off and scans/b.off"
cp small.off more/b.ply
expect 2 find scans more -o results
says "scans/b.off and more/b.ply"
one_line
rm more/b.ply
cp a.ply more/p.ply
expect 2 find more -o more --format csv,ply
says "would be overwritten"
rm more/p.ply
cp small.off more/summary.off
expect 2 find more -o results
says "rename it"
rm more/summary.off
expect 1 find small.off more -o body.off/results
one_line
no_file results more/c,1.csv

rows() { cut -d, -f"$1" "${2:-results/summary.csv}" | paste -sd' '; }
expect 1 find scans "${quick[@]}" -o results
[[ $(ls results | paste -sd' ') == "a.csv b.csv summary.csv" ]] || fail "not the outputs of the two good meshes"
[[ $(rows 1,2) == "mesh,status a,done b,done cut,failed" ]] || fail "the summary has $(rows 1,2)"
[[ $(rows 3) == "vertices 194 194 " ]] || fail "the summary has the vertices $(rows 3)"
says "1 of 3 meshes failed"
says "^ga_symmetry: cut: cannot read scans/cut.off" 
says "^2 done, 0 skipped, 1 failed: results/summary.csv" out
expect 0 find small.off "${quick[@]}" -o alone.csv
cmp -s alone.csv results/a.csv || fail "a mesh among others gives other bytes"
# Finished ones are left alone, and their rows.
cp results/summary.csv before.csv
echo kept >results/a.csv
cp small.off scans/cut.off
expect 0 find scans "${quick[@]}" -o results/
[[ $(cat results/a.csv) == kept ]] || fail "a finished mesh was done again"
[[ $(rows 1,2) == "mesh,status a,done b,done cut,done" ]] || fail "after a resume the summary has $(rows 1,2)"
diff before.csv results/summary.csv | grep -q ',[ab],' && fail "rows of finished meshes changed"
says "^1 done, 2 skipped, 0 failed" out
expect 0 find scans "${quick[@]}" -o results --redo --quiet
cmp -s alone.csv results/a.csv || fail "--redo does not do it again"
[[ ! -s out && ! -s err ]] || fail "--quiet is not quiet"
rm results/summary.csv
expect 0 find scans "${quick[@]}" -o results
[[ $(rows 1,2) == "mesh,status a,skipped b,skipped cut,skipped" ]] || fail "without a summary: $(rows 1,2)"
# References beside the mesh, other formats, rows of earlier runs kept, a comma in a name.
expect 0 find more --refs-files --method pairs --pairs-samples 50 --format csv,json --format ply -o results
for ending in csv json ply; do [[ -s results/c,1.$ending ]] || fail "no .$ending"; done
[[ $(python3 -c 'import csv; print([r[:2] for r in csv.reader(open("results/summary.csv"))][1:])') == \
  "[['c,1', 'done'], ['a', 'skipped'], ['b', 'skipped'], ['cut', 'skipped']]" ]] || fail "the summary is no CSV of all"
expect 0 find "more/c,1.off" --refs-files --method pairs --pairs-samples 50 -o beside.csv
cmp -s beside.csv results/c,1.csv || fail "one mesh with references beside it gives other bytes"
expect 1 find scans --refs-files -o referenced
[[ $(rows 2 referenced/summary.csv) == "status failed failed failed" ]] || fail "references that are missing are not missed"

# An interrupt ends a run at whatever stage, in one line, and leaves no half of anything.
# interrupt SECONDS ARGUMENT...
interrupt() {
  local after=$1 run status
  shift
  "$tool" "$@" >out 2>err &
  run=$!
  sleep "$after"
  # What a script starts in the background ignores the signal until it catches it.
  while kill -0 $run 2>/dev/null && ! ((0x$(awk '/^SigCgt/ { print $2 }' /proc/$run/status) & 2)); do sleep 0.01; done
  kill -INT $run
  for ((i = 0; i < 200; ++i)); do
    kill -0 $run 2>/dev/null || break
    sleep 0.1
  done
  kill -0 $run 2>/dev/null && fail "not interrupted after 20 seconds" && kill -KILL $run
  wait $run
  status=$?
  [[ $status == 130 ]] || fail "an interrupted run: exit $status instead of 130"
  one_line
  says "^ga_symmetry: interrupted"
}
body 200 300 | to_off >large.off
endless=(--joint-population 10000 --joint-generations 10000)
for after in 0.05 0.3 1; do
  interrupt $after find large.off "${endless[@]}" -o a2.csv -o a2.ply
  no_file a2.csv a2.ply
done
mkdir long
cp small.off long/a.off
cp large.off long/b.off
expect 0 find long/a.off "${quick[@]}" -o stopped/
interrupt 1 find long "${endless[@]}" -o stopped
says "after 1 of 2 meshes: the same command goes on"
[[ $(ls stopped | paste -sd' ') == "a.csv summary.csv" ]] || fail "left by an interrupted run: $(ls stopped)"

leftovers=$(find . -name '*.part')
[[ -z $leftovers ]] || fail "left behind: $leftovers"
((failures == 0)) && echo "all passed"
exit $((failures > 0))
