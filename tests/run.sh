#!/usr/bin/env bash
# run.sh [CTEST OPTION...]: installs what is missing, builds, and runs every test. `./tests/run.sh -R Field` runs some.
# An existing build tree is used again. PRESET=debug ./tests/run.sh takes another preset of CMakePresets.json.
set -eu
cd "$(dirname "$0")/.."
preset=${PRESET:-release}
./setup/install.sh tests
cmake --preset "$preset" -DCLEFT_TESTS=ON > /dev/null
cmake --build --preset "$preset"
ctest --preset "$preset" "$@"
