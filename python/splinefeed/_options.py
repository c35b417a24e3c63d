# SPDX-License-Identifier: MIT
"""Arguments in the form of the command's options, and arrays in the form of its columns."""
from __future__ import annotations

import json
import numbers
import os
from typing import Any

import numpy as np


def text_of(value: Any) -> str:
    """A value as it would be typed: 3, 0.5, auto, or 1.0,0.0 for a vector."""
    if isinstance(value, str):
        return value
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, np.ndarray) and value.ndim == 0:
        value = value.item()
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        return repr(float(value))
    return ",".join(text_of(part) for part in value)


def options_of(**options: Any) -> dict[str, str | bool]:
    """Those that are not None."""
    return {name: bool(value) if isinstance(value, (bool, np.bool_)) else text_of(value)
            for name, value in options.items() if value is not None}


def points_of(points: Any) -> np.ndarray:
    """An array (n, axes) of doubles."""
    out = np.ascontiguousarray(points, dtype=np.float64)
    if out.ndim != 2:
        raise ValueError(f"points must be an array of the shape (n, axes), not {out.shape}")
    return out


def column_of(value: Any, rows: int) -> np.ndarray | None:
    """One number for each row; None and True, False become nan, 1, 0."""
    if value is None:
        return None
    if isinstance(value, np.ndarray) and value.ndim > 0:
        return np.array(value, dtype=np.float64)
    if isinstance(value, np.ndarray) or np.isscalar(value):
        return np.full(rows, float(value))
    return np.array([np.nan if one is None else float(one) for one in value])


def json_of(document: Any) -> str:
    """A text that is no name of a file. Raises ValueError for nan and infinity, which JSON does not have."""
    return json.dumps(document, allow_nan=False) + "\n"


def is_file(program: Any) -> bool:
    """Whether it names a file: a path, or a text of one line. Raises TypeError for what is neither."""
    if not isinstance(program, (str, bytes, os.PathLike)):
        raise TypeError(f"there must be a text or a path, not {program!r:.60}")
    return isinstance(program, os.PathLike) or (isinstance(program, str) and "\n" not in program)
