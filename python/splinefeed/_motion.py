# SPDX-License-Identifier: MIT
"""Planning, and the motion that comes of it."""
from __future__ import annotations

import functools
import json
import math
import os
from typing import Any, NamedTuple

import numpy as np

from . import _native
from ._errors import warn_caller
from ._machine import Machine, machine_or_default
from ._options import column_of, is_file, json_of, options_of, points_of


class Samples(NamedTuple):
    """A motion at n times. Arrays are (n, axes), in the units of the axes: mm or, of a rotary axis, degrees."""

    time: np.ndarray  #: (n,) [s]
    position: np.ndarray  #: [mm]
    velocity: np.ndarray  #: [mm/s]
    acceleration: np.ndarray  #: [mm/s^2]
    jerk: np.ndarray  #: [mm/s^3]


#: What is kept of a segment beside its motion.
_HEAD = np.dtype([("waypoint", "u4"), ("row", "u4"), ("limit", "u1"), ("", "V3")])


def segment_dtype(axes: int) -> np.dtype:
    """The structured type of feed segments."""
    return np.dtype([("index", "u8"), ("duration_ticks", "u4"), ("waypoint", "u4"),
                     *((name, "i8", (axes,)) for name in ("start", "end", "start_velocity", "end_velocity"))])


class Motion:
    """A planned motion. plan(), plan_gcode() and plan_elements() make it."""

    def __init__(self, native: _native.Motion, machine: Machine) -> None:
        self._native = native
        self._machine = machine
        warn_caller(self.notes)

    @property
    def machine(self) -> Machine:
        """The machine that it was planned for."""
        return self._machine

    @property
    def time(self) -> float:
        """Its duration [s]."""
        return self._native.time

    @functools.cached_property
    def summary(self) -> dict[str, Any]:
        """What ``splinefeed plan --summary json`` prints, by the same names (docs/reference/command.md)."""
        return json.loads(self._native.summary)

    @property
    def stopped(self) -> str:
        """Why it ends before the program, one sentence; empty: it does not."""
        return self._native.stopped

    @property
    def notes(self) -> list[str]:
        """What else one should know, sentences. They are warnings, too."""
        return self._native.notes

    @functools.cached_property
    def segments(self) -> np.ndarray:
        """The feed segments, a structured array (n,): cubics in time, in integers.

        ``index``, ``duration_ticks`` (1/8 us), ``waypoint`` (that it leads to, from 0); and for each axis ``start``, ``end`` (units
        of 1/(3 * 2^30) count), ``start_velocity`` and ``end_velocity`` (units a duration). All take equally long.
        """
        out = self._native.segments.view(segment_dtype(len(self._machine.axes)))[:, 0]
        out.flags.writeable = False
        return out

    @functools.cached_property
    def begins(self) -> np.ndarray:
        """When each segment begins, and the last one ends: (n + 1,) [s]."""
        return np.arange(len(self.lines) + 1) * self._native.segment_ticks / float(_native.ticks_per_s)

    @property
    def lines(self) -> np.ndarray:
        """Where each segment comes from, (n,), from 1: the line of G-code, else the waypoint or element; 0: unknown."""
        return self._native.heads.view(_HEAD)[:, 0]["row"]

    @functools.cached_property
    def binding(self) -> np.ndarray:
        """The limit that each segment uses most, (n,) of texts: ``acceleration of x``; ``no limit`` where all are used below 95 %."""
        return np.array(self._native.limit_names)[self._native.heads.view(_HEAD)[:, 0]["limit"]]

    def sample(self, times: float | Any) -> Samples:
        """Position, velocity, acceleration and jerk, from the polynomials of the segments.

        Args:
            times: a period [s], for samples from 0 to the end; or an array of times [s], in any order. Behind its end the machine
                stands. Where two segments meet the jerk is that of the second.
        Cost: about 50 ns a time for three axes.
        """
        if np.ndim(times) == 0:
            if not times > 0.0:
                raise ValueError(f"the period must be above 0 s, not {times}")
            times = np.arange(math.ceil(round(self.time / times, 9)) + 1) * times
        times = np.ascontiguousarray(times, dtype=np.float64)
        if times.ndim != 1:
            raise ValueError(f"times must be an array of the shape (n,), not {times.shape}")
        return Samples(times, *self._native.sample(times))

    def report(self, path: str | os.PathLike[str]) -> None:
        """Writes the page of ``--report``, for a browser. It is planned once more for this. Raises OutputError."""
        self._native.report(os.fspath(path))

    def plot(self, period: float | None = None) -> Any:
        """A figure of matplotlib: the path, coloured by speed, and each axis against its limits. Needs matplotlib."""
        from ._plot import figure_of  # pylint: disable=import-outside-toplevel
        return figure_of(self, period)

    def __repr__(self) -> str:
        return f"<splinefeed.Motion: {self.time:.6g} s, {len(self.lines)} segments of {', '.join(self._machine.axes)}>"


def plan(points: Any, machine: Machine | None = None, curve: str = "g2", *, feed_mm_s: Any = None, max_feed_mm_s: Any = None,
         corner: Any = None, tolerance_mm: Any = None, closed: bool = False, smooth: bool = False, scalar: str = "fixed",
         window: int = 1024, jerk_scalar: str = "double", advice: bool = False, **options: Any) -> Motion:
    """Plans the motion along a curve through points.

    Args:
        points: (n, axes) [mm]. Fewer columns than the machine has axes are the first ones; the others stand at 0.
        machine: None: Machine.default().
        curve: one of curve_names().
        feed_mm_s, max_feed_mm_s: wanted speed, and its limit for every override, on the way to each point: a number, or (n,) with
            nan where the machine's counts.
        corner: (n,): True, a stop; False, none; None or nan, as the corner angle says.
        tolerance_mm: how far the path may be from the lines of ``curve="polyline"``: a number, or (n,).
        closed: return to the first point, smoothly.
        smooth, degree, parameterization, knots, tension, factor, beta1, beta2, lambda_, mu, curvature_sign, corner_angle,
            start_tangent, end_tangent: as the command's options (``splinefeed plan --help``).
        scalar: ``fixed``, ``float`` or ``double``: number type of the plan.
        window: look-ahead of the feed plan in cells.
        jerk_scalar: ``double`` or ``float``.
        advice: also find what would help: the summary's ``what_would_help``. Costs a plan for each limit that binds.

    Returns:
        The motion: bit for bit that of ``splinefeed plan`` with these points and options.
    Raises:
        InputError, UsageError.
    """
    machine = machine_or_default(machine)
    points = points_of(points)
    rows = len(points)
    per_point = tolerance_mm is not None and np.ndim(tolerance_mm) > 0
    given = options_of(curve=curve, closed=closed, smooth=smooth, scalar=scalar, window=window, jerk_scalar=jerk_scalar,
                       advice=advice, tolerance_mm=None if per_point else tolerance_mm, **options)
    native = _native.plan_points(machine._native, points, column_of(feed_mm_s, rows), column_of(max_feed_mm_s, rows),
                                 column_of(tolerance_mm, rows) if per_point else None, column_of(corner, rows), given)
    return Motion(native, machine)


def plan_gcode(program: str | os.PathLike[str], machine: Machine | None = None, *, tolerance_mm: float | None = None,
               dialect: str | None = None, ignore: Any = None, tools: str | os.PathLike[str] | None = None,
               subprograms: str | None = None, repeat: int | None = None, position: Any = None, zero: Any = None,
               state: str | os.PathLike[str] | None = None, increments: bool = False, block_delete: bool = False,
               optional_stop: bool = False, scalar: str = "fixed", window: int = 1024, jerk_scalar: str = "double",
               advice: bool = False) -> Motion:
    """Plans a program in G-code.

    Args:
        program: a file (a path, or a text of one line), or the program itself (a text of several lines).
        tolerance_mm: of G64 without P, and of a program without G64.
        dialect: ``linuxcnc``, ``grbl``, ``marlin``, ``fanuc``, ``klipper`` or ``auto``.
        ignore: words and lines that are left out, a sequence or a text with commas.
        subprograms: folders, separated by colons, where subprograms in files of their own are looked for, behind the
            folder of the program if that is a file.
        repeat: how often a program runs that M99 ends.
        tools: file of tools. state: file of offsets and of where the machine stands; it is not changed.
        position: (axes,) [mm]: where the machine stands. zero: (axes,) [mm]: where the program's zero (G54) lies on it.
        increments, block_delete, optional_stop, scalar, window, jerk_scalar, advice: as plan() and the command's options.
    """
    return _plan_program("gcode", program, machine,
                         options_of(tolerance_mm=tolerance_mm, dialect=dialect, ignore=ignore, tools=tools,
                                    subprograms=subprograms, repeat=repeat, position=position, zero=zero, state=state,
                                    increments=increments, block_delete=block_delete, optional_stop=optional_stop,
                                    scalar=scalar, window=window, jerk_scalar=jerk_scalar, advice=advice))


def plan_elements(elements: Any, machine: Machine | None = None, *, tolerance_mm: float | None = None, smooth: bool = False,
                  scalar: str = "fixed", window: int = 1024, jerk_scalar: str = "double", advice: bool = False) -> Motion:
    """Plans lines, arcs and splines within their tolerances, or a curve as it is.

    Args:
        elements: a list of elements, the document of a file of elements or of a curve as a dict, its JSON, or a file (a path, or a
            text of one line that ends with .json). docs/reference/files.md has both.
        tolerance_mm: of elements that state none.
        smooth: join the segments of a curve with G2.
    """
    if isinstance(elements, (list, tuple)):
        elements = {"elements": list(elements)}
    if isinstance(elements, dict):
        elements = json_of(elements)
    elif isinstance(elements, str) and elements.lstrip().startswith("{"):
        elements += "\n"
    return _plan_program("json", elements, machine,
                         options_of(tolerance_mm=tolerance_mm, smooth=smooth, scalar=scalar, window=window,
                                    jerk_scalar=jerk_scalar, advice=advice))


def _plan_program(kind: str, program: Any, machine: Machine | None, options: dict[str, str | bool]) -> Motion:
    machine = machine_or_default(machine)
    text = not is_file(program)
    native = _native.plan_program(machine._native, kind, program if text else os.fspath(program), text, options)
    return Motion(native, machine)
