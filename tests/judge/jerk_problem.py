# SPDX-License-Identifier: MIT
"""JerkProblem: a run under limits of velocity, acceleration and jerk, as a minimisation over the coefficients of a SpeedSpline.

An axis's jerk is v (q' b''/2 + 3/2 q'' b' + q''' b) with b = v^2, so a limit J asks |q' u + 3 q'' a + q''' b| <= J / sqrt(b). It is
asked for in the middle of each interval: the error falls with the square of the intervals' length.

Minimised is the time less mu times the sum of the logarithms of all slacks, while mu falls. Each step is Newton's, without what of the
curvature could be negative (that of J / sqrt(b)), and is shortened until the sum falls: every iterate keeps all limits."""
import numpy as np
from scipy import sparse
from scipy.linalg import LinAlgError, solveh_banded

from speed_spline import SpeedSpline

BANDS = 4  # y[i] meets y[i + 2] at most, and next to rest one further
STEPS = 400  # of Newton; 60 to 100 are needed
MU_MOST, MU_LEAST, MU_FALL = 0.1, 3e-6, 0.2  # of the time: what is left of the barrier costs less than 1e-4 of it
DECREMENT = 0.1  # of mu: where one step promises less the next mu is taken


class JerkProblem:
    """Limits as rows over the coefficients of the spline: cap - b, high - row, row - low, J / sqrt(b) -+ row."""

    def __init__(self, grid, limits):
        self.spline = spline = SpeedSpline(grid.length)
        q, q1, q2, q3 = (np.vstack([part[1:-1].mean(1), part[0, 1:], part[-1, :1]]) for part in (grid.q, grid.q1, grid.q2, grid.q3))
        self.cap = limits.speed_sq_cap(q, q1, q2)
        self.b = sparse.vstack([spline.inner_b, spline.rest_b]).tocsr()
        a = sparse.vstack([spline.inner_a, spline.rest_a]).tocsr()
        u = sparse.vstack([spline.inner_u, spline.rest_u]).tocsr()
        low, high = limits.acceleration_range(q1)
        axes = range(q1.shape[1])
        self.acceleration = sparse.vstack([sparse.diags(q2[:, k]) @ self.b + sparse.diags(q1[:, k]) @ a for k in axes]).tocsr()
        self.low, self.high = low.T.ravel(), high.T.ravel()
        # At the places at rest the same jerk along the path, by the direction there.
        rest = np.vstack([grid.q1[0, :1], grid.q1[-1, 1:]])
        limited = [k for k in axes if np.isfinite(limits.jerk[k])]
        rows, b_rows, most = [], [], []
        for k in limited:
            rows += [sparse.diags(q3[:, k]) @ self.b + sparse.diags(3.0 * q2[:, k]) @ a + sparse.diags(q1[:, k]) @ u,
                     sparse.diags(rest[:, k]) @ spline.rest_u]
            b_rows += [self.b, spline.rest_b]
            most += [np.full(len(q1) + 2, limits.jerk[k])]
        self.jerk, self.jerk_b, self.most = sparse.vstack(rows).tocsr(), sparse.vstack(b_rows).tocsr(), np.concatenate(most)

    def weigh(self, share):
        """share: how much the barriers of each interval count."""
        share = np.concatenate([share[1:-1], share[[0, -1]]])
        axes = len(self.high) // len(share)
        jerk_axes = len(self.most) // (len(share) + 2)
        self.cap_weight, self.acceleration_weight = share, np.tile(share, axes)
        self.jerk_weight = np.tile(np.concatenate([share, share[-2:]]), jerk_axes)

    def slacks(self, y):
        b = self.b @ y
        row = self.acceleration @ y
        bound = self.most / np.sqrt(np.maximum(self.jerk_b @ y, 1e-300))
        jerk = self.jerk @ y
        return self.cap - b, self.high - row, row - self.low, bound - jerk, bound + jerk

    def merit(self, y, mu):
        if (self.spline.time_b @ y).min() <= 0.0 or (self.b @ y).min() <= 0.0:
            return np.inf
        slacks = self.slacks(y)
        if min(s.min() for s in slacks) <= 0.0:
            return np.inf
        weights = (self.cap_weight, self.acceleration_weight, self.acceleration_weight, self.jerk_weight, self.jerk_weight)
        return self.spline.seconds(y) - mu * sum((w * np.log(s)).sum() for w, s in zip(weights, slacks))

    def newton(self, y, mu):
        """Gradient of the merit, and the step."""
        spline = self.spline
        b = spline.time_b @ y
        gradient = spline.time_b.T @ (-0.5 * spline.time_weight * b**-1.5)
        hessian = spline.time_b.T @ sparse.diags(0.75 * spline.time_weight * b**-2.5) @ spline.time_b
        cap, over, under, ahead, back = self.slacks(y)
        gradient = gradient + mu * (self.b.T @ (self.cap_weight / cap))
        hessian = hessian + self.b.T @ sparse.diags(mu * self.cap_weight / cap**2) @ self.b
        w = mu * self.acceleration_weight
        gradient += self.acceleration.T @ (w / over - w / under)
        hessian = hessian + self.acceleration.T @ sparse.diags(w / over**2 + w / under**2) @ self.acceleration
        w = mu * self.jerk_weight
        fall = 0.5 * self.most * (self.jerk_b @ y) ** -1.5
        gradient += self.jerk_b.T @ (fall * (w / ahead + w / back)) + self.jerk.T @ (w / ahead - w / back)
        both, apart = w / ahead**2 + w / back**2, w / ahead**2 - w / back**2
        cross = self.jerk_b.T @ sparse.diags(fall * apart) @ self.jerk
        hessian = hessian + self.jerk_b.T @ sparse.diags(fall**2 * both) @ self.jerk_b + cross + cross.T
        hessian = hessian + self.jerk.T @ sparse.diags(both) @ self.jerk
        scale = 1.0 / np.sqrt(hessian.diagonal())
        scaled = (sparse.diags(scale) @ hessian @ sparse.diags(scale)).tocsr()
        bands = np.zeros((BANDS, len(y)))
        for k in range(BANDS):
            diagonal = scaled.diagonal(k)
            bands[k, :len(diagonal)] = diagonal
        bands[0] += 1e-13
        return gradient, -scale * solveh_banded(bands, scale * gradient, lower=True)

    def slowed(self, y):
        """y, made slower until it keeps all limits."""
        while not np.isfinite(self.merit(y, 1.0)):
            y = 0.7 * y
            if y.max() < 1e-30:
                raise ValueError("no motion keeps these limits")
        return y

    def centred(self, y, mu):
        """Where the merit is least, from y on."""
        merit = self.merit(y, mu)
        for _ in range(STEPS):
            try:
                gradient, step = self.newton(y, mu)
            except LinAlgError:
                return y
            slope, size = float(gradient @ step), 1.0
            while not self.merit(y + size * step, mu) <= merit + 1e-4 * size * slope:
                size *= 0.5
                if size < 1e-10:
                    return y
            y = y + size * step
            merit = self.merit(y, mu)
            if -slope < DECREMENT * mu:
                return y
        raise ValueError("the least time is not found")

    def solve(self, y):
        """The coefficients of a fastest motion. y: of any motion, positive; only its shape matters."""
        self.weigh(np.full(len(self.spline.lengths), 1.0 / len(self.spline.lengths)))
        y = self.slowed(y)
        share = self.spline.interval_seconds(y) / self.spline.seconds(y)
        self.weigh(0.5 * share + 0.5 / len(share))
        mu = MU_MOST
        while mu > MU_LEAST:
            y = self.centred(y, mu * self.spline.seconds(y))
            mu *= MU_FALL
        return y
