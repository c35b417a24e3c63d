# SPDX-License-Identifier: MIT
"""Arrays of callers as the planner takes them: whatever a function takes as an array, checked() has seen."""
from __future__ import annotations

import numpy as np
import numpy.typing as npt

Numbers = npt.NDArray[np.float64]
Bytes = npt.NDArray[np.uint8]
AnyArray = npt.NDArray[np.generic]

#: Kinds of dtypes that are no numbers.
_NO_NUMBERS = {"b": "True and False", "c": "complex numbers", "O": "objects", "S": "bytes", "U": "texts", "M": "dates", "m": "durations",
               "V": "records"}
_LARGEST_INTEGER = 2**53  # up to which a double holds each


def checked(value: object, name: str) -> AnyArray:
    """An array of whatever it holds. Raises ValueError for what numpy would lose: a mask, rows of different lengths."""
    parts = value if isinstance(value, (list, tuple)) else (value,)
    if any(isinstance(part, np.ma.MaskedArray) and np.any(part.mask) for part in parts):
        raise ValueError(f"{name} has masked values; fill them, or leave them out")
    try:
        return np.asarray(value)
    except ValueError:
        raise ValueError(f"{name} has rows of different lengths") from None


def numbers_of(value: object, name: str, shape: str | None = None, flags: bool = False) -> Numbers:
    """A copy in doubles, one number behind the other. Raises TypeError for what are no numbers.

    Args:
        shape: what it must have, one word for each dimension: ``(n, axes)``; None: any.
        flags: True and False are 1 and 0.
    """
    given = checked(value, name)
    kind = given.dtype.kind
    if kind in _NO_NUMBERS and not (flags and kind == "b"):
        such = f" such as {given.ravel()[0]!r:.60}" if kind == "O" and given.size else ""
        raise TypeError(f"{name} must hold numbers, not {_NO_NUMBERS[kind]}{such}")
    if shape is not None and given.ndim != len(shape.strip("(),").split(",")):
        raise ValueError(f"{name} must be an array of the shape {shape}, not {given.shape}")
    out = np.array(given, dtype=np.float64, order="C")
    exact = np.abs(out) <= _LARGEST_INTEGER if kind in "iu" else (out == given) | np.isnan(out)
    if not exact.all():
        raise ValueError(f"{name} has numbers with more digits than a double has: {given[~exact].flat[0]}")
    return out


def column_of(value: object, name: str, rows: int, flags: bool = False) -> Numbers | None:
    """One number for each row: of one number, or of a column, in which None is nan. None: no column."""
    if value is None:
        return None
    if isinstance(value, np.ndarray) and value.dtype.kind == "O":
        value = checked(value, name).tolist()
    if isinstance(value, (list, tuple)):
        value = [np.nan if one is None else one for one in value]
    out = numbers_of(value, name, flags=flags)
    return np.full(rows, out) if out.ndim == 0 else out
