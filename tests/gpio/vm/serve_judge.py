#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What serve_guest.sh left: serve_judge.py OUT_DIR. Wherever the controller said that it stands, the kernel's trace of the step
lines has to have the same count of steps; and no step is made where none may be."""
import pathlib
import re
import sys

from runs_judge import HIGH_US, HOLD_US, LOW_US, SETUP_US, STEPS_PER_MM
from trace_edges import follow, line_edges, read_lines, read_trace

MARK = re.compile(r"(\d+)\.(\d{6}): tracing_mark_write: (\w+) ?(\S*) ?(\S*)")
SWITCH_MM, PULL_OFF_MM = 5, 2  # lines.toml
NEAREST = 0.51  # a place between two steps, in the three digits of a status: the lines made the nearer one
REACTION_US = 2000  # a port looks at its e-stop each millisecond at least


def main():
    out = pathlib.Path(sys.argv[1])
    edges = line_edges(read_trace(out / "trace.txt"), read_lines(out / "lines.csv"))
    axes = [follow([edge for edge in edges if edge.axis == axis], axis) for axis in "xyz"]
    steps_us = [edge.t_us for edge in edges if edge.line == "step" and edge.value == 1]
    problems, places, at = [], {}, {}
    origin, origins = [0, 0, 0], {}
    for text in (out / "trace.txt").read_text(encoding="ascii", errors="replace").splitlines():
        if not (found := MARK.search(text)):
            continue
        t_us, word = int(found[1]) * 1_000_000 + int(found[2]), found[3]
        at[word] = t_us
        name, told = (found[4], found[5]) if word == "place" else (word, found[4])
        if not told:
            continue
        said = [STEPS_PER_MM * float(mm) for mm in told.split(",")]
        counts = [axis.count_at(at["touch"] if word == "touched" else t_us) for axis in axes]
        if name in ("homed", "behind_estop"):  # counts from elsewhere from here on
            origin = [round(a - b) for a, b in zip(said, counts)]
            origins[name] = origin
        places[name] = said
        off = max(abs(a - b - c) for a, b, c in zip(said, counts, origin))
        if off > (1 if word == "touched" else NEAREST):
            problems.append(f"{name}: it says {said}, the lines made {[a + b for a, b in zip(counts, origin)]} steps")

    def check(true, text):
        problems.extend([] if true else [text])

    def still(begin, end, what):
        made = sum(begin < t_us < end for t_us in steps_us)
        check(made == 0, f"{made} steps {what}")

    check(places["program"] == [40, 20, 0], f"the program ends at {places['program']}")
    check(40 < places["jog_cancelled"][0] < 280 and places["jog"][0] == places["jog_cancelled"][0] - 9, f"jogs: {places}")
    check(places["resumed"] == [320, 80, 0] and places["held"][0] < 320, f"hold: {places}")
    still(at["resume"] - 300_000, at["resume"], "in the hold")
    check(40 < places["reset"][0] < 320, f"reset: {places}")
    check(places["homed"][0] == STEPS_PER_MM * (SWITCH_MM + PULL_OFF_MM), f"homed at {places['homed']}")
    switch = axes[0].count_at(at["switch"]) + origins["homed"][0]
    check(abs(switch - STEPS_PER_MM * SWITCH_MM) <= 2, f"the switch is at {switch} steps")
    check(places["probed"][0] >= places["touched"][0], f"probe: {places}")
    for name in ("X_LIMIT", "FAULT"):
        check(places[f"before_{name}"][0] == 40 and 40 < places[f"at_{name}"][0] < 320, f"{name}: {places}")
    still(at["estop"] + REACTION_US, at["estop_over"], "behind the e-stop")
    check(places["at_last"][0] == places["behind_estop"][0] + 14, f"behind the e-stop: {places}")
    still(at["gone"] + 100_000, at["gone"] + 1e9, "of a chip that is gone")
    for axis, name in zip(axes, "xyz"):
        for what, least in (("step_length_us", HIGH_US), ("step_space_us", LOW_US), ("setup_us", SETUP_US), ("hold_us", HOLD_US)):
            value = getattr(axis, what)
            check(value is None or value >= least - 1, f"{name}: {what} {value}")
    files = {name: (out / name).read_text().split() for name in ("coolant", "alarms", "enable", "served")}
    check(files == {"coolant": ["1", "0"], "alarms": ["ALARM:1", "ALARM:17"], "enable": ["1"], "served": ["1"]}, f"{files}")
    print(f"{len(edges)} edges, {len(places)} places: {', '.join(places)}")
    print("\n".join(problems))
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
