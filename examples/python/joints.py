#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Six joints through five random points, within limits of velocity and acceleration: the problem that toppra's tutorial solves.

joints.py [PICTURE.png]: cycle times without and with a jerk limit, beside the least possible one.
"""
import sys

import numpy as np

import splinefeed

rng = np.random.default_rng(9)
points = np.degrees(rng.uniform(-1.0, 1.0, (5, 6)))
limits = {"kind": "rotary", "max_feed_mm_s": 10_000, "steps_per_mm": 1000,
          "max_velocity_mm_s": np.degrees(rng.uniform(1.0, 3.0, 6)), "max_acceleration_mm_s2": np.degrees(rng.uniform(10.0, 12.0, 6))}

motions = {}
for name, jerk in (("no jerk limit", None), ("jerk 20 times the acceleration", 20 * limits["max_acceleration_mm_s2"])):
    arm = splinefeed.Machine("xyzabc", **limits, max_jerk_mm_s3=jerk)
    motion = motions[name] = splinefeed.plan(points, arm, "bspline-interpolation")
    used = motion.summary["limit_use"]
    most = max(value for limit in used.values() for value in limit.values())
    print(f"{name}: {motion.time:.4f} s, least possible {motion.summary['optimum_time_s']:.4f} s, limits used {most:.5f}")

if len(sys.argv) > 1:
    import matplotlib.pyplot as plt
    figure, strips = plt.subplots(2, 2, figsize=(11, 5), sharex="col", layout="constrained")
    for column, (name, motion) in zip(strips.T, motions.items()):
        samples = motion.sample(1e-3)
        column[0].plot(samples.time, samples.velocity / motion.machine.limits["max_velocity_mm_s"])
        column[1].plot(samples.time, samples.acceleration / motion.machine.limits["max_acceleration_mm_s2"])
        column[0].set(title=f"{name}: {motion.time:.3f} s", ylabel="velocity / limit")
        column[1].set(xlabel="time [s]", ylabel="acceleration / limit")
    figure.savefig(sys.argv[1], dpi=80)
