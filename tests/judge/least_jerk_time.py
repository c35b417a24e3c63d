# SPDX-License-Identifier: MIT
"""The least time in which a machine follows a run from rest to rest, its accelerations and jerks limited: that of a JerkProblem on
a grid whose nodes are as close as the motion is slow there, which a coarser grid has told."""
import numpy as np

from jerk_problem import JerkProblem
from least_time import least_time
from path_grid import PathGrid

REST = 6.0 ** (4.0 / 3.0) / 4.0  # from rest with constant jerk j: b = REST j^(2/3) s^(4/3)


def rest_factors(grid, limits):
    """b / s^(4/3) next to the start and next to the end, with all the jerk that the direction there allows."""
    ends = np.vstack([grid.q1[0, 0], grid.q1[-1, 1]])
    jerk = (limits.jerk / np.maximum(np.abs(ends), 1e-12)).min(1)
    return REST * np.where(np.isfinite(jerk), jerk, 1e9) ** (2.0 / 3.0)


def graded(grid, seconds, intervals, share):
    """The grid with so many intervals, spread by this share of the time in each and the rest by length."""
    return grid.resampled(intervals * (share * seconds / seconds.sum() + (1.0 - share) * grid.length / grid.length.sum()))


def least_jerk_time(pieces, limits, intervals):
    """The time [s] of the run of these pieces on about so many intervals."""
    fine = PathGrid.even(pieces, 2 * intervals)
    _, b = least_time(fine, limits)
    start, end = rest_factors(fine, limits)
    s = fine.places
    middle = 0.5 * (s[1:] + s[:-1])
    b = np.minimum(0.5 * (b[1:] + b[:-1]), np.minimum(start * middle ** (4.0 / 3.0), end * (s[-1] - middle) ** (4.0 / 3.0)))
    grid = graded(fine, fine.length / np.sqrt(b), max(intervals // 2, 100), 0.6)
    problem = JerkProblem(grid, limits)
    at = problem.spline.places
    y = problem.solve(1.0 / (1.0 / (start * at ** (4.0 / 3.0)) + 1.0 / (end * (s[-1] - at) ** (4.0 / 3.0)) + 1.0 / limits.feed**2))

    finer = JerkProblem(graded(grid, problem.spline.interval_seconds(y), intervals, 0.9), limits)
    y = finer.solve(np.interp(finer.spline.places, at, problem.spline.about(y)))
    return finer.spline.seconds(y)
