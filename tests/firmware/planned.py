# SPDX-License-Identifier: MIT
"""The firmware's test programs, and what the tool plans for them on the same machine."""
import csv
import math
import re
import subprocess

from board_in_qemu import BoardFailed, DIRECTION, STEP

STEPS_PER_MM = (80, 80, 400)
MACHINE = "examples/firmware/machine.toml"
AXES = "xyz"
LINES = {pin: (axis, "step") for axis, pin in enumerate(STEP)} | {pin: (axis, "dir") for axis, pin in enumerate(DIRECTION)}


def check(right, what):
    if not right:
        raise BoardFailed(what)


def waypoints(path):
    with open(path, encoding="utf-8") as rows:
        return [row.strip() for row in rows if row[0] in "-0123456789"]


def spiral():
    """A path of 240 short moves with a corner and two programmed feeds."""
    rows = [f"{i * 0.1:.3f},{(i % 7) * 0.05:.3f},{i * 0.01:.3f}" for i in range(200)]
    rows += [f"{19.9 - i * 0.4:.3f},{0.2 + i * 0.3:.3f},1.99,{20 if i < 20 else 60},{int(i == 20)}" for i in range(1, 41)]
    return rows


def arc():
    """16 waypoints on a helix, with two programmed feeds. The curve looks ahead over so many, and turns nowhere so sharply that it ends
    there: nothing moves before the end of the program is known, and the host's pace changes nothing."""
    rows = [f"{10 - 10 * math.cos(0.3 * i):.3f},{10 * math.sin(0.3 * i):.3f},{i * 0.1:.3f}" for i in range(16)]
    return [f"{row},{20 if i in (6, 7) else 60},0" if i >= 6 else row for i, row in enumerate(rows)]


def noisy_helix(count):
    """The one of tests/arm/stages.cpp, in millimetres."""
    x, y, z, random, rows = 20000, 0, 0, 1, []
    for _ in range(count):
        x -= y >> 4
        y += x >> 4
        z += 100
        row = []
        for um in (x, y, z):
            random = (random * 1664525 + 1013904223) % 2**32
            row.append(f"{(um + (random >> 16) % 61 - 30) / 1000:.3f}")
        rows.append(",".join(row))
    return rows


def slowed(machine):
    """The machine file with segments of 8 ms, a quarter of the speed, 1/64 of the acceleration, and ticks of 200 us."""
    scales = {"sample_period_us": 8, "max_velocity_mm_s": 1 / 4, "max_acceleration_mm_s2": 1 / 64, "tick_us": 4, "step_length_us": 4,
              "step_space_us": 4, "direction_setup_us": 4, "direction_hold_us": 4}
    return re.sub(r"^(\w+) = (\d+)$", lambda m: f"{m[1]} = {int(m[2]) * scales.get(m[1], 1):.12g}", machine, flags=re.MULTILINE)


class Plan:
    """What the tool plans for these waypoints: the steps of each axis, and the counts at the end."""

    def __init__(self, tool, folder, rows, kind):
        path, edges = f"{folder}/rows.csv", f"{folder}/edges.csv"
        with open(path, "w", encoding="utf-8") as out:
            out.write("x,y,z,feed,corner\n" + "".join(f"{row}{',' * (4 - row.count(','))}\n" for row in rows))
        machine = MACHINE
        if kind.slow:
            machine = f"{folder}/machine.toml"
            with open(MACHINE, encoding="utf-8") as fast, open(machine, "w", encoding="utf-8") as slow:
                slow.write(slowed(fast.read()))
        subprocess.run([tool, "run", path, "-m", machine, "--window", str(kind.window), "--scalar", kind.scalar,
                        "--edges", edges], check=True, capture_output=True)
        with open(edges, encoding="utf-8") as rows_of_edges:
            rows_of_edges = list(csv.DictReader(rows_of_edges))
        levels = [(AXES.index(row["axis"]), row["line"], int(row["value"])) for row in rows_of_edges]
        self.edges = sorted((int(row["t_ns"]), *level) for row, level in zip(rows_of_edges, levels))
        self.start = counts_at(rows[0])
        self.steps, _ = steps_of(levels, [0, 0, 0])
        self.end = counts_after(self.start, self.steps)


def counts_at(row):
    return tuple(round(float(v) * s) for v, s in zip(row.split(","), STEPS_PER_MM))


def steps_of(edges, up):
    """[(axis, +1 or -1)], and the directions at the end."""
    steps, up = [], list(up)
    for axis, line, level in edges:
        if line == "dir":
            up[axis] = level
        elif level:
            steps.append((axis, 1 if up[axis] else -1))
    return steps, up


def counts_after(start, steps):
    return tuple(count + sum(step for k, step in steps if k == axis) for axis, count in enumerate(start))


def of_axis(axis, steps):
    return [step for k, step in steps if k == axis]
