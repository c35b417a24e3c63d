#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Which feed is worth its drives: the cycle time of a part over feed and acceleration.

feed_study.py [PICTURE.png]: a table of cycle times, and which limit binds for the largest share of the time.
"""
import collections
import pathlib
import sys

import numpy as np

import splinefeed

part = np.loadtxt(pathlib.Path(__file__).parent.parent / "path61.csv", delimiter=",", skiprows=2)[:, :2]
feeds = [25, 50, 100, 150, 200]
times = {}
print(f"{'mm/s^2':>8}" + "".join(f"{feed:>11} mm/s" for feed in feeds))
for acceleration in (500, 1000, 2000, 4000):
    bound = []
    for feed in feeds:
        machine = splinefeed.Machine("xy", max_feed_mm_s=feed, max_velocity_mm_s=200, max_acceleration_mm_s2=acceleration,
                                     max_jerk_mm_s3=50 * acceleration)
        motion = splinefeed.plan(part, machine)
        times[acceleration, feed] = motion.time
        shares: collections.Counter[str] = collections.Counter()
        for limit, ticks in zip(motion.binding, motion.segments["duration_ticks"].tolist()):
            shares[limit.split(" of ")[0]] += ticks
        bound.append(shares.most_common(1)[0][0])
    print(f"{acceleration:>8}" + "".join(f"{times[acceleration, feed]:>14.3f} s" for feed in feeds))
    print(" " * 8 + "".join(f"{limit:>16}" for limit in bound))

if len(sys.argv) > 1:
    import matplotlib.pyplot as plt
    figure, plot = plt.subplots(figsize=(7, 4), layout="constrained")
    for acceleration in sorted({key[0] for key in times}):
        plot.plot(feeds, [times[acceleration, feed] for feed in feeds], marker="o", label=f"{acceleration} mm/s²")
    plot.set(xlabel="feed [mm/s]", ylabel="cycle time [s]", ylim=(0, None), title="path61: more feed helps as far as the acceleration lets it")
    plot.legend()
    figure.savefig(sys.argv[1], dpi=80)
