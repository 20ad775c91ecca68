#!/usr/bin/env bash
# compare_test.sh COMPARE.PY: what it calls worse, and what noise.
set -u
compare=$1; folder=$(mktemp -d); trap 'rm -rf "$folder"' EXIT; failed=0

# runs NAME TIMES ALLOCATIONS: a file of three repetitions
runs() {
  local rows="" time
  for time in $2; do
    rows+="${rows:+,}{\"run_name\": \"evaluate\", \"run_type\": \"iteration\", \"real_time\": 1e9, \"cpu_time\": $time, \"work_allocations\": $3}"
  done
  echo "{\"benchmarks\": [$rows, {\"run_name\": \"evaluate\", \"run_type\": \"aggregate\", \"cpu_time\": 1}]}" > "$folder/$1"
}
expect() {
  local code=$1 words=$2; shift 2
  output=$("$compare" "$@" 2>&1); local got=$?
  [ $got = "$code" ] && grep -q "$words" <<< "$output" || { echo "expected $code, '$words'; got $got:"; echo "$output"; failed=1; }
}
runs before "100 101 99" 20
runs noisy "120 80 109" 20;      expect 0 "nothing got worse" "$folder/before" "$folder/noisy"
runs slow "110 111 109" 20;      expect 1 "time .* WORSE" "$folder/before" "$folder/slow"
runs quick "80 81 79" 20;        expect 0 "time .* BETTER" "$folder/before" "$folder/quick"
runs work "100 101 99" 21;       expect 1 "work_allocations .* WORSE" "$folder/before" "$folder/work"
echo "{}" > "$folder/broken";    expect 2 "broken: is no file of run.sh" "$folder/before" "$folder/broken"
expect 2 "missing" "$folder/missing" "$folder/before"
exit $failed
