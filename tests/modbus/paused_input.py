#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Programs that come through a pipe with pauses, on a simulated drive of three axes: the shafts stay on the path and within their
limits, rest in a long pause, and end where the program ends.

paused_input.py TOOL [--runs N] [--seed S]"""
import argparse
import math
import os
import random
import subprocess
import sys
import tempfile
import time

from drive_processes import Drive, machine_text
from stopped_runs import distance

STEPS = 320.0
FEED = 60.0
ACCELERATION = 1000.0
PAUSE_S = 1.5
OFF_MM = 0.005
TOLERATED = 1.01  # of the acceleration: recorded shafts are differences of rounded positions over 8 ms


def run(tool, seed):
    rng = random.Random(seed)
    points = [(0.0, 0.0, 0.0)]
    while len(points) < 24:
        points.append(tuple(c + rng.uniform(-6, 6) for c in points[-1]))
    rows = ["%.6f,%.6f,%.6f\n" % point for point in points]
    trickle = rng.random() < 0.5
    with tempfile.TemporaryDirectory(prefix="splinefeed-paused-") as folder:
        drive = Drive(tool, folder, 0, 3)
        keys = f"max_velocity_mm_s = {FEED}\nmax_acceleration_mm_s2 = {ACCELERATION}\nsteps_per_mm = {STEPS}\n"
        with open(os.path.join(folder, "machine.toml"), "w", encoding="ascii") as file:
            addresses = [f"{drive.tcp_address()}&axis={k}" for k in range(3)]
            file.write(machine_text([(name, keys) for name in "xyz"], addresses,
                                    f"name = \"paused\"\n[path]\nmax_feed_mm_s = {FEED}\n"))
        with subprocess.Popen([tool, "run", "-", "-m", "machine.toml", "--target", "modbus", "--curve", "polyline", "--quiet"],
                              cwd=folder, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) as tool_run:
            half = len(rows) // 2
            tool_run.stdin.write("".join(rows[:half]).encode())
            tool_run.stdin.flush()
            time.sleep(PAUSE_S + 0.25 * half)
            paused = time.monotonic()
            for row in rows[half:]:
                tool_run.stdin.write(row.encode())
                tool_run.stdin.flush()
                time.sleep(rng.uniform(0.0, 0.25) if trickle else 0.0)
            tool_run.stdin.close()
            errors = tool_run.stderr.read().decode().strip()
            status = tool_run.wait(timeout=60)
        time.sleep(0.3)
        problems = drive.stop()
        start = drive.start_s()
        shafts = [[start + row[0]] + [count / STEPS for count in row[1:]] for row in drive.shaft_rows()]
    if status != 0 or errors:
        problems.append(f"exit status {status}: {errors}")
    return problems + judge(shafts, points, paused)


def judge(shafts, points, paused):
    problems = []
    rest = [row[1:] for row in shafts if paused - 0.3 < row[0] < paused]
    if not rest or any(row != rest[0] for row in rest):
        problems.append("they do not rest in the pause")
    elif math.dist(rest[0], shafts[0][1:]) < 1.0:
        problems.append("they did not move before the pause")
    off = max(min(distance(row[1:], a, b) for a, b in zip(points, points[1:])) for row in shafts[::4])
    if off > OFF_MM:
        problems.append(f"{off:.4f} mm off the path")
    if math.dist(shafts[-1][1:], points[-1]) > 2.0 / STEPS:
        problems.append(f"they end at {shafts[-1][1:]}, not at {points[-1]}")
    for k in (1, 2, 3):
        place = [row[k] for row in shafts[::8]]
        steepest = max(abs(a - 2 * b + c) for a, b, c in zip(place, place[1:], place[2:])) / 0.008 ** 2
        if steepest > ACCELERATION * TOLERATED + 2.0 / STEPS / 0.008 ** 2:
            problems.append(f"a shaft accelerates by {steepest:.0f} mm/s^2")
    return problems


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("tool", type=os.path.abspath)
    parser.add_argument("--runs", type=int, default=2)
    parser.add_argument("--seed", type=int, default=None)
    options = parser.parse_args()
    seed = options.seed if options.seed is not None else random.SystemRandom().randrange(10**9)
    print(f"seed {seed}, {options.runs} runs", flush=True)
    failed = 0
    for i in range(options.runs):
        problems = run(options.tool, seed + i)
        failed += 1 if problems else 0
        for problem in problems:
            print(f"--seed {seed + i} --runs 1: {problem}", flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
