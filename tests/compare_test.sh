#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# compare_test.sh TOOL SAMPLES: the report of `ga_symmetry compare`, and what it refuses.
set -uo pipefail
tool=$1 samples=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0
fail() { echo "FAILED: $*"; [[ -s err ]] && sed 's/^/    stderr: /' err; failures=$((failures + 1)); }
expect() {
  local wanted=$1 status
  shift
  "$tool" compare "$@" >out 2>err </dev/null
  status=$?
  [[ $status == "$wanted" ]] || fail "compare $*: exit $status instead of $wanted"
}
refused() {  # in one line, without a report
  expect "$@"
  [[ $(wc -l <err) == 1 ]] || fail "the message is not one line"
  [[ -z $(find . -maxdepth 1 -name 'report*') ]] || fail "a refused run left something behind"
}
mesh=$samples/person_wave_scan.off
quick=(--seeds 1 --methods naive,kdtree,pairs-squared)

# Wrong calls.
expect 2
expect 2 "$mesh"
expect 2 "$mesh" -o report --seeds x
refused 2 "$mesh" -o report --methods naive,slow
grep -q "zoomout" err || fail "the methods are not listed"
refused 2 "$mesh" -o report --methods naive,naive
refused 2 "$mesh" -o report --seeds 1,1
refused 2 "$mesh" -o report --repeats 0
refused 1 missing.off -o report
refused 1 "$mesh" "$mesh" -o missing/report
refused 2 "$mesh" "$mesh" -o report
refused 1 "$mesh" --truth missing -o report
mkdir empty
refused 1 "$mesh" --truth empty -o report
grep -q "nothing is known of person_wave_scan" err || fail "no word of the missing truth"
echo "0 99999" >empty/person_wave_scan.truth
refused 1 "$mesh" --truth empty -o report
mkdir taken
expect 1 "$mesh" -o taken
[[ -z $(ls -A taken) ]] || fail "wrote into a folder that was there"

# A report.
figures="comparison.json
durations.csv
error_curves.csv
generations.csv
methods.csv"
expect 0 "$mesh" "${quick[@]}" --repeats 2 -o report/
[[ $(wc -l <report/runs.csv) == 7 ]] || fail "not three methods, twice"
if grep -q "no page" err; then
  grep -q "python3-jinja2" err || fail "no page, for another reason"
  echo "python3-jinja2 is missing: the page is not tested"
  have_page=
else
  have_page=yes
  [[ $(cat out) == report/report.html ]] || fail "does not say where the report is"
  ! grep -Eq '(src|href)="?(http|//)' report/report.html || fail "the report needs a network"
  for word in "ga_symmetry compare" "seeds 1, 2 repeats" "ratio to naive" "Mean error on each mesh"; do
    grep -q "$word" report/report.html || fail "\"$word\" is not in the report"
  done
  if [[ ! -s err ]]; then
    [[ $(ls report) == "$figures
report.html
runs.csv" ]] || fail "other files: $(ls report)"
    [[ $(grep -o 'src="data:image/png;base64,iVBOR' report/report.html | wc -l) == 7 ]] || fail "not seven pictures"
  else
    grep -q "no plots: .*python3-matplotlib" err || fail "no plots, for another reason"
  fi
fi
# The optimum is found by naive and k-d tree, and beaten by nobody.
awk -F, 'NR > 1 && $6 == "naive" { optimum = $12 } NR > 1 && ($12 < optimum || ($6 == "kdtree" && $12 != optimum)) { exit 1 }
  NR > 1 { ++n[$6] } END { exit !(n["naive"] == 8 && n["kdtree"] == 8 && n["genetic"] == 24 && n["scan"] == 24) }' \
  report/durations.csv || fail "the durations are not what they should be"
awk -F, 'NR > 1 && $2 != "joint" && $7 < $11 { exit 1 } NR > 1 { exit !($11 > 0) }' <(awk -F, 'NR == 1 || $11 != ""' report/generations.csv) ||
  fail "a generation beats the optimum"
# The same figures as `score`.
"$tool" find "$mesh" --refs "$(tr ' ' , <"${mesh%.off}.refs")" --method pairs --quiet -o pairs.csv
"$tool" score "$mesh" "${mesh%.off}.truth" pairs.csv >score
awk -F, '$2 == "pairs-squared" { printf "mean %.4f corr %.4f coverage %.4f involution %.4f lines %d\n", $6, $7, $8, $9, $10; exit }' \
  report/runs.csv | cmp -s - score || fail "other figures than score's: $(cat score)"

# What the page says follows from the figures: once joint is behind everybody, once ahead.
page=$(dirname "$tool")/../share/ga_symmetry/comparison/report.py
python=$(command -v /usr/bin/python3 || echo python3)
if [[ $have_page ]]; then
  while IFS=: read -r name mean corr seconds others; do
    cp -r report "$name"
    echo "joint,1,$mean,$corr,1,1,1,$seconds" >>"$name/methods.csv"
    echo '[]' >"$name/pictures.json"
    "$python" "$page" "$name" >out 2>err
    [[ $? =~ ^[04]$ ]] || fail "report.py does not make the page again"
    for what in "Lower mean error" "Higher corr" "Faster"; do
      grep -q "$what: $others\." "$name/report.html" || fail "joint is $name, but not: $what: $others"
    done
  done <<<"behind:1:0.1:900:naive, kdtree, pairs-squared
ahead:0.001:0.999:0:none"
fi

# Without jinja2, without matplotlib; without references.
mkdir -p none/jinja2 none/matplotlib plots/matplotlib truth
for module in none/jinja2 none/matplotlib plots/matplotlib; do
  echo 'raise ImportError("not here")' >$module/__init__.py
done
cp "${mesh%.off}.truth" truth
plain=("$mesh" --truth truth --seeds 1 --methods naive,spectral-auto)
PYTHONPATH=$work/none expect 0 "${plain[@]}" -o tables
grep -q "no page: .*install python3-jinja2 python3-matplotlib, and run: .*report.py tables$" err ||
  fail "does not say what to install"
[[ $(cat out) == tables && $(ls tables) == "$figures
pictures.json
runs.csv" ]] || fail "without jinja2: $(ls tables)"
grep -q "person_wave_scan has no references" err || fail "does not say what was left out"
[[ $(wc -l <tables/runs.csv) == 2 ]] || fail "a method ran without the references that it needs"
if [[ $have_page ]]; then
  PYTHONPATH=$work/plots expect 0 "${plain[@]}" -o plain
  grep -q "no plots: .*install python3-matplotlib" err || fail "does not say what to install"
  [[ $(cat out) == plain/report.html && ! -e plain/report.log ]] || fail "no report without matplotlib"
  ! grep -q "data:image" plain/report.html || fail "pictures out of nowhere"
  grep -q "There are no plots" plain/report.html || fail "the page does not say why it has no plots"
  grep -q "person_wave_scan has no references" plain/report.html || fail "does not say what was left out"
  rm plain/report.html
  $(sed -n 's/.*, and run: //p' err) >out 2>err
  [[ $? =~ ^[04]$ && -s plain/report.html ]] || fail "the command that it names does not make the page"
  # How a child ended is known even where the parent left SIGCHLD ignored.
  "$python" -c 'import os, signal, sys
signal.signal(signal.SIGCHLD, signal.SIG_IGN)
os.execv(sys.argv[1], sys.argv[1:])' "$tool" compare "${plain[@]}" -o ignored >out 2>err ||
    fail "exit $? with SIGCHLD ignored"
  [[ $(cat out) == ignored/report.html ]] || fail "no report with SIGCHLD ignored"
fi

# An interrupt leaves nothing.
"$tool" compare "$mesh" -o half >out 2>err &
run=$!
sleep 1
kill -INT $run
wait $run
status=$?
[[ $status == 130 ]] || fail "an interrupted run: exit $status instead of 130"
[[ -z $(find . -maxdepth 1 -name 'half*') ]] || fail "half a report"
((failures == 0)) && echo "all passed"
exit $((failures > 0))
