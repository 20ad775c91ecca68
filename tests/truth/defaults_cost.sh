#!/usr/bin/env bash
# defaults_cost.sh: opening and processor seconds of the default case, of small strains but for one row, with
# the settings of patch and mesh that were the defaults before, those of today, those that `cleft advise`
# chooses for an error of 0.1, and finer ones; a table in Markdown (minutes). Processor seconds, of user and
# system, are the least of RUNS (1) runs of `cleft solve`.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
bin=${CLEFT_BIN:-$here/../../build/release/bin}
work=$(mktemp -d); trap 'rm -rf "$work"' EXIT
runs=${RUNS:-1}
export OPENBLAS_NUM_THREADS=1  # threads that wait for work count as processor time
: > "$work/case.toml"

# row NAME PARAMETER=VALUE...: solves, and prints a row of the table.
row() {
  local name=$1 parameter options=(); shift
  for parameter in "$@"; do options+=(--set "$parameter"); done
  for run in $(seq "$runs"); do
    TIMEFORMAT='%U %S'
    { time "$bin/cleft" solve "$work/case.toml" --no-estimate --quiet --json --out "$work/case.h5" \
        "${options[@]}" > "$work/figures.json"; } 2> "$work/time.$run"
  done
  python3 - "$name" "$work" "$runs" <<'PY'
import json, sys
name, work, runs = sys.argv[1:]
seconds = min(sum(map(float, open(f"{work}/time.{run}").read().split())) for run in range(1, int(runs) + 1))
figures = json.load(open(f"{work}/figures.json"))
print(f"| {name} | {figures['nodes']:,} | {figures['gape_mm']:.2f} | {seconds:.1f} |", flush=True)
PY
}

# advised PARAMETER=VALUE...: what `cleft advise` chooses for the case, as PARAMETER=VALUE.
advised() {
  printf '%s\n' 'name = "default"' '[case]' 'model = "small"' "$@" > "$work/study.toml"
  "$bin/cleft" advise "$work/study.toml" --error 0.1 --out "$work/advised.toml" --quiet > /dev/null
  python3 - "$work/advised.toml" <<'PY'
import sys, tomllib
for group, values in tomllib.load(open(sys.argv[1], "rb"))["case"].items():
    if isinstance(values, dict):
        for name, value in values.items(): print(f"{group}.{name}={value}")
    elif group != "model": print(f"{group}={values}")
PY
}

before=(patch.length=60 patch.width=40 mesh.grading=1 mesh.front=nodes skin.edges=free)
echo '| setting | nodes | opening, mm | processor s |'
echo '|---|---|---|---|'
row 'default before: 60 x 40 mm, free edges, even elements' "${before[@]}"
row 'default'
row 'default, finite strains' model=finite
mapfile -t chosen < <(advised 'skin.edges = "free"' 'mesh.front = "nodes"')
row 'advised, with free edges and cuts that end at nodes' "${chosen[@]}"
mapfile -t chosen < <(advised)
row 'advised' "${chosen[@]}"
row 'finer: 480 x 480 mm, free edges, cuts that end at nodes, elements of 0.5 mm' patch.length=480 \
  patch.width=480 skin.edges=free mesh.front=nodes mesh.element_size=0.5
row 'converged: 270 x 240 mm, elements of 1/3 mm' patch.length=270 patch.width=240 \
  mesh.element_size=0.3333333333
