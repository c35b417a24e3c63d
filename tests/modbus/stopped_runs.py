#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs that are stopped by signals at random times, on simulated drives, each a process of its own.

stopped_runs.py TOOL [--runs N] [--long-runs N] [--seed S] [--jobs J] [--verbose]

Each run has a target, signals and a situation by its seed. It is judged by what the drives recorded:
- every axis that answers stands within STANDSTILL_S of the signal, and no shaft moves after the program's exit;
- the exit status is 1, or 0 where the program had ended before; the sentence says what was asked and where the machine
  stands, names a drive that does not answer, and claims that all were held on the path only where they are there;
- the program ends within EXIT_S, whatever is blocked;
- the state file has the places where the shafts stand, or says that it does not know them;
- a spindle that turned is told to stop, and stands.

It prints a table: target, situation, worst time to standstill by the signals, most counts that a shaft moved after the exit.
The same on a virtual clock, and on other targets: tests/live/shaft_stories.txt."""
import argparse
import concurrent.futures
import json
import math
import os
import random
import re
import signal
import subprocess
import sys
import threading
import time

from case_runs import pymodbus_missing
from drive_processes import Drive, folder_with_cables, machine_text, missing_for
from spindle_runs import Vfd
from real_time import ATTEMPTS, HostWatch, OffTime

STEPS = 320.0
FEED = 80.0
HEAD = f"name = \"stopped\"\n[path]\nmax_feed_mm_s = {FEED}\n"
KEYS = f"max_velocity_mm_s = {FEED}\nmax_acceleration_mm_s2 = 1000\nsteps_per_mm = {STEPS}\n"
NEVER_MOVED = "interrupted before anything was moved; the drives were not enabled"

# name: profile, wire, stated time to standstill by what was asked [s], off the path where all were held [mm].
TARGETS = {
    "splinefeed-pvt, tcp": ("", "tcp", {"once": 0.28, "about a start": 0.4, "twice": 0.05}, 0.02),
    "lexium32m, tcp": ("lexium32m&ramp=1e6", "tcp", {"once": 0.25, "twice": 0.05}, 0.3),
    "leadshine-pr, rtu": ("leadshine-pr", "rtu", {"once": 0.4, "twice": 0.1}, 0.3),
}
# What is sent, and what asks for a stop: the last one. One that only steers is on its way first.
SIGNALS = {
    "SIGINT": ["SIGINT"],
    "SIGTERM": ["SIGTERM"],
    "SIGHUP": ["SIGHUP"],
    "SIGQUIT": ["SIGQUIT"],
    "SIGINT, twice": ["SIGINT", "SIGINT"],
    "SIGTSTP first": ["SIGTSTP", "SIGTERM"],
    "SIGUSR1 first": ["SIGUSR1", "SIGTERM"],
    "SIGPIPE first": ["SIGPIPE", "SIGTERM"],
}
STEERING = ("SIGTSTP", "SIGUSR1", "SIGPIPE")
SITUATIONS = ["plain", "slow machine file", "spindle", "stalled input", "full pipe", "frozen drive", "dead drive"]
SPINDLE = "[spindle]\nmax_rpm = 24000\nat_speed_timeout_s = 10\nvfd = \"{vfd}?profile=vfd-delta-ms300\"\n"
EXIT_S = 12.0
START_S = 0.06  # a hold so near to a start waits for it
MEASURED_S = 0.004  # the record has a row a millisecond, and an exit is looked for as often


class Run:
    def __init__(self, tool, seed):
        self.tool = tool
        self.seed = seed
        self.rng = random.Random(seed)
        self.target = self.rng.choice(list(TARGETS))
        self.signals = self.rng.choice(list(SIGNALS))
        self.situation = self.rng.choice(SITUATIONS)
        self.at_s = self.rng.uniform(0.0, 3.0) if self.rng.random() < 0.8 else self.rng.uniform(0.0, 0.4)
        self.gap_s = self.rng.choice([0.0, self.rng.uniform(0.0, 0.3)])
        self.before_s = self.rng.choice([0.0, self.rng.uniform(0.0, 0.4)])  # the drive is lost so long before
        self.problems = []
        self.told = ""
        self.standstill_s = None
        self.early = False  # it had ended before the signal
        self.loss = None
        self.after = 0
        self.judged = True

    def check(self, condition, text):
        if not condition:
            self.problems.append(text)

    def program(self):
        points = [(0.0, 0.0, 0.0)]
        while len(points) < 60:
            points.append(tuple(c + self.rng.uniform(-20, 20) for c in points[-1]))
        return points

    def start(self, folder, addresses):
        points = self.program()
        spindle = self.situation == "spindle"
        rows = ["x,y,z\n"] + ["%.6f,%.6f,%.6f\n" % point for point in points]
        if spindle:
            rows = ["G61 S12000 M3\n"] + ["G1 F4800 X%.6f Y%.6f Z%.6f\n" % point for point in points] + ["M2\n"]
        program = "program.ngc" if spindle else "program.csv"
        with open(os.path.join(folder, program), "w", encoding="ascii") as file:
            file.writelines(rows)
        machine = machine_text([(name, KEYS) for name in "xyz"], addresses, HEAD)
        if spindle:
            machine += SPINDLE.format(vfd=self.vfd.address)
        machine_file = os.path.join(folder, "machine.toml")
        if self.situation == "slow machine file":
            os.mkfifo(machine_file)
            threading.Thread(target=write_slowly, args=[machine_file, machine], daemon=True).start()
        else:
            with open(machine_file, "w", encoding="ascii") as file:
                file.write(machine)
        stalled = self.situation == "stalled input"
        command = [self.tool, "run", "-" if stalled else program, "-m", "machine.toml", "--target", "modbus",
                   "--quiet", "--state", "state.json", *([] if spindle else ["--curve", "polyline"])]
        command += ["--trace", "-"] if self.situation == "full pipe" else ["--segments", "plan.csv"]
        errors = open(os.path.join(folder, "errors"), "w", encoding="utf-8")
        with errors:
            run = subprocess.Popen(command, cwd=folder, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=errors)
        if stalled:
            run.stdin.write("".join(rows[:self.rng.randint(1, 30)]).encode())
            run.stdin.flush()
        return run, points

    def execute(self):
        profile, wire, _, _ = TARGETS[self.target]
        with folder_with_cables(wire, 3) as (folder, cables):
            query = "?baud=115200&parity=E&unit=1"
            listen = [f"rtu://{theirs}{query}" for _, theirs in cables] or ["tcp://127.0.0.1:0"] * 3
            drives = [Drive(self.tool, folder, k, 1, listen=listen[k], profile=profile.split("&")[0]) for k in range(3)]
            keys = f"profile={profile}" if profile else "unit=1"
            addresses = [f"modbus-rtu://{ours}{query}&{keys}" for ours, _ in cables] or \
                        [drive.tcp_address(keys) for drive in drives]
            self.vfd = Vfd(folder, 2000.0) if self.situation == "spindle" else None
            run, points = self.start(folder, addresses)
            lost = self.rng.randrange(3) if "drive" in self.situation else None
            try:
                asked, ended = self.stop(run, drives, lost)
                time.sleep(0.6)
            finally:
                run.kill()
                run.stdin.close()
                run.stdout.close()
                if self.vfd:
                    self.turned = self.vfd.rows()
                    self.vfd.process.kill()
                    self.vfd.process.wait()
                if lost is not None:
                    drives[lost].process.send_signal(signal.SIGCONT)
                answering = [k for k in range(3) if not (lost == k and self.situation == "dead drive")]
                for k in answering:
                    self.problems += drives[k].stop()
            with open(os.path.join(folder, "errors"), encoding="utf-8") as file:
                sentence = file.read().strip()
            if self.signals == "SIGTSTP first":
                sentence = sentence.split("\n")[-1]  # the hold was told before
            self.told = f"{self.target}, {self.signals}, {self.situation}: exit {run.returncode} {sentence}"
            if ended is not None:
                self.judge(folder, run.returncode, sentence, drives, lost, points, asked, ended,
                           addresses[lost] if lost is not None else "")

    def stop(self, run, drives, lost):
        """When the (last) signal was sent and when the program had ended, by CLOCK_MONOTONIC."""
        time.sleep(self.at_s)
        if lost is not None:
            drives[lost].process.send_signal(signal.SIGSTOP if self.situation == "frozen drive" else signal.SIGKILL)
            self.loss = time.monotonic()
            time.sleep(self.before_s)
        self.early = run.poll() is not None
        *first, last = SIGNALS[self.signals]
        if first and first[0] in STEERING:
            run.send_signal(getattr(signal, first[0]))
            time.sleep(self.gap_s)
            self.early = self.early or run.poll() is not None
            run.send_signal(getattr(signal, last))
            if first[0] == "SIGTSTP":
                run.send_signal(signal.SIGCONT)
        else:
            run.send_signal(getattr(signal, last))
        asked = time.monotonic()
        if self.signals.endswith("twice"):
            time.sleep(self.gap_s)
            # Two of a kind may be one to the kernel before a thread was woken for the first; two kinds never are.
            run.send_signal(signal.SIGINT if self.gap_s > 0.01 else signal.SIGTERM)
            asked = time.monotonic()
        while run.poll() is None and time.monotonic() < asked + EXIT_S:
            time.sleep(0.001)
        if run.returncode is None:
            self.problems.append(f"the program does not end within {EXIT_S} s")
            return asked, None
        return asked, time.monotonic()

    def judge(self, folder, status, sentence, drives, lost, points, asked, ended, lost_address):
        _, _, stated, off_mm = TARGETS[self.target]
        self.standstill_s = 0.0
        begun_s = float("inf")
        ends = {}
        for k, drive in enumerate(drives):
            if k == lost:
                continue
            start = drive.start_s()
            rows = drive.shaft_rows()
            moved = [i for i in range(1, len(rows)) if rows[i][1] != rows[i - 1][1]]
            last_s = start + rows[moved[-1]][0] if moved else 0.0
            begun_s = min(begun_s, start + rows[moved[0]][0] if moved else begun_s)
            self.standstill_s = max(self.standstill_s, last_s - asked)
            at_exit = min(range(len(rows)), key=lambda i: abs(start + rows[i][0] - ended - MEASURED_S))
            self.after = max(self.after, abs(rows[-1][1] - rows[at_exit][1]))
            ends[k] = rows[-1][1] / STEPS
        self.check(self.after == 0, f"a shaft moved by {self.after} counts after the exit")
        still = all(place == 0.0 for place in ends.values())
        self.judge_state(folder, ends, still)
        if self.vfd and self.turned:
            self.check(self.turned[-1][2] == 0 and self.turned[-1][1] == 0, f"the spindle is left as {self.turned[-1]}")
        if self.early and status == 1:
            self.standstill_s = None  # a host that is busy may keep a run from starting; nobody stopped it
            return
        finished = status == 0 and self.situation not in ("stalled input", "full pipe")
        if finished:
            self.check(sentence == "", f"done, and yet: {sentence}")
            return
        if status < 0:  # the signal came before the program had begun to take signals
            self.check(still, "killed, and something was moved")
            return
        how = "twice" if self.signals.endswith("twice") else "once"
        if how == "once" and abs(begun_s - asked) < START_S + MEASURED_S and "about a start" in stated:
            how = "about a start"
        limit_s = stated[how]
        if self.standstill_s > limit_s:
            self.problems.append(OffTime.too_long(self.standstill_s, limit_s, "to standstill"))
        self.check(status == 1, f"exit status {status}")
        self.check(sentence.count("\n") == 0 and sentence.startswith("splinefeed: "), f"no sentence: {sentence}")
        self.check(not [name for name in os.listdir(folder) if name.endswith(".tmp")], "a temporary file is left behind")
        if NEVER_MOVED in sentence or "stands at" not in sentence:
            self.check(still, "something was moved, and it does not say where the machine stands")
            return
        before = self.loss is not None and asked - self.loss > 0.05
        if lost is not None and "all drives were held" in sentence:
            self.check(not before, "it claims to have held a drive that did not answer")
        if before:
            self.check(lost_address in sentence or "when it was last heard" in sentence,
                       "it says nothing of the drive that does not answer")
        if lost is None:
            self.check("interrupted" in sentence or still, "it does not say that it was interrupted")
        self.where(sentence, ends)
        if "held on the path" in sentence and lost is None:
            place = [ends[k] for k in range(3)]
            off = min(distance(place, a, b) for a, b in zip(points, points[1:]))
            self.check(off <= off_mm, f"held {off:.3f} mm off the path")

    def judge_state(self, folder, ends, still):
        path = os.path.join(folder, "state.json")
        if not os.path.exists(path):
            self.check(still, "something was moved, and there is no state")
            return
        with open(path, encoding="utf-8") as file:
            kept = json.load(file)["position_mm"]
        for k, place in ends.items():
            self.check(kept[k] is None or abs(kept[k] - place) <= 2.0 / STEPS + 1e-4,
                       f"{'xyz'[k]} stands at {place:.4f}, and the state says {kept[k]}")

    def where(self, sentence, ends):
        stated = re.findall(r" ([xyz])=(-?[0-9.]+)( \(when)?", sentence)
        self.check(len(stated) == 3, "it does not say where the machine stands")
        for name, value, old in stated:
            k = "xyz".index(name)
            if k in ends and not old:
                self.check(abs(float(value) - ends[k]) <= 2.0 / STEPS + 1e-4,
                           f"{name} stands at {ends[k]:.4f}, not {value}")


def write_slowly(path, text):
    """A machine file whose first byte comes late, and its second half later."""
    try:
        with open(path, "w", encoding="ascii") as file:
            for part in (text[:1], text[1:len(text) // 2], text[len(text) // 2:]):
                time.sleep(0.15)
                file.write(part)
                file.flush()
    except OSError:
        pass  # the program has gone


def distance(place, a, b):
    along = [q - p for p, q in zip(a, b)]
    length = sum(d * d for d in along)
    part = min(max(sum((x - p) * d for x, p, d in zip(place, a, along)) / length, 0.0), 1.0) if length > 0 else 0.0
    return math.dist(place, [p + part * d for p, d in zip(a, along)])


def one(options, seed):
    """A run whose times a host that stood still explains is made again; what else is wrong is wrong at once."""
    for attempt in range(ATTEMPTS):
        run = Run(options.tool, seed)
        try:
            with HostWatch() as watch:
                run.execute()
        except (OSError, ValueError, IndexError, subprocess.TimeoutExpired) as error:
            run.problems.append(f"{type(error).__name__}: {error}")
            return run
        excused = [p for p in run.problems if isinstance(p, OffTime) and p.stall_s <= watch.longest_s]
        if not excused:
            return run
        print(f"--seed {run.seed}: the host stood still for {watch.longest_s:.3f} s, attempt {attempt + 1} of {ATTEMPTS}: "
              f"{excused[0]}", flush=True)
        if len(excused) < len(run.problems):
            return run
    run.problems.clear()
    run.standstill_s = None
    run.judged = False
    return run


def print_table(runs):
    """Worst time to standstill by target and situation (rows) and signals (columns), and most counts after the exit."""
    judged = [run for run in runs if run.standstill_s is not None]
    print(f"| target | situation | runs | {' | '.join(SIGNALS)} | counts after the exit |\n" + "|---" * (4 + len(SIGNALS)) + "|")
    for target in TARGETS:
        for situation in SITUATIONS:
            row = [run for run in judged if (run.target, run.situation) == (target, situation)]
            cells = []
            for signals in SIGNALS:
                times = [run.standstill_s for run in row if run.signals == signals]
                cells.append(f"{max(times):.3f} s" if times else "")
            after = max((run.after for run in row), default=0)
            print(f"| {target} | {situation} | {len(row)} | {' | '.join(cells)} | {after:.0f} |")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("tool", type=os.path.abspath)
    parser.add_argument("--runs", type=int, default=30)
    parser.add_argument("--long-runs", type=int, default=0, help="so many where SPLINEFEED_LONG is 1")
    parser.add_argument("--seed", type=int, default=None)
    parser.add_argument("--jobs", type=int, default=4)
    parser.add_argument("--verbose", action="store_true")
    options = parser.parse_args()
    if why := missing_for("rtu"):
        print(why)
        TARGETS.pop("leadshine-pr, rtu")
    if why := pymodbus_missing():
        print(why)
        SITUATIONS.remove("spindle")
    if options.long_runs > 0 and os.environ.get("SPLINEFEED_LONG") == "1":
        options.runs = options.long_runs
    for ignored in (signal.SIGINT, signal.SIGQUIT, signal.SIGHUP):  # by a shell's & or nohup; a tool would ignore them, too
        signal.signal(ignored, signal.SIG_DFL)
    seed = options.seed if options.seed is not None else random.SystemRandom().randrange(10**9)
    print(f"seed {seed}, {options.runs} runs", flush=True)
    runs = []
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for run in pool.map(lambda i: one(options, seed + i), range(options.runs)):
            runs.append(run)
            if run.problems or options.verbose:
                print(f"--seed {run.seed} --runs 1: after {run.at_s:.3f} s: {run.told}", flush=True)
            for problem in run.problems[:5]:
                print(f"    {problem}", flush=True)
    print_table(runs)
    failed = sum(1 for run in runs if run.problems)
    print(f"{failed} of {options.runs} runs failed")
    if failed:
        return 1
    if not all(run.judged for run in runs):
        print("SKIPPED: this host stood still too often to judge the times of each run; the rest of what they did was right")
        return 77
    return 0


if __name__ == "__main__":
    sys.exit(main())
