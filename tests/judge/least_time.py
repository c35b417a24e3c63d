# SPDX-License-Identifier: MIT
"""The least time in which a machine follows a run from rest to rest, its accelerations limited and its jerk not.

With b = v^2 linear over each interval of the grid the acceleration q' b'/2 + q'' b of an axis in the middle of the interval is
linear in b at its ends, so that what is allowed is a polygon of pairs (x, y) = (b here, b there). Backward: the largest x from
which rest at the end can be reached. Forward: the largest y that is reached from x. The error falls with the square of the
intervals' length."""
import numpy as np

BISECTIONS = 50


class Polygons:
    """For each interval the half-planes near x + far y <= most."""

    def __init__(self, grid, limits):
        q1, q2 = grid.q1.mean(1), grid.q2.mean(1)
        low, high = limits.acceleration_range(q1)
        slope, bend = q1 / (2.0 * grid.length[:, None]), q2 / 2.0
        self.near = near = np.concatenate([bend - slope, slope - bend], axis=1)
        self.far = far = np.concatenate([bend + slope, -bend - slope], axis=1)
        self.most = most = np.concatenate([high, -low], axis=1)
        cap = limits.speed_sq_cap(grid.q, grid.q1, grid.q2)
        self.node_cap = np.minimum(np.append(cap[:, 0], np.inf), np.append(np.inf, cap[:, 1]))
        # x <= up - up_slope y where x has a positive factor; x >= down - down_slope y where it has a negative one
        with np.errstate(divide="ignore", invalid="ignore"):
            self.up, self.up_slope = np.where(near > 0, most / near, np.inf), np.where(near > 0, far / near, 0.0)
            self.down, self.down_slope = np.where(near < 0, most / near, -np.inf), np.where(near < 0, far / near, 0.0)
            self.ahead, self.ahead_slope = np.where(far > 0, most / far, np.inf), np.where(far > 0, near / far, 0.0)

    def best_far(self):
        """The y, of those that leave an x, that allows the largest x."""
        def top(y):
            return np.minimum((self.up - self.up_slope * y[:, None]).min(1), self.node_cap[:-1])

        def bottom(y):
            return np.maximum((self.down - self.down_slope * y[:, None]).max(1), 0.0)

        low, high = np.zeros(len(self.up)), self.node_cap[1:].copy()
        for _ in range(BISECTIONS):
            y = np.where(top(high) >= bottom(high), high, 0.5 * (low + high))
            fits = top(y) >= bottom(y)
            low, high = np.where(fits, y, low), np.where(fits, high, y)
        left, right = np.zeros_like(low), low
        for _ in range(2 * BISECTIONS):  # of a concave function, by thirds
            a, b = left + (right - left) / 3.0, right - (right - left) / 3.0
            rises = top(a) < top(b)
            left, right = np.where(rises, a, left), np.where(rises, right, b)
        return 0.5 * (left + right)


def least_time(grid, limits):
    """The time [s], and b at the nodes of the grid."""
    polygons = Polygons(grid, limits)
    best_far = polygons.best_far()
    count = len(grid.length)
    reach = np.zeros(count + 1)
    for i in range(count - 1, -1, -1):
        y = min(reach[i + 1], best_far[i])
        reach[i] = max(0.0, min(polygons.node_cap[i], (polygons.up[i] - polygons.up_slope[i] * y).min()))
    b = np.zeros(count + 1)
    for i in range(count):
        b[i + 1] = max(0.0, min(reach[i + 1], (polygons.ahead[i] - polygons.ahead_slope[i] * b[i]).min()))
    v = np.sqrt(b)
    return float((2.0 * grid.length / np.maximum(v[1:] + v[:-1], 1e-9)).sum()), b
