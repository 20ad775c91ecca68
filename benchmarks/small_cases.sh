#!/usr/bin/env bash
# small_cases.sh [CASES [BIN [ELEMENT_SIZE]]]: milliseconds of a processor a case of a study of small cases, all on one
# core: by `cleft run`, and of them in solving, encoding and packing; and where each case has a process of its own for each
# step. Of cases that differ in the skin's tension, and in the tissue's modulus, which needs a factor for each. A figure
# and a number a line.
set -eu
cases=${1:-24}; bin=$(realpath "${2:-build/release/bin}"); size=${3:-2.5}
place=$(mktemp -d "${TMPDIR:-/tmp}/cleft-small-XXXXXX"); trap 'rm -rf "$place"' EXIT
export OPENBLAS_NUM_THREADS=1
mkdir "$place/bin"; ln -s "$bin"/cleft-* "$place/bin"
cp --remove-destination "$bin/cleft-run" "$place/bin"
for step in solve encode pack check; do  # notes the time that the step takes
  rm "$place/bin/cleft-$step"
  cat > "$place/bin/cleft-$step" <<NOTE
#!/bin/bash
TIMEFORMAT='%U %S'
{ time "$bin/cleft-$step" "\$@" 2>&3; } 3>&2 2>> "$place/$step.times"
NOTE
  chmod +x "$place/bin/cleft-$step"
done

# milliseconds FILE: a case, of the times in it.
milliseconds() { awk -v n="$cases" '{ sum += $1 + $2 } END { printf "%.1f (%d processes)\n", 1000 * sum / n, NR }' "$1"; }
TIMEFORMAT='%U %S'
for varied in '"skin.prestress_v" = { from = 0.02, to = 0.05' '"tissue.young_modulus" = { from = 0.01, to = 0.04'; do
  name=$(echo "$varied" | cut -d'"' -f2)
  printf '[case]\nmesh.element_size = %s\n[vary]\n%s, count = %d }\n' "$size" "$varied" "$cases" > "$place/study.toml"
  rm -f "$place"/*.times; rm -rf "$place/study"
  { time "$place/bin/cleft-run" "$place/study.toml" --out "$place/study" --jobs 1 --quiet > /dev/null 2> "$place/log"; } 2> "$place/run"
  echo "$name run $(milliseconds "$place/run")"
  for step in solve encode check pack; do echo "$name run_$step $(milliseconds "$place/$step.times")"; done
  : > "$place/own_solve"; : > "$place/own_encode"
  for one in "$place"/study/cases/*/case.toml; do
    { time "$bin/cleft-solve" "$one" --out "$place/one.h5" --quiet &> "$place/log"; } 2>> "$place/own_solve"
    { time "$bin/cleft-encode" "$place/one.h5" --out "$place/one.dffd" --quiet &> "$place/log"; } 2>> "$place/own_encode"
    rm "$place/one.h5" "$place/one.dffd"
  done
  for step in solve encode; do echo "$name own_$step $(milliseconds "$place/own_$step")"; done
done
