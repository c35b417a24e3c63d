# SPDX-License-Identifier: MIT
"""Arrays as callers have them: what is lossless is taken, all else is refused by one sentence, at every door."""
import decimal
import fractions
import unittest

import numpy as np

import splinefeed
from scratch import FIVE, LIMITS, noise
from splinefeed import Curve, Machine, Stream

POINTS = noise(12)
MASKED = np.ma.array(POINTS, mask=POINTS > 8)
PLAIN = splinefeed.plan(POINTS)
CURVE = Curve(FIVE)

#: The same numbers in other forms.
LOSSLESS = (POINTS.tolist(), tuple(map(tuple, POINTS.tolist())), list(POINTS), POINTS.astype(">f8"), np.asfortranarray(POINTS), np.ma.array(POINTS),
            np.ma.array(POINTS, mask=np.zeros_like(POINTS, bool)), np.repeat(POINTS, 3, axis=0)[::3], np.column_stack([POINTS] * 2)[:, :2],
            POINTS.astype(np.longdouble), memoryview(POINTS), np.frombuffer(b"\0" + POINTS.tobytes(), np.uint8)[1:].view(np.float64).reshape(12, 2))

#: (what is given for points, error, sentence); {} is the name of the argument.
WRONG = (
    (MASKED, ValueError, "{} has masked values; fill them, or leave them out"),
    (list(MASKED), ValueError, "{} has masked values; fill them, or leave them out"),
    (POINTS + 0j, TypeError, "{} must hold numbers, not complex numbers"),
    ([[0, 0], [1j, 1]], TypeError, "{} must hold numbers, not complex numbers"),
    (POINTS.astype("U32"), TypeError, "{} must hold numbers, not texts"),
    ([["0", "0"], ["1", "1"]], TypeError, "{} must hold numbers, not texts"),
    (POINTS.astype("S32"), TypeError, "{} must hold numbers, not bytes"),
    (POINTS > 0, TypeError, "{} must hold numbers, not True and False"),
    (POINTS.astype(object), TypeError, "{} must hold numbers, not objects such as "),
    ([[0, None], [1, 1]], TypeError, "{} must hold numbers, not objects such as 0"),
    ([[decimal.Decimal(1), fractions.Fraction(1)]], TypeError, "{} must hold numbers, not objects such as Decimal('1')"),
    (POINTS.astype("m8[s]"), TypeError, "{} must hold numbers, not durations"),
    (POINTS.astype("M8[s]"), TypeError, "{} must hold numbers, not dates"),
    (np.zeros(3, [("x", "f8"), ("y", "f8")]), TypeError, "{} must hold numbers, not records"),
    ([[0, 0], [1]], ValueError, "{} has rows of different lengths"),
    (POINTS.astype(np.longdouble) / 3, ValueError, "{} has numbers with more digits than a double has: "),
    ([[0, 0], [2**53 + 2, 1]], ValueError, "{} has numbers with more digits than a double has: 9007199254740994"),
    (object(), TypeError, "{} must hold numbers, not objects such as <object object"),
)
SHAPES = ((3.0, "()"), ([1.0, 2.0], "(2,)"), ([], "(0,)"), (np.zeros((2, 2, 2)), "(2, 2, 2)"))

#: Doors: what takes arrays, and the name that each gives it.
DOORS = ((splinefeed.plan, "points"), (Curve, "points"), (lambda value: Stream().push(value), "points"), (lambda value: CURVE.evaluate(value), "u"),
         (lambda value: CURVE.derivative(value), "u"), (PLAIN.sample, "times"))
COLUMNS = ((lambda name, value: splinefeed.plan(POINTS, **{name: value}), ("feed_mm_s", "max_feed_mm_s", "corner")),
           (lambda name, value: splinefeed.plan(POINTS, curve="polyline", **{name: value}), ("tolerance_mm",)),
           (lambda name, value: Stream().push(POINTS, **{name: value}), ("feed_mm_s", "max_feed_mm_s", "corner")))


class Arrays(unittest.TestCase):
    def refused(self, error, sentence, call):
        with self.assertRaises(error) as raised:
            call()
        self.assertIn(sentence, str(raised.exception))
        self.assertNotIn("\n", str(raised.exception))

    def test_what_is_lossless_is_taken(self):
        for number, points in enumerate(LOSSLESS):
            with self.subTest(number):
                self.assertEqual(splinefeed.plan(points), PLAIN)
        for dtype in (np.int8, np.int64, np.uint16, np.float16, np.float32, ">i4", ">f4"):
            self.assertEqual(splinefeed.plan(np.array(FIVE, dtype)), splinefeed.plan(FIVE))

    def test_all_else_is_refused_at_every_door(self):
        for call, name in DOORS:
            for value, error, sentence in WRONG:
                with self.subTest(name, value=str(value)[:40]):
                    self.refused(error, sentence.format(name), lambda call=call, value=value: call(value))
        for call in (splinefeed.plan, Curve):
            for value, shape in SHAPES:
                self.refused(ValueError, f"points must be an array of the shape (n, axes), not {shape}", lambda call=call, value=value: call(value))
        self.refused(ValueError, "times must be an array of the shape (n,), not (2, 2)", lambda: PLAIN.sample([[0, 1], [1, 2]]))
        self.refused(ValueError, "points must be an array of the shape (n, axes)", lambda: Stream().push(np.zeros((2, 2, 2))))

    def test_columns(self):
        for call, names in COLUMNS:
            for name in names:
                for value, error, sentence in WRONG:
                    if np.ndim(getattr(value, "shape", ())) <= 1 and not (name == "corner" and "True" in sentence) and "objects" not in sentence:
                        with self.subTest(name, value=str(value)[:40]):
                            self.refused(error, sentence.format(name), lambda call=call, name=name, value=value: call(name, value))
                self.refused(ValueError, f"{name} must have one number for each of the 12 points", lambda call=call, name=name: call(name, [1.0] * 11))
                self.refused(ValueError, f"{name} must have one number for each of the 12 points", lambda call=call, name=name: call(name, np.ones((12, 1))))
                self.refused(ValueError, f"{name} has masked values", lambda call=call, name=name: call(name, np.ma.array([1.0] * 12, mask=[1] + [0] * 11)))
                self.refused(ValueError, f"{name} has masked values", lambda call=call, name=name: call(name, [1.0] * 11 + [np.ma.masked]))
                self.refused(TypeError, f"{name} must hold numbers, not objects such as <object", lambda call=call, name=name: call(name, [object()] * 12))
        feeds = [30.0, None] * 6
        same = [splinefeed.plan(POINTS, feed_mm_s=feed) for feed in (feeds, np.array(feeds, dtype=object), np.array(feeds, dtype=float),
                                                                   np.array(feeds, dtype=">f4"), np.repeat(np.array(feeds, dtype=float), 2)[::2])]
        self.assertEqual(same, same[:1] * len(same))
        self.assertNotEqual(same[0], PLAIN)
        corners = [False, True] * 6
        self.assertEqual(splinefeed.plan(POINTS, corner=corners), splinefeed.plan(POINTS, corner=np.array(corners, dtype=np.int8)))

    def test_machines_options_and_documents(self):
        masked = np.ma.array([30000.0, 1.0], mask=[0, 1])
        two = [[0, 0], [1, 1]]
        for error, sentence, call in (
                (ValueError, "max_jerk_mm_s3 has masked values", lambda: Machine("xy", **LIMITS, max_jerk_mm_s3=masked)),
                (ValueError, "travel_mm has masked values", lambda: Machine("xy", **LIMITS, travel_mm=masked)),
                (TypeError, "(1+0j) is no value of a machine file", lambda: Machine("xy", **LIMITS, max_jerk_mm_s3=np.array([1, 1j]))),
                (TypeError, "b'x' is no value of a machine file", lambda: Machine("xy", **LIMITS, kind=b"x")),
                (ValueError, "start_tangent has masked values", lambda: splinefeed.plan(two, start_tangent=masked)),
                (ValueError, "start_tangent has masked values", lambda: splinefeed.plan(two, start_tangent=[1.0, np.ma.masked])),
                (TypeError, "start_tangent must be a number, a text or a sequence of them, not 1j", lambda: splinefeed.plan(two, start_tangent=[1j, 0])),
                (TypeError, "tension must be a number, a text or a sequence of them, not b'1'", lambda: splinefeed.plan(two, tension=b"1")),
                (ValueError, "position has masked values", lambda: splinefeed.plan_gcode("G1 X1 F100\n", position=np.ma.array([1, 2, 3], mask=[0, 0, 1]))),
                (ValueError, "an array of the document has masked values",
                 lambda: Curve.from_json({"segments": [{"control_points": np.ma.array(two, mask=[[0, 0], [0, 1]])}]})),
                (TypeError, "JSON has no 1j", lambda: Curve.from_json({"segments": [{"control_points": np.array([[1j, 0], [1, 1]])}]})),
                (TypeError, "JSON has no <object", lambda: splinefeed.plan_elements([{"type": object()}])),
                (ValueError, "JSON", lambda: splinefeed.plan_elements({"segments": [{"control_points": np.array([[np.nan, 0], [1, 1]])}]}))):
            with self.subTest(sentence):
                self.refused(error, sentence, call)
        self.assertEqual(Machine("xy", **LIMITS, max_jerk_mm_s3=np.ma.array([1.0, 2.0]) * 1e4), Machine("xy", **LIMITS, max_jerk_mm_s3=[10000, 20000]))
        self.assertEqual(Curve.from_json({"segments": [{"control_points": np.array(two, ">i2")}]}), Curve.from_json({"segments": [{"control_points": two}]}))

    def test_nan_is_refused_where_a_number_must_be(self):
        for call, error, sentence in ((lambda: splinefeed.plan([[0, 0], [np.nan, 1]]), splinefeed.InputError, "points:2: x 'nan' is out of range"),
                                      (lambda: splinefeed.plan([[0, np.inf], [0, 1]]), splinefeed.InputError, "points:1: y 'inf' is out of range"),
                                      (lambda: PLAIN.sample([np.nan]), ValueError, "times must be finite and not negative"),
                                      (lambda: PLAIN.sample(np.nan), ValueError, "the period must be above 0 s, not nan"),
                                      (lambda: CURVE.evaluate(np.nan), ValueError, "u must lie within 0 and 4")):
            self.refused(error, sentence, call)

    def test_a_machine_has_the_limits_that_its_hints_name(self):
        limits, hints = Machine.default().limits, splinefeed._machine.Limits.__annotations__
        self.assertEqual(set(limits), set(hints))
        for key, value in limits.items():
            self.assertEqual(isinstance(value, np.ndarray), "Numbers" in str(hints[key]), key)


if __name__ == "__main__":
    unittest.main(verbosity=1)
