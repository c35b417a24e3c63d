#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Judges a run by its files alone, by nothing that the planner computes with. Prints one JSON object.

    judge.py --machine M.toml --curve C.json --trace T.csv [--segments S.csv] [--waypoints PROGRAM] [--least acceleration|jerk]

M.toml is what the run was made with, the others are what it wrote: --curve-out, --trace, --segments. PROGRAM is its waypoints
.csv or curve .json, which the curve has to meet. Programmed feeds and events are not looked at. All outputs:

  cycle_time_s, samples      from the first to the last motion; rows of the trace
  use                        of velocity, acceleration (and braking), jerk by axis, and of feed: 1 is at the limit
  use_between                the same at any instant between the samples (with --segments)
  segments                   jumps between segments, and how far the trace is from them (with --segments)
  path_error_mm              the farthest sample from the curve
  waypoint_error_mm          the farthest waypoint from the curve (with --waypoints)
  joints                     the largest gap_mm, turn_rad, curvature_jump (relative, and in 1/mm) between pieces; corners
  least_time_s, over_least   the least time with limited acceleration, or jerk as well, at rest at corners; the cycle time over it

Needs python3-numpy and python3-scipy."""
import argparse
import json

import numpy as np

from bezier_chain import BezierChain
from curve_distance import CurveDistance
from joints import joint_jumps
from least_jerk_time import least_jerk_time
from least_time import least_time
from machine_limits import MachineLimits
from path_grid import PathGrid
from segment_cubics import SegmentCubics
from motion_trace import Trace
from waypoints import chain_ends, read_waypoints

INTERVALS = {"acceleration": 10000, "jerk": 3000}
SETTLED = {"acceleration": 3e-4, "jerk": 5e-3}  # of the time: what twice the intervals may change; the error is a third of it
A_PIECE = {"acceleration": 16, "jerk": 4}  # intervals at least, so that twice as many are more everywhere
A_RUN = 400
DOUBLINGS = 4


def on_grid(runs, limits, kind, intervals):
    """The least time over these runs, from rest to rest each, on a grid of so many intervals."""
    size = [sum(piece.polygon_length for piece in run) for run in runs]
    seconds = 0.0
    for run, part in zip(runs, size):
        count = int(intervals * (0.5 * part / sum(size) + 0.5 / len(runs)))
        if kind == "jerk" and np.isfinite(limits.jerk).any():
            seconds += least_jerk_time(run, limits, count)
        else:
            seconds += least_time(PathGrid.even(run, count), limits)[0]
    return seconds


def least(chain, limits, kind, intervals=None):
    """The least time over the smooth runs of a curve, on grids finer and finer until it settles; and the stops between them."""
    runs = chain.smooth_runs()
    intervals = max(intervals or INTERVALS[kind], A_PIECE[kind] * len(chain.pieces), A_RUN * len(runs))
    coarse = on_grid(runs, limits, kind, intervals // 2)
    for _ in range(DOUBLINGS):
        seconds = on_grid(runs, limits, kind, intervals)
        if abs(seconds - coarse) <= SETTLED[kind] * seconds:
            return seconds, len(runs) - 1
        coarse, intervals = seconds, 2 * intervals
    raise ValueError(f"the least time does not settle: {coarse} s on {intervals // 2} intervals")


def by_axis(uses, limits):
    """The uses of Trace and SegmentCubics for JSON: by name of the axis, without those that have no limit."""
    names = {kind: dict(zip(limits.names, map(float, use))) for kind, use in uses.items() if kind != "feed"}
    if not np.isfinite(limits.jerk).any():
        del names["jerk"]
    return {**names, "feed": uses["feed"]}


def largest(uses):
    """Of all limits and axes."""
    return max(max(use.values()) if isinstance(use, dict) else use for use in uses.values())


def judged(limits, chain, trace, segments=None, waypoints=None, kind=None):
    """What the head of this file says, as a dict."""
    distance = CurveDistance(chain)
    found = {"cycle_time_s": trace.cycle_time, "samples": len(trace.times), "use": by_axis(trace.uses(limits), limits),
             "path_error_mm": float(distance.of(trace.positions).max()), "joints": joint_jumps(chain)}
    if segments is not None:
        found["use_between"] = by_axis(segments.uses(limits), limits)
        gap, jump = segments.gaps()
        apart = float(np.abs(segments.position_at(trace.times) - trace.positions).max())
        found["segments"] = {"gap_mm": gap, "velocity_jump_mm_s": jump, "from_trace_mm": apart}
    if waypoints is not None:
        found["waypoint_error_mm"] = float(distance.of(waypoints).max())
    if kind:
        found["least_time_s"], found["stops"] = least(chain, limits, kind)
        found["over_least"] = found["cycle_time_s"] / found["least_time_s"]
    return found


def judged_files(machine, curve, trace, segments=None, program=None, kind=None):
    """The same of files; those that are None are not there."""
    limits = MachineLimits.read(machine)
    axes = limits.names
    waypoints = None
    if program:
        is_curve = str(program).endswith(".json")
        waypoints = chain_ends(BezierChain.read(program, len(axes))) if is_curve else read_waypoints(program, axes)
    return judged(limits, BezierChain.read(curve, len(axes)), Trace.read(trace, axes),
                  SegmentCubics.read(segments, axes) if segments else None, waypoints, kind)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ("machine", "curve", "trace"):
        parser.add_argument("--" + name, required=True)
    for name in ("segments", "waypoints"):
        parser.add_argument("--" + name)
    parser.add_argument("--least", choices=list(INTERVALS))
    options = parser.parse_args()
    print(json.dumps(judged_files(options.machine, options.curve, options.trace, options.segments, options.waypoints,
                                  options.least), indent=1))


if __name__ == "__main__":
    main()
