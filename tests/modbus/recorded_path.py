# SPDX-License-Identifier: MIT
"""Shafts that drives recorded, put together by the machine's clock, against the plan (the rows of --segments)."""
import json
import math
import os
import re

from drive_processes import TICKS_PER_S, UNITS, fields, sequence_problems
from real_time import OffTime, called

SUB = 8  # points of the plan a segment
SPEED_MM_S = 100.0  # of the machines here


def plan_points(segments, steps):
    """Places on the planned path [mm], SUB a segment."""
    points = []
    for row in segments:
        values = [int(x) for x in row[2:]]
        for i in range(SUB):
            u = i / SUB
            place = []
            for axis, per_mm in enumerate(steps):
                p0, p1, v0, v1 = values[4 * axis:4 * axis + 4]
                way = p1 - p0
                q = p0 + (((v0 + v1 - 2 * way) * u + (3 * way - 2 * v0 - v1)) * u + v0) * u
                place.append(q / UNITS / per_mm)
            points.append(place)
    points.append([int(segments[-1][3 + 4 * axis]) / UNITS / per_mm for axis, per_mm in enumerate(steps)])
    return points


def from_piece(q, a, b):
    ab = [y - x for x, y in zip(a, b)]
    aq = [y - x for x, y in zip(a, q)]
    length_sq = sum(x * x for x in ab)
    u = min(1.0, max(0.0, sum(x * y for x, y in zip(ab, aq)) / length_sq)) if length_sq > 0 else 0.0
    return math.dist(aq, [u * x for x in ab])


def shafts_together(drives, steps):
    """Rows [t of the machine's clock, x, y, z in mm] each millisecond of the first drive; axes in the drives' order."""
    rows = [drive.shaft_rows() for drive in drives]
    starts = [drive.start_s() for drive in drives]
    first = max(start + r[0][0] for start, r in zip(starts, rows))
    last = min(start + r[-1][0] for start, r in zip(starts, rows))
    out = []
    for t, *_ in rows[0]:
        now = starts[0] + t
        if not first <= now <= last - 0.001:
            continue
        place = [now]
        for start, r in zip(starts, rows):
            i = max(1, min(len(r) - 1, int((now - start) * 1000.0) + 1))
            share = (now - start - r[i - 1][0]) / (r[i][0] - r[i - 1][0])
            place += [a + share * (b - a) for a, b in zip(r[i - 1][1:], r[i][1:])]
        out.append([now] + [q / per_mm for q, per_mm in zip(place[1:], steps)])
    return out


def furthest(rows, path, behind=40, ahead=400):
    """How far the rows are from the path at most, and how many pieces lie behind the last one; the path is followed in
    order: the nearest piece is so many behind or ahead of the last one at most. Where it stands there is no piece."""
    path = [path[0], *(b for a, b in zip(path, path[1:]) if a != b)]
    worst = 0.0
    at = 0
    for row in rows:
        place = row[1:]
        near = range(max(0, at - behind), min(len(path) - 1, at + ahead))
        rough = min(near[::SUB], key=lambda i: math.dist(place, path[i]))  # to a segment
        near = range(max(near[0], rough - 2 * SUB), min(near[-1] + 1, rough + 2 * SUB))
        distances = [from_piece(place, path[i], path[i + 1]) for i in near]
        best = min(range(len(distances)), key=distances.__getitem__)
        at = near[best]
        worst = max(worst, distances[best])
    return worst, len(path) - at


def durations(rows, path, plan, steps):
    """From the first to the last motion of any axis [s]: of the shafts, and planned."""
    def moves(a, b):
        return any(abs(y - x) * per_mm > 1e-6 for x, y, per_mm in zip(a, b, steps))
    moving = [row[0] for row, later in zip(rows, rows[1:]) if moves(row[1:], later[1:])]
    piece_s = [int(row[1]) / SUB / TICKS_PER_S for row in plan for _ in range(SUB)]
    planned = [i for i, (a, b) in enumerate(zip(path, path[1:])) if moves(a, b)]
    return moving[-1] - moving[0], sum(piece_s[planned[0]:planned[-1]])


def apart(rows, plan, path, steps):
    """How far apart the axes begin, s, apart from what is planned."""
    times = [0]
    for segment in plan:
        times.append(times[-1] + int(segment[1]))
    starts = []
    for k, per_mm in enumerate(steps):
        moving = [row[0] for row, later in zip(rows, rows[1:]) if abs(later[1 + k] - row[1 + k]) * per_mm > 1e-6]
        planned = [i for i, (a, b) in enumerate(zip(path, path[1:])) if abs(b[k] - a[k]) * per_mm > 1e-6]
        if moving:
            segment, part = divmod(planned[0], SUB)
            starts.append(moving[0] - (times[segment] + part / SUB * int(plan[segment][1])) / TICKS_PER_S)
    return max(starts) - min(starts)


def judge(name, tolerance_mm, asked, summary, plan, steps, drives):
    """Prints how it went under this name; what is wrong, a sentence each. asked: how often all are
    made to stop and go on, at least and at most."""
    problems = []
    path = plan_points(plan, steps)
    rows = shafts_together(drives, steps)
    # From the start of the session on the shafts are where the plan begins; one row later no row is between there and
    # where they were before.
    begin = next((i for i, row in enumerate(rows) if math.dist(row[1:], path[0]) < 1e-3), None)
    if begin is None:
        return ["the shafts are never where the plan begins"]
    rows = rows[begin + 1:]
    worst, _ = furthest(rows, path)
    apart_s = apart(rows, plan, path, steps)
    end = max(abs(row - planned) * per_mm for row, planned, per_mm in zip(rows[-1][1:], path[-1], steps))
    link = summary["link"]
    print(f"{name}: path error {1000 * worst:.3f} um, starts within {1e6 * apart_s:.0f} us, end off by {end:.2g} counts, "
          f"smoothing at most {1000 * summary['smoothing_bound_mm']:.2f} um, cycle {summary['cycle_time_s']:.3f} s, "
          f"resumes {link['resumes']}, clocks known to {1e6 * link['clocks_known_to_s']:.0f} us, "
          f"buses' processor time {link['bus_time_s']:.3f} s")
    resumes = link["resumes"]
    if worst > tolerance_mm:
        problems.append(OffTime.off_path(worst, tolerance_mm, SPEED_MM_S))
    if resumes > asked[-1]:
        problems.append(OffTime(f"all stopped and went on {resumes} times, not {asked[-1]}"))
    if resumes < asked[0]:
        problems.append("they did not stop and go on; was it over before the fault?")
    took_s, planned_s = durations(rows, path, plan, steps)
    if resumes == 0 and abs(took_s - planned_s) > 0.02:
        problems.append(OffTime(f"they move for {took_s:.3f} s; the plan takes {planned_s:.3f} s"))
    if apart_s > 0.0025:
        problems.append(OffTime(f"the axes start {1e6 * apart_s:.0f} us apart"))
    if end > 1e-3:
        problems.append(f"they end {end} counts from where the plan ends")
    return problems


def machine_file(machine, folder, addresses):
    """Copies a machine file whose axes are x, y, z, on these drives; its name, and counts per mm of each axis."""
    with open(machine, encoding="utf-8") as file:
        text = file.read()
    for name, address in zip("xyz", addresses):
        text = text.replace(f'name = "{name}"', f'name = "{name}"\ndrive = "{address}"')
    copy = os.path.join(folder, "machine.toml")
    with open(copy, "w", encoding="utf-8") as file:
        file.write(text)
    return copy, [float(s) for s in re.findall(r"^steps_per_mm *= *([0-9.]+)", text, re.M)]


def run_and_judge(name, tolerance_mm, asked, command, folder, steps, drives, stall_s=0.0):
    """As judge(). Runs the tool (its `run` with program, machine and options), stops the drives; what is wrong, a sentence each."""
    problems = []
    try:
        call = called([*command, "--target", "modbus", "--segments", "plan.csv", "--summary", "json"], folder, stall_s)
    finally:
        for drive in drives:
            problems += drive.stop()
    if call.status != 0:
        silent = "does not answer" in call.errors
        return call.excused(problems + [(OffTime if silent else str)(f"exit status {call.status}: {call.errors}")])
    plan = fields(os.path.join(folder, "plan.csv"))
    first = 0
    for k, drive in enumerate(drives):
        problems += sequence_problems(drive.executed(), plan, range(first, first + drive.axes), True, f"drive {k}")
        first += drive.axes
    return call.excused(problems + judge(name, tolerance_mm, asked, json.loads(call.output), plan, steps, drives))
