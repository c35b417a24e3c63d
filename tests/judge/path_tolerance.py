#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Whether a run kept the tolerance of its program, by files alone. Prints one JSON object; exit status 1: it did not.

    path_tolerance.py --program ELEMENTS.json|WAYPOINTS.csv --trace T.csv [--machine M.toml] [--tolerance MM]

The program is followed in order: a sample belongs to no piece before that of the sample before it. Linear axes are measured
together, and rotary ones, in degrees. All outputs:

  kept              every distance is at most what its element allows, and slack_mm
  deviation_mm      the largest distance of a sample from the program, and at_element (from 1)
  coverage_mm       the largest distance of the program from the trace, and at_element
  over_mm           the largest distance beyond what its element allows, chords between samples aside
  slack_mm          what a sample period smoothes, 1e-5 for chords of arcs and splines, and 1e-6
  deviation_deg, coverage_deg, over_deg    of rotary axes, if there are any

Needs python3-numpy."""
import argparse
import json
import sys
import tomllib

import numpy as np

from element_path import CHORD_MM, JOINT_MM, ElementPath, read_elements
from motion_trace import Trace

BLOCK = 256  # pieces looked at at once


def from_pieces(point, starts, ways):
    """Distances of a point from straight pieces."""
    apart = point - starts
    size = np.einsum("ij,ij->i", ways, ways)
    part = np.clip(np.einsum("ij,ij->i", apart, ways) / np.where(size > 0.0, size, 1.0), 0.0, 1.0)
    return np.linalg.norm(apart - part[:, None] * ways, axis=1)


def first_within(point, starts, ways, most, begin):
    """The first piece from `begin` on that is near enough; len(starts) if there is none."""
    for low in range(begin, len(starts), BLOCK):
        near = from_pieces(point, starts[low:low + BLOCK], ways[low:low + BLOCK]) <= most[low:low + BLOCK]
        if near.any():
            return low + int(near.argmax())
    return len(starts)


def earliest(samples, starts, ways, most):
    """For each sample the first piece that it may belong to, if those before it belong to theirs. A sample that is near no piece
    from there on keeps the place of the one before."""
    found, at = np.zeros(len(samples), int), 0
    for i, sample in enumerate(samples):
        piece = first_within(sample, starts, ways, most, at)
        at = piece if piece < len(starts) else at
        found[i] = at
    return found


def measured(path, samples, slack, chord):
    """(largest distance of a sample, its element), (largest distance of the program, its element), largest excess.

    chord: how far the motion may be from the chords between its samples."""
    most = path.allowed[path.owner] + slack
    low = earliest(samples, path.starts, path.ways, most)
    ends = path.starts + path.ways
    count = len(most)
    high = count - 1 - earliest(samples[::-1], ends[::-1], -path.ways[::-1], most[::-1])[::-1]
    high = np.maximum(high, low)
    deviation = (-1.0, 0)
    over = -np.inf
    for sample, a, b in zip(samples, low, high):
        distance = from_pieces(sample, path.starts[a:b + 1], path.ways[a:b + 1])
        nearest = int(distance.argmin())
        if distance[nearest] > deviation[0]:
            deviation = (float(distance[nearest]), int(path.owner[a + nearest]))
        over = max(over, float((distance - path.allowed[path.owner[a:b + 1]]).min()))
    # The program: the ends of its pieces, and the middle of long ones.
    steps = np.diff(samples, axis=0)
    coverage = (-1.0, 0)
    lengths = np.linalg.norm(path.ways, axis=1)
    for j in range(count):
        begin = max(int(np.searchsorted(high, j, "left")) - 1, 0)
        end = min(int(np.searchsorted(low, j, "right")) + 1, len(steps))
        shares = np.linspace(0.0, 1.0, 2 + min(int(lengths[j] / 0.05), 40))
        for share in shares[0 if j == 0 else 1:]:
            point = path.starts[j] + share * path.ways[j]
            distance = float(from_pieces(point, samples[begin:end], steps[begin:end]).min()) if end > begin else np.inf
            if distance > coverage[0]:
                coverage = (distance, int(path.owner[j]))
            over = max(over, distance - chord - path.allowed[path.owner[j]])
    ends = np.linalg.norm(samples[0] - path.starts[0]), np.linalg.norm(samples[-1] - path.starts[-1] - path.ways[-1])
    return deviation, coverage, max(over, *ends)  # the machine stands there


def judged(elements, machine, trace, names):
    """What the head of this file says, as a dict."""
    axes = {axis["name"]: axis for axis in machine["axis"]}
    joint = machine.get("path", {}).get("joint_tolerance_mm", JOINT_MM)
    acceleration = np.linalg.norm([max(axes[n]["max_acceleration_mm_s2"], axes[n].get("max_braking_mm_s2", 0.0)) for n in names])
    bend = trace.period**2 * float(acceleration)
    slack = CHORD_MM + 1e-6 + bend / 6.0
    found = {"kept": True, "slack_mm": slack}
    for unit, kind in (("mm", "linear"), ("deg", "rotary")):
        chosen = [i for i, n in enumerate(names) if axes[n].get("kind", "linear") == kind]
        if not chosen:
            continue
        path = ElementPath(elements, [names[i] for i in chosen], joint)
        (deviation, at), (coverage, covered), over = measured(path, trace.positions[:, chosen], slack, bend / 8.0)
        found[f"deviation_{unit}"], found[f"deviation_{unit}_at_element"] = deviation, path.number[at]
        found[f"coverage_{unit}"], found[f"coverage_{unit}_at_element"] = coverage, path.number[covered]
        found[f"over_{unit}"] = float(over)
        found["kept"] = found["kept"] and bool(over <= slack)
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ("program", "trace"):
        parser.add_argument("--" + name, required=True)
    parser.add_argument("--machine")
    parser.add_argument("--tolerance", type=float)
    options = parser.parse_args()
    machine = {"axis": [{"name": n, "max_acceleration_mm_s2": 1000.0} for n in "xyz"]}
    if options.machine:
        with open(options.machine, "rb") as file:
            machine = tomllib.load(file)
    names = [axis["name"] for axis in machine["axis"]]
    elements = read_elements(options.program, machine, options.tolerance)
    found = judged(elements, machine, Trace.read(options.trace, names), names)
    print(json.dumps(found, indent=1))
    sys.exit(0 if found["kept"] else 1)


if __name__ == "__main__":
    main()
