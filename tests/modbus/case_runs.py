# SPDX-License-Identifier: MIT
"""Tests that consist of cases, each a function of the tool and a folder of its own that returns the problems it found."""
import functools
import tempfile


def pymodbus_missing():
    """The reason, or nothing."""
    try:
        import pymodbus.server.async_io  # noqa: F401
    except ImportError as missing:
        return f"{missing} (Debian: apt-get install python3-pymodbus)"
    return ""


def by_profile(run, profiles):
    """A case of run(tool, folder, profile) for each of them, by its name; "" is splinefeed-pvt."""
    return {profile or "splinefeed-pvt": functools.partial(run, profile=profile) for profile in profiles}


def run_cases(tool, cases, names=(), missing=""):
    """The exit status. cases: functions, or such by their names; names: of the cases to be run; none: all; missing: why they are skipped."""
    if missing:
        print(f"SKIPPED: {missing}")
        return 77
    problems = []
    if not isinstance(cases, dict):
        cases = {case.__name__: case for case in cases}
    for name, case in cases.items():
        if names and name not in names:
            continue
        with tempfile.TemporaryDirectory(prefix="splinefeed-case-") as folder:
            found = case(tool, folder)
        print(f"{name}: {len(found) or 'no'} problems", flush=True)
        problems += [f"{name}: {problem}" for problem in found]
    for problem in problems:
        print(problem)
    return 1 if problems else 0
