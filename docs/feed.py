#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Cycle times of a curve with limited jerk, as the table of docs/feed.md."""
import argparse
import json
import pathlib
import subprocess
import tempfile

CASES = [(40, 500, 20000), (50, 1000, 50000), (100, 3000, 60000), (200, 3000, 60000), (250, 2000, 20000), (300, 2500, 50000)]


def machine(feed, acceleration, jerk, tier):
    text = f'name = "feed.py"\n[path]\nmax_feed_mm_s = {feed}\njerk_plan = "{tier}"\n'
    for axis in "xy":
        text += f'[[axis]]\nname = "{axis}"\nmax_velocity_mm_s = {feed}\nmax_acceleration_mm_s2 = {acceleration}\n'
        text += f"max_jerk_mm_s3 = {jerk}\nsteps_per_mm = 1000\n"
    return text


def seconds(tool, curve, case, tier):
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "machine.toml"
        file.write_text(machine(*case, tier))
        command = [tool, "run", curve, "-m", str(file), "--quiet", "--summary", "json"]
        return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)["cycle_time_s"]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--tool", default="build/release/bin/splinefeed")
    parser.add_argument("--curve", required=True, help="a curve .json in two dimensions")
    arguments = parser.parse_args()
    for case in CASES:
        times = [seconds(arguments.tool, arguments.curve, case, tier) for tier in ("optimal", "bounded")]
        print("| {:g} / {:g} / {:g} | {:.3f} | {:.3f} |".format(*case, *times))


if __name__ == "__main__":
    main()
