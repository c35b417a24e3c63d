# SPDX-License-Identifier: MIT
"""What a pickle holds of a machine, a motion or a curve: its bits, with a version and a checksum.

    splinefeed KIND VERSION\\n | CRC-32 of the rest | length of the facts | facts in JSON | arrays, one behind the other
"""
from __future__ import annotations

import json
import math
import zlib
from collections.abc import Mapping
from typing import Any, TypeVar

import numpy as np

from ._arrays import AnyArray
from ._errors import Error, InputError

VERSION = 1
#: Their types are the same on every processor: doubles, and bytes.
_TYPES = ("<f8", "|u1")

Facts = dict[str, Any]
Arrays = Mapping[str, AnyArray]


class Picklable:
    """A class whose objects are pickled as their bits, and copied by them."""

    _kind: str

    def _state(self) -> tuple[Facts, Arrays]:
        """What it is made of: JSON, and arrays of _TYPES by their names."""
        raise NotImplementedError

    def _restore(self, facts: Facts, arrays: Arrays) -> None:
        """Becomes what _state() told."""
        raise NotImplementedError

    def __reduce__(self) -> tuple[object, ...]:
        return restored, (type(self), _packed(self._kind, *self._state()))


_One = TypeVar("_One", bound=Picklable)


def _packed(kind: str, facts: Facts, arrays: Arrays) -> bytes:
    rows = [(name, array.dtype.newbyteorder("<").str, array.shape) for name, array in arrays.items()]
    head = json.dumps({**facts, "arrays": rows}).encode()
    body = b"".join([len(head).to_bytes(8, "little"), head,
                     *(array.astype(type_, order="C", copy=False).tobytes() for array, (_, type_, _) in zip(arrays.values(), rows))])
    return b"splinefeed %s %d\n" % (kind.encode(), VERSION) + zlib.crc32(body).to_bytes(4, "little") + body


def _unpacked(body: memoryview) -> tuple[Facts, Arrays]:
    end = 8 + int.from_bytes(body[:8], "little")
    facts = json.loads(bytes(body[8:end]))
    arrays: dict[str, AnyArray] = {}
    for name, type_, shape in facts.pop("arrays"):
        if type_ not in _TYPES or min(shape, default=0) < 0:
            raise ValueError(f"no array is {type_} {shape}")
        begin, end = end, end + math.prod(shape) * np.dtype(type_).itemsize
        native = np.dtype(type_).newbyteorder("=")
        arrays[name] = np.frombuffer(body[begin:end], type_).reshape(shape).astype(native, copy=False)
    return facts, arrays


def restored(kind: type[_One], state: bytes) -> _One:
    """What was pickled. Raises InputError where the pickle is of another version, or damaged."""
    name, what = kind.__name__, kind._kind
    first, _, rest = state.partition(b"\n")
    if first != b"splinefeed %s %d" % (what.encode(), VERSION):
        made = first[:60].decode("ascii", "backslashreplace")
        raise InputError(f"pickle: it begins with '{made}'; of a {name} this version reads 'splinefeed {what} {VERSION}'")
    out = kind.__new__(kind)
    try:
        if zlib.crc32(rest[4:]) != int.from_bytes(rest[:4], "little"):
            raise ValueError("its checksum is of other bytes")
        out._restore(*_unpacked(memoryview(rest)[4:]))
    except Error:
        raise
    except (AttributeError, KeyError, OverflowError, RecursionError, TypeError, ValueError) as error:
        reason = str(error).partition("\n")[0]
        raise InputError(f"pickle: the {name} is damaged: {reason}; pickle it once more") from error
    return out
