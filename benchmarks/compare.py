#!/usr/bin/env python3
"""compare.py BEFORE.json AFTER.json: what got slower beyond noise, between two files of run.sh.

Times are processor times, which other programs on the machine disturb least. They are compared by the medians of the
repetitions: slower where the ratio is beyond 5 % and beyond three times the spread (median absolute deviation) of both. Counts of work (work_...) and errors (error_...) hardly scatter: worse beyond
1 %. Exits with 1 where something is worse, with 2 where a file cannot be read.
"""
import json
import statistics
import sys


def samples_of(path):
    """{benchmark: {figure: [one for each repetition]}}"""
    try:
        with open(path, encoding="utf-8") as file:
            runs = json.load(file)["benchmarks"]
    except (OSError, ValueError, KeyError, TypeError) as error:
        print(f"compare.py: error: {path}: is no file of run.sh ({error})", file=sys.stderr)
        sys.exit(2)
    samples = {}
    for run in runs:
        if run.get("run_type") == "aggregate":
            continue
        figures = {"time": run["real_time" if "manual_time" in run["run_name"] else "cpu_time"]}
        figures.update({k: v for k, v in run.items() if k.startswith(("work_", "error_", "ms_", "us_", "ns_"))})
        for figure, value in figures.items():
            samples.setdefault(run["run_name"], {}).setdefault(figure, []).append(value)
    return samples


def spread(values):
    middle = statistics.median(values)
    return 1.4826 * statistics.median(abs(v - middle) for v in values) / middle if middle else 0


def verdict(figure, before, after):
    """The ratio of the medians, and whether it is worse, better or the same."""
    a, b = statistics.median(before), statistics.median(after)
    if a == 0:
        return (1 if b == 0 else float("inf")), "same" if b == 0 else "worse"
    counted = figure.startswith(("work_", "error_"))
    noise = 0.01 if counted else max(0.05, 3 * (spread(before) + spread(after)))
    return b / a, "worse" if b / a > 1 + noise else "better" if b / a < 1 / (1 + noise) else "same"


def main():
    if len(sys.argv) != 3:
        print("usage: compare.py BEFORE.json AFTER.json", file=sys.stderr)
        return 2
    before, after = samples_of(sys.argv[1]), samples_of(sys.argv[2])
    worse = 0
    print(f"{'benchmark':44} {'figure':18} {'before':>12} {'after':>12} {'ratio':>7}")
    for name in before:
        if name not in after:
            print(f"{name:44} is not in {sys.argv[2]}")
            continue
        for figure, values in before[name].items():
            if figure not in after[name]:
                continue
            ratio, what = verdict(figure, values, after[name][figure])
            worse += what == "worse"
            note = "" if what == "same" else "  " + what.upper()
            print(f"{name:44} {figure:18} {statistics.median(values):12.5g} "
                  f"{statistics.median(after[name][figure]):12.5g} {ratio:7.3f}{note}")
    for name in after:
        if name not in before:
            print(f"{name:44} is new")
    print(f"{worse} worse" if worse else "nothing got worse beyond noise")
    return 1 if worse else 0


if __name__ == "__main__":
    sys.exit(main())
