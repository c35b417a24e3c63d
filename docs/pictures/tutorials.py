#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws the pictures of the tutorials as SVG, from what their own commands make.

    docs/pictures/tutorials.py first_path build/release/bin/splinefeed > first_path.svg       also steered, edges, windows
    docs/pictures/tutorials.py measured shaft_x.csv shaft_y.csv shaft_z.csv > broken_link.json    records of tutorial 2, Break the link
    docs/pictures/tutorials.py broken_link broken_link.json > broken_link.svg

Python's standard library only."""
import csv
import json
import pathlib
import subprocess
import sys
import tempfile

from drawing import BLACK, BLUE, GREEN, GREY, ORANGE, SKY, VERMILLION, Frame, document, legend, line, text

POINTS = [(0, 0), (10, 5), (20, 0), (30, 5), (40, 0)]
MACHINE = "examples/three_axis.toml"
MY_MACHINE = '[path]\nmax_feed_mm_s = 60\n' + "".join(
    f'[[axis]]\nname = "{axis}"\nmax_velocity_mm_s = 60\nmax_acceleration_mm_s2 = 400\n' for axis in "xy")
EVENTS = [(0.2, "override", 0.5), (0.6, "hold", ""), (0.9, "resume", "")]
SPEEDS = [VERMILLION, ORANGE, "#b8b83a", GREEN, SKY, BLUE]  # slow to fast
STEP_S, BEGIN_S, END_S, COUNTS_PER_MM = 0.02, 1.4, 7.2, 320  # of broken_link.json


class Tool:
    """Runs of the five points; each row of an output has numbers by name."""

    def __init__(self, path, folder):
        self.path, self.folder = path, pathlib.Path(folder)
        self.part = self.kept("part.csv", "".join(f"{x},{y}\n" for x, y in POINTS))

    def kept(self, name, content):
        (self.folder / name).write_text(content)
        return self.folder / name

    def run(self, *options):
        return subprocess.run([self.path, "run", self.part, *options], capture_output=True, text=True, check=True).stdout

    def rows(self, output, *options):
        self.run(f"--{output}", self.folder / "rows.csv", "--quiet", *options)
        with open(self.folder / "rows.csv", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def trace(self, *options):
        return [{key: float(value) for key, value in row.items()} for row in self.rows("trace", *options)]


def first_path(tool):
    """The path, coloured by speed, and the speed over time."""
    rows, out = tool.trace("-m", MACHINE), []
    path, speed = Frame((56, 40, 880, 154), (-1, 41), (-1.2, 6.15)), Frame((56, 246, 880, 120), (0, 0.62), (0, 110))
    out += path.drawn("The path [mm]; points are the waypoints, colours the speed") + speed.drawn("Speed [mm/s]", "time [s]")
    bins = [min(int(6 * row["speed"] / 100), 5) for row in rows]
    start = 0
    for at in range(1, len(rows) + 1):
        if at == len(rows) or bins[at] != bins[start]:
            piece = rows[start:at + 1]
            for frame, x, y in ((path, "x", "y"), (speed, "t", "speed")):
                out.append(frame.curve([(r[x], r[y]) for r in piece], SPEEDS[bins[start]], 3))
            start = at
    out += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4.5" fill="{BLACK}"/>' for x, y in (path.at(*point) for point in POINTS)]
    return document(960, 408, out + speed.limit(100, "max_feed_mm_s"))


def steered(tool):
    """The speed over time, without an operator and with one."""
    machine = tool.kept("machine.toml", MY_MACHINE)
    events = tool.kept("events.csv", "t,event,value\n" + "".join(f"{t},{what},{value}\n" for t, what, value in EVENTS))
    frame = Frame((56, 62, 880, 170), (0, 1.8), (0, 66))
    out = frame.drawn("Speed [mm/s]", "time [s]", count_x=9)
    for colour, width, options in ((GREY, 1.2, ()), (BLUE, 2.2, ("--events", events))):
        out.append(frame.curve([(row["t"], row["speed"]) for row in tool.trace("-m", machine, *options)], colour, width))
    for time, what, value in EVENTS:
        x, top = frame.at(time, 66)
        out += [line([(x, top), (x, frame.at(0, 0)[1])], ORANGE, 1, "4 3"), text(x + 5, top + 14, f"{what} {value}".strip(), colour=ORANGE, bold=True)]
    return document(960, 274, out + legend(56, 28, [("without events", GREY, ""), ("with the operator's events", BLUE, "")], 170))


def levels(edges, axis, name, begin, end):
    """The level of a line as points (ms, 0 or 1) from begin to end."""
    out, level = [(begin, 0)], 0
    for edge in edges:
        time = int(edge["t_ns"]) * 1e-6
        if (edge["axis"], edge["line"]) == (axis, name) and time < end:
            if time > begin:
                out += [(time, level), (time, int(edge["value"]))]
            level = int(edge["value"])
            if time <= begin:
                out = [(begin, level)]
    return out + [(end, level)]


def edges(tool):
    """Levels of the lines: the first 20 ms, and the first microseconds of a motion."""
    found, out = tool.rows("edges", "-m", MACHINE), []
    first = next(int(edge["t_ns"]) * 1e-6 for edge in found if edge["axis"] == "x")
    begins = "The first step of x: the direction is there 5 us before, and the pulse is 2 us long"
    for top, title, begin, end, shown in ((40, "The first 20 ms: steps come faster as the machine speeds up", 0, 20, "xy"),
                                          (316, begins, first - 0.004, first + 0.016, "x")):
        rows = [(axis, name) for axis in shown for name in ("step", "dir")]
        frame = Frame((90, top, 846, 50 * len(rows)), (begin, end), (0, len(rows)))
        drawn = frame.drawn(title, "time [ms]", count_y=len(rows), count_x=5)
        out += [part for part in drawn if 'text-anchor="end" fill="#555555" font-size="11">' not in part or "time" in part]
        for place, (axis, name) in enumerate(rows):
            base = len(rows) - 1 - place + 0.2
            points = [frame.at(x, base + 0.6 * level) for x, level in levels(found, axis, name, begin, end)]
            out += [line(points, BLUE if name == "step" else VERMILLION, 1.2), text(80, points[0][1] - 6, f"{axis} {name}", "end")]
    return document(960, 460, out)


def windows(tool):
    """The cycle time over the window, with and without a jerk limit."""
    frame = Frame((56, 40, 880, 200), (3, 11), (0.55, 0.85))
    drawn = frame.drawn("Cycle time of the five points [s] over the window [cells]", count_x=8)
    out = drawn + [text(frame.at(power, 0.55)[0], 256, str(2**power), "middle", GREY, 11) for power in range(3, 12)]
    for colour, machine in ((BLUE, MACHINE), (ORANGE, "examples/jerk_limited.toml")):
        places = []
        for power in range(7, 23):
            made = json.loads(tool.run("-m", machine, "--window", str(round(2 ** (power / 2))), "--summary", "json", "--no-advice", "--quiet"))
            places.append((power / 2, made["cycle_time_s"]))
        out.append(line([frame.at(*place) for place in places], colour, 2))
        out += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="{colour}"/>' for x, y in (frame.at(*place) for place in places)]
    return document(960, 290, out + legend(56, 280, [("without a jerk limit", BLUE, ""), ("with one", ORANGE, "")], 200))


def measured(*records):
    """The records of the shafts, put together by their clocks: positions in mm every STEP_S of the second one's time."""
    shafts = []
    for record in records:
        lines = pathlib.Path(record).read_text(encoding="utf-8").splitlines()
        shafts.append((float(lines[1].split("CLOCK_MONOTONIC")[1].split()[0]), [float(row.split(",")[1]) for row in lines[3:]]))
    zero, rows = shafts[1][0], []
    for step in range(round((END_S - BEGIN_S) / STEP_S)):
        at = [min(round((zero + BEGIN_S + step * STEP_S - start) * 1000), len(counts) - 1) for start, counts in shafts]
        rows.append([round(counts[i] / COUNTS_PER_MM, 3) for i, (_, counts) in zip(at, shafts)])
    note = "tutorial 2, Break the link: x y z [mm] every 20 ms from 1.4 s behind the start of the drive of y on; it has no link from 3 s on for 1 s"
    return f'{{"note": "{note}",\n"rows": [\n' + ",\n".join(json.dumps(row) for row in rows) + "\n]}"


def broken_link(file):
    """Where the shafts were, over time."""
    rows = json.loads(pathlib.Path(file).read_text(encoding="utf-8"))["rows"]
    places = [value for row in rows for value in row]
    speeds = [0.0] + [sum((b - a) ** 2 for a, b in zip(before, row)) ** 0.5 / STEP_S for before, row in zip(rows, rows[1:])]
    shaft, speed, out = Frame((56, 62, 880, 170), (BEGIN_S, END_S), (min(places) - 5, max(places) + 5)), Frame((56, 268, 880, 90), (BEGIN_S, END_S), (0, 110)), []
    for frame in (shaft, speed):
        (left, top), (right, low) = frame.at(3, frame.y1), frame.at(4, frame.y0)
        out.append(f'<rect x="{left:.1f}" y="{top:.1f}" width="{right - left:.1f}" height="{low - top:.1f}" fill="#fbe3cf"/>')
    out += shaft.drawn("Shafts of the three drives [mm]", count_x=7) + speed.drawn("Speed of the machine [mm/s]", "time [s]", 2, 7)
    for axis, colour in enumerate((BLUE, VERMILLION, GREEN)):
        out.append(shaft.curve([(BEGIN_S + i * STEP_S, row[axis]) for i, row in enumerate(rows)], colour, 2))
    out += [speed.curve([(BEGIN_S + i * STEP_S, value) for i, value in enumerate(speeds)], BLACK, 1.6),
            text(shaft.at(3.5, 0)[0], 78, "y has no link", "middle", ORANGE, bold=True)]
    return document(960, 398, out + legend(56, 28, [(axis, colour, "") for axis, colour in zip("xyz", (BLUE, VERMILLION, GREEN))], 80))


def main():
    name, *arguments = sys.argv[1:]
    if name in ("measured", "broken_link"):
        print({"measured": measured, "broken_link": broken_link}[name](*arguments))
        return
    with tempfile.TemporaryDirectory() as folder:
        print({"first_path": first_path, "steered": steered, "edges": edges, "windows": windows}[name](Tool(*arguments, folder)))


if __name__ == "__main__":
    main()
