# SPDX-License-Identifier: MIT
"""Waypoints: the points that a curve has to meet."""
import csv

import numpy as np


def read_waypoints(path, axes):
    """Points of a waypoint .csv, one row each: axes that the file does not name are 0."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = [row for row in csv.reader(file) if row and not row[0].lstrip().startswith("#")]
    try:
        [float(x) for x in rows[0]]
        names = list("xyzabc")[:len(rows[0])]
    except ValueError:
        names = [name.strip() for name in rows.pop(0)]
    columns = [names.index(axis) if axis in names else None for axis in axes]
    return np.array([[0.0 if i is None else float(row[i]) for i in columns] for row in rows])


def chain_ends(chain):
    """Of a curve that is itself the program: both ends of each of its pieces."""
    return np.vstack([[piece.start, piece.end] for piece in chain.pieces])
