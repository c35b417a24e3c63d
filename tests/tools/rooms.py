#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Whether every #include goes along the arrows of tests/tools/rooms.txt, and DESIGN.md names each room.

A room is a folder with its sources. A file may include its own room and those to which arrows lead, over other rooms, too. An arrow
points to a line further up, so no room includes itself by others; and an arrow without which no include of its room fails is too many.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
TABLE = "tests/tools/rooms.txt"
TREES = {"firmware_core": "splinefeed/", "hal": "splinefeed/hal/", "host_sim": "host_sim/", "python": "python/"}


def arrows_of(table):
    """{room: rooms that it includes}, in the order of the lines."""
    lines = [line for line in table.splitlines() if line.strip() and not line.startswith("#")]
    return {room: others.split() for room, _, others in (line.partition(":") for line in lines)}


def reach(arrows, room):
    """All rooms to which arrows lead from a room."""
    found, todo = set(), list(arrows.get(room, []))
    while todo:
        other = todo.pop()
        if other not in found:
            found.add(other)
            todo += arrows.get(other, [])
    return found


def room_of(path, rooms):
    """The innermost room whose folder holds the file."""
    for folder in path.parents:
        if str(folder) in rooms:
            return str(folder)
    return None


def target_of(source, name):
    """The file of this repository that an include names, or None."""
    for tree in TREES:
        start = ROOT if TREES[tree] == f"{tree}/" else ROOT / tree
        if (start / name).is_file():
            return (start / name).relative_to(ROOT)
    beside = (ROOT / source).parent / name
    return beside.resolve().relative_to(ROOT) if beside.is_file() else None


def includes_of(arrows):
    """([(source, line, name, room, included room)] between rooms, sources that lie in no room)"""
    found, homeless = [], []
    for source in (p.relative_to(ROOT) for tree in TREES for p in sorted((ROOT / tree).rglob("*.?pp"))):
        room = room_of(source, arrows)
        if room is None:
            homeless.append(source)
            continue
        for number, line in enumerate((ROOT / source).read_text().splitlines(), 1):
            include = re.match(r'\s*#\s*include "([^"]+)"', line)
            target = target_of(source, include[1]) if include else None
            other = room_of(target, arrows) if target else None
            if other not in (None, room):
                found.append((source, number, include[1], room, other))
    return found, homeless


def problems_of(arrows, includes):
    problems = []
    allowed = {room: reach(arrows, room) for room in arrows}
    for source, number, name, room, other in includes:
        if other not in allowed[room]:
            problems.append(f"{source}:{number}: {room} includes {other} ({name}), and no arrow of {TABLE} leads there")
    order = list(arrows)
    for room, others in arrows.items():
        used = {other for *_, of, other in includes if of == room}
        for other in others:
            if other not in arrows:
                problems.append(f"{TABLE}: {room} includes {other}, which is no room")
                continue
            if order.index(other) >= order.index(room):
                problems.append(f"{TABLE}: {room} includes {other}, which does not stand above it; arrows point up")
            without = reach({**arrows, room: [o for o in others if o != other]}, room)
            if used <= without | (used - allowed[room]):
                problems.append(f"{TABLE}: {room} needs no arrow to {other}; leave it out")
    return problems


def unnamed(arrows, design):
    """Rooms that DESIGN.md's section Rooms does not name at the beginning of an item."""
    section = design.partition("\n## Rooms\n")[2].partition("\n## ")[0]
    tree, named = "", set()
    for line in section.splitlines():
        if heading := re.match(r"\*\*`([^`]+)`", line):
            tree = heading[1]
        elif item := re.match(r"- `([^`]+)`:", line):
            named.add(tree if item[1] == "." else f"{tree}/{item[1]}")
    return [f"DESIGN.md: its section Rooms does not name {room}" for room in arrows if room not in named] + \
           [f"DESIGN.md: its section Rooms names {room}, which is no room" for room in sorted(named - set(arrows))]


def self_test():
    """Whether small tables have the problems that they should have."""
    arrows = arrows_of("# a remark\na:\nb: a\nc: b\n")
    cases = [(arrows, [("b", "a"), ("c", "b"), ("c", "a")], ""),  # c reaches a over b
             (arrows, [("b", "a"), ("c", "a")], ""),  # used through the closure alone
             (arrows, [("b", "a"), ("c", "b"), ("a", "c")], "no arrow of"),
             (arrows, [("c", "b")], "b needs no arrow to a"),
             (arrows_of("a:\nb: a\nc: a b\n"), [("b", "a"), ("c", "a"), ("c", "b")], "c needs no arrow to a"),
             (arrows_of("b: a\na:\n"), [("b", "a")], "arrows point up"),
             (arrows_of("a: d\n"), [], "is no room")]
    for table, pairs, expected in cases:
        said = "\n".join(problems_of(table, [("source", 1, "name", *pair) for pair in pairs]))
        if (expected not in said) or (not expected and said):
            yield f"self-test: {pairs} in {table}: '{said}', not '{expected}'"
    design = "\n## Rooms\n\n**`t`** text\n\n- `.`: one\n- `b`: two\n- `x`: three\n\n## Next\n"
    if unnamed(arrows_of("t:\nt/b:\nt/c:\n"), design) != ["DESIGN.md: its section Rooms does not name t/c",
                                                          "DESIGN.md: its section Rooms names t/x, which is no room"]:
        yield "self-test: the names in DESIGN.md are not compared"


def main():
    arrows = arrows_of((ROOT / TABLE).read_text())
    includes, homeless = includes_of(arrows)
    if sys.argv[1:] == ["--edges"]:  # what there is, for whoever changes the table
        print("\n".join(sorted({f"{room} -> {other}" for *_, room, other in includes})))
        return 0
    problems = [*self_test(), *(f"{source}: no room of {TABLE} holds it" for source in homeless)]
    problems += problems_of(arrows, includes) + unnamed(arrows, (ROOT / "DESIGN.md").read_text())
    print("\n".join(problems) if problems else f"{len(arrows)} rooms: every include goes along an arrow")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
