#!/usr/bin/env bash
# certified.sh BIN FOLDER: certified bounds against true errors, of three studies of make_studies.py (24 cases of the Sobol
# sequence) at six random points each. BIN: the folder of cleft. Prints a row of CSV for each study: the least and the
# largest quotient of bound and error over points and frames, what `cleft certify` states of it at most, and the range of
# the error over the size of the displacement (in the norm of the energy, all cut).
set -eu
bin=$(realpath "$1"); here=$(cd "$(dirname "$0")" && pwd); mkdir -p "$2"; cd "$2"
"$here/make_studies.py" .
echo "study,least,largest,stated_at_most,error_from,error_to"
for name in length depth base; do
  sed -i 's/^count = 32/count = 24/' "$name.toml"
  "$bin/cleft" run "$name.toml" --out "$name" --quiet > "$name.log" 2>&1 || { tail -3 "$name.log"; exit 1; }
  python3 - "$name.toml" > "$name.csv" <<'POINTS'
import random, sys, tomllib
vary = tomllib.load(open(sys.argv[1], "rb"))["vary"]
random.seed(5)
def drawn(range):
    least, most, part = range["from"], range["to"], random.random()
    return least * (most / least) ** part if range.get("scale") == "log" else least + part * (most - least)
print(*vary, sep=",")
for _ in "123456":
    print(*(f"{drawn(range):.5g}" for range in vary.values()), sep=",")
POINTS
  "$bin/cleft" certify "$name" --points "$name.csv" --solve --json --quiet > "$name.json"
  python3 - "$name" <<'ROW'
import json, sys
found = json.load(open(sys.argv[1] + ".json"))
quotients = [frame["bound"] / frame["error"] for one in found for frame in one["frames"] if frame["length_cut_mm"] > 0]
errors = [one["frames"][-1]["error"] / one["frames"][-1]["size"] for one in found]
stated = max(one["bound_over_error_at_most"] for one in found)
print(sys.argv[1], *(f"{x:.3f}" for x in (min(quotients), max(quotients), stated, min(errors), max(errors))), sep=",")
ROW
done
