#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Fixed is at every millisecond where double is, within 1e-4 mm: fixed_to_double.py TOOL

Both plan the same motion but for rounding. An error of the same sign in every cell makes one of them slower, and the distance grows with
the length of the run: so a long run on which one cell is like another, and a fast one in curves."""
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import needed  # noqa: F401
import numpy as np
from machine_text import machine_text
from motion_trace import Trace

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
MOST_MM = 1e-4
RUNS = [("raster3d.csv", ["--corner-angle", "120"], "xyz", 100, 1000), ("butterfly.json", [], "xy", 300, 2500)]


def main():
    tool = os.path.abspath(sys.argv[1])
    failed = False
    with tempfile.TemporaryDirectory(prefix="splinefeed-scalars-") as folder:
        os.chdir(folder)
        for program, options, axes, feed, acceleration in RUNS:
            Path("machine.toml").write_text(machine_text(axes, feed, acceleration), encoding="ascii")
            traces = []
            for scalar in ("fixed", "double"):
                subprocess.run([tool, "run", EXAMPLES / program, "-m", "machine.toml", "--scalar", scalar, "--trace", "trace.csv", "--quiet",
                                *options], check=True, stdout=subprocess.DEVNULL)
                traces.append(Trace.read("trace.csv", axes).positions)
            fixed, double = traces
            if len(fixed) != len(double):
                print(f"{program}: {len(fixed)} samples, {len(double)} in double")
                failed = True
                continue
            apart = np.abs(fixed - double).max()
            print(f"{program} {' '.join(options)}: {apart * 1e6:.1f} nm apart in {len(fixed) * 1e-3:.1f} s, at most {MOST_MM * 1e6:.0f}")
            failed = failed or not apart <= MOST_MM
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
