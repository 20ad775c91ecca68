#!/usr/bin/env bash
# page.sh [PRESET]: builds what docs/validation.md is measured with, and writes the page (minutes).
set -eu
cd "$(dirname "$0")/../../.."
preset=${1:-release}
[ -d "build/$preset" ] || cmake --preset "$preset" > /dev/null
cmake --build --preset "$preset" -j2 --target cleft cleft-solve cleft-body write_subject cleft-truth-excision cleft-truth-law solve_with_rule > /dev/null
python=/usr/bin/python3 && [ -x $python ] || python=python3
PYTHONDONTWRITEBYTECODE=1 "$python" tests/truth/validation/validation.py "build/$preset/bin" --page docs/validation.md
git --no-pager diff --stat -- docs/validation.md
