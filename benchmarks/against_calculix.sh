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
series=$(echo "$(date +%s.%N) - $start" | bc)
frames=$(grep -o '"frames": [0-9]*' "$work/figures.json" | head -1 | grep -o '[0-9]*')
echo "cleft solve: $frames frames in $series s, everything included"
start=$(date +%s.%N)
/usr/bin/python3 tests/solver/calculix/calculix.py "$work/case.h5" --time
one=$(echo "$(date +%s.%N) - $start" | bc)
