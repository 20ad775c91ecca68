#!/usr/bin/env bash
# solve_and_recompute.sh PYTHON CLEFT CASE.toml: solves a case, and its frames again in Python. 77: modules are missing.
set -eu
here=$(dirname "$0") python=$1 cleft=$2 case=$3
place=$(mktemp -d); trap 'rm -rf "$place"' EXIT
"$cleft" solve "$case" --out "$place/case.h5" --no-estimate
PYTHONDONTWRITEBYTECODE=1 "$python" "$here/recompute.py" "$place/case.h5"
