#!/usr/bin/env python3
"""elements_chart.py OUT [PROGRAM]: errors of the opening over processor seconds, of elements of several kinds.

Runs PROGRAM, cleft-benchmark-elements, for three cases, and writes OUT.csv (20 minutes); without it, reads that. Draws
the chart OUT.svg and OUT.png, and prints which time keeps an error, as tables in Markdown. A point is one frame, the whole cut open: assembly, factor and solution. The error is the largest one of the opening but for the
outermost fifteenths of the cut, over the largest opening; between nodes the opening over sqrt(s (L - s)) is interpolated
linearly. The converged answer is the mean of two kinds in elements of L / 40, whose difference is printed: quadratic
ones with and without quarter points.
"""
import csv
import json
import os
import subprocess
import sys

import matplotlib
import numpy

matplotlib.use("Agg")
import matplotlib.pyplot as pyplot

CASES = {
    "default": {},
    "stiff skin": {"skin.young_modulus": 0.36, "skin.thickness": 2.5},
    "short and deep": {"cut.length": 20, "cut.depth": 5},
}
LINEAR = [(8, 1), (12, 2), (16, 2), (24, 3), (31, 4), (47, 5), (62, 7)]
QUADRATIC = [(4, 1), (6, 1), (8, 1), (12, 1), (16, 2), (24, 3), (32, 4)]
# name: kind, growth, toward the fronts, parts of elements at the ends and at the bottom, elements, colour, marker
VARIANTS = {
    "linear, ends at nodes, graded 1.3": ("linear", 1.3, 1, 0, 0, LINEAR, "#999999", "x"),
    "linear, uniform": ("linear", 1.0, 1, 0.42, 0.3, LINEAR[:5], "#e69f00", "v"),
    "linear, graded 1.3 (cleft solve)": ("linear", 1.3, 1, 0.42, 0.3, LINEAR, "#0072b2", "o"),
    "linear, graded 1.15": ("linear", 1.15, 1, 0.42, 0.3, LINEAR, "#56b4e9", "s"),
    "linear, graded 1.3, 1.2 toward the fronts": ("linear", 1.3, 1.2, 0.42, 0.3, LINEAR[:5], "#000000", "+"),
    "singular functions, ends at nodes, graded 1.3": ("enriched", 1.3, 1, 0, 0, LINEAR[:6], "#f0c808", "x"),
    "singular functions, graded 1.3": ("enriched", 1.3, 1, 0.23, 0.3, LINEAR[:6], "#a08000", "D"),
    "quadratic, ends at nodes, graded 1.6": ("quadratic", 1.6, 1, 0, 0, QUADRATIC, "#cc79a7", "x"),
    "quadratic, quarter points, graded 1.6": ("quarter", 1.6, 1, 0.015, 0.02, QUADRATIC, "#d55e00", "^"),
    "quadratic, graded 1.6": ("quadratic", 1.6, 1, 0.1, 0.1, QUADRATIC, "#009e73", "o"),
    "quadratic, graded 2": ("quadratic", 2, 1, 0.1, 0.1, QUADRATIC, "#66c2a5", "s"),
}
AIMS = [0.05, 0.02, 0.01, 0.005]
FINEST = (40, 5)


def run(program, kind, sizes, growth, towards, end, bottom, case):
    settings = [f"{name}={value}" for name, value in case.items()]
    arguments = [str(a) for a in (kind, *sizes, growth, towards, end, bottom)]
    alone = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    done = subprocess.run([program, *arguments, *settings], check=True, capture_output=True, text=True, env=alone)
    return json.loads(done.stdout)


def curve(result, length, places):
    along = numpy.array(result["along"])
    over_root = numpy.array(result["opening"]) / numpy.sqrt(along * (length - along))
    return numpy.interp(places, along, over_root) * numpy.sqrt(places * (length - places))


def deepened(sizes, case):
    """Elements in the depth as long as along the cut, as in the default case."""
    length, depth = case.get("cut.length", 30), case.get("cut.depth", 3)
    along, down = sizes
    return (along, down) if not case else (along, max(1, round(along * depth / length)))


def measure(program):
    rows = []
    for name, case in CASES.items():
        length = case.get("cut.length", 30)
        places = length * numpy.linspace(1 / 15, 14 / 15, 261)
        finest = [curve(run(program, kind, deepened(FINEST, case), 1.3, 1, end, bottom, case), length, places)
                  for kind, end, bottom in (("quadratic", 0.1, 0.1), ("quarter", 0.015, 0.02))]
        truth = sum(finest) / 2
        apart = abs(finest[0] - finest[1]).max() / truth.max()
        print(f"{name}: {truth.max():.4f} mm, two kinds apart by {apart:.4f}", flush=True)
        for variant, (kind, growth, towards, end, bottom, sizes, *_) in VARIANTS.items():
            for size in sizes:
                size = deepened(size, case)
                results = [run(program, kind, size, growth, towards, end, bottom, case)]
                if results[0]["unknowns"] < 60000:
                    results += [run(program, kind, size, growth, towards, end, bottom, case) for _ in range(2)]
                found = curve(results[0], length, places)
                seconds = sorted(r["assembly"] + r["solution"] for r in results)[len(results) // 2]
                rows.append({"case": name, "variant": variant, "along": size[0], "down": size[1],
                             "unknowns": results[0]["unknowns"], "processor_s": f"{seconds:.4g}",
                             "error": f"{abs(found - truth).max() / truth.max():.5f}",
                             "error_of_largest": f"{found.max() / truth.max() - 1:.5f}"})
    return rows


def cheapest(rows):
    """Prints a table in Markdown: by variant the seconds from which on all finer meshes keep the error."""
    for name in CASES:
        print(f"\n| {name} | " + " | ".join(f"{100 * aim:g} %" for aim in AIMS) + " |\n|---" + "|---" * len(AIMS) + "|")
        for variant in VARIANTS:
            own = [(float(r["processor_s"]), float(r["error"])) for r in rows if (r["case"], r["variant"]) == (name, variant)]
            cells = []
            for aim in AIMS:
                kept = [s for i, (s, _) in enumerate(own) if all(e <= aim for _, e in own[i:])]
                cells.append(f"{kept[0]:.2g}" if kept else "")
            print(f"| {variant} | " + " | ".join(cells) + " |")


def draw(rows, out):
    figure, axes = pyplot.subplots(1, len(CASES), figsize=(15, 5.6), sharey=True)
    for axis, name in zip(axes, CASES):
        for variant, (*_, colour, marker) in VARIANTS.items():
            own = [r for r in rows if (r["case"], r["variant"]) == (name, variant)]
            axis.loglog([float(r["processor_s"]) for r in own], [100 * float(r["error"]) for r in own], marker=marker,
                        color=colour, label=variant, linewidth=1.3, markersize=5)
        axis.set_title(name)
        axis.set_xlabel("processor seconds of a frame")
        axis.set_yticks([100 * a for a in AIMS] + [10, 0.2], labels=[f"{100 * a:g}" for a in AIMS] + ["10", "0.2"])
        axis.minorticks_off()
        axis.grid(True, color="#dddddd")
    axes[0].set_ylabel("largest error of the opening, %")
    figure.legend(*axes[0].get_legend_handles_labels(), loc="lower center", ncol=3, frameon=False)
    figure.tight_layout(rect=(0, 0.14, 1, 1))
    figure.savefig(f"{out}.svg")
    figure.savefig(f"{out}.png", dpi=110)


def main():
    out, *program = sys.argv[1:]
    if program:
        rows = measure(program[0])
        with open(f"{out}.csv", "w", newline="") as file:
            table = csv.DictWriter(file, rows[0], lineterminator="\n")
            table.writeheader()
            table.writerows(rows)
    with open(f"{out}.csv") as file:
        rows = list(csv.DictReader(file))
    cheapest(rows)
    draw(rows, out)


if __name__ == "__main__":
    main()
