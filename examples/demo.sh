#!/usr/bin/env bash
# demo.sh: from nothing to an open wound. Installs what is missing, builds, runs the study examples/demo.toml and the
# family of fields examples/demo_family.toml, cuts a head along a curved path, which the family opens by the shape of the
# skin and the path, and opens the explorer; where there is no display it writes pictures instead.
# Its files are in out/demo. Run again, it does only what is left to do.
set -eu
cd "$(dirname "$0")/.."
out=out/demo
bin=build/release/bin
mkdir -p $out

step() { echo; echo "== $*"; }

step "1/5 Packages"
./setup/install.sh
echo "All packages are there."

step "2/5 Build"
fresh=-DCLEFT_TESTS=OFF
[ ! -e build/release/CMakeCache.txt ] || fresh=  # an existing build keeps its options
cmake --preset release $fresh > /dev/null
cmake --build --preset release --target commands

step "3/5 A study of four cases, and a family of fields for cuts of any shape"
$bin/cleft run examples/demo.toml --out $out/study
$bin/cleft status $out/study
$bin/cleft run examples/demo_family.toml --out $out/family

step "4/5 A head, cut along a curved path"
$bin/make-head --out $out/head.stl --path $out/path.csv
$bin/cleft cut --mesh $out/head.stl --path $out/path.csv --field $out/family/study.dffd --out $out/cut.vtp
echo "The cut head: $out/cut.vtp"

step "5/5 Explore"
if [ -n "${DISPLAY:-}" ]; then
  echo "The explorer opens; F1 shows its keys and commands. Close its window to end."
  echo "The four cases: $bin/cleft explore $out/study"
  exec $bin/cleft explore $out/family --mesh $out/head.stl --path $out/path.csv
fi
{
  echo "screenshot $out/head.png"
  for side in "front -38 12" "back 32 8"; do
    read -r name azimuth elevation <<< "$side"
    echo "camera $azimuth $elevation 2"
    for millimetres in 12 34 68; do
      echo "time $millimetres"
      echo "screenshot $out/wound-$name-$millimetres.png 900 900"
    done
  done
} > $out/pictures.txt
$bin/cleft explore $out/family --mesh $out/head.stl --path $out/path.csv --script $out/pictures.txt
sed -n 's/^screenshot \([^ ]*\).*/picture: \1/p' $out/pictures.txt
$bin/cleft explore $out/study --case 3 --screenshot $out/patch.png
echo "picture: $out/patch.png"
echo "There is no display, so pictures were written. With one, these open the explorer:"
echo "  $bin/cleft explore $out/family --mesh $out/head.stl --path $out/path.csv"
echo "  $bin/cleft explore $out/study"
