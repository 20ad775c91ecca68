#!/usr/bin/env bash
# study_overhead.sh [CASES [BIN [OPTIONS OF cleft run]]]: what running a study costs a case beside solving and encoding,
# which stand-ins do in no time here: milliseconds a case of cleft run, with everything flushed to disk; then those of
# cleft status with its index, and without. A figure and a number a line.
set -eu
cases=${1:-200}; bin=$(realpath "${2:-build/release/bin}"); shift $(($# < 2 ? $# : 2))
place=$(mktemp -d "${TMPDIR:-/tmp}/cleft-overhead-XXXXXX"); trap 'rm -rf "$place"' EXIT
mkdir "$place/bin"; cp "$bin"/cleft{,-run,-status} "$place/bin"
cat > "$place/bin/cleft-solve" <<'STAND_IN'
#!/bin/sh
# CASE.toml ... --out DIR --json
files=; while [ "$1" != --out ]; do files="$files $1"; shift; done
first=1; printf '['
for file in $files; do
  name=${file##*/}; out=$2/${name%.toml}.h5
  echo solved > "$out"
  [ $first = 1 ] || printf ','
  first=0; printf '{"out": "%s"}' "$out"
done
printf ']\n'
STAND_IN
printf '#!/bin/sh\necho encoded > "$3"\necho "{}"\n' > "$place/bin/cleft-encode"
printf '#!/bin/sh\nexit 0\n' > "$place/bin/cleft-check"
cp "$place/bin/cleft-check" "$place/bin/cleft-pack"; chmod +x "$place"/bin/*
printf '[vary]\n"skin.prestress_v" = { from = 0.01, to = 0.05, count = %d }\n' "$cases" > "$place/study.toml"

milliseconds() { local begin=$(date +%s%N); "$@" > "$place/out" 2> "$place/log" || { cat "$place/log"; exit 1; }
  echo $((($(date +%s%N) - begin) / 1000000)); }
ms=$(milliseconds "$place/bin/cleft-run" "$place/study.toml" --out "$place/study" "$@")
echo "ms_run_a_case $((ms * 10 / cases / 10)).$((ms * 10 / cases % 10))"
milliseconds "$place/bin/cleft-status" "$place/study" > /dev/null
echo "ms_status_with_index $(milliseconds "$place/bin/cleft-status" "$place/study")"
rm "$place/study/index.json"
echo "ms_status_without_index $(milliseconds "$place/bin/cleft-status" "$place/study")"
