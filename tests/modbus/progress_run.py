#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The progress of a run on simulated drives, on a terminal: what the machine has done, with its line and its place, not what was read.

progress_run.py TOOL"""
import os
import pty
import re
import subprocess
import sys
import tempfile
import time

from drive_processes import Drive, write, write_machine

AXIS = "max_velocity_mm_s = 80\nmax_acceleration_mm_s2 = 500\nsteps_per_mm = 320\n"
LINES = 20  # of 10 mm each, to and fro, at 40 mm/s


def shown_by(command, folder):
    """[(seconds since the start, text)], all that the program writes on its terminal."""
    master, slave = pty.openpty()
    begin = time.monotonic()
    shown = []
    with subprocess.Popen(command, cwd=folder, stdout=subprocess.DEVNULL, stderr=slave) as run:
        os.close(slave)
        while True:
            try:
                text = os.read(master, 65536).decode()
            except OSError:
                break
            if not text:
                break
            shown.append((time.monotonic() - begin, text))
        run.wait(timeout=60)
    os.close(master)
    return shown, run.returncode


def main():
    tool = os.path.abspath(sys.argv[1])
    problems = []
    with tempfile.TemporaryDirectory(prefix="splinefeed-progress-") as folder:
        drive = Drive(tool, folder, 0, 1)
        write_machine(folder, [("x", AXIS)], [drive], "[path]\nmax_feed_mm_s = 80\n")
        write(folder, "part.ngc", "G1 F2400 G61 (MSG,begun)\n" + "".join(f"X{10 * (n % 2)}\n" for n in range(1, LINES // 2)) +
              "(MSG,half)\n" + "".join(f"X{10 * (n % 2)}\n" for n in range(LINES // 2, LINES + 1)))
        shown, status = shown_by([tool, "run", "part.ngc", "-m", "machine.toml", "--target", "modbus"], folder)
        problems += drive.stop()
    text = "".join(part for _, part in shown)
    rows = [tuple(map(float, row)) for row in
            re.findall(r"(\d+) %  line (\d+), move (\d+) of \d+, ([0-9.]+) s, [0-9.]+ s left x=([0-9.]+)", text)]
    if status != 0 or len(rows) < 15:
        problems.append(f"exit status {status}: {text!r}")
    whole_s = rows[-1][3] * LINES / rows[-1][2] if rows else 0.0
    for percent, line, move, motion_s, x in rows:
        if abs(motion_s / whole_s * LINES - move) > 1.5 or not 1 <= line - move <= 2 or abs(percent - 100 * move / LINES) > 1:
            problems.append(f"{percent} %, line {line}, move {move} after {motion_s} s at x = {x}")
    if rows and max(b[0] - a[0] for a, b in zip(rows, rows[1:])) > 20:
        problems.append(f"it jumps: {[row[0] for row in rows]}")
    if re.search(r"[^\n\rK]half", text):
        problems.append("a message stands behind the line")
    for problem in problems:
        print(problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
