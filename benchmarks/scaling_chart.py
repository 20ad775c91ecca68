#!/usr/bin/env python3
"""scaling_chart.py SCALING.csv OUT.svg: draws what scaling.sh has measured, over ranks.

Left: millions of unknowns that a frame and a second take, by the clock (filled), without the time in which ranks wait
and send (hollow), and as many as ranks times that of one rank (grey). Right: kilobytes that a rank sends in a cycle.
"""
import csv
import math
import sys

WIDTH, HEIGHT, LEFT, TOP, PANEL, TALL, BETWEEN = 760, 330, 70, 34, 270, 230, 100
COLOURS = {"strong": "#0072b2", "weak": "#d55e00"}


def axis(values):
    """A range around positive values, as logarithms."""
    low, high = math.log10(min(values)), math.log10(max(values))
    margin = max(0.08, 0.08 * (high - low))
    return low - margin, high + margin


def ticks(low, high):
    steps = [1, 2, 5] if high - low < 2.5 else [1]
    found = [s * 10.0**e for e in range(math.floor(low), math.ceil(high) + 1) for s in steps
             if low <= math.log10(s * 10.0**e) <= high]
    return found if len(found) > 1 else [float(f"{10**at:.2g}") for at in (low + 0.04, high - 0.04)]


class Panel:
    def __init__(self, svg, left, ranks, values, title):
        self.svg, self.left = svg, left
        self.across, self.up = axis(ranks), axis(values)
        svg.append(f'<rect x="{left}" y="{TOP}" width="{PANEL}" height="{TALL}" fill="none" stroke="#999"/>')
        svg.append(f'<text x="{left}" y="{TOP - 12}">{title}</text>')
        for rank in sorted(set(ranks)):
            svg.append(f'<text x="{self.x(rank):.1f}" y="{TOP + TALL + 18}" text-anchor="middle">{rank:g}</text>')
        for value in ticks(*self.up):
            svg.append(f'<text x="{left - 6}" y="{self.y(value) + 4:.1f}" text-anchor="end">{value:g}</text>')
            svg.append(f'<path d="M{left},{self.y(value):.1f} h{PANEL}" stroke="#ddd"/>')
        svg.append(f'<text x="{left + PANEL / 2}" y="{TOP + TALL + 40}" text-anchor="middle">ranks</text>')

    def x(self, rank):
        low, high = self.across
        return self.left + (math.log10(rank) - low) / (high - low) * PANEL

    def y(self, value):
        low, high = self.up
        return TOP + TALL - (math.log10(value) - low) / (high - low) * TALL

    def curve(self, points, colour, filled=True, dashed=False):
        if not points:
            return
        line = " ".join(f"{self.x(r):.1f},{self.y(v):.1f}" for r, v in points)
        dash = ' stroke-dasharray="5 4"' if dashed else ""
        self.svg.append(f'<polyline points="{line}" fill="none" stroke="{colour}" stroke-width="1.6"{dash}/>')
        for r, v in [] if dashed else points:
            fill = colour if filled else "white"
            self.svg.append(f'<circle cx="{self.x(r):.1f}" cy="{self.y(v):.1f}" r="4" fill="{fill}" stroke="{colour}"/>')


def rate(row, seconds):
    return float(row["unknowns"]) / 1e6 / float(row[seconds])


def main():
    source, out = sys.argv[1:]
    with open(source) as file:
        rows = [{**row, "ranks": int(row["ranks"])} for row in csv.DictReader(file)]
    svg = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" '
           'font-family="DejaVu Sans, sans-serif" font-size="12">',
           f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>']
    ranks = [row["ranks"] for row in rows]
    one = max(rate(row, "frame_s") for row in rows if row["ranks"] == min(ranks)) / min(ranks)
    ideal = [(r, one * r) for r in sorted(set(ranks))]
    rates = [rate(row, column) for row in rows for column in ("frame_s", "frame_computing_s")]
    speed = Panel(svg, LEFT, ranks, rates + [v for _, v in ideal], "million unknowns a frame and second")
    sent = [(row["kind"], row["ranks"], float(row["kilobytes_a_cycle"])) for row in rows if row["ranks"] > 1]
    volume = Panel(svg, LEFT + PANEL + BETWEEN, ranks, [v for _, _, v in sent] or [1], "kilobytes a rank sends in a cycle")
    speed.curve(ideal, "#888", dashed=True)
    for place, (kind, colour) in enumerate(COLOURS.items()):
        own = sorted((row for row in rows if row["kind"] == kind), key=lambda row: row["ranks"])
        speed.curve([(row["ranks"], rate(row, "frame_s")) for row in own], colour)
        speed.curve([(row["ranks"], rate(row, "frame_computing_s")) for row in own], colour, filled=False)
        volume.curve([(r, v) for k, r, v in sent if k == kind], colour)
        svg.append(f'<text x="{LEFT + 10 + 70 * place}" y="{HEIGHT - 6}" fill="{colour}">{kind}</text>')
    svg.append(f'<text x="{LEFT + 150}" y="{HEIGHT - 6}">filled: by the clock; hollow: without waiting and sending</text>')
    with open(out, "w") as file:
        file.write("\n".join(svg + ["</svg>"]) + "\n")


if __name__ == "__main__":
    main()
