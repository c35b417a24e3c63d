#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws what a tolerance does to a corner, a joint and a chain of short lines, and the time against the tolerance, as SVG.

    docs/pictures/tolerance.py build/release/bin/splinefeed > tolerance.svg

All is taken from runs of the tool. Python's standard library only (3.11 or later)."""
import json
import math
import pathlib
import subprocess
import sys
import tempfile

from drawing import BLACK, BLUE, GREY, ORANGE, VERMILLION, Frame, document, legend, line, text, thinned

CORNER = [{"from": [-10, 0, 0], "to": [0, 0, 0]}, {"from": [0, 0, 0], "to": [5, 8.66025403784, 0]}]
JOINT = [{"from": [-20, 0, 0], "to": [0, 0, 0]},
         {"type": "arc", "from": [0, 0, 0], "to": [10, 10, 0], "centre": [0, 10, 0], "axis": [0, 0, 1], "angle": math.pi / 2}]
WIDTH, HEIGHT, SIDE = 960, 620, 270
TIMES = ["star.csv", "path61.csv", "circle720.csv"]
MACHINE = '[path]\nmax_feed_mm_s = 100\n' + "".join(
    f'[[axis]]\nname = "{axis}"\nmax_velocity_mm_s = 100\nmax_acceleration_mm_s2 = 1000\nmax_jerk_mm_s3 = 30000\n' for axis in "xyz")


def chain():
    """A curve rounded to 0.05 mm, as coarse data is."""
    places = [[round(x / 0.05) * 0.05 for x in (0.35 * i, 1.5 * math.sin(0.25 * i), 0.0)] for i in range(24)]
    return [{"from": a, "to": b} for a, b in zip(places, places[1:])]


def places_of(points, parts):
    out = []
    for i in range(parts + 1):
        row = [tuple(p[:2]) for p in points]
        while len(row) > 1:
            row = [tuple(a + (b - a) * i / parts for a, b in zip(p, q)) for p, q in zip(row, row[1:])]
        out.append(row[0])
    return out


class Tool:
    def __init__(self, path, folder):
        self.path, self.folder = path, pathlib.Path(folder)

    def pieces(self, elements, tolerance):
        """The Bezier points of a program's path."""
        program = self.folder / "program.json"
        program.write_text(json.dumps({"elements": elements}))
        made = subprocess.run([self.path, "curve", program, "--tolerance", str(tolerance), "--scalar", "double", "--quiet"],
                              capture_output=True, text=True, check=True).stdout
        return [segment["control_points"] for segment in json.loads(made)["segments"]]

    def seconds(self, program, tolerance):
        machine = self.folder / "machine.toml"
        machine.write_text(MACHINE)
        made = subprocess.run([self.path, "plan", f"examples/{program}", "-m", machine, "--curve", "polyline", "--tolerance",
                               repr(tolerance), "--summary", "json", "--quiet"], capture_output=True, text=True, check=True).stdout
        return json.loads(made)["cycle_time_s"]


def drawn_pieces(frame, pieces):
    out = [line(thinned([frame.at(*p) for p in places_of(points, 60)]), BLUE, 2) for points in pieces]
    for points in pieces[:-1]:
        x, y = frame.at(*points[-1][:2])
        out.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="2.6" fill="white" stroke="{BLUE}" stroke-width="1.4"/>')
    return out


def corner(tool, box):
    frame = Frame(box, (-0.85, 0.55), (-0.27, 0.85))
    out = frame.drawn("a corner: tolerance 0.1 mm", "mm", 4, 4)
    out.append(line([frame.at(-0.85, 0.0), frame.at(0.0, 0.0), frame.at(0.85 / 3**0.5, 0.85)], VERMILLION, 1.4))
    x, y = frame.at(0.0, 0.0)
    radius = frame.at(0.1, 0.0)[0] - x
    out.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius:.1f}" fill="none" stroke="{ORANGE}" stroke-width="1.2"/>')
    return out + drawn_pieces(frame, clipped(tool.pieces(CORNER, 0.1), frame))


def clipped(pieces, frame):
    """Straight pieces cut at the frame; the bent ones lie within."""
    out = []
    for points in pieces:
        if len(points) > 2:
            out.append(points)
            continue
        (x0, y0), (x1, y1) = (p[:2] for p in points)
        low, high = 0.0, 1.0
        for a, d, lo, hi in ((x0, x1 - x0, frame.x0, frame.x1), (y0, y1 - y0, frame.y0, frame.y1)):
            if abs(d) > 1e-12:
                near, far = sorted(((lo - a) / d, (hi - a) / d))
                low, high = max(low, near), min(high, far)
        out.append([[x0 + t * (x1 - x0), y0 + t * (y1 - y0)] for t in (low, high)])
    return out


def curvature(tool, box):
    """Curvature along the path over the joint of a line and an arc."""
    frame = Frame(box, (-8.0, 8.0), (-0.02, 0.13))
    out = frame.drawn("a joint: curvature [1/mm] where a line meets an arc of 10 mm", "mm along the path from the joint", 4, 4)
    out.append(line([frame.at(*p) for p in ((-8, 0), (0, 0), (0, 0.1), (8, 0.1))], VERMILLION, 1.4))
    for tolerance, colour in ((0.01, BLUE), (0.001, BLACK)):
        points, way, last = [], 0.0, None
        for piece in tool.pieces(JOINT, tolerance):
            places = places_of(piece, 200)
            for a, b, c in zip(places, places[1:], places[2:]):
                if last is not None:
                    way += math.dist(last, b)
                last = b
                area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
                size = math.dist(a, b) * math.dist(b, c) * math.dist(a, c)
                points.append((way, 2.0 * area / size if size > 1e-12 else 0.0))
        leg = 20.0  # the joint is so far along the path
        shown = [(s - leg, k) for s, k in points if -8.0 <= s - leg <= 8.0]
        out.append(frame.curve(shown, colour, 1.8))
    return out


def short_lines(tool, box):
    elements = chain()
    frame = Frame(box, (0.2, 4.2), (0.1, 1.7))
    out = frame.drawn("a chain: lines of data rounded to 0.05 mm, tolerance 0.05 mm", "mm", 4, 4)
    places = [elements[0]["from"]] + [e["to"] for e in elements]
    inside = [frame.at(p[0], p[1]) for p in places if 0.2 <= p[0] <= 4.2 and 0.1 <= p[1] <= 1.7]
    out.append(line(inside, VERMILLION, 1.4))
    out += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="2.2" fill="{VERMILLION}"/>' for x, y in inside]
    for points in tool.pieces(elements, 0.05):
        run = [frame.at(*p) for p in places_of(points, 80) if inside and 0.2 <= p[0] <= 4.2 and 0.1 <= p[1] <= 1.7]
        if len(run) > 1:
            out.append(line(thinned(run), BLUE, 2))
    return out


def times(tool, box):
    tolerances = [10 ** (e / 4) for e in range(-14, 1)]
    frame = Frame(box, (-3.5, 0.0), (0.0, 1.15))
    out = frame.drawn("cycle time over that with exact stops, jerk-limited", "", 5, 7)
    for value in (-3, -2, -1, 0):
        x, y = frame.at(value, 0.0)
        out.append(text(x, y + 14, f"{10.0**value:g}", "middle", GREY, 11))
    left, top, width, height = box
    out.append(text(left + width, top + height + 29, "tolerance [mm]", "end", GREY, 11))
    for program, colour in zip(TIMES, (BLUE, ORANGE, VERMILLION)):
        stop = tool.seconds(program, 0.0)
        points = [(math.log10(t), tool.seconds(program, t) / stop) for t in tolerances]
        out.append(frame.curve(points, colour, 2))
    return out + legend(left, top + height + 46, [(p, c, "") for p, c in zip(TIMES, (BLUE, ORANGE, VERMILLION))], 125)


def main():
    with tempfile.TemporaryDirectory() as folder:
        tool = Tool(sys.argv[1], folder)
        out = corner(tool, (56, 40, SIDE, SIDE * 0.8))
        out += curvature(tool, (410, 40, WIDTH - 430, SIDE * 0.8))
        out += short_lines(tool, (56, 340, 420, 200))
        out += times(tool, (540, 340, WIDTH - 560, 200))
        out += legend(56, 600, [("programmed", VERMILLION, ""), ("path", BLUE, "")], 110)
        out += [text(290, 600, "circle: the tolerance about the corner; black: tolerance 0.001 mm", colour=GREY, size=11)]
        print(document(WIDTH, HEIGHT, out))


if __name__ == "__main__":
    main()
