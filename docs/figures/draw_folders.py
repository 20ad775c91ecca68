#!/usr/bin/env python3
"""draw_folders.py ROOT [--check]: draws docs/figures/folders.svg, the folders of the sources and their dependencies.

The folders are those that tests/includes/check_includes.sh lists. An arrow leads from a folder to a folder whose
headers it includes. An arrow that follows from others (A includes B and C, and B includes C) is left out, and so are
the arrows to base, which every folder may include. The picture depends on the sources alone: the same sources give
the same bytes. With --check nothing is written; the exit code is 1 if the committed picture is out of date.
"""
import re
import sys
from pathlib import Path

TOP = ["base", "params", "solver", "encoder", "haptic", "explorer", "tradeoff", "cli", "examples",
       "python"]
FILL = {"base": "#e8e8e8", "params": "#fdf0c4", "solver": "#fbd9c6", "encoder": "#d3e6f5", "haptic": "#e9d7ee",
        "explorer": "#d6edd2", "tradeoff": "#f6d5dd", "cli": "#e8e8e8", "examples": "#e8e8e8",
        "python": "#e8e8e8"}
CHARACTER, HEIGHT, GAP, LAYER, MARGIN, WIDTH = 7.3, 26, 18, 66, 20, 940


def folders_of(root):
    """The folders in the list of the include check, longest names first."""
    text = (root / "tests/includes/check_includes.sh").read_text()
    listed = re.search(r"<<'PARTS'\n(.*?)\nPARTS", text, re.S).group(1)
    return sorted((line.split(":")[0] for line in listed.splitlines()), key=lambda name: (-len(name), name))


def owner(path, folders):
    """The innermost listed folder that holds a path relative to the root; None for other paths."""
    return next((folder for folder in folders if path.startswith(folder + "/")), None)


def dependencies_of(root, folders):
    """For each folder the other folders whose headers its files include."""
    uses = {folder: set() for folder in folders}
    for top in TOP:
        for file in sorted((root / top).rglob("*")):
            if file.suffix not in (".h", ".cpp"):
                continue
            source = owner(file.relative_to(root).as_posix(), folders)
            for header in re.findall(r'^#include "([^"]+)"', file.read_text(), re.M):
                target = owner(header, folders)
                if source and target and target != source and target.split("/")[0] != "base":
                    uses[source].add(target)
    return {folder: used for folder, used in uses.items() if folder.split("/")[0] != "base"}


def reachable(folder, uses):
    seen, stack = set(), [folder]
    while stack:
        for target in uses[stack.pop()]:
            if target not in seen:
                seen.add(target)
                stack.append(target)
    return seen


def reduced(uses):
    """Without the arrows that follow from others. The include check excludes cycles."""
    return {folder: {target for target in used
                     if not any(target in reachable(other, uses) for other in used if other != target)}
            for folder, used in uses.items()}


def layers_of(uses):
    """Layer 0: folders that use no other; each further layer uses folders of the layers below it."""
    level = {}

    def find(folder):
        if folder not in level:
            level[folder] = 1 + max((find(target) for target in uses[folder]), default=-1)
        return level[folder]

    for folder in sorted(uses):
        find(folder)
    return level


def width_of(folder):
    return CHARACTER * len(folder) + 16


def ways_of(uses, level):
    """Each arrow as the list of its nodes: where it passes a layer, a node (source, target, layer) keeps room for it."""
    return {(f, g): [f] + [(f, g, n) for n in range(level[f] - 1, level[g], -1)] + [g]
            for f in sorted(uses) for g in sorted(uses[f])}


def placed(uses, level, ways):
    """The centre of each node. The order in a layer follows the mean place of the neighbours."""
    rows = [sorted((f for f in uses if level[f] == n), key=lambda f: (TOP.index(f.split("/")[0]), f))
            for n in range(max(level.values()) + 1)]
    neighbours = {f: [] for f in uses}
    for way in ways.values():
        for node in way[1:-1]:
            rows[node[2]].append(node)
        for upper, lower in zip(way, way[1:]):
            neighbours.setdefault(upper, []).append(lower)
            neighbours.setdefault(lower, []).append(upper)
    x = {}

    def spread(row):
        wide = [width_of(node) if isinstance(node, str) else 4 for node in row]
        total = sum(wide) + GAP * (len(row) - 1)
        extra = min(40.0, max(0.0, (WIDTH - 2 * MARGIN - total) / (len(row) + 1)))
        at = (WIDTH - total - extra * (len(row) - 1)) / 2
        for node, own in zip(row, wide):
            x[node] = round(at + own / 2, 1)
            at += own + GAP + extra

    for row in rows:
        spread(row)
    for _ in range(24):
        for row in rows + rows[::-1]:
            near = {node: sum(x[other] for other in neighbours[node]) / max(1, len(neighbours[node])) for node in row}
            row.sort(key=lambda node: (round(near[node], 3), str(node)))
            spread(row)
    place = {}
    for n, row in enumerate(rows):
        for node in row:
            place[node] = (x[node], MARGIN + HEIGHT / 2 + (len(rows) - 1 - n) * LAYER)
    return place


def drawn(uses, level):
    ways = ways_of(uses, level)
    place = placed(uses, level, ways)
    height = MARGIN * 2 + HEIGHT + max(level.values()) * LAYER + 30
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{height}" '
           f'viewBox="0 0 {WIDTH} {height}" font-family="DejaVu Sans Mono, monospace" font-size="12">',
           f'<rect width="{WIDTH}" height="{height}" fill="white"/>',
           '<defs><marker id="head" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7" '
           'orient="auto"><path d="M0,0 L8,4 L0,8 z" fill="#555"/></marker></defs>']
    for way in ways.values():
        points = [place[node] for node in way]
        x0, y0 = points[0]
        curve = f"M{x0:.1f},{y0 + HEIGHT / 2:.1f}"
        for upper, lower, node in zip(points, points[1:], way[1:]):
            top = upper[1] + HEIGHT / 2
            bottom = lower[1] - HEIGHT / 2
            bend = (bottom - top) / 2
            curve += (f" C{upper[0]:.1f},{top + bend:.1f} {lower[0]:.1f},{bottom - bend:.1f} "
                      f"{lower[0]:.1f},{bottom:.1f}")
            if not isinstance(node, str):
                curve += f" L{lower[0]:.1f},{lower[1] + HEIGHT / 2:.1f}"
        out.append(f'<path d="{curve}" fill="none" stroke="#555" stroke-width="1.1" marker-end="url(#head)"/>')
    for folder in sorted(uses):
        (x, y), wide = place[folder], width_of(folder)
        out.append(f'<rect x="{x - wide / 2:.1f}" y="{y - HEIGHT / 2:.1f}" width="{wide:.1f}" height="{HEIGHT}" '
                   f'rx="5" fill="{FILL[folder.split("/")[0]]}" stroke="#555"/>')
        out.append(f'<text x="{x:.1f}" y="{y + 4:.1f}" text-anchor="middle">{folder}</text>')
    out.append(f'<text x="{MARGIN}" y="{height - 12}" font-size="11" fill="#555">An arrow: includes headers of. '
               'Arrows that follow from others, and those to base, are left out.</text>')
    return "\n".join(out + ["</svg>"]) + "\n"


def main():
    root = Path(sys.argv[1])
    folders = folders_of(root)
    uses = reduced(dependencies_of(root, folders))
    picture, file = drawn(uses, layers_of(uses)), root / "docs/figures/folders.svg"
    if "--check" not in sys.argv:
        file.write_text(picture)
    elif not file.exists() or file.read_text() != picture:
        sys.exit("docs/figures/folders.svg does not show the includes of the sources; renew it: "
                 "docs/figures/draw_folders.py .")


if __name__ == "__main__":
    main()
