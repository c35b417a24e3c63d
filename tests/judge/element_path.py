# SPDX-License-Identifier: MIT
"""ElementPath: programmed lines, arcs and splines as short straight pieces, with what each may be off."""
import csv
import json
import math

import numpy as np

AXES = "xyzabc"
CHORD_MM = 1e-5  # between a piece and the curve
LEFT_OUT_MM = 2e-4  # moves that are shorter need not be there
LONGEST_PIECE_MM = 2.0  # of a line: within a piece nobody looks at the order
JOINT_MM, DEFAULT_MM, RAPID_MM = 1e-3, 1e-2, 0.1  # what a machine file need not state


def six(point):
    return np.pad(np.asarray(point, float), (0, 6 - len(point)))


def parameters(bend, size):
    """Even parameters: enough for a curve of this largest second derivative by a parameter of [0, 1]."""
    return np.linspace(0.0, 1.0, max(2, int(math.ceil(math.sqrt(bend / (8.0 * CHORD_MM)))) + 1, int(size)))


def arc_points(element):
    """From the stated angle; its end is moved onto "to" evenly, as far as the angle was rounded."""
    start, end = six(element["from"]), six(element["to"])
    centre = np.asarray(element["centre"], float)
    axis = np.asarray(element["axis"], float)
    axis = axis / np.linalg.norm(axis)
    arms = [p[:3] - centre - ((p[:3] - centre) @ axis) * axis for p in (start, end)]
    radii = [np.linalg.norm(arm) for arm in arms]
    x = arms[0] / radii[0]
    y = np.cross(axis, x)
    seen = math.atan2(arms[1] @ y, arms[1] @ x)
    angle = element["angle"] - math.remainder(element["angle"] - seen, 2.0 * math.pi)
    w = parameters(max(radii) * angle**2 + 2.0 * abs(radii[1] - radii[0]) * abs(angle), 2)[:, None]
    points = start + w * (end - start)
    heights = [(p[:3] - centre) @ axis for p in (start, end)]
    radius = radii[0] + w * (radii[1] - radii[0])
    points[:, :3] = (centre + radius * (np.cos(w * angle) * x + np.sin(w * angle) * y)
                     + (heights[0] + w * (heights[1] - heights[0])) * axis)
    return points


def bezier_points(control, t):
    rows = np.repeat(np.asarray(control, float)[None], len(t), 0)
    while rows.shape[1] > 1:
        rows = rows[:, :-1] + t[:, None, None] * np.diff(rows, axis=1)
    return rows[:, 0]


def nurbs_points(element, t):
    """By the recursion of Cox and de Boor, rational."""
    degree, knots = element["order"] - 1, np.asarray(element["knots"], float)
    control = np.asarray(element["control_points"], float)[:, :3]
    weights = np.asarray(element.get("weights", np.ones(len(control))), float)
    u = knots[degree] + t * (knots[len(control)] - knots[degree])
    span = np.clip(np.searchsorted(knots, u, "right") - 1, degree, len(control) - 1)
    rows = np.column_stack([control * weights[:, None], weights])[span[:, None] + np.arange(-degree, 1)]
    for level in range(1, degree + 1):
        for j in range(degree, level - 1, -1):
            low, high = knots[span + j - degree], knots[span + 1 + j - level]
            share = np.where(high > low, (u - low) / np.where(high > low, high - low, 1.0), 0.0)[:, None]
            rows[:, j] = (1.0 - share) * rows[:, j - 1] + share * rows[:, j]
    return rows[:, degree, :3] / rows[:, degree, 3:]


def points_of(element):
    """Points of an element, six coordinates each; chords between them are within CHORD_MM."""
    kind = element.get("type", "line")
    start, end = six(element["from"]), six(element["to"])
    if kind == "line":
        parts = max(1, math.ceil(np.linalg.norm(end - start) / LONGEST_PIECE_MM))
        return start + np.linspace(0.0, 1.0, parts + 1)[:, None] * (end - start)
    if kind == "arc":
        return arc_points(element)
    control = np.asarray(element["control_points"], float)[:, :3]
    size = np.linalg.norm(np.diff(control, axis=0), axis=1).sum()
    t = parameters(4.0 * len(control) ** 2 * size, 64)
    points = start + t[:, None] * (end - start)
    points[:, :3] = bezier_points(control, t) if kind == "bezier" else nurbs_points(element, t)
    points[0], points[-1] = start, end
    return points


def turns_rotary_axis(element, machine):
    rotary = {"xyzabc".index(axis["name"]) for axis in machine.get("axis", []) if axis.get("kind") == "rotary"}
    points = [element["from"], *element.get("control_points", []), element["to"]]
    return any(len({point[k] if k < len(point) else 0.0 for point in points}) > 1 for k in rotary)


def read_elements(path, machine, tolerance=None):
    """Elements of a .json, or the lines between the waypoints of a .csv, each with its "tolerance_mm"; those that stop at their end
    are exact_stop."""
    stated = machine.get("path", {})
    default = stated.get("default_tolerance_mm", DEFAULT_MM) if tolerance is None else tolerance
    if str(path).endswith(".csv"):
        return lines_between(path, tolerance or 0.0)
    with open(path, encoding="utf-8") as file:
        data = json.load(file)
    elements = [dict(element) for element in data["elements"]]
    for element in elements:
        rapid = stated.get("rapid_tolerance_mm", RAPID_MM)
        element["tolerance_mm"] = rapid if element.get("rapid") else element.get("tolerance_mm", default)
        if turns_rotary_axis(element, machine):
            element["tolerance_mm"] = min(element["tolerance_mm"], stated.get("rotary_tolerance_deg", math.inf))
    for stop in data.get("dwells", []) + data.get("events", []):
        if stop["after_element"] > 0:
            elements[stop["after_element"] - 1]["mode"] = "exact_stop"
    return elements


def lines_between(path, tolerance):
    with open(path, newline="", encoding="utf-8") as file:
        rows = [row for row in csv.reader(file) if row and not row[0].lstrip().startswith("#")]
    try:
        [float(x) for x in rows[0]]
        names = list(AXES)[:len(rows[0])]
    except ValueError:
        names = [name.strip().lower() for name in rows.pop(0)]
    places = [[float(row[names.index(axis)]) if axis in names else 0.0 for axis in AXES] for row in rows]
    elements = []
    for number, (start, end) in enumerate(zip(places, places[1:]), 1):
        given = dict(zip(names, rows[number]))
        elements.append({"from": start, "to": end, "tolerance_mm": float(given.get("tolerance") or tolerance),
                         "mode": "exact_stop" if given.get("corner", "").strip() == "1" else "continuous"})
    return elements


def whole(elements):
    """Indices of the elements that are there for the path: not those that end within LEFT_OUT_MM, on every axis, of where the one
    before them ended. Their stops are those of the one before."""
    kept, end = [], None
    for index, element in enumerate(elements):
        start, to = six(element["from"]), six(element["to"])
        end = start if end is None else end
        if element.get("type", "line") != "arc" and np.abs(to - end).max() < LEFT_OUT_MM:
            if kept and element.get("mode") == "exact_stop":
                elements[kept[-1]] = {**elements[kept[-1]], "mode": "exact_stop"}
            continue
        kept.append(index)
        end = to
    return kept


def allowed(elements, joint):
    """What the path may be off each element: the larger one of what the joints at its ends allow, and those between the pieces of a
    NURBS."""
    at_end = []
    for one, following in zip(elements, elements[1:]):
        both = min(one["tolerance_mm"], following["tolerance_mm"])
        mode = one.get("mode", "continuous")
        at_end.append(0.0 if mode == "exact_stop" else both if mode == "continuous" and both > 0.0 else joint)
    within = [(element["tolerance_mm"] if element.get("mode", "continuous") == "continuous" and element["tolerance_mm"] > 0.0 else joint)
              if element.get("type") == "nurbs" else 0.0 for element in elements]
    return np.max([[0.0] + at_end, at_end + [0.0], within], axis=0)


class ElementPath:
    """pieces: starts, ways [n, axes]; owner: which element each belongs to; allowed: of these; number: of these in the program, from 1."""

    def __init__(self, elements, axes, joint=JOINT_MM):
        columns = [AXES.index(axis) for axis in axes]
        elements = list(elements)
        kept = whole(elements)
        elements = [elements[index] for index in kept]
        self.number = [index + 1 for index in kept]
        points = [points_of(element)[:, columns] for element in elements]
        self.starts = np.vstack([p[:-1] for p in points])
        self.ways = np.vstack([np.diff(p, axis=0) for p in points])
        self.owner = np.repeat(np.arange(len(points)), [len(p) - 1 for p in points])
        self.allowed = allowed(elements, joint)
