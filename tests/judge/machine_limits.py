# SPDX-License-Identifier: MIT
"""MachineLimits: what a machine file allows each axis and the path."""
import math
import tomllib

import numpy as np

TINY = 1e-12


class MachineLimits:
    """Units as in the file: mm (degrees for rotary axes) and s. A limit that the file does not have is infinite."""

    def __init__(self, machine):
        path = machine.get("path", {})
        axes = machine["axis"]
        self.names = [axis["name"] for axis in axes]
        self.period_s = machine.get("sample_period_us", 1000) * 1e-6
        self.feed = float(path["max_feed_mm_s"])
        self.centripetal = float(path.get("centripetal_mm_s2", math.inf))
        self.chord_error = float(path.get("chord_error_mm", math.inf))
        self.velocity = np.array([axis["max_velocity_mm_s"] for axis in axes], float)
        self.acceleration = np.array([axis["max_acceleration_mm_s2"] for axis in axes], float)
        braking = [axis.get("max_braking_mm_s2", axis["max_acceleration_mm_s2"]) for axis in axes]
        self.braking = np.array(braking, float)
        self.jerk = np.array([axis.get("max_jerk_mm_s3", math.inf) for axis in axes], float)
        self.linear = np.array([axis.get("kind", "linear") == "linear" for axis in axes])
        travel = [axis.get("travel_mm", (-math.inf, math.inf)) for axis in axes]
        zone = [axis.get("travel_end_zone_mm", 0.0) for axis in axes]
        self.inner = np.array([(low + z, high - z) for (low, high), z in zip(travel, zone)], float)
        slow = [axis.get("travel_end_velocity_mm_s", axis["max_velocity_mm_s"]) for axis in axes]
        self.slow = np.array(slow, float)

    @classmethod
    def read(cls, path):
        with open(path, "rb") as file:
            return cls(tomllib.load(file))

    def velocity_at(self, q):
        """Of each axis at the places q: less near the ends of its travel."""
        near_end = (q < self.inner[:, 0]) | (q > self.inner[:, 1])
        return np.where(near_end, self.slow, self.velocity)

    def speed_sq_cap(self, q, q1, q2):
        """The largest squared path speed that velocities, feed, centripetal and chord limits allow at each place."""
        feed_share = np.linalg.norm(q1 * self.linear, axis=-1)
        feed_share = np.where(feed_share > TINY, feed_share, np.linalg.norm(q1, axis=-1))  # rotary axes alone
        speed = np.minimum(self.feed / feed_share, (self.velocity_at(q) / np.maximum(np.abs(q1), TINY)).min(-1))
        bend = np.maximum(np.linalg.norm(q2, axis=-1), TINY)
        return np.minimum(speed**2, np.minimum(self.centripetal, 8.0 * self.chord_error / self.period_s**2) / bend)

    def acceleration_range(self, q1):
        """Lowest and highest acceleration of each axis where it moves in the direction q1: against it, it is braking."""
        ahead = np.where(q1 >= 0.0, self.acceleration, self.braking)
        back = np.where(q1 >= 0.0, self.braking, self.acceleration)
        return -back, ahead
