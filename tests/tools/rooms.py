#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Whether every #include goes along the arrows that DESIGN.md draws (its section Rooms).

Each row of that table names a room, what it holds and the rooms that it includes; a room is a folder with its sources. An include
of another room needs its arrow, an arrow needs an include, and points to a row further up, so that no room includes itself by others.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
TREES = {"firmware_core": "splinefeed/", "hal": "splinefeed/hal/", "host_sim": "host_sim/"}


def arrows_of(design):
    """{room: rooms that it includes}, in the order of the table."""
    section = design.split("\n## Rooms\n", 1)[1].split("\n## ", 1)[0]
    arrows = {}
    for row in re.findall(r"^\| `([^`]+)` \|[^|]*\|([^|]*)\|$", section, re.MULTILINE):
        arrows[row[0]] = re.findall(r"`([^`]+)`", row[1])
    return arrows


def room_of(path, rooms):
    """The innermost room whose folder holds the file."""
    for folder in path.parents:
        if str(folder) in rooms:
            return str(folder)
    return None


def target_of(source, name):
    """The file of this repository that an include names, or None."""
    for tree in TREES:
        start = ROOT / tree if tree != "host_sim" else ROOT
        if (start / name).is_file():
            return (start / name).relative_to(ROOT)
    beside = (ROOT / source).parent / name
    return beside.resolve().relative_to(ROOT) if beside.is_file() else None


def problems_of(arrows):
    problems = []
    used = set()
    sources = [p.relative_to(ROOT) for tree in TREES for p in sorted((ROOT / tree).rglob("*.?pp"))]
    for source in sources:
        room = room_of(source, arrows)
        if room is None:
            problems.append(f"{source}: no row of DESIGN.md's table of rooms holds it")
            continue
        for number, line in enumerate((ROOT / source).read_text().splitlines(), 1):
            include = re.match(r'\s*#\s*include "([^"]+)"', line)
            target = target_of(source, include[1]) if include else None
            other = room_of(target, arrows) if target else None
            if other in (None, room):
                continue
            used.add((room, other))
            if other not in arrows[room]:
                problems.append(f"{source}:{number}: {room} includes {other} ({include[1]}), and DESIGN.md draws no such arrow")
    order = list(arrows)
    for room, others in arrows.items():
        for other in others:
            if other not in arrows:
                problems.append(f"DESIGN.md: {room} includes `{other}`, which is no room")
            elif (room, other) not in used:
                problems.append(f"DESIGN.md: no file of {room} includes one of {other}; leave that arrow out")
            elif order.index(other) > order.index(room):
                problems.append(f"DESIGN.md: {room} includes {other}, which stands below it; arrows point up")
    return problems


def main():
    if sys.argv[1:] == ["--edges"]:  # what there is, for whoever changes the table
        arrows = arrows_of((ROOT / "DESIGN.md").read_text())
        for line in problems_of({room: [] for room in arrows}):
            if " includes " in line and "(" in line:
                print(re.sub(r"^\S+ (\S+) includes (\S+) .*", r"\1 -> \2", line))
        return 0
    problems = problems_of(arrows_of((ROOT / "DESIGN.md").read_text()))
    print("\n".join(problems) if problems else "every include goes along an arrow")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
