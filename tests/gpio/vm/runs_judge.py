#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What runs_guest.sh left: runs_judge.py OUT_DIR. Each run's lines as the kernel's trace has them, against the edges that its plan
is, and what it said.

The trace has to show the same edges in the same order, over all axes: then every place that the motors came through is one that
the plan comes through, within half a step. Times are judged as distances that drives ask for."""
import csv
import json
import os
import re
import sys

from trace_edges import follow, line_edges, read_lines, read_trace

HIGH_US, LOW_US, SETUP_US, HOLD_US = 2, 2, 5, 5
AXES = "xyz"
UNITS = 3 << 30  # of --segments, in a count
JITTER_US = 150  # tolerated_late_us, and what a call takes in an emulated machine
STEPS_PER_MM = 4
NEAR_STEPS = 1  # a program's lines switch within a segment and a look: 2 ms at 50 mm/s are 0.4 steps

SAFE_NUMBERS = []  # enable and the step lines, in the trace


def split_trace(path):
    """The trace of each scenario, as a file of its own; the instant [us] of the marker `switch`."""
    head, parts, name, switch = [], {}, None, None
    with open(path, encoding="ascii", errors="replace") as file:
        for line in file:
            if line.startswith("#"):
                head.append(line)
            elif found := re.search(r"(\d+)\.(\d{6}): tracing_mark_write: (scenario (\w+)|switch)", line):
                if found[4]:
                    name = found[4]
                    parts[name] = []
                else:
                    switch = int(found[1]) * 1_000_000 + int(found[2])
            elif name:
                parts[name].append(line)
    for name, lines in parts.items():
        with open(f"{os.path.dirname(path)}/{name}.trace", "w", encoding="ascii") as file:
            file.writelines(head + lines)
    return switch


class Run:
    def __init__(self, out, name, wiring):
        self.name = name
        self.problems = []
        text = self.read(f"{out}/{name}.json")
        self.summary = json.loads(text) if text.startswith("{") else {}
        self.errors = self.read(f"{out}/{name}.err").strip()
        self.status = int(self.read(f"{out}/{name}.status"))
        events = read_trace(f"{out}/{name}.trace") if os.path.exists(f"{out}/{name}.trace") else []
        self.edges = line_edges(events, wiring)
        self.sets = [event for event in events if event.kind == "set"]
        self.last = {event.number: event.value for event in events if event.kind == "set"}
        segments = self.read(f"{out}/{name}.segments").splitlines()
        first = next((row.split(",") for row in segments if row[:1].isdigit()), None)
        self.start = [round(int(value) / UNITS) for value in first[2::4]] if first else [0, 0, 0]
        self.planned = self.read_plan(f"{out}/{name}.edges")

    @staticmethod
    def read(path):
        if not os.path.exists(path):
            return ""
        with open(path, encoding="utf-8", errors="replace") as file:
            return file.read()

    @staticmethod
    def read_plan(path):
        """Groups of edges of one instant: (t in us, {(axis, line, value)})."""
        groups = []
        if os.path.exists(path):
            with open(path, encoding="ascii") as file:
                for row in csv.DictReader(file):
                    edge = (row["axis"], row["line"], int(row["value"]))
                    if groups and groups[-1][0] == int(row["t_ns"]) / 1000:
                        groups[-1][1].add(edge)
                    else:
                        groups.append((int(row["t_ns"]) / 1000, {edge}))
        return groups

    def check(self, condition, text):
        if not condition:
            self.problems.append(text)

    def ended(self, status, *words):
        self.check(self.status == status, f"status {self.status}, not {status}: {self.errors}")
        for word in words:
            self.check(word in self.errors, f"does not say '{word}': {self.errors}")

    def left(self, enable):
        """What the lines were set to at last; released, those of the simulated chip follow their pull."""
        levels = [self.last.get(number) for number in SAFE_NUMBERS]
        self.check(levels == [enable, 0, 0, 0], f"enable and steps are left at {levels}")

    def safe(self):
        self.left(1)

    def follows_plan(self, complete=True):
        """The trace's edges are the plan's, in order; complete: all of them. Returns how many of the plan's were made."""
        made = 0
        at = 0
        for _, group in self.planned:
            seen = [(edge.axis, edge.line, edge.value) for edge in self.edges[at:at + len(group)]]
            if set(seen) != group:
                break
            at += len(group)
            made += 1
        self.check(not complete or made == len(self.planned), f"edge {made} of {len(self.planned)} is another one")
        # What comes behind them is that all lines take their safe levels: no step.
        rest = [edge for edge in self.edges[at:] if edge.line == "step" and edge.value == 1]
        self.check(not complete or not rest, f"{len(rest)} steps more than planned")
        return made, at

    def switched(self, number):
        """[(level, x in steps)] of each change of a line that a program switches."""
        levels = []
        for event in self.sets:
            if event.number == number and (not levels or levels[-1][0] != event.value):
                x = follow([edge for edge in self.edges if edge.axis == "x" and edge.t_us <= event.t_us], "x").count
                levels.append((event.value, x))
        return levels

    def switches(self, number, *meant):
        """Levels and where; the first one is that before the run."""
        seen = self.switched(number)
        near = len(seen) == len(meant) and all(a == b and abs(x - STEPS_PER_MM * mm) <= NEAR_STEPS
                                               for (a, x), (b, mm) in zip(seen, meant))
        self.check(near, f"line {number} has levels and places {seen} steps, not {meant} mm")

    def distances(self):
        for axis in AXES:
            seen = follow([edge for edge in self.edges if edge.axis == axis], axis)
            for what, most in (("step_length_us", HIGH_US), ("step_space_us", LOW_US), ("setup_us", SETUP_US), ("hold_us", HOLD_US)):
                value = getattr(seen, what)
                # Whole microseconds: a distance may be off by one. The last direction is that of the lines' safe levels.
                self.check(value is None or value >= most - 1, f"{axis}: {what} {value}")

    def counts(self):
        return [follow([edge for edge in self.edges if edge.axis == axis], axis).count for axis in AXES]

    def stretched_us(self):
        return 1e6 * self.summary["gpio"]["schedule_slip_s"]

    def catches_nothing_up(self):
        """However late an edge was, none behind it is earlier, but for what is no delay yet."""
        at, latest = 0, None
        for t_us, group in self.planned:
            if at >= len(self.edges):
                break
            late = self.edges[at].t_us - t_us
            at += len(group)
            latest = late if latest is None else max(late, latest)
            if late < latest - JITTER_US:
                self.problems.append(f"{latest - late:.0f} us were caught up at {t_us} us")
                break


def whole(run, status=0, *words):
    run.ended(status, *words)
    run.safe()
    run.follows_plan()
    run.distances()
    run.catches_nothing_up()
    return run


def judge(out):
    wiring = read_lines(f"{out}/lines.csv")
    with open(f"{out}/lines.csv", encoding="ascii") as file:
        rows = [row for row in csv.reader(file) if row[0].isdigit()]
    number = {row[3]: int(row[0]) for row in rows}
    elsewhere = {**wiring, next(int(row[0]) for row in rows if row[1:3] == ["aux", "3"]): ("z", "dir")}
    del elsewhere[number["Z_DIR"]]
    SAFE_NUMBERS.extend(number[name] for name in ("ENABLE", "X_STEP", "Y_STEP", "Z_STEP"))
    switch_us = split_trace(f"{out}/trace.txt")
    runs = {}

    def run(name, lines=wiring):
        runs[name] = Run(out, name, lines)
        return runs[name]

    path61 = whole(run("path61"))
    path61.check(path61.summary["gpio"]["edges"] > 2500, "few edges")
    whole(run("limit"), 1, "limit of axis x (", "X_LIMIT) acts: held on the path", "; the machine stands at x=")
    at = run("estop")
    at.ended(1, "the e-stop was pressed: the drives were disabled", "is not known")
    at.safe()
    made, last = at.follows_plan(complete=False)
    at.check(0 < made < len(at.planned), "it is over before the e-stop")
    at.check(not [edge for edge in at.edges[last:] if edge.line == "step" and edge.value == 1], "steps behind the cut")
    run("estop_at_once").ended(1, "the e-stop (", "release it")
    probe = whole(run("probe"))
    touched = [change for change in probe.summary["gpio"]["changes"] if change["role"] == "probe" and change["active"]]
    probe.check(len(touched) == 1, "the probe did not touch once")
    if touched:
        t_us = 1e6 * (touched[0]["time_s"] + probe.summary["gpio"]["began_monotonic_s"])
        counts = [begin + follow([edge for edge in probe.edges if edge.axis == axis and edge.t_us <= t_us], axis).count
                  for axis, begin in zip(AXES, probe.start)]
        told = [round(STEPS_PER_MM * mm) for mm in touched[0]["position_mm"]]
        probe.check(all(abs(a - b) <= 1 for a, b in zip(counts, told)), f"the probe is told at {told}, and was at {counts}")

    stalled = run("stalled")
    stalled.ended(1, "no step was made for longer than 40 ms", "is not known")
    stalled.safe()
    still = whole(run("stands_still"))
    still.check(still.summary["gpio"]["schedule_slip_s"] > 0.15, f"stretched by {still.summary['gpio']['schedule_slip_s']} s")
    changes = [change for change in still.summary["gpio"]["changes"] if change["role"] == "probe"]
    still.check(changes and changes[-1]["active"], "the last level of the probe was not noticed")
    steering = whole(run("steering"))
    longest = max(b.t_us - a.t_us for a, b in zip(steering.edges, steering.edges[1:]))
    steering.check(longest > 300_000, "it did not stand")
    whole(run("sigterm"), 1, "interrupted: held on the path")
    for name in ("sigsegv", "sigkill"):
        run(name).check(runs[name].status in (128 + 11, 128 + 9), f"status {runs[name].status}")
    runs["sigsegv"].safe()

    coolant, output = number["COOLANT"], number["SPINDLE"]
    for name in ("outputs", "outputs_held"):
        program = whole(run(name))
        program.switches(coolant, (0, 0), (1, 0), (0, 60))
        program.switches(output, (1, 0), (0, 20), (1, 40))
    held = [Run.read(f"{out}/held_{what}").strip() for what in ("output", "coolant")]
    runs["outputs_held"].check(held == ["0", "1"], f"in the hold output and coolant are {held}")
    program = run("outputs_estop")
    program.ended(1, "the e-stop was pressed: the drives were disabled")
    program.safe()
    for line, levels in ((coolant, [0, 1, 0]), (output, [1, 0, 1])):
        program.check([level for level, _ in program.switched(line)] == levels, f"line {line} has {program.switched(line)}")

    spindle = number["DOOR"]
    program = whole(run("spindle_lines"))
    program.switches(spindle, (0, 0), (1, 10), (0, 30))
    on_us = next((event.t_us for event in program.sets if event.number == spindle and event.value == 1), 0)
    next_us = next((edge.t_us for edge in program.edges if edge.t_us > on_us and edge.line == "step"), on_us)
    program.check(next_us - on_us > 490_000, f"it cuts {next_us - on_us} us after the spindle was on, and its speed came after 500000")
    program = run("spindle_estop")
    program.ended(1, "the e-stop was pressed: the drives were disabled")
    program.safe()
    program.check([level for level, _ in program.switched(spindle)] == [0, 1, 0], f"the spindle is {program.switched(spindle)}")

    if os.path.exists(f"{out}/square.status"):
        for name in ("square", "star", "fixed", "busy"):
            whole(run(name))
        whole(run("two_chips", elsewhere))
        run("limit_at_once").ended(1, "the limit of axis x", "--home")
        fault = run("drive_fault")  # stopped by the port, not by the plan
        fault.ended(1, "the drive-fault (", "held on the path; the machine stands at x=")
        fault.safe()
        run("probe_nothing").ended(1, "the probe did not touch")
        home = run("home")
        home.ended(0)
        home.safe()
        x = [edge for edge in home.edges if edge.axis == "x"]
        # The switch is at 5 mm, and the program ends where it begins.
        way = follow(x, "x").count - follow([edge for edge in x if edge.t_us <= switch_us], "x").count
        home.check(abs(way - (home.start[0] - 5 * STEPS_PER_MM)) <= 2, f"from the switch to the end are {way} steps")
        run("home_nothing").ended(1, "axis x does not find its reference", "X_HOME) does not act within")
        runs["limit_at_once"].check(not runs["limit_at_once"].edges, "it moved")

    run("line_busy").ended(1, "X_STEP", "splinefeed")
    whole(run("holder"))
    run("wrong_name").ended(1, "X_STEPP", "X_STEP")
    run("wrong_offset").ended(1, "Y_DIR")
    run("wrong_chip").ended(1, "/dev/gpiochip7")
    run("wrong_label").ended(1, "there is no GPIO chip with the label 'none'; this machine has /dev/gpiochip")
    run("chip_vanishes").ended(1, "No such device")
    for name in ("estop_at_once", "wrong_name", "wrong_offset", "wrong_chip", "wrong_label"):
        runs[name].check(not runs[name].edges, "it moved")
    return runs


def main():
    runs = judge(sys.argv[1])
    for name, run in runs.items():
        gpio = run.summary.get("gpio", {})
        late = f", 99 % within {1e6 * gpio['p99_late_s']:.0f} us, latest {1e6 * gpio['most_late_s']:.0f} us" if gpio else ""
        print(f"{name}: status {run.status}, {len(run.edges)} edges{late} {run.errors[:110]}")
    failed = [f"{name}: {problem}" for name, run in runs.items() for problem in run.problems]
    print("\n".join(failed))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
