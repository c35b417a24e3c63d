#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""The judge of tolerances, on paths whose distances are known in closed form; and on runs of the tool.

    path_tolerance_test.py TOOL"""
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

import needed  # noqa: F401
import numpy as np

from element_path import points_of
from motion_trace import Trace
from path_tolerance import judged

TOOL = None
MACHINE = {"axis": [{"name": n, "max_acceleration_mm_s2": 1000.0} for n in "xy"]}


def corner(tolerance=0.1, mode="continuous"):
    return [{"from": [0, 0, 0], "to": [10, 0, 0], "tolerance_mm": tolerance, "mode": mode},
            {"from": [10, 0, 0], "to": [10, 10, 0], "tolerance_mm": tolerance}]


def walked(*corners):
    """A trace along straight lines, a sample every 0.02 mm."""
    points = [np.array([corners[0]], float)]
    for a, b in zip(corners, corners[1:]):
        steps = int(math.ceil(math.dist(a, b) / 0.02))
        points.append(np.array(a) + np.linspace(0, 1, steps + 1)[1:, None] * (np.array(b) - np.array(a)))
    points = np.vstack(points)
    return Trace(1e-3 * np.arange(len(points)), points)


class Known(unittest.TestCase):
    def judge(self, elements, *corners):
        return judged(elements, MACHINE, walked(*corners), ["x", "y"])

    def test_a_corner_that_is_cut(self):
        cut = ((0, 0), (9.9, 0), (10, 0.1), (10, 10))
        for tolerance, kept in ((0.0715, True), (0.07, False)):
            found = self.judge(corner(tolerance), *cut)
            self.assertEqual(found["kept"], kept)
            self.assertAlmostEqual(found["coverage_mm"], math.sqrt(0.5) / 10, delta=1e-9)
            self.assertAlmostEqual(found["deviation_mm"], 0.05, delta=0.01)

    def test_a_stop_must_be_met(self):
        cut = ((0, 0), (9.99, 0), (10, 0.01), (10, 10))
        self.assertTrue(self.judge(corner(0.1), *cut)["kept"])
        for mode in ("exact_stop", "exact_path"):
            self.assertFalse(self.judge(corner(0.1, mode), *cut)["kept"])

    def test_what_is_left_out_or_done_backwards(self):
        there_and_back = corner() + [{"from": [10, 10, 0], "to": [10, 0, 0], "tolerance_mm": 0.1}]
        self.assertTrue(self.judge(there_and_back, (0, 0), (10, 0), (10, 10), (10, 0))["kept"])
        self.assertFalse(self.judge(there_and_back, (0, 0), (10, 0), (10, 10), (10, 1))["kept"])
        self.assertFalse(self.judge(there_and_back, (0, 0), (10, 0))["kept"])
        self.assertFalse(self.judge(corner(), (0, 0), (10, 0), (10, 10), (10, 0))["kept"])
        self.assertFalse(self.judge(corner(), (10, 10), (10, 0), (0, 0))["kept"])

    def test_elements_shorter_than_rounding_are_left_out(self):
        elements = corner(0.1)
        elements.insert(1, {"from": [10, 0, 0], "to": [10, 0.00005, 0], "tolerance_mm": 0.0})
        elements[2]["from"] = [10, 0.00005, 0]
        cut = ((0, 0), (9.9, 0), (10, 0.1), (10, 10))
        self.assertTrue(self.judge(elements, *cut)["kept"])
        elements[1]["mode"] = "exact_stop"
        self.assertFalse(self.judge(elements, *cut)["kept"])

    def test_points_of_curves(self):
        circle = points_of({"type": "arc", "from": [5, 0, 0], "to": [5, 0, 3], "centre": [0, 0, 0], "axis": [0, 0, 1],
                            "angle": -2 * math.pi})
        self.assertAlmostEqual(np.abs(np.hypot(circle[:, 0], circle[:, 1]) - 5).max(), 0, delta=1e-12)
        self.assertLess(circle[len(circle) // 4, 1], -4.9)
        quarter = points_of({"type": "nurbs", "from": [5, 0, 0], "to": [0, 5, 0], "order": 3, "weights": [1, 0.5**0.5, 1],
                             "control_points": [[5, 0, 0], [5, 5, 0], [0, 5, 0]], "knots": [0, 0, 0, 1, 1, 1]})
        self.assertAlmostEqual(np.abs(np.hypot(quarter[:, 0], quarter[:, 1]) - 5).max(), 0, delta=1e-12)


class Runs(unittest.TestCase):
    def run_and_judge(self, elements, *options):
        with tempfile.TemporaryDirectory() as folder:
            program = pathlib.Path(folder, "part.json")
            program.write_text(json.dumps({"elements": elements}), encoding="ascii")
            trace = pathlib.Path(folder, "t.csv")
            subprocess.run([TOOL, "run", program, "--trace", trace, "--quiet", *options], check=True, stdout=subprocess.DEVNULL)
            return judged([{"tolerance_mm": 0.1 if e.get("rapid") else 0.01, **e} for e in elements],
                          {"axis": [{"name": n, "max_acceleration_mm_s2": 1000.0} for n in "xyz"]},
                          Trace.read(trace, "xyz"), list("xyz"))

    def test_lines_arcs_and_splines(self):
        elements = [{"from": [0, 0, 0], "to": [20, 0, 0]},
                    {"type": "arc", "from": [20, 0, 0], "to": [30, 10, 2], "centre": [20, 10, 0], "axis": [0, 0, 1],
                     "angle": math.pi / 2, "tolerance_mm": 0.05},
                    {"from": [30, 10, 2], "to": [0, 30, 0], "rapid": True},
                    {"from": [0, 30, 0], "to": [0, 29, 0], "rapid": True},
                    {"type": "bezier", "from": [0, 29, 0], "to": [0, 0, 0],
                     "control_points": [[0, 29, 0], [9, 20, 0], [-9, 10, 5], [0, 0, 0]]}]
        found = self.run_and_judge(elements)
        self.assertTrue(found["kept"], found)
        self.assertGreater(found["coverage_mm"], 0.09)

    def test_a_chain_of_short_lines(self):
        places = [[round(5 * math.cos(a), 3), round(5 * math.sin(a), 3), 0] for a in np.linspace(0, 6, 400)]
        found = self.run_and_judge([{"from": a, "to": b} for a, b in zip(places, places[1:])])
        self.assertTrue(found["kept"], found)


if __name__ == "__main__":
    TOOL = sys.argv.pop(1)
    unittest.main()
