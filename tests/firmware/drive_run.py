#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The firmware's Modbus drive on an emulated board, moved by the tool: drive_run.py TOOL IMAGE BOARD [--faulted RUNS] [--seed SEED]

`splinefeed run` over a pseudo-terminal; then short programs over a line that drops, cuts, changes, repeats and delays frames. The pulses
of its pins are counted: each axis is where the program ends, and no pulse is lost or doubled. The board's clock goes as the host's,
as far as the host is fast enough: a board that is late stands on the path now and then, and loses nothing by it."""
import argparse
import json
import os
import random
import re
import subprocess
import sys
import tempfile
import time

from board_in_qemu import Board, BoardFailed, plugins_refused
from faulty_line import FaultyLine
from planned import AXES, LINES, MACHINE, STEPS_PER_MM, Plan, check, counts_after, counts_at, of_axis, slowed, steps_of, waypoints

PROFILE = "hal/profiles/splinefeed-pvt.toml"
SHARE = 0.03  # of the frames
CLOCK = "shift=5,align=on"  # with the host's time; an instruction takes 32 ns
RUN_S = 600


def patient(profile):
    """The profile, for a host that is busy."""
    profile = re.sub(r"^response_timeout_ms = \d+$", "response_timeout_ms = 1000", profile, flags=re.MULTILINE)
    return re.sub(r"^timeout_ms = \d+ +#", "timeout_ms = 20000 #", profile, flags=re.MULTILINE)


class Drive:
    def __init__(self, tool, image, machine, folder):
        self.tool, self.folder = tool, folder
        self.board = Board(image, folder, machine, clock=CLOCK)
        self.up = [0, 0, 0]
        self.profile = f"{folder}/drive.toml"
        with open(PROFILE, encoding="utf-8") as shipped, open(self.profile, "w", encoding="utf-8") as out:
            out.write(patient(shipped.read()))
        self.machine = MACHINE
        if self.board.kind.slow:
            self.machine = f"{folder}/slow.toml"
            with open(MACHINE, encoding="utf-8") as fast, open(self.machine, "w", encoding="utf-8") as out:
                out.write(slowed(fast.read()))

    def new_steps(self):
        """The steps of the pins since the last call."""
        changes = self.board.pin_levels()
        steps, self.up = steps_of([(*LINES[change.pin], change.level) for change in changes if change.pin in LINES], self.up)
        return steps

    def run(self, name, rows, share, seed):
        path = f"{self.folder}/rows.csv"
        with open(path, "w", encoding="utf-8") as out:
            out.write("x,y,z\n" + "\n".join(rows) + "\n")
        line = FaultyLine(self.board.uart, share, seed)
        begun = time.monotonic()
        try:
            address = f"modbus-rtu://{line.path}?parity=N&stop=1&profile={self.profile}"
            run = subprocess.run([self.tool, "run", path, "-m", self.machine, "--target", address, "--start", "here", "--summary",
                                  "json"],
                                 capture_output=True, text=True, timeout=RUN_S, check=False)
        finally:
            line.close()
        faults = ", ".join(f"{count} {kind}" for kind, count in line.counts.items() if count)
        told = f"{name}: {time.monotonic() - begun:.1f} s, {line.frames} frames, faults: {faults or 'none'}"
        check(run.returncode == 0, f"{told}: exit status {run.returncode}: {run.stderr.strip()[-600:]}")
        steps = self.new_steps()
        start, end = counts_at(rows[0]), counts_at(rows[-1])
        counts = counts_after(start, steps)
        check(counts == end, f"{told}: the pins stepped to {counts}, the program ends at {end}")
        return told, steps, json.loads(run.stdout)


def turns_of(steps):
    return sum(a != b for a, b in zip(steps, steps[1:]))


def whole(drive):
    """The pulses of the simulated machine. Where an axis turns it may do so nearer, by what longer segments smooth, both ways."""
    rows = waypoints("examples/path61.csv")
    told, steps, summary = drive.run("path61", rows, 0.0, 0)
    plan = Plan(drive.tool, drive.folder, rows, drive.board.kind)
    for axis in range(3):
        made, planned = of_axis(axis, steps), of_axis(axis, plan.steps)
        allowed = 2 * turns_of(planned) * (summary["smoothing_bound_mm"] * STEPS_PER_MM[axis] + 1)
        check(abs(len(made) - len(planned)) <= allowed,
              f"path61: {len(made)} pulses of {AXES[axis]}, the simulated machine makes {len(planned)}, {allowed:.0f} may differ")
    return f"{told}; {len(steps)} steps of {len(plan.steps)} planned, smoothing {summary['smoothing_bound_mm'] * 1e3:.1f} um"


def faulted(drive, seed):
    """A part of path61, from where the drive stands: the first point is preset."""
    rng = random.Random(seed)
    rows = waypoints("examples/path61.csv")
    first = rng.randrange(len(rows) - 12)
    told, steps, _ = drive.run(f"seed {seed}", rows[first:first + rng.randint(5, 12)], SHARE, seed)
    return f"{told}; {len(steps)} steps"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("tool")
    parser.add_argument("image")
    parser.add_argument("machine")
    parser.add_argument("--faulted", type=int, default=50 if os.environ.get("SPLINEFEED_LONG") == "1" else 3)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    if refused := plugins_refused():
        print(f"SKIPPED: {refused}")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        drive = Drive(options.tool, options.image, options.machine, folder)
        try:
            print(whole(drive), flush=True)
            for seed in range(options.seed, options.seed + options.faulted):
                print(faulted(drive, seed), flush=True)
        except (BoardFailed, subprocess.TimeoutExpired) as problem:
            print(f"{options.machine}: {problem}")
            return 1
        finally:
            drive.board.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
