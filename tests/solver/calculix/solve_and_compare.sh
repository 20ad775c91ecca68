#!/usr/bin/env bash
# solve_and_compare.sh PYTHON CLEFT CASE.toml [SOLVE_WITH_RULE]: solves a case with ccx's rule, by SOLVE_WITH_RULE or
# else by the independent solver on the mesh of `cleft solve`, and compares it with ccx. 77: ccx or modules are missing.
set -eu
here=$(dirname "$0") python=$1 cleft=$2 case=$3 solver=${4:-}
export PYTHONDONTWRITEBYTECODE=1
place=$(mktemp -d); trap 'rm -rf "$place"' EXIT
if [ -n "$solver" ]; then
  "$solver" "$case" "$place/case.h5"
else
  "$cleft" solve "$case" --out "$place/full.h5"
  "$python" "$here/../independent/recompute.py" "$place/full.h5" --rule centroid --out "$place/case.h5"
fi
"$python" "$here/calculix.py" "$place/case.h5"
