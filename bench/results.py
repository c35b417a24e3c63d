#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Makes docs/results.md: every example run in the simulated machine and judged from its files alone.

    /usr/bin/python3 bench/results.py --yardstick DIR > docs/results.md

DIR holds check_run.py and optimum.py, the independent judge. Needs python3-numpy, python3-scipy and a release build.
"""
import argparse
import csv
import json
import os
import subprocess
import sys
import tempfile

import numpy as np

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
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


def machine(path, axes, feed, acceleration):
    with open(path, "w") as f:
        f.write(f'name = "measured"\nsample_period_us = 1000\n[path]\nmax_feed_mm_s = {feed}\n')
        for axis in axes:
            f.write(f'[[axis]]\nname = "{axis}"\nmax_velocity_mm_s = {feed}\n')
            f.write(f"max_acceleration_mm_s2 = {acceleration}\nsteps_per_mm = 320\n")


def optimum_with_stops(yardstick, curve, machine_file):
    """Least time where the curve is travelled from corner to corner, at rest at each: the sum over its smooth runs."""
    sys.path.insert(0, yardstick)
    import optimum as opt
    import tomllib
    with open(machine_file, "rb") as f:
        m = tomllib.load(f)
    with open(curve) as f:
        segments = [np.array(s["control_points"], float) for s in json.load(f)["segments"]]
    lim = dict(feed=m["path"]["max_feed_mm_s"], velocity=[a["max_velocity_mm_s"] for a in m["axis"]],
               acceleration=[a["max_acceleration_mm_s2"] for a in m["axis"]], jerk=[np.inf] * len(m["axis"]))
    runs, last = [], None
    for s in segments:
        t0 = s[1] - s[0]
        t0 = t0 / np.linalg.norm(t0)
        if last is None or np.linalg.norm(t0 - last) > 1e-3:
            runs.append([])
        runs[-1].append(s)
        last = (s[-1] - s[-2]) / np.linalg.norm(s[-1] - s[-2])
    length = sum(np.linalg.norm(np.diff(s, axis=0), axis=1).sum() for s in segments)
    ds = max(length / 20000, min(length / 4000, 0.02))
    return len(runs) - 1, sum(opt.accel_optimum(opt.Path(r, min(ds, 0.01)), lim)[0] for r in runs)


def read_trace(path):
    with open(path, newline="") as f:
        rows = list(csv.reader(f))
    return np.array([[float(x) for x in row[1:-1]] for row in rows[1:]])


def row(args, work, program, options, machine_file, scalar, reference):
    trace, curve = os.path.join(work, f"{scalar}.csv"), os.path.join(work, "curve.json")
    command = [args.tool, "run", os.path.join(ROOT, "examples", program), "-m", machine_file, "--scalar", scalar,
               "--trace", trace, "--curve-out", curve, "--summary", "json", "--quiet", *options]
    summary = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    check = ["/usr/bin/python3", os.path.join(args.yardstick, "check_run.py"), "--trace", trace, "--machine", machine_file,
             "--curve", curve]
    if program.endswith(".csv"):
        check += ["--waypoints", os.path.join(ROOT, "examples", program)]
    r = json.loads(subprocess.run(check, check=True, capture_output=True, text=True).stdout)
    stops, best = reference or optimum_with_stops(args.yardstick, curve, machine_file)
    samples = read_trace(trace)
    apart = "-"
    if scalar == "double":
        row.double = samples
    elif scalar == "fixed":
        same = len(samples) == len(row.double)
        apart = f"{np.abs(samples - row.double).max() * 1e6:.2f}" if same else "other length"
    print(f"| {scalar} | {summary['cycle_time_s']:.4f} | {r['cycle_time_s'] / best:.4f} | {r['use.velocity']:.6f} | "
          f"{r['use.acceleration']:.6f} | {r['use.feed']:.6f} | {r['path_error_mm'] * 1e3:.3f} | "
          f"{r.get('waypoint_error_mm', 0) * 1e3:.2g} | {r['joints.curvature_jump']:.1e} | {apart} |", flush=True)
    return stops, best


def table(args, work, title, program, options, machine_file):
    print(f"\n### {title}\n")
    print("| scalar | cycle time [s] | over optimum | velocity use | acceleration use | feed use | path error [um] | "
          "waypoint error [um] | curvature jump | fixed to double [nm] |")
    print("|---|---|---|---|---|---|---|---|---|---|", flush=True)
    reference = None
    for scalar in SCALARS:
        reference = row(args, work, program, options, machine_file, scalar, reference)
    print(f"\nLeast possible time: {reference[1]:.4f} s with {reference[0]} stops at corners.")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--yardstick", required=True)
    parser.add_argument("--tool", default=os.path.join(ROOT, "build/release/bin/splinefeed"))
    args = parser.parse_args()
    args.yardstick = os.path.abspath(args.yardstick)
    print("# Results\n\nMade by `bench/results.py --yardstick DIR > docs/results.md`; every figure is judged from the files of a run"
          " (trace,\ncurve, machine), by finite differences of the trace at 1 ms. `over optimum` is the cycle time over the"
          " least time that is\npossible on the same curve under the same velocity, acceleration and feed limits, at rest at"
          " every corner of the curve\n(TOPP-RA on a fine grid). 1 in a `use` column is the limit.")
    with tempfile.TemporaryDirectory() as work:
        print("\n## Three axes, 100 mm/s, 1000 mm/s^2 each, feed 100 mm/s, 1 ms")
        for program, options in PROGRAMS:
            file = os.path.join(work, "machine.toml")
            machine(file, "xyz", 100, 1000)
            table(args, work, " ".join([program, *options]), program, options, file)
        print("\n## The butterfly, two axes, 1 ms")
        for feed, acceleration in BUTTERFLY:
            file = os.path.join(work, "machine.toml")
            machine(file, "xy", feed, acceleration)
            table(args, work, f"butterfly.json, {feed} mm/s, {acceleration} mm/s^2", "butterfly.json", [], file)


if __name__ == "__main__":
    main()
