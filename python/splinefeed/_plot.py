# SPDX-License-Identifier: MIT
"""Pictures of a motion, by matplotlib."""
from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from matplotlib.figure import Figure as FigureType

    from ._motion import Motion

_STRIPS = (("position", "mm", None), ("velocity", "mm/s", "max_velocity_mm_s"),
           ("acceleration", "mm/s²", "max_acceleration_mm_s2"), ("jerk", "mm/s³", "max_jerk_mm_s3"))
_MOST_SAMPLES = 20_000


def figure_of(motion: Motion, period: float | None) -> FigureType:
    """A figure: the path of the first two axes at the left, all axes over time at the right."""
    from matplotlib.collections import LineCollection  # pylint: disable=import-outside-toplevel
    from matplotlib.figure import Figure  # pylint: disable=import-outside-toplevel
    samples = motion.sample(period or max(motion.time / _MOST_SAMPLES, 1e-3))
    figure = Figure(figsize=(11, 6), layout="constrained")
    grid = figure.add_gridspec(len(_STRIPS), 2)
    path = figure.add_subplot(grid[:, 0])
    points = samples.position[:, [0, min(1, samples.position.shape[1] - 1)]]
    line = LineCollection(np.stack([points[:-1], points[1:]], axis=1), array=np.linalg.norm(samples.velocity[:-1], axis=1))
    path.add_collection(line)
    path.autoscale()
    path.set_aspect("equal", "datalim")
    path.set(xlabel=f"{motion.machine.axes[0]} [mm]", ylabel=f"{motion.machine.axes[min(1, len(motion.machine.axes) - 1)]} [mm]",
             title=f"{motion.time:.4g} s")
    figure.colorbar(line, ax=path, label="speed [mm/s]", location="bottom")
    limits: Mapping[str, object] = motion.machine.limits
    for row, (name, unit, key) in enumerate(_STRIPS):
        strip = figure.add_subplot(grid[row, 1])
        for k, axis in enumerate(motion.machine.axes):
            drawn, = strip.plot(samples.time, getattr(samples, name)[:, k], label=axis, linewidth=1)
            bound = np.asarray(limits[key])[k] if key else np.nan
            if np.isfinite(bound):
                for side in (-bound, bound):
                    strip.axhline(side, color=drawn.get_color(), linewidth=0.7, linestyle=":")
        strip.set_ylabel(f"{name}\n[{unit}]")
        if row == 0:
            strip.legend(loc="upper right", ncols=len(motion.machine.axes))
    strip.set_xlabel("time [s]")
    return figure
