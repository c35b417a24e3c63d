# SPDX-License-Identifier: MIT
"""The command beside the module: what both make of one input."""
import json
import os
import pathlib
import subprocess
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
TOOL = pathlib.Path(os.environ["SPLINEFEED_TOOL"]).resolve()
OF_THE_PROCESS = ("planning_time_s", "peak_rss_bytes", "memory_bytes")


def call(*arguments, folder=ROOT, text=None):
    """(exit status, standard output, standard error) of the command."""
    done = subprocess.run([TOOL, *map(str, arguments)], cwd=folder, input=text, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout, done.stderr


def planned(path, machine, *options):
    """(segments as integers, one row each; summary) of `splinefeed plan`."""
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "machine.toml").write_text(machine.toml)
        status, out, error = call("plan", path, "-m", f"{folder}/machine.toml", "--segments", f"{folder}/s.csv", "--summary", "json",
                                  "--no-advice", "--quiet", *options)
        assert status == 0, error
        rows = np.loadtxt(f"{folder}/s.csv", delimiter=",", comments="#", skiprows=len(machine.axes) * 2 + 3, dtype=np.int64, ndmin=2)
        return rows, json.loads(out)


def as_rows(segments, axes):
    """Segments of the module in the columns of --segments."""
    columns = [segments["index"], segments["duration_ticks"]]
    for k in range(axes):
        columns += [segments[name][:, k] for name in ("start", "end", "start_velocity", "end_velocity")]
    return np.stack([column.astype(np.int64) for column in columns], axis=1)


def without_process(summary):
    return {key: value for key, value in summary.items() if key not in OF_THE_PROCESS}
