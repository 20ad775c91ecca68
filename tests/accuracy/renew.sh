#!/usr/bin/env bash
# renew.sh [PRESET]: builds, encodes the reference cases again, writes accuracy.csv, and prints what differs from it.
# Commit the table together with the reason.
set -eu
cd "$(dirname "$0")/../.."
preset=${1:-release}
snapshots=build/$preset/tests/accuracy/snapshots
[ -d "build/$preset" ] || cmake --preset "$preset" > /dev/null
cmake --build --preset "$preset" --target accuracy cleft cleft-solve cleft-encode > /dev/null
"build/$preset/tests/accuracy/bin/accuracy" make "$snapshots"
"build/$preset/tests/accuracy/bin/accuracy" renew "$snapshots"
git --no-pager diff --stat -- tests/accuracy/accuracy.csv
