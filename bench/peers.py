#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Motions beside Ruckig's and toppra's: peers.py BUILD_DIRECTORY [--ruckig PROGRAM] [--toppra FOLDER].

PROGRAM is bench/ruckig_moves.cpp, compiled with the sources of Ruckig (g++ -std=c++20 -O2 -I RUCKIG/include, without its cloud client).
FOLDER is a source tree of toppra, behind `python3 setup.py build_ext --inplace` (Debian: cython3).
"""
import argparse
import os
import pathlib
import subprocess
import sys
import time

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
import numpy as np  # pylint: disable=wrong-import-position

V, A, J = 100.0, 1000.0, 30000.0  # of each axis: mm/s, mm/s^2, mm/s^3
AXES = {"max_velocity_mm_s": V, "max_acceleration_mm_s2": A, "max_feed_mm_s": 10000.0, "steps_per_mm": 1000}


def least(work, rounds=5):
    """The result, and the least processor time of so many rounds [s]."""
    took = []
    for _ in range(rounds):
        begun = time.process_time()
        result = work()
        took.append(time.process_time() - begun)
    return result, min(took)


def beside_ruckig(splinefeed, program):
    """A polyline with a stop at each corner: each line is a move from rest to rest."""
    moves = np.random.default_rng(1).uniform(-40, 40, (2000, 3))
    points = np.vstack([np.zeros(3), np.cumsum(moves, axis=0)])
    text = "".join(f"{x:.17g} {y:.17g} {z:.17g}\n" for x, y, z in moves)
    out = subprocess.run([program, str(V), str(A), str(J)], input=text, capture_output=True, text=True, check=True).stdout.split()
    theirs, cost_us = np.array(out[:-1], dtype=float), float(out[-1])
    machine = splinefeed.Machine("xyz", **AXES, max_jerk_mm_s3=J)
    corners = np.ones(len(points))
    motion, took = least(lambda: splinefeed.plan(points, machine, curve="polyline", corner=corners, scalar="double"))
    smooth, took_smooth = least(lambda: splinefeed.plan(points, machine, corner_angle=180, scalar="double"))
    print(f"2,000 lines from rest to rest: Ruckig {theirs.sum():.2f} s, splinefeed {motion.time:.2f} s ({(motion.time / theirs.sum() - 1) * 100:+.2f} %)")
    print(f"planning a line: Ruckig {cost_us:.2f} us, splinefeed {took / len(moves) * 1e6:.0f} us")
    print(f"the same points on one curve without stops: splinefeed {smooth.time:.2f} s, {took_smooth / len(moves) * 1e6:.0f} us a point")


def beside_toppra(splinefeed, folder):
    """One curve for both: splinefeed's, through the points of examples/path61.csv."""
    sys.path.insert(0, str(folder))
    import toppra  # pylint: disable=import-outside-toplevel,import-error
    from toppra import algorithm, constraint, interpolator  # pylint: disable=import-outside-toplevel,import-error
    toppra.setup_logging("ERROR")
    points = np.loadtxt(pathlib.Path(__file__).parents[1] / "examples/path61.csv", delimiter=",", skiprows=2)
    curve = splinefeed.Curve(points, scalar="double")

    # A parameter in which both derivatives are continuous, as toppra needs it: each segment as long as its ends say.
    ends = [(len(b) - 1) * np.linalg.norm([b[1] - b[0], b[-1] - b[-2]], axis=1) for b in curve.bezier]
    spans = np.cumprod([1.0, *(after[0] / before[1] for before, after in zip(ends, ends[1:]))])
    knots = np.concatenate([[0.0], np.cumsum(spans)])

    class Path(interpolator.AbstractGeometricPath):
        """The curve as toppra asks for it."""
        dof, path_interval, waypoints = 3, knots[[0, -1]], None

        def __call__(self, t, order=0):
            t = np.clip(t, 0.0, knots[-1])
            at = np.clip(np.searchsorted(knots, t, side="right") - 1, 0, len(spans) - 1)
            u = np.minimum(at + (t - knots[at]) / spans[at], np.nextafter(at + 1.0, 0.0))
            return curve.derivative(u, order) / np.power(spans[at], order)[..., np.newaxis] if order else curve.evaluate(u)

    limits = [constraint.JointVelocityConstraint(np.array([[-V, V]] * 3)), constraint.JointAccelerationConstraint(np.array([[-A, A]] * 3))]
    machine = splinefeed.Machine("xyz", **AXES)
    motion, took = least(lambda: splinefeed.plan(points, machine, scalar="double"))
    optimum = motion.summary["optimum_time_s"]
    use = max(max(of.values()) for of in motion.summary["limit_use"].values() if of)
    print(f"path61: least possible {optimum:.4f} s")
    print(f"  splinefeed: {motion.time:.4f} s, planned in {took * 1e3:.1f} ms, largest use of a limit {use:.5f}")
    for per_segment in (2, 10, 50):
        grid = np.interp(np.linspace(0.0, len(spans), per_segment * len(spans) + 1), np.arange(len(knots)), knots)
        trajectory, took = least(lambda: algorithm.TOPPRA(limits, Path(), gridpoints=grid, solver_wrapper="seidel",
                                                          parametrizer="ParametrizeConstAccel").compute_trajectory(0, 0), 3)
        times = np.linspace(0.0, trajectory.duration, 20001)
        use = max(np.abs(trajectory(times, 1)).max() / V, np.abs(trajectory(times, 2)).max() / A)
        print(f"  toppra, {len(grid)} grid points: {trajectory.duration:.4f} s, planned in {took * 1e3:.1f} ms, largest use of a limit between them {use:.3f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--ruckig", type=pathlib.Path)
    parser.add_argument("--toppra", type=pathlib.Path)
    given = parser.parse_args()
    sys.path.insert(0, str(given.build.resolve() / "python"))
    import splinefeed  # pylint: disable=import-outside-toplevel
    if given.ruckig:
        beside_ruckig(splinefeed, given.ruckig.resolve())
    if given.toppra:
        beside_toppra(splinefeed, given.toppra.resolve())


if __name__ == "__main__":
    main()
