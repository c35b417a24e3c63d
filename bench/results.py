#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Makes docs/reference/results.md: every example run in the simulated machine and judged from its files alone.

    /usr/bin/python3 bench/results.py > docs/reference/results.md

The judge is tests/judge. Needs python3-numpy, python3-scipy and a release build.
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "tests", "judge"))

from judge import judged_files  # noqa: E402
from machine_limits import MachineLimits  # noqa: E402
from machine_text import machine_text  # noqa: E402
from motion_trace import Trace  # noqa: E402

SCALARS = ["double", "fixed", "float"]
PROGRAMS = [
    ("path61.csv", []),
    ("circle720.csv", []),
    ("raster3d.csv", ["--corner-angle", "120"]),
    ("raster3d.csv", []),
    ("square.csv", ["--curve", "polyline"]),
    ("square.csv", []),
    ("star.csv", ["--curve", "polyline"]),
    ("star.csv", []),
]
BUTTERFLY = [(40, 500), (100, 3000), (200, 3000), (250, 2000), (300, 2500)]


def row(tool, work, program, options, machine_file, scalar, reference):
    trace, curve = os.path.join(work, f"{scalar}.csv"), os.path.join(work, "curve.json")
    path = os.path.join(ROOT, "examples", program)
    command = [tool, "run", path, "-m", machine_file, "--scalar", scalar, "--trace", trace, "--curve-out", curve, "--summary",
               "json", "--quiet", *options]
    summary = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    r = judged_files(machine_file, curve, trace, program=path, kind=None if reference else "acceleration")
    stops, best = reference or (r["stops"], r["least_time_s"])
    samples = Trace.read(trace, MachineLimits.read(machine_file).names).positions
    apart = "-"
    if scalar == "double":
        row.double = samples
    elif scalar == "fixed":
        same = len(samples) == len(row.double)
        apart = f"{np.abs(samples - row.double).max() * 1e6:.2f}" if same else "other length"
    use = r["use"]
    print(f"| {scalar} | {summary['cycle_time_s']:.4f} | {r['cycle_time_s'] / best:.4f} | {max(use['velocity'].values()):.6f} | "
          f"{max(use['acceleration'].values()):.6f} | {use['feed']:.6f} | {r['path_error_mm'] * 1e3:.3f} | "
          f"{r['waypoint_error_mm'] * 1e3:.2g} | {r['joints']['curvature_jump']:.1e} | {apart} |", flush=True)
    return stops, best


def table(tool, work, title, program, options, machine_file):
    print(f"\n### {title}\n")
    print("| scalar | cycle time [s] | over optimum | velocity use | acceleration use | feed use | path error [um] | "
          "waypoint error [um] | curvature jump | fixed to double [nm] |")
    print("|---|---|---|---|---|---|---|---|---|---|", flush=True)
    reference = None
    for scalar in SCALARS:
        reference = row(tool, work, program, options, machine_file, scalar, reference)
    print(f"\nLeast possible time: {reference[1]:.4f} s with {reference[0]} stops at corners.")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--tool", default=os.path.join(ROOT, "build/release/bin/splinefeed"))
    args = parser.parse_args()
    print("# Results\n\n`bench/results.py > docs/reference/results.md` makes this page. tests/judge computes every figure from the files of a"
          " run (trace,\ncurve, machine), by finite differences of the trace at 1 ms. `over optimum` is the cycle time divided by the"
          " least possible time\non the same curve. The limits are the same velocity, acceleration and feed, with standstill at"
          " every corner of the curve\n(TOPP-RA on a fine grid). 1 in a `use` column is the limit.")
    with tempfile.TemporaryDirectory() as work:
        print("\n## Three axes, 100 mm/s, 1000 mm/s^2 each, feed 100 mm/s, 1 ms")
        for program, options in PROGRAMS:
            file = os.path.join(work, "machine.toml")
            pathlib.Path(file).write_text(machine_text("xyz", 100, 1000), encoding="ascii")
            table(args.tool, work, " ".join([program, *options]), program, options, file)
        print("\n## The butterfly, two axes, 1 ms")
        for feed, acceleration in BUTTERFLY:
            file = os.path.join(work, "machine.toml")
            pathlib.Path(file).write_text(machine_text("xy", feed, acceleration), encoding="ascii")
            table(args.tool, work, f"butterfly.json, {feed} mm/s, {acceleration} mm/s^2", "butterfly.json", [], file)
    print("\n## Within a tolerance, three axes, 100 mm/s, 1000 mm/s^2 each, 1 ms\n\nOf `bench/tolerance.py --judge`: `acc` without a jerk"
          " limit, `jerk` with 30000 mm/s^3. Goals stand in parentheses;\n! marks one that was missed, ^ a time above the"
          " estimate with exact stops. Pictures and reasons: [tolerance](../explanation/tolerance.md).\n", flush=True)
    subprocess.run(["/usr/bin/python3", os.path.join(ROOT, "bench/tolerance.py"), "--tool", args.tool, "--judge"], check=True)


if __name__ == "__main__":
    main()
