# SPDX-License-Identifier: MIT
"""CurveDistance: how far points are from a curve, to rounding."""
import math

import numpy as np
from scipy.spatial import cKDTree

NEAR = 6  # samples of the curve from which the nearest place is searched
STEPS = 8  # of Newton


def elevated(polygon, degree):
    """The same curve with control points for this degree."""
    while len(polygon) <= degree:
        part = np.arange(1, len(polygon))[:, None] / len(polygon)
        polygon = np.vstack([polygon[:1], part * polygon[:-1] + (1.0 - part) * polygon[1:], polygon[-1:]])
    return polygon


class CurveDistance:
    def __init__(self, chain, samples=40000):
        """samples: of the whole curve, spread over its pieces by their length."""
        degree = max(len(piece.control_points) for piece in chain.pieces) - 1
        polygons = np.stack([elevated(piece.control_points, degree) for piece in chain.pieces])
        self._polygons = [polygons, degree * np.diff(polygons, axis=1), degree * (degree - 1) * np.diff(polygons, 2, axis=1)]
        size = np.array([piece.polygon_length for piece in chain.pieces])
        counts = np.maximum(9, np.ceil(samples * size / size.sum())).astype(int)
        self._piece = np.repeat(np.arange(len(counts)), counts + 1)
        self._u = np.concatenate([np.linspace(0.0, 1.0, n + 1) for n in counts])
        self._step = 1.0 / counts[self._piece]
        self._tree = cKDTree(self._at(0, self._piece, self._u))

    def _at(self, order, piece, u):
        """A derivative by u at a place of each of these pieces."""
        polygons = self._polygons[order]
        degree = polygons.shape[1] - 1
        if degree < 0:
            return np.zeros((len(u), polygons.shape[2]))
        return sum((math.comb(degree, i) * u**i * (1.0 - u) ** (degree - i))[:, None] * polygons[piece, i]
                   for i in range(degree + 1))

    def of(self, points):
        """The distance of each point [mm]."""
        _, near = self._tree.query(points, k=NEAR)
        return np.min([self._from_near(points, sample) for sample in near.T], axis=0)

    def _from_near(self, points, sample):
        """From the piece of each sample, no farther from it than the next samples are."""
        piece, u = self._piece[sample], self._u[sample]
        low, high = np.maximum(u - self._step[sample], 0.0), np.minimum(u + self._step[sample], 1.0)
        best = np.linalg.norm(self._at(0, piece, u) - points, axis=1)
        for _ in range(STEPS):
            apart, first, second = (self._at(order, piece, u) - (points if order == 0 else 0.0) for order in range(3))
            bend = (first * first).sum(1) + (apart * second).sum(1)
            u = np.clip(u - (apart * first).sum(1) / np.where(bend > 0.0, bend, (first * first).sum(1)), low, high)
        return np.minimum(best, np.linalg.norm(self._at(0, piece, u) - points, axis=1))
