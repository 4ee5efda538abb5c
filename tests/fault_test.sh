#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# fault_test.sh TOOL: what fails outside of the tool (disk, folder, memory, threads, the tool itself killed) loses nothing:
# each output is the old file or the new one, whole. Exit 77 = nothing could be tested here.
set -uo pipefail
tool=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0 skipped=0
quick=(--joint-samples 30 --joint-population 10 --joint-generations 3)

fail() {
  echo "FAILED: $*"
  [[ -s err ]] && sed 's/^/    stderr: /' err
  failures=$((failures + 1))
}
one_line() { [[ $(wc -l <err) == 1 ]] || fail "$1: the message is not one line"; }
no_leftovers() { [[ -z $(find "$1" -name '*.part') ]] || fail "$2: a temporary file was left"; }

# globe RINGS SEGMENTS: a bumpy closed surface as OFF.
globe() {
  awk -v n="$1" -v m="$2" 'BEGIN { pi = atan2(0, -1); print "OFF"; print n*m + 2, 2*n*m, 0
    for (i = 0; i < n; ++i) for (j = 0; j < m; ++j) { p = pi*(i+1)/(n+1); q = 2*pi*j/m
      r = 1 + .4*sin(p)^2*cos(2*q) + .5*exp(8*(sin(p)*sin(q)-1)) + .3*cos(p)
      print r*sin(p)*cos(q), r*sin(p)*sin(q), r*cos(p) }
    print 0, 0, 1.3; print 0, 0, -0.7
    for (j = 0; j < m; ++j) { k = (j+1)%m; print 3, n*m, j, k; print 3, n*m+1, (n-1)*m+k, (n-1)*m+j
      for (i = 0; i < n-1; ++i) { a = i*m+j; b = i*m+k; print 3, a, a+m, b+m; print 3, a, b+m, b } } }'
}
globe 24 32 >small.off
globe 90 120 >large.off
can_mount() { unshare -m true 2>/dev/null && unshare -m mount -t tmpfs none /mnt 2>/dev/null; }
# in_folder MOUNT_OPTIONS COMMAND: runs it where ./disk is a small file system of its own, which is gone afterwards.
in_folder() { mkdir -p disk && unshare -m bash -c "mount -t tmpfs -o $1 none disk && $2"; }
export tool
run="\"\$tool\" find small.off ${quick[*]}"

if can_mount; then
  # A full disk: room for the old files, not for the new ones.
  in_folder size=24k "for e in csv json ply; do echo old >disk/a.\$e; done
    $run -o disk/a.csv -o disk/a.json -o disk/a.ply >out 2>err; echo \$? >status; cp -r disk after"
  [[ $(<status) == 1 ]] || fail "full disk: exit $(<status) instead of 1"
  one_line "full disk"
  grep -q "No space left" err || fail "full disk: the message does not say so"
  for e in csv json ply; do [[ $(<after/a.$e) == old ]] || fail "full disk: a.$e was changed"; done
  no_leftovers after "full disk"
  rm -rf after
  for e in csv json ply; do  # each format alone; the disk fills up in the middle of it
    in_folder size=24k "echo old >disk/a.$e; $run -o disk/a.$e >out 2>err; echo \$? >status; cp -r disk after"
    [[ $(<status) == 1 && $(<after/a.$e) == old ]] || fail "full disk: a.$e was changed, or exit $(<status)"
    no_leftovers after "full disk, $e"
    rm -rf after
  done
  # A disk that can only be read.
  in_folder size=1m "echo old >disk/a.csv; mount -o remount,ro disk; $run -o disk/a.csv >out 2>err; echo \$? >status
    cp -r disk after"
  [[ $(<status) == 1 && $(<after/a.csv) == old ]] || fail "read-only disk: exit $(<status), $(<after/a.csv)"
  one_line "read-only disk"
  rm -rf after
else
  echo "left out: full and read-only disks (they take the right to mount)"
  skipped=1
fi

if [[ -w /dev/full ]]; then
  "$tool" find small.off "${quick[@]}" >/dev/full 2>err
  [[ $? == 1 ]] || fail "a summary that cannot be written is a success"
  "$tool" samples small.off >/dev/full 2>err
  [[ $? == 1 ]] || fail "a table that cannot be written is a success"
fi

if [[ $(id -u) != 0 ]]; then
  mkdir closed && echo old >closed/a.csv && chmod 555 closed
  "$tool" find small.off "${quick[@]}" -o closed/a.csv >out 2>err
  [[ $? == 1 && $(<closed/a.csv) == old ]] || fail "a folder without the right to write"
  one_line "a folder without the right to write"
  chmod 755 closed
fi

# A limit of file sizes is an error like a full disk.
echo old >a.json
(ulimit -f 16 && exec "$tool" find small.off "${quick[@]}" -o a.json) >out 2>err
[[ $? == 1 && $(<a.json) == old ]] || fail "a limit of file sizes"
one_line "a limit of file sizes"
no_leftovers . "a limit of file sizes"

# Killed while it writes: the old file stays. The temporary file shows that it writes.
globe 250 400 >huge.off
write_huge=("$tool" samples huge.off --count 2)
"${write_huge[@]}" -o whole.ply >out 2>err || fail "huge.off"
caught=0
for delay in 0 0 0.01 0.02 0.03 0.05; do
  echo old >killed.ply
  "${write_huge[@]}" -o killed.ply >out 2>err &
  run=$!
  while kill -0 $run 2>/dev/null; do
    for part in .ga_symmetry-*.part; do
      [[ -e $part ]] && sleep $delay && kill -KILL $run 2>/dev/null && caught=$((caught + 1)) && break 2
    done
  done
  wait $run 2>/dev/null
  cmp -s killed.ply <(echo old) || cmp -s killed.ply whole.ply || fail "killed: killed.ply is neither old nor new"
  rm -f .ga_symmetry-*.part
done
echo "killed $caught times of 6 while it wrote"
"${write_huge[@]}" -o killed.ply >out 2>err
cmp -s killed.ply whole.ply || fail "after a kill it does not write"

# Memory and threads that cannot be had. Sanitizers reserve more than any limit.
if (ulimit -v 8000000 && "$tool" --version >/dev/null 2>&1); then
  for kilobytes in 40000 60000 80000 120000; do
    (ulimit -v $kilobytes && exec "$tool" find large.off "${quick[@]}" --threads 1 -o memory.csv) >out 2>err
    status=$?
    case $status in
      0) cmp -s <(wc -l <memory.csv) <(echo 10803) || fail "$kilobytes kB: memory.csv is not whole"; rm memory.csv ;;
      1) one_line "$kilobytes kB of memory"; [[ ! -e memory.csv ]] || fail "$kilobytes kB: a file was written" ;;
      127) ;;  # not even loaded
      *) fail "$kilobytes kB of memory: exit $status" ;;
    esac
  done
  "$tool" find small.off "${quick[@]}" -o one.csv >out 2>err
  (ulimit -v 400000 && exec "$tool" find small.off "${quick[@]}" --threads 256 -o many.csv) >out 2>err
  [[ $? == 0 ]] && cmp -s one.csv many.csv || fail "256 threads where there is room for a few"
else
  echo "left out: limits of memory"
fi
no_leftovers . "in the end"
((failures == 0)) && echo "all passed$([[ $skipped == 0 ]] || echo " of what could be tested")"
exit $((failures > 0))
