# SPDX-License-Identifier: MIT
"""PathGrid: a smooth run of Bezier pieces, cut into short intervals of known length."""
import numpy as np

GAUSS_X, GAUSS_W = np.polynomial.legendre.leggauss(8)


class PathGrid:
    """Interval i lies within one piece. Where pieces join, both of them say how the curve bends, each on its own side.

    length: of each interval [mm]; q, q1, q2, q3: position and derivatives by arc length, [interval, end (0, 1), axis]."""

    def __init__(self, pieces, cuts):
        """cuts: for each piece the places u of its nodes, from 0 to 1."""
        self.pieces, self.cuts = pieces, cuts
        lengths, ends = [], []
        for piece, u in zip(pieces, cuts):
            half = np.diff(u) / 2.0
            inner = (u[:-1] + half)[:, None] + half[:, None] * GAUSS_X
            rate = np.linalg.norm(piece.derivative(1, inner.ravel()), axis=1).reshape(inner.shape)
            lengths.append((rate * GAUSS_W).sum(1) * half)
            at_nodes = np.stack(piece.along(u)[:4])
            ends.append(np.stack([at_nodes[:, :-1], at_nodes[:, 1:]], axis=2))
        self.length = np.concatenate(lengths)
        self.q, self.q1, self.q2, self.q3 = np.concatenate(ends, axis=1)

    @classmethod
    def even(cls, pieces, intervals):
        """About so many intervals, each piece cut evenly in u: half of them spread by length, half of them by piece."""
        size = np.array([piece.polygon_length for piece in pieces])
        counts = np.ceil(intervals * (0.5 * size / size.sum() + 0.5 / len(pieces))).astype(int)
        return cls(pieces, [np.linspace(0.0, 1.0, max(4, n) + 1) for n in counts])

    def resampled(self, weight):
        """The same run with other nodes: an interval of this grid gets about `weight` of them."""
        first, cuts = 0, []
        for u in self.cuts:
            last = first + len(u) - 1
            level = np.concatenate([[0.0], np.cumsum(weight[first:last])])
            count = max(1, int(np.ceil(level[-1])))
            cuts.append(np.interp(np.linspace(0.0, level[-1], count + 1), level, u))
            cuts[-1][0], cuts[-1][-1] = 0.0, 1.0
            first = last
        return PathGrid(self.pieces, cuts)

    @property
    def places(self):
        """Distance of each node from the start [mm]: one more than intervals."""
        return np.concatenate([[0.0], np.cumsum(self.length)])
