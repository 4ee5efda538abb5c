#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# batch_test.sh TOOL SAMPLES: the recipes of docs/batch.md do what they say. Skips (77) without GNU Parallel.
set -uo pipefail
tool=$1 samples=$2
root=$(cd "$(dirname "$0")/.." && pwd)
if ! parallel --version 2>/dev/null </dev/null | grep -q "^GNU parallel"; then
  echo "skipped: GNU Parallel is not installed (apt-get install parallel)"
  exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
export HOME=$work PATH=$work/bin:$PATH  # Parallel writes to the home directory
mkdir -p .parallel bin scans
touch .parallel/will-cite
ln -s "$tool" bin/ga_symmetry
failures=0
fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}
for name in a b; do cp "$samples/person_wave_scan.off" scans/$name.off; done
echo broken >scans/c.off
# recipe N: the N-th command of docs/batch.md that begins with `parallel`, as it stands.
recipe() {
  awk -v n="$1" '/^```/ { on = 0 } /^parallel / && ++k == n { on = 1 } on' "$root/docs/batch.md"
}
# The samples are OFF files.
run() { bash -c "${1//\*.ply/\*.off}" >out 2>err </dev/null; }
for n in 1 2; do
  rm -rf results jobs.log
  [[ $n == 2 ]] || mkdir results
  command=$(recipe $n)
  [[ -n $command ]] || fail "recipe $n is not in docs/batch.md"
  run "${command/:,host1,host2/:}"
  status=$?
  [[ $status == 1 ]] || { fail "recipe $n: exit $status, one mesh fails"; cat err; }
  [[ $(ls results | paste -sd' ') == "a.csv b.csv" ]] || fail "recipe $n left $(ls results)"
  [[ $(awk 'NR > 1 { print $7 }' jobs.log | sort -n | paste -sd' ') == "0 0 1" ]] || fail "recipe $n logged $(cat jobs.log)"
  # Again: only what failed.
  echo kept >results/a.csv
  cp scans/a.off scans/c.off
  run "${command/:,host1,host2/:}" || fail "recipe $n does not resume: $(cat err)"
  [[ $(cat results/a.csv) == kept ]] || fail "recipe $n did a finished mesh again"
  cmp -s results/b.csv results/c.csv || fail "recipe $n: the same mesh gives other bytes"
  echo broken >scans/c.off
done
expected=$(cksum <results/b.csv)

# The Slurm script, as a task of an array would run it.
rm -rf results
for task in 1 2; do
  SLURM_ARRAY_TASK_ID=$task SLURM_CPUS_PER_TASK=1 "$root/examples/cluster/slurm_array.sh" scans/a.off scans/b.off >out ||
    fail "task $task of the array"
done
[[ $(ls results | paste -sd' ') == "a.csv b.csv" && $(cksum <results/b.csv) == "$expected" ]] || fail "the array left $(ls results)"
echo kept >results/a.csv
SLURM_ARRAY_TASK_ID=1 SLURM_CPUS_PER_TASK=1 "$root/examples/cluster/slurm_array.sh" scans/a.off >out
[[ $(cat results/a.csv) == kept ]] || fail "the array does not resume"
((failures == 0)) && echo "all passed"
exit $((failures > 0))
