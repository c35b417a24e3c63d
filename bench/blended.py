#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Corners blended within a tolerance against stops: cycle times of both jerk-limited plans, as docs/explanation/feed_derivation.md states them.

    bench/blended.py [--tool build/release/bin/splinefeed]

A corner is replaced by the cubic Bezier segment that has both inner control points on the corner. Its middle is the trim times
sin(turn / 2) / 4 away from the corner."""
import argparse
import csv
import json
import math
import os
import pathlib
import subprocess
import tempfile

TOLERANCES_MM = (0.01, 0.05, 0.1)
MACHINE = """[path]
max_feed_mm_s = 100
""" + "".join(f"""[[axis]]
name = "{axis}"
max_velocity_mm_s = 100
max_acceleration_mm_s2 = 1000
max_jerk_mm_s3 = 30000
""" for axis in "xyz")


def star():
    """14 points on two circles, closed."""
    radii = (19.179, 9.5895)
    angles = [math.pi * i / 7 for i in range(15)]
    return [(radii[i % 2] * math.cos(angle), radii[i % 2] * math.sin(angle)) for i, angle in enumerate(angles)]


def zigzag(turn_degrees):
    half = math.radians(turn_degrees) / 2
    return [(10.0 * i * math.cos(half), 10.0 * math.sin(half) * (i % 2)) for i in range(9)]


def blended(points, tolerance_mm):
    """The control points of lines and blends, in mm."""
    def unit(a, b):
        length = math.dist(a, b)
        return tuple((y - x) / length for x, y in zip(a, b))

    segments, here = [], points[0]
    for before, corner, after in zip(points, points[1:], points[2:]):
        enter, leave = unit(before, corner), unit(corner, after)
        trim = 4.0 * tolerance_mm / (math.dist(enter, leave) / 2)
        start = tuple(c - trim * d for c, d in zip(corner, enter))
        end = tuple(c + trim * d for c, d in zip(corner, leave))
        segments += [(here, start), (start, corner, corner, end)]
        here = end
    return segments + [(here, points[-1])]


def seconds(tool, program, folder, *options):
    machine = folder / "machine.toml"
    machine.write_text(MACHINE)
    command = [tool, "plan", str(program), "--machine", str(machine), "--scalar", "double", "--quiet", "--summary", "json", *options]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)["cycle_time_s"]


def row(tool, points, folder, *options):
    """Times: with a stop at each corner, and within each tolerance."""
    sharp = folder / "sharp.csv"
    with open(sharp, "w", encoding="ascii", newline="") as file:
        csv.writer(file).writerows([(*point, 0.0) for point in points])
    times = [seconds(tool, sharp, folder, "--curve", "polyline", *options)]
    for tolerance in TOLERANCES_MM:
        curve = folder / "blended.json"
        segments = [{"degree": len(s) - 1, "control_points": [[*p, 0.0] for p in s]} for s in blended(points, tolerance)]
        curve.write_text(json.dumps({"curve": "bezier", "closed": False, "segments": segments}))
        times.append(seconds(tool, curve, folder, *options))
    return times


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tool", type=os.path.abspath, default="build/release/bin/splinefeed")
    tool = parser.parse_args().tool
    print("| path | plan | stops [s] | " + " | ".join(f"within {t} mm [s]" for t in TOLERANCES_MM) + " |")
    print("|---|---|" + "---|" * (1 + len(TOLERANCES_MM)))
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        for name, points in [("star", star())] + [(f"zigzag of {turn} degrees", zigzag(turn)) for turn in (90, 126, 170)]:
            for scalar in ("double", "float"):
                times = row(tool, points, folder, "--jerk-scalar", scalar)
                print(f"| {name} | {scalar} | " + " | ".join(f"{s:.3f}" for s in times) + " |", flush=True)


if __name__ == "__main__":
    main()
