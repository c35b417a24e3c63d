#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The path from the edges alone: edges_path.py SPLINEFEED WAYPOINTS MACHINE CASE

Runs the tool with --edges and --segments, as the case says (CASES below); follows the lines as a drive would, and holds the counts against the cubics of the segments: within half a step at any
instant, but for what the plan moves in the engine's resolution; exact at the end; set-up, hold and widths kept.
"""
import bisect
import subprocess
import sys
import tempfile
from pathlib import Path

UNITS = 3 << 30  # a count
NS = 125  # a tick

INTERVALS = {"step": "", "axis": "", "resolution_ns": 125, "setup": 5000, "hold": 5000, "high": 2000, "low": 2000}
CASES = {
    "intervals": INTERVALS,
    "fixed rate": {**INTERVALS, "step": "engine = 'fixed-rate'\ntick_us = 5\n", "resolution_ns": 2500, "high": 5000, "low": 5000},
    "interpolated": {**INTERVALS, "step": "engine = 'interpolated'\n", "resolution_ns": 125},
    "on edges": {**INTERVALS, "step": "step_on_edge = true\ndirection_setup_us = 1.5\ndirection_hold_us = 0\n",
                 "setup": 1500, "hold": 0, "edge": True},
    "two motors": {**INTERVALS, "axis": "motors = 2\ninvert_step = true\ninvert_direction = [false, true]\n", "motors": 2,
                   "inverted": 1},
}


def read_segments(path):
    rows = [line.split(",") for line in path.read_text().splitlines() if not line.startswith("#")]
    axes = [name[: -len("_start")] for name in rows[0] if name.endswith("_start") and not name.endswith("_v_start")]
    starts, cubics, t = [], {axis: [] for axis in axes}, 0
    for row in rows[1:]:
        values = [int(v) for v in row[1:]]
        starts.append(t)
        for k, axis in enumerate(axes):
            cubics[axis].append((values[0], *values[1 + 4 * k : 5 + 4 * k]))
        t += values[0]
    return starts, cubics, t


def place(starts, cubics, tick, units):
    """Position of an axis less `units`, in counts; tick may be a fraction."""
    i = min(max(bisect.bisect_right(starts, tick) - 1, 0), len(starts) - 1)
    duration, start, end, v0, v1 = cubics[i]
    u = min(max((tick - starts[i]) / duration, 0.0), 1.0)
    way = end - start
    travelled = u * (v0 + u * ((3 * way - 2 * v0 - v1) + u * (v0 + v1 - 2 * way)))
    return (start - units + travelled) / UNITS


class Drive:
    def __init__(self, case, count, second):
        self.case, self.count, self.steps = case, count, []
        self.inverted = case.get("inverted", 0)
        self.inverted_direction = 1 if second else 0
        self.level = self.up = 0
        self.rise = self.fall = self.turned = -10**12

    def see(self, t, line, value):
        case = self.case
        if line == "dir":
            up = value ^ self.inverted_direction
            assert up != self.up, f"direction that was there already at {t}"
            assert t - (self.rise if case.get("edge") else self.fall) >= case["hold"], f"hold time at {t}"
            assert case.get("edge") or not self.level, f"direction in a pulse at {t}"
            self.up, self.turned = up, t
            return
        level = value ^ self.inverted
        assert level != self.level, f"level that was there already at {t}"
        self.level = level
        if not case.get("edge") and not level:
            assert t - self.rise >= case["high"], f"pulse at {t}"
            self.fall = t
            return
        assert t - self.turned >= case["setup"], f"set-up time at {t}"
        assert t - (self.rise if case.get("edge") else self.fall) >= case["low"], f"pause at {t}"
        self.rise = t
        self.count += 1 if self.up else -1
        self.steps.append((t, self.count))


def check(name, case, tool, waypoints, machine, folder):
    text = Path(machine).read_text()
    text = text.replace("[path]", f"[step]\n{case['step']}\n[path]", 1).replace("[[axis]]\n", f"[[axis]]\n{case['axis']}")
    text = text.replace("steps_per_mm = 320", "steps_per_mm = 150")  # half the time, and still a hundred thousand steps
    (folder / "m.toml").write_text(text)
    subprocess.run([tool, "plan", waypoints, "-m", "m.toml", "--edges", "e.csv", "--segments", "s.csv", "--quiet"], cwd=folder,
                   check=True, stdout=subprocess.DEVNULL)
    starts, cubics, end = read_segments(folder / "s.csv")
    nearest = lambda units: (units + UNITS // 2) // UNITS
    drives = {}
    for axis in cubics:
        for motor in range(case.get("motors", 1)):
            drives[axis + ("2" if motor else "")] = Drive(case, nearest(cubics[axis][0][1]), motor == 1)
    rows = (folder / "e.csv").read_text().splitlines()
    assert rows[0] == "t_ns,axis,line,value", rows[0]
    last = -10**12
    for row in rows[1:]:
        t, axis, line, value = row.split(",")
        t = int(t)
        assert t >= last and t % NS == 0, row
        last = t
        drives[axis].see(t, line, int(value))
    worst, total = 0.0, 0
    for axis, cubic in cubics.items():
        drive = drives[axis]
        assert drive.count == nearest(cubic[-1][2]), f"{axis} ends at {drive.count}"
        if case.get("motors") == 2:
            assert drive.steps == drives[axis + "2"].steps, "the second motor follows the first"
        total += len(drive.steps)
        slack_ticks = case["resolution_ns"] / NS + 1e-6
        count = nearest(cubic[0][1])
        for t, after in drive.steps + [(end * NS, drive.count)]:
            for at in (count, after):  # just before the step, and just behind it
                tick = t / NS
                off = abs(place(starts, cubic, tick, at * UNITS))
                worst = max(worst, off)
                if off > 0.5:
                    off = min(abs(place(starts, cubic, tick + d, at * UNITS)) for d in (-slack_ticks, slack_ticks))
                assert off <= 0.5 + 1e-6, f"{axis} is {off} steps off the plan at {t} ns"
            count = after
    assert total > 10000, f"only {total} steps"
    print(f"{name}: {total} steps, {len(rows) - 1} edges, never further than {worst:.4f} steps from the plan")


def main():
    tool, waypoints, machine, name = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        check(name, CASES[name], str(Path(tool).resolve()), str(Path(waypoints).resolve()), machine, Path(folder))


main()
