# SPDX-License-Identifier: MIT
"""Planning, and the motion that comes of it."""
from __future__ import annotations

import functools
import json
import math
import os
import sys
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple, TYPE_CHECKING, Union

import numpy as np
import numpy.typing as npt

from . import _native
from ._arrays import AnyArray, checked, column_of, Numbers, numbers_of
from ._errors import warn_caller
from ._machine import Machine, machine_or_default
from ._options import bytes_of, is_file, json_of, Option, options_of, Typed
from ._state import Arrays, Facts, Picklable

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: A number for all points, or one for each.
Column = Union[float, Sequence[Union[float, None]], AnyArray, None]


class Samples(NamedTuple):
    """A motion at n times. Arrays are (n, axes), in the units of the axes: mm or, of a rotary axis, degrees."""

    time: Numbers  #: (n,) [s]
    position: Numbers  #: [mm]
    velocity: Numbers  #: [mm/s]
    acceleration: Numbers  #: [mm/s^2]
    jerk: Numbers  #: [mm/s^3]

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Samples) and all(np.array_equal(mine, theirs) for mine, theirs in zip(self, other))

    def __ne__(self, other: object) -> bool:
        return not self == other

    def __repr__(self) -> str:
        return f"<splinefeed.Samples: {len(self.time)} of {self.position.shape[1]} axes>"


def segment_dtype(axes: int) -> np.dtype[np.void]:
    """The structured type of feed segments."""
    return np.dtype([("index", "u8"), ("duration_ticks", "u4"), ("waypoint", "u4"),
                     *((name, "i8", (axes,)) for name in ("start", "end", "start_velocity", "end_velocity"))])


def _record_dtype(axes: int) -> np.dtype[np.void]:
    """What is kept of a segment."""
    return np.dtype([("waypoint", "u4"), ("row", "u4"), ("limit", "u1"), ("zero", "u1", (3,)), ("end", "i8", (axes,)),
                     ("end_velocity", "i8", (axes,))])


class _Source(NamedTuple):
    """What a motion is planned of."""

    kind: str  # of the input: points, gcode, json
    columns: dict[str, Numbers]  # of points
    program: bytes  # a path or a text
    is_text: bool
    options: Typed

    def read_for(self, machine: Machine) -> _native.Input:
        """As the extension takes it."""
        if self.kind != "points":
            return _native.Input(machine._native, self.kind, self.program, self.is_text, self.options)
        column = self.columns.get
        return _native.Input(machine._native, self.columns["points"], column("feed_mm_s"), column("max_feed_mm_s"), column("tolerance_mm"),
                             column("corner"), self.options)

    def plan(self, machine: Machine) -> Motion:
        """Plans it, and warns whoever called this package."""
        out = Motion.__new__(Motion)
        out._hold(self.read_for(machine).plan(), machine, self)
        warn_caller(out.notes)
        return out


class Motion(Picklable):
    """A planned motion. plan(), plan_gcode() and plan_elements() make it.

    Motions are equal if their machines are, and all bits of their segments. They can be pickled.
    """

    _kind = "motion"

    def __init__(self) -> None:
        raise TypeError("a Motion is made by plan(), plan_gcode() or plan_elements()")

    def _hold(self, native: _native.Motion, machine: Machine, source: _Source) -> None:
        self._native = native
        self._machine = machine
        self._source = source

    def _state(self) -> tuple[Facts, Arrays]:
        kind, columns, program, is_text, options = self._source
        return {"order": sys.byteorder, "machine": self._machine._state()[0], "time": self.time, "summary": self._native.summary,
                "stopped": self.stopped, "notes": self.notes, "kind": kind, "is_text": is_text, "options": options,
                "program": program.decode("utf-8", "surrogateescape")}, {
                    **columns, "first": self._native.first, "records": self._native.records}

    def _restore(self, facts: Facts, arrays: Arrays) -> None:
        if facts["order"] != sys.byteorder:
            raise ValueError(f"its integers are {facts['order']}-endian, and this processor's are {sys.byteorder}-endian")
        machine = Machine.__new__(Machine)
        machine._restore(facts["machine"], {})
        columns = {name: array.astype(np.float64) for name, array in arrays.items() if name not in ("first", "records")}
        self._hold(_native.restore_motion(machine._native, arrays["first"].astype(np.uint8, copy=False),
                                          arrays["records"].astype(np.uint8, copy=False), facts["time"], facts["summary"],
                                          facts["stopped"], facts["notes"]),
                   machine, _Source(facts["kind"], columns, facts["program"].encode("utf-8", "surrogateescape"), facts["is_text"],
                                    facts["options"]))

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
        out: dict[str, Any] = json.loads(self._native.summary)
        return out

    @property
    def stopped(self) -> str:
        """Why it ends before the program, one sentence; empty: it does not."""
        return self._native.stopped

    @property
    def notes(self) -> list[str]:
        """What else one should know, sentences. They are warnings, too."""
        return self._native.notes

    @functools.cached_property
    def segments(self) -> npt.NDArray[np.void]:
        """The feed segments, a structured array (n,): cubics in time, in integers.

        ``index``, ``duration_ticks`` (1/8 us), ``waypoint`` (that it leads to, from 0); and for each axis ``start``, ``end`` (units
        of 1/(3 * 2^30) count), ``start_velocity`` and ``end_velocity`` (units a duration). All take equally long.
        """
        out: npt.NDArray[np.void] = self._native.segments.view(segment_dtype(len(self._machine.axes)))[:, 0]
        out.flags.writeable = False
        return out

    @functools.cached_property
    def begins(self) -> Numbers:
        """When each segment begins, and the last one ends: (n + 1,) [s]."""
        return np.arange(len(self.lines) + 1) * self._native.segment_ticks / float(_native.ticks_per_s)

    @property
    def _records(self) -> npt.NDArray[np.void]:
        return self._native.records.view(_record_dtype(len(self._machine.axes)))[:, 0]

    @property
    def lines(self) -> npt.NDArray[np.uint32]:
        """Where each segment comes from, (n,), from 1: the line of G-code, else the waypoint or element; 0: unknown."""
        return self._records["row"]

    @functools.cached_property
    def binding(self) -> npt.NDArray[np.str_]:
        """The limit that each segment uses most, (n,) of texts: ``acceleration of x``; ``no limit`` where all are used below 95 %."""
        names: npt.NDArray[np.str_] = np.array(self._native.limit_names)[self._records["limit"]]
        return names

    def sample(self, times: npt.ArrayLike) -> Samples:
        """Position, velocity, acceleration and jerk, from the polynomials of the segments.

        Args:
            times: a period [s], for samples from 0 to the end; or an array of times [s], in any order. Behind its end the machine
                stands. Where two segments meet the jerk is that of the second.
        Cost: about 50 ns a time for three axes.
        """
        at = numbers_of(times, "times")
        if at.ndim == 0:
            period = float(at)
            if not period > 0.0:
                raise ValueError(f"the period must be above 0 s, not {period}")
            at = np.arange(math.ceil(round(self.time / period, 9)) + 1) * period
        elif at.ndim != 1:
            raise ValueError(f"times must be an array of the shape (n,), not {at.shape}")
        return Samples(at, *self._native.sample(at))

    def report(self, path: str | os.PathLike[str]) -> None:
        """Writes the page of ``--report``, for a browser. It is planned once more for this. Raises OutputError."""
        self._source.read_for(self._machine).report(bytes_of(path))

    def plot(self, period: float | None = None) -> Figure:
        """A figure of matplotlib: the path, coloured by speed, and each axis against its limits. Needs matplotlib."""
        from ._plot import figure_of  # pylint: disable=import-outside-toplevel
        return figure_of(self, period)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Motion):
            return NotImplemented
        return (self._machine == other._machine and np.array_equal(self._native.first, other._native.first)
                and np.array_equal(self._native.records, other._native.records))

    def __hash__(self) -> int:
        return hash((self._machine, len(self.lines)))

    def __repr__(self) -> str:
        return f"<splinefeed.Motion: {self.time:.6g} s, {len(self.lines)} segments of {', '.join(self._machine.axes)}>"


def plan(points: npt.ArrayLike, machine: Machine | None = None, curve: str = "g2", *, feed_mm_s: Column = None,
         max_feed_mm_s: Column = None, corner: Column = None, tolerance_mm: Column = None, closed: bool = False, smooth: bool = False,
         scalar: str = "fixed", window: int = 1024, jerk_scalar: str = "double", advice: bool = False, **options: Option) -> Motion:
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
    given = numbers_of(points, "points", "(n, axes)")
    rows = len(given)
    per_point = tolerance_mm is not None and checked(tolerance_mm, "tolerance_mm").ndim > 0
    columns = {"points": given, "feed_mm_s": column_of(feed_mm_s, "feed_mm_s", rows),
               "max_feed_mm_s": column_of(max_feed_mm_s, "max_feed_mm_s", rows),
               "tolerance_mm": column_of(tolerance_mm, "tolerance_mm", rows) if per_point else None,
               "corner": column_of(corner, "corner", rows, flags=True)}
    typed = options_of(curve=curve, closed=closed, smooth=smooth, scalar=scalar, window=window, jerk_scalar=jerk_scalar,
                       advice=advice, tolerance_mm=None if per_point else tolerance_mm, **options)
    there = {name: column for name, column in columns.items() if column is not None}
    return _Source("points", there, b"", False, typed).plan(machine_or_default(machine))


def plan_gcode(program: str | bytes | os.PathLike[str], machine: Machine | None = None, *, tolerance_mm: float | None = None,
               dialect: str | None = None, ignore: str | Sequence[str] | None = None, tools: str | os.PathLike[str] | None = None,
               subprograms: str | None = None, repeat: int | None = None, position: str | Sequence[float] | AnyArray | None = None,
               zero: str | Sequence[float] | AnyArray | None = None, state: str | os.PathLike[str] | None = None, increments: bool = False, block_delete: bool = False,
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


def plan_elements(elements: str | bytes | os.PathLike[str] | Sequence[Mapping[str, object]] | Mapping[str, object],
                  machine: Machine | None = None, *, tolerance_mm: float | None = None, smooth: bool = False, scalar: str = "fixed", window: int = 1024, jerk_scalar: str = "double", advice: bool = False) -> Motion:
    """Plans lines, arcs and splines within their tolerances, or a curve as it is.

    Args:
        elements: a list of elements, the document of a file of elements or of a curve as a dict, its JSON, or a file (a path, or a
            text of one line that ends with .json). docs/reference/files.md has both.
        tolerance_mm: of elements that state none.
        smooth: join the segments of a curve with G2.
    """
    if isinstance(elements, Mapping):
        given: str | bytes | os.PathLike[str] = json_of(dict(elements))
    elif isinstance(elements, (str, bytes, os.PathLike)):
        given = f"{elements}\n" if isinstance(elements, str) and elements.lstrip().startswith("{") else elements
    elif isinstance(elements, Sequence):
        given = json_of({"elements": list(elements)})
    else:
        given = elements
    return _plan_program("json", given, machine,
                         options_of(tolerance_mm=tolerance_mm, smooth=smooth, scalar=scalar, window=window,
                                    jerk_scalar=jerk_scalar, advice=advice))


def _plan_program(kind: str, program: str | bytes | os.PathLike[str], machine: Machine | None, options: Typed) -> Motion:
    is_text = not is_file(program)
    return _Source(kind, {}, bytes_of(program), is_text, options).plan(machine_or_default(machine))
