#!/usr/bin/env bash
# robustness.sh [MESHES]: cleft body along random paths on generated meshes and those of a folder (some minutes); see
# robustness.py, whose options follow the folder. PRESET names another build.
set -eu
cd "$(dirname "$0")/../.."
preset=${PRESET:-release} meshes=${1:-../shared/meshes}
[ $# = 0 ] || shift
cmake --build --preset "$preset" -j2 --target cleft cleft-body write_random_cuts > /dev/null
[ ! -d "$meshes" ] || set -- --meshes "$meshes" "$@"
place=$(mktemp -d); trap 'rm -rf "$place"' EXIT
python=/usr/bin/python3 && [ -x $python ] || python=python3
PYTHONDONTWRITEBYTECODE=1 "$python" tests/bodies/robustness.py "build/$preset/bin" "$place" "$@"
