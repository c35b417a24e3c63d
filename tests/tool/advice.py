#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What would help, as a summary says it, is what comes of raising limits by hand: advice.py TOOL.

Of each program the five largest gains: planned with the --set that is said, or with the feeds of the program edited."""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples"
RUNS = [("path61.csv", "three_axis"), ("circle720.csv", "three_axis"), ("square.csv", "jerk_limited"), ("star.csv", "jerk_limited"),
        ("butterfly.json", "jerk_limited"), ("cam.json", "three_axis"), ("ring.gcode", "three_axis"), ("bracket.ngc", "three_axis"),
        ("bracket.ngc", "jerk_limited"), ("nameplate.nc", "three_axis")]
KEYS = {"velocity": "max_velocity_mm_s", "acceleration": "max_acceleration_mm_s2", "braking": "max_braking_mm_s2", "jerk": "max_jerk_mm_s3",
        "machine's feed": "max_feed_mm_s", "centripetal limit": "centripetal_mm_s2", "chord error": "chord_error_mm"}
LARGEST = 5
SAME = 0.001  # of the cycle time: gains are parts of it
FEED = r"(?<![A-Z#<])(F)(\d+\.?\d*)"


def planned(tool, program, machine, *more):
    dialect = {".nc": ["--dialect", "grbl"], ".gcode": ["--dialect", "marlin", "--ignore", "E"]}.get(program.suffix, [])
    call = subprocess.run([tool, "plan", program, "-m", machine, *dialect, "--summary", "json", "--quiet", *more], capture_output=True, text=True,
                          check=True)
    return json.loads(call.stdout)


def raised(text, pattern):
    """The text with every number that the pattern finds 10 % higher."""
    out, count = re.subn(pattern, lambda found: f"{found[1]}{float(found[2]) * 1.1!r}", text, flags=re.MULTILINE)
    assert count > 0, pattern
    return out


def by_hand(tool, folder, program, machine, said):
    """The cycle time with one limit raised."""
    if said["limit"] == "programmed feed":
        assert said["set"] is None
        program_file = folder / program.name
        program_file.write_text(raised(program.read_text(), FEED))
        return planned(tool, program_file, machine, "--no-advice")["cycle_time_s"]
    kind, _, axis = said["limit"].partition(" of ")
    key = f"axis.{axis}.{KEYS[kind]}" if axis else f"path.{KEYS[kind]}"
    assert said["set"].startswith(f"{key}="), said
    return planned(tool, program, machine, "--set", said["set"], "--no-advice")["cycle_time_s"]


def main():
    tool = str(pathlib.Path(sys.argv[1]).resolve())
    wrong = compared = 0
    with tempfile.TemporaryDirectory() as name:
        for program, machine in ((EXAMPLES / program, EXAMPLES / f"{machine}.toml") for program, machine in RUNS):
            summary = planned(tool, program, machine)
            for said in summary["what_would_help"][:LARGEST]:
                time = by_hand(tool, pathlib.Path(name), program, machine, said)
                gain = 1.0 - time / summary["cycle_time_s"]
                compared += 1
                if abs(said["cycle_time_s"] - time) > SAME * time or abs(said["gain"] - gain) > SAME:
                    wrong += 1
                    print(f"{program.name} on {machine.name}, {said['limit']}: it says {said['cycle_time_s']:.6f} s, by hand {time:.6f} s "
                          f"(gains {said['gain']:.5f} and {gain:.5f})")
    print(f"{len(RUNS)} programs, {compared} limits, {wrong} wrong")
    sys.exit(1 if wrong or compared < 3 * len(RUNS) else 0)


if __name__ == "__main__":
    main()
