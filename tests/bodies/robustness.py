"""robustness.py BIN FOLDER [--seed N] [--meshes FOLDER] [--only NAME] [--set NAME=VALUE]...: runs cleft body along random
paths on many meshes, and prints a table in Markdown: bodies made, paths refused, thinned columns, the least determinant of
a wedge, seconds. Looks at every body itself: Jacobians at all corners of its wedges. Exit code 1 where a run crashed, ran
out of time, was refused without a message, or made wedges that are inside out."""

import argparse
import collections
import json
import pathlib
import re
import subprocess
import sys
import time

try:
    import h5py
    import numpy as np
except ImportError as missing:
    print(f"Skipped: {missing}. Debian has python3-numpy and python3-h5py.")
    sys.exit(77)

LIMIT = 60  # s for a run
CORNERS = [(a, b, c) for c in (-1, 1) for a, b in ((0, 0), (1, 0), (0, 1))]


def least_determinant(file):
    """Over all wedges: the least Jacobian of its corners over their mean."""
    with h5py.File(file, "r") as h5:
        vtk = h5["VTKHDF"]
        types, offsets, cells = vtk["Types"][:], vtk["Offsets"][:], vtk["Connectivity"][:]
        lower_first = np.array([3, 4, 5, 0, 1, 2])
        wedges = vtk["Points"][:][cells[offsets[:-1][types == 13][:, None] + lower_first]]
    all_corners = []
    for a, b, c in CORNERS:
        corner, slopes = np.array([1 - a - b, a, b]), np.array([[-1, -1], [1, 0], [0, 1]])
        shape = np.zeros((6, 3))
        for half, sign in ((slice(0, 3), -1), (slice(3, 6), 1)):
            shape[half, :2], shape[half, 2] = slopes * (1 + sign * c) / 2, corner * sign / 2
        all_corners.append(np.linalg.det(np.einsum("eni,nk->eik", wedges, shape)))
    determinants = np.array(all_corners)
    return float((determinants.min(axis=0) / np.abs(determinants.mean(axis=0))).min())


class Row:
    def __init__(self):
        self.made = self.refused = self.failed = self.thinned = self.left_out = 0
        self.least, self.angle, self.slowest, self.nodes = np.inf, np.inf, 0, 0

    def add(self, other):
        for name in ("made", "refused", "failed", "thinned", "left_out"):
            setattr(self, name, getattr(self, name) + getattr(other, name))
        self.least, self.angle = min(self.least, other.least), min(self.angle, other.angle)
        self.slowest, self.nodes = max(self.slowest, other.slowest), max(self.nodes, other.nodes)

    def text(self, name):
        least = f"{self.least:.2f} | {self.angle:.0f}" if self.made else "- | -"
        return (f"| {name} | {self.made} | {self.refused} | {self.failed} | {self.thinned} | {self.left_out} | {least} | "
                f"{self.nodes:,} | {self.slowest:.1f} |")


def without_numbers(message):
    return re.sub(r"-?\d[\d.e+-]*", "N", message)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", metavar="BIN")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--seed", default="1")
    parser.add_argument("--meshes")
    parser.add_argument("--only", default="", help="meshes that have this in their name")
    parser.add_argument("--set", action="append", default=[], metavar="NAME=VALUE")
    options = parser.parse_args()
    if options.meshes and not pathlib.Path(options.meshes).is_dir():
        print(f"{options.meshes} is not there: generated meshes only")
        options.meshes = None
    programs = pathlib.Path(options.build)
    options.folder.mkdir(exist_ok=True)
    write = [programs / "../tests/write_random_cuts", options.folder, options.seed]
    cuts = subprocess.run(write + ([options.meshes] if options.meshes else []), text=True, check=True, stdout=subprocess.PIPE)
    rows, messages, bad = collections.defaultdict(Row), collections.Counter(), []
    print("| mesh | made | refused | failed | thinned | left out | determinant | angle | "
          "most nodes | slowest, s |\n" + "|---" * 10 + "|", flush=True)
    settings = [text for value in options.set for text in ("--set", value)]
    last = None
    for line in cuts.stdout.splitlines():
        name, kind, scale, mesh, *paths = line.split("\t")
        if options.only not in name:
            continue
        if last not in (None, name):
            print(rows[last].text(last), flush=True)
        last, one, body = name, Row(), options.folder / "body.h5"
        body.unlink(missing_ok=True)
        command = [programs / "cleft", "body", "--mesh", mesh, "--scale", scale, "--out", body, "--json", *settings]
        for path in paths:
            command += ["--path", path]
        start = time.perf_counter()
        try:
            done = subprocess.run(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=LIMIT)
            code, error = done.returncode, done.stderr.strip()
        except subprocess.TimeoutExpired:
            code, error = "time", f"longer than {LIMIT} s"
        one.slowest = time.perf_counter() - start
        if code == 0:
            figures = json.loads(done.stdout)
            one.made, one.nodes, one.angle = 1, figures["nodes"], figures["least_angle_degrees"]
            one.thinned, one.left_out = figures["thinned_columns"], figures["left_out_triangles"]
            one.least = least_determinant(body)
            if one.least <= 0 or abs(one.least - figures["least_determinant"]) > 1e-3:
                one.failed = 1
                bad.append(f"{name}, {kind}: determinant {one.least:.4g}, reported {figures['least_determinant']:.4g}")
        elif code == 2 and "error: " in error and not body.exists():
            one.refused = 1
            messages[without_numbers(error.split("error: ", 1)[1].replace(str(options.folder) + "/", ""))] += 1
        else:
            one.failed = 1
            bad.append(f"{name}, {kind}: {code}: {error[-300:]}")
        rows[name].add(one)
    if not rows:
        print(f"Skipped: no mesh has {options.only} in its name")
        return 77
    if last:
        print(rows[last].text(last), flush=True)
    total = Row()
    for row in rows.values():
        total.add(row)
    print(total.text(f"all {len(rows)}"))
    print("\nRefused:\n" + "\n".join(f"- {'once' if count == 1 else f'{count} times'}: {message}" for message, count in messages.most_common()))
    print("\n".join(["\nFailed:", *bad]) if bad else "\nNone failed.")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
