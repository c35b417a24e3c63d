# SPDX-License-Identifier: MIT
"""Machines: what a machine file states."""
from __future__ import annotations

import functools
import json
import os
from collections.abc import Iterable, Mapping, Sequence
from typing import cast, TypedDict, Union

import numpy as np

from . import _native
from ._arrays import AnyArray, checked, Numbers
from ._state import Arrays, Facts, Picklable

#: A number for all axes, or one for each: a sequence, or by the names of axes.
PerAxis = Union[float, Sequence[Union[float, None]], AnyArray, Mapping[str, float], None]
Pair = Sequence[float]
#: (lowest, highest) for all axes, or a pair for each.
Travel = Union[Pair, Sequence[Union[Pair, None]], AnyArray, Mapping[str, Pair], None]
#: Any value of a machine file.
Value = Union[bool, str, float, np.generic, AnyArray, Sequence["Value"], Mapping[str, "Value"], None]


class Limits(TypedDict):
    """The numbers of a machine by their keys; those of axes are arrays (axes,). What it does not have is nan."""

    max_feed_mm_s: float
    centripetal_mm_s2: float
    chord_error_mm: float
    sample_period_us: float
    max_velocity_mm_s: Numbers
    max_acceleration_mm_s2: Numbers
    max_braking_mm_s2: Numbers
    max_jerk_mm_s3: Numbers
    steps_per_mm: Numbers
    travel_end_zone_mm: Numbers
    travel_end_velocity_mm_s: Numbers


def _toml(value: object) -> str:
    if isinstance(value, np.ndarray):
        value = checked(value, "an array of a machine").tolist()
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    if isinstance(value, (Mapping, bytes)) or not isinstance(value, Iterable):
        raise TypeError(f"{value!r} is no value of a machine file; it must be a number, True, False, a text or a sequence")
    return "[" + ", ".join(_toml(part) for part in value) + "]"


def _one(value: object, axes: Sequence[str], number: int, key: str) -> object:
    """What one axis has of an argument: the value itself, or its part of a sequence or a mapping."""
    if isinstance(value, Mapping):
        by_name = {str(name).lower(): one for name, one in value.items()}
        names = [str(name).lower() for name in axes]
        if unknown := [name for name in by_name if name not in names]:
            raise ValueError(f"there is no axis {unknown[0]!r}; the axes are {', '.join(names)}")
        if len(by_name) < len(value):
            raise ValueError(f"an axis is there with a small and with a capital letter: {', '.join(map(str, value))}; give one")
        return by_name.get(names[number])
    if isinstance(value, np.ndarray):
        value = checked(value, key).tolist()
    if isinstance(value, (str, bytes)) or not isinstance(value, Sequence):
        return value
    if key == "travel_mm" and all(isinstance(part, (int, float, np.number)) for part in value):
        return value
    if len(value) != len(axes):
        raise ValueError(f"there are {len(value)} values for {len(axes)} axes: {list(value)}")
    return value[number]


class Machine(Picklable):
    """The axes of a machine and their limits.

    Arguments have the names of the keys of machine files (docs/reference/files.md). One of an axis is a number for all axes, a
    sequence with one for each (None: the axis has no such limit), or a mapping from names of axes.

    Args:
        axes: names of the axes, of ``xyzabc``, in the order of the columns of points.
        max_velocity_mm_s, max_acceleration_mm_s2: limits of each axis.
        max_feed_mm_s: limit of the speed along the path.
        max_jerk_mm_s3, max_braking_mm_s2: limits of each axis; None: no limit of its own.
        travel_mm: (lowest, highest) position, for all axes or a pair for each; None: not limited.
        steps_per_mm: counts a mm; positions at the ends of segments are multiples of 1/(3 * 2^30) count.
        kind: ``linear`` or ``rotary``, whose mm are degrees.
        centripetal_mm_s2, chord_error_mm: limits in bends; None: none.
        sample_period_us: period of the samples of the plan.
        keys: any other key of machine files, for example ``default_tolerance_mm``.

    Raises:
        InputError: a number is missing, out of range, or does not go together with another.

    Machines are equal if they state the same keys with the same values. They can be pickled.
    """

    _kind = "machine"

    def __init__(self, axes: str | Sequence[str] = "xyz", *, max_velocity_mm_s: PerAxis, max_acceleration_mm_s2: PerAxis,
                 max_feed_mm_s: float, max_jerk_mm_s3: PerAxis = None, max_braking_mm_s2: PerAxis = None, travel_mm: Travel = None,
                 steps_per_mm: PerAxis = None, kind: str | Sequence[str] | Mapping[str, str] | None = None,
                 centripetal_mm_s2: float | None = None, chord_error_mm: float | None = None, sample_period_us: int | None = None,
                 name: str | None = None, **keys: Value) -> None:
        root: dict[str, object] = {"name": name, "sample_period_us": sample_period_us}
        path: dict[str, object] = {"max_feed_mm_s": max_feed_mm_s, "centripetal_mm_s2": centripetal_mm_s2, "chord_error_mm": chord_error_mm,
                **{key: keys.pop(key) for key in list(keys) if key in _native.path_keys}}
        of_axis: dict[str, object] = {"max_velocity_mm_s": max_velocity_mm_s, "max_acceleration_mm_s2": max_acceleration_mm_s2,
                   "max_jerk_mm_s3": max_jerk_mm_s3, "max_braking_mm_s2": max_braking_mm_s2, "travel_mm": travel_mm,
                   "steps_per_mm": steps_per_mm, "kind": kind, **keys}
        lines = [f"{key} = {_toml(value)}" for key, value in root.items() if value is not None]
        lines += ["[path]", *(f"{key} = {_toml(value)}" for key, value in path.items() if value is not None)]
        for number, axis in enumerate(axes):
            lines += ["[[axis]]", f"name = {_toml(axis)}"]
            for key, value in of_axis.items():
                one = _one(value, axes, number, key)
                lines += [f"{key} = {_toml(one)}"] if one is not None else []
        text = "\n".join(lines) + "\n"
        self._hold(_native.parse_machine(text, "machine"), text, "machine")

    def _hold(self, native: _native.Machine, text: str, file: str) -> None:
        self._native = native
        self._text = text
        self._file = file  # for messages

    def _state(self) -> tuple[Facts, Arrays]:
        return {"text": self._text, "file": self._file}, {}

    def _restore(self, facts: Facts, arrays: Arrays) -> None:
        self._hold(_native.parse_machine(facts["text"], facts["file"]), facts["text"], facts["file"])

    @classmethod
    def from_toml(cls, path: str | os.PathLike[str], *, set: Mapping[str, Value] | None = None) -> Machine:  # pylint: disable=redefined-builtin
        """Reads a machine file. Raises InputError, with the line of what is wrong.

        Args:
            set: values in the place of what the file states, as ``--set`` has them: ``{"axis.x.max_jerk_mm_s3": 30000}``.
                Raises UsageError for them.
        """
        out = cls.__new__(cls)
        file = os.fspath(path)
        out._hold(*_native.read_machine(file, [f"{name}={_toml(value)}" for name, value in (set or {}).items()]), file)
        return out

    @classmethod
    def default(cls) -> Machine:
        """The command's machine without a file: axes x, y and z, 100 mm/s, 1000 mm/s^2."""
        return cls(max_velocity_mm_s=100, max_acceleration_mm_s2=1000, max_feed_mm_s=100, steps_per_mm=320)

    @property
    def name(self) -> str:
        """Its name, for people."""
        return self._native.name

    @property
    def axes(self) -> tuple[str, ...]:
        """The names of its axes, in the order of the columns of points."""
        return tuple(self._native.axes)

    @property
    def toml(self) -> str:
        """Its text as a machine file, for the command."""
        return self._text

    @property
    def limits(self) -> Limits:
        """Its numbers by their keys: one number, or an array (axes,). A limit that it does not have is nan."""
        return cast(Limits, {key: np.array(value) if isinstance(value, list) else value for key, value in self._native.limits.items()})

    @functools.cached_property
    def _stated(self) -> object:
        """What its text states, however it is written."""
        return json.loads(_native.machine_json(self._text))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Machine):
            return NotImplemented
        return self._stated == other._stated

    def __hash__(self) -> int:
        return hash((self.name, self.axes))

    def __repr__(self) -> str:
        return f"<splinefeed.Machine {self.name!r}: {', '.join(self.axes)}>"


def machine_or_default(machine: Machine | None) -> Machine:
    """The machine; None: Machine.default()."""
    if machine is not None and not isinstance(machine, Machine):
        raise TypeError(f"machine must be a Machine, not {machine!r}; Machine.from_toml() reads a file")
    return machine or Machine.default()
