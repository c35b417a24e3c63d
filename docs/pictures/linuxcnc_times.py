#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws the times of programs in LinuxCNC with splinefeed_tp.so over those with LinuxCNC's planner, as SVG.

    docs/pictures/linuxcnc_times.py hal/linuxcnc/README.md > linuxcnc_times.svg

The times are those of the page's tables."""
import pathlib
import re
import sys

from drawing import BLACK, BLUE, GREEN, GREY, ORANGE, VERMILLION, Frame, document, text

WIDTH, HEIGHT = 960, 330
CELL = re.compile(r"([\d.]+)\*? / ([\d.]+)")
TABLES = [("| program | G64 P0.01 Q0 |", ["P0.01", "P0.05", "exact path"], "no jerk limit, 2.9"),
          ("| program | G64 P0.01 | G64 P0.05", ["P0.01", "P0.05", "exact path"], "30000 mm/s^3, 2.10")]
COLOURS = [BLUE, GREEN, ORANGE]


def columns(page, head):
    """The ratios in each column of a table."""
    rows = page[page.index(head) :].split("\n\n")[0].split("\n")[2:]
    cells = [[CELL.match(cell.strip()) for cell in row.strip("|").split("|")[1:]] for row in rows if not row.startswith("| median")]
    return [[float(c[i][2]) / float(c[i][1]) for c in cells if i < len(c) and c[i]] for i in range(3)]


def main():
    page = pathlib.Path(sys.argv[1]).read_text()
    names = [f"{mode}, {of}" for _, modes, of in TABLES for mode in modes]
    ratios = [column for head, _, _ in TABLES for column in columns(page, head)]
    frame = Frame((230, 50, 690, 235), (0.0, 1.1), (0.0, len(names)))
    out = frame.drawn("time over that of LinuxCNC's planner: a dot is a program, the line is the median", "", 1, 11)
    out = [element for element in out if not element.endswith(">0</text>")] # of the scale of rows
    for i, (name, column) in enumerate(zip(names, ratios)):
        y = frame.at(0.0, len(names) - i - 0.5)[1]
        out.append(text(220, y + 4, name, "end"))
        for ratio in column:
            out.append(f'<circle cx="{frame.at(ratio, 0)[0]:.1f}" cy="{y:.1f}" r="4" fill="{COLOURS[i % 3]}" fill-opacity="0.55"/>')
        x = frame.at(sorted(column)[len(column) // 2], 0)[0]
        out.append(f'<rect x="{x - 1.5:.1f}" y="{y - 11:.1f}" width="3" height="22" fill="{BLACK}"/>')
    x, y = frame.at(1.0, 0.0)
    out.append(f'<rect x="{x - 0.5:.1f}" y="50" width="1" height="235" fill="{VERMILLION}"/>')
    for tenth in range(0, 12, 2):
        out.append(text(frame.at(tenth / 10, 0)[0], y + 16, f"{tenth / 10:g}", "middle", GREY, 11))
    print(document(WIDTH, HEIGHT, out))


if __name__ == "__main__":
    main()
