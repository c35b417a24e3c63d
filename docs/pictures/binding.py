#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws speed, acceleration and jerk along the path over time, coloured by the limit that binds, as SVG.

    docs/pictures/binding.py --tool build/release/bin/splinefeed --machine examples/jerk_limited.toml examples/butterfly.json > out.svg

One column for each jerk_plan, bounded and optimal. All is taken from the feed segments of the runs: in the middle of each the
limit with the largest use binds, where that is 95 % at least. Acceleration and jerk are shown as what of them points in the
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

TIERS = ["bounded", "optimal"]
BINDS = 0.95
COLOURS = {"feed or velocity": "#2a7f9e", "acceleration of an axis": "#66a182", "jerk of an axis": "#d1495b", "none": "#999999"}
LEFT, WIDTH, GAP, TOP, HEIGHT, STEP = 62, 420, 50, 62, 120, 152


def segments_of(tool, program, options, machine_text, tier):
    with tempfile.TemporaryDirectory() as folder:
        machine, out = pathlib.Path(folder) / "machine.toml", pathlib.Path(folder) / "segments.csv"
        text = re.sub(r"(?m)^\s*jerk_plan\s*=.*\n", "", machine_text)
        machine.write_text(text.replace("[path]\n", f'[path]\njerk_plan = "{tier}"\n', 1))
        subprocess.run([tool, "run", program, "-m", str(machine), "--segments", str(out), "--quiet", *options],
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


def text(x, y, content, anchor="start", colour="#333", size=12):
    return f'<text x="{x}" y="{y}" text-anchor="{anchor}" fill="{colour}" font-size="{size}">{content}</text>'


def line(points, colour):
    """A polyline, without the points that are on the line between their neighbours to a fifth of a pixel."""
    kept = points[:1]
    for point, after in zip(points[1:], points[2:]):
        (x0, y0), (x, y), (x1, y1) = kept[-1], point, after
        if abs((x1 - x0) * (y - y0) - (y1 - y0) * (x - x0)) > 0.2 * math.hypot(x1 - x0, y1 - y0) or x - x0 > 4:
            kept.append(point)
    kept += points[-1:]
    return f'<polyline points="{" ".join(f"{x:.1f},{y:.1f}" for x, y in kept)}" stroke="{colour}"/>'


def panel(samples, which, left, top, width, span, low, high):
    def at(sample):
        y = top + HEIGHT * (high - sample[1][which]) / (high - low)
        return left + width * (sample[0] - span[0]) / (span[1] - span[0]), y

    out = [f'<rect x="{left}" y="{top}" width="{width}" height="{HEIGHT}" stroke="#bbb" stroke-width="1"/>']
    if low < 0:
        zero = top + HEIGHT * high / (high - low)
        out.append(f'<path d="M{left} {zero:.1f}h{width}" stroke="#ddd" stroke-width="1"/>')
    run = [at(samples[0])]
    for before, sample in zip(samples, samples[1:]):
        run.append(at(sample))
        if sample[2] != before[2]:
            out.append(line(run, COLOURS[before[2]]))
            run = [at(sample)]
    return out + [line(run, COLOURS[samples[-1][2]])]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", help="waypoints or a curve")
    parser.add_argument("--machine", required=True)
    parser.add_argument("--tool", default="build/release/bin/splinefeed")
    parser.add_argument("--start", type=float, default=0.0, help="s")
    parser.add_argument("--end", type=float, default=math.inf, help="s")
    arguments, options = parser.parse_known_args()
    machine_text = pathlib.Path(arguments.machine).read_text()
    machine = tomllib.loads(machine_text)
    runs = []
    for tier in TIERS:
        samples = samples_of(segments_of(arguments.tool, arguments.program, options, machine_text, tier), machine)
        runs.append((samples, [s for s in samples if arguments.start <= s[0] <= arguments.end]))
    span = (min(shown[0][0] for _, shown in runs), max(shown[-1][0] for _, shown in runs))
    size = (LEFT + len(TIERS) * (WIDTH + GAP), TOP + 3 * STEP + 4)
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {size[0]} {size[1]}" font-family="sans-serif">',
           '<rect width="100%" height="100%" fill="white"/>']
    for i, (name, colour) in enumerate(COLOURS.items()):
        out.append(f'<rect x="{LEFT + 200 * i}" y="10" width="18" height="4" fill="{colour}"/>')
        out.append(text(LEFT + 24 + 200 * i, 16, name))
    out.append('<g fill="none" stroke-width="1.3" stroke-linejoin="round">')
    words = []
    titles = ["speed [mm/s]", "acceleration along the path [mm/s^2]", "jerk along the path [mm/s^3]"]
    for which, title in enumerate(titles):
        top = TOP + STEP * which
        values = [s[1][which] for _, shown in runs for s in shown]
        low, high = 1.05 * min(0.0, *values), 1.05 * max(values)
        words += [text(LEFT - 5, top + 10, f"{high:.0f}", "end", "#777", 10), text(LEFT - 5, top + HEIGHT, f"{low:.0f}", "end", "#777", 10)]
        for column, (samples, shown) in enumerate(runs):
            left = LEFT + column * (WIDTH + GAP)
            words.append(text(left, top - 6, title if which else f"<tspan font-weight=\"bold\">{TIERS[column]}</tspan>, {title}"))
            out += panel(shown, which, left, top, WIDTH, span, low, high)
            if which == 2:
                words += [text(left, top + HEIGHT + 13, f"{span[0]:.2f} s", "start", "#777", 10),
                          text(left + WIDTH, top + HEIGHT + 13, f"{span[1]:.2f} s of {len(samples) * (samples[1][0] - samples[0][0]):.3f} s", "end", "#777", 10)]
    print("\n".join(out + ["</g>"] + words + ["</svg>"]))


if __name__ == "__main__":
    main()
