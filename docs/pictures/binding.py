#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws speed, acceleration and jerk along the path over time, coloured by the limit that binds, as SVG.

    docs/pictures/binding.py --tool build/release/bin/splinefeed --machine examples/jerk_limited.toml examples/butterfly.json > out.svg

All is taken from the feed segments of the run: in the middle of each the limit with the largest use binds, where that is 95 % at least. Acceleration and jerk are shown as what of them points in the
direction of travel. Python's standard library only (3.11 or later).
"""
import argparse
import csv
import math
import pathlib
import re
import subprocess
import tempfile
import tomllib

from drawing import BLUE, ORANGE, VERMILLION, Frame, document, legend, line, text, thinned

BINDS = 0.95
COLOURS = {"feed or velocity": BLUE, "acceleration of an axis": ORANGE, "jerk of an axis": VERMILLION, "none": "#8c8c8c"}
LEFT, WIDTH, TOP, HEIGHT, STEP = 66, 874, 74, 124, 164


def segments_of(tool, program, options, machine):
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "segments.csv"
        subprocess.run([tool, "run", program, "-m", machine, "--segments", str(out), "--quiet", *options],
                       check=True, stdout=subprocess.DEVNULL)
        return out.read_text()


def samples_of(text, machine):
    """Time, speed, acceleration and jerk along the path and what binds, in the middle of each segment."""
    lines = text.splitlines()
    unit_mm = [float(x) for x in re.findall(r"1 unit = (\S+) mm", text)]
    tick_s = float(re.search(r"1 tick = \S+ us = (\S+) s", text)[1])
    axes = machine["axis"][: len(unit_mm)]
    feed = machine["path"]["max_feed_mm_s"]
    out, time = [], 0.0
    for row in csv.DictReader(line for line in lines if not line.startswith("#")):
        duration = int(row["duration_ticks"]) * tick_s
        velocity, acceleration, jerk = [], [], []
        for axis, mm in zip(axes, unit_mm):
            p0, p1, v0, v1 = (int(row[f"{axis['name']}_{key}"]) for key in ("start", "end", "v_start", "v_end"))
            square, cube = 3 * (p1 - p0) - 2 * v0 - v1, v0 + v1 - 2 * (p1 - p0)  # whole numbers: exact
            velocity.append((v0 + square + 0.75 * cube) * mm / duration)
            acceleration.append((2 * square + 3 * cube) * mm / duration**2)
            jerk.append(6 * cube * mm / duration**3)
        speed = math.hypot(*velocity)
        uses = {"feed or velocity": max([speed / feed] + [abs(v) / a["max_velocity_mm_s"] for v, a in zip(velocity, axes)]),
                "acceleration of an axis": max(abs(x) / a["max_acceleration_mm_s2"] for x, a in zip(acceleration, axes)),
                "jerk of an axis": max([0.0] + [abs(x) / a["max_jerk_mm_s3"] for x, a in zip(jerk, axes) if "max_jerk_mm_s3" in a])}
        limit = max(uses, key=uses.get)
        def along(vector):
            """What of it points in the direction of travel; at rest nothing."""
            return sum(v * x for v, x in zip(velocity, vector)) / speed if speed > 1e-3 else 0.0

        shown = (speed, along(acceleration), along(jerk))
        out.append((time + 0.5 * duration, shown, limit if uses[limit] >= BINDS else "none"))
        time += duration
    return out


def panel(samples, which, frame):
    """The curve in pieces of one colour, each by what binds."""
    out, run = [], [frame.at(samples[0][0], samples[0][1][which])]
    for before, sample in zip(samples, samples[1:]):
        run.append(frame.at(sample[0], sample[1][which]))
        if sample[2] != before[2]:
            out.append(line(thinned(run), COLOURS[before[2]], 1.6))
            run = run[-1:]
    return out + [line(thinned(run), COLOURS[samples[-1][2]], 1.6)]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", help="waypoints or a curve")
    parser.add_argument("--machine", required=True)
    parser.add_argument("--tool", default="build/release/bin/splinefeed")
    parser.add_argument("--start", type=float, default=0.0, help="s")
    parser.add_argument("--end", type=float, default=math.inf, help="s")
    arguments, options = parser.parse_known_args()
    machine = tomllib.loads(pathlib.Path(arguments.machine).read_text())
    samples = samples_of(segments_of(arguments.tool, arguments.program, options, arguments.machine), machine)
    shown = [s for s in samples if arguments.start <= s[0] <= arguments.end]
    out = [text(LEFT, 20, "What binds (95 % of a limit is used):")]
    out += legend(LEFT + 240, 20, [(name, colour, "") for name, colour in COLOURS.items()], 175)
    path = machine["path"]["max_feed_mm_s"]
    limits = [path, max(a["max_acceleration_mm_s2"] for a in machine["axis"]), max(a["max_jerk_mm_s3"] for a in machine["axis"])]
    titles = ["speed [mm/s]", "acceleration along the path [mm/s^2]", "jerk along the path [mm/s^3]"]
    for which, (title, limit) in enumerate(zip(titles, limits)):
        values = [s[1][which] for s in shown]
        high = 1.1 * max(limit, *values)
        low = min(0.0, 1.1 * min(values)) if which == 0 else 1.1 * min(-limit, *values)
        frame = Frame((LEFT, TOP + STEP * which, WIDTH, HEIGHT), (shown[0][0], shown[-1][0]), (low, high))
        out += frame.drawn(title, "time [s]" if which == 2 else "", 5)
        out += frame.limit(limit, "feed limit" if which == 0 else "limit of an axis") + (frame.limit(-limit) if which else [])
        out += panel(shown, which, frame)
    whole = len(samples) * (samples[1][0] - samples[0][0])
    out.append(text(LEFT, TOP - 24, f"cycle time {whole:.3f} s", bold=True))
    print(document(LEFT + WIDTH + 20, TOP + 3 * STEP, out))


if __name__ == "__main__":
    main()
