# SPDX-License-Identifier: MIT
"""Trace: where the axes were told to be at every sample period, and what of each limit that uses."""
import csv

import numpy as np

STANDS_MM = 1e-9


class Trace:
    def __init__(self, times, positions):
        """times [s], one row of positions [mm] each. All periods are the same but for the last one, which may be shorter."""
        self.times, self.positions = times, positions
        self.period = float(np.median(np.diff(times)))
        even = times if abs(times[-1] - times[-2] - self.period) < 1e-9 else times[:-1]
        if len(even) > 1 and np.abs(np.diff(even) - self.period).max() > 1e-9:
            raise ValueError("the trace has samples at uneven times")

    @classmethod
    def read(cls, path, axes):
        with open(path, newline="", encoding="ascii") as file:
            rows = csv.reader(file)
            columns = {name: i for i, name in enumerate(next(rows))}
            values = np.array([[float(x) for x in row] for row in rows])
        return cls(values[:, columns["t"]], values[:, [columns[axis] for axis in axes]])

    @property
    def cycle_time(self):
        """From the first to the last motion [s]."""
        moves = np.flatnonzero(np.any(np.abs(np.diff(self.positions, axis=0)) > STANDS_MM, axis=1))
        return float(self.times[moves[-1] + 1] - self.times[moves[0]]) if len(moves) else 0.0

    def uses(self, limits):
        """The largest use of each limit, by axis; feed apart.

        A difference over one, two, three periods is a mean of the derivative over them, so it never exceeds a limit that holds.
        Before the first and after the last sample the axes stand."""
        # Where the last period is shorter the axes are at the end of a full one where they are at its own.
        h, rest = self.period, 3
        q = np.vstack([self.positions[:1]] * rest + [self.positions] + [self.positions[-1:]] * rest)
        velocity = np.diff(q, axis=0) / h
        acceleration = np.diff(velocity, axis=0) / h
        jerk = np.diff(acceleration, axis=0) / h
        way = 0.5 * (velocity[1:] + velocity[:-1])
        one_way = velocity[1:] * velocity[:-1] > 0.0
        brakes = one_way & (acceleration * way < 0.0)
        highest = np.where(one_way, np.where(brakes, limits.braking, limits.acceleration),
                           np.maximum(limits.braking, limits.acceleration))
        ends = q[1:], q[:-1]
        most = np.maximum(limits.velocity_at(ends[0]), limits.velocity_at(ends[1]))
        return {"velocity": (np.abs(velocity) / most).max(0), "acceleration": (np.abs(acceleration) / highest).max(0),
                "jerk": (np.abs(jerk) / limits.jerk).max(0), "feed": feed_use(velocity, limits)}


def feed_use(velocity, limits):
    """Of the linear axes together, where they move; else of the rotary ones."""
    linear = np.linalg.norm(velocity * limits.linear, axis=-1)
    all_axes = np.linalg.norm(velocity, axis=-1)
    return float(np.where(linear > 1e-9, linear, all_axes).max() / limits.feed)
