#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Ctrl-Z in the middle of a motion on simulated drives: the machine is held on the path, then the process stops. When it continues, the
machine still stands, until SIGUSR2. Ctrl-Z while the machine is made ready stops nothing that moves.

suspended_run.py TOOL"""
import os
import signal
import subprocess
import sys
import time

from case_runs import by_profile, run_cases
from drive_processes import Drive, write, write_machine

STEPS = 320
AXIS = f"max_velocity_mm_s = 80\nmax_acceleration_mm_s2 = 500\nsteps_per_mm = {STEPS}\n"
AWAY_S = 3.0


def stops(run, seconds):
    """Whether the process stops (state T) within that time."""
    until = time.monotonic() + seconds
    while time.monotonic() < until and run.poll() is None:
        with open(f"/proc/{run.pid}/stat", encoding="ascii") as file:
            if file.read().rsplit(")", 1)[1].split()[0] == "T":
                return True
        time.sleep(0.005)
    return False


def run(tool, folder, profile):
    return one(tool, folder, profile, True) + one(tool, folder, profile, False)


def one(tool, folder, profile, resumes):
    """resumes: it goes on; otherwise it is ended while it is stopped."""
    problems = []
    drives = [Drive(tool, folder, k, 1, profile=profile.split("&")[0]) for k in range(2)]
    write_machine(folder, [("x", AXIS), ("y", AXIS)], drives, "[path]\nmax_feed_mm_s = 80\n", profile)
    write(folder, "part.ngc", "G1 F4800 X240 Y120\n")
    command = [tool, "run", "part.ngc", "-m", "machine.toml", "--target", "modbus"]
    run = subprocess.Popen(command, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    time.sleep(2.0)
    run.send_signal(signal.SIGTSTP)
    if not stops(run, 8.0):
        problems.append("the process does not stop")
    still = [time.monotonic()]
    time.sleep(AWAY_S)
    if resumes:
        run.send_signal(signal.SIGCONT)
        time.sleep(1.0)
        still.append(time.monotonic())
        run.send_signal(signal.SIGUSR2)
    else:
        still.append(time.monotonic() + 60)
        run.send_signal(signal.SIGTERM)
        run.send_signal(signal.SIGCONT)
    said = run.communicate(timeout=60)[1]
    for k, drive in enumerate(drives):
        problems += drive.stop()
        rows, start = drive.shaft_rows(), drive.start_s()
        while_still = [row[1] for row in rows if still[0] <= start + row[0] <= still[1]]
        if max(while_still) - min(while_still) > 1:
            problems.append(f"axis {k} moved by {max(while_still) - min(while_still)} counts while it was to be held")
        if not 5 < while_still[0] / STEPS / (240, 120)[k] * 100 < 95:
            problems.append(f"axis {k} was held at {while_still[0] / STEPS} mm")
        if resumes and abs(rows[-1][1] - (240, 120)[k] * STEPS) > 1:
            problems.append(f"axis {k} ends at {rows[-1][1] / STEPS} mm")
    words = ["the machine is held, and the process stops", "the motion goes on with kill -USR2"] if resumes else \
            ["the machine is held, and the process stops", "the machine stands at x="]
    if run.returncode != (0 if resumes else 1) or not all(word in said for word in words):
        problems.append(f"exit status {run.returncode}: {said}")
    return [f"{'resumed' if resumes else 'ended'}: {problem}" for problem in problems]


def main():
    return run_cases(os.path.abspath(sys.argv[1]), by_profile(run, ("", "cia402-index", "lexium32m&ramp=1e6")))


if __name__ == "__main__":
    sys.exit(main())
