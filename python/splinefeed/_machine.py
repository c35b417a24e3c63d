# SPDX-License-Identifier: MIT
"""Machines: what a machine file states."""
from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Union

import numpy as np

from . import _native

PerAxis = Union[float, Sequence[Union[float, None]], Mapping[str, float], None]


def _toml(value: Any) -> str:
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    if isinstance(value, Mapping) or not isinstance(value, Iterable):
        raise TypeError(f"{value!r} is no value of a machine file; it must be a number, True, False, a text or a sequence")
    return "[" + ", ".join(_toml(part) for part in value) + "]"


def _one(value: Any, axes: Sequence[str], number: int, pairs: bool) -> Any:
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
        value = value.tolist()
    if isinstance(value, str) or not isinstance(value, Sequence):
        return value
    if pairs and all(isinstance(part, (int, float, np.number)) for part in value):
        return value
    if len(value) != len(axes):
        raise ValueError(f"there are {len(value)} values for {len(axes)} axes: {list(value)}")
    return value[number]


class Machine:
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
    """

    def __init__(self, axes: str | Sequence[str] = "xyz", *, max_velocity_mm_s: PerAxis, max_acceleration_mm_s2: PerAxis,
                 max_feed_mm_s: float, max_jerk_mm_s3: PerAxis = None, max_braking_mm_s2: PerAxis = None, travel_mm: Any = None,
                 steps_per_mm: PerAxis = None, kind: str | Sequence[str] | Mapping[str, str] | None = None,
                 centripetal_mm_s2: float | None = None, chord_error_mm: float | None = None, sample_period_us: int | None = None,
                 name: str | None = None, **keys: Any) -> None:
        root = {"name": name, "sample_period_us": sample_period_us}
        path = {"max_feed_mm_s": max_feed_mm_s, "centripetal_mm_s2": centripetal_mm_s2, "chord_error_mm": chord_error_mm,
                **{key: keys.pop(key) for key in list(keys) if key in _native.path_keys}}
        of_axis = {"max_velocity_mm_s": max_velocity_mm_s, "max_acceleration_mm_s2": max_acceleration_mm_s2,
                   "max_jerk_mm_s3": max_jerk_mm_s3, "max_braking_mm_s2": max_braking_mm_s2, "travel_mm": travel_mm,
                   "steps_per_mm": steps_per_mm, "kind": kind, **keys}
        lines = [f"{key} = {_toml(value)}" for key, value in root.items() if value is not None]
        lines += ["[path]", *(f"{key} = {_toml(value)}" for key, value in path.items() if value is not None)]
        for number, axis in enumerate(axes):
            lines += ["[[axis]]", f"name = {_toml(axis)}"]
            for key, value in of_axis.items():
                one = _one(value, axes, number, key == "travel_mm")
                lines += [f"{key} = {_toml(one)}"] if one is not None else []
        self._hold(_native.parse_machine("\n".join(lines) + "\n", "machine"), "\n".join(lines) + "\n")

    def _hold(self, native: _native.Machine, text: str) -> None:
        self._native = native
        self._text = text

    @classmethod
    def from_toml(cls, path: str | os.PathLike[str], *, set: Mapping[str, Any] | None = None) -> Machine:  # pylint: disable=redefined-builtin
        """Reads a machine file. Raises InputError, with the line of what is wrong.

        Args:
            set: values in the place of what the file states, as ``--set`` has them: ``{"axis.x.max_jerk_mm_s3": 30000}``.
                Raises UsageError for them.
        """
        out = cls.__new__(cls)
        out._hold(*_native.read_machine(os.fspath(path), [f"{name}={_toml(value)}" for name, value in (set or {}).items()]))
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
    def limits(self) -> dict[str, float | np.ndarray]:
        """Its numbers by their keys: one number, or an array (axes,). A limit that it does not have is nan."""
        return {key: np.array(value) if isinstance(value, list) else value for key, value in self._native.limits.items()}

    def __repr__(self) -> str:
        return f"<splinefeed.Machine {self.name!r}: {', '.join(self.axes)}>"


def machine_or_default(machine: Machine | None) -> Machine:
    """The machine; None: Machine.default()."""
    if machine is not None and not isinstance(machine, Machine):
        raise TypeError(f"machine must be a Machine, not {machine!r}; Machine.from_toml() reads a file")
    return machine or Machine.default()
