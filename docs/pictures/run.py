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

COLOURS = ["#d1495b", "#2a7f9e", "#66a182", "#8d6a9f", "#b08d57", "#444444"]


def read(path):
    with open(path, newline="") as f:
        rows = [r for r in csv.reader(f) if r and not r[0].startswith("#")]
    names = [h.strip() for h in rows[0]]
    if names[0].lstrip("+-").replace(".", "", 1).isdigit():  # waypoints without a header are x, y, z, ...
        rows.insert(0, [])
        names = list("xyzabc")[:len(names)]
    return names, [[float(x or 0) for x in r] for r in rows[1:]]


def shade(fraction):
    """Blue (slow) over green to red (full speed)."""
    return f"hsl({240 - 240 * min(1.0, max(0.0, fraction)):.0f},65%,48%)"


class Plot:
    """A rectangle of the picture with its own scales."""

    def __init__(self, x, y, width, height, xs, ys, square=False):
        self.box = (x, y, width, height)
        self.x0, self.x1, self.y0, self.y1 = min(xs), max(xs), min(ys), max(ys)
        self.sx = width / ((self.x1 - self.x0) or 1)
        self.sy = height / ((self.y1 - self.y0) or 1)
        if square:
            self.sx = self.sy = min(self.sx, self.sy)

    def at(self, x, y):
        left, top, _, height = self.box
        return f"{left + (x - self.x0) * self.sx:.1f},{top + height - (y - self.y0) * self.sy:.1f}"


def thin(points, count=700):
    return points[:: max(1, len(points) // count)] + points[-1:]


def line(plot, points, colour, width=1.4, dash=""):
    path = " ".join(plot.at(x, y) for x, y in points)
    style = f' stroke-dasharray="{dash}"' if dash else ""
    return f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="{width}"{style}/>'


def text(x, y, content, anchor="start", colour="#333", size=12):
    return f'<text x="{x}" y="{y}" text-anchor="{anchor}" fill="{colour}" font-size="{size}">{content}</text>'


def frame(plot, low, high, unit, title):
    x, y, width, height = plot.box
    return [f'<rect x="{x}" y="{y}" width="{width}" height="{height}" fill="none" stroke="#bbb"/>',
            text(x, y - 6, title), text(x - 5, y + 10, high, "end", "#777", 10),
            text(x - 5, y + height, low, "end", "#777", 10), text(x + width, y - 6, unit, "end", "#777", 10)]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--trace", required=True)
    parser.add_argument("--machine", required=True)
    parser.add_argument("--waypoints")
    args = parser.parse_args()
    with open(args.machine, "rb") as f:
        machine = tomllib.load(f)
    head, rows = read(args.trace)
    axes = head[1:-1]
    feed = machine["path"]["max_feed_mm_s"]
    t = [r[0] for r in rows]
    out = ['<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 960 400" font-family="sans-serif">',
           '<rect width="960" height="400" fill="white"/>']
    xy = Plot(20, 36, 400, 336, [r[1] for r in rows], [r[2] for r in rows], square=True)
    out.append(text(20, 22, "path, blue slow to red at full feed; dots: waypoints"))
    steps = thin(rows, 500)
    for a, b in zip(steps, steps[1:]):
        out.append(line(xy, [(a[1], a[2]), (b[1], b[2])], shade(b[-1] / feed), 3))
    if args.waypoints:
        names, points = read(args.waypoints)
        for p in points:
            place = [p[names.index(axis)] if axis in names else 0.0 for axis in axes[:2]]
            cx, cy = xy.at(*place).split(",")
            out.append(f'<circle cx="{cx}" cy="{cy}" r="2" fill="#222"/>')
    speed = Plot(490, 36, 450, 130, t, [0, feed * 1.08])
    out += frame(speed, "0", f"{feed * 1.08:.0f}", "mm/s", "speed along the path, limit dashed")
    out.append(line(speed, [(t[0], feed), (t[-1], feed)], "#999", 1, "5 4"))
    out.append(line(speed, thin([(r[0], r[-1]) for r in rows]), "#222"))
    limit = max(a["max_acceleration_mm_s2"] for a in machine["axis"])
    accel = Plot(490, 206, 450, 150, t, [-limit * 1.08, limit * 1.08])
    out += frame(accel, f"{-limit * 1.08:.0f}", f"{limit * 1.08:.0f}", "mm/s^2", "acceleration of each axis, limits dashed")
    for bound in {a["max_acceleration_mm_s2"] for a in machine["axis"]}:
        for sign in (-1, 1):
            out.append(line(accel, [(t[0], sign * bound), (t[-1], sign * bound)], "#999", 1, "5 4"))
    h = t[1] - t[0]
    for k, axis in enumerate(axes):
        q = [r[k + 1] for r in rows]
        points = [(t[i], (q[i + 1] - 2 * q[i] + q[i - 1]) / h**2) for i in range(1, len(q) - 2)]
        if max(abs(a) for _, a in points) > 1e-6:
            out.append(line(accel, points[:: max(1, len(points) // 900)], COLOURS[k], 1.1))
            out.append(text(490 + 40 * k, 374, axis, colour=COLOURS[k]))
    out.append(text(940, 374, f"{t[-1]:.3f} s", "end", "#777", 10))
    out.append("</svg>")
    print("\n".join(out))


if __name__ == "__main__":
    main()
