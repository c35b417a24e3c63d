# SPDX-License-Identifier: MIT
"""What the tool says of a program that it plans under given limits."""
import json
import subprocess
from dataclasses import dataclass

from machine_text import unequal_machine_text

SAMPLING_PERIODS = 12  # what a motion from rest to rest may take longer for being sampled


class Refused(Exception):
    """Why there is no plan: the tool's last line."""


@dataclass(frozen=True)
class Setting:
    """The machine (velocity, acceleration, jerk of each axis from x on, in mm and s), and options of the command."""

    limits: tuple
    feed: float
    period_us: int = 1000
    options: tuple = ()


@dataclass(frozen=True)
class Planned:
    seconds: float
    segment_s: float  # the period in which the motion is sampled: that of the machine or a part of it

    def sampling_s(self):
        return SAMPLING_PERIODS * self.segment_s


class Case:
    """A program and its setting, whose machine file lies beside it: PROGRAM.toml, or PROGRAM.TAG.toml."""

    def __init__(self, program, setting, tag=""):
        self.machine = program.with_name(f"{program.name}{tag and '.'}{tag}.toml")
        self.machine.write_text(unequal_machine_text(setting.limits, setting.feed, setting.period_us), encoding="ascii")
        self.arguments = ["plan", str(program), "-m", str(self.machine), *setting.options]

    def __str__(self):
        return " ".join(["splinefeed", *self.arguments])

    def planned(self, tool):
        command = [tool, *self.arguments, "--quiet", "--no-advice", "--summary", "json"]
        call = subprocess.run(command, capture_output=True, text=True, check=False)
        if call.returncode != 0:
            lines = call.stderr.strip().splitlines()
            raise Refused(lines[-1] if lines else f"exit status {call.returncode}")
        summary = json.loads(call.stdout)
        return Planned(summary["cycle_time_s"], summary["cycle_time_s"] / summary["feed_segments"])
