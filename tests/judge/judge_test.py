#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""The judge itself, on runs whose figures are known in closed form; and on runs that break what it has to notice."""
import unittest

import needed  # noqa: F401
import numpy as np
from scipy.optimize import linprog

from bezier_chain import BezierChain
from curve_distance import CurveDistance
from joints import joint_jumps
from judge import judged, least
from least_time import Polygons, least_time
from machine_limits import MachineLimits
from path_grid import PathGrid
from segment_cubics import SegmentCubics
from motion_trace import Trace

KAPPA = 4.0 / 3.0 * (2.0**0.5 - 1.0)  # a quarter of a circle as a cubic


def machine(axes="xyz", feed=100.0, acceleration=1000.0, jerk=None, path=None, **axis_keys):
    axis = {"max_velocity_mm_s": feed, "max_acceleration_mm_s2": acceleration, **axis_keys}
    if jerk:
        axis["max_jerk_mm_s3"] = jerk
    return MachineLimits({"path": {"max_feed_mm_s": feed, **(path or {})}, "axis": [{"name": name, **axis} for name in axes]})


def line(length, axes=3, pieces=1):
    """Along x."""
    at = np.linspace(0.0, length, pieces + 1)
    return BezierChain([[[a] + [0.0] * (axes - 1), [b] + [0.0] * (axes - 1)] for a, b in zip(at, at[1:])], axes)


def quarters(radius, count=4):
    """An arc of so many quarters."""
    turn = np.array([[0.0, -1.0], [1.0, 0.0]])
    quarter = radius * np.array([[1.0, 0.0], [1.0, KAPPA], [KAPPA, 1.0], [0.0, 1.0]])
    chain = []
    for _ in range(count):
        chain.append(quarter)
        quarter = quarter @ turn.T
    return BezierChain(chain, 2)


def trapezoid(length, v, a):
    """The place at time t, and the end of time."""
    ramp, end = v / a, length / v + v / a

    def place(t):
        t = np.clip(t, 0.0, end)
        back = end - t
        return np.where(t < ramp, a * t * t / 2, np.where(back < ramp, length - a * back * back / 2, v * (t - ramp / 2)))
    return place, end


def trapezoid_trace(length, v, a, period=1e-3):
    place, end = trapezoid(length, v, a)
    times = period * np.arange(int(np.ceil(end / period)) + 1)
    return Trace(times, np.column_stack([place(times), 0 * times, 0 * times]))


class LeastTime(unittest.TestCase):
    def test_of_a_trapezoid(self):
        for length, pieces in ((100.0, 1), (3.0, 1), (100.0, 7)):
            v = min(100.0, (length * 1000.0) ** 0.5)
            seconds, stops = least(line(length, 3, pieces), machine(), "acceleration")
            self.assertAlmostEqual(seconds, length / v + v / 1000.0, delta=1e-5)
            self.assertEqual(stops, 0)

    def test_with_braking(self):
        seconds, _ = least(line(100.0), machine(max_braking_mm_s2=500.0), "acceleration")
        self.assertAlmostEqual(seconds, 1.0 + 0.05 + 0.1, delta=1e-4)

    def test_on_a_circle_by_centripetal_limit(self):
        # v = sqrt(c r) but for ramps, which are short with a large acceleration
        radius, c, steep = 20.0, 500.0, 1e6
        seconds, _ = least(quarters(radius), machine("xy", 1000.0, steep, path={"centripetal_mm_s2": c}), "acceleration")
        v = (c * radius) ** 0.5
        self.assertAlmostEqual(seconds, 2 * np.pi * radius / v + v / steep, delta=2e-3 * seconds)

    def test_stops_at_corners(self):
        corner = BezierChain([[[0, 0], [50, 0]], [[50, 0], [50, 50]]], 2)
        seconds, stops = least(corner, machine("xy"), "acceleration")
        self.assertAlmostEqual(seconds, 2 * (0.5 + 0.1), delta=1e-4)
        self.assertEqual(stops, 1)

    def test_is_what_a_linear_program_finds(self):
        grid, limits = PathGrid.even(quarters(5.0).pieces, 150), machine("xy", 100.0, 1000.0)
        seconds, b = least_time(grid, limits)
        polygons, count = Polygons(grid, limits), len(grid.length)
        rows, most = np.zeros((polygons.near.size, count + 1)), polygons.most.ravel()
        at = np.repeat(np.arange(count), polygons.near.shape[1])
        rows[np.arange(len(at)), at], rows[np.arange(len(at)), at + 1] = polygons.near.ravel(), polygons.far.ravel()
        bounds = [(0.0, 0.0), *((0.0, cap) for cap in polygons.node_cap[1:-1]), (0.0, 0.0)]
        best = np.sqrt(linprog(-np.ones(count + 1), A_ub=rows, b_ub=most, bounds=bounds).x)
        self.assertAlmostEqual(seconds / (2.0 * grid.length / (best[1:] + best[:-1])).sum(), 1.0, delta=1e-4)
        self.assertLessEqual((rows @ b - most).max(), 1e-6)


class LeastJerkTime(unittest.TestCase):
    limits = machine(jerk=20000.0)

    def test_of_s_curves(self):
        a, v, j = 1000.0, 100.0, 20000.0
        long = 100.0 / v + v / a + a / j
        middle = a / j + ((a / j) ** 2 + 4 * 5.0 / a) ** 0.5  # the acceleration is reached, the velocity is not
        for length, exact in ((100.0, long), (5.0, middle), (1.0, 4 * (1.0 / (2 * j)) ** (1 / 3))):
            seconds, _ = least(line(length), self.limits, "jerk", 800)
            self.assertAlmostEqual(seconds / exact, 1.0, delta=2e-3)

    def test_without_a_jerk_that_binds_it_is_that_of_the_acceleration(self):
        chain, hard = quarters(20.0), machine("xy", jerk=1e8)
        without, _ = least(chain, hard, "acceleration")
        self.assertAlmostEqual(least(chain, hard, "jerk", 800)[0] / without, 1.0, delta=5e-3)

    def test_on_a_circle_it_is_no_longer_than_an_even_motion(self):
        # Each axis's jerk is r w^3 at most at constant speed: v = (J r^2)^(1/3), with an S-curve at both ends.
        radius, jerk, a = 20.0, 2000.0, 400.0
        v = (jerk * radius**2) ** (1 / 3)
        seconds, _ = least(quarters(radius), machine("xy", 1000.0, a, jerk), "jerk", 800)
        round_trip = 2 * np.pi * radius / v
        self.assertLess(seconds, round_trip + 2 * (v / jerk) ** 0.5 * 2)
        self.assertGreater(seconds, round_trip / 2**0.5)  # were both axes at their limits all the time


class LimitUse(unittest.TestCase):
    def test_of_a_trapezoid(self):
        limits = machine(jerk=1e9)
        uses = trapezoid_trace(100.0, 100.0, 1000.0).uses(limits)
        self.assertAlmostEqual(uses["velocity"][0], 1.0, places=9)
        self.assertAlmostEqual(uses["acceleration"][0], 1.0, places=6)
        self.assertAlmostEqual(uses["feed"], 1.0, places=9)
        self.assertAlmostEqual(uses["jerk"][0], 0.5 * 1000.0 / 1e-3 / 1e9, delta=1e-9)  # half of it in the first period
        self.assertAlmostEqual(trapezoid_trace(100.0, 100.0, 1000.0).cycle_time, 1.1, delta=2e-3)

    def test_of_what_is_broken(self):
        limits = machine()
        self.assertGreater(trapezoid_trace(100.0, 100.5, 1000.0).uses(limits)["velocity"][0], 1.004)
        self.assertGreater(trapezoid_trace(100.0, 100.0, 1005.0).uses(limits)["acceleration"][0], 1.004)
        self.assertGreater(trapezoid_trace(100.0, 100.0, 1000.0).uses(machine(max_braking_mm_s2=900.0))["acceleration"][0], 1.1)

    def test_between_samples(self):
        # One segment of 0.1 s: 0 to 1 mm from rest to rest has 15 mm/s in its middle, 600 mm/s^2 at its ends, 12000 mm/s^3.
        zero, one = np.zeros((1, 1)), np.ones((1, 1))
        uses = SegmentCubics(np.array([0.1]), zero, one, zero, zero).uses(machine("x", 15.0, 600.0, 12000.0))
        for limit in ("velocity", "acceleration", "jerk"):
            self.assertAlmostEqual(uses[limit][0], 1.0, places=9)
        self.assertAlmostEqual(uses["feed"], 1.0, places=9)


class Geometry(unittest.TestCase):
    def test_joints_of_a_circle(self):
        fits = joint_jumps(quarters(20.0))
        self.assertLess(max(fits["gap_mm"], fits["turn_rad"], fits["curvature_jump"]), 1e-13)
        wrong = quarters(20.0)
        turned = [piece.control_points.copy() for piece in wrong.pieces]
        turned[1][2] *= 1.0 + 1e-7
        self.assertGreater(joint_jumps(BezierChain(turned, 2))["curvature_jump"], 1e-8)
        turned[1][0] += 1e-7
        self.assertAlmostEqual(joint_jumps(BezierChain(turned, 2))["gap_mm"], 1e-7 * 2**0.5, delta=1e-9)

    def test_curvature_of_pieces(self):
        # The cubic's own at its end, 2/3 h / a^2 with leg a and height h of the next point
        end = quarters(1.0).pieces[0].along(0.0)
        self.assertAlmostEqual(np.linalg.norm(end[2]), 2 / 3 * (1 - KAPPA) / KAPPA**2, places=12)

    def test_derivatives_by_length(self):
        piece = quarters(3.0).pieces[0]
        h, u = 1e-4, 0.3
        _, _, q2, q3, rate = piece.along(np.array([u - h, u, u + h]))
        np.testing.assert_allclose(q3[1], (q2[2] - q2[0]) / (2 * h * rate[1]), rtol=1e-6, atol=1e-8)

    def test_length_of_a_circle(self):
        # The cubic's radius is 1 to 1.00027 of the circle's.
        self.assertAlmostEqual(PathGrid.even(quarters(1.0).pieces, 100).length.sum() / (2 * np.pi), 1.00014, delta=1e-4)

    def test_distance_from_a_parabola(self):
        parabola = BezierChain([[[-2, 4], [0, -4], [2, 4]]], 2)  # y = x^2
        found = CurveDistance(parabola).of(np.array([[0.0, 1.0], [0.0, -1.0], [2.0, 4.0], [3.0, 4.0]]))
        np.testing.assert_allclose(found, [0.75**0.5, 1.0, 0.0, 1.0], atol=1e-12)

    def test_waypoints_that_are_missed(self):
        limits, chain = machine(), line(100.0)
        trace = trapezoid_trace(100.0, 100.0, 1000.0)
        hit = judged(limits, chain, trace, waypoints=np.array([[0.0, 0, 0], [30.0, 0, 0], [100.0, 0, 0]]))
        self.assertLess(max(hit["waypoint_error_mm"], hit["path_error_mm"]), 1e-12)
        missed = judged(limits, chain, trace, waypoints=np.array([[30.0, 2e-8, 0]]))
        self.assertAlmostEqual(missed["waypoint_error_mm"], 2e-8, delta=1e-14)


if __name__ == "__main__":
    unittest.main()
