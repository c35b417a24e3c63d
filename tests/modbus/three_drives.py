#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A program through three simulated drives, one an axis, each a process of its own: the recorded shafts, put together by the
machine's clock, against the plan.

three_drives.py TOOL PROGRAM MACHINE [--wire tcp|rtu] [--tolerance-mm T] [--faults SPEC] [--if-long] [--under "valgrind ..."]

--faults: what the second drive does on the way; it must make all of them stop and go on once, on the path all the same.

Exit status 77: skipped, with the reason (no socat for --wire rtu; --if-long without SPLINEFEED_LONG=1)."""
import argparse
import os
import shlex
import shutil
import subprocess
import sys
import tempfile

from drive_processes import Drive, wait_for
from recorded_path import machine_file, run_and_judge


def serial_lines(folder):
    pairs = []
    for k in range(3):
        ends = [os.path.join(folder, f"{side}{k}") for side in "AB"]
        process = subprocess.Popen(["socat", *[f"pty,raw,echo=0,link={end}" for end in ends]])
        for end in ends:
            wait_for(end)
        pairs.append((process, ends))
    return pairs


def main():
    parser = argparse.ArgumentParser()
    for name in ("tool", "program", "machine"):
        parser.add_argument(name, type=os.path.abspath)
    parser.add_argument("--wire", choices=["tcp", "rtu"], default="tcp")
    parser.add_argument("--tolerance-mm", type=float, default=0.001)
    parser.add_argument("--faults", default="")
    parser.add_argument("--stall-ms", type=int, default=0, help="the run itself stands still for so long, twice")
    parser.add_argument("--under", type=shlex.split, default=[], help="a command that runs the tool and the drives")
    parser.add_argument("--if-long", action="store_true")
    options = parser.parse_args()
    if options.if_long and os.environ.get("SPLINEFEED_LONG") != "1":
        print("SKIPPED: takes minutes: ./check --long")
        return 77
    if options.wire == "rtu" and shutil.which("socat") is None:
        print("SKIPPED: there is no socat, which lays a serial cable between two processes")
        return 77
    problems = []
    with tempfile.TemporaryDirectory(prefix="splinefeed-drives-") as folder:
        lines = serial_lines(folder) if options.wire == "rtu" else []
        try:
            problems = run(options, folder, lines)
        finally:
            for process, _ in lines:
                process.terminate()
                process.wait()
    for problem in problems:
        print(problem)
    return 1 if problems else 0


def run(options, folder, lines):
    baud = "?baud=115200&parity=E&unit=1"
    faults = ["", options.faults, ""]
    if lines:
        drives = [Drive(options.tool, folder, k, 1, listen=f"rtu://{ends[1]}{baud}", faults=faults[k], under=options.under)
                  for k, (_, ends) in enumerate(lines)]
        addresses = [f"modbus-rtu://{ends[0]}{baud}" for _, ends in lines]
    else:
        drives = [Drive(options.tool, folder, k, 1, faults=faults[k], under=options.under) for k in range(3)]
        addresses = [drive.tcp_address() for drive in drives]
    machine, steps = machine_file(options.machine, folder, addresses)
    command = [*options.under, options.tool, "run", options.program, "-m", machine]
    return run_and_judge(options.wire, options.tolerance_mm, 1 if options.faults else 0, command, folder, steps, drives,
                         options.stall_ms / 1000)


if __name__ == "__main__":
    sys.exit(main())
