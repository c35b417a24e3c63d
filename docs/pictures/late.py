#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws how late edges came, as SVG, from what step_port_bench measured.

    build/release/bin/step_port_bench --benchmark_format=json > late.json
    docs/pictures/late.py late.json > docs/pictures/late.svg

One row of bars a rate and time of spinning; a bar is the share of the edges that were late by less than the time under it (and by
more than the one to its left), on a logarithmic scale, so that one of a hundred thousand is seen. Python's standard library only."""
import json
import math
import sys

LEFT, TOP, BAR, HEIGHT, STEP, OCTAVES = 150, 40, 34, 70, 92, 14
LEAST = 1e-6


def text(x, y, content, anchor="middle", size=11):
    return f'<text x="{x}" y="{y}" text-anchor="{anchor}" font-size="{size}">{content}</text>'


def name_of(run):
    values = dict(part.split(":") for part in run["name"].split("/") if ":" in part)
    return f'{int(values["steps_s"]):,} steps/s', f'{values["spin_us"]} us spinning'


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        runs = json.load(file)["benchmarks"]
    width, height = LEFT + OCTAVES * BAR + 20, TOP + STEP * len(runs) + 20
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif">',
           f'<rect width="{width}" height="{height}" fill="white"/>',
           text(width / 2, 20, "share of the edges by how late they came (logarithmic, from 1 of 1,000,000)", size=13)]
    for row, run in enumerate(runs):
        base = TOP + STEP * row + HEIGHT
        total = sum(value for key, value in run.items() if key.startswith("octave "))
        for line, part in enumerate(name_of(run)):
            out.append(text(LEFT - 10, base - 40 + 16 * line, part, "end", 12))
        out.append(text(LEFT - 10, base - 8, f'worst {run["worst_us"]:.0f} us', "end", 10))
        out.append(f'<line x1="{LEFT}" y1="{base}" x2="{LEFT + OCTAVES * BAR}" y2="{base}" stroke="#999"/>')
        for octave in range(OCTAVES):
            x = LEFT + octave * BAR
            share = run.get(f"octave {octave}", 0) / total
            if share > 0:
                tall = HEIGHT * max(0.02, 1 - math.log(share) / math.log(LEAST))
                colour = "#2a7f9e" if octave <= 6 else "#d1495b"
                out.append(f'<rect x="{x + 2}" y="{base - tall:.1f}" width="{BAR - 4}" height="{tall:.1f}" fill="{colour}"/>')
            label = f"{2**octave} us" if octave < 10 else f"{2**octave / 1024:.0f} ms"
            out.append(text(x + BAR / 2, base + 12, label, size=9))
    print("\n".join(out + ["</svg>"]))


if __name__ == "__main__":
    main()
