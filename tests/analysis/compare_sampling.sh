#!/usr/bin/env bash
# compare_sampling.sh BIN FOLDER NAME SEEDS COUNT...: the true error of the gape at 200 cases held out (95 % quantile, over its
# largest value) of a study of make_studies.py, by as many cases of the Sobol sequence and of adaptive sampling, for each seed
# of SEEDS ("1 2 3"). BIN: the folder of cleft; `coverage` lies beside it, or in ../tests/analysis/bin. Prints a row of CSV for
# each seed and count.
set -eu
bin=$(realpath "$1"); name=$3; seeds=$4; here=$(cd "$(dirname "$0")" && pwd); cd "$2"; shift 4
coverage=$bin/coverage; [ -x "$coverage" ] || coverage=$bin/../tests/analysis/bin/coverage
[ -f "$name.toml" ] || "$here/make_studies.py" .

# sampled FILE SAMPLING: the study with other cases
sampled() { sed "/^\[sampling\]/,\$d" "$name.toml" > "$1"; printf '[sampling]\n%s\n' "$2" >> "$1"; }
quantile() { "$coverage" "$1" "${name}_200" gape | sed -n 's/.*error: median [0-9.]*, 95 % \([0-9.]*\).*/\1/p'; }
run() { "$bin/cleft" run "$1.toml" --out "$1" --quiet > /dev/null; }

sampled "${name}_200.toml" $'method = "latin-hypercube"\ncount = 200\nseed = 77'
run "${name}_200"
echo "seed,cases,sobol,adaptive"
for seed in $seeds; do
  sobol=${name}_sobol_$seed; adaptive=${name}_adaptive_$seed
  for count in "$@"; do
    sampled "$sobol.toml" "method = \"sobol\"
count = $count
seed = $seed"
    sampled "$adaptive.toml" "method = \"adaptive\"
error = 1e-6
most = $count
of = \"gape\"
batch = 4
seed = $seed"
    run "$sobol"; run "$adaptive" || true  # the error is never reached: exit code 1
    echo "$seed,$count,$(quantile "$sobol"),$(quantile "$adaptive")"
  done
done
