#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Runs a program in the simulated machine and holds it against what README.md claims, judged by judge.py.

    gates.py TOOL PROGRAM            PROGRAM: a path in examples/, or `uneven`: points 0.02 to 20 mm apart;
                                     or `known`, `known_without_jerk`, `straight`, `monotone`: plans held against known times and each other (time_gates.py)

With SPLINEFEED_LONG=1 on finer grids, and with all limits that docs/explanation/feed.md and feed_derivation.md have figures of. --keep FOLDER: programs and machine
files stay there."""
import argparse
import contextlib
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import needed  # noqa: F401
from judge import INTERVALS, judged_files, largest
from machine_text import machine_text
from time_gates import TIME_GATES
from uneven_path import write_uneven_path

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
OVER_LEAST = {"acceleration": 1.01, "jerk": 1.02}
LIMIT_USE = 0.999995  # 6e-6 of each limit is kept for rounding: MotionLimits::make
CURVATURE_JUMP = 1e-8  # relative; and in 1/mm where points are 0.02 mm apart: there a Fixed's last bit is 1e-7 of a small curvature
WAYPOINT_MM = 1e-8
# The trace has 12 decimals of mm, and sums of integers of 2^-32 counts are rounded once.
FROM_TRACE_MM = 1e-10
UNEVEN_SEED = 20

MACHINES = {
    "butterfly.json": ("xy", [(250, 2000, None), (250, 2000, 20000)],
                       [(40, 500, 20000), (50, 1000, 50000), (100, 3000, 60000), (200, 3000, 60000), (300, 2500, 50000)]),
}
OTHERS = ("xyz", [(100, 1000, None), (100, 1000, 30000)], [(100, 1000, 10000), (50, 2000, 100000)])


def problems(tool, program, axes, limits, folder):
    """Of a run under these limits (feed and velocity, acceleration, jerk or None): each a sentence."""
    feed, acceleration, jerk = limits
    kind = "jerk" if jerk else "acceleration"
    os.chdir(folder)
    Path("machine.toml").write_text(machine_text(axes, *limits), encoding="ascii")
    call = subprocess.run([tool, "run", program, "-m", "machine.toml", "--trace", "trace.csv", "--segments", "segments.csv",
                           "--curve-out", "curve.json", "--quiet"], capture_output=True, text=True, check=False)
    if call.returncode != 0:
        return [f"exit status {call.returncode}: {call.stderr}"]
    found = judged_files("machine.toml", "curve.json", "trace.csv", "segments.csv", program, kind)
    use, between = largest(found["use"]), largest(found["use_between"])
    uneven = Path(program).stem == "uneven"
    jump = "curvature_jump_1_mm" if uneven else "curvature_jump"
    period_s = 1e-3
    smoothing_mm = period_s**2 * acceleration * len(axes) ** 0.5 / 6.0  # docs/explanation/feed_derivation.md, step 7 of the proof
    gates = [
        ("cycle time over the least", found["over_least"], OVER_LEAST[kind]),
        ("limits used on the samples", use, LIMIT_USE),
        ("limits used between them", between, LIMIT_USE),
        ("path error [mm]", found["path_error_mm"], smoothing_mm),
        ("waypoint error [mm]", found["waypoint_error_mm"], WAYPOINT_MM),
        (jump.replace("_", " "), found["joints"][jump], CURVATURE_JUMP),
        ("gap of the curve [mm]", found["joints"]["gap_mm"], WAYPOINT_MM),
        ("turn of its tangent [rad]", found["joints"]["turn_rad"], CURVATURE_JUMP),
        ("trace off the segments [mm]", found["segments"]["from_trace_mm"], FROM_TRACE_MM),
        ("gap between segments [mm]", found["segments"]["gap_mm"], 0.0),
    ]
    print(f"{Path(program).name}, {feed} mm/s, {acceleration} mm/s^2, {jerk or 'no'} mm/s^3: {found['cycle_time_s']:.4f} s, "
          f"least {found['least_time_s']:.4f} s with {found['stops']} stops")
    for name, value, gate in gates:
        print(f"    {name}: {value:.6g}, at most {gate:.6g}")
    return [f"{name}: {value:.9g}, not at most {gate:.9g} ({kind})" for name, value, gate in gates if not value <= gate]


def problems_of_program(tool, name, folder):
    long = os.environ.get("SPLINEFEED_LONG") == "1"
    if long:
        INTERVALS.update({kind: 3 * count for kind, count in INTERVALS.items()})
    axes, cases, more = MACHINES.get(name, OTHERS)
    program = str(EXAMPLES / name)
    if name == "uneven":
        program = os.path.join(folder, "uneven.csv")
        write_uneven_path(program, UNEVEN_SEED)
    return [problem for limits in cases + (more if long else []) for problem in problems(tool, program, axes, limits, folder)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tool", type=os.path.abspath)
    parser.add_argument("program")
    parser.add_argument("--keep", type=os.path.abspath, metavar="FOLDER")
    options = parser.parse_args()
    with contextlib.ExitStack() as stack:
        folder = options.keep or stack.enter_context(tempfile.TemporaryDirectory(prefix="splinefeed-gates-"))
        os.makedirs(folder, exist_ok=True)
        if options.program in TIME_GATES:
            failed = TIME_GATES[options.program](options.tool, Path(folder))
        else:
            failed = problems_of_program(options.tool, options.program, folder)
    for problem in failed:
        print("FALLS SHORT:", problem)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
