# SPDX-License-Identifier: MIT
"""SegmentCubics: the feed segments of a run, cubics in time, and what of each limit they use at any instant."""
import csv
import re

import numpy as np

from motion_trace import feed_use

TICKS_PER_S = 8e6


class SegmentCubics:
    def __init__(self, seconds, start, end, start_velocity, end_velocity):
        """Of each segment: its duration, and of each axis positions [mm] and velocities [mm/s] at its ends."""
        h = seconds[:, None]
        self.seconds = seconds
        self.start, self.end = start, end
        way = (end - start) / h
        self.velocities = start_velocity, end_velocity
        self.first_acceleration = (6.0 * way - 4.0 * start_velocity - 2.0 * end_velocity) / h
        self.last_acceleration = (2.0 * start_velocity + 4.0 * end_velocity - 6.0 * way) / h
        self.jerk = (self.last_acceleration - self.first_acceleration) / h

    @classmethod
    def read(cls, path, axes):
        """A file of --segments: integers, and what their units are in the lines on top."""
        units = {}
        with open(path, newline="", encoding="ascii") as file:
            rows = [line for line in file]
        for line in rows:
            if found := re.match(r"# (\w+)_start, .*1 unit = ([-+.e0-9]+) mm", line):
                units[found[1]] = float(found[2])
        table = list(csv.reader(line for line in rows if not line.startswith("#")))
        columns = {name: i for i, name in enumerate(table[0])}
        integers = {name: [int(row[i]) for row in table[1:]] for name, i in columns.items()}
        seconds = np.array(integers["duration_ticks"], float) / TICKS_PER_S

        def of(ending):
            return np.column_stack([np.array(integers[axis + ending], float) * units[axis] for axis in axes])

        per_duration = seconds[:, None]
        return cls(seconds, of("_start"), of("_end"), of("_v_start") / per_duration, of("_v_end") / per_duration)

    def gaps(self):
        """The largest jump between segments of the position [mm] and of the velocity [mm/s]."""
        if len(self.seconds) < 2:
            return 0.0, 0.0
        return (float(np.abs(self.start[1:] - self.end[:-1]).max()),
                float(np.abs(self.velocities[0][1:] - self.velocities[1][:-1]).max()))

    def uses(self, limits):
        """The largest use of each limit at any instant, by axis: velocities where they are extreme, accelerations at both ends
        (they are linear in between), the jerk, which is constant. The feed at nine instants of each segment."""
        h = self.seconds[:, None]
        slope = self.last_acceleration - self.first_acceleration
        turn = np.where(slope != 0.0, -self.first_acceleration / np.where(slope != 0.0, slope, 1.0), -1.0)
        inside = np.clip(turn, 0.0, 1.0)
        speeds = [self.velocity_at(np.zeros_like(h)), self.velocity_at(inside), self.velocity_at(np.ones_like(h))]
        most = np.maximum(limits.velocity_at(self.start), limits.velocity_at(self.end))
        velocity = np.maximum.reduce([np.abs(v) for v in speeds])
        one_way = (speeds[0] * speeds[2] > 0.0) & (speeds[0] * speeds[1] > 0.0)
        uses = []
        for acceleration in (self.first_acceleration, self.last_acceleration):
            brakes = acceleration * speeds[1] < 0.0
            highest = np.where(one_way, np.where(brakes, limits.braking, limits.acceleration),
                               np.maximum(limits.braking, limits.acceleration))
            uses.append((np.abs(acceleration) / highest).max(0))
        feed = max(feed_use(self.velocity_at(np.full_like(h, u)), limits) for u in np.linspace(0.0, 1.0, 9))
        return {"velocity": (velocity / most).max(0), "acceleration": np.maximum(*uses),
                "jerk": (np.abs(self.jerk) / limits.jerk).max(0), "feed": feed}

    def velocity_at(self, u):
        """At this part of each segment."""
        h = self.seconds[:, None]
        return self.velocities[0] + h * u * (self.first_acceleration + 0.5 * u * h * self.jerk)

    def position_at(self, times):
        """At these times from the start; before it and after the end it stands."""
        begins = np.concatenate([[0.0], np.cumsum(self.seconds)])
        i = np.clip(np.searchsorted(begins, times, side="right") - 1, 0, len(self.seconds) - 1)
        t = np.clip(times - begins[i], 0.0, self.seconds[i])[:, None]
        return self.start[i] + t * (self.velocities[0][i] + t * (self.first_acceleration[i] / 2.0 + t * self.jerk[i] / 6.0))
