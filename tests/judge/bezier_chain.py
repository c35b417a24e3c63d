# SPDX-License-Identifier: MIT
"""BezierChain: the travelled curve, as a curve .json gives it."""
import json
import math

import numpy as np


class BezierPiece:
    """One Bezier segment; its parameter u runs from 0 to 1."""

    def __init__(self, control_points):
        polygon = np.asarray(control_points, float)
        self._polygons = [polygon]
        for degree in range(len(polygon) - 1, 0, -1):
            polygon = degree * np.diff(polygon, axis=0)
            self._polygons.append(polygon)

    @property
    def control_points(self):
        return self._polygons[0]

    @property
    def start(self):
        return self._polygons[0][0]

    @property
    def end(self):
        return self._polygons[0][-1]

    @property
    def polygon_length(self):
        """Length of the control polygon: at least that of the curve."""
        return float(np.linalg.norm(np.diff(self._polygons[0], axis=0), axis=1).sum())

    def derivative(self, order, u):
        """The derivative of this order by u at the places u: one row a place. Order 0 is the point itself."""
        u = np.atleast_1d(np.asarray(u, float))
        if order >= len(self._polygons):
            return np.zeros((len(u), self._polygons[0].shape[1]))
        polygon = self._polygons[order]
        degree = len(polygon) - 1
        basis = [math.comb(degree, i) * u**i * (1.0 - u) ** (degree - i) for i in range(degree + 1)]
        return np.column_stack(basis) @ polygon

    def along(self, u):
        """Position q and its derivatives q', q'', q''' by arc length at the places u, and |dq/du|."""
        q, r1, r2, r3 = (self.derivative(order, u) for order in range(4))
        rate = np.linalg.norm(r1, axis=1)
        if not rate.min() > 0.0:
            raise ValueError("the curve has a vanishing tangent: its derivatives by length do not exist there")
        rate = rate[:, None]
        mixed = (r1 * r2).sum(1)[:, None]
        mixed_rate = ((r2 * r2).sum(1) + (r1 * r3).sum(1))[:, None]  # d(mixed)/du
        q1 = r1 / rate
        q2 = r2 / rate**2 - r1 * mixed / rate**4
        q3 = (r3 / rate**2 - (3.0 * r2 * mixed + r1 * mixed_rate) / rate**4 + 4.0 * r1 * mixed**2 / rate**6) / rate
        return q, q1, q2, q3, rate[:, 0]


class BezierChain:
    """Pieces in travel order, of `axes` coordinates each: those that the file does not have are 0."""

    def __init__(self, control_points, axes, closed=False):
        self.pieces = []
        for points in control_points:
            points = np.asarray(points, float)
            self.pieces.append(BezierPiece(np.pad(points, ((0, 0), (0, axes - points.shape[1])))))
        self.closed = closed

    @classmethod
    def read(cls, path, axes):
        with open(path, encoding="utf-8") as file:
            content = json.load(file)
        return cls([segment["control_points"] for segment in content["segments"]], axes, content.get("closed", False))

    def smooth_runs(self, corner_rad=1e-3):
        """The pieces in lists, broken where the direction jumps: there a machine has to stop."""
        runs = [[self.pieces[0]]]
        for before, after in zip(self.pieces, self.pieces[1:]):
            t0, t1 = before.along(1.0)[1][0], after.along(0.0)[1][0]
            if np.linalg.norm(t1 - t0) > corner_rad:
                runs.append([])
            runs[-1].append(after)
        return runs
