#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Programs of custom macro B, and of coordinates of Fanuc's and Haas' controls, as people write them: their moves against those that each part
needs, computed here from its drawing.

macros.py TOOL. Each program of macros/ has a function of its name, which gives the moves in order: "rapid", "feed" or "arc", and the end in
mm. A move without a length is none. PAUSES and DWELLS have what else there is."""
import cmath
import json
import math
import pathlib
import subprocess
import sys
import tempfile

FOLDER = pathlib.Path(__file__).resolve().parent / "macros"
PAUSES = {"peck_macro": 1}
DWELLS = {"serial_number": [0.25], "rotated_pattern": [0.25] * 10}
LEFT_OUT = {"peck_macro": "left out: M99 on line 9"}
TOLERANCE_MM = 1e-6


def polar(radius, degrees):
    return radius * math.cos(math.radians(degrees)), radius * math.sin(math.radians(degrees))


def rounded(inches):
    """To 0.0001, a half away from 0."""
    return math.copysign(math.floor(abs(inches) * 1e4 + 0.5 + 1e-7) / 1e4, inches)


def bolt_circle():
    yield "rapid", (0, 0, 50)
    level = 50
    for x, y, first, step, radius, depth, holes in ((30, -20, 15, 60, 40, -12, 6), (0, 0, 0, 60, 12.5, -5, 4)):
        for k in range(holes):
            dx, dy = polar(radius, first + k * step)
            yield "rapid", (x + dx, y + dy, level)
            yield "rapid", (x + dx, y + dy, 2)
            yield "feed", (x + dx, y + dy, depth)
            yield "rapid", (x + dx, y + dy, level)  # G98: where the cycle began


def pocket_grid():
    length, width, tool = 24, 16, 6
    half = (width - tool) / 2
    rings = [min(half, tool / 2 * 0.8 + k * tool * 0.4) for k in range(3)]
    rings = rings[:rings.index(half) + 1]
    yield "rapid", (0, 0, 10)
    for row in range(2):
        for column in (range(3) if row == 0 else reversed(range(3))):
            x, y = column * 40, row * 30
            yield "rapid", (x, y, 10)
            yield "rapid", (x, y, 1)
            for z in (-2.5, -5, -6):
                yield "feed", (x, y, z)
                for ring in rings:
                    side = ring + (length - width) / 2
                    for dx, dy in ((side, -ring), (side, ring), (-side, ring), (-side, -ring), (side, -ring)):
                        yield "feed", (x + dx, y + dy, z)
                yield "feed", (x, y, z)
            yield "rapid", (x, y, 10)


def helical_bore():
    yield "rapid", (0, 0, 20)
    for x, y, hole, tool, bottom, step, level in ((10, 5, 30, 10, -8, 1.7, 1), (-40, 0, 18.2, 8, -3, 1, 3)):
        side = x + (hole - tool) / 2
        yield "rapid", (side, y, 20)
        yield "rapid", (side, y, level)
        yield "feed", (side, y, 0)
        turns = math.ceil(-bottom / step)
        for k in range(turns):
            yield "arc", (side, y, bottom * (k + 1) / turns)
        yield "arc", (side, y, bottom)
        yield "feed", (x, y, bottom)
        yield "rapid", (x, y, 20)


def peck_macro():
    inch = 25.4
    yield "rapid", (0, 0, 2 * inch)
    for x, y, bottom, peck, clearance in ((0.5, 0.25, -1.2, 0.4, 0.02), (1.5, 0.25, -0.75, 0.3, 0.05)):
        level, least, z = 0.1, 0.1, 0.0
        heights = [("rapid", 2 if x == 0.5 else level), ("rapid", level)]
        while z - peck > bottom:
            z -= peck
            heights += [("feed", rounded(z)), ("rapid", level), ("rapid", z + clearance)]
            peck = max(0.75 * peck, least)
        heights += [("feed", bottom), ("rapid", level)]
        yield from ((kind, (x * inch, y * inch, height * inch)) for kind, height in heights)
    yield "rapid", (1.5 * inch, 1.25 * inch, 0.1 * inch)


def nested_calls():
    for end in ((0, 0, 5), (10, 0, 5), (10, 0, 6), (10, 0, 5), (20, 0, 5), (20, 0, 6), (20, 0, 5),  # M98 P21000: G91, with M97 P10
                (23, 0, 5), (23, -1, 5), (26, -1, 5), (26, -2, 5), (29, -2, 5), (29, -3, 5),  # M97 P500 L3
                (100, 0, 5), (100, 10, 5), (110, 10, 5), (110, 10, 6), (110, 10, 5),  # M98 P2000 L2
                (110, 20, 5), (120, 20, 5), (120, 20, 6), (120, 20, 5),
                (0, 20, 5), (0, 19, 5), (20, 19, 5), (20, 7, 5), (9, 7, 5), (9, 7, 50)):  # M97 P600, G65, M98 P4000, GOTO#100
        yield "rapid", end


def serial_number():
    yield "rapid", (0, 0, 3)
    y = 0.0
    for row, digit in enumerate((4, 0, 8, 2)):
        for _ in range(digit):
            yield "rapid", (row * 5, y, 3)
            y += 1.5
            yield "rapid", (row * 5, y, 3)
            yield "feed", (row * 5, y, -0.5)
            yield "rapid", (row * 5, y, 3)
    yield "rapid", (15, y, 30)


def ellipse():
    yield "rapid", (0, 0, 5)
    for k in range(37):
        x, y = 25 * math.cos(math.radians(10 * k)), 15 * math.sin(math.radians(10 * k))
        x, y = (x * math.cos(math.radians(30)) - y * math.sin(math.radians(30)),
                x * math.sin(math.radians(30)) + y * math.cos(math.radians(30)))
        if k == 0:
            yield "rapid", (x, y, 5)
        yield "feed", (x, y, -1)
    yield "rapid", (x, y, 5)
    radius = math.hypot(25, 15)
    rows = math.ceil(2 * radius / 8)
    yield "rapid", (-(radius + 5), -radius, 5)
    yield "feed", (-(radius + 5), -radius, 0)
    side = 1
    for row in range(rows + 1):
        height = -radius + 2 * radius / rows * row
        yield "feed", (-side * (radius + 5), height, 0)
        yield "feed", (side * (radius + 5), height, 0)
        side = -side
    yield "rapid", (-side * (radius + 5), radius, 5)
    yield "rapid", (math.degrees(math.atan2(-15, -25)) % 360, 30, 5)


def palette():
    for origin_x, origin_y, system in ((10, 20, 54), (110, 20, 55), (110, -20, 56)):
        yield "rapid", (origin_x + 1, origin_y + 2, 0 if system == 54 else system - 1)
        yield "rapid", (origin_x + origin_x, origin_y, 0 if system == 54 else system - 1)
        yield "rapid", (origin_x + origin_x, origin_y, system)
    yield "rapid", (10, 20, 56)


def pallet_offsets():
    part = [("rapid", (10, 5), 20), ("rapid", (10, 5), 2), ("feed", (10, 5), -3), ("rapid", (10, 5), 2), ("rapid", (20, 5), 2), ("feed", (20, 5), -3),
            ("rapid", (20, 5), 2), ("rapid", (15, 12), 2), ("feed", (15, 12), -1), ("arc", (25, 12), -1), ("arc", (15, 12), -1), ("rapid", (15, 12), 20)]
    yield "rapid", (-300, -200, 0)
    yield "rapid", (-300, -200, -30)
    for x, y in ((0, 0), (60, 0), (120, 0), (180, 45), (67.5, -2.5)):
        yield from ((kind, (x - 300 + at[0], y - 200 + at[1], height - 50)) for kind, at, height in part)
    yield "rapid", (-300, -200, -30)
    yield "rapid", (-300, -200, 0)


def turned_about(centre, degrees, point):
    return centre + (point - centre) * cmath.exp(1j * math.radians(degrees))


def rotated_pattern():
    corner = 40 - 15j

    def at(kind, point, height):
        return kind, (point.real, point.imag, height)
    yield at("rapid", corner, 0)
    yield at("rapid", corner, 10)
    for lobe in range(5):
        holes = [(kind, y, height) for y in (4, -4) for kind, height in (("rapid", 2), ("rapid", 1), ("feed", -5), ("rapid", 2))]
        first = [("rapid", 30, 10 if lobe == 0 else 2), ("rapid", 30, 2), ("feed", 30, -1.5), ("arc", 30, -1.5), ("arc", 22, -1.5), ("rapid", 22, 2)]
        for kind, place, height in first + [(kind, 12 + 1j * y, height) for kind, y, height in holes]:
            yield at(kind, corner + turned_about(0, 72 * lobe, complex(place)), height)
    yield at("rapid", corner + 60, 2)
    slot = [58 - 3j, 72 - 3j, 72 + 3j, 58 + 3j, 58 - 3j]
    slot = [corner + turned_about(50, 22.5, place) for place in slot]
    yield at("rapid", slot[0], 2)
    for place in slot:
        yield at("feed", place, -2)
    yield at("rapid", slot[0], 10)
    yield at("rapid", slot[0], 0)
    yield "rapid", (0, 0, 0)
    for kind, place in (("rapid", 10 + 20j), ("arc", 30 + 0j)):  # Z and X, the axes of G18
        place = turned_about(10 + 0j, -30, place)
        yield kind, (place.imag, 0, place.real)


def scaled_window():
    shape = [("rapid", 1 + 1j, 1), ("feed", 1 + 1j, -0.1), ("feed", 2 + 1j, -0.1), ("feed", 2 + 2j, -0.1), ("arc", 1 + 2j, -0.1), ("feed", 1 + 1j, -0.1),
             ("arc", 1.5 + 1j, -0.1), ("rapid", 1.5 + 1j, 1)]

    def window(place, height=lambda z: z):
        for kind, point, z in shape:
            point = place(point)
            yield kind, (25.4 * point.real, 25.4 * point.imag, 25.4 * height(z))
    start = "rapid", (0, 0, 25.4)
    yield start
    yield from window(lambda point: point)
    yield from window(lambda point: 2 * point, lambda z: 2 * z)
    yield "rapid", (0, 0, 25.4)

    def small(point):
        return 1.5 + 1.5j + 0.75 * (point - 1.5 - 1.5j)
    yield from window(lambda point: turned_about(small(1 + 1j), 45, small(point)), lambda z: 0.75 * z)
    yield start
    yield from window(lambda point: complex(-2 - point.real, point.imag))
    yield from window(lambda point: complex(-2 - point.real, -1 - point.imag))
    yield from window(lambda point: complex(point.real, -1 - point.imag))
    yield start


def with_length(moves):
    place = (0.0, 0.0, 0.0)
    for kind, end in moves:
        if kind == "arc" or math.dist(place, end) > 1e-9:
            yield kind, end
        place = end


def planned(tool, name):
    """Its moves, and what is wrong beside them."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "elements.json"
        call = subprocess.run([tool, "plan", f"{name}.nc", "--dialect", "fanuc", "--elements", str(path)], cwd=FOLDER, capture_output=True,
                              text=True, check=False)
        if call.returncode != 0:
            return [], call.stderr.strip()
        document = json.loads(path.read_text())
        piped = subprocess.run([tool, "plan", "-", "--format", "gcode", "--dialect", "fanuc", "--elements", str(path)],
                               input=(FOLDER / f"{name}.nc").read_text(), capture_output=True, text=True, check=False)
        if piped.returncode != 0 or json.loads(path.read_text()) != document:
            return [], f"from a pipe it is another one: {piped.stderr.strip()}"
    moves = [("arc" if element["type"] == "arc" else "rapid" if element.get("rapid") else "feed", element["to"])
             for element in document["elements"]]
    pauses = sum(event["what"] == "stop" for event in document["events"])
    dwells = [dwell["seconds"] for dwell in document["dwells"]]
    if pauses != PAUSES.get(name, 0) or dwells != DWELLS.get(name, []):
        return moves, f"{pauses} pauses, dwells {dwells}"
    if LEFT_OUT.get(name, "") not in call.stdout + call.stderr:
        return moves, f"it does not say: {LEFT_OUT[name]}"
    return moves, ""


def difference(name, moves, expected):
    for number, (seen, wanted) in enumerate(zip(moves, expected), 1):
        if seen[0] != wanted[0] or math.dist(seen[1], wanted[1]) > TOLERANCE_MM:
            return f"{name}: move {number} is {seen}, and should be {wanted}"
    return "" if len(moves) == len(expected) else f"{name}: {len(moves)} moves, and should have {len(expected)}"


def main():
    tool = str(pathlib.Path(sys.argv[1]).resolve())
    names = sorted(path.stem for path in FOLDER.glob("*.nc"))
    wrong = 0
    for name in names:
        moves, problem = planned(tool, name)
        problem = problem and f"{name}: {problem}" or difference(name, moves, list(with_length(globals()[name]())))
        wrong += bool(problem)
        print(problem, end="\n" if problem else "")
    print(f"{len(names)} programs, {wrong} wrong")
    sys.exit(1 if wrong or not names else 0)


if __name__ == "__main__":
    main()
