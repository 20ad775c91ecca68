#!/usr/bin/env bash
# solve_a_body.sh recompute|ranks|calculix PYTHON CLEFT WRITE_SUBJECT SOLVE_WITH_RULE SUBJECT: meshes the body of a subject,
# solves it (ranks: on three, twice, to the same bytes), and again by the independent solver or by ccx (with its
# integration rule). 77: ccx or modules are missing.
set -eu
here=$(dirname "$0") by=$1 python=$2 cleft=$3 write_subject=$4 solve_with_rule=$5 subject=$6
export PYTHONDONTWRITEBYTECODE=1
place=$(mktemp -d); trap 'rm -rf "$place"' EXIT
what=$("$write_subject" "$subject" "$place")
printf '[case]\nmesh.element_size = 1.5\nmesh.grading = 1.6\npatch.height = 4.5\nskin.prestress_uv = 0.004\n' >"$place/case.toml"
"$cleft" body $what --case "$place/case.toml" --reach 8 --direction 1,0.3,0.1 --out "$place/body.h5"
program=independent/recompute.py many=
[ "$by" != ranks ] || many="mpirun --oversubscribe --bind-to none -n 3"
if [ "$by" = calculix ]; then
  program=calculix/calculix.py
  "$solve_with_rule" "$place/case.toml" "$place/case.h5" "$place/body.h5"
else
  $many "$cleft" solve "$place/case.toml" --mesh "$place/body.h5" --out "$place/case.h5" --no-estimate
fi
if [ "$by" = ranks ]; then
  cp "$place/case.h5" "$place/first.h5"
  $many "$cleft" solve "$place/case.toml" --mesh "$place/body.h5" --out "$place/case.h5" --no-estimate
  cmp "$place/first.h5" "$place/case.h5"
fi
"$python" "$here/../solver/$program" "$place/case.h5"
