#!/usr/bin/env bash
# make_figures.sh [BUILD]: makes the pictures of the manual with the commands of the program: the study of
# examples/demo.sh, its patch, the lattice of its field at two times, the constraints of its simulation, the
# parametrisation volume on a head, and curves of the field across the cut.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
build=${1:-$root/build/release}
work=${CLEFT_FIGURES:-$build/figures}  # a finished study there is used again
mkdir -p "$work"
cd "$work"
"$build/bin/make-head" --out head.stl --path path.csv > /dev/null
"$build/bin/cleft" run "$root/examples/demo.toml" --out study > /dev/null
cat > figures.txt <<SCRIPT
open study
case 3
time 34
camera 12 -52 1.15
screenshot patch.png 800 500
figure constraints
time 20
camera 12 -52 1.25
screenshot constraints.png 600 375
camera 12 -52 1.15
figure lattice
time 10
screenshot lattice-10.png 800 500
time 30
screenshot lattice-30.png 800 500
figure off
mesh head.stl
cut-file path.csv
time 34
camera -38 12 2
figure volume
screenshot volume.png 800 600
SCRIPT
env -u DISPLAY "$build/bin/cleft" explore --script figures.txt > /dev/null
case=$(find study/cases -name case.dffd | sort | head -1)
awk 'BEGIN { print "u,v,w,side,t"; for (t = 10; t <= 30; t += 20) for (side = -1; side <= 1; side += 2)
  for (i = 0; i <= 100; ++i) printf "4,%.3f,0,%d,%d\n", side * 20 * i / 100, side, t }' > places.csv
"$build/bin/cleft" eval "$case" < places.csv > values.csv
"$here/draw_break.py" places.csv values.csv "$here/break.svg"
cp patch.png constraints.png lattice-10.png lattice-30.png volume.png "$here/"
