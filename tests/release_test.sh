#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# release_test.sh SOURCE: the version is one everywhere, and the package's date can be derived and repeated.
set -uo pipefail
source=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0
fail() { echo "FAILED: $*"; failures=$((failures + 1)); }
version=$(sed -n 's/#define GA_SYMMETRY_VERSION "\(.*\)"/\1/p' "$source/core/include/ga_symmetry/version.h")

grep -qx "version: $version" "$source/CITATION.cff" || fail "CITATION.cff is not of version $version"
{ grep -qx "## Unreleased" "$source/CHANGELOG.md" && grep -qx "Version $version\." "$source/CHANGELOG.md"; } ||
  grep -Eqx "## $version, [0-9]{4}-[0-9]{2}-[0-9]{2}" "$source/CHANGELOG.md" ||
  fail "CHANGELOG.md has neither version $version as Unreleased nor its date"

# date_of VERSION: what the Debian changelog says, from the CHANGELOG.md in $work/tree.
cat >"$work/date.cmake" <<END
include("$source/cmake/ReleaseDate.cmake")
release_date(date "\${VERSION}" "$work/tree/CHANGELOG.md" "%a, %d %b %Y %H:%M:%S +0000")
file(WRITE "$work/date" "\${date}")
END
date_of() { cmake -DVERSION="$1" -P "$work/date.cmake" >"$work/log" 2>&1 && cat "$work/date"; }
expect() { [[ $1 == "$2" ]] || fail "$3: $1 instead of $2"; }
unset SOURCE_DATE_EPOCH
mkdir "$work/tree"
export GIT_CEILING_DIRECTORIES=$work  # no repository above
for day in 1970-01-01 2000-02-29 2024-02-29 2024-12-31 2025-03-01 2026-11-24 2027-08-09; do
  printf '# Changes\n\n## 1.10.0, 2001-01-01\n\n## 1.1.0, %s\n' $day >"$work/tree/CHANGELOG.md"
  expect "$(date_of 1.1.0)" "$(LC_ALL=C date -u -R -d $day)" "released on $day"
done
expect "$(date_of 1.2.0)" "Mon, 01 Jan 2001 00:00:00 +0000" "not released, without git"
expect "$(SOURCE_DATE_EPOCH=86400 date_of 1.1.0)" "Fri, 02 Jan 1970 00:00:00 +0000" "SOURCE_DATE_EPOCH"
echo "# Changes" >"$work/tree/CHANGELOG.md"
! date_of 1.2.0 >/dev/null || fail "a date out of nothing"
if command -v git >/dev/null; then
  git -C "$work/tree" init -q
  GIT_COMMITTER_DATE="@172800 +0000" git -C "$work/tree" -c user.name=a -c user.email=a@b commit -q --allow-empty -m a
  expect "$(date_of 1.2.0)" "Sat, 03 Jan 1970 00:00:00 +0000" "not released, by git"
fi
((failures == 0)) && echo "all passed"
exit $((failures > 0))
