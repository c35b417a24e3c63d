#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs on simulated drives, each a process of its own, with random faults on the wire and in the drives.

faulted_runs.py TOOL [--runs N] [--long-runs N] [--seed S] [--jobs J] [--under "valgrind ..." --later S] [--verbose]

Every run is judged by what the drives recorded, against the plan:
- each executed segment has the number, the ends and (but for trims) the duration of the plan's, none is missing or twice;
- no shaft is faster than its limit, none accelerates more than its limit and what a stop on the path adds;
- a run that says it is done ended where the plan ends, at rest; one that says it is not names what was done to it;
- of ten runs at most one ends before anything moved, because a line went dead while the session was opened;
- drives that were told to stop stand within twice the stop reserve and the watchdog.
"""
import argparse
import concurrent.futures
import json
import os
import random
import shlex
import subprocess
import sys
import tempfile
import time

from drive_processes import Drive, fields, machine_text, sequence_problems

STEPS = 320.0
FEED = 100.0
ACCELERATION = 1000.0
STOP_RESERVE_S = 0.1
WATCHDOG_S = 1.0
TOLERATED = 1.005  # of a limit: recorded shafts are differences of rounded positions

# What a run may say of each fault; the others let it finish.
NAMED = {
    "power-cycle": ["switched off and on"],
    "swap-words": ["low word first"],
    "disconnect-long": ["does not answer", "no connection", "in fault"],
    "freeze-long": ["does not answer", "in fault", "watchdog"],
}


def random_program(rng):
    points = [[0.0, 0.0, 0.0]]
    for _ in range(rng.randint(4, 12)):
        points.append([c + rng.uniform(-25, 25) for c in points[-1]])
    return "x,y,z\n" + "".join(f"{x:.6f},{y:.6f},{z:.6f}\n" for x, y, z in points)


def random_faults(rng, later_s):
    """A list for --faults, and the names of those that may end the run. None happens before 0.3 s and later_s."""
    kinds = rng.sample(["none", "drop", "corrupt", "exception", "duplicate", "stale", "delay", "disconnect", "freeze",
                        "power-cycle", "swap-words", "disconnect-long", "freeze-long"], rng.choice([1, 1, 1, 2, 3]))
    parts = [f"seed={rng.randint(1, 10**6)}"]
    fatal = []
    for kind in kinds:
        at = rng.uniform(0.3, 2.0) + later_s
        if kind in ("drop", "corrupt", "exception", "stale"):
            parts.append(f"{kind}={rng.uniform(0.002, 0.08):.4f}")
        elif kind == "duplicate":
            parts.append(f"duplicate={rng.uniform(0.01, 0.5):.3f}")
        elif kind == "delay":
            parts.append(f"delay={rng.randint(1, 60)}:{rng.uniform(0.01, 0.2):.3f}")
        elif kind in ("disconnect", "freeze"):
            parts.append(f"{kind}@{at:.3f}:{rng.randint(20, 1500)}")
        elif kind in ("disconnect-long", "freeze-long"):
            parts.append(f"{kind[:-5]}@{at:.3f}:7000")
            fatal.append(kind)
        elif kind != "none":
            parts.append(f"{kind}@{at:.3f}")
            fatal.append(kind)
    return ",".join(parts), fatal


class Run:
    def __init__(self, tool, seed, under=(), later_s=0.0):
        self.tool = tool
        self.under = under
        self.later_s = later_s
        self.seed = seed
        self.rng = random.Random(seed)
        self.problems = []
        self.late = False
        self.told = ""

    def check(self, condition, text):
        if not condition:
            self.problems.append(text)

    @staticmethod
    def machine(addresses):
        keys = f"max_velocity_mm_s = {FEED}\nmax_acceleration_mm_s2 = {ACCELERATION}\nsteps_per_mm = {STEPS}\n"
        drives = addresses if len(addresses) == 3 else [f"{addresses[0]}&axis={k}" for k in range(3)]
        head = f"name = \"faulted\"\n[path]\nmax_feed_mm_s = {FEED}\n"
        return machine_text([(name, keys) for name in "xyz"], drives, head)

    def execute(self):
        with tempfile.TemporaryDirectory(prefix="splinefeed-faulted-") as folder:
            single = self.rng.random() < 0.3
            axes = 3 if single else 1
            count = 1 if single else 3
            faulted = self.rng.randrange(count)
            faults, fatal = random_faults(self.rng, self.later_s)
            both = [faults if k == faulted or self.rng.random() < 0.15 else "" for k in range(count)]
            with open(os.path.join(folder, "program.csv"), "w", encoding="ascii") as file:
                file.write(random_program(self.rng))
            drives = [Drive(self.tool, folder, k, axes, faults=both[k], under=self.under) for k in range(count)]
            addresses = [drive.tcp_address() for drive in drives]
            with open(os.path.join(folder, "machine.toml"), "w", encoding="ascii") as file:
                file.write(self.machine(addresses))
            try:
                run = subprocess.run([*self.under, self.tool, "run", "program.csv", "-m", "machine.toml", "--target", "modbus",
                                      "--segments", "plan.csv", "--summary", "json", "--quiet"], cwd=folder, capture_output=True,
                                     text=True, timeout=120, check=False)
                # A drive that thaws may find a start in its buffer, and stops by itself: what did not confirm may still move.
                time.sleep(0.4 + (WATCHDOG_S + 2 * STOP_RESERVE_S if "may still move" in run.stderr else 0.0))
            finally:
                for drive in drives:
                    self.problems += drive.stop()
            self.told = f"{count} x {axes} axes, drive {faulted}: {faults}: exit {run.returncode} {run.stderr.strip()}"
            self.judge(folder, run, drives, axes, fatal, both)

    def judge(self, folder, run, drives, axes, fatal, faults):
        self.check(run.returncode in (0, 1), f"exit status {run.returncode}")
        if run.returncode == 0:
            json.loads(run.stdout)
        elif not self.under:  # where all is slow, any run may fail to start in time
            names = [name for kind in fatal for name in NAMED[kind]]
            named = any(name in run.stderr for name in names)
            # After lost answers, or on a busy host, a line may go dead while the session is opened; nothing has moved then.
            self.late = (not named and any(fault in text for text in faults for fault in ("disconnect@", "freeze@"))
                         and any(name in run.stderr for name in ("does not answer", "no connection"))
                         and not any(drive.executed() for drive in drives))
            self.check(named or self.late, f"not named: {run.stderr.strip()}")
        planned = os.path.join(folder, "plan.csv")
        plan = fields(planned) if os.path.exists(planned) else []
        for k, drive in enumerate(drives):
            mine = [0, 1, 2] if axes == 3 else [k]
            self.problems += sequence_problems(drive.executed(), plan, mine, run.returncode == 0, f"drive {k}")
            self.shafts(k, drive.shaft_rows(), axes, "power-cycle" in faults[k])

    def shafts(self, drive, rows, axes, power_cycled):
        most = ACCELERATION + FEED / (2 * STOP_RESERVE_S)
        for j in range(axes):
            place = [row[1 + j] / STEPS for row in rows]
            # The start of a session defines where the shafts are; nothing moves then.
            speed = [(b - a) * 1000.0 for a, b in zip(place, place[1:])]
            moved = [abs(v) > FEED * TOLERATED for v in speed]
            self.check(sum(moved) <= 1, f"drive {drive}: a shaft at {max(map(abs, speed)):.2f} mm/s")
            jump = moved.index(True) if any(moved) else -2
            steepest = max((abs(b - a) * 1000.0 for i, (a, b) in enumerate(zip(speed, speed[1:]))
                            if i not in (jump, jump - 1)), default=0.0)
            if not power_cycled:
                self.check(steepest <= most * TOLERATED, f"drive {drive}: a shaft accelerates by {steepest:.1f} mm/s^2")
            last = speed[-100:]
            self.check(max(map(abs, last), default=0.0) < 1e-6, f"drive {drive} does not stand at the end")


def one(options, seed):
    run = Run(os.path.abspath(options.tool), seed, options.under, options.later)
    try:
        run.execute()
    except (OSError, ValueError, IndexError, subprocess.TimeoutExpired) as error:
        run.problems.append(f"{type(error).__name__}: {error}")
    return run


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("tool")
    parser.add_argument("--runs", type=int, default=24)
    parser.add_argument("--seed", type=int, default=None)
    parser.add_argument("--long-runs", type=int, default=0, help="so many where SPLINEFEED_LONG is 1")
    parser.add_argument("--jobs", type=int, default=4)
    parser.add_argument("--under", type=shlex.split, default=[], help="a command that runs the tool and the drives")
    parser.add_argument("--later", type=float, default=0.0, help="s that the tool takes to start, under a command or sanitizers")
    parser.add_argument("--verbose", action="store_true")
    options = parser.parse_args()
    if options.long_runs > 0 and os.environ.get("SPLINEFEED_LONG") == "1":
        options.runs = options.long_runs
    seed = options.seed if options.seed is not None else random.SystemRandom().randrange(10**9)
    print(f"seed {seed}, {options.runs} runs", flush=True)
    failed = late = 0
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for run in pool.map(lambda i: one(options, seed + i), range(options.runs)):
            if run.problems:
                failed += 1
            late += run.late
            if run.problems or run.late or options.verbose:
                print(f"--seed {run.seed} --runs 1: {run.told}", flush=True)
            for problem in run.problems[:5]:
                print(f"    {problem}", flush=True)
    print(f"{failed} of {options.runs} runs failed, {late} ended before they began")
    return 1 if failed or late > options.runs / 10 else 0


if __name__ == "__main__":
    sys.exit(main())
