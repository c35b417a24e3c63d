#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What a host that stood still excuses, and what it does not."""
import contextlib
import io
import os
import time
import unittest
import unittest.mock

from real_time import ATTEMPTS, Call, HostStoodStill, HostWatch, OffTime, exit_status


def call(stood_still_s):
    return Call(0, "", "", stood_still_s)


def status(problems):
    """The exit status of a test whose attempts all have these problems, and how many it made."""
    made = []
    with contextlib.redirect_stdout(io.StringIO()) as printed:
        result = exit_status(lambda: made.append(1) or problems)
    return result, len(made), printed.getvalue()


class Excuses(unittest.TestCase):
    def test_a_host_that_kept_time_excuses_nothing(self):
        problems = [OffTime.off_path(0.0006, 0.0004, 100.0)]
        self.assertEqual(call(0.0009).excused(problems), problems)
        self.assertEqual(status(call(0.0009).excused(problems))[:2], (1, 1))

    def test_a_stall_excuses_what_it_explains(self):
        problems = [OffTime.off_path(0.5, 0.1, 100.0)]  # 4 ms of motion: four delays of 1 ms
        self.assertEqual(call(0.00099).excused(problems), problems)
        excused = call(0.0011).excused(problems)
        self.assertIsInstance(excused[0], HostStoodStill)
        result, made, printed = status(excused)
        self.assertEqual((result, made), (77, ATTEMPTS))
        self.assertIn("SKIPPED: ", printed)
        far = [OffTime.off_path(8.1, 0.1, 100.0)]  # 80 ms of motion
        self.assertEqual(call(0.019).excused(far), far)

    def test_what_time_does_not_explain_is_not_excused(self):
        problems = [OffTime("late"), "they end 3 counts from where the plan ends"]
        self.assertEqual(call(1.0).excused(problems), problems)
        self.assertEqual(status(problems)[0], 1)

    def test_a_line_that_is_late_is_seen(self):
        read = os.read
        with unittest.mock.patch("real_time.os.read", lambda *of: time.sleep(0.3) or read(*of)), HostWatch() as watch:
            time.sleep(0.4)
        self.assertGreaterEqual(watch.late_s["line"], 0.3)
        self.assertEqual(watch.longest_s, max(watch.late_s.values()))

    def test_a_run_without_problems_passes_at_once(self):
        self.assertEqual(status([])[:2], (0, 1))


if __name__ == "__main__":
    unittest.main()
