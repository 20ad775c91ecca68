#!/usr/bin/env bash
# gallery.sh [BUILD]: takes the pictures of docs/gallery anew: the window under Xvfb in two sizes, and a face-lift without
# a display. The study is that of examples/demo.sh.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
build=${1:-$root/build/release}
work=$build/gallery
mkdir -p "$work" "$root/docs/gallery"; chmod 700 "$work"
cd "$work"
"$build/bin/make-head" --out head.stl --path path.csv > /dev/null
"$build/bin/cleft" run "$root/examples/demo.toml" --out study > /dev/null
export XDG_CONFIG_HOME=$work/settings XDG_RUNTIME_DIR=$work  # not the user's
export CLEFT_BIN=$build/bin
for size in 1280x720 1920x1080; do
  rm -rf settings
  mkdir -p "$root/docs/gallery/$size"
  xvfb-run -a -s "-screen 0 ${size}x24" "$build/tests/cleft-gallery" "$root/tests/app/gallery.txt" "$root/docs/gallery/$size" \
    "${size%x*}" "${size#*x}"
done
env -u DISPLAY "$build/bin/cleft-explore" --script "$root/tests/app/face-lift.txt"
mv face-lift-*.png "$root/docs/gallery/"
