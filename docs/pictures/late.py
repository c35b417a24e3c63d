#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws how late edges came, as SVG, from what step_port_bench measured.

    build/release/bin/step_port_bench --benchmark_format=json > late.json
    docs/pictures/late.py late.json > docs/pictures/late.svg

Each row of bars is a step rate and a time of spinning. A bar is the share of the edges that were late by less than the time under it and
by more than the one to its left, on a logarithmic scale. Python's standard library only."""
import json
import math
import sys

from drawing import BLACK, BLUE, GREY, GRID, ORANGE, VERMILLION, document, line, text

LEFT, TOP, BAR, HEIGHT, STEP, OCTAVES = 190, 74, 40, 66, 84, 17
DECADES = 6  # 1 of a million is the least share that is drawn
LATE = 7     # bars from here on are beyond the default of tolerated_late_us, 100 us, by more than a half


def name_of(run):
    values = dict(part.split(":") for part in run["name"].split("/") if ":" in part)
    return f'{int(values["steps_s"]):,} steps/s', f'{values["spin_us"]} us spinning'


def row_of(run, top):
    base = top + HEIGHT
    total = sum(value for key, value in run.items() if key.startswith("octave "))
    out = []
    for decade in range(0, DECADES + 1, 2):
        y = top + HEIGHT * decade / DECADES
        out.append(line([(LEFT, y), (LEFT + OCTAVES * BAR, y)], GRID if decade < DECADES else GREY, 1))
        out.append(text(LEFT - 5, y + 4, ["100 %", "1 %", "100 ppm", "1 ppm"][decade // 2], "end", GREY, 10))
    for number, part in enumerate(name_of(run)):
        out.append(text(LEFT - 56, top + 26 + 17 * number, part, "end", size=12))
    for octave in range(OCTAVES):
        share = run.get(f"octave {octave}", 0) / total
        if share > 0:
            tall = HEIGHT * max(0.02, 1 + math.log10(share) / DECADES)
            colour = BLUE if octave < LATE else ORANGE
            out.append(f'<rect x="{LEFT + octave * BAR + 3}" y="{base - tall:.1f}" width="{BAR - 6}" height="{tall:.1f}" fill="{colour}"/>')
    x = LEFT + BAR * min(OCTAVES, max(0.0, math.log2(run["worst_us"]) + 1))
    out.append(f'<path d="M{x:.1f} {base - 9}l5 9h-10z" fill="{VERMILLION}" stroke="{BLACK}" stroke-width="0.6"/>')
    return out


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        runs = json.load(file)["benchmarks"]
    out = [text(LEFT, 22, "Share of the edges by how late they came (logarithmic scale)", size=14)]
    for x, colour, name in ((LEFT, BLUE, "up to 64 us late"), (LEFT + 150, ORANGE, "more than 64 us late")):
        out += [f'<rect x="{x}" y="38" width="14" height="12" fill="{colour}"/>', text(x + 20, 49, name)]
    out += [f'<path d="M{LEFT + 337} 38l6 12h-12z" fill="{VERMILLION}" stroke="{BLACK}" stroke-width="0.6"/>',
            text(LEFT + 350, 49, "the latest edge")]
    for number, run in enumerate(runs):
        out += row_of(run, TOP + STEP * number)
    base = TOP + STEP * (len(runs) - 1) + HEIGHT
    for octave in range(OCTAVES):
        label = f"{2**octave} us" if octave < 10 else f"{2**octave // 1024} ms"
        out.append(text(LEFT + (octave + 1) * BAR, base + 15, label, "middle", GREY, 10))
    out.append(text(LEFT + OCTAVES * BAR, base + 31, "late by less than", "end", GREY, 11))
    print(document(LEFT + OCTAVES * BAR + 24, base + 42, out))


if __name__ == "__main__":
    main()
