# SPDX-License-Identifier: MIT
"""Straight moves from rest to rest of random machines, whose least time is that of seven phases in closed form, whatever other axes there are."""
import json
import math
import random

from planning import Case, Setting

PERIODS_US = (50, 100, 125, 250, 500, 1000, 2000, 4000)
WINDOWS = (64, 128, 256, 512, 1024, 2048, 4096)
DECADES = 2.0  # limits of the axes have ratios up to 100
SECONDS = (0.05, 4.0)
MM = (0.01, 5000.0)


def seven_phase_seconds(length, velocity, acceleration, jerk):
    acceleration = min(acceleration, math.sqrt(velocity * jerk))
    rise = acceleration / jerk
    if length >= velocity * (velocity / acceleration + rise):
        return length / velocity + velocity / acceleration + rise
    if length >= 2.0 * acceleration * rise**2:  # the acceleration is reached, the velocity is not
        return rise + math.sqrt(rise**2 + 4.0 * length / acceleration)
    return 4.0 * (length / (2.0 * jerk)) ** (1.0 / 3.0)


class StraightMove:
    """`end` in mm (it begins at 0), `setting`, and `seconds`, the least time."""

    def __init__(self, seed):
        numbers = random.Random(f"straight move {seed}")
        self.seed = seed
        while not self.drawn(numbers):
            pass

    def drawn(self, numbers):
        """Whether it takes as long as is wanted."""
        count = numbers.randint(2, 6)
        acceleration = 10 ** numbers.uniform(2.7, 4.0)
        largest = (10 ** numbers.uniform(1.5, 2.8), acceleration, acceleration / 10 ** numbers.uniform(-2.3, -1.0))
        limits = [tuple(limit / 10 ** numbers.uniform(0.0, DECADES) for limit in largest) for _ in range(count)]
        limits[numbers.randrange(count)] = largest
        moving = [numbers.randrange(count)] if numbers.random() < 0.5 else numbers.sample(range(count), numbers.randint(2, count))
        direction = [numbers.choice((-1, 1)) * numbers.uniform(0.02, 1.0) if i in moving else 0.0 for i in range(count)]
        way_to_full, _ = self.along(direction, limits)
        length = way_to_full * 10 ** numbers.uniform(-2.0, 1.5)
        if not MM[0] <= length <= MM[1]:
            return False
        self.end = [round(length * d / math.hypot(*direction), 6) for d in direction]
        _, (velocity, acceleration, jerk) = self.along(self.end, limits)
        feed = 2.0 * math.hypot(*(limit[0] for limit in limits))
        if max(moving) < 3 and numbers.random() < 0.3:  # what a feed of other axes counts is not asked here
            feed = velocity = velocity * numbers.uniform(0.3, 1.0)
        self.setting = Setting(tuple(limits), feed, numbers.choice(PERIODS_US), ("--window", str(numbers.choice(WINDOWS))))
        self.form = numbers.choice(("csv", "json", "ngc") if count <= 3 else ("csv", "json"))
        self.seconds = seven_phase_seconds(math.hypot(*self.end), velocity, acceleration, jerk)
        return SECONDS[0] <= self.seconds <= SECONDS[1]

    @staticmethod
    def along(direction, limits):
        """How far it has to be to the full velocity and back to rest; velocity, acceleration and jerk along the line."""
        size = math.hypot(*direction)
        velocity, acceleration, jerk = (min(limit[k] * size / abs(d) for limit, d in zip(limits, direction) if d) for k in range(3))
        return velocity * (velocity / acceleration + acceleration / jerk), (velocity, acceleration, jerk)

    def write(self, folder):
        """Its program: two points, an element, or G-code."""
        program = folder / f"straight{self.seed}.{self.form}"
        places = [f"{x:.6f}" for x in self.end]
        if self.form == "csv":
            text = ",".join("xyzabc"[:len(places)]) + "\n" + ",".join("0" for _ in places) + "\n" + ",".join(places) + "\n"
        elif self.form == "json":
            end = [*self.end, 0.0, 0.0][:max(3, len(places))]
            text = json.dumps({"elements": [{"from": [0.0] * len(end), "to": end}]})
        else:
            words = " ".join(axis + place for axis, place in zip("XYZ", places))
            text = f"G21 G90 G94 G1 {words} F{60.0 * self.setting.feed:.6f}\nM2\n"
        program.write_text(text, encoding="ascii")
        return program

    def case(self, folder):
        return Case(self.write(folder), self.setting)
