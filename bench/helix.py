#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Prints N waypoints of a helix of 20 mm radius with 5 um of noise, about 0.35 mm apart: an endless program for a pipe.

    bench/helix.py 1000000 | splinefeed run - --quiet --summary json
"""
import math
import random
import sys

random.seed(1)
print("x,y,z")
for i in range(int(sys.argv[1]) if len(sys.argv) > 1 else 1000):
    x, y, z = 20 * math.cos(0.0174 * i), 20 * math.sin(0.0174 * i), 1e-4 * i
    print(f"{x + random.uniform(-0.005, 0.005):.6f},{y + random.uniform(-0.005, 0.005):.6f},"
          f"{z + random.uniform(-0.005, 0.005):.6f}")
