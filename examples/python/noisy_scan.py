#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A noisy scan becomes a path: 1,500 measured points of a contour, with 5 um of noise, within a tolerance.

noisy_scan.py [PICTURE.png]: cycle times of the curve through every point, and of paths within 0.02 and 0.1 mm of the lines.
"""
import sys

import numpy as np

import splinefeed

rng = np.random.default_rng(3)
angle = np.linspace(0.0, 2.0 * np.pi, 1500)
radius = 30.0 + 4.0 * np.cos(3.0 * angle) + 1.5 * np.sin(7.0 * angle)
contour = np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)
scan = contour + rng.normal(0.0, 0.005, contour.shape)

machine = splinefeed.Machine("xy", max_feed_mm_s=200, max_velocity_mm_s=200, max_acceleration_mm_s2=2000, max_jerk_mm_s3=50_000)
motions = {"through every point": splinefeed.plan(scan, machine, corner_angle=180)}
for tolerance in (0.02, 0.1):
    motions[f"within {tolerance} mm"] = splinefeed.plan(scan, machine, "polyline", tolerance_mm=tolerance)
clean = splinefeed.plan(contour, machine, corner_angle=180).time
for name, motion in motions.items():
    print(f"{name}: {motion.time:.2f} s, {motion.time / clean:.2f} times that of the contour without noise")

if len(sys.argv) > 1:
    import matplotlib.pyplot as plt
    figure, (path, speed) = plt.subplots(1, 2, figsize=(11, 4.5), layout="constrained")
    path.plot(*scan.T, ".", color="0.7", markersize=3, label="scan")
    for name, motion in motions.items():
        samples = motion.sample(1e-3)
        path.plot(*samples.position.T, linewidth=1, label=name)
        speed.plot(samples.time, np.linalg.norm(samples.velocity, axis=1), linewidth=1, label=f"{name}: {motion.time:.2f} s")
    x, y = contour[100]
    path.set(xlim=(x - 0.4, x + 0.4), ylim=(y - 0.4, y + 0.4), xlabel="x [mm]", ylabel="y [mm]", title="0.8 mm of the contour")
    speed.set(xlabel="time [s]", ylabel="speed [mm/s]")
    path.legend()
    speed.legend()
    figure.savefig(sys.argv[1], dpi=80)
