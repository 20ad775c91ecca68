#!/usr/bin/env bash
# accuracy.sh: measures the default case on this machine and writes docs/accuracy.md with its chart (minutes). Its second
# chart, whose table is copied by hand: benchmarks/elements_chart.py docs/accuracy/elements PROGRAM (20 minutes).
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

## Elements of other kinds

![chart of the opening's error over processor time](accuracy/elements.png)

One frame, the whole cut open, of the default case, of one with stiffer and thicker skin (0.36 MPa, 2.5 mm)
and of a short and deep cut (20 x 5 mm): the largest error of the opening over the largest opening, but for
the outermost fifteenths of the cut, over the processor time of assembly, factor and solution
([accuracy/elements.csv](accuracy/elements.csv); \`benchmarks/elements_chart.py\`). All kinds share one assembly
and MUMPS; of the linear elements it gives the opening of \`cleft solve\` to nine digits. The converged answer
is the mean of quadratic elements with and without quarter points, which differ by 0.0009 to 0.0013. The
machine did other work meanwhile: times may be a fifth off. An error counts as kept from the mesh on from
which no finer one exceeds it:

| processor s: default, stiff skin, short and deep | 5 % | 2 % | 1 % | 0.5 % |
|---|---|---|---|---|
| linear, ends at nodes, graded 1.3 | 1.3, 1.4, 3.8 | | | |
| linear, uniform | .03, .03, .13 | .03, 2.2, .86 | 5.6, 2.2, 24 | 5.6, 2.2, 24 |
| linear, graded 1.3, as \`cleft solve\` does | .01, .01, .03 | .06, .10, .09 | .49, .17, 1.3 | |
| linear, graded 1.15 | .02, .02, .04 | .02, .26, .14 | .52, .26, 1.1 | 1.3, .26, 10 |
| linear, graded 1.3, and 1.2 toward the fronts | .01, .01, .03 | .01, .03, .11 | .62, .14, - | |
| singular functions, ends at nodes | .42, .17, .74 | | | |
| singular functions | .05, .05, .07 | .05, .16, .15 | .41, .24, 1.7 | |
| quadratic, ends at nodes, graded 1.6 | .87, .72, .64 | 4.2, 1.0, 3.9 | | |
| quadratic, quarter points, graded 1.6 | .06, .05, .16 | .90, .10, .28 | .90, .77, 1.1 | 1.8, .77, 3.9 |
| quadratic, graded 1.6 | .12, .05, .05 | .25, .21, .63 | .25, .21, .63 | .88, .76, 1.1 |
| quadratic, graded 2 | .07, .04, .04 | .16, .15, .18 | .16, .15, .84 | .51, .47, .84 |

- Where the cut ends inside its closed nodes (all rows but those that say otherwise) matters more than the
  kind of element: every kind has its own part of an element at the front
  ([manual](architecture.md#22-the-growing-cut)), at the ends and the bottom 0.42 and 0.30 of linear ones,
  0.10 and 0.10 of quadratic ones, 0.015 and 0.02 with quarter points, 0.23 and 0.3 with singular functions.
- For 5 and 2 % the solver's linear elements are the cheapest or nearly so. Shrinking toward the fronts takes
  a quarter of the time for 2 % in two cases, more in the deep one, and serves the last frame alone, whose
  fronts are at the ends.
- For 1 and 0.5 % quadratic elements whose cut ends inside its closed nodes are, with few exceptions: they
  take a third of the linear ones' time in the default case, and err by 0.25 % where linear ones of equal time
  err by 0.9 %. One factor serves all frames of them too. Quarter points, which need a factor for each frame,
  and singular functions, which need unknowns of their own for each, gain hardly anything over that.
- Elements that grow by 1.3 away from the cut keep an error of 0.6 to 1 % however small they are at the cut:
  the largest opening of the default case is 5.513 mm, and 5.463 with the defaults (0.9 % less). Finer
  elements at the cut do not see this part; a companion of \`cleft solve\`'s estimate, whose elements grow
  faster, does: it expects 1.2 % (0.6 % without). With elements of 0.5 to 2.5 mm that grow by 1.3 and 1.15
  it expects 0.6 to 3.3 times the error, and less than it only once (1.3 for 2.0 %).

So the defaults, linear elements that grow by 1.3, are right for errors of 2 % and more of the opening but for
the outermost fifteenths of the cut. There, at the first open node, linear elements open by a tenth too much,
however small they are, and quadratic ones by a fiftieth too little: of the opening along all of the cut that
is 2.7 % of the largest in linear elements of 0.375 mm (35 processor seconds to solve and encode), and 0.9 %
in quadratic ones of 1.07 mm that grow by 1.6 (14 s), which \`cleft advise\` takes for an error of 2 %
(\`mesh.elements = "quadratic"\`, [manual](architecture.md#22-the-growing-cut)). It takes them from 3 to 5 %
down, for straight, upright cuts in small strains.
Singular functions were tried at the nodes of the front alone, not within a radius of it; frames in the middle
of the cut were not compared with them.
PAGE
