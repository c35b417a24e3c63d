#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws a run as SVG: the path coloured by speed over the waypoints, and speed and accelerations over time.

    splinefeed run PART.csv -m MACHINE.toml --trace trace.csv
    docs/pictures/run.py --trace trace.csv --machine MACHINE.toml --waypoints PART.csv > run.svg

Python's standard library only (3.11 or later).
"""
import argparse
import csv
import tomllib

from drawing import AXES, BLACK, GREY, RAMP, Frame, document, legend, line, shade, text

WIDTH, HEIGHT = 960, 440
PATH_BOX = (58, 36, 350, 330)
STEPS = 400  # pieces of one colour that the path is drawn in


def read(path):
    with open(path, newline="", encoding="utf-8") as f:
        rows = [r for r in csv.reader(f) if r and not r[0].startswith("#")]
    names = [h.strip() for h in rows[0]]
    if names[0].lstrip("+-").replace(".", "", 1).isdigit():  # waypoints without a header are x, y, z, ...
        rows.insert(0, [])
        names = list("xyzabc")[:len(names)]
    return names, [[float(x or 0) for x in r] for r in rows[1:]]


def path_of(rows, axes, feed, waypoints):
    """The path in the plane of the first two axes, with equal scales, and the colours of its speed."""
    left, top, width, height = PATH_BOX
    second = 2 if len(axes) > 1 else 1
    spans = [(min(r[k] for r in rows), max(r[k] for r in rows)) for k in (1, second)]
    if second == 1:
        spans[1] = (0.0, 0.0)
    scale = min(w / ((b - a) or 1e-9) for w, (a, b) in zip((0.94 * width, 0.94 * height), spans))
    ranges = [((a + b - w / scale) / 2, (a + b + w / scale) / 2) for w, (a, b) in zip((width, height), spans)]
    frame = Frame(PATH_BOX, *ranges)
    out = frame.drawn(f"path: {axes[0]} and {axes[1] if len(axes) > 1 else ''} [mm]; dots: waypoints", " ", 6, 6)
    pieces = rows[::-(-len(rows) // STEPS)] + rows[-1:]
    for a, b in zip(pieces, pieces[1:]):
        ends = [frame.at(r[1], r[2] if second == 2 else 0.0) for r in (a, b)]
        out.append(line(ends, shade(max(a[-1], b[-1]) / feed), 3.5))
    if waypoints:
        names, points = read(waypoints)
        for p in points:
            x, y = frame.at(*[p[names.index(axis)] if axis in names else 0.0 for axis in (list(axes[:2]) + ["-"])[:2]])
            out.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="2.4" fill="white" stroke="{BLACK}" stroke-width="1"/>')
    bar = 240 / len(RAMP)
    for i, colour in enumerate(RAMP):
        out.append(f'<rect x="{left + 60 + i * bar:.1f}" y="{top + height + 36}" width="{bar:.1f}" height="10" fill="{colour}"/>')
    return out + [text(left, top + height + 45, "speed"), text(left + 60, top + height + 61, "0", "middle", GREY, 11),
                  text(left + 300, top + height + 61, f"{feed:g} mm/s (feed)", "middle", GREY, 11)]


def accelerations(rows, k):
    h = rows[1][0] - rows[0][0]
    q = [r[k + 1] for r in rows]
    return [(rows[i][0], (q[i + 1] - 2 * q[i] + q[i - 1]) / h**2) for i in range(1, len(q) - 2)]  # the last sample may be earlier


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--trace", required=True)
    parser.add_argument("--machine", required=True)
    parser.add_argument("--waypoints")
    args = parser.parse_args()
    with open(args.machine, "rb") as f:
        machine = tomllib.load(f)
    head, rows = read(args.trace)
    axes, feed = head[1:-1], machine["path"]["max_feed_mm_s"]
    out = path_of(rows, axes, feed, args.waypoints)
    end = rows[-1][0]
    speed = Frame((510, 36, 430, 120), (0.0, end), (0.0, 1.15 * feed))
    out += speed.drawn("speed along the path [mm/s]") + speed.limit(feed, "feed limit")
    out.append(speed.curve([(r[0], r[-1]) for r in rows], BLACK))
    limits = [a["max_acceleration_mm_s2"] for a in machine["axis"][:len(axes)]]
    largest = 1.15 * max(limits)
    frame = Frame((510, 206, 430, 160), (0.0, end), (-largest, largest))
    out += frame.drawn("acceleration of each axis [mm/s^2]", "time [s]")
    for number, limit in enumerate(sorted(set(limits))):
        out += frame.limit(limit, "limit" if number == 0 else "") + frame.limit(-limit)
    moving = []
    for k, axis in enumerate(axes):
        points = accelerations(rows, k)
        if max(abs(a) for _, a in points) > 1e-6:
            moving.append((axis, AXES[axis], ""))
            out.append(frame.curve(points, AXES[axis]))
    out += legend(510, 426, moving, 70)
    out.append(text(940, 426, f"cycle time {end:.3f} s", "end"))
    print(document(WIDTH, HEIGHT, out))


if __name__ == "__main__":
    main()
