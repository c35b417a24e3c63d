# SPDX-License-Identifier: MIT
"""What splinefeed raises. The text is the sentence that the command prints."""


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
