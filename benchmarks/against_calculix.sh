#!/usr/bin/env bash
# against_calculix.sh [BUILD]: the frames of a case of 110,000 unknowns by CalculiX, one *STATIC measured, beside the
# whole series by cleft solve.
set -eu
cd "$(dirname "$0")/.."
bin=$(realpath "${1:-build/release}")/bin
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
case=tests/solver/calculix/large.toml
start=$(date +%s.%N)
"$bin/cleft" solve "$case" --out "$work/case.h5" --json > "$work/figures.json"
series=$(awk -v from="$start" -v to="$(date +%s.%N)" 'BEGIN { print to - from }')
frames=$(grep -o '"frames": [0-9]*' "$work/figures.json" | head -1 | grep -o '[0-9]*')
echo "cleft solve: $frames frames in $series s, everything included"
answer=$(/usr/bin/python3 tests/solver/calculix/calculix.py "$work/case.h5" --time)
echo "$answer"
one=$(sed -E 's/.*"seconds": ([0-9.]+).*/\1/' <<< "$answer")
awk -v one="$one" -v frames="$frames" -v series="$series" \
  'BEGIN { printf "CalculiX for all frames: %.0f s, %.0f times the series\n", one * frames, one * frames / series }'
