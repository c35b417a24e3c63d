#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""The motions, moves and pairs that plans are held against: whether their times and limits are what they say."""
import json
import math
import random
import tempfile
import unittest
from fractions import Fraction
from pathlib import Path

import needed  # noqa: F401
import numpy as np

from bezier_chain import BezierChain
from judge import least
from known_motions import KnownMotion
from machine_limits import MachineLimits
from monotone_pairs import corners, monotone_pair, with_points_between
from straight_moves import StraightMove, seven_phase_seconds

SEEDS = range(1, 41)


def machine(limits, feed):
    keys = ("max_velocity_mm_s", "max_acceleration_mm_s2", "max_jerk_mm_s3")
    return MachineLimits({"path": {"max_feed_mm_s": feed}, "axis": [{"name": name, **dict(zip(keys, row))} for name, row in zip("xyzabc", limits)]})


def differences(motion):
    """Velocity, acceleration and jerk at the control points of each piece, by time: [piece, point, axis]."""
    found, of = [np.array(motion.control_points)], np.array(motion.piece_seconds)[:, None, None]
    for degree in (3, 2, 1):
        found.append(degree * np.diff(found[-1], axis=1) / of)
    return found[1:]


class KnownMotions(unittest.TestCase):
    def test_are_as_long_as_they_say(self):
        for seed in SEEDS:
            motion = KnownMotion(seed)
            self.assertAlmostEqual(sum(motion.piece_seconds), motion.seconds, places=9)
            self.assertTrue(2 <= len(motion.limits) <= 6)

    def test_are_smooth_from_rest_to_rest(self):
        for seed in SEEDS:
            motion = KnownMotion(seed)
            points, limits = np.array(motion.control_points), np.array(motion.limits).T
            np.testing.assert_array_equal(points[1:, 0], points[:-1, 3])
            self.assertFalse(points[0, 0].any())
            for rate, limit in zip(differences(motion)[:2], limits):
                share = rate / limit
                np.testing.assert_allclose(share[1:, 0], share[:-1, -1], atol=1e-7)
                np.testing.assert_allclose([share[0, 0], share[-1, -1]], 0.0, atol=1e-7)

    def test_keep_limits_and_reach_them(self):
        for seed in SEEDS:
            motion = KnownMotion(seed)
            velocity, acceleration, jerk = differences(motion)
            parts = np.linspace(0.0, 1.0, 33)[:, None, None, None]
            velocity = (1 - parts)**2 * velocity[:, 0] + 2 * parts * (1 - parts) * velocity[:, 1] + parts**2 * velocity[:, 2]
            limits = np.array(motion.limits)
            most = [np.abs(rate).max(axis=tuple(range(rate.ndim - 1))) / limits[:, k] for k, rate in enumerate((velocity, acceleration, jerk))]
            np.testing.assert_allclose(np.array(most), 1.0, atol=1e-7)

    def test_without_jerk_keep_limits_and_reach_them(self):
        for seed in SEEDS:
            motion = KnownMotion(seed, jerk=False)
            points, limits = np.array(motion.control_points), np.array([row[:2] for row in motion.limits])
            self.assertAlmostEqual(sum(motion.piece_seconds), motion.seconds, places=9)
            self.assertFalse(points[0, 0].any())
            np.testing.assert_array_equal(points[1:, 0], points[:-1, 2])
            of = np.array(motion.piece_seconds)[:, None, None]
            velocity = 2.0 * np.diff(points, axis=1) / of / limits[:, 0]
            acceleration = np.diff(points, n=2, axis=1) * 2.0 / of**2 / limits[:, 1]
            np.testing.assert_allclose(velocity[1:, 0], velocity[:-1, 1], atol=1e-7)
            np.testing.assert_allclose([velocity[0, 0], velocity[-1, 1]], 0.0, atol=1e-7)
            for share in (velocity, acceleration):
                np.testing.assert_allclose(np.abs(share).max(axis=(0, 1)), 1.0, atol=1e-7)

    def test_have_one_path_in_all_forms(self):
        for seed in SEEDS:
            motion = KnownMotion(seed)
            segments = [row["control_points"] for row in json.loads(motion.curve())["input"]["segments"]]
            if motion.elements():
                for segment, element in zip(segments, json.loads(motion.elements())["elements"], strict=True):
                    for point, same in zip(segment, element.get("control_points", [element["from"], element["to"]]), strict=True):
                        self.assertEqual([*point, 0.0][:3], same)
            if motion.g5():
                place = np.zeros(2)
                for segment, line in zip(segments, motion.g5().splitlines()[1:-1], strict=True):
                    words = {word[0]: float(word[1:]) for word in line.split()[1:]}
                    end = np.array([words["X"], words["Y"]])
                    np.testing.assert_allclose(end, segment[-1], atol=1e-7)
                    if len(segment) == 4:
                        np.testing.assert_allclose(place + [words["I"], words["J"]], segment[1], atol=2e-7)
                        np.testing.assert_allclose(end + [words["P"], words["Q"]], segment[2], atol=2e-7)
                    place = end

    def test_take_no_less_than_the_least_time(self):
        for seed in (3, 11):
            motion = KnownMotion(seed)
            chain = BezierChain([row["control_points"] for row in json.loads(motion.curve())["input"]["segments"]], len(motion.limits))
            seconds, stops = least(chain, machine(motion.limits, motion.feed()), "jerk", 1500)
            print(f"known motion {seed}: {motion.seconds:.4f} s, the least that the judge finds {seconds:.4f} s")
            self.assertEqual(stops, 0)
            self.assertTrue(0.9 * motion.seconds < seconds < 1.005 * motion.seconds)


class StraightMoves(unittest.TestCase):
    def test_of_seven_phases(self):
        for length in (300.0, 5.0, 1.0, 0.01):
            chain = BezierChain([[[0.0, 0.0], [length, 0.0]]], 2)
            seconds, _ = least(chain, machine([(100.0, 1000.0, 20000.0)] * 2, 100.0), "jerk", 800)
            self.assertAlmostEqual(seconds / seven_phase_seconds(length, 100.0, 1000.0, 20000.0), 1.0, delta=2e-3)
        # 100 mm/s is reached before 5000 mm/s^2 are: two ramps of jerk alone, of 2 sqrt(v / j) each
        self.assertAlmostEqual(seven_phase_seconds(100.0, 100.0, 5000.0, 20000.0), 1.0 + 2 * math.sqrt(100.0 / 20000.0), places=12)

    def test_of_seven_phases_is_that_of_the_highest_velocity(self):
        numbers = random.Random(53)
        for _ in range(300):
            length, velocity, acceleration, jerk = (10 ** numbers.uniform(*decades) for decades in ((-2, 3), (0, 3), (2, 4), (3, 6)))

            def ramp_s(v):
                return v / acceleration + acceleration / jerk if v * jerk >= acceleration**2 else 2.0 * math.sqrt(v / jerk)
            low, high = 0.0, velocity
            for _ in range(200):
                middle = 0.5 * (low + high)
                low, high = (middle, high) if middle * ramp_s(middle) <= length else (low, middle)
            seconds = 2.0 * ramp_s(low) + (length - low * ramp_s(low)) / low
            self.assertAlmostEqual(seconds / seven_phase_seconds(length, velocity, acceleration, jerk), 1.0, places=9)

    def test_are_not_faster_than_any_axis_alone(self):
        for seed in SEEDS:
            move = StraightMove(seed)
            alone = [seven_phase_seconds(abs(x), *limits) for x, limits in zip(move.end, move.setting.limits) if x]
            self.assertGreaterEqual(move.seconds, max(alone) * (1 - 1e-12))
            if len(alone) == 1 and move.setting.feed > max(limits[0] for limits in move.setting.limits):
                self.assertAlmostEqual(move.seconds, alone[0], places=9)


class MonotonePairs(unittest.TestCase):
    def test_have_the_same_lines(self):
        for seed in SEEDS:
            numbers = random.Random(seed)
            points = corners(numbers, 5)
            more = with_points_between(numbers, points)
            self.assertTrue(set(points) <= set(more))
            for point in more:
                exact = [Fraction("{:.7f}".format(x)) for x in point]
                self.assertEqual(exact, [Fraction(x) for x in point])

    def test_differ_in_one_thing(self):
        with tempfile.TemporaryDirectory(prefix="splinefeed-pairs-") as folder:
            for seed in SEEDS:
                pair = monotone_pair(seed, Path(folder))
                first, second = pair.first, pair.second
                machines = [case.machine.read_text(encoding="ascii") for case in (first, second)]
                differs = {"limit": machines[0] != machines[1], "period": machines[0] != machines[1],
                           "window": first.arguments[4:] != second.arguments[4:], "points": first.arguments[1] != second.arguments[1]}
                self.assertTrue(differs[pair.kind], pair.says)
                if pair.kind != "points":
                    self.assertEqual(first.arguments[1], second.arguments[1])


if __name__ == "__main__":
    unittest.main()
