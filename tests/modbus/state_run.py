#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A program in G-code that a signal ends on simulated drives: --state, the message and the summary have the place and the line that the
drives have come to, not those of the plan, which is ahead.

state_run.py TOOL"""
import json
import os
import re
import signal
import subprocess
import sys
import time

from case_runs import by_profile, run_cases
from drive_processes import Drive, write, write_machine

STEPS = 320
AXIS = f"max_velocity_mm_s = 100\nmax_acceleration_mm_s2 = 1000\nsteps_per_mm = {STEPS}\n"
LINES = 200  # of 0.5 mm along x, at 10 mm/s: a line lasts 50 ms; Q0: no two of them are joined
STOP_AFTER_S = 5.0


def run(tool, folder, profile):
    drives = [Drive(tool, folder, k, 1, profile=profile) for k in range(2)]
    write_machine(folder, [("x", AXIS), ("y", AXIS)], drives, "[path]\nmax_feed_mm_s = 100\n", profile)
    write(folder, "part.ngc", "G1 F600 G64 Q0\n" + "".join(f"X{0.5 * n}\n" for n in range(1, LINES + 1)))
    process = subprocess.Popen([tool, "run", "part.ngc", "-m", "machine.toml", "--target", "modbus", "--state", "state.json",
                                "--summary", "json"], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    time.sleep(STOP_AFTER_S)
    process.send_signal(signal.SIGTERM)
    output, error = process.communicate(timeout=60)
    problems = [problem for drive in drives for problem in drive.stop()]
    said = re.search(r"the machine stands at x=(\S+) y=(\S+) mm, on line (\d+)$", error.strip())
    if process.returncode != 1 or said is None:
        return problems + [f"exit status {process.returncode}: {error}"]
    with open(os.path.join(folder, "state.json"), encoding="utf-8") as file:
        kept = json.load(file)["position_mm"]
    shafts = [drive.shaft_rows()[-1][1] / STEPS for drive in drives]
    for k in range(2):
        if abs(kept[k] - float(said[k + 1])) > 1e-4 or abs(kept[k] - shafts[k]) > 2.0 / STEPS:
            problems.append(f"axis {k} stands at {shafts[k]}; the message says {said[k + 1]}, the state {kept[k]}")
    line = int(said[3])
    # A segment names the line at its end, and the smoothing holds the axis back by one more: two segments of 10 um.
    if not 0.5 * (line - 2) - 2e-2 <= shafts[0] <= 0.5 * (line - 1) + 1e-2 or not 3 < line < LINES:
        problems.append(f"x stands at {shafts[0]}, and the message says line {line}")
    if json.loads(output)["program"]["line"] != line:
        problems.append("the summary has another line than the message")
    return problems


def main():
    return run_cases(os.path.abspath(sys.argv[1]), by_profile(run, ("", "cia402-index")))


if __name__ == "__main__":
    sys.exit(main())
