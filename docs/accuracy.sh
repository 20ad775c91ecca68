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

Of the default case (\`cleft solve --help\`), on $(nproc) threads of a machine with "$machine". Made by \`docs/accuracy.sh\`;
\`cleft chart DIR\` draws the same of any study.

![charts of error over size, time and rate](accuracy/chart.png)

- Encoded case, encoding, evaluation: the largest error at any node and frame over the largest displacement. zfp is given the
  errors that the default parametrisation reached; it decodes whole arrays, which is its time for a point, and has no
  values between nodes.
- Simulation: the largest error of the opening, over the cut and over time, against the finest mesh, and of a slit in a
  sheet against its closed form, the middle's opening 4 a tension / E.
- Replay: cuts that are curved, tilted, longer or beside another one, replayed with the case's field, against the solver's
  own simulations of them: the largest error of the opening (over frame time, of any vertex of the skin) over the largest
  opening. "tension turned": three fields of other prestress, superposed as the tension turns against the path. Frame time
  is that of all vertices of the patch's skin.
- Force: a blade that presses, slides, trembling at 5 Hz, and leaves, against 8,000 ticks a second. Below the default 1,000
  the energy observer takes force away to stay passive.

The numbers are in [accuracy/chart.csv](accuracy/chart.csv). More on replayed and simulated cuts:
[tests/truth](../tests/truth/README.md). Where methods fail: [stability.md](stability.md).
PAGE
