# SPDX-License-Identifier: MIT
"""Pairs of plans of which the second may not be slower: a limit is higher, the window larger, the period shorter, or a line has more points."""
import math
import random
from dataclasses import dataclass, replace

from known_motions import KnownMotion
from planning import Case, Setting

KINDS = ("limit", "window", "period", "points")
SLOWER = 1.003  # at most this share of the first
PERIODS_US = (125, 250, 500, 1000, 2000, 4000)
WINDOWS = (64, 128, 256, 512, 1024, 2048)
GRID = 16  # places are multiples of 1 / GRID, and a point between is at a half, a quarter or an eighth: decimals that are exact
LIMIT_NAMES = ("velocity", "acceleration", "jerk")


@dataclass(frozen=True)
class Pair:
    kind: str
    says: str  # what is changed
    first: Case
    second: Case

    def seconds(self, tool):
        """Both times, and what the second may take."""
        first, second = self.first.planned(tool), self.second.planned(tool)
        sampling = min(first.sampling_s(), second.sampling_s()) if self.kind == "period" else 0.0
        return first.seconds, second.seconds, SLOWER * first.seconds + sampling


def random_setting(numbers, count):
    """30 to 300 mm/s, 400 to 5000 mm/s^2, 5 to 50 ms to the full acceleration; of every other machine axes differ up to tenfold."""
    velocity, acceleration = 10 ** numbers.uniform(1.5, 2.5), 10 ** numbers.uniform(2.6, 3.7)
    largest = (velocity, acceleration, acceleration / 10 ** numbers.uniform(-2.3, -1.3))
    decades = numbers.choice((0.0, 1.0))
    limits = tuple(tuple(limit / 10 ** numbers.uniform(0.0, decades) for limit in largest) for _ in range(count))
    return Setting(limits, 2.0 * math.hypot(*(limit[0] for limit in limits)))


def corners(numbers, lines):
    """The corners of a polyline of lines that are 2 to 80 mm long."""
    points = [(0.0, 0.0, 0.0)]
    for _ in range(lines):
        size = 10 ** numbers.uniform(0.3, 1.9)
        points.append(tuple(x + round(GRID * size * numbers.uniform(-0.6, 0.6)) / GRID for x in points[-1]))
    return points


def with_points_between(numbers, points):
    """The same lines, each divided into up to eight."""
    found = points[:1]
    for start, end in zip(points, points[1:]):
        parts = numbers.choice((1, 2, 4, 8))
        found += [tuple(a + (b - a) * k / parts for a, b in zip(start, end)) for k in range(1, parts + 1)]
    return found


def write_points(program, points):
    rows = ["{:.7f},{:.7f},{:.7f}\n".format(*point) for point in points]
    program.write_text("x,y,z\n" + "".join(rows), encoding="ascii")
    return program


def write_moves(program, points):
    moves = ["G1 X{:.7f} Y{:.7f} Z{:.7f}\n".format(*point) for point in points[1:]]
    program.write_text("G21 G90 G94 G64 P0.01 F60000\n" + "".join(moves) + "M2\n", encoding="ascii")
    return program


def random_program(numbers, folder, stem):
    """A program and its setting: a known motion as curve or elements, lines in G-code, or a spline through waypoints."""
    kind = numbers.choice(("known", "known", "lines", "spline"))
    if kind == "known":
        motion = KnownMotion(numbers.randrange(10**6))
        programs = motion.write(folder)
        return programs[numbers.choice(sorted({"curve", "elements"} & set(programs)))], motion.setting()
    points = corners(numbers, numbers.randint(1, 12))
    if kind == "lines":
        return write_moves(folder / f"{stem}.ngc", points), replace(random_setting(numbers, 3), feed=1000.0)
    setting = random_setting(numbers, 3)
    return write_points(folder / f"{stem}.csv", points), replace(setting, options=("--corner-angle", "180"))


def raised(numbers, setting):
    """One limit, of one axis or of all, up to ten times as high."""
    which, factor = numbers.randrange(3), 10 ** numbers.uniform(0.02, 1.0)
    axis = numbers.choice((None, *range(len(setting.limits))))
    limits = tuple(tuple(limit * factor if k == which and axis in (None, i) else limit for k, limit in enumerate(limits))
                   for i, limits in enumerate(setting.limits))
    return f"{LIMIT_NAMES[which]} of {'all axes' if axis is None else 'xyzabc'[axis]} x {factor:.2f}", replace(setting, limits=limits)


def monotone_pair(seed, folder):
    numbers = random.Random(f"monotone pair {seed}")
    kind, stem = KINDS[seed % len(KINDS)], f"pair{seed}"
    if kind == "points":
        lines = numbers.choice((1, 1, 4, 8))
        points = corners(numbers, lines)
        more, setting = with_points_between(numbers, points), random_setting(numbers, 3)
        write, suffix = numbers.choice(((write_points, ".csv"), (write_moves, ".ngc"))) if lines == 1 else (write_moves, ".ngc")
        setting = replace(setting, feed=1000.0)
        return Pair(kind, f"{len(points)} -> {len(more)} points", Case(write(folder / (stem + suffix), points), setting),
                    Case(write(folder / (stem + "more" + suffix), more), setting))
    program, setting = random_program(numbers, folder, stem)
    if kind == "limit":
        setting = replace(setting, period_us=numbers.choice(PERIODS_US), options=(*setting.options, "--window", str(numbers.choice(WINDOWS))))
        says, other = raised(numbers, setting)
    elif kind == "window":
        small = numbers.choice(WINDOWS)
        large = small * numbers.choice((2, 4, 16))
        says = f"window {small} -> {large}"
        setting, other = (replace(setting, options=(*setting.options, "--window", str(cells))) for cells in (small, large))
    else:
        short, long = sorted(numbers.sample(PERIODS_US, 2))
        says = f"{long} -> {short} us"
        setting, other = replace(setting, period_us=long), replace(setting, period_us=short)
    return Pair(kind, says, Case(program, setting, "first"), Case(program, other, "second"))
