#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""What the Python module costs: bench/python.py BUILD_DIRECTORY [ROUNDS]. Planning beside the command, in turn, and sampling.

Of planning it is processor time: that of the command is what it and its start take.
"""
import os
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[1]
BUILD = pathlib.Path(sys.argv[1]).resolve()
sys.path.insert(0, str(BUILD / "python"))
import numpy as np  # pylint: disable=wrong-import-position
import splinefeed  # pylint: disable=wrong-import-position


def seconds(work):
    begun = time.perf_counter()
    work()
    return time.perf_counter() - begun


def processor_time(work, whose):
    """Of this process, or of its children that have ended [s]."""
    before = resource.getrusage(whose)
    work()
    after = resource.getrusage(whose)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    rounds = int(sys.argv[2]) if len(sys.argv) > 2 else 7
    machine = splinefeed.Machine.from_toml(ROOT / "examples/jerk_limited.toml")
    points = np.cumsum(np.random.default_rng(1).normal(0, 3, (2000, 3)), axis=0)
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "points.csv")
        np.savetxt(file, points, delimiter=",", fmt="%.17g")
        program = os.path.join(folder, "points.ngc")
        with open(program, "w", encoding="ascii") as out:
            out.write("G21 G90 G64 P0.02 F6000\n" + "".join(f"G1 X{x:.4f} Y{y:.4f} Z{z:.4f}\n" for x, y, z in points))
        for name, read, work in (("2,000 points", file, lambda: splinefeed.plan(points, machine)),
                                 ("2,000 lines of G-code", program, lambda: splinefeed.plan_gcode(program, machine))):
            command = [BUILD / "bin/splinefeed", "plan", read, "-m", ROOT / "examples/jerk_limited.toml", "--no-advice", "--quiet"]
            pairs = [(processor_time(work, resource.RUSAGE_SELF),
                      processor_time(lambda: subprocess.run(command, check=True, stdout=subprocess.DEVNULL), resource.RUSAGE_CHILDREN))
                     for _ in range(rounds)]
            module, tool = (min(column) for column in zip(*pairs))
            ratio = statistics.median(mine / theirs for mine, theirs in pairs)
            print(f"{name}: module {module:.3f} s, command {tool:.3f} s, ratio (median of {rounds} pairs) {ratio:.3f}")
    motion = splinefeed.plan(points, machine)
    times = np.linspace(0.0, motion.time, 1_000_000)
    print(f"a million samples, three axes: {min(seconds(lambda: motion.sample(times)) for _ in range(rounds)):.3f} s")
    shuffled = np.random.default_rng(2).permutation(times)
    print(f"the same times in random order: {min(seconds(lambda: motion.sample(shuffled)) for _ in range(rounds)):.3f} s")


if __name__ == "__main__":
    main()
