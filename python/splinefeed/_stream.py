# SPDX-License-Identifier: MIT
"""Points as they come."""
from __future__ import annotations

import threading
from typing import NoReturn

import numpy as np
import numpy.typing as npt

from . import _native
from ._arrays import column_of, numbers_of
from ._machine import Machine, machine_or_default
from ._motion import Column, segment_dtype
from ._options import Option, options_of


class Stream:
    """Plans while its points come, in constant memory: the segments of ``splinefeed plan -``, bit for bit.

    Args:
        machine: None: Machine.default().
        curve: a method that streams: not one that needs all points.
        options: as in plan().

    Any thread may call any method. hold(), resume(), abort() and override() never wait.
    """

    def __init__(self, machine: Machine | None = None, curve: str = "g2", *, scalar: str = "fixed", window: int = 1024,
                 jerk_scalar: str = "double", **options: Option) -> None:
        self._machine = machine_or_default(machine)
        given = options_of(curve=curve, scalar=scalar, window=window, jerk_scalar=jerk_scalar, **options)
        self._native = _native.Stream(self._machine._native, given)
        self._dtype = segment_dtype(len(self._machine.axes))
        self._lock = threading.Lock()

    @property
    def machine(self) -> Machine:
        """The machine that it plans for."""
        return self._machine

    def push(self, points: npt.ArrayLike, *, feed_mm_s: Column = None, max_feed_mm_s: Column = None,
             corner: Column = None) -> None:
        """Adds a point (axes,) or several (n, axes) [mm]; as in plan(). Raises InputError: the points before the wrong one count."""
        given = np.atleast_2d(numbers_of(points, "points"))
        rows = len(given)
        columns = (column_of(feed_mm_s, "feed_mm_s", rows), column_of(max_feed_mm_s, "max_feed_mm_s", rows),
                   column_of(corner, "corner", rows, flags=True))
        with self._lock:
            self._native.push(given, *columns)

    def finish(self) -> None:
        """No more points come."""
        with self._lock:
            self._native.finish()

    def next(self, most: int = 1024, *, drain: bool = False) -> npt.NDArray[np.void]:
        """The next segments, at most so many, as Motion.segments has them. Fewer: `state` says why.

        Args:
            drain: also those that end at the last known point, for a machine that cannot wait. Without it segments come once the
                look-ahead is full, so that they do not depend on when points come.
        Raises:
            InputError: the curve leaves the travel; the motion has come to a stop before that.
        """
        with self._lock:
            return self._native.next(most, drain).view(self._dtype)[:, 0]

    def stand(self) -> npt.NDArray[np.void]:
        """One segment of standstill, while the motion is held and stands; else none."""
        with self._lock:
            return self._native.stand().view(self._dtype)[:, 0]

    @property
    def state(self) -> str:
        """Behind the last segment: ``moves``, ``starved`` (push points), ``held`` or ``finished``."""
        return self._native.state

    def hold(self) -> None:
        """Feed hold: the motion brakes on the path, as hard as the limits allow."""
        self._native.hold()

    def resume(self) -> None:
        """The end of a hold."""
        self._native.resume()

    def abort(self) -> None:
        """A hold behind which nothing comes."""
        self._native.abort()

    def override(self, ratio: float) -> None:
        """Factor of the wanted speed, 0 to 2. The limits of the machine still apply."""
        if not 0.0 <= ratio <= 2.0:
            raise ValueError(f"an override must lie between 0 and 2, and is {ratio}")
        self._native.override(ratio)

    def __reduce__(self) -> NoReturn:
        raise TypeError("a Stream is in the middle of its work and cannot be pickled or copied; pickle its machine and its points")

    def __repr__(self) -> str:
        return f"<splinefeed.Stream: {self.state}, of {', '.join(self._machine.axes)}>"
