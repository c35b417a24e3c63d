#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws a corner of 60 degrees as LinuxCNC's planner and splinefeed_tp.so pass it: the path, and the speed over time, as SVG.

    docs/pictures/linuxcnc_corner.py docs/pictures/linuxcnc_corner.json > linuxcnc_corner.svg

The file has the positions of each servo period of 1 ms in LinuxCNC 2.9, as bench/linuxcnc_tp.py --keep records them."""
import json
import math
import pathlib
import sys

from drawing import BLACK, BLUE, ORANGE, VERMILLION, Frame, document, legend, line, text

WIDTH, HEIGHT = 960, 350
PLANNERS = [("linuxcnc", "LinuxCNC's planner", VERMILLION), ("splinefeed", "splinefeed", BLUE)]


def path(data):
    frame = Frame((70, 70, 350, 230), (19.0, 20.4), (-0.18, 0.74))
    out = frame.drawn("the path near the corner, tolerance 0.1 mm", "mm", 4, 4)
    out.append(line([frame.at(19.0, 0.0), frame.at(20.0, 0.0), frame.at(20.4, 0.6928)], BLACK, 1, "2 3"))
    x, y = frame.at(20.0, 0.0)
    out.append(f'<ellipse cx="{x:.1f}" cy="{y:.1f}" rx="{frame.at(20.1, 0)[0] - x:.1f}" ry="{y - frame.at(20, 0.1)[1]:.1f}" fill="none" stroke="{ORANGE}"/>')
    for name, _, colour in PLANNERS:
        inside = [(a, b) for a, b in zip(*data[name]) if 19.0 <= a <= 20.4 and b <= 0.74]
        out.append(frame.curve(inside, colour, 2))
    return out


def speed(data):
    frame = Frame((500, 70, 410, 230), (0.0, 0.65), (0.0, 110.0))
    out = frame.drawn("speed, mm/s", "s", 5, 6) + frame.limit(100.0, "feed")
    for name, _, colour in PLANNERS:
        xs, ys = data[name]
        rate = 1.0 / data["period_s"]
        speeds = [rate * math.hypot(c - a, d - b) for a, b, c, d in zip(xs, ys, xs[1:], ys[1:])]
        out.append(frame.curve([(i * data["period_s"], v) for i, v in enumerate(speeds)], colour, 2))
        x, y = frame.at(len(speeds) * data["period_s"], 0.0)
        out.append(text(x + (3 if name == "linuxcnc" else -3), y - 6, f"{len(speeds) * data['period_s']:.3f} s", "middle", colour, 11))
    return out


def main():
    data = json.loads(pathlib.Path(sys.argv[1]).read_text())
    names = [(name, colour, "") for _, name, colour in PLANNERS]
    print(document(WIDTH, HEIGHT, path(data) + speed(data) + legend(70, 30, names, 190)))


if __name__ == "__main__":
    main()
