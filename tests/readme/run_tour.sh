#!/usr/bin/env bash
# run_tour.sh SOURCE BUILD: runs the commands of the README's tour as they are printed, in a folder of its own. Only the
# ones that would open a window are left out.
set -eu
source=$1 build=$2
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1  # mpirun refuses root otherwise
place=$(mktemp -d); trap 'rm -rf "$place"' EXIT
cd "$place"
mkdir build; ln -s "$build" build/release; ln -s "$source/examples" examples
sed -n '/^## A short tour/,/^## How/ s/^    //p' "$source/README.md" | grep -vE '^cleft explore [a-z]+$' > tour.sh
[ "$(wc -l < tour.sh)" -ge 9 ] || { echo "the tour was not found in README.md"; exit 1; }
bash -euxo pipefail tour.sh
[ -s wound.png ] && [ -s cut.vtp ]
