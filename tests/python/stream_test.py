# SPDX-License-Identifier: MIT
"""Streams of the Python module against plans, and steered."""
import unittest

import numpy as np

import splinefeed
import tool
from scratch import JERKY, LIMITS, noise, Scratch
from splinefeed import InputError, Machine, Stream, UsageError


class Streams(Scratch):
    def drain(self, stream, most=100_000):
        out = []
        while len(part := stream.next(most)):
            out.append(part)
        return np.concatenate(out)

    def test_points_in_any_portions_give_the_bits_of_a_plan(self):
        points, rng = noise(300, 3), np.random.default_rng(4)
        for curve, machine in (("g2", JERKY), ("catmull-rom", Machine.default()), ("polyline", JERKY)):
            with self.subTest(curve):
                stream, out, at = Stream(machine, curve), [], 0
                while at < len(points):
                    portion = int(rng.integers(1, 9))
                    stream.push(points[at] if portion == 1 else points[at:at + portion])
                    at += portion
                    out.append(stream.next(int(rng.integers(1, 500))))
                stream.finish()
                out.append(self.drain(stream))
                self.assertEqual(stream.state, "finished")
                np.testing.assert_array_equal(np.concatenate(out), splinefeed.plan(points, machine, curve).segments)

    def test_steering_is_that_of_events(self):
        points = noise(60)
        np.savetxt(self.folder / "p.csv", points, delimiter=",", fmt="%.17g")
        (self.folder / "e.csv").write_text("t,event,value\n0.2,override,0.5\n0.6,hold\n1.2,resume\n")
        machine = Machine("xy", **LIMITS)
        expected, _ = tool.planned(self.folder / "p.csv", machine, "--events", self.folder / "e.csv")
        stream, out, now = Stream(machine), [], 0.0
        stream.push(points)
        stream.finish()
        steps = [(0.2, lambda: stream.override(0.5)), (0.6, stream.hold), (1.2, stream.resume)]
        while True:
            while steps and steps[0][0] <= now + 1e-9:
                steps.pop(0)[1]()
            segment = stream.next(1)
            if not len(segment) and stream.state == "held":
                segment = stream.stand()
            if not len(segment):
                break
            out.append(segment)
            now += segment["duration_ticks"][0] / 8e6
        np.testing.assert_array_equal(tool.as_rows(np.concatenate(out), 2), expected)

    def test_a_machine_that_cannot_wait_stops_at_the_last_known_point(self):
        stream = Stream(Machine("xy", **LIMITS), window=64)
        stream.push(noise(60))
        first = stream.next(10_000)
        self.assertEqual(stream.state, "starved")
        self.assertTrue(first["end_velocity"][-1].any())
        rest = stream.next(10_000, drain=True)
        self.assertFalse(rest["end_velocity"][-1].any())
        self.assertEqual(rest["index"][0], first["index"][-1] + 1)
        stream.push(noise(60, seed=2) + noise(60)[-1])
        stream.finish()
        self.assertGreater(len(self.drain(stream)), 0)
        self.assertEqual(stream.state, "finished")

    def test_a_feed_has_its_limit_for_every_override(self):
        times = []
        for most in (None, 20.0):
            stream = Stream(Machine("xy", **LIMITS))
            stream.override(2.0)
            stream.push(noise(40), feed_mm_s=20.0, max_feed_mm_s=most)
            stream.finish()
            times.append(len(self.drain(stream)))
        self.assertLess(times[0], 0.7 * times[1])

    def test_what_a_stream_refuses(self):
        with self.assertRaisesRegex(UsageError, "bspline-interpolation needs all points before it begins; take plan"):
            Stream(curve="bspline-interpolation")
        stream = Stream(Machine("xy", **LIMITS, travel_mm=(0, 45)))
        with self.assertRaisesRegex(InputError, "points: the points have 3 coordinates; there must be 1 to 2: x, y"):
            stream.push([1, 2, 3])
        stream.push([0, 0])
        with self.assertRaisesRegex(InputError, "points: these points have 1 coordinates; the first ones have 2"):
            stream.push([1])
        with self.assertRaisesRegex(InputError, "points:1: there is a single waypoint"):
            stream.finish()
        with self.assertRaisesRegex(InputError, "points:2: y 'nan' is out of range"):
            stream.push([1, np.nan])
        with self.assertRaisesRegex(InputError, "points:1: there is a single waypoint"):  # the wrong one does not count
            stream.finish()
        for ratio in (-0.1, 2.1, np.nan):
            with self.assertRaisesRegex(ValueError, "an override must lie between 0 and 2"):
                stream.override(ratio)
        stream.push([[30, 0], [60, 0]])
        stream.finish()
        with self.assertRaisesRegex(UsageError, "nothing can be pushed behind finish"):
            stream.push([1, 1])
        with self.assertRaisesRegex(InputError, r"axis x goes to .* its travel_mm is \[0, 45\]"):
            self.drain(stream)


if __name__ == "__main__":
    unittest.main(verbosity=1)
