#!/usr/bin/env bash
# table.sh [PRESET]: builds and runs the tests that limits.txt lists, and makes docs/stability.md from their rows.
set -eu
cd "$(dirname "$0")/../.."
preset=${1:-release}
list=$(grep -v '^#' tests/stability/limits.txt)
[ -d "build/$preset" ] || cmake --preset "$preset" > /dev/null
# shellcheck disable=SC2046
cmake --build --preset "$preset" -j2 --target $(cut -d' ' -f1 <<<"$list" | sort -u) > /dev/null
rows=$(mktemp -d)
trap 'rm -rf "$rows"' EXIT
for program in $(cut -d' ' -f1 <<<"$list" | sort -u); do
  filter=$(grep "^$program " <<<"$list" | cut -d' ' -f2 | paste -sd:)
  CLEFT_STABILITY_ROWS=$rows OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 \
    "build/$preset/tests/$program" --gtest_brief=1 --gtest_filter="$filter"
done
new=$(while read -r _ test; do echo "$rows/$test"; done <<<"$list")
# shellcheck disable=SC2086
tests/stability/make_page.py $new > "$rows/page.md"
cp "$rows/page.md" docs/stability.md
git --no-pager diff --stat -- docs/stability.md
