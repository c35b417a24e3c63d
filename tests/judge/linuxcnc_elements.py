#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Whether the moves of programs are those of LinuxCNC's own interpreter, in order: random programs, contours with cutter compensation, threads, and
the programs of examples/.

    linuxcnc_elements.py build/release/bin/splinefeed [--programs 300] [--seed N]

`rs274` of Debian's package linuxcnc-uspace prints the ends of its moves with four decimals: 1e-4 mm are allowed. Exit status 77: skipped,
it is not here."""
import argparse
import json
import math
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
ALLOWED_MM = 1.01e-4  # of the last decimal a half is theirs, and ours is not rounded
CALL = re.compile(r"^\s*\d+ \S+\s+([A-Z0-9_]+)\((.*)\)$")
REFUSED = "the tool does not fit"  # LinuxCNC does not see all of them
CYCLES = ("G81", "G82 P0.1", "G83 Q1.5", "G73 Q1.5", "G85", "G89 P0.1")
ORDER = {"XY": (0, 1, 2), "YZ": (1, 2, 0), "XZ": (2, 0, 1)}  # axes of an ARC_FEED: two ends, and the way across

MACHINE = "[path]\nmax_feed_mm_s = 100\n" + "".join(
    f'[[axis]]\nname = "{axis}"\nmax_velocity_mm_s = 100\nmax_acceleration_mm_s2 = 1000\n' for axis in "xyz")


def theirs(program, folder):
    """(kind, end in mm) of every move that has a length."""
    printed = subprocess.run(["rs274", "-g", program], cwd=folder, capture_output=True, text=True, check=False).stdout
    moves, at, offset, plane, unit = [], (0.0, 0.0, 0.0), {}, "XY", 1.0
    for row in printed.splitlines():
        match = CALL.match(row)
        if match is None:
            continue
        name, given = match[1], match[2].split(",")
        if name == "USE_LENGTH_UNITS":
            unit = 25.4 if "INCHES" in match[2] else 1.0
        elif name == "SELECT_PLANE":
            plane = match[2][-2:]
        elif name in ("SET_G5X_OFFSET", "SET_G92_OFFSET"):
            offset[name] = [float(x) for x in given[-6:-3]]
        elif name in ("STRAIGHT_TRAVERSE", "STRAIGHT_FEED", "ARC_FEED"):
            numbers = [float(x) for x in given]
            if name == "ARC_FEED":  # ends, centre, turns, way across
                place = [0.0] * 3
                for axis, number in zip(ORDER[plane], (numbers[0], numbers[1], numbers[5])):
                    place[axis] = number
            else:
                place = numbers[:3]
            end = tuple(unit * (x + sum(one[k] for one in offset.values())) for k, x in enumerate(place))
            if name == "ARC_FEED" or math.dist(end, at) > ALLOWED_MM:
                moves.append(("arc" if name == "ARC_FEED" else "rapid" if name == "STRAIGHT_TRAVERSE" else "line", end))
            at = end
    return moves


def ours(tool, program, folder):
    (folder / "m.toml").write_text(MACHINE, encoding="ascii")
    call = subprocess.run([tool, "plan", program, "-m", folder / "m.toml", "--elements", folder / "e.json", "--quiet"], capture_output=True,
                          text=True, check=False)
    if call.returncode != 0:
        return None, call.stderr.strip()
    elements = json.loads((folder / "e.json").read_text(encoding="utf-8"))["elements"]
    moves = [("rapid" if e.get("rapid") else e["type"], tuple(e["to"][:3])) for e in elements
             if e["type"] == "arc" or math.dist(e["from"][:3], e["to"][:3]) > ALLOWED_MM]
    return moves, ""


def random_program(numbers):
    """Lines, arcs by centre and by radius in all planes, cycles, both kinds of distance, offsets."""
    rows, relative = ["G21 G90 G17 G94 F1200", "G0 X5 Y5 Z5"], False
    def near(size):
        return f"{numbers.uniform(-size, size):.3f}"
    for _ in range(numbers.randint(3, 25)):
        kind = numbers.random()
        if kind < 0.4:
            rows.append(f"G{numbers.randint(0, 1)} X{near(30)} Y{near(30)} Z{near(10)}")
        elif kind < 0.6:  # a part of a circle about a point beside the present one: its end is on it
            first, second = numbers.choice((("X", "Y"), ("Z", "X"), ("Y", "Z")))
            rows.append({"XY": "G17", "ZX": "G18", "YZ": "G19"}[first + second])
            rows.append(f"G91 G{numbers.randint(2, 3)} {first}0 {second}0 {dict(X='I', Y='J', Z='K')[first]}{near(9)} "
                        f"{dict(X='I', Y='J', Z='K')[second]}{near(9)} P{numbers.randint(1, 3)}")
            rows.append("G91" if relative else "G90")
        elif kind < 0.7:
            x, y = numbers.uniform(-9, 9), numbers.uniform(-9, 9)
            rows.append(f"G17 G91 G{numbers.randint(2, 3)} X{x:.3f} Y{y:.3f} Z{near(2)} "
                        f"R{numbers.choice((1, -1)) * (math.hypot(x, y) / 2 + numbers.uniform(0.1, 20)):.4f}")
            rows.append("G91" if relative else "G90")
        elif kind < 0.8:
            rows.append("G17 G90")
            rows.append(f"G{numbers.choice((98, 99))} {numbers.choice(CYCLES)} X{near(20)} Y{near(20)} Z-4 R2")
            rows.append(f"X{near(20)} Y{near(20)}")
            rows.append("G80" + (" G91" if relative else ""))
        elif kind < 0.9:
            rows.append(numbers.choice((f"G92 X{near(9)} Y{near(9)}", f"G10 L2 P1 X{near(9)} Z{near(9)}", "G92.1", f"G10 L20 P1 Y{near(9)}",
                                        f"G52 X{near(9)}")))
        else:
            relative = not relative
            rows.append("G91" if relative else "G90")
    return "\n".join([*rows, "M2", ""])


def random_contour(numbers):
    """Lines and arcs with cutter compensation. Corners are none or 0.1 to 1.7 rad: below 0.05 rad LinuxCNC leaves ends as they are."""
    side, radius = numbers.choice(("G41.1", "G42.1")), numbers.choice((0.25, 1.0, 3.0))
    rows, x, y, heading = ["G21 G90 G17 F1200", f"{side} D{2 * radius} G{numbers.randint(0, 1)} X30 Y0"], 30.0, 0.0, 0.0
    for _ in range(numbers.randint(2, 9)):
        heading += numbers.choice((0.0, 1.0, -1.0)) * numbers.uniform(0.1, 1.7)
        if numbers.random() < 0.6:
            length = numbers.uniform(1, 25)
            x, y = x + length * math.cos(heading), y + length * math.sin(heading)
            rows.append(f"G{numbers.choice('0111')} X{x:.9f} Y{y:.9f}" + numbers.choice(("", "", "", " Z-1", "\nG0 Z2\nM8\nG1 Z0")))
        else:
            turn, size, sweep = numbers.choice((1, -1)), numbers.uniform(1, 20), numbers.uniform(0.1, 4)
            centre = (x - turn * size * math.sin(heading), y + turn * size * math.cos(heading))
            i, j, heading = centre[0] - x, centre[1] - y, heading + turn * sweep
            x, y = centre[0] + turn * size * math.sin(heading), centre[1] - turn * size * math.cos(heading)
            rows.append(f"G{3 if turn > 0 else 2} X{x:.9f} Y{y:.9f} I{i:.9f} J{j:.9f}")
    return "\n".join([*rows, "G40", "G1 X90 Y90", "M2", ""])


def random_threads(numbers):
    """G76 with all its words, outside and inside, and moves by polar coordinates."""
    rows = ["G21 G90 G18" + numbers.choice(("", " G7")), f"S{numbers.randint(50, 2000)} M3",
            f"G0 X{numbers.uniform(5, 30):.3f} Z{numbers.uniform(1, 8):.3f}"]
    for way in (-1, 1, -1):
        first = numbers.uniform(0.05, 0.4)
        rows.append(f"G76 P{numbers.uniform(0.2, 3):.3f} Z{way * numbers.uniform(20, 40):.3f} "
                    f"I{numbers.choice((-1, 1)) * numbers.uniform(0.2, 3):.3f} J{first:.3f} K{first * numbers.uniform(1.1, 5):.3f}"
                    + numbers.choice(("", f" R{numbers.uniform(0.5, 3):.2f}")) + numbers.choice(("", f" Q{numbers.uniform(0, 45):.2f}"))
                    + numbers.choice(("", f" H{numbers.randint(0, 3)}"))
                    + numbers.choice(("", f" E{numbers.uniform(0.1, 5):.3f} L{numbers.randint(0, 3)}")))
    rows.append(f"G17\nG0 @{numbers.uniform(1, 20):.3f} ^{numbers.uniform(-200, 400):.3f}")
    for _ in range(6):
        both = (f"@{numbers.uniform(1, 9):.3f}", f"^{numbers.uniform(-90, 90):.3f}")
        rows.append(f"G1 F600 {numbers.choice(('G90', 'G91'))} {numbers.choice((*both, ' '.join(both)))}")
    return "\n".join([*rows, "M2", ""])


def problem(tool, program, folder):
    there = theirs(program, folder)
    here, said = ours(tool, program, folder)
    if here is None and any(words in said for words in ("would gouge", "does not fit")):
        return REFUSED
    if here is None:
        return said
    for i, (mine, other) in enumerate(zip(here, there)):
        if mine[0] != other[0] or math.dist(mine[1], other[1]) > 2 * ALLOWED_MM:
            return f"move {i + 1}: {mine}, not {other}"
    return "" if len(here) == len(there) else f"{len(here)} moves, not {len(there)}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tool", type=pathlib.Path)
    parser.add_argument("--programs", type=int, default=300)
    parser.add_argument("--seed", type=int, default=20261123)
    options = parser.parse_args()
    if shutil.which("rs274") is None:
        print("SKIPPED: needs LinuxCNC's interpreter rs274 (Debian: linuxcnc-uspace)")
        sys.exit(77)
    failed = refused = 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for example in sorted(p for p in (ROOT / "examples").iterdir() if p.suffix in (".ngc", ".nc")):
            if said := problem(options.tool, example, folder):
                failed += 1
                print(f"{example.name}: {said}")
        for i in range(options.programs):
            program = folder / "random.ngc"
            make = {2: random_contour, 3: random_threads}.get(i % 4, random_program)
            program.write_text(make(random.Random(options.seed + i)), encoding="ascii")
            (folder / "rs274ngc.var").unlink(missing_ok=True)
            said = problem(options.tool, program, folder)
            if said == REFUSED:
                refused += 1
            elif said:
                failed += 1
                print(f"seed {options.seed + i}: {said}\n{program.read_text(encoding='ascii')}" if failed < 3 else f"seed {options.seed + i}: {said}")
    print(f"{options.programs} random programs and the examples: {failed} differ; in {refused} contours the tool does not fit")
    sys.exit(1 if failed or 5 * refused > options.programs else 0)


if __name__ == "__main__":
    main()
