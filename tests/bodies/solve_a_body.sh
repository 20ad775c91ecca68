#!/usr/bin/env bash
# solve_a_body.sh recompute|ranks|calculix|own PYTHON CLEFT WRITE_SUBJECT SOLVE_WITH_RULE SUBJECT [KIND]: meshes the body of
# a subject, solves it (ranks: on three, twice, to the same bytes), and again by the independent solver or by ccx (with its
# integration rule). own: brings the mesh back as one's own, which must give the same series. KIND: layers (of different
# tissue), or finite, finite_fung (strains). 77: ccx or modules are missing.
set -eu
here=$(dirname "$0") by=$1 python=$2 cleft=$3 write_subject=$4 solve_with_rule=$5 subject=$6 kind=${7:-}
export PYTHONDONTWRITEBYTECODE=1
place=$(mktemp -d); trap 'rm -rf "$place"' EXIT
what=$("$write_subject" "$subject" "$place")
printf '[case]\nmesh.element_size = 1.5\nmesh.grading = 1.6\npatch.height = 4.5\nskin.prestress_uv = 0.004\n' >"$place/case.toml"
case $kind in
  finite) printf 'model = "finite"\nskin.law = "st-venant-kirchhoff"\ntissue.law = "st-venant-kirchhoff"\n' >>"$place/case.toml" ;;
  finite_fung) printf 'model = "finite"\nskin.law = "fung"\nskin.stiffening = 8\nskin.fibre_share = 0.5\nskin.fibre_angle = 30\n' \
    >>"$place/case.toml" ;;
esac
layers=
if [ "$kind" = layers ] || [ "$by" = own ]; then
  printf '[dermis]\nto_depth = 1.1\nyoung_modulus = 0.08\n[fat]\nto_depth = 3\n[muscle]\nyoung_modulus = 0.05\npoisson_ratio = 0.4\n' \
    >"$place/layers.toml"
  layers="--materials $place/layers.toml"
fi
"$cleft" body $what $layers --case "$place/case.toml" --reach 8 --direction 1,0.3,0.1 --out "$place/body.h5"
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
if [ "$by" = own ]; then
  mv "$place/case.h5" "$place/first.h5"
  "$python" "$here/own_mesh.py" export "$place/body.h5" "$place/own.vtu" "$place/own.toml" "$place/map.npy"
  paths=$(printf %s "$what" | sed 's/--mesh [^ ]*//; s/--bone [^ ]*//')
  "$cleft" body --mesh "$place/own.vtu" $paths --materials "$place/own.toml" --case "$place/case.toml" --direction 1,0.3,0.1 \
    --out "$place/own.h5"
  "$cleft" solve "$place/case.toml" --mesh "$place/own.h5" --out "$place/case.h5" --no-estimate
  "$python" "$here/own_mesh.py" compare "$place/first.h5" "$place/case.h5" "$place/map.npy"
fi
"$python" "$here/../solver/$program" "$place/case.h5"
