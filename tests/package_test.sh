#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes the Debian package, installs it, runs the filters in the system's meshlabserver, and removes it again.
#
#   package_test.sh BUILD_DIRECTORY SAMPLE.off
#
# Exit 0 = passed, 1 = failed, 77 = cannot be run here: it takes root's rights.
set -euo pipefail
build=$1 sample=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "FAILED: $*"; exit 1; }
on_screen=$(dirname "$(realpath "$0")")/../scripts/on_screen
for program in apt-get dpkg-shlibdeps meshlabserver xvfb-run; do
  command -v $program > /dev/null || { echo "skipped: $program is missing"; exit 77; }
done
(cd "$build" && cpack -G DEB -B "$work") > "$work/log" 2>&1 || { cat "$work/log"; fail "cpack"; }
package=$(echo "$work"/ga-symmetry_*.deb)
if command -v lintian > /dev/null; then
  lintian --allow-root --tag-display-limit 0 "$package" > "$work/lintian" 2>&1 || true
  ! grep '^E: ' "$work/lintian" || fail "lintian finds errors"
else
  echo "lintian is missing: its check is left out"
fi
dpkg-deb --field "$package" Depends | grep -q meshlab || fail "the package does not depend on meshlab"
[ "$(id -u)" = 0 ] || { echo "skipped: only root can install packages"; exit 77; }
! dpkg-query -W ga-symmetry > /dev/null 2>&1 || { echo "skipped: ga-symmetry is installed"; exit 77; }

chmod 755 "$work"
apt-get -q install -y --no-install-recommends "$package" > "$work/log" 2>&1 || { cat "$work/log"; fail "it does not install"; }
trap 'apt-get -q remove -y ga-symmetry > /dev/null 2>&1 || true; rm -rf "$work"' EXIT
ga_symmetry --version
man -w ga_symmetry > /dev/null 2>&1 || fail "there is no manual page"
cd "$work"
export HOME=$work
"$on_screen" meshlabserver -i "$sample" -o out.ply -m vq \
  -s /usr/share/doc/ga-symmetry/examples/meshlabserver/compute_asymmetry_per_vertex.mlx > log 2>&1 || { cat log; fail "the filters do not run"; }
grep -q "Asymmetry: " log || fail "the filters are not found"
[ -s partners.csv ] && [ -s out.ply ] || fail "no results"
apt-get -q remove -y ga-symmetry > log 2>&1 || { cat log; fail "it cannot be removed"; }
for left in /usr/bin/ga_symmetry /usr/share/ga_symmetry /usr/share/doc/ga-symmetry /usr/include/ga_symmetry; do
  [ ! -e $left ] || fail "$left is left behind"
done
[ -z "$(find /usr/lib -name 'libfilter_ga_symmetry*')" ] || fail "the plugin is left behind"
echo "installed, run and removed"
