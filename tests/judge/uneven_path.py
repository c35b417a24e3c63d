# SPDX-License-Identifier: MIT
"""A smooth curve in space, sampled at points whose distances differ a thousandfold."""
import math
import random

LEAST_MM, MOST_MM = 0.02, 20.0


def uneven_points(seed, count=60):
    """Points 0.02 to 20 mm apart, each distance drawn anew and both extremes among them, on a curve that bends by 40 to 120 mm."""
    numbers = random.Random(seed)
    distances = [math.exp(numbers.uniform(math.log(LEAST_MM), math.log(MOST_MM))) for _ in range(count)]
    distances[count // 3], distances[count // 2] = LEAST_MM, MOST_MM
    at, points = 0.0, []
    for distance in [0.0, *distances]:
        at += distance
        points.append((40.0 * math.sin(at / 60.0), 60.0 * math.sin(at / 90.0 + 1.0), 20.0 * math.cos(at / 70.0)))
    return points


def write_uneven_path(path, seed):
    with open(path, "w", encoding="ascii") as file:
        file.write("x,y,z\n" + "".join("{:.6f},{:.6f},{:.6f}\n".format(*point) for point in uneven_points(seed)))
