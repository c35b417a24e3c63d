#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Random programs through headless LinuxCNC with splinefeed_tp.so: limits, tolerance, and cycle times beside those of the tool.

  bench/linuxcnc_random.py [--programs 300] [--seed 1] [--in-one 15] [--jobs 2] [--jerk 30000] [--period 1000]
      [--module build/linuxcnc/linuxcnc/splinefeed_tp.so] [--tool build/tool/bin/splinefeed] [--linuxcnc TREE]

Lines, arcs and rapids in one of the three planes, as bench/tolerance.py makes them, with G61 or G64 P0.001 to P0.5 and Q0. LinuxCNC runs
`in-one` of them in one file, with dwells and a rapid back between them, in real time. What each axis was told is cut at the dwells. A
program fails where a limit is exceeded by 1e-4, where it leaves its tolerance or an end (tests/judge), or where it takes 1.5 % and 10 ms
longer than `splinefeed run` says. A slow one is run once more, because a loaded computer delays LinuxCNC's task. Exit status 1: one
failed."""
import argparse
import concurrent.futures
import json
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "tests/judge")]
import linuxcnc_tp  # noqa: E402, and takes bench/ from the path again

PLANES = {"G17": "XYIJ", "G18": "ZXKI", "G19": "YZJK"}
DWELL_S, CUT_S = 0.4, 0.3
SLOW, LOST = " it is slow", " it did not come to its end"


class Program:
    """Its blocks, and what the tool says of it."""

    def __init__(self, seed, options):
        source = random.Random(seed)
        blocks = linuxcnc_tp.load(HERE / "tolerance.py").random_gcode(source).removesuffix("M2\n")
        self.seed, self.tolerance = seed, round(10.0 ** source.uniform(-3.0, -0.3), 4)
        plane = source.choice(list(PLANES))
        blocks = re.sub("[XYIJ]", lambda m: PLANES[plane]["XYIJ".index(m[0])], blocks)
        blocks = re.sub("G1 ", lambda m: "G0 " if source.random() < 0.1 else m[0], blocks)
        mode = "G61" if source.random() < 0.15 else f"G64 P{self.tolerance} Q0"
        self.text = f"{mode}\n{plane}\n{blocks}"
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            self.seconds = linuxcnc_tp.tool_time(options, f"G21 G90\n{self.text}M2\n", "XYZ", folder)
            planned = subprocess.run([options.tool, "plan", folder / "tool.ngc", "-m", folder / "m.toml", "--elements", folder / "e.json", "--quiet"],
                                     capture_output=True, text=True, check=False)
            if planned.returncode != 0:
                raise SystemExit(f"seed {seed}: the tool says: {planned.stderr}")
            from element_path import read_elements  # needs numpy
            self.machine = tomllib.loads((folder / "m.toml").read_text())
            self.elements = read_elements(folder / "e.json", self.machine)


def session(programs):
    """One file for LinuxCNC."""
    between = f"G17\nG4 P{DWELL_S}\nG64 P0.01 Q0\nG0 X0 Y0 Z0\nG4 P{DWELL_S}\n"
    return "G21 G90 G17 G94 G40 G49 G80\n" + between.join(p.text for p in programs) + "M2\n"


def motions(samples, ends, period_us):
    """(first, last) sample of each motion that ends with a dwell at the next one of `ends`."""
    import numpy

    moved = numpy.flatnonzero(numpy.abs(numpy.diff(samples[:, :3], axis=0)).max(axis=1) > 1e-9)
    stops = numpy.append(numpy.flatnonzero(numpy.diff(moved) > CUT_S * 1e6 / period_us), len(moved) - 1)
    found, begin = [], 0
    for stop in stops if len(moved) else []:
        if len(found) < len(ends) and numpy.abs(samples[moved[stop] + 1, :3] - ends[len(found)]).max() < 1e-5:
            found.append((moved[begin], moved[stop] + 1))
            begin = stop + 1
    return found


def judged(program, samples, options):
    """What is wrong with a program; its uses of limits, and how far it is beyond its tolerance [mm]."""
    import numpy
    from motion_trace import Trace
    from path_tolerance import judged as within

    used = linuxcnc_tp.limits_used(samples, "XYZ", options.period, options.jerk)
    times = numpy.arange(len(samples)) * options.period * 1e-6
    found = within(program.elements, program.machine, Trace(times, samples[:, :3]), ["x", "y", "z"])
    problem = "" if max(used[1:]) <= 1.0001 else " a limit is exceeded"
    problem += "" if found["kept"] else f" {found['over_mm']:.5f} mm beyond its tolerance"
    problem += "" if used[0] <= 1.015 * program.seconds + 0.01 else SLOW
    return problem, used, found["over_mm"] - found["slack_mm"]


def run(seeds, options):
    """Rows (seed, problem, times of both, uses, over) of one session."""
    programs = [Program(seed, options) for seed in seeds]
    parameters = f"jerk={options.jerk}" if options.jerk else ""
    result = linuxcnc_tp.run(session(programs), "XYZ", options, options.module.resolve(), parameters, [])
    problem = "".join(f" {text}" for text in [result["problem"], *result["said"]] if text)
    if not problem and result["figures"]["splinefeed-tp.late"]:
        problem = " a period without motion"
    ends = [end for p in programs for end in (p.elements[-1]["to"][:3], [0.0] * 3)][:-1]
    found = motions(result["samples"], ends, options.period) if "samples" in result else []
    rows = [(p.seed, problem or LOST, (0.0, p.seconds), (0.0,) * 3, 0.0) for p in programs[(len(found) + 1) // 2 :]]
    for program, (first, last) in zip(programs, found[::2]):
        wrong, used, over = judged(program, result["samples"][max(first - 3, 0) : last + 4], options)
        rows.append((program.seed, wrong + problem, (used[0], program.seconds), used[1:], over))
    return rows


def run_all(seeds, options):
    parts = [seeds[i : i + options.in_one] for i in range(0, len(seeds), options.in_one)]
    rows = []
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for part in pool.map(lambda part: run(part, options), parts):
            rows += part
            for seed, problem, (ours, tool), used, _ in part:
                if problem:
                    print(f"seed {seed}: {ours:.3f} s, tool {tool:.3f} s, limits {max(used):.5f}:{problem}", flush=True)
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name, default in (("programs", 300), ("seed", 1), ("in-one", 15), ("jobs", 2)):
        parser.add_argument("--" + name, type=int, default=default)
    parser.add_argument("--tool", type=pathlib.Path, default=HERE.parent / "build/tool/bin/splinefeed")
    options = linuxcnc_tp.parsed(parser, 900)
    if options is None:
        return 0
    rows = run_all(range(options.seed, options.seed + options.programs), options)
    again = [row[0] for row in rows if row[1] in (SLOW, LOST)]
    rows = [row for row in rows if row[0] not in again] + run_all(again, options)
    good = [row for row in rows if row[2][0] > 0.0]
    ours, tool = (sum(row[2][k] for row in good) for k in (0, 1))
    most = [max((row[3][k] for row in good), default=0.0) for k in range(3)]
    slowest = max((row[2][0] / row[2][1] - 1.0 for row in good), default=0.0)
    print(f"{len(rows)} programs, {sum(1 for row in rows if row[1])} failed; {ours:.1f} s, the tool {tool:.1f} s, at most {100 * slowest:.1f} % longer; "
          f"largest use of velocity {most[0]:.5f}, acceleration {most[1]:.5f}, jerk {most[2]:.5f}; "
          f"at most {1e3 * max((row[4] for row in good), default=0.0):+.2f} um beyond the tolerance")
    return 1 if any(row[1] for row in rows) else 0


if __name__ == "__main__":
    sys.exit(main())
