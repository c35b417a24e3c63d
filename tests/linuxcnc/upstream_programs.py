#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""LinuxCNC's programs of circular arcs, with its planner and with splinefeed_tp.so.

  tests/linuxcnc/upstream_programs.py TREE MODULE [--only NAME]... [--lines 1500] [--parameters "tolerance_um=50"] [--slower 6] [--jobs 2]

Those of TREE/tests/trajectory-planner/circular-arcs/nc_files that have at most so many lines, but those of the spindle, which
bench/linuxcnc_spindle.py judges. Each axis has 100 mm/s and 1000 mm/s^2; path modes are the program's own. The module must keep every
limit, end where LinuxCNC's planner ends, and take at most 0.5 % and 20 ms more, but for --slower programs. What does not is printed; a program that LinuxCNC's own
planner does not run to its end counts as left out.
"""
import argparse
import concurrent.futures
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "bench"))
import linuxcnc_tp  # noqa: E402

SLOWER, SLOWER_S = 1.005, 0.02
OTHERS = "ABCUVW"


def axes_of(text):
    words = re.sub(r"\(.*?\)|;.*|#?<.*?>", "", text).upper()
    return "XYZ" + "".join(letter for letter in OTHERS if re.search(rf"(?<![A-Z]){letter}\s*[-+.\d#\[]", words))


def run(options, program, module):
    """What is wrong, seconds, largest use of a limit, end."""
    text = program.read_text(errors="replace")
    axes = axes_of(text)
    result = linuxcnc_tp.run(text, axes, options, module, options.parameters if module else "", [])
    problem = "; ".join(dict.fromkeys([result["problem"]] * bool(result["problem"]) + result["said"]))
    if "samples" not in result:
        return problem, 0.0, 0.0, []
    used = linuxcnc_tp.limits_used(result["samples"], axes, options.period, 0)
    if module and result["figures"].get("splinefeed-tp.late"):
        problem += " a period without motion"
    return problem, used[0], max(used[1:3]), result["position"]


def judged(stock, ours):
    """What is wrong with the module, and whether it is slower; None: LinuxCNC's planner does not get to the end, either."""
    if stock[0] or not stock[1] > 0.0:
        return None
    problem = ours[0]
    if ours[2] > 1.0001:
        problem += f" a limit is exceeded: {ours[2]:.4f}"
    if ours[3] and max(abs(a - b) for a, b in zip(stock[3], ours[3])) > 1e-6:
        problem += f" it ends at {ours[3]} and not at {stock[3]}"
    return problem, ours[1] > stock[1] * SLOWER + SLOWER_S


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("linuxcnc", type=pathlib.Path)
    parser.add_argument("tp", type=pathlib.Path)
    parser.add_argument("--only", action="append")
    parser.add_argument("--lines", type=int, default=1500)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--slower", type=int, default=0)
    parser.add_argument("--parameters", default="")
    parser.set_defaults(period=1000, jerk=0, inch=False, hal=None, indexer=False, set=[], timeout=240)
    options = parser.parse_args()
    options.linuxcnc = options.linuxcnc.resolve()
    folder = options.linuxcnc / "tests/trajectory-planner/circular-arcs/nc_files"
    programs = [p for p in sorted(folder.rglob("*.ngc")) if p.parent.name != "spindle" and (not options.only or p.stem in options.only)
                and p.read_bytes().count(b"\n") <= options.lines]
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as workers:
        jobs = [(p, [workers.submit(run, options, p, m) for m in (None, options.tp.resolve())]) for p in programs]
        print("| program | LinuxCNC's planner, s | this one, s | limit used | |\n|---|---|---|---|---|")
        wrong, slower, left_out, ratios = 0, 0, 0, []
        for program, pair in jobs:
            stock, ours = (job.result() for job in pair)
            found = judged(stock, ours)
            if found is None:
                left_out += 1
                print(f"| {program.relative_to(folder)} | left out: {stock[0][:200]} | | | |", flush=True)
                continue
            ratios.append(ours[1] / stock[1])
            problem, is_slower = found
            wrong += bool(problem)
            slower += is_slower
            problem += f" slower: {ratios[-1]:.3f}" if is_slower else ""
            print(f"| {program.relative_to(folder)} | {stock[1]:.3f} | {ours[1]:.3f} | {ours[2]:.4f} | {problem} |", flush=True)
    if not ratios:
        return 1
    ratios.sort()
    print(f"{len(ratios)} programs, {wrong} with a problem, {slower} slower, {left_out} left out; time over LinuxCNC's: {ratios[len(ratios) // 2]:.3f} in the median, "
          f"{ratios[-1]:.3f} at most")
    return 1 if wrong or slower > options.slower else 0


if __name__ == "__main__":
    sys.exit(main())
