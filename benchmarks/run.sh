#!/usr/bin/env bash
# run.sh OUT.json [OPTIONS OF GOOGLE BENCHMARK]: all headline figures, five times each, printed and saved.
set -eu
out=${1:?run.sh OUT.json}; shift
here=$(cd "$(dirname "$0")" && pwd)
exec "${CLEFT_BIN:-$here/../build/release/bin}/cleft-benchmarks" --benchmark_repetitions=5 --benchmark_out="$out" \
  --benchmark_out_format=json --benchmark_display_aggregates_only=true "$@"
