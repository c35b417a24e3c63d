#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Step and direction lines as the kernel saw them: trace_edges.py trace.txt --lines lines.csv [--against edges.csv] ...

Reads the text of the kernel's trace (events gpio_value and gpio_direction) and says for each axis how often it stepped and how
near edges came to each other. Written from the format of the trace alone; nothing of splinefeed's engines is in it.
Times are in us of the trace's clock, whole ones, as the kernel prints them: a difference of two may be off by 1 us.
"""
import argparse
import bisect
import csv
import re
import sys
from typing import NamedTuple

EVENT = re.compile(r"\s(\d+)\.(\d{6}): gpio_(?:value|direction): (\d+)\s+(set|get|out|in) \(?(-?\d+)\)?\s*$")
WRITTEN = re.compile(r"^# entries-in-buffer/entries-written: (\d+)/(\d+)")


class Event(NamedTuple):
    """kind is `set` or `get` with the level, or `out` or `in` with the kernel's error."""
    t_us: int
    number: int
    kind: str
    value: int


class Edge(NamedTuple):
    """line is `step` or `dir`, value the level after the edge."""
    t_us: float
    axis: str
    line: str
    value: int


class Wiring(NamedTuple):
    """How a drive takes the lines of one axis."""
    invert_step: bool = False
    invert_dir: bool = False
    step_on_edge: bool = False


class Axis(NamedTuple):
    """What one axis did. steps: (t_us, count afterwards); the least times are None where nothing was to be measured.
    hold_us counts from the end of a pulse to a change of direction (0 inside a pulse), hold_from_step_us from the step."""
    up: int
    down: int
    steps: list
    setup_us: float | None
    hold_us: float | None
    hold_from_step_us: float | None
    step_length_us: float | None
    step_space_us: float | None

    @property
    def count(self):
        return self.up - self.down

    def count_at(self, t_us):
        """The count at an instant, that of a step included; 0 before the first one."""
        index = bisect.bisect_right(self.steps, t_us, key=lambda step: step[0])
        return self.steps[index - 1][1] if index else 0


def read_trace(path):
    """All events in order. ValueError where the kernel lost some, or a line is not understood."""
    events = []
    with open(path, encoding="utf-8") as file:
        for number, text in enumerate(file, 1):
            written = WRITTEN.match(text)
            if (written and written[1] != written[2]) or "LOST" in text:
                raise ValueError(f"{path}:{number}: events were lost: {text.strip()}")
            if text.startswith("#") or not text.strip():
                continue
            match = EVENT.search(text)
            if match:
                events.append(Event(int(match[1]) * 1_000_000 + int(match[2]), int(match[3]), match[4], int(match[5])))
            elif "gpio_" in text:
                raise ValueError(f"{path}:{number}: not understood: {text.strip()}")
    return events


def read_lines(path):
    """number -> (axis, line) of the lines that are called AXIS_STEP or AXIS_DIR in run.sh's lines.csv."""
    with open(path, encoding="utf-8", newline="") as file:
        matches = [(int(row["number"]), re.fullmatch(r"(\w+)_(STEP|DIR)", row["name"])) for row in csv.DictReader(file)]
    return {number: (match[1].lower(), match[2].lower()) for number, match in matches if match}


def line_edges(events, lines):
    """Changes of level of `lines` (number -> (axis, line)) while they are outputs. A write of the level that was there already
    is none, and the level that a request begins with is none either."""
    # The kernel notes the level of a request first and then that the line is an output.
    beginnings, last_set = set(), {}
    for index, event in enumerate(events):
        if event.kind == "set":
            last_set[event.number] = index
        elif event.kind == "out" and event.number in last_set:
            beginnings.add(last_set[event.number])
    levels, edges = {}, []
    for index, event in enumerate(events):
        if event.number not in lines or event.kind != "set":
            continue
        if index not in beginnings and levels.get(event.number, event.value) != event.value:
            edges.append(Edge(event.t_us, *lines[event.number], event.value))
        levels[event.number] = event.value
    return edges


def read_plan(path):
    """Edges of a file of `splinefeed plan --edges`."""
    with open(path, encoding="utf-8", newline="") as file:
        rows = csv.DictReader(row for row in file if not row.startswith("#"))
        return [Edge(int(row["t_ns"]) / 1000, row["axis"], row["line"], int(row["value"])) for row in rows]


def least(values):
    return min(values, default=None)


def follow(edges, axis, wiring=Wiring()):
    """The drive of one axis: Axis from all edges. Before the first edge the lines are idle, the direction downwards."""
    up, active = False, False
    totals = {True: 0, False: 0}
    steps, setups, holds, holds_from_step, highs, lows = [], [], [], [], [], []
    turned = stepped = rose = fell = None
    for edge in edges:
        if edge.axis != axis:
            continue
        if edge.line == "dir":
            up = bool(edge.value) != wiring.invert_dir
            turned = edge.t_us
            if stepped is not None:
                holds_from_step.append(turned - stepped)
                pulse_over = wiring.step_on_edge or not active
                holds.append(turned - (stepped if wiring.step_on_edge else fell) if pulse_over else 0)
            continue
        active = bool(edge.value) != wiring.invert_step
        if active:
            if fell is not None:
                lows.append(edge.t_us - fell)
            rose = edge.t_us
        else:
            if rose is not None:
                highs.append(edge.t_us - rose)
            fell = edge.t_us
        if active or wiring.step_on_edge:
            if turned is not None:
                setups.append(edge.t_us - turned)
                turned = None
            totals[up] += 1
            stepped = edge.t_us
            steps.append((stepped, totals[True] - totals[False]))
    return Axis(totals[True], totals[False], steps, least(setups), least(holds), least(holds_from_step), least(highs), least(lows))


def axes_of(edges):
    return sorted({edge.axis for edge in edges})


def compare(edges, plan, wirings=None):
    """What differs between the edges of a trace and those of a plan, as sentences: each line must have made the same sequence of
    levels, and each axis the same sequence of steps up and down. An empty list: the same motion."""
    problems = []
    for axis in sorted({*axes_of(edges), *axes_of(plan)}):
        for line in ("step", "dir"):
            made, meant = ([e.value for e in some if (e.axis, e.line) == (axis, line)] for some in (edges, plan))
            if made != meant:
                problems.append(f"{axis} {line}: {len(made)} edges of {len(meant)}{first_difference(made, meant)}")
        wiring = (wirings or {}).get(axis, Wiring())
        made, meant = ([count for _, count in follow(some, axis, wiring).steps] for some in (edges, plan))
        if made != meant:
            problems.append(f"{axis}: count {(made or [0])[-1]} instead of {(meant or [0])[-1]}{first_difference(made, meant)}")
    return problems


def first_difference(made, meant):
    for index, (one, other) in enumerate(zip(made, meant)):
        if one != other:
            return f", first difference at number {index}: {one} instead of {other}"
    return ""


def lateness(edges, plan):
    """us by which each edge came later than in the plan, the earliest counted as 0 (the clocks have no common start). Only of
    edges that `compare` finds the same; in order of the plan."""
    made = {}
    for edge in edges:
        made.setdefault((edge.axis, edge.line), []).append(edge.t_us)
    times = {key: iter(values) for key, values in made.items()}
    late = [next(times[edge.axis, edge.line]) - edge.t_us for edge in plan]
    return [value - min(late) for value in late]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("trace")
    parser.add_argument("--lines", help="lines.csv of run.sh: names AXIS_STEP and AXIS_DIR are taken")
    parser.add_argument("--line", action="append", default=[], metavar="NUMBER=AXIS,step|dir",
                        help="one more line, by its number in the trace")
    parser.add_argument("--invert-step", action="append", default=[], metavar="AXIS")
    parser.add_argument("--invert-dir", action="append", default=[], metavar="AXIS")
    parser.add_argument("--step-on-edge", action="store_true")
    parser.add_argument("--against", metavar="EDGES_CSV", help="the plan: status 1 where the motion is another")
    parser.add_argument("--edges", metavar="CSV", help="writes rows t_us,axis,line,value")
    parser.add_argument("--counts", metavar="CSV", help="writes rows t_us,axis,count")
    options = parser.parse_args()

    lines = read_lines(options.lines) if options.lines else {}
    for text in options.line:
        number, _, axis_line = text.partition("=")
        lines[int(number)] = tuple(axis_line.split(","))
    edges = line_edges(read_trace(options.trace), lines)
    plan = read_plan(options.against) if options.against else []
    wirings = {axis: Wiring(axis in options.invert_step, axis in options.invert_dir, options.step_on_edge)
               for axis in axes_of(edges + plan)}
    axes = {axis: follow(edges, axis, wirings[axis]) for axis in wirings}
    print("axis,count,up,down,setup_us,hold_us,hold_from_step_us,step_length_us,step_space_us")
    for name, axis in axes.items():
        print(name, axis.count, axis.up, axis.down, *axis[3:], sep=",")
    if options.edges:
        write(options.edges, Edge._fields, edges)
    if options.counts:
        rows = [(t_us, name, count) for name, axis in axes.items() for t_us, count in axis.steps]
        write(options.counts, ("t_us", "axis", "count"), sorted(rows))
    if not options.against:
        return 0
    problems = compare(edges, plan, wirings)
    for problem in problems:
        print(problem)
    if not problems and plan:
        late = sorted(lateness(edges, plan))
        print(f"the plan's {len(plan)} edges; late by {late[len(late) // 2]:.0f} us (median), {late[-1]:.0f} us (worst)")
    return 1 if problems else 0


def write(path, heading, rows):
    with open(path, "w", encoding="utf-8", newline="") as file:
        csv.writer(file).writerows([heading, *rows])


if __name__ == "__main__":
    sys.exit(main())
