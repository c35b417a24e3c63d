# SPDX-License-Identifier: MIT
"""The Python module against the command, and against itself."""
import contextlib
import json
import os
import signal
import threading
import time
import unittest
from unittest import mock

import numpy as np

import splinefeed
import tool
from scratch import FIVE, JERKY, LIMITS, noise, Scratch
from splinefeed import _native, Curve, InputError, Machine, Stream, UsageError

EXAMPLES = tool.ROOT / "examples"


class Planning(Scratch):
    """Motions, and what they say of themselves."""

    def same_as_the_command(self, motion, path, *options):
        rows, summary = tool.planned(path, motion.machine, *options)
        np.testing.assert_array_equal(tool.as_rows(motion.segments, len(motion.machine.axes)), rows)
        self.assertEqual(tool.without_process(motion.summary), tool.without_process(summary))
        self.assertAlmostEqual(motion.time, summary["cycle_time_s"], 12)
        return motion

    def test_programs_are_those_of_the_command(self):
        g = "G21 G90 F3000\nG0 X1 Y1\nG64 P0.02\n" + "".join(f"G1 X{i % 7} Y{i}\n" for i in range(30)) + "M2\n"
        (self.folder / "p.ngc").write_text(g)
        self.same_as_the_command(splinefeed.plan_gcode(g, JERKY), self.folder / "p.ngc")
        self.same_as_the_command(splinefeed.plan_gcode(self.folder / "p.ngc", JERKY, scalar="double"), self.folder / "p.ngc", "--scalar", "double")
        self.same_as_the_command(splinefeed.plan_gcode(EXAMPLES / "ring.gcode", dialect="marlin", ignore=["E", "unknown"]),
                                 EXAMPLES / "ring.gcode", "--dialect", "marlin", "--ignore", "E,unknown")
        elements = [{"type": "line", "from": [0, 0, 0], "to": [10, 0, 0]}, {"type": "line", "from": [10, 0, 0], "to": [10, 10, 0], "tolerance_mm": 0.2}]
        (self.folder / "e.json").write_text(json.dumps({"elements": elements}))
        for given in (elements, {"elements": elements}, json.dumps({"elements": elements}), self.folder / "e.json"):
            self.same_as_the_command(splinefeed.plan_elements(given, JERKY, tolerance_mm=0.05, scalar="double"), self.folder / "e.json",
                                     "--tolerance", "0.05", "--scalar", "double")
        self.same_as_the_command(splinefeed.plan_elements(EXAMPLES / "butterfly.json", JERKY), EXAMPLES / "butterfly.json")

    def test_columns_and_options_are_those_of_the_command(self):
        points = noise(40)
        feed, corner = np.where(np.arange(40) % 3, np.nan, 30.0), [None, True, False, None] * 10
        rows = "\n".join(f"{x!r},{y!r},{'' if np.isnan(f) else f},{'' if c is None else int(c)}"
                         for (x, y), f, c in zip(points.tolist(), feed, corner))
        (self.folder / "p.csv").write_text(f"x,y,feed,corner\n{rows}\n")
        self.same_as_the_command(splinefeed.plan(points, JERKY, feed_mm_s=feed, corner=corner), self.folder / "p.csv")
        tolerance = np.where(np.arange(40) % 2, 0.5, 0.1)
        np.savetxt(self.folder / "t.csv", np.column_stack([points, tolerance]), delimiter=",", fmt="%.17g", header="x,y,tolerance", comments="")
        segments, _ = tool.planned(self.folder / "t.csv", JERKY, "--curve", "polyline")
        np.testing.assert_array_equal(tool.as_rows(splinefeed.plan(points, JERKY, curve="polyline", tolerance_mm=tolerance).segments, 3), segments)

    def test_samples_are_the_segments_and_the_trace(self):
        motion = splinefeed.plan(noise(30, 3), JERKY)
        np.savetxt(self.folder / "p.csv", noise(30, 3), delimiter=",", fmt="%.17g")
        (self.folder / "m.toml").write_text(JERKY.toml)
        status, _, error = tool.call("plan", self.folder / "p.csv", "-m", self.folder / "m.toml", "--trace", self.folder / "t.csv", "--quiet")
        self.assertEqual(status, 0, error)
        trace = np.loadtxt(self.folder / "t.csv", delimiter=",", skiprows=1)
        at = motion.sample(trace[:, 0])
        np.testing.assert_allclose(at.position, trace[:, 1:4], rtol=0, atol=2e-9)
        np.testing.assert_allclose(np.linalg.norm(at.velocity, axis=1), trace[:, 4], rtol=0, atol=1e-6)
        # Where segments meet, also exactly there, and in any order.
        unit = 320 * _native.units_per_count
        order = np.random.default_rng(2).permutation(len(motion.segments))
        np.testing.assert_allclose(motion.sample(motion.begins[:-1][order]).position, motion.segments["start"][order] / unit, rtol=0, atol=1e-12)
        long = splinefeed.plan(noise(300), JERKY)  # times that seconds round to either side of a tick
        half = np.diff(long.begins) / 2
        np.testing.assert_array_equal(long.sample(long.begins[:-1]).jerk, long.sample(long.begins[:-1] + half).jerk)
        h, inner = 1e-5, np.linspace(0.01, motion.time - 0.01, 997)
        below, here, above = motion.sample(inner - h), motion.sample(inner), motion.sample(inner + h)
        for derivative, of in (("velocity", "position"), ("acceleration", "velocity")):
            np.testing.assert_allclose((getattr(above, of) - getattr(below, of)) / (2 * h), getattr(here, derivative), rtol=0, atol=0.5)
        dense = motion.sample(1e-4)
        self.assertAlmostEqual(dense.time[-1], motion.time, delta=1e-4)
        for name, most in (("velocity", 100), ("acceleration", 1000), ("jerk", 30000)):
            self.assertLess(np.abs(getattr(dense, name)).max(), most * (1 + 1e-9))
            self.assertGreater(np.abs(getattr(dense, name)).max(), 0.85 * most)
        behind = motion.sample([motion.time, motion.time + 5])
        np.testing.assert_array_equal(behind.position, np.repeat(motion.segments["end"][-1:] / unit, 2, axis=0))
        self.assertEqual((behind.velocity.any(), behind.acceleration.any(), behind.jerk.any()), (False, False, False))

    def test_segments_know_their_lines_and_limits(self):
        motion = splinefeed.plan_gcode("G21 G90 F3000\nG1 X10\nG1 Y10 F600\nG1 X0\nM2\n", JERKY)
        self.assertEqual(sorted(set(motion.lines)), [2, 3, 4])
        self.assertTrue((np.diff(motion.lines.astype(int)) >= 0).all())
        self.assertEqual(len(motion.binding), len(motion.segments))
        ticks = motion.segments["duration_ticks"]
        self.assertAlmostEqual(ticks[motion.binding == "no limit"].sum() / ticks.sum(), motion.summary["limit_share"]["none"], 9)
        self.assertIn("programmed feed", set(motion.binding[motion.lines == 3]))
        self.assertIn("jerk of y", set(motion.binding[motion.lines == 3]))
        self.assertEqual(sorted(set(splinefeed.plan(FIVE, JERKY).lines)), [2, 3, 4, 5])
        self.assertFalse(motion.segments.flags.writeable)

    def test_a_plot_has_the_path_and_each_axis(self):
        try:
            import matplotlib  # pylint: disable=import-outside-toplevel,unused-import
        except ImportError:
            self.skipTest("there is no matplotlib")
        figure = splinefeed.plan(FIVE, JERKY).plot()
        self.assertEqual([len(axes.lines) for axes in figure.axes if axes.get_ylabel().startswith("jerk")], [9])
        figure.savefig(self.folder / "f.png")
        self.assertGreater((self.folder / "f.png").stat().st_size, 10_000)


class Machines(Scratch):
    def test_a_machine_of_arguments_is_one_of_a_file(self):
        machine = Machine("xza", max_feed_mm_s=80, max_velocity_mm_s=[100, 50, 360], max_acceleration_mm_s2={"x": 1000, "z": 500, "a": 2000},
                          max_braking_mm_s2=3000, centripetal_mm_s2=700, chord_error_mm=0.01, steps_per_mm=100, max_jerk_mm_s3=[None, 20000, None], travel_mm=[(-100, 300), None, None], kind=["linear", "linear", "rotary"],
                          default_tolerance_mm=0.05, sample_period_us=500, name="a \"mill\"\n")
        (self.folder / "m.toml").write_text(machine.toml)
        again = Machine.from_toml(self.folder / "m.toml")
        for one in (machine, again):
            self.assertEqual((one.name, one.axes, one.toml), ('a "mill"\n', ("x", "z", "a"), machine.toml))
            np.testing.assert_array_equal(one.limits["max_velocity_mm_s"], [100, 50, 360])
            np.testing.assert_array_equal(one.limits["max_jerk_mm_s3"], [np.nan, 20000, np.nan])
            for key, value in {"sample_period_us": 500, "max_braking_mm_s2": 3000, "centripetal_mm_s2": 700, "chord_error_mm": 0.01, "steps_per_mm": 100}.items():
                self.assertTrue(np.all(one.limits[key] == value), key)
        points = noise(20, 3)
        np.testing.assert_array_equal(splinefeed.plan(points, machine).segments, splinefeed.plan(points, again).segments)

    def test_a_file_with_other_values(self):
        path = EXAMPLES / "three_axis.toml"
        machine = Machine.from_toml(path, set={"axis.y.max_jerk_mm_s3": 30000, "path.max_feed_mm_s": 50.0, "name": "an \"other\" one"})
        self.assertEqual((machine.name, machine.limits["max_feed_mm_s"]), ('an "other" one', 50.0))
        np.testing.assert_array_equal(machine.limits["max_jerk_mm_s3"], [np.nan, 30000, np.nan])
        (self.folder / "m.toml").write_text(machine.toml)
        points = noise(20, 3)
        np.testing.assert_array_equal(splinefeed.plan(points, machine).segments, splinefeed.plan(points, Machine.from_toml(self.folder / "m.toml")).segments)
        self.assertEqual(Machine.from_toml(path).toml, path.read_text())
        for wrong, sentence in (({"axis.x.max_jerk_mm_s3": 0.1}, "--set axis.x.max_jerk_mm_s3=0.1: max_jerk_mm_s3 is 0.1; it must lie between"),
                                ({"axis.u.kind": "rotary"}, "the machine has no axis 'u'; it has x, y, z"), ({"jerk": 1}, "unknown key 'jerk'")):
            with self.assertRaisesRegex(UsageError, sentence):
                Machine.from_toml(path, set=wrong)

    def test_axes_may_be_written_with_capitals(self):
        machine = Machine("XYz", **LIMITS, max_jerk_mm_s3={"x": 30000, "Z": 20000})
        self.assertEqual(machine.axes, ("x", "y", "z"))
        np.testing.assert_array_equal(machine.limits["max_jerk_mm_s3"], [30000, np.nan, 20000])
        (self.folder / "m.toml").write_text(machine.toml)
        for name in ("x", "X"):
            other = Machine.from_toml(self.folder / "m.toml", set={f"axis.{name}.max_jerk_mm_s3": 10000})
            np.testing.assert_array_equal(other.limits["max_jerk_mm_s3"], [10000, np.nan, 20000])

    def test_a_number_may_be_an_array_and_a_name_any_text(self):
        machine = Machine("x", **{**LIMITS, "max_feed_mm_s": np.array(80), "max_velocity_mm_s": np.array(90.5)}, name="a \x7f\t\"\\ ü")
        self.assertEqual((machine.limits["max_feed_mm_s"], list(machine.limits["max_velocity_mm_s"])), (80, [90.5]))
        self.assertEqual(machine.name, "a \x7f\t\"\\ ü")

    def test_the_default_machine_is_the_command_s(self):
        default = _native.default_machine().limits
        self.assertEqual(str(Machine.default().limits), str({key: np.array(v) if isinstance(v, list) else v for key, v in default.items()}))

    def test_what_is_wrong_is_said_as_the_command_says_it(self):
        for wrong in ({"max_jerk_mm_s3": -1}, {"max_velocity_mm_s": 1e9}, {"axes": "xx"}, {"max_feed_mm_s": None}, {"max_acceleraton": 1},
                      {"travel_mm": (5, 1)}, {"sample_period_us": 1}, {"kind": "round"}):
            with self.subTest(wrong):
                with mock.patch.object(_native, "parse_machine", wraps=_native.parse_machine) as parse, self.assertRaises(InputError) as raised:
                    Machine(**{"axes": "xyz", **LIMITS, **wrong})
                (self.folder / "machine").write_text(parse.call_args[0][0])
                status, _, error = tool.call("plan", EXAMPLES / "path61.csv", "-m", "machine", folder=self.folder)
                self.assertEqual((status, error), (2, f"{raised.exception}\n"))


class Refusals(Scratch):
    def test_programs_are_refused_as_by_the_command(self):
        for name, text in (("p.ngc", "G1 X10 F3000\nG1 Q7\n"), ("p.ngc", "M98 P\n"), ("p.json", '{"elements": [{"type": "lime"}]}\n'), ("p.json", "{\n")):
            with self.subTest(text):
                (self.folder / name).write_text(text)
                status, _, error = tool.call("plan", name, folder=self.folder)
                plan = splinefeed.plan_gcode if name.endswith("ngc") else splinefeed.plan_elements
                with contextlib.chdir(self.folder), self.assertRaises(InputError) as raised:
                    plan(name)
                self.assertEqual((status, error), (2, f"{raised.exception}\n"))
                with self.assertRaisesRegex(InputError, "^program:"):
                    plan(text)


class Curves(unittest.TestCase):
    def test_curves_are_those_of_the_command(self):
        points = noise(12)
        text = "\n".join(f"{x!r},{y!r}" for x, y in points.tolist()) + "\n"
        self.assertEqual(len(splinefeed.curve_names()), 9)
        for name in splinefeed.curve_names():
            with self.subTest(name):
                rows = points if name != "beta-chain" else points[:10]
                status, out, error = tool.call("curve", "-", "--curve", name, text="\n".join(text.split("\n")[:len(rows)]) + "\n")
                self.assertEqual(status, 0, error)
                curve = Curve(rows, name)
                segments = json.loads(out)["segments"]
                self.assertEqual(len(curve), len(segments))
                for mine, theirs in zip(curve.bezier, segments):
                    np.testing.assert_allclose(mine, theirs["control_points"], rtol=0, atol=1e-9)

    def test_values_derivatives_and_lengths(self):
        curve = Curve(noise(12, 3), "ferguson", scalar="double")
        u = np.linspace(0, len(curve), 301)[1:-1] + 1e-3
        for order in (1, 2):
            by_difference = (curve.derivative(u + 1e-6, order - 1) - curve.derivative(u - 1e-6, order - 1)) / 2e-6
            np.testing.assert_allclose(curve.derivative(u, order), by_difference, rtol=0, atol=1e-5)
        np.testing.assert_array_equal(curve.evaluate(np.arange(len(curve))), [piece[0] for piece in curve.bezier])
        np.testing.assert_array_equal(curve.evaluate(float(len(curve))), curve.bezier[-1][-1])
        self.assertEqual(curve.evaluate(np.zeros((2, 5))).shape, (2, 5, 3))
        fine = curve.evaluate(np.linspace(0, len(curve), 400_001))
        self.assertAlmostEqual(curve.arc_length(), np.linalg.norm(np.diff(fine, axis=0), axis=1).sum(), 6)
        self.assertAlmostEqual(curve.arc_length(5.0, 0.3), -curve.arc_length(0.3, 5.0), 9)
        self.assertAlmostEqual(curve.arc_length(0.3, 1.7) + curve.arc_length(1.7, 5.0), curve.arc_length(0.3, 5.0), 9)
        for wrong in (-0.1, len(curve) + 0.1, np.nan):
            with self.assertRaises(ValueError):
                curve.evaluate(wrong)

    def test_mixed_degrees_and_files(self):
        document = {"segments": [{"control_points": [[0, 0], [1, 0]]}, {"control_points": [[1, 0], [2, 0], [2, 1], [3, 1]]},
                                 {"control_points": [[3, 1], [4, 1], [4, 2]]}]}
        curve = Curve.from_json(document)
        np.testing.assert_allclose(curve.evaluate([0.5, 1.5, 2.5, 3.0]), [[0.5, 0], [2, 0.5], [3.75, 1.25], [4, 2]], atol=1e-15)
        np.testing.assert_array_equal(curve.derivative([0.5, 2.5], 2), [[0, 0], [-2, 2]])
        self.assertGreater(Curve.from_json(EXAMPLES / "logo.json").arc_length(), 100)


class LongWork(unittest.TestCase):
    """Others run meanwhile, and Ctrl-C ends it."""

    def test_ctrl_c(self):
        loop = "O1 while [1 EQ 1]\nG1 X[#1 MOD 7] F3000\n#1 = [#1 + 1]\nO1 endwhile\nM2\n"
        stream = Stream()
        stream.push(noise(200_000))
        for work in (lambda: splinefeed.plan(noise(2_000_000)), lambda: splinefeed.plan_gcode(loop), lambda: stream.next(10_000_000)):
            threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
            begun = time.monotonic()
            with self.assertRaises(KeyboardInterrupt):
                work()
            self.assertLess(time.monotonic() - begun, 5.0)

    def test_other_threads_run(self):
        counted, done = [0], threading.Event()

        def count():
            while not done.is_set():
                counted[0] += 1
                time.sleep(0.001)
        thread = threading.Thread(target=count)
        thread.start()
        before = counted[0]
        begun = time.monotonic()
        splinefeed.plan(noise(20_000))
        took = time.monotonic() - begun
        during = counted[0] - before
        done.set()
        thread.join()
        self.assertGreater(during, 20 * took)  # a thousand a second, were it alone


if __name__ == "__main__":
    unittest.main(verbosity=1)
