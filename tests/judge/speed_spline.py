# SPDX-License-Identifier: MIT
"""SpeedSpline: b = v^2 along a run from rest to rest, as a spline of the length whose second derivative is constant in each
interval. Everything that a limit asks of it is linear in its coefficients y.

In the first interval b grows with s^(4/3), and in the last one it falls so: there the jerk along the path is constant."""
import numpy as np
from scipy import sparse

GAUSS_X, GAUSS_W = np.polynomial.legendre.leggauss(3)


class SpeedSpline:
    """Rows over y: b, a = b'/2 (the acceleration along the path) and u = b''/2, in the middle of each inner interval and at the inner
    end of the two intervals at rest."""

    def __init__(self, lengths):
        """lengths: of the intervals [mm], 5 at least."""
        self.lengths = lengths
        node = np.cumsum(lengths[:-1])
        # of the coefficients: b is about y[i] here
        self.places = np.concatenate([node[:1], 0.5 * (node[1:-2] + node[2:-1]), node[-1:]])
        first, inner, last = lengths[0], lengths[1:-1], lengths[-1]
        m = len(inner)
        # B-spline coefficients c of the inner intervals. At node i b is on the chord of c[i] and c[i + 1], and b' is its slope.
        before, after = np.concatenate([[0.0], inner]), np.concatenate([inner, [0.0]])
        node = np.arange(m + 1)
        at = (np.concatenate([node, node]), np.concatenate([node, node + 1]))
        both = before + after
        value = sparse.csr_matrix((np.concatenate([after / both, before / both]), at), shape=(m + 1, m + 2))
        slope = sparse.csr_matrix((np.concatenate([-1.0 / both, 1.0 / both]), at), shape=(m + 1, m + 2))
        second = sparse.diags(1.0 / inner) @ (slope[1:] - slope[:-1])
        # Next to rest b' = 4/3 b / s, and so the second coefficient is a multiple of the first: y leaves it out.
        select = sparse.lil_matrix((m + 2, m))
        select[0, 0], select[m + 1, m - 1] = 1.0, 1.0
        select[1, 0], select[m, m - 1] = 1.0 + 2.0 / 3.0 * inner[0] / first, 1.0 + 2.0 / 3.0 * inner[-1] / last
        for i in range(2, m):
            select[i, i - 1] = 1.0
        select = select.tocsr()
        value, slope, second = value @ select, slope @ select, second @ select
        ends = sparse.identity(m, format="csr")[[0, m - 1]]
        rest_u = 2.0 / 9.0
        half = sparse.diags(inner / 2.0)
        self.inner_b = value[:-1] + 2.0 * half @ slope[:-1] + half @ half @ second
        self.inner_a = slope[:-1] + half @ second
        self.inner_u = second
        # The two intervals at rest: at their ends that are not at rest
        self.rest_b = ends
        self.rest_a = sparse.diags([2.0 / 3.0 / first, -2.0 / 3.0 / last]) @ ends
        self.rest_u = sparse.diags([rest_u / first**2, rest_u / last**2]) @ ends
        # Time: 3 s / v next to rest (b = c s^(4/3)), and Gauss' sum over 1 / v within
        x = 0.5 + 0.5 * GAUSS_X
        parts = [value[:-1] + sparse.diags(2.0 * t * inner) @ slope[:-1] + sparse.diags((t * inner) ** 2) @ second for t in x]
        self.time_b = sparse.vstack([ends, *parts]).tocsr()
        self.time_weight = np.concatenate([[3.0 * first, 3.0 * last], *(w / 2.0 * inner for w in GAUSS_W)])

    def about(self, y):
        """b at the places."""
        return np.concatenate([(self.rest_b @ y)[:1], (self.inner_b @ y)[1:-1], (self.rest_b @ y)[1:]])

    def seconds(self, y):
        return float((self.time_weight / np.sqrt(self.time_b @ y)).sum())

    def interval_seconds(self, y):
        """The time in each interval."""
        parts = self.time_weight / np.sqrt(self.time_b @ y)
        inner = parts[2:].reshape(len(GAUSS_W), -1).sum(0)
        return np.concatenate([[parts[0]], inner, [parts[1]]])
