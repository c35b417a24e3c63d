# SPDX-License-Identifier: MIT
"""Tests that consist of cases, each a function of the tool and a folder of its own that returns the problems it found."""
import tempfile


def pymodbus_missing():
    """The reason, or nothing."""
    try:
        import pymodbus.server.async_io  # noqa: F401
    except ImportError as missing:
        return f"{missing} (Debian: apt-get install python3-pymodbus)"
    return ""


def run_cases(tool, cases, names):
    """The exit status. names: of the cases to be run; none: all."""
    problems = []
    for case in cases:
        if names and case.__name__ not in names:
            continue
        with tempfile.TemporaryDirectory(prefix="splinefeed-case-") as folder:
            found = case(tool, folder)
        print(f"{case.__name__}: {len(found) or 'no'} problems", flush=True)
        problems += [f"{case.__name__}: {problem}" for problem in found]
    for problem in problems:
        print(problem)
    return 1 if problems else 0
