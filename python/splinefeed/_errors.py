# SPDX-License-Identifier: MIT
"""What splinefeed raises. The text is the sentence that the command prints."""
from __future__ import annotations

import sys
import warnings
from collections.abc import Iterable


class Error(Exception):
    """All errors of splinefeed."""


class InputError(Error, ValueError):
    """Wrong input: ``FILE:LINE: what is wrong, what would be right``. The file of arrays is ``points``, its lines are rows from 1."""


class UsageError(Error, ValueError):
    """An argument has a value that it cannot have. Arguments have the names of the command's options."""


class OutputError(Error, OSError):
    """A file cannot be written."""


class SplinefeedWarning(UserWarning):
    """Input that is valid, but hardly what was meant."""


def warn_caller(notes: Iterable[str]) -> None:
    """Each note is a warning of the line, outside this package, that called it."""
    level, frame = 2, sys._getframe(1)  # pylint: disable=protected-access
    while frame.f_back is not None and frame.f_globals.get("__package__") == __package__:
        level, frame = level + 1, frame.f_back
    for note in notes:
        warnings.warn(note, SplinefeedWarning, stacklevel=level)
