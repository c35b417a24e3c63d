# SPDX-License-Identifier: MIT
"""Machines, motions and curves as pickles: equal bits, in other processes too, and what is damaged is refused."""
import concurrent.futures
import copy
import json
import multiprocessing
import os
import pathlib
import pickle
import resource
import tempfile
import unittest
import warnings
import zlib

import numpy as np

import splinefeed
import tool
from scratch import FIVE, JERKY, LIMITS, noise, Scratch
from splinefeed import Curve, InputError, Machine, Motion, SplinefeedWarning, Stream

GCODE = "G21 G90 F3000\nG1 X10 (\u00e4\u00f6)\nG1 Y10 F600\nM2\n"
ROUNDS = 1500
MEMORY = 512 << 20  # more than there is: a damaged pickle may ask Python for any amount


def motions():
    """Of each kind of input, and of each number of axes."""
    yield splinefeed.plan(noise(30), JERKY, feed_mm_s=[None, *range(20, 49)], corner=[None, True, False] * 10)
    yield splinefeed.plan(noise(9), JERKY, "polyline", tolerance_mm=np.linspace(0.1, 0.2, 9), scalar="double")
    yield splinefeed.plan_gcode(GCODE, JERKY)
    yield splinefeed.plan_gcode(GCODE.encode("utf-8") + b"(\xff)\n", JERKY)
    yield splinefeed.plan_elements([{"type": "line", "from": [0, 0, 0], "to": [10, 0, 0]}], JERKY)
    yield splinefeed.plan(FIVE, Machine.from_toml(tool.ROOT / "examples/three_axis.toml"), advice=True)
    for axes in range(1, 7):
        yield splinefeed.plan(noise(9, axes), Machine("xyzabc"[:axes], **LIMITS))


def planned(machine, points):
    """In another process."""
    return splinefeed.plan(points, machine)


def sampled(motion):
    """In another process."""
    return motion.sample(0.01)


def refused(points):
    """In another process."""
    return splinefeed.plan(points)


class Pickles(Scratch):
    def assert_same(self, mine, theirs):
        self.assertEqual(mine, theirs)
        self.assertEqual(hash(mine), hash(theirs))
        self.assertEqual(mine.segments.tobytes(), theirs.segments.tobytes())
        self.assertEqual(tool.without_process(mine.summary), tool.without_process(theirs.summary))
        for name in ("time", "stopped", "notes"):
            self.assertEqual(getattr(mine, name), getattr(theirs, name))
        for name in ("lines", "binding", "begins"):
            np.testing.assert_array_equal(getattr(mine, name), getattr(theirs, name))
        self.assertEqual(mine.sample(0.003), theirs.sample(0.003))
        self.assertEqual(repr(mine), repr(theirs))
        self.assertEqual(mine.machine.toml, theirs.machine.toml)

    def test_a_motion_is_its_bits(self):
        for motion in motions():
            for protocol in range(pickle.HIGHEST_PROTOCOL + 1):
                self.assert_same(motion, pickle.loads(pickle.dumps(motion, protocol)))
            self.assert_same(motion, copy.deepcopy(motion))
            self.assert_same(motion, copy.copy(motion))
            self.assertEqual(pickle.dumps(motion), pickle.dumps(pickle.loads(pickle.dumps(motion))))

    def test_equal_plans_have_equal_records(self):
        one, other = (splinefeed.plan(noise(200), JERKY) for _ in range(2))
        self.assertEqual(one, other)
        self.assertEqual(one._native.records.tobytes(), other._native.records.tobytes())
        self.assertFalse(one._records["zero"].any())
        self.assertNotEqual(one, splinefeed.plan(noise(200, seed=2), JERKY))
        self.assertNotEqual(one, splinefeed.plan(noise(200), JERKY, scalar="double"))
        self.assertNotEqual(one, splinefeed.plan(noise(200), Machine("xyz", **LIMITS, max_jerk_mm_s3=30000, steps_per_mm=320, name="other")))
        self.assertNotEqual(one, 1)

    def test_its_report_is_planned_again(self):
        for motion, name in ((splinefeed.plan_gcode(GCODE, JERKY), "g.html"), (splinefeed.plan(noise(9), JERKY, feed_mm_s=30), "p.html")):
            pickle.loads(pickle.dumps(motion)).report(self.folder / name)
            motion.report(self.folder / "first.html")
            shown = [(self.folder / one).read_text() for one in (name, "first.html")]
            self.assertEqual(*(len(one.splitlines()) for one in shown))
            self.assertIn(f"{motion.time:.3f}"[:4], shown[0])

    def test_what_a_caller_changes_later_is_not_in_it(self):
        points = noise(30)
        motion = splinefeed.plan(points, JERKY)
        before = pickle.dumps(motion)
        points[:] = 0
        self.assertEqual(before, pickle.dumps(motion))

    def test_a_thousand_motions_of_texts_do_not_hold_files_open(self):
        soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
        resource.setrlimit(resource.RLIMIT_NOFILE, (64, hard))
        self.addCleanup(resource.setrlimit, resource.RLIMIT_NOFILE, (soft, hard))
        held = [splinefeed.plan_gcode("G1 X1 F3000\nM2\n") for _ in range(100)]
        self.assertEqual(len({motion.time for motion in held}), 1)

    def test_machines_are_equal_that_state_the_same(self):
        one = Machine("xy", **LIMITS, max_jerk_mm_s3=30000)
        (self.folder / "m.toml").write_text("# the same\n" + one.toml.replace(" = 100\n", " = 100.0\n").replace("[path]", "\n[path]   # here"))
        other = Machine.from_toml(self.folder / "m.toml")
        self.assertNotEqual(one.toml, other.toml)
        self.assertEqual(one, other)
        self.assertEqual({one: 1}[other], 1)
        for machine in (one, other, Machine.default(), Machine("x", **LIMITS, name="a \x7f\t\"\\ ü")):
            for again in (pickle.loads(pickle.dumps(machine)), copy.copy(machine), copy.deepcopy(machine)):
                self.assertEqual((again, hash(again), again.toml, str(again.limits)), (machine, hash(machine), machine.toml, str(machine.limits)))
        for different in (Machine("yx", **LIMITS, max_jerk_mm_s3=30000), Machine("xy", **LIMITS, max_jerk_mm_s3=30001), Machine("xy", **LIMITS), "xy"):
            self.assertNotEqual(one, different)

    def test_curves_and_samples(self):
        for curve in (Curve(noise(9)), Curve.from_json({"segments": [{"control_points": [[0, 0], [1, 0]]}, {"control_points": [[1, 0], [2, 0], [2, 1]]}]})):
            curve.evaluate(0.5)
            again = pickle.loads(pickle.dumps(curve))
            self.assertEqual((again, hash(again), again.arc_length()), (curve, hash(curve), curve.arc_length()))
            self.assertNotEqual(curve, Curve(noise(9, seed=3)))
        samples = splinefeed.plan(FIVE).sample(0.1)
        self.assertEqual(pickle.loads(pickle.dumps(samples)), samples)
        self.assertNotEqual(samples, splinefeed.plan(FIVE).sample(0.2))

    def test_everything_public_says_what_it_is(self):
        motion = splinefeed.plan(FIVE)
        for one, text in ((motion.machine, "<splinefeed.Machine 'default machine': x, y, z>"), (motion.sample(0.1), "<splinefeed.Samples: 8 of 3 axes>"),
                          (Stream(), "<splinefeed.Stream: starved, of x, y, z>"), (Curve(FIVE), "<splinefeed.Curve: 4 segments of 2 axes>")):
            self.assertEqual(repr(one).replace("'machine'", "'default machine'"), text)

    def test_a_stream_is_not_copied(self):
        for call in (pickle.dumps, copy.copy, copy.deepcopy):
            with self.assertRaisesRegex(TypeError, "a Stream is in the middle of its work and cannot be pickled or copied"):
                call(Stream())
        with self.assertRaisesRegex(TypeError, "a Motion is made by plan"):
            Motion()

    def test_other_processes_plan_the_same(self):
        sets = [noise(20, seed=seed) for seed in range(4)]
        with concurrent.futures.ProcessPoolExecutor(2, multiprocessing.get_context("spawn")) as pool:
            for points, motion in zip(sets, pool.map(planned, [JERKY] * len(sets), sets)):
                self.assert_same(splinefeed.plan(points, JERKY), motion)
            mine = splinefeed.plan(FIVE, JERKY)
            self.assertEqual(pool.submit(sampled, mine).result(), mine.sample(0.01))
            with self.assertRaisesRegex(InputError, "points:1: there is a single waypoint"):
                pool.submit(refused, [[0, 0]]).result()

    def test_a_warning_comes_once(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            motion = splinefeed.plan(noise(20), curve="bspline-interpolation", degree=9)
            again = pickle.loads(pickle.dumps(motion))
        self.assertEqual([one.category for one in caught], [SplinefeedWarning])
        self.assertEqual(again.notes, motion.notes)


class Damage(unittest.TestCase):
    def setUp(self):
        before = resource.getrlimit(resource.RLIMIT_AS)
        mapped = int(pathlib.Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
        resource.setrlimit(resource.RLIMIT_AS, (mapped + MEMORY, before[1]))
        self.addCleanup(resource.setrlimit, resource.RLIMIT_AS, before)
        seed = int(os.environ.get("SPLINEFEED_SEED") or np.random.SeedSequence().entropy % 2**32)
        print(f"seed {seed}", flush=True)
        self.rng = np.random.default_rng(seed)
        self.all = [splinefeed.plan_gcode(GCODE, JERKY), splinefeed.plan(noise(4), Machine("xy", **LIMITS)), JERKY, Curve(noise(9))]

    def use(self, one):
        """All that a motion can do. It may refuse, and must not end the process."""
        for call in (repr, hash, lambda motion: motion.segments, lambda motion: motion.sample(np.array([0.0, 0.01, 1e9])), lambda motion: motion.binding,
                     lambda motion: motion.summary, lambda motion: motion.machine.limits, pickle.dumps, lambda curve: curve.evaluate(0.5),
                     lambda motion: motion.report(pathlib.Path(folder) / "r.html") if self.rng.random() < 0.02 else None):
            with tempfile.TemporaryDirectory() as folder:
                try:
                    call(one)
                except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError, OSError):
                    pass

    def changed(self, data):
        out = bytearray(data)
        for _ in range(int(self.rng.integers(1, 4))):
            out[int(self.rng.integers(len(out)))] = int(self.rng.integers(256))
        return bytes(out) if self.rng.random() < 0.8 else bytes(out[:int(self.rng.integers(len(out)))])

    def test_a_damaged_pickle_is_the_same_object_or_an_error(self):
        for number in range(ROUNDS):
            one = self.all[number % len(self.all)]
            try:
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore")
                    again = pickle.loads(self.changed(pickle.dumps(one)))
            except Exception:  # pylint: disable=broad-except  # what Python's own reader says
                continue
            if isinstance(again, type(one)):
                self.assertEqual(one, again)

    def test_the_state_itself_is_refused_by_a_sentence(self):
        for number in range(ROUNDS):
            one = self.all[number % len(self.all)]
            restore, (kind, state) = one.__reduce__()
            damaged = self.changed(state)
            if damaged != state:
                with self.assertRaisesRegex(InputError, "^pickle: (the (Motion|Machine|Curve) is damaged: |it begins with )[^\n]*$"):
                    restore(kind, damaged)

    def test_a_right_checksum_of_wrong_bytes_is_no_crash(self):
        restored = 0
        for number in range(ROUNDS):
            restore, (kind, state) = self.all[number % len(self.all)].__reduce__()
            first, _, rest = state.partition(b"\n")
            body = self.changed(rest[4:])
            try:
                again = restore(kind, first + b"\n" + zlib.crc32(body).to_bytes(4, "little") + body)
            except InputError as error:
                self.assertNotIn("\n", str(error))
                continue
            restored += 1
            self.use(again)
        self.assertGreater(restored, ROUNDS // 20)

    def test_other_versions_kinds_and_processors_are_named(self):
        motion = self.all[0]
        restore, (kind, state) = motion.__reduce__()
        for wrong, sentence in ((state.replace(b"splinefeed motion 1", b"splinefeed motion 2", 1),
                                 "pickle: it begins with 'splinefeed motion 2'; of a Motion this version reads 'splinefeed motion 1'"),
                                (JERKY.__reduce__()[1][1], "pickle: it begins with 'splinefeed machine 1'; of a Motion this version reads 'splinefeed motion 1'"),
                                (state[:-1], "pickle: the Motion is damaged: its checksum is of other bytes; pickle it once more")):
            with self.assertRaises(InputError) as raised:
                restore(kind, wrong)
            self.assertEqual(str(raised.exception), sentence)

        def stated(facts, arrays):
            """Of other facts, with their checksum."""
            body = splinefeed._state._packed("motion", {**motion._state()[0], **facts}, {**motion._state()[1], **arrays})
            return restore(Motion, body)
        self.assertEqual(stated({}, {}), motion)
        records, starts = motion._native.records, motion._native.first
        other = Machine("xy", **LIMITS)._state()[0]
        far = records.copy()
        far.view(splinefeed._motion._record_dtype(3))["end"][1::2] = 2**62
        far.view(splinefeed._motion._record_dtype(3))["end"][::2] = -2**62 - 2
        unknown = records.copy()
        unknown.view(splinefeed._motion._record_dtype(3))["limit"][1] = 255
        still = starts.copy()
        still[:, 8:12] = 0
        for facts, arrays, sentence in (({"order": "big"}, {}, "its integers are big-endian, and this processor's are little-endian"),
                                        ({"machine": other}, {}, "its segments are none of 2 axes"), ({}, {"records": far}, "segment 1 is none of a plan"),
                                        ({}, {"records": unknown}, "segment 1 is none of a plan"), ({}, {"first": still}, "segment 0 is none of a plan"),
                                        ({"time": -1.0}, {}, "its time is none"), ({"time": float("nan")}, {}, "its time is none"),
                                        ({"machine": {"text": "[path]\n", "file": "m"}}, {}, None), ({"notes": 3}, {}, "")):
            with self.assertRaises(InputError) as raised:
                stated(facts, arrays)
            if sentence is not None:
                self.assertIn(f"pickle: the Motion is damaged: {sentence}", str(raised.exception))

    def test_arrays_that_none_can_be_are_refused(self):
        for kind, facts, rows, sentence in ((Curve, {"degrees": [3]}, [["points", "<f8", [-4, -2]]], "no array is <f8"),
                                            (Curve, {"degrees": [3]}, [["points", "|O", [4, 2]]], "no array is |O"),
                                            (Curve, {"degrees": [3]}, [["points", "<f8", [5, 2]]], "cannot reshape array"),
                                            (Curve, {"degrees": [2]}, [["points", "<f8", [4, 2]]], "its degrees are not those of its points"),
                                            (Curve, {"degrees": []}, [["points", "<f8", [4, 2]]], "its degrees are not those of its points"),
                                            (Curve, {"degrees": [7]}, [["points", "<f8", [8]]], "its degrees are not those of its points"),
                                            (Machine, {"text": 3, "file": "m"}, [], "parse_machine")):
            head = json.dumps({**facts, "arrays": rows}).encode()
            body = len(head).to_bytes(8, "little") + head + bytes(64)
            with self.assertRaises(InputError) as raised:
                splinefeed._state.restored(kind, b"splinefeed %s 1\n" % kind._kind.encode() + zlib.crc32(body).to_bytes(4, "little") + body)
            self.assertIn(f"pickle: the {kind.__name__} is damaged: {sentence}", str(raised.exception))
            self.assertNotIn("\n", str(raised.exception))


if __name__ == "__main__":
    unittest.main(verbosity=1)
