#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Cycle times with limited jerk, planned in double and in float, as the tables of docs/explanation/feed.md and feed_derivation.md: of a curve, of random splines, or of splines through unevenly
spaced points, against the least time
that tests/judge finds for the same curve and limits (needs python3-numpy, python3-scipy). Also times of known motions and straight moves over
the known ones, and pairs of which the second may not be slower."""
import argparse
import json
import math
import os
import pathlib
import random
import subprocess
import sys
import tempfile
from functools import partial
from statistics import median

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tests" / "judge"))

from judge import judged_files  # noqa: E402
from known_motions import FORMS, KnownMotion  # noqa: E402
from monotone_pairs import monotone_pair  # noqa: E402
from planning import Refused  # noqa: E402
from straight_moves import StraightMove  # noqa: E402
from time_gates import known_ratios, straight_ratio  # noqa: E402
from uneven_path import write_uneven_path  # noqa: E402

CASES = [(40, 500, 20000), (50, 1000, 50000), (100, 3000, 60000), (200, 3000, 60000), (250, 2000, 20000), (300, 2500, 50000)]
SCALARS = ("double", "float")  # of the plan


def machine(axes, feed, limits):
    """limits: of each axis, velocity, acceleration and jerk"""
    text = f'name = "feed.py"\n[path]\nmax_feed_mm_s = {feed}\n'
    for axis, (velocity, acceleration, jerk) in zip(axes, limits):
        text += f'[[axis]]\nname = "{axis}"\nmax_velocity_mm_s = {velocity}\nmax_acceleration_mm_s2 = {acceleration}\n'
        text += f"max_jerk_mm_s3 = {jerk}\nsteps_per_mm = 1000\n"
    return text


def seconds(tool, program, machine_text, folder, *options):
    file = folder / "machine.toml"
    file.write_text(machine_text)
    command = [tool, "run", str(program), "-m", str(file), "--quiet", "--summary", "json", *options]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)["cycle_time_s"]


def files(folder):
    return ["--trace", str(folder / "trace.csv"), "--curve-out", str(folder / "curve.json")]


def least_time(folder):
    """Of the run whose files these are; and the largest use of a jerk limit."""
    found = judged_files(folder / "machine.toml", folder / "curve.json", folder / "trace.csv", kind="jerk")
    return found["least_time_s"], max(found["use"]["jerk"].values())


def curve_table(tool, curve, folder):
    for feed, acceleration, jerk in CASES:
        limits = [(feed, acceleration, jerk)] * 2
        times = [seconds(tool, curve, machine("xy", feed, limits), folder, "--jerk-scalar", scalar, *files(folder)) for scalar in SCALARS]
        print("| {:g} / {:g} / {:g} | {:.3f} | {:.3f} | {:.3f} |".format(feed, acceleration, jerk, *times, least_time(folder)[0]))


def random_points(numbers):
    """6 to 25 chords in space, 0.2 to 25 mm long, that turn smoothly."""
    size = 10 ** numbers.uniform(-0.3, 1.0)
    direction = [numbers.gauss(0, 1) for _ in range(3)]
    point = [0.0, 0.0, 0.0]
    points = [point]
    for _ in range(numbers.randint(6, 25)):
        direction = [0.7 * d + 0.7 * numbers.gauss(0, 1) for d in direction]
        chord = size * numbers.uniform(0.4, 2.5) / math.hypot(*direction)
        point = [p + chord * d for p, d in zip(point, direction)]
        points.append(point)
    return points


def random_limits(numbers):
    """30 to 300 mm/s, 400 to 5000 mm/s^2, 5 to 100 ms to the full acceleration; every other machine has unequal axes."""
    feed, acceleration = 10 ** numbers.uniform(1.5, 2.5), 10 ** numbers.uniform(2.6, 3.7)
    jerk = acceleration / 10 ** numbers.uniform(-2.3, -1.0)
    share = (lambda low: numbers.uniform(low, 1.0)) if numbers.random() < 0.5 else (lambda low: 1.0)
    return feed, [(feed * share(0.4), acceleration * share(0.3), jerk * share(0.3)) for _ in "xyz"]


def unequal_limits(numbers):
    """The same ranges, with axes whose limits have ratios of up to 30."""
    feed, limits = random_limits(numbers)
    return feed, [tuple(limit * 10 ** numbers.uniform(-math.log10(30), 0) for limit in of_axis) for of_axis in limits]


def random_table(tool, count, folder, limits_of=random_limits):
    ratios = {scalar: [] for scalar in SCALARS}
    print("| spline | least | double | float | A / J of the first axis | jerk use in double |\n|---|---|---|---|---|---|")
    for seed in range(1, count + 1):
        numbers = random.Random(seed)
        program = folder / "points.csv"
        rows = ["{:.5f},{:.5f},{:.5f}\n".format(*point) for point in random_points(numbers)]
        program.write_text("x,y,z\n" + "".join(rows))
        feed, limits = limits_of(numbers)
        least, use = 0.0, 0.0
        for scalar in SCALARS:
            wanted = [] if least else files(folder)
            time = seconds(tool, program, machine("xyz", feed, limits), folder, "--jerk-scalar", scalar, "--corner-angle", "180", *wanted)
            if not least:
                least, use = least_time(folder)
            ratios[scalar].append(time / least)
        print("| {} | {:.4f} s | {:.4f} | {:.4f} | {:.0f} ms | {:.4f} |".format(
            seed, least, *(ratios[scalar][-1] for scalar in SCALARS), 1e3 * limits[0][1] / limits[0][2], use), flush=True)
    print_ratios(ratios, count)


def uneven_table(tool, count, folder):
    """Points 0.02 to 20 mm apart on a smooth curve, on three axes of 100 mm/s, 1000 mm/s^2, 30000 mm/s^3."""
    ratios = {scalar: [] for scalar in SCALARS}
    print("| path | least | double | float |\n|---|---|---|---|")
    for seed in range(1, count + 1):
        program = folder / "points.csv"
        write_uneven_path(program, seed)
        times = [seconds(tool, program, machine("xyz", 100, [(100, 1000, 30000)] * 3), folder, "--jerk-scalar", scalar,
                         *files(folder)) for scalar in SCALARS]
        least, _ = least_time(folder)
        for scalar, time in zip(SCALARS, times):
            ratios[scalar].append(time / least)
        print("| {} | {:.4f} s | {:.4f} | {:.4f} |".format(seed, least, *(ratios[scalar][-1] for scalar in SCALARS)), flush=True)
    print_ratios(ratios, count)


MONOTONE_PATHS = ("butterfly.json", "logo.json", "cam.json", "path61.csv", "circle720.csv", "square.csv", "star.csv", "random")


def monotone_table(tool, count, folder):
    """A limit that is raised, of velocity, acceleration or jerk of every axis, must not make the time longer."""
    worst = []
    for seed in range(1, count + 1):
        numbers = random.Random(seed)
        name = numbers.choice(MONOTONE_PATHS)
        program = folder / "points.csv" if name == "random" else pathlib.Path("examples") / name
        if name == "random":
            program.write_text("x,y,z\n" + "".join("{:.5f},{:.5f},{:.5f}\n".format(*point) for point in random_points(numbers)))
        axes = "xy" if name in ("butterfly.json", "logo.json") else "xyz"
        limits = [10 ** numbers.uniform(0.7, 3), 10 ** numbers.uniform(1, 5), 10 ** numbers.uniform(3, 9)]
        raised, which = list(limits), numbers.randrange(3)
        raised[which] *= 10 ** numbers.uniform(0.01, 2)
        if raised[0] > 1e4 or raised[1] > 1e6 or raised[2] > 1e9:
            continue
        try:
            times = [seconds(tool, program, machine(axes, each[0], [tuple(each)] * len(axes)), folder) for each in (limits, raised)]
        except subprocess.CalledProcessError as error:  # such as a sample period that is too short for these limits
            print(f"seed {seed}, {name}, {limits}: {error.stderr.strip().splitlines()[-1]}")
            continue
        worst.append((times[1] / times[0], seed, name, limits, "VAJ"[which], raised[which], times))
    worst.sort(key=lambda row: -row[0])
    print("| longer by | seed | path | V, A, J | raised to | times |\n|---|---|---|---|---|---|")
    for ratio, seed, name, limits, which, value, times in worst[:10]:
        print("| {:.4f} | {} | {} | {:.3g}, {:.3g}, {:.3g} | {} {:.3g} | {:.4f}, {:.4f} s |".format(ratio - 1, seed, name, *limits, which, value, *times))
    print(f"{sum(row[0] > 1.003 for row in worst)} of {len(worst)} are longer by more than 0.3 %")


def known_table(tool, seeds, folder, jerk=True):
    """Motions whose time is known: the tool's over it, and without what sampling costs."""
    ratios = {form: [] for form in FORMS}
    print("| motion | axes | known | " + " | ".join(FORMS) + " |\n|---|---|---|" + "---|" * len(FORMS))
    for seed in seeds:
        motion = KnownMotion(seed, jerk=jerk)
        cells = []
        for form, row in known_ratios(tool, motion, folder).items():
            if row[0] is None:
                print(row[2])
            else:
                ratios[form].append(row)
                cells.append("{:.4f} ({:.4f})".format(*row))
        print("| {} | {} | {:.4f} s | {} |".format(seed, len(motion.limits), motion.seconds, " | ".join(cells)), flush=True)
    for form, rows in ratios.items():
        if rows:
            print(f"{form}: {len(rows)} motions, median {median(row[0] for row in rows):.4f}, largest {max(row[0] for row in rows):.4f}; "
                  f"without sampling {median(row[1] for row in rows):.4f}, {max(row[1] for row in rows):.4f}")


def straight_table(tool, seeds, folder):
    """Straight moves: the time over that of seven phases, and over what is allowed (time_gates.py)."""
    ratios = []
    print("| move | axes | seven phases | period | options | over seven phases | over what is allowed |\n|---|---|---|---|---|---|---|")
    for seed in seeds:
        move = StraightMove(seed)
        case = move.case(folder)
        try:
            ratios.append(straight_ratio(tool, move, case))
        except Refused as refused:
            print(f"{case}: {refused}")
            continue
        print("| {} | {} of {} | {:.4f} s | {} us | {} | {:.4f} | {:.4f} |".format(
            seed, sum(x != 0.0 for x in move.end), len(move.end), move.seconds, move.setting.period_us, " ".join(move.setting.options), *ratios[-1]), flush=True)
    print(f"median {median(row[0] for row in ratios):.4f}, largest {max(row[0] for row in ratios):.4f}; {sum(row[1] > 1.0 for row in ratios)} of "
          f"{len(ratios)} take longer than is allowed")


def pairs_table(tool, seeds, folder):
    """Pairs of which the second may not be slower: a higher limit, a larger window, a shorter period, more points on a line."""
    slower = 0
    print("| pair | what is changed | first | second | ratio |\n|---|---|---|---|---|")
    for seed in seeds:
        pair = monotone_pair(seed, folder)
        try:
            first, second, allowed = pair.seconds(tool)
        except Refused as refused:
            print(f"{pair.first} -> {pair.second}: {refused}")
            continue
        slower += second > allowed
        print("| {} | {} | {:.4f} s | {:.4f} s | {:.4f}{} |".format(
            seed, pair.says, first, second, second / first, ", slower" if second > allowed else ""), flush=True)
    print(f"{slower} of {len(seeds)} are slower")


def print_ratios(ratios, count):
    for scalar in SCALARS:
        ordered = sorted(ratios[scalar])
        print(f"{scalar}: median {ordered[count // 2]:.4f}, largest {ordered[-1]:.4f}, "
              f"{sum(r <= 1.04 for r in ordered)} of {count} at most 1.04")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--tool", type=os.path.abspath, default="build/release/bin/splinefeed")
    parser.add_argument("--curve", help="a curve .json in two dimensions")
    parser.add_argument("--random", type=int, default=0, metavar="COUNT", help="so many random splines")
    parser.add_argument("--unequal", type=int, default=0, metavar="COUNT", help="the same on machines whose axes differ by up to 30 times")
    parser.add_argument("--monotone", type=int, default=0, metavar="COUNT", help="so many random limits and one of them raised")
    parser.add_argument("--uneven", type=int, default=0, metavar="COUNT", help="so many splines through points 0.02 to 20 mm apart")
    parser.add_argument("--known", type=int, default=0, metavar="COUNT", help="so many random motions whose time is known, as curves, elements and G5")
    parser.add_argument("--known-without-jerk", type=int, default=0, metavar="COUNT", help="the same on machines without a jerk limit")
    parser.add_argument("--straight", type=int, default=0, metavar="COUNT", help="so many straight moves of random machines")
    parser.add_argument("--pairs", type=int, default=0, metavar="COUNT", help="so many pairs of which the second may not be slower")
    parser.add_argument("--seed", type=int, default=1, help="the first of --known, --known-without-jerk, --straight and --pairs (default 1)")
    parser.add_argument("--keep", type=pathlib.Path, metavar="FOLDER", help="programs and machine files stay there")
    arguments = parser.parse_args()
    counts = (arguments.random, arguments.unequal, arguments.uneven, arguments.monotone, arguments.known, arguments.known_without_jerk, arguments.straight,
              arguments.pairs)
    if not arguments.curve and max(counts) <= 0:
        parser.error("what is to be run? --curve FILE, or a COUNT for --random, --unequal, --uneven, --monotone, --known, --known-without-jerk, --straight or --pairs")
    with tempfile.TemporaryDirectory() as name:
        folder = arguments.keep or pathlib.Path(name)
        folder.mkdir(parents=True, exist_ok=True)
        if arguments.curve:
            curve_table(arguments.tool, arguments.curve, folder)
        if arguments.random:
            random_table(arguments.tool, arguments.random, folder)
        if arguments.unequal:
            random_table(arguments.tool, arguments.unequal, folder, unequal_limits)
        if arguments.uneven:
            uneven_table(arguments.tool, arguments.uneven, folder)
        if arguments.monotone:
            monotone_table(arguments.tool, arguments.monotone, folder)
        known_tables = ((known_table, arguments.known), (partial(known_table, jerk=False), arguments.known_without_jerk))
        for table, count in (*known_tables, (straight_table, arguments.straight), (pairs_table, arguments.pairs)):
            if count:
                table(arguments.tool, range(arguments.seed, arguments.seed + count), folder)


if __name__ == "__main__":
    main()
