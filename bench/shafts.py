#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""How far the shafts of simulated drives, put together, were off the planned path.

    splinefeed run part.csv ... --trace t.csv       while each drive ran with --record SHAFT.csv
    bench/shafts.py t.csv SHAFT.csv ... [--steps-per-mm 320]

The records go by CLOCK_MONOTONIC, so they are put together by the clock, not by the path. Needs python3-numpy.
"""
import argparse

import numpy as np


def shafts(name):
    with open(name) as f:
        next(f)
        start = float(next(f).split("CLOCK_MONOTONIC")[1].split()[0])
        rows = np.loadtxt(f, delimiter=",", skiprows=1, ndmin=2)
    return rows[:, 0] + start, rows[:, 1:]


def distance(points, path):
    """Of each point from the polyline; both go the same way, so the search goes on from the last place."""
    a, b = path[:-1], path[1:]
    along = b - a
    square = np.maximum((along ** 2).sum(1), 1e-30)
    out, at = np.empty(len(points)), 0
    for i, p in enumerate(points):
        low, high = max(at - 50, 0), min(at + 400, len(a))
        u = np.clip(((p - a[low:high]) * along[low:high]).sum(1) / square[low:high], 0, 1)
        off = np.linalg.norm(a[low:high] + u[:, None] * along[low:high] - p, axis=1)
        at, out[i] = low + int(np.argmin(off)), off.min()
    return out


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("trace")
    parser.add_argument("record", nargs="+", help="in the order of the axes")
    parser.add_argument("--steps-per-mm", type=float, default=320)
    args = parser.parse_args()
    path = np.loadtxt(args.trace, delimiter=",", skiprows=1)[:, 1:-1]
    records = [shafts(name) for name in args.record]
    begin, end = max(t[0] for t, _ in records), min(t[-1] for t, _ in records)
    time = np.arange(begin, end, 0.001)
    together = np.column_stack([np.interp(time, t, axis) for t, all_axes in records for axis in all_axes.T])
    together = together / args.steps_per_mm
    # Before the motion the drives are told to call the place where they stand the start of the path.
    placed = np.argmax(np.linalg.norm(together - path[0], axis=1) < 1e-3)
    together = together[placed:]
    moves = np.any(np.abs(np.diff(together, axis=0)) > 1e-7, axis=1)
    first, last = np.argmax(moves), len(moves) - np.argmax(moves[::-1])
    off = distance(together[first:last + 1], path)
    rests = int(np.sum((~moves[first:last])[1:] & moves[first:last][:-1]))
    print(f"{(last - first) * 1e-3:.3f} s from the first motion to the last, {rests} rests between")
    print(f"off the path: {off.max() * 1e3:.3f} um at most, {off.mean() * 1e3:.3f} um on average")
    print(f"off its end: {np.linalg.norm(together[last] - path[-1]) * 1e3:.3f} um")


if __name__ == "__main__":
    main()
