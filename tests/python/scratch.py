# SPDX-License-Identifier: MIT
"""What tests of the Python module share."""
import pathlib
import tempfile
import unittest

import numpy as np

from splinefeed import Machine

FIVE = [[0, 0], [10, 5], [20, 0], [30, 5], [40, 0]]
LIMITS = {"max_velocity_mm_s": 100, "max_acceleration_mm_s2": 1000, "max_feed_mm_s": 100}
JERKY = Machine("xyz", **LIMITS, max_jerk_mm_s3=30000, steps_per_mm=320)


def noise(rows, axes=2, seed=1):
    return np.cumsum(np.random.default_rng(seed).normal(0, 4, (rows, axes)), axis=0)


class Scratch(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
