#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A program through three simulated drives that do not interpolate, one an axis, each a process of its own: the recorded
shafts, put together by the machine's clock, stay as near to the plan as docs/reference/modbus.md says.

profile_run.py TOOL PROGRAM MACHINE PROFILE --tolerance-mm T [--wire tcp|rtu] [--baud N] [--address-keys "&ramp=1e6"] [--faults LIST]

Exit status 77: skipped, with the reason (no socat for --wire rtu; a host that does not keep time)."""
import argparse
import json
import math
import os
import sys

from drive_processes import Drive, fields, folder_with_cables, missing_for
from real_time import OffTime, called, exit_status
from recorded_path import SPEED_MM_S, furthest, machine_file, plan_points, shafts_together

ANSWER_S = 0.1  # a drive that answers later does not answer
START_COUNTS = (0, 1000, -70000)  # where the shafts stand at first: their own business


def main():
    parser = argparse.ArgumentParser()
    for name in ("tool", "program", "machine"):
        parser.add_argument(name, type=os.path.abspath)
    parser.add_argument("profile")
    parser.add_argument("--tolerance-mm", type=float, required=True)
    parser.add_argument("--slow", action="store_true", help="what checks the tool keeps it from keeping time: it may stop and go on")
    parser.add_argument("--wire", choices=["tcp", "rtu"], default="tcp")
    parser.add_argument("--baud", default="115200")
    parser.add_argument("--address-keys", default="")
    parser.add_argument("--faults", default="", help="of the second drive; then all must have stopped together and gone on")
    options = parser.parse_args()
    if why := missing_for(options.wire):
        print(why)
        return 77
    return exit_status(lambda: run(options))


def run(options):
    query = f"?baud={options.baud}&parity=E&unit=1"
    keys = f"profile={options.profile}{options.address_keys}"
    with folder_with_cables(options.wire, 3) as (folder, cables):
        listen = [f"rtu://{theirs}{query}" for _, theirs in cables] or ["tcp://127.0.0.1:0"] * 3
        drives = [Drive(options.tool, folder, k, 1, listen=listen[k], faults=options.faults if k == 1 else "",
                        profile=options.profile, position=START_COUNTS[k]) for k in range(3)]
        addresses = [f"modbus-rtu://{ours}{query}&{keys}" for ours, _ in cables] or \
                    [drive.tcp_address(keys) for drive in drives]
        machine, steps = machine_file(options.machine, folder, addresses)
        try:
            call = called([options.tool, "run", options.program, "-m", machine, "--target", "modbus", "--segments", "plan.csv",
                           "--summary", "json"], folder)
        finally:
            problems = [problem for drive in drives for problem in drive.stop()]
        if call.status != 0:
            return call.excused(problems + [OffTime(f"exit status {call.status}: {call.errors}", ANSWER_S)])
        plan = fields(os.path.join(folder, "plan.csv"))
        return call.excused(problems + judge(options, json.loads(call.output), plan, steps, drives))


def judge(options, summary, plan, steps, drives):
    path = plan_points(plan, steps)
    # What a drive calls its position where the motion begins is where the plan begins.
    moved = [start / per_mm - begin for start, per_mm, begin in zip(START_COUNTS, steps, path[0])]
    rows = [[row[0]] + [place - off for place, off in zip(row[1:], moved)] for row in shafts_together(drives, steps)]
    worst, left = furthest(rows, path, 400, 800)
    end = max(abs(row - planned) * per_mm for row, planned, per_mm in zip(rows[-1][1:], path[-1], steps))
    link = summary["link"]
    took = rows[next(i for i in reversed(range(len(rows))) if math.dist(rows[i][1:], rows[-1][1:]) > 1e-4)][0] - \
        rows[next(i for i in range(len(rows)) if math.dist(rows[i][1:], rows[0][1:]) > 1e-4)][0]
    print(f"{options.profile}, {options.wire}: path error {1000 * worst:.1f} um, stated {1000 * link['between_targets_mm']:.1f} "
          f"um, a target each {1000 * link['target_period_s']:.2f} ms, the latest {1000 * link['latest_target_s']:.1f} ms late, "
          f"{link['resumes']} resumes, took {took:.3f} of {summary['cycle_time_s']:.3f} s, end off by {end:.2g} counts")
    problems = []
    if worst > options.tolerance_mm:
        problems.append(OffTime.off_path(worst, options.tolerance_mm, SPEED_MM_S))
    if link["resumes"] > (1 if options.faults else 0) and not options.slow:
        problems.append(OffTime(f"all stopped and went on {link['resumes']} times"))
    if left > 20:
        lost = "they do not come to the end of the path"
        problems.append(OffTime(lost) if link["resumes"] > 0 and end <= 1e-2 else lost)
    if end > 1e-2:
        problems.append(f"they end {end} counts from where the plan ends")
    if link["resumes"] == 0 and abs(took - summary["cycle_time_s"]) > 0.06 + 2 * link["target_period_s"]:
        problems.append(OffTime(f"they moved for {took:.3f} s, not {summary['cycle_time_s']:.3f} s"))
    if options.faults and link["resumes"] == 0:
        problems.append("they did not stop for the one with the faults")
    return problems


if __name__ == "__main__":
    sys.exit(main())
