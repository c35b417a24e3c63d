#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs on simulated drives, each a process of its own, with random faults on the wire and in the drives.

faulted_runs.py TOOL [--kind pvt,cyclic,block] [--wire tcp,rtu] [--runs N] [--long-runs N] [--seed S] [--jobs J]
                [--under "valgrind ..." --later S] [--verbose]

Each run has one of the kinds, and one of the wires, by its seed. Every run is judged by what the drives recorded, against the plan:
- no shaft is faster than its limit; of drives that take segments none accelerates more than its limit and what a stop on
  the path adds, and each executed segment has the number, the ends and (but for trims) the duration of the plan's;
- no shaft moves after the program's exit, but of drives that the program names as not confirmed;
- a run that says it is done ended where the plan ends, at rest; one that says it is not names what was done to it;
- of ten runs, or fewer, at most one ends before anything moved, because a line went dead while the session was opened;
- drives that were told to stop stand within twice the stop reserve and the watchdog; every run ends.
"""
import argparse
import concurrent.futures
import json
import os
import random
import shlex
import subprocess
import sys
import time

from drive_processes import Drive, fields, folder_with_cables, machine_text, missing_for, sequence_problems, write

STEPS = 320.0
FEED = 100.0
ACCELERATION = 1000.0
STOP_RESERVE_S = 0.1
WATCHDOG_S = 1.0
TOLERATED = 1.005  # of a limit: recorded shafts are differences of rounded positions
BEHIND_PATH = 1.5  # of the feed: how fast a drive without segments may come back to the path
ENDS_S = 60.0  # these motions take 10 s at most, and a port ends one that takes 10 s more than four times its time
EXIT_SEEN_S = 0.004  # the record has a row a millisecond
SETTLES = 1.0  # counts: a port of drives that report whole ones cannot see that a shaft still settles by less

# By kind and wire: the profile and, of a machine file's address, its keys. No cyclic profile that ships has a serial line: that
# one is written for the test.
KINDS = {
    ("pvt", "tcp"): ("", ""),
    ("pvt", "rtu"): ("", ""),
    ("cyclic", "tcp"): ("cia402-index", ""),
    ("cyclic", "rtu"): ("serial.toml", ""),
    ("block", "tcp"): ("lexium32m", "&ramp=1.28e6"),
    ("block", "rtu"): ("leadshine-pr", "&ramp=1.28e6"),
}
QUERY = "?baud=115200&parity=E&unit=1"

SILENT = ["does not answer", "no connection", "in fault", "watchdog"]
ANY = [""]
SLOW = ["its line is too slow for targets", "the wire carries a target"]  # never said of pvt
PVT = ("pvt",)
ALL = ("pvt", "cyclic", "block")


def probability(name, low, high):
    return lambda rng, at: f"{name}={rng.uniform(low, high):.4f}"


def spell(name, low_ms, high_ms, low, high):
    return lambda rng, at: f"{name}={rng.randint(low_ms, high_ms)}:{rng.uniform(low, high):.4f}"


def lasting(name, low_ms, high_ms):
    return lambda rng, at: f"{name}@{at:.3f}:{rng.randint(low_ms, high_ms)}"


# What is asked of --faults, of which kinds of drives, and what a run may say of it; nothing: it has to finish. A frame without a
# checksum of its own (on TCP; what a gateway mixes up) is nobody's to notice, so these are for pvt.
FAULTS = {
    "none": (lambda rng, at: "", ALL, []),
    "drop": (probability("drop", 0.002, 0.08), ALL, SLOW),
    "corrupt": (probability("corrupt", 0.002, 0.08), PVT, []),
    "exception": (probability("exception", 0.002, 0.08), PVT, []),
    "stale": (probability("stale", 0.002, 0.08), PVT, []),
    "duplicate": (probability("duplicate", 0.01, 0.5), ALL, []),
    "short": (probability("short", 0.002, 0.08), ALL, SLOW),
    "foreign": (probability("foreign", 0.002, 0.08), ALL, SLOW),
    "delay": (spell("delay", 1, 60, 0.01, 0.2), ALL, SLOW),
    "late": (spell("late", 1, 250, 0.005, 0.05), ALL, SLOW),
    "drip": (spell("drip", 1, 30, 0.005, 0.03), ALL, SLOW),
    "mute": (spell("mute", 10, 150, 0.002, 0.02), ALL, SLOW),
    "mute-at": (lambda rng, at: f"mute-at={rng.randint(1, 60)}:150", ALL, SLOW),
    "dither": (lambda rng, at: f"dither={rng.randint(1, 2)}", ALL, []),
    "disconnect": (lasting("disconnect", 20, 1500), ALL, []),
    "freeze": (lasting("freeze", 20, 1500), ALL, ["in fault"]),
    "flood": (lasting("flood", 20, 1000), ALL, []),
    "no-room": (lasting("no-room", 20, 1000), PVT, []),
    "refuse-stop": (lasting("refuse-stop", 20, 5000), ALL, ANY),
    "stuck-state": (lasting("stuck-state", 20, 8000), ALL, ANY),
    "stuck-place": (lasting("stuck-place", 20, 8000), ALL, ANY),
    "state": (lambda rng, at: f"state@{at:.3f}:{rng.choice([0, 4, 6, 99, 65535])}", ALL, ANY),
    "second-master": (lambda rng, at: f"second-master@{at:.3f}", ALL, ANY),
    "power-cycle": (lambda rng, at: f"power-cycle@{at:.3f}", ALL, ANY),
    "swap-words": (lambda rng, at: f"swap-words@{at:.3f}", PVT, ["low word first"]),
    "disconnect-long": (lambda rng, at: f"disconnect@{at:.3f}:7000", ALL, SILENT),
    "freeze-long": (lambda rng, at: f"freeze@{at:.3f}:7000", ALL, SILENT),
}


def random_program(rng):
    points = [[0.0, 0.0, 0.0]]
    for _ in range(rng.randint(4, 12)):
        points.append([c + rng.uniform(-25, 25) for c in points[-1]])
    return "x,y,z\n" + "".join(f"{x:.6f},{y:.6f},{z:.6f}\n" for x, y, z in points)


def random_faults(rng, kind, later_s):
    """A list for --faults, and its names. What is at an instant does not happen before 0.3 s and later_s."""
    names = rng.sample([name for name, (_, kinds, _) in FAULTS.items() if kind in kinds], rng.choice([1, 1, 1, 2, 3]))
    parts = [f"seed={rng.randint(1, 10**6)}"]
    parts += [FAULTS[name][0](rng, rng.uniform(0.3, 2.0) + later_s) for name in names]
    return ",".join(filter(None, parts)), names


class Run:
    def __init__(self, options, seed):
        self.tool = options.tool
        self.under = options.under
        self.later_s = options.later
        self.seed = seed
        self.rng = random.Random(seed)
        fits = [pair for pair in KINDS if pair[0] in options.kind.split(",") and pair[1] in options.wire.split(",")]
        self.kind, self.wire = self.rng.choice(fits)
        self.problems = []
        self.late = False
        self.stops_hard = False  # a drive may have been stopped as hard as it can
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
        single = self.kind == "pvt" and self.rng.random() < 0.3
        axes, count = (3, 1) if single else (1, 3)
        faulted = self.rng.randrange(count)
        faults, names = random_faults(self.rng, self.kind, self.later_s)
        both = [faults if k == faulted or self.rng.random() < 0.15 else "" for k in range(count)]
        profile, keys = KINDS[self.kind, self.wire]
        with folder_with_cables(self.wire, count) as (folder, cables):
            write(folder, "program.csv", random_program(self.rng))
            if profile == "serial.toml":
                write_serial_profile(os.path.join(folder, profile))
            listen = [f"rtu://{theirs}{QUERY}" for _, theirs in cables] or ["tcp://127.0.0.1:0"] * count
            extra = ["--ring", str(self.rng.choice([512, 4096]))] if self.kind == "pvt" else []
            drives = [Drive(self.tool, folder, k, axes, listen=listen[k], faults=both[k], profile=profile, under=self.under,
                            extra=extra) for k in range(count)]
            keys = f"&profile={profile}{keys}" if profile else keys
            addresses = [f"modbus-rtu://{ours}{QUERY}{keys}" for ours, _ in cables] or \
                        [drive.tcp_address() + keys for drive in drives]
            if profile == "lexium32m":
                addresses = [address.replace("unit=1", "unit=255") for address in addresses]
            write(folder, "machine.toml", self.machine(addresses))
            began_s = time.monotonic()
            try:
                run = subprocess.run([*self.under, self.tool, "run", "program.csv", "-m", "machine.toml", "--target", "modbus",
                                      "--segments", "plan.csv", "--summary", "json", "--quiet"], cwd=folder, capture_output=True,
                                     text=True, timeout=ENDS_S if not self.under else 10 * ENDS_S, check=False)
                ended_s = time.monotonic()
                # A drive that thaws may find a start in its buffer, and stops by itself: what did not confirm may still move.
                time.sleep(0.4 + (WATCHDOG_S + 2 * STOP_RESERVE_S if "may still move" in run.stderr else 0.0))
            except subprocess.TimeoutExpired:
                self.problems.append(f"{self.kind}, {self.wire}, {both}: it does not end within {ENDS_S} s")
                return
            finally:
                for drive in drives:
                    self.problems += drive.stop()
            self.told = (f"{self.kind}, {self.wire}, {count} x {axes} axes, drive {faulted}: {faults}: exit {run.returncode} "
                         f"after {ended_s - began_s:.1f} s {run.stderr.strip()}")
            self.judge(folder, run, drives, axes, names, ended_s)

    def judge(self, folder, run, drives, axes, names, ended_s):
        # A line that is measured while it is silent, or on a busy host, is too slow for cyclic targets: that is usage.
        slow = run.returncode == 2 and "the wire carries a target" in run.stderr
        self.check(run.returncode in (0, 1) or slow, f"exit status {run.returncode}")
        self.stops_hard = any(FAULTS[name][2] is ANY for name in names)
        unmoved = not any(self.moved(drive) for drive in drives)
        if run.returncode == 0:
            json.loads(run.stdout)
        elif not self.under:  # where all is slow, any run may fail to start in time
            named = any(text in run.stderr for name in names for text in FAULTS[name][2])
            # After lost answers, or on a busy host, a line may go dead while the session is opened; nothing has moved then.
            self.late = not named and unmoved
            self.check(named or self.late, f"not named: {run.stderr.strip()}")
        planned = os.path.join(folder, "plan.csv")
        plan = fields(planned) if os.path.exists(planned) else []
        for k, drive in enumerate(drives):
            rows = drive.shaft_rows()
            if self.kind == "pvt":
                mine = [0, 1, 2] if axes == 3 else [k]
                self.problems += sequence_problems(drive.executed(), plan, mine, run.returncode == 0, f"drive {k}")
            self.shafts(k, rows, axes)
            if "may still move" not in run.stderr:
                self.stands(k, [row for row in rows if drive.start_s() + row[0] >= ended_s + EXIT_SEEN_S])

    @staticmethod
    def moved(drive):
        rows = drive.shaft_rows()
        return any(row[1:] != rows[0][1:] for row in rows)

    def stands(self, drive, rows):
        off = max((abs(place - first) for row in rows for place, first in zip(row[1:], rows[0][1:])), default=0.0)
        most = 1e-3 if self.kind == "pvt" else SETTLES
        self.check(off < most, f"drive {drive}: a shaft moved by {off:.3f} counts after the exit")

    def shafts(self, drive, rows, axes):
        pvt = self.kind == "pvt"
        fastest = FEED * (TOLERATED if pvt else BEHIND_PATH)
        most = ACCELERATION + FEED / (2 * STOP_RESERVE_S)
        for j in range(axes):
            place = [row[1 + j] / STEPS for row in rows]
            # A session presets the positions to where the shafts stand already, so that a shaft never jumps.
            speed = [(b - a) * 1000.0 for a, b in zip(place, place[1:])]
            reached = max(map(abs, speed), default=0.0)
            self.check(reached <= fastest, f"drive {drive}: a shaft at {reached:.2f} mm/s")
            steepest = max((abs(b - a) * 1000.0 for a, b in zip(speed, speed[1:])), default=0.0)
            if pvt and not self.stops_hard:
                self.check(steepest <= most * TOLERATED, f"drive {drive}: a shaft accelerates by {steepest:.1f} mm/s^2")
            last = speed[-100:]
            self.check(max(map(abs, last), default=0.0) < 1e-3, f"drive {drive} does not stand at the end")


def write_serial_profile(path):
    """cia402-index, as if it had a serial line, and interpolated over a few of its targets."""
    shipped = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "hal", "profiles", "cia402-index.toml")
    with open(shipped, encoding="utf-8") as source:
        text = source.read()
    for theirs, ours in (('name = "cia402-index"', 'name = "serial"'), ('wires = ["tcp"]', 'wires = ["rtu"]'),
                         ("unit = 255", "unit = 1"), ("period_ms = 10", "period_ms = 40")):
        text = text.replace(theirs, ours)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def one(options, seed):
    run = Run(options, seed)
    try:
        run.execute()
    except (OSError, ValueError, IndexError, subprocess.TimeoutExpired) as error:
        run.problems.append(f"{type(error).__name__}: {error}")
    return run


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("tool", type=os.path.abspath)
    parser.add_argument("--kind", default="pvt,cyclic,block")
    parser.add_argument("--wire", default="tcp,rtu")
    parser.add_argument("--runs", type=int, default=24)
    parser.add_argument("--seed", type=int, default=None)
    parser.add_argument("--long-runs", type=int, default=0, help="so many where SPLINEFEED_LONG is 1")
    parser.add_argument("--jobs", type=int, default=4)
    parser.add_argument("--under", type=shlex.split, default=[], help="a command that runs the tool and the drives")
    parser.add_argument("--later", type=float, default=0.0, help="s that the tool takes to start, under a command or sanitizers")
    parser.add_argument("--verbose", action="store_true")
    options = parser.parse_args()
    if "rtu" in options.wire and (why := missing_for("rtu")):
        print(why)
        if options.wire == "rtu":
            return 77
        options.wire = "tcp"
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
    return 1 if failed or late > max(1, options.runs / 10) else 0


if __name__ == "__main__":
    sys.exit(main())
