#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""The plot of the Python tutorial's five points: motion.py PICTURE.png, with the module `splinefeed` on PYTHONPATH."""
import sys

import numpy as np
import splinefeed

machine = splinefeed.Machine("xy", max_feed_mm_s=100, max_velocity_mm_s=100, max_acceleration_mm_s2=1000)
points = np.array([[0, 0], [10, 5], [20, 0], [30, 5], [40, 0]])
splinefeed.plan(points, machine).plot().savefig(sys.argv[1], dpi=72)
