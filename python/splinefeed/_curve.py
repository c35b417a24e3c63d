# SPDX-License-Identifier: MIT
"""Curves: chains of Bezier segments."""
from __future__ import annotations

import functools
import os
from collections.abc import Mapping

import numpy as np
import numpy.typing as npt

from . import _native
from ._arrays import Numbers, numbers_of
from ._errors import warn_caller
from ._options import bytes_of, is_file, json_of, Option, options_of
from ._state import Arrays, Facts, Picklable

#: Nodes and weights of Gauss-Legendre for the arc length: exact to 1e-12 of a span that is smooth.
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(16)  # type: ignore[no-untyped-call]


def curve_names() -> list[str]:
    """The names of all methods that join points."""
    return list(_native.curve_names)


class Curve(Picklable):
    """A curve as Bezier segments. Its parameter u is 0 to len(curve): the whole part is the segment, the rest its own parameter.

    Args:
        points: (n, axes) [mm].
        curve: one of curve_names().
        closed: return to the first point, smoothly.
        scalar: ``fixed``, ``float`` or ``double``: number type of the computation.
        options: as in plan().
    """

    _kind = "curve"

    def __init__(self, points: npt.ArrayLike, curve: str = "g2", *, closed: bool = False, smooth: bool = False, scalar: str = "fixed",
                 **options: Option) -> None:
        given = options_of(curve=curve, closed=closed, smooth=smooth, scalar=scalar, **options)
        self._take(*_native.curve_of_points(numbers_of(points, "points", "(n, axes)"), given))

    @classmethod
    def from_json(cls, curve: str | os.PathLike[str] | Mapping[str, object], *, smooth: bool = False, scalar: str = "fixed") -> Curve:
        """A curve file: its segments, or the description of a curve. A path, or its document as a dict."""
        out = cls.__new__(cls)
        given = json_of(dict(curve)) if isinstance(curve, Mapping) else curve
        is_text = not is_file(given)
        out._take(*_native.curve_of_description(bytes_of(given), is_text, options_of(smooth=smooth, scalar=scalar)))
        return out

    def _take(self, points: Numbers, degrees: npt.NDArray[np.int64], notes: list[str]) -> None:
        ends = np.cumsum(degrees + 1)
        self._bezier = [points[end - degree - 1:end] for end, degree in zip(ends, degrees)]
        warn_caller(notes)

    def _state(self) -> tuple[Facts, Arrays]:
        return {"degrees": [len(one) - 1 for one in self._bezier]}, {"points": np.concatenate(self._bezier)}

    def _restore(self, facts: Facts, arrays: Arrays) -> None:
        points, degrees = arrays["points"].astype(np.float64), np.array(facts["degrees"], dtype=np.int64)
        if points.ndim != 2 or degrees.ndim != 1 or not len(degrees) or degrees.min() < 0 or np.sum(degrees + 1) != len(points):
            raise ValueError("its degrees are not those of its points")
        self._take(points, degrees, [])

    @property
    def bezier(self) -> list[Numbers]:
        """The control points of each segment, (degree + 1, axes) [mm]."""
        return self._bezier

    @property
    def axes(self) -> int:
        """Number of coordinates."""
        return self._bezier[0].shape[1]

    def __len__(self) -> int:
        return len(self._bezier)

    def evaluate(self, u: npt.ArrayLike) -> Numbers:
        """Points at the parameters u: the shape of u with (axes,) behind it [mm]."""
        return self.derivative(u, 0)

    def derivative(self, u: npt.ArrayLike, order: int = 1) -> Numbers:
        """Derivatives by u: the shape of u with (axes,) behind it. At a joint they are those of the segment behind it."""
        if order < 0:
            raise ValueError(f"the order must not be below 0, and is {order}")
        places = numbers_of(u, "u")
        if not np.all((places >= 0.0) & (places <= len(self))):
            raise ValueError(f"u must lie within 0 and {len(self)}")
        flat = places.ravel()
        segment = np.minimum(flat.astype(np.int64), len(self) - 1)
        out = np.zeros((len(flat), self.axes))
        for degree, (numbers, control) in self._by_degree.items():
            place = np.searchsorted(numbers, segment)
            mine = np.flatnonzero((place < len(numbers)) & (numbers[np.minimum(place, len(numbers) - 1)] == segment))
            if order <= degree:
                out[mine] = _value(control[place[mine]], flat[mine] - segment[mine], order)
        return out.reshape(*places.shape, self.axes)

    @functools.cached_property
    def _by_degree(self) -> dict[int, tuple[npt.NDArray[np.intp], Numbers]]:
        """For each degree the numbers of its segments, and their control points (n, degree + 1, axes)."""
        degrees = np.array([len(one) - 1 for one in self._bezier])
        return {int(degree): (np.flatnonzero(degrees == degree), np.array([self._bezier[i] for i in np.flatnonzero(degrees == degree)]))
                for degree in np.unique(degrees)}

    def arc_length(self, u0: float = 0.0, u1: float | None = None) -> float:
        """Length from u0 to u1, by default of all [mm]. Each segment is halved until two estimates differ by less than 1e-12 of it."""
        u1 = float(len(self)) if u1 is None else float(u1)
        edges = np.concatenate([[u0], np.arange(np.floor(u0) + 1.0, np.ceil(u1)), [u1]])
        low, high = edges[:-1], edges[1:]
        total, whole = 0.0, self._lengths(low, high)
        for _ in range(40):
            middle = 0.5 * (low + high)
            left, right = self._lengths(low, middle), self._lengths(middle, high)
            open_ = np.abs(left + right - whole) > 1e-12 * np.maximum(np.abs(whole), 1e-9)
            total += float(np.sum((left + right)[~open_]))
            if not open_.any():
                return total
            low, high = np.concatenate([low[open_], middle[open_]]), np.concatenate([middle[open_], high[open_]])
            whole = np.concatenate([left[open_], right[open_]])
        return total + float(np.sum(whole))

    def _lengths(self, low: Numbers, high: Numbers) -> Numbers:
        """Lengths of spans, each within a segment."""
        half = 0.5 * (high - low)
        speed = np.linalg.norm(self.derivative(0.5 * (low + high)[:, None] + half[:, None] * _NODES), axis=-1)
        out: Numbers = half * (speed @ _WEIGHTS)
        return out

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Curve):
            return NotImplemented
        return len(self) == len(other) and all(np.array_equal(mine, theirs) for mine, theirs in zip(self._bezier, other._bezier))

    def __hash__(self) -> int:
        return hash((len(self), self.axes))

    def __repr__(self) -> str:
        return f"<splinefeed.Curve: {len(self)} segments of {self.axes} axes>"


def _value(control: Numbers, t: Numbers, order: int) -> Numbers:
    """Derivatives of n Bezier segments (n, degree + 1, axes), each at its own t (n,), by de Casteljau."""
    for _ in range(order):
        control = (control.shape[1] - 1.0) * (control[:, 1:] - control[:, :-1])
    t = t[:, None, None]
    while control.shape[1] > 1:
        control = control[:, :-1] + t * (control[:, 1:] - control[:, :-1])
    return control[:, 0]
