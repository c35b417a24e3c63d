# SPDX-License-Identifier: MIT
"""Arguments in the form of the command's options."""
from __future__ import annotations

import json
import numbers
import os
from collections.abc import Iterable, Sequence
from typing import Union

import numpy as np

from ._arrays import AnyArray, checked

#: What an option may be: as it would be typed, or a number, or a sequence of these.
Option = Union[str, float, np.generic, AnyArray, "os.PathLike[str]", Sequence[Union[str, float, np.generic]], None]
#: Options as the extension takes them.
Typed = dict[str, Union[str, bool]]


def text_of(value: object, name: str) -> str:
    """A value as it would be typed: 3, 0.5, auto, or 1.0,0.0 for a vector."""
    if isinstance(value, np.ndarray):
        value = checked(value, name).tolist()
    if isinstance(value, str):
        return value
    if isinstance(value, os.PathLike):
        return os.fsdecode(value)
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        return repr(float(value))
    if not isinstance(value, Iterable) or isinstance(value, bytes):
        raise TypeError(f"{name} must be a number, a text or a sequence of them, not {value!r:.60}")
    return ",".join(text_of(part, name) for part in value)


def options_of(**options: object) -> Typed:
    """Those that are not None."""
    return {name: bool(value) if isinstance(value, (bool, np.bool_)) else text_of(value, name)
            for name, value in options.items() if value is not None}


def _json_part(value: object) -> object:
    if isinstance(value, (np.ndarray, np.generic)):
        return checked(value, "an array of the document").tolist()
    raise TypeError(f"JSON has no {value!r:.60}; there must be numbers, texts, lists and dicts")


def json_of(document: object) -> str:
    """A text that is no name of a file. Raises ValueError for nan and infinity, which JSON does not have."""
    return json.dumps(document, allow_nan=False, default=_json_part) + "\n"


def is_file(program: object) -> bool:
    """Whether it names a file: a path, or a text of one line. Raises TypeError for what is neither."""
    if not isinstance(program, (str, bytes, os.PathLike)):
        raise TypeError(f"there must be a text or a path, not {program!r:.60}")
    return isinstance(program, os.PathLike) or (isinstance(program, str) and "\n" not in program)


def bytes_of(program: str | bytes | os.PathLike[str]) -> bytes:
    """A path or a text as the extension takes it."""
    given = os.fspath(program)
    return given if isinstance(given, bytes) else given.encode("utf-8", "surrogateescape")
