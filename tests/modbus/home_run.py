#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""`splinefeed run --home` on simulated drives that stand somewhere: each finds its reference, and the program begins there.

home_run.py TOOL"""
import json
import os
import subprocess
import sys

from case_runs import by_profile, run_cases
from drive_processes import Drive, write, write_machine

STEPS = 320
START = (4000, -2500)
WAY_MM = (3.0, -2.0)
TURNED = (1, -1)  # y is inverted: its drive counts down where the axis goes up
AXIS = f"max_velocity_mm_s = 100\nmax_acceleration_mm_s2 = 1000\nsteps_per_mm = {STEPS}\n"


def run(tool, folder, profile):
    drives = [Drive(tool, folder, k, 1, profile=profile, position=START[k]) for k in range(2)]
    write_machine(folder, [("x", AXIS), ("y", AXIS + "invert = true\n")], drives, "[path]\nmax_feed_mm_s = 100\n", profile)
    write(folder, "way.csv", f"0,0\n{WAY_MM[0]},{WAY_MM[1]}\n")
    called = subprocess.run([tool, "run", "way.csv", "-m", "machine.toml", "--target", "modbus", "--home", "--summary", "json"],
                            cwd=folder, capture_output=True, text=True, timeout=100, check=False)
    problems = [problem for drive in drives for problem in drive.stop()]
    if called.returncode != 0:
        return problems + [f"exit status {called.returncode}: {called.stderr}"]
    json.loads(called.stdout)
    for k, drive in enumerate(drives):
        rows = [row[1] for row in drive.shaft_rows()]
        if abs(rows[0] - START[k]) > 1e-6:
            problems.append(f"axis {k} begins at {rows[0]} counts")
        home = next((i for i, place in enumerate(rows) if abs(place) < 1e-3), None)
        if home is None:
            problems.append(f"axis {k} does not find its reference")
        elif max(abs(b - a) for a, b in zip(rows[:home], rows[1:home + 1])) > 500:
            problems.append(f"axis {k} jumps on its way to the reference")
        if abs(rows[-1] - TURNED[k] * WAY_MM[k] * STEPS) > 1e-2:
            problems.append(f"axis {k} ends at {rows[-1]} counts, not {TURNED[k] * WAY_MM[k] * STEPS}")
    return problems


def main():
    return run_cases(os.path.abspath(sys.argv[1]), by_profile(run, ("", "cia402-index", "cia402-kinco", "leadshine-pr", "oriental-az")))


if __name__ == "__main__":
    sys.exit(main())
