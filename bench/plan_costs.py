#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""What the plans cost, and what they lose: of this build, and of an older revision built beside it.

    /usr/bin/python3 bench/plan_costs.py [--base d1b017f] [--growth] [--count 30]

Times of a node (the shortest of --repeat runs, one build after the other), bytes of a cell, cycle times over the least time that
tests/judge finds (needs python3-numpy, python3-scipy), and blended corners against stops. Needs a release build with benchmarks."""
import argparse
import json
import pathlib
import random
import statistics
import subprocess
import tempfile

import blended
import feed

ROOT = pathlib.Path(__file__).resolve().parents[1]
SCALARS = feed.SCALARS
OF_NAMES = {"(jerk_plan<double, double>)": "jerk_plan", "(jerk_plan<Fixed, float>)": "jerk_plan float"}
NODES = [  # what feed_plan_bench calls it, its counter, the unit, what it is called here
    ("feed_plan<double>", "ns_a_node", "ns", "FeedPlan, a node, double"),
    ("feed_plan<Fixed>", "ns_a_node", "ns", "FeedPlan, a node, Fixed"),
    ("jerk_plan", "ns_a_node", "ns", "JerkPlan, a node, double"),
    ("jerk_plan float", "ns_a_node", "ns", "JerkPlan, a node, float in Fixed"),
    ("worst_window", "all_but_0.1%_ms", "ms", "JerkPlan, the longest window but for one in 1000"),
    ("straight_move", "items_per_second", "ns", "straight move in closed form"),
]


def built(revision):
    """The build folder of an older revision, made if it is not there."""
    folder = ROOT / "build" / f"base-{revision}"
    if not (folder / "build/bin/feed_plan_bench").exists():
        subprocess.run(["git", "clone", "--quiet", "--no-checkout", str(ROOT), str(folder)], check=True)
        subprocess.run(["git", "-C", str(folder), "checkout", "--quiet", revision], check=True)
        subprocess.run(["cmake", "--preset", "release", "-S", str(folder), "-B", str(folder / "build"), "-DSPLINEFEED_TESTS=OFF",
                        "-DSPLINEFEED_REPOSITORY_TESTS=OFF", "-DSPLINEFEED_BENCHMARKS=ON"], check=True, cwd=folder, stdout=subprocess.DEVNULL)
        subprocess.run(["ninja", "-C", str(folder / "build"), "splinefeed", "feed_plan_bench"], check=True, stdout=subprocess.DEVNULL)
    return folder / "build/bin"


def node_costs(bench, waypoints):
    """By the names of NODES."""
    command = [str(bench), f"--benchmark_filter=/{waypoints}/|straight", "--benchmark_format=json"]
    rows = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)["benchmarks"]
    found = {}
    for name, counter, _, _ in NODES:
        for row in rows:
            called = row["name"].split("/")[0]
            if OF_NAMES.get(called, called) == name and counter in row:
                found[name] = 1e9 / row[counter] if counter == "items_per_second" else row[counter]
    return found


def node_table(bins, waypoints, repeat):
    least = [{} for _ in bins]
    for _ in range(repeat):
        for one, folder in zip(least, bins):
            for name, cost in node_costs(folder / "feed_plan_bench", waypoints).items():
                one[name] = min(cost, one.get(name, cost))
    print(f"\n| {waypoints} waypoints | now |" + (" base | now / base |" if len(bins) > 1 else ""))
    print("|---|---|" + "---|---|" * (len(bins) - 1))
    for name, _, unit, title in NODES:
        if any(name not in one for one in least):
            continue
        cells = [f"{one[name]:.4g} {unit}" for one in least]
        print(f"| {title} | " + " | ".join(cells + [f"{least[0][name] / one[name]:.2f}" for one in least[1:]]) + " |", flush=True)


def bytes_of_a_cell(tool, folder, options):
    """From two windows, so that what does not grow with them does not count."""
    program = folder / "points.csv"
    program.write_text("x,y,z\n0,0,0\n1,2,3\n3,4,1\n")
    file = folder / "machine.toml"
    file.write_text(feed.machine("xyz", 100, [(100, 1000, 30000)] * 3))
    def used(window):
        made = subprocess.run([tool, "run", str(program), "-m", str(file), "--window", str(window), "--quiet", "--summary", "json", *options],
                              check=True, capture_output=True, text=True).stdout
        return json.loads(made)["memory_bytes"]["feed_plan"]
    return (used(4096) - used(2048)) / 2048


def plans(bins):
    """(name, folder of the tool, its options)"""
    yield from ((scalar, bins[0], ["--jerk-scalar", scalar]) for scalar in SCALARS)
    yield from (("base", build, []) for build in bins[1:])


def splines(count, folder):
    """(kind, program, limits of the machine, options of the tool)"""
    butterfly = ROOT / "examples/butterfly.json"
    for feed_mm_s, acceleration, jerk in feed.CASES:
        yield "butterfly", butterfly, ("xy", feed_mm_s, [(feed_mm_s, acceleration, jerk)] * 2), []
    program = folder / "points.csv"
    for seed in range(1, count + 1):
        numbers = random.Random(seed)
        program.write_text("x,y,z\n" + "".join("{:.5f},{:.5f},{:.5f}\n".format(*point) for point in feed.random_points(numbers)))
        speed, limits = feed.random_limits(numbers)
        yield "random splines", program, ("xyz", speed, limits), ["--corner-angle", "180"]
    for seed in range(1, count + 1):
        feed.write_uneven_path(program, seed)
        yield "unevenly spaced points", program, ("xyz", 100, [(100, 1000, 30000)] * 3), []


def ratio_table(bins, count, folder):
    ratios = {}
    for kind, program, limits, options in splines(count, folder):
        least = 0.0
        for plan, build, more in plans(bins):
            wanted = [] if least else feed.files(folder)
            time = feed.seconds(str(build / "splinefeed"), program, feed.machine(*limits), folder, *options, *more, *wanted)
            least = least or feed.least_time(folder)[0]
            ratios.setdefault((kind, plan), []).append(time / least)
    print("\n| over the least time | plan | median | largest |\n|---|---|---|---|")
    for (kind, plan), found in ratios.items():
        print(f"| {kind} | {plan} | {statistics.median(found):.4f} | {max(found):.4f} |", flush=True)


def corner_table(bins, folder):
    print("\n| corners | plan | stops [s] | " + " | ".join(f"within {t} mm [s]" for t in blended.TOLERANCES_MM) + " |")
    print("|---|---|---|" + "---|" * len(blended.TOLERANCES_MM))
    for name, points in [("star", blended.star())] + [(f"zigzag of {turn} degrees", blended.zigzag(turn)) for turn in (90, 170)]:
        for plan, build, more in plans(bins):
            row = blended.row(str(build / "splinefeed"), points, folder, *more)
            print(f"| {name} | {plan} | " + " | ".join(f"{s:.3f}" for s in row) + " |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default=ROOT / "build/release", type=pathlib.Path)
    parser.add_argument("--base", metavar="REVISION", help="built in build/base-REVISION")
    parser.add_argument("--growth", action="store_true", help="nodes of 1000 to 1,000,000 waypoints instead of 10,000")
    parser.add_argument("--repeat", default=3, type=int)
    parser.add_argument("--count", default=30, type=int, help="random splines of each kind")
    arguments = parser.parse_args()
    bins = [arguments.build / "bin"] + ([built(arguments.base)] if arguments.base else [])
    for waypoints in (1000, 10000, 100000, 1000000) if arguments.growth else (10000,):
        node_table(bins, waypoints, arguments.repeat)
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        print("\n| plan | bytes of a cell |\n|---|---|")
        for plan, build, more in plans(bins):
            print(f"| {plan} | {bytes_of_a_cell(str(build / 'splinefeed'), folder, more):.0f} |")
        corner_table(bins, folder)
        ratio_table(bins, arguments.count, folder)


if __name__ == "__main__":
    main()
