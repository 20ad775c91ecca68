#!/usr/bin/env python3
"""draw_break.py PLACES.csv VALUES.csv OUT.svg: draws the displacement across the cut along a line on the skin, over v.

PLACES has the columns u, v, w, side, t of `cleft eval`, VALUES what it writes for them (du, dv, dw). A curve is drawn
for each t and each side of the cut.
"""
import csv
import sys

WIDTH, HEIGHT, LEFT, BOTTOM, TOP, RIGHT = 640, 300, 60, 46, 16, 150
COLOURS = ["#0072b2", "#d55e00", "#009e73"]


def main():
    places, values, out = sys.argv[1:]
    with open(places) as file:
        at = list(csv.DictReader(file))
    with open(values) as file:
        moved = list(csv.DictReader(file))
    curves = {}
    for place, value in zip(at, moved):
        curves.setdefault((float(place["t"]), int(place["side"])), []).append((float(place["v"]), float(value["dv"])))
    times = sorted({t for t, _ in curves})
    reach = max(abs(v) for curve in curves.values() for v, _ in curve)
    most = 1.1 * max(abs(d) for curve in curves.values() for _, d in curve)
    u = float(at[0]["u"])

    def x(v):
        return LEFT + (v + reach) / (2 * reach) * (WIDTH - LEFT - RIGHT)

    def y(d):
        return TOP + (most - d) / (2 * most) * (HEIGHT - TOP - BOTTOM)

    svg = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" '
           'font-family="DejaVu Sans, sans-serif" font-size="12">',
           f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>',
           f'<path d="M{x(-reach)},{y(0):.1f} H{x(reach)} M{x(0):.1f},{TOP} V{HEIGHT - BOTTOM}" stroke="#999"/>']
    for k in range(5):
        v = reach * (k - 2) / 2
        svg.append(f'<text x="{x(v):.1f}" y="{HEIGHT - BOTTOM + 16}" text-anchor="middle">{v:g}</text>')
        d = most / 1.1 * (k - 2) / 2
        svg.append(f'<text x="{LEFT - 6}" y="{y(d) + 4:.1f}" text-anchor="end">{d:.2g}</text>')
    svg.append(f'<text x="{x(0):.1f}" y="{HEIGHT - 10}" text-anchor="middle">v, mm (across the cut)</text>')
    svg.append(f'<text x="14" y="{y(0):.1f}" text-anchor="middle" transform="rotate(-90 14 {y(0):.1f})">'
               'displacement along v, mm</text>')
    for (t, side), curve in sorted(curves.items()):
        colour = COLOURS[times.index(t)]
        points = " ".join(f"{x(v):.1f},{y(d):.1f}" for v, d in sorted(curve))
        svg.append(f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="1.8"/>')
    for k, t in enumerate(times):
        svg.append(f'<text x="{x(reach) + 14:.1f}" y="{TOP + 20 + 20 * k}" fill="{COLOURS[k]}">u = {u:g} mm, t = {t:g} mm'
                   '</text>')
    with open(out, "w") as file:
        file.write("\n".join(svg + ["</svg>"]) + "\n")


if __name__ == "__main__":
    main()
