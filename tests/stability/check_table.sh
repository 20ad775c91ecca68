#!/usr/bin/env bash
# check_table.sh ROOT: docs/stability.md has the tests of limits.txt, in its order, and the tests that record a row
# are the same.
set -eu
cd "$1"
bad=0
compare() { diff <(echo "$2") <(echo "$3") || { echo "$1"; bad=1; }; }

listed=$(grep -v '^#' tests/stability/limits.txt | cut -d' ' -f2)
compare "docs/stability.md (right) has other tests than limits.txt (left): tests/stability/table.sh" \
  "$listed" "$(sed -n 's/^- \*\*Test\*\*: `\(.*\)`$/\1/p' docs/stability.md)"
recording=$(find tests -name '*_test.cpp' -print0 | xargs -0 awk '
  /^TEST(_F)?\(/ { name = $0; sub(/^TEST(_F)?\(/, "", name); sub(/\).*/, "", name); sub(/, */, ".", name) }
  /^}/ { name = "" }
  /record_limit\(/ && name != "" { print name }' | sort)
compare "tests that call record_limit (right) are not those of limits.txt (left)" "$(sort <<<"$listed")" "$recording"
exit $bad
