# SPDX-License-Identifier: MIT
"""Options and refusals as data. An option changes what comes of it, and as the command's option changes it."""
import contextlib
import inspect
import json
import os
import re
import threading
import unittest
import warnings

import numpy as np

import splinefeed
import tool
from scratch import FIVE, JERKY, LIMITS, noise, Scratch
from splinefeed import Curve, InputError, Machine, OutputError, SplinefeedWarning, Stream, UsageError

POINTS = noise(40)
CORNERS = "G90 F3000\nG1 X10\nG1 Y10\nG1 X0 Y3\nM2\n"
ELEMENTS = {"elements": [{"type": "line", "from": [0, 0, 0], "to": [10, 0, 0]}, {"type": "line", "from": [10, 0, 0], "to": [10, 10, 0]}]}
SEGMENTS = {"segments": [{"control_points": [[0, 0], [5, 0], [10, 0]]}, {"control_points": [[10, 0], [15, 0], [20, 9]]}]}
STATE = {"version": 1, "axes": ["x", "y", "z"], "position_mm": [1, 2, 3], "work_systems": [{"origin_mm": [0.5, 0, 0], "rotation_deg": 0}] * 9,
         "active": 0, "g92_mm": [0, 0, 0], "g92_applies": False, "tool_mm": [0, 0, 0], "g28_mm": [0, 0, 0], "g30_mm": [0, 0, 0], "tool_number": 0}
PLANNING = [({"scalar": "double"}, ""), ({"window": 12}, ""), ({"jerk_scalar": "float"}, ""), ({"advice": True}, None)]

# (function, input, its options, and as the command's where they are not --NAME VALUE); the last option is the one that is tried.
OPTIONS = [
    *((splinefeed.plan, POINTS, options, typed) for options, typed in (
        *PLANNING,
        ({"curve": "g2-bezier"}, ""), ({"closed": True}, ""), ({"closed": np.bool_(True)}, ""), ({"curve": "catmull-rom", "smooth": True}, ""),
        ({"curve": "bspline", "degree": 2}, ""), ({"curve": "catmull-rom", "parameterization": "uniform"}, ""),
        ({"curve": "bspline-interpolation", "knots": "uniform"}, ""), ({"curve": "catmull-rom", "tension": 0.4}, ""),
        ({"curve": "catmull-rom-modified", "factor": "constant"}, ""), ({"curve": "g2-bezier", "beta1": 1.25}, ""),
        ({"curve": "g2-bezier", "beta2": 0.5}, ""), ({"curve": "ferguson", "lambda_": 1.5}, ""), ({"curve": "ferguson", "mu": 2}, ""),
        ({"curve": "ferguson", "curvature_sign": "auto"}, ""), ({"corner_angle": 20}, ""), ({"start_tangent": np.array([0, 1])}, ""),
        ({"end_tangent": [0, 1]}, ""), ({"curve": "polyline", "tolerance_mm": np.array(0.3)}, ""))),
    *((splinefeed.plan_gcode, CORNERS, options, typed) for options, typed in (*PLANNING, ({"tolerance_mm": 0.2}, ""))),
    (splinefeed.plan_gcode, "G1 X10 E1 F3000\nM2\n", {"dialect": "marlin"}, ""),
    (splinefeed.plan_gcode, "G1 X10 E1 F3000\nM2\n", {"dialect": "marlin", "ignore": ["E", "unknown"]}, "--dialect marlin --ignore E,unknown"),
    (splinefeed.plan_gcode, "G43 H1\nG1 X10 F3000\nM2\n", {"tools": "t.tbl"}, ""),
    (splinefeed.plan_gcode, CORNERS, {"position": (1, 2, 3)}, ""),
    (splinefeed.plan_gcode, CORNERS, {"zero": (-1.5, 2, 3)}, ""),
    (splinefeed.plan_gcode, CORNERS, {"state": "s.json"}, ""),
    (splinefeed.plan_gcode, "G91 G1 X1 F3000\nX1 Y1\nM99\n", {"repeat": 3}, ""),
    (splinefeed.plan_gcode, "o<side> call\nM2\n", {"subprograms": "subs"}, ""),
    (splinefeed.plan_gcode, "G1 X10 F3000\nM30\n", {"dialect": "fanuc", "increments": True}, ""),
    (splinefeed.plan_gcode, "/G1 X10 F3000\nG1 Y10 F3000\nM2\n", {"block_delete": True}, ""),
    (splinefeed.plan_gcode, "G1 X10 F3000\nM1\nG1 X0\nM2\n", {"optional_stop": True}, ""),
    *((splinefeed.plan_elements, ELEMENTS, options, typed) for options, typed in (*PLANNING, ({"tolerance_mm": 0.2}, ""))),
    (splinefeed.plan_elements, SEGMENTS, {"smooth": True}, ""),
]
ARRAYS = {"points", "program", "elements", "machine", "feed_mm_s", "max_feed_mm_s", "corner", "options"}  # module_test.py

ONE, TWO = [[0, 0]], [[0, 0], [1, 1]]
XY = Machine("xy", **LIMITS, travel_mm=(0, 300))
NOT_THERE = "there is no argument '{}'"
# (what is called, error, sentence)
REFUSALS = [
    *((lambda points=points, options=options: splinefeed.plan(points, **options), error, sentence) for points, options, error, sentence in (
        (ONE, {}, InputError, "points:1: there is a single waypoint; a path needs two"),
        ([[0, 0], [np.nan, 1]], {}, InputError, "points:2: x 'nan' is out of range; a position must lie within +-1048576 mm"),
        ([[0, 0], [70000, 1]], {}, InputError, "points:2: x moves from 0 to 70000 mm; two successive waypoints must be at most"),
        (TWO, {"feed_mm_s": 1e6}, InputError, "points:1: feed '1000000' is out of range"),
        (TWO, {"corner": [0, 7]}, InputError, "points:2: corner is 7; it must be 1 (a corner), 0 (none) or nan"),
        ([[0] * 4, [1] * 4], {}, InputError, "points: the points have 4 coordinates; there must be 1 to 3: x, y, z"),
        ([0, 1, 2], {}, ValueError, "points must be an array of the shape (n, axes)"),
        (TWO, {"feed_mm_s": [1.0, 2.0, 3.0]}, ValueError, "feed_mm_s must have one number for each of the 2 points"),
        (TWO, {"curve": "g3"}, UsageError, "--curve 'g3': there is no such method; available are g2,"),
        (TWO, {"scalar": "doubl"}, UsageError, "--scalar 'doubl': it must be one of fixed, float, double; did you mean 'double'?"),
        (TWO, {"window": 3}, UsageError, "--window '3': it must be a whole number from 10 to 1000000"),
        (TWO, {"curve": True}, UsageError, "--curve 'True': there is no such method"),
        (TWO, {"closed": 1}, TypeError, "closed must be True or False"),
        (TWO, {"machine": "mill.toml"}, TypeError, "machine must be a Machine, not 'mill.toml'; Machine.from_toml() reads a file"),
        (TWO, {"tensoin": 1}, TypeError, "there is no argument 'tensoin'; did you mean 'tension'?"),
        ([[0, 0], [500, 0]], {"machine": XY}, InputError, "axis x goes to 500.000000 mm; its travel_mm is [0, 300]"),
        *((FIVE, {name: "a"}, TypeError, NOT_THERE.format(name)) for name in ("dialect", "state", "block_delete")))),
    *((lambda name=name: Stream(**{name: True}), TypeError, NOT_THERE.format(name)) for name in ("advice", "dialect")),
    *((lambda name=name: Curve(FIVE, **{name: True}), TypeError, NOT_THERE.format(name)) for name in ("window", "advice")),
    *((lambda call=call, path=path: call(path), UsageError, f"the {what} has no file; give its path, not '{path}'")
      for path in ("", "-") for what, call in (
          ("program", splinefeed.plan_gcode), ("program", splinefeed.plan_elements), ("curve", Curve.from_json), ("machine", Machine.from_toml),
          ("report", splinefeed.plan(FIVE).report))),
    (lambda: splinefeed.plan(FIVE).report("none/r.html"), OutputError, "none/r.html"),
    (lambda: splinefeed.plan_gcode("none.ngc"), InputError, "none.ngc: cannot be opened"),
    (lambda: Machine("xy", **LIMITS, max_jerk_mm_s3=1, sample_period_us=50), InputError, "machine: the sample period is too short for the acceleration"),
    (lambda: Machine("xyz", **LIMITS, max_jerk_mm_s3={"u": 30000}), ValueError, "there is no axis 'u'; the axes are x, y, z"),
    *((lambda keys=keys: Machine("xyz", **{**LIMITS, **keys}), error, sentence) for keys, error, sentence in (
        ({"max_jerk_mm_s3": {0: 30000}}, ValueError, "there is no axis '0'; the axes are x, y, z"),
        ({"max_jerk_mm_s3": {"X": 30000, "x": 40000}}, ValueError, "an axis is there with a small and with a capital letter: X, x; give one"),
        ({"max_feed_mm_s": 3j}, TypeError, "3j is no value of a machine file; it must be a number,"))),
    (lambda: Machine.from_toml("machine", set={"axis.x.invert": None}), TypeError, "None is no value of a machine file"),
    *((lambda call=call: call(3), TypeError, "there must be a text or a path, not 3")
      for call in (splinefeed.plan_gcode, splinefeed.plan_elements, Curve.from_json)),
    *((lambda call=call: call({"segments": [np.inf]}), ValueError, "not JSON compliant") for call in (splinefeed.plan_elements, Curve.from_json)),
]

DEGREE_9 = {"method": "bspline_interpolation", "input": {"points": POINTS[:20].tolist(), "degree": 9}}
NOTED = "degree 9 is high: the condition grows with it, and the curve swings between the points; 3 or 5 is usual"
# (what is called, the warning): of this line, and one line.
WARNINGS = [
    (lambda: splinefeed.plan(POINTS[:20], curve="bspline-interpolation", degree=9), f"points: {NOTED}"),
    (lambda: Curve(POINTS[:20], "bspline-interpolation", degree=9), f"points: {NOTED}"),
    (lambda: Curve.from_json(DEGREE_9), f"curve: {NOTED}"),
    (lambda: splinefeed.plan_elements(DEGREE_9), f"program: {NOTED}"),
    (lambda: splinefeed.plan_gcode("G28\nG1 X1 F100\nM104 S1\nM2\n", dialect="auto", ignore="unknown"), "program: --dialect marlin"),
]


class Data(Scratch):
    def setUp(self):
        super().setUp()
        self.enterContext(contextlib.chdir(self.folder))
        np.savetxt("points", POINTS, delimiter=",", fmt="%.17g")
        for name, text in (("t.tbl", "T1 P1 Z12.5\n"), ("s.json", json.dumps(STATE)), ("machine", JERKY.toml)):
            (self.folder / name).write_text(text)
        (self.folder / "subs").mkdir()
        (self.folder / "subs" / "side.ngc").write_text("o<side> sub\nG1 X10 F3000\no<side> endsub\n")

    def of_the_module(self, call, given, options):
        """What comes of it: its segments and its summary, or what is refused."""
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", SplinefeedWarning)
            try:
                motion = call(given, JERKY, **options)
            except InputError as error:
                return str(error)
        return tool.as_rows(motion.segments, 3).tolist(), tool.without_process(motion.summary)

    def of_the_command(self, given, options, typed):
        name, kind = ("points", "csv") if isinstance(given, np.ndarray) else ("program", "gcode" if isinstance(given, str) else "json")
        if name == "program":
            (self.folder / name).write_text(given if isinstance(given, str) else json.dumps(given) + "\n")
        if typed == "":
            for option, value in options.items():
                typed += f" --{option.strip('_').removesuffix('_mm').replace('_', '-')}"
                typed += "" if isinstance(value, (bool, np.bool_)) else f" {value}" if np.ndim(value) == 0 else " " + ",".join(map(str, value))
        advice = [] if options.get("advice") else ["--no-advice"]
        status, out, error = tool.call("plan", name, "--format", kind, "-m", "machine", "--segments", "s.csv", "--summary", "json", "--quiet",
                                       *advice, *(typed or "").split(), folder=self.folder)
        if status:
            return error.strip()
        rows = np.loadtxt("s.csv", delimiter=",", comments="#", skiprows=9, dtype=np.int64, ndmin=2)
        return rows.tolist(), tool.without_process(json.loads(out))

    def test_each_option_is_the_command_s_and_changes_what_comes(self):
        tried = set()
        for call, given, options, typed in OPTIONS:
            with self.subTest(call.__name__, options=options):
                *others, name = options
                mine = self.of_the_module(call, given, options)
                self.assertEqual(mine, self.of_the_command(given, options, typed))
                self.assertNotEqual(mine, self.of_the_module(call, given, {other: options[other] for other in others}))
                tried.add((call, name))
        for call in (splinefeed.plan, splinefeed.plan_gcode, splinefeed.plan_elements):
            names = set(inspect.signature(call).parameters) | set(re.findall(r"\w+", inspect.getdoc(call).partition("smooth, degree,")[2].partition(":")[0]))
            self.assertEqual({(call, name) for name in names - ARRAYS} - tried, set())

    def test_refusals(self):
        for call, error, sentence in REFUSALS:
            with self.subTest(sentence):
                with self.assertRaises(error) as raised:
                    call()
                self.assertIn(sentence, str(raised.exception))
                self.assertEqual(isinstance(raised.exception, splinefeed.Error), error not in (ValueError, TypeError))

    def test_a_warning_is_one_line_of_the_line_that_called(self):
        for call, text in WARNINGS:
            with self.subTest(text), warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                call()
                line = inspect.getsourcelines(call)[1]
                self.assertEqual([(one.category, one.filename, one.lineno) for one in caught], [(SplinefeedWarning, __file__, line)])
                self.assertTrue(str(caught[0].message).startswith(text) and "\n" not in str(caught[0].message), str(caught[0].message))

    def test_a_report_is_the_command_s_page(self):
        gcode = "G21 G90 F3000\nG1 X10\nG1 Y10\nM2\n"
        (self.folder / "program").write_text(gcode)
        for motion, given in ((splinefeed.plan(POINTS, JERKY), "points --format csv"), (splinefeed.plan_gcode(gcode, JERKY), "program --format gcode")):
            with self.subTest(given):
                motion.report("mine.html")
                status, _, error = tool.call("plan", *given.split(), "-m", "machine", "--report", "theirs.html", "--quiet", folder=self.folder)
                self.assertEqual(status, 0, error)
                mine, theirs = (self.data_of(name) for name in ("mine.html", "theirs.html"))
                self.assertTrue(mine["summary"]["what_would_help"])
                of_text = ("lines",) if given.startswith("points") else ()  # an array has no lines
                self.assertEqual(*({key: value for key, value in page.items() if key not in of_text} for page in (mine, theirs)))

    def data_of(self, page):
        """What a page shows, without what differs from process to process."""
        data = json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', (self.folder / page).read_text(), re.DOTALL)[1])
        return {**data, "summary": tool.without_process(data["summary"])}

    def test_what_stops_a_motion_is_said_as_the_command_says_it(self):
        text = "".join(f"G1 X{i % 40} Y{i % 7} F3000\n" for i in range(300)) + "G1 Q7\nM2\n"
        os.mkfifo("p.ngc")  # read once: what is wrong is found behind the first moves

        def with_program(call):
            writer = threading.Thread(target=lambda: (self.folder / "p.ngc").write_text(text))
            writer.start()
            done = call()
            writer.join()
            return done
        motion = with_program(lambda: splinefeed.plan_gcode("p.ngc", JERKY, window=10))
        status, _, error = with_program(lambda: tool.call("plan", "p.ngc", "-m", "machine", "--window", "10", "--quiet", folder=self.folder))
        self.assertEqual((status, error), (1, f"splinefeed: {motion.stopped}\n"))
        self.assertTrue(motion.summary["stopped"])
        self.assertEqual(splinefeed.plan(FIVE).stopped, "")


if __name__ == "__main__":
    unittest.main(verbosity=1)
