#!/usr/bin/env bash
# accuracy.sh: measures the default case on this machine and writes docs/accuracy.md with its chart (minutes).
set -eu
here=$(cd "$(dirname "$0")" && pwd)
bin=${CLEFT_BIN:-$here/../build/release/bin}
work=$(mktemp -d); trap 'rm -rf "$work"' EXIT
printf 'name = "default"\n[case]\n' > "$work/default.toml"
"$bin/cleft" run "$work/default.toml" --out "$work/study" > /dev/null
mkdir -p "$here/accuracy"
"$bin/cleft" chart "$work/study" --out "$here/accuracy/chart.svg" > /dev/null
machine=$(sed -n 's/^model name\t: //p' /proc/cpuinfo | head -1)
cat > "$here/accuracy.md" <<PAGE
# Speed and size against accuracy

The default case (\`cleft solve --help\`), on $(nproc) threads of a machine with "$machine".
\`docs/accuracy.sh\` makes this page; \`cleft chart DIR\` draws the same for any study.

![charts of error over size, time and rate](accuracy/chart.png)

- Encoded case, encoding, evaluation: the largest error at any node and frame, relative to the largest
  displacement. zfp gets the errors that the default parametrisation reached as its bounds; it decodes whole
  arrays, which is its time for a point, and has no values between nodes.
- Simulation: the largest error of the opening, over the cut and over time, against the finest mesh, and that
  of a slit in a sheet against its closed form (the opening in the middle, 4 a tension / E). Small and finite
  strains: against finite strains (the default laws), in the finest mesh of at most an eighth as many nodes,
  whose own error of some percent is not seen.
- Replay: cuts that are curved, tilted, longer, or next to another cut, replayed with the case's field and
  compared with the solver's own simulations of them: the largest error of the opening (over frame time: of
  any vertex of the skin), relative to the largest opening. "tension turned": three fields of different
  prestress, superposed as the tension turns against the path. The frame time is that of all vertices of the
  patch's skin.
- Force: a blade that presses, slides, trembles at 5 Hz, and leaves, against 8,000 ticks a second. Below the
  default of 1,000 the passivity controller reduces the force.

[accuracy/chart.csv](accuracy/chart.csv) has the numbers. Further comparisons of replayed and simulated cuts:
[tests/truth](../tests/truth/README.md). Limits of the methods: [stability.md](stability.md).
PAGE
