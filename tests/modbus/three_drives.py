#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A program through three simulated drives, one an axis, each a process of its own: the recorded shafts, put together by the
machine's clock, against the plan.

three_drives.py TOOL PROGRAM MACHINE [--wire tcp|rtu] [--tolerance-mm T] [--faults SPEC] [--if-long] [--slow] [--under "valgrind ..."]

--faults: what the second drive does on the way; it must make all of them stop and go on once, on the path all the same.

Exit status 77: skipped, with the reason (no socat for --wire rtu; --if-long without SPLINEFEED_LONG=1; a host that does not
keep time)."""
import argparse
import math
import os
import shlex
import sys

from drive_processes import Drive, folder_with_cables, missing_for
from real_time import exit_status
from recorded_path import machine_file, run_and_judge


def main():
    parser = argparse.ArgumentParser()
    for name in ("tool", "program", "machine"):
        parser.add_argument(name, type=os.path.abspath)
    parser.add_argument("--wire", choices=["tcp", "rtu"], default="tcp")
    parser.add_argument("--tolerance-mm", type=float, default=0.001)
    parser.add_argument("--faults", default="")
    parser.add_argument("--stall-ms", type=int, default=0, help="the run itself stands still for so long, twice")
    parser.add_argument("--under", type=shlex.split, default=[], help="a command that runs the tool and the drives")
    parser.add_argument("--slow", action="store_true", help="what checks the tool keeps it from keeping time: it may stop and go on")
    parser.add_argument("--if-long", action="store_true")
    options = parser.parse_args()
    if options.if_long and os.environ.get("SPLINEFEED_LONG") != "1":
        print("SKIPPED: takes minutes: ./check --long")
        return 77
    if why := missing_for(options.wire):
        print(why)
        return 77
    return exit_status(lambda: run(options))


def run(options):
    baud = "?baud=115200&parity=E&unit=1"
    faults = ["", options.faults, ""]
    with folder_with_cables(options.wire, 3) as (folder, cables):
        listen = [f"rtu://{theirs}{baud}" for _, theirs in cables] or ["tcp://127.0.0.1:0"] * 3
        drives = [Drive(options.tool, folder, k, 1, listen=listen[k], faults=faults[k], under=options.under) for k in range(3)]
        addresses = [f"modbus-rtu://{ours}{baud}" for ours, _ in cables] or [drive.tcp_address() for drive in drives]
        machine, steps = machine_file(options.machine, folder, addresses)
        command = [*options.under, options.tool, "run", options.program, "-m", machine]
        asked = (1, 1) if options.faults else (0, 2 if options.stall_ms else 0)
        if options.slow:
            asked = (asked[0], math.inf)
        return run_and_judge(options.wire, options.tolerance_mm, asked, command, folder, steps, drives, options.stall_ms / 1000)


if __name__ == "__main__":
    sys.exit(main())
