#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""What the look-ahead of the plan is worth: cycle times of a program over windows, as a Markdown table.

    bench/window.py --tool build/release/bin/splinefeed --jerk 30000 examples/path61.csv
    bench/window.py --feed 250 --acceleration 2000 --jerk 20000 --axes xy examples/butterfly.json

The acceleration-limited machine, and with --jerk the same with a jerk limit. The lines below say what is reached in --memory
KiB, with the largest window (a multiple of 4 cells) that needs no more. The memory is what the tool says of the plan, the stage of
arc length included; it depends on the capacity that the tool was built with (SPLINEFEED_MAX_AXES, SPLINEFEED_MAX_DEGREE).
Options that are not known are passed on to the tool. Python's standard library only.
"""
import argparse
import json
import os
import pathlib
import subprocess
import tempfile

WINDOWS = [16, 24, 32, 48, 64, 96, 128, 256, 512, 1024, 2048, 4096]
FINEST = 4  # cells; a jerk-limited plan gets a quarter of them


def machine(arguments, jerk):
    text = f'name = "window.py"\n[path]\nmax_feed_mm_s = {arguments.feed}\n'
    for axis in arguments.axes:
        text += f'[[axis]]\nname = "{axis}"\nmax_velocity_mm_s = {arguments.feed}\nsteps_per_mm = 320\n'
        text += f"max_acceleration_mm_s2 = {arguments.acceleration}\n" + (f"max_jerk_mm_s3 = {jerk}\n" if jerk else "")
    return text


class Sweep:
    """Runs of one machine."""

    def __init__(self, arguments, options, jerk):
        self.arguments, self.options, self.jerk = arguments, options, jerk
        self.name = "jerk" if jerk else "acceleration"
        self.rows = [self.run(window) for window in WINDOWS]

    def run(self, window):
        """Memory of the plan in bytes, cycle time."""
        a = self.arguments
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "machine.toml"
            file.write_text(machine(a, self.jerk))
            command = [a.tool, "run", a.program, "-m", str(file), "--window", str(window), "--quiet", "--summary", "json"]
            made = subprocess.run(command + self.options, check=True, capture_output=True, text=True).stdout
        summary = json.loads(made)
        return summary["memory_bytes"]["feed_plan"], summary["cycle_time_s"]

    def above(self, seconds):
        return f"{100 * (seconds / self.rows[-1][1] - 1):.2f} %"

    def within(self, memory):
        if self.rows[0][0] > memory:
            return f"nothing: {WINDOWS[0]} cells need {self.rows[0][0] / 1024:.1f} KiB"
        low, high = WINDOWS[0], WINDOWS[-1]
        while high - low > FINEST:
            middle = (low + high) // (2 * FINEST) * FINEST
            low, high = (middle, high) if self.run(middle)[0] <= memory else (low, middle)
        used, seconds = self.run(low)
        return f"{low} cells, {used / 1024:.1f} KiB, {seconds:.4f} s, {self.above(seconds)} above the largest window"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", help="waypoints or a curve")
    parser.add_argument("--tool", type=os.path.abspath, default="build/release/bin/splinefeed")
    parser.add_argument("--axes", default="xyz")
    parser.add_argument("--feed", type=float, default=100)
    parser.add_argument("--acceleration", type=float, default=1000)
    parser.add_argument("--jerk", type=float, default=0)
    parser.add_argument("--memory", type=int, default=32, help="KiB")
    arguments, options = parser.parse_known_args()
    sweeps = [Sweep(arguments, options, jerk) for jerk in ([0.0, arguments.jerk] if arguments.jerk else [0.0])]
    print("| window |" + "".join(f" {s.name}: memory [kB] | time [s] | above the largest |" for s in sweeps))
    print("|---|" + "---|---|---|" * len(sweeps))
    for i, window in enumerate(WINDOWS):
        cells = "".join(f" {s.rows[i][0] / 1000:.1f} | {s.rows[i][1]:.4f} | {s.above(s.rows[i][1])} |" for s in sweeps)
        print(f"| {window} |{cells}")
    print()
    for sweep in sweeps:
        print(f"In {arguments.memory} KiB, {sweep.name}: {sweep.within(1024 * arguments.memory)}.")


if __name__ == "__main__":
    main()
