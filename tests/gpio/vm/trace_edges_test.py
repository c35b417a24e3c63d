#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""trace_edges.py on traces that are written down here: what it measures, and that it sees what is wrong."""
import sys
import tempfile
from pathlib import Path

from trace_edges import Edge, Event, Wiring, compare, follow, lateness, line_edges, read_lines, read_plan, read_trace

TRACE = """# tracer: nop
#
# entries-in-buffer/entries-written: {written}   #P:1
#
#           TASK-PID     CPU#  |||||  TIMESTAMP  FUNCTION
           a b-1       [000] .....     7.999990: gpio_value: 992 set 0
           a b-1       [000] .....     7.999991: gpio_direction: 992 out (0)
          <...>-2      [000] d..1.    12.000005: gpio_value: 992 set 1
          <...>-2      [000] d..1.    12.000006: gpio_value: 993 get 1
          <...>-2      [000] d..1.    12.000007: gpio_value: 992 set 1
          <...>-2      [000] d..1.    12.000008: gpio_direction: 1000  in (0)
"""
# x: two up (high 2, low 8), turned 3 after the pulse, one down after 5.
MOTION = [Edge(10, "x", "dir", 1), Edge(16, "x", "step", 1), Edge(18, "x", "step", 0), Edge(26, "x", "step", 1),
          Edge(29, "x", "step", 0), Edge(32, "x", "dir", 0), Edge(37, "x", "step", 1), Edge(40, "x", "step", 0)]


def fails(call, *words):
    try:
        call(*words)
    except ValueError:
        return True
    return False


def reading(folder):
    path = folder / "trace.txt"
    path.write_text(TRACE.format(written="6/6"))
    events = read_trace(path)
    assert [event.t_us for event in events] == [7999990, 7999991, 12000005, 12000006, 12000007, 12000008], events
    assert events[2] == Event(12000005, 992, "set", 1) and events[5] == Event(12000008, 1000, "in", 0), events
    assert line_edges(events, {992: ("x", "step")}) == [Edge(12000005, "x", "step", 1)]
    path.write_text(TRACE.format(written="6/9"))
    assert fails(read_trace, path)
    path.write_text(TRACE.format(written="6/6") + "CPU:0 [LOST 3 EVENTS]\n")
    assert fails(read_trace, path)
    path.write_text(TRACE.format(written="6/6") + "  a-1 [000] ..... 13.000000: gpio_value: x\n")
    assert fails(read_trace, path)
    (folder / "lines.csv").write_text("number,chip,offset,name\n992,cnc,0,X_STEP\n993,cnc,1,X2_DIR\n998,cnc,6,ENABLE\n999,cnc,7,\n")
    assert read_lines(folder / "lines.csv") == {992: ("x", "step"), 993: ("x2", "dir")}
    (folder / "edges.csv").write_text("t_ns,axis,line,value\n-1500,y2,dir,1\n3119750,y,step,1\n")
    assert read_plan(folder / "edges.csv") == [Edge(-1.5, "y2", "dir", 1), Edge(3119.75, "y", "step", 1)]


def requests():
    """A line that idles high begins there; a second request begins anew and is no edge either."""
    rows = [(1, "set", 1), (2, "out", 0), (3, "set", 0), (4, "set", 1), (9, "set", 0), (10, "out", 0), (11, "set", 1)]
    edges = line_edges([Event(t, 5, kind, value) for t, kind, value in rows], {5: ("x", "step")})
    assert [(edge.t_us, edge.value) for edge in edges] == [(3, 0), (4, 1), (11, 1)], edges


def measuring():
    axis = follow(MOTION, "x")
    assert (axis.up, axis.down, axis.count) == (2, 1, 1), axis
    assert axis[3:] == (5, 3, 6, 2, 8), axis
    assert [axis.count_at(t) for t in (15, 16, 30, 100)] == [0, 1, 2, 1], axis.steps
    inverted = [edge._replace(value=1 - edge.value) for edge in MOTION]
    assert follow(inverted, "x", Wiring(invert_step=True, invert_dir=True)) == axis
    assert follow(inverted, "x", Wiring(invert_step=True)).count == -1
    # Each edge a step; the direction changes 3 after the last one.
    on_edge = follow(MOTION, "x", Wiring(step_on_edge=True))
    assert (on_edge.up, on_edge.down) == (4, 2) and on_edge[3:] == (5, 3, 3, 2, 8), on_edge
    inside = MOTION[:2] + [Edge(17, "x", "dir", 0)] + MOTION[2:5]
    assert follow(inside, "x").hold_us == 0
    assert follow([], "x")[3:] == (None,) * 5


def comparing():
    late = [edge._replace(t_us=edge.t_us + 1000 + (7 if edge.t_us == 26 else 0)) for edge in MOTION]
    assert compare(late, MOTION) == []
    assert max(lateness(late, MOTION)) == 7 and min(lateness(late, MOTION)) == 0
    for index in range(len(MOTION)):
        assert compare(late[:index] + late[index + 1 :], MOTION), f"edge {index} is not missed"
    assert compare([*late, Edge(5000, "y", "step", 1)], MOTION)
    # The same sequences of both lines, but the direction came a step too late.
    order = [*late[:5], late[6], late[7], late[5]]
    assert compare(order, MOTION), "the order of step and direction is not seen"


def main():
    with tempfile.TemporaryDirectory() as folder:
        reading(Path(folder))
    requests()
    measuring()
    comparing()
    print("trace_edges: all as it should be")
    return 0


if __name__ == "__main__":
    sys.exit(main())
