#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Whether a program is accepted with another meaning than its controller's: random programs in four dialects, with words that other controllers
have, and with --ignore. A small reader that shares no line with the interpreter says what each moves, or that it is not understood.

    other_meaning.py build/release/bin/splinefeed [--programs 60] [--seed N] [--verbose]

An accepted program must have the reader's ends of moves, their kinds, lengths and times, and its dwells. What the reader does not understand must be
refused, whatever option is given. What the reader understands may be refused: how much is printed."""
import argparse
import json
import math
import pathlib
import random
import re
import subprocess
import sys
import tempfile

from fanuc_coordinates import WORDS as PLACING, Coordinates, Unclear

DIALECTS = ("linuxcnc", "grbl", "fanuc", "marlin")
MACHINE = "[path]\nmax_feed_mm_s = 100\n" + "".join(
    f'[[axis]]\nname = "{axis}"\nmax_velocity_mm_s = 100\nmax_acceleration_mm_s2 = 1000\n' for axis in "xyz") + (
        '[[axis]]\nname = "a"\nkind = "rotary"\nmax_velocity_mm_s = 360\nmax_acceleration_mm_s2 = 3600\n')
NEAR = 2e-5  # mm, degrees, s
LEAST_TAKEN = 0.5  # of what the reader understands
AXES = "XYZA"
WORD = re.compile(r"([A-Z])([-+]?(?:\d+\.?\d*|\.\d+))")
STILL = {3, 4, 5, 7, 8, 9}  # M words that move nothing
PRINTER_STILL = {82, 83, 84, 104, 106, 107, 109, 117, 140}
# Words of other controls, or of no one: each changes the path, its place or the order of the blocks.
FOREIGN = ("G68 X0 Y0 R90", "G16", "G51 X0 Y0 P2", "G51.1 X0", "G65 P9000 A1", "G66 P9000", "G12 I5", "G54.1 P2", "G154 P3", "G107 X1", "G234",
           "IF [#1 EQ #0] GOTO 10", "WHILE[#1LT5]DO1", "N50 GOTO 10", "END1", "(ABORT, no part)", "TRANS X5", "ROT Z30", "M98 P77", "M99 P20",
           "SET_GCODE_OFFSET Z=1", "SAVE_GCODE_STATE NAME=a", "$J=G91X5F100", "$RST=#", "SDCARD_LOOP_BEGIN COUNT=2")
OF_LATHES = ("T0101", "G50 S2000", "G92 X40. Z-20. F1.5", "G0 X42. Z2.\nG90 X38. Z-20. F0.2", "G75 X1 Z2 P3 Q4", "G71 U2. R1.", "G21\nG99 G1 X5 F0.2", "G96 S200")
LATHE_ROWS = {row for rows in OF_LATHES for row in rows.split("\n") if not row.startswith(("G0 ", "G21"))}
OF_PRINTERS = ("M808 L3", "M92 X160", "M206 X5", "M290 Z0.1", "M810 G1 X5", "M32 /a.gco", "M112", "M665 R5")
IGNORED = (None, "unknown", "unknown,M31,G68,G16,G51,G65,IF,WHILE,END1,GOTO,TRANS,M98,M99,M808,M92,M206,$*,SET_GCODE_OFFSET,T,S")


class NotUnderstood(Exception):
    pass


class Reader:
    """What a program moves: `moves` of (kind, end in machine coordinates, length of x y z, seconds at its feed), `dwells` in seconds."""

    def __init__(self, dialect):
        self.dialect, self.moves, self.dwells = dialect, [], []
        self.at = dict.fromkeys(AXES, 0.0)  # machine
        self.work = [dict.fromkeys(AXES, 0.0) for _ in range(2)]
        self.system, self.shift = 0, dict.fromkeys(AXES, 0.0)
        self.motion = None if dialect in ("linuxcnc", "fanuc") else 0
        self.before_cycle, self.cycle, self.level = self.motion, None, 0.0
        self.steps, self.inches, self.to_r = False, False, False
        self.feed, self.feed_in_inches = (1500.0 if dialect == "marlin" else 0.0), False
        self.ended = False
        self.fanuc = Coordinates()  # nothing of it applies elsewhere

    def offset(self, axis):
        return (self.fanuc.origin() or self.work[self.system])[axis] + self.shift[axis]

    def program(self):
        return self.fanuc.programmed({axis: self.at[axis] - self.offset(axis) for axis in AXES})

    def mm(self, axis, value):
        return value * 25.4 if self.inches and axis != "A" else value

    def go(self, kind, end, angle=None):
        way = {axis: end[axis] - self.at[axis] for axis in AXES}
        space = math.hypot(way["X"], way["Y"], way["Z"])
        space = space if space > 1e-9 else 0.0
        if angle is not None:
            space = math.hypot(angle[0] * angle[1], way["Z"])
        turn = abs(way["A"])
        if space + turn > 1e-9:
            if kind != "rapid" and self.feed <= 0.0:
                raise NotUnderstood("no feed")
            degrees = turn * 25.4 if self.feed_in_inches and self.dialect != "grbl" else turn
            counted = math.hypot(space, degrees) if self.dialect in ("grbl", "fanuc") else space if space > 0.0 else degrees
            self.moves.append((kind, tuple(end[axis] for axis in AXES), space, None if kind == "rapid" else 60.0 * counted / self.feed))
        self.at = dict(end)

    def target(self, words):
        end, moved = self.program(), False
        for axis in AXES:
            step = "UVW-"["XYZA".index(axis)]
            if self.dialect == "fanuc" and step in words:
                if axis in words:
                    raise NotUnderstood("twice")
                end[axis] += self.mm(axis, words[step])
                moved = True
            elif axis in words:
                end[axis] = self.mm(axis, words[axis]) + (end[axis] if self.steps else 0.0)
                moved = True
        return {axis: value + self.offset(axis) for axis, value in self.fanuc.placed(end).items()} if moved else dict(self.at)

    def hole(self, words):
        cycle = self.cycle
        end = self.target({letter: value for letter, value in words.items() if letter in "XY"})
        cleared, bottom = (cycle[word] + self.offset("Z") + self.fanuc.local["Z"] for word in "RZ")
        if cleared < bottom:
            raise NotUnderstood("below")
        if self.level < cleared:
            self.go("rapid", self.at | {"Z": cleared})
        up = cleared if self.to_r or self.level < cleared else self.level
        self.go("rapid", end | {"Z": max(self.at["Z"], up)})
        self.go("rapid", end | {"Z": cleared})
        depth = cleared - cycle["Q"] if cycle["Q"] > 0.0 else bottom
        while depth > bottom:
            self.go("line", end | {"Z": depth})
            if cycle["code"] == 83:
                self.go("rapid", end | {"Z": cleared})
            self.go("rapid", end | {"Z": depth + 0.254})
            depth -= cycle["Q"]
        self.go("line", end | {"Z": bottom})
        if cycle["code"] == 82 or cycle["P"] > 0.0:
            self.dwells.append(cycle["P"])
        self.go("rapid", end | {"Z": up})

    def dwell(self, words, text):
        given = re.search(r"P(\S+)", text)
        if self.dialect == "fanuc":
            if "X" in words:
                return words["X"]
            return words["P"] if given and "." in given[1] else words["P"] / 1000.0
        if self.dialect == "marlin":
            return words["S"] if "S" in words else words.get("P", 0.0) / 1000.0
        return words["P"]

    def reference(self, codes, words):
        if self.dialect == "marlin":
            axes = [axis for axis in "XYZ" if axis in words] or list(AXES)
            for axis in axes:
                self.shift[axis] = 0.0
            self.go("rapid", self.at | dict.fromkeys(axes, 0.0))
            return
        if self.dialect == "fanuc" and set(codes) & {0, 1}:
            self.motion = self.before_cycle = (set(codes) & {0, 1}).pop()
        elif set(codes) & {0, 1}:
            raise NotUnderstood("two motions")
        axes = [axis for axis in AXES if axis in words or (self.dialect == "fanuc" and "UVW-"["XYZA".index(axis)] in words)] or list(AXES)
        self.go("rapid", self.target(words))
        self.go("rapid", self.at | dict.fromkeys(axes, 0.0))

    def arc(self, code, words):
        if "R" not in words:
            raise NotUnderstood("no radius")
        end = self.target(words)
        way = math.hypot(end["X"] - self.at["X"], end["Y"] - self.at["Y"])
        radius = self.mm("X", words["R"]) * self.fanuc.factor
        if way > 2.0 * radius or way < 1e-6:
            raise NotUnderstood("radius")
        self.go("arc", end, (radius, 2.0 * math.asin(0.5 * way / radius)))

    def line(self, text):
        bare = re.sub(r"\([^)]*\)", "", text.split(";")[0]).upper().strip()
        if self.ended or bare in ("", "%") or re.fullmatch(r"O\d+", bare):
            if "(ABORT" in text.upper() and not self.ended:
                raise NotUnderstood(text)
            return
        if self.dialect == "fanuc" and text in LATHE_ROWS:
            raise NotUnderstood(text)
        if "(ABORT" in text.upper() or WORD.sub("", bare).strip() not in (
                ("", "X", "Y", "Z") if self.dialect == "marlin" and bare.startswith("G28") else ("",)):
            raise NotUnderstood(text)
        words, codes, ms = {}, [], []
        for letter, number in WORD.findall(bare):
            if letter in "GM":
                (codes if letter == "G" else ms).append(float(number))
            elif letter in words:
                raise NotUnderstood("twice")
            else:
                words[letter] = float(number)
        if self.dialect == "marlin":
            words |= {letter: 0.0 for letter in "XYZ" if bare.startswith("G28") and re.search(letter + r"(?![-+.\d])", bare)}
            words.pop("E", None)
            if ms and (ms[0] in PRINTER_STILL or ms[0] in STILL):
                return
        for code in ms:
            known = code in STILL or code in (2, 30) or (code == 31 and self.dialect == "fanuc") or (code == 6 and "T" in words)
            if not known:
                raise NotUnderstood(text)
            self.ended = self.ended or code in (2, 30)
        self.block(codes, words, text.upper())

    def place(self, codes, words, text):
        """Words of coordinates, in fanuc."""
        stated = {axis: self.mm(axis, words[axis]) for axis in AXES if axis in words}
        try:
            self.fanuc.read(codes, words, stated, self.program(), text)
        except Unclear as why:
            raise NotUnderstood(text) from why

    def block(self, codes, words, text):
        placing = [code for code in codes if code in PLACING] if self.dialect == "fanuc" else []
        codes = [code for code in codes if code not in placing]
        modes = {17, 20, 21, 90, 91, 94, 98, 99, 54, 55}
        motions = [code for code in codes if code in (0, 1, 2, 3, 5, 73, 80, 81, 82, 83)]
        others = [code for code in codes if code in (4, 10, 28, 52, 92)]
        if set(codes) - modes - set(motions) - set(others) or (52 in others and self.dialect in ("grbl", "marlin")):
            raise NotUnderstood(text)
        if self.dialect == "marlin" and set(codes) & {98, 99, 10, 73, 81, 82, 83}:
            raise NotUnderstood(text)
        inches = self.inches if not set(codes) & {20, 21} else 20 in codes
        if "F" in words:
            self.feed_in_inches = inches if self.dialect == "grbl" else self.inches
            self.feed = words["F"] * (25.4 if self.feed_in_inches else 1.0)
        self.inches = inches
        self.steps = 91 in codes or (self.steps and 90 not in codes)
        self.to_r = 99 in codes or (self.to_r and 98 not in codes)
        self.system = 0 if 54 in codes else 1 if 55 in codes else self.system
        if 54 in codes or 55 in codes:
            self.fanuc.system = None
        self.place(placing, words, text)
        has_axes = set(words) & set(AXES + ("UVW" if self.dialect == "fanuc" else ""))
        if 4 in others:
            self.dwells.append(self.dwell(words, text))
        elif 28 in others:
            self.reference(codes, words)
        elif 10 in others:
            if words["L"] == 20 and self.dialect != "fanuc":
                raise NotUnderstood("where it stands")
            system = (self.fanuc.further.setdefault(int(words["P"]), dict.fromkeys(AXES, 0.0)) if words["L"] == 20
                      else self.work[int(words["P"]) - 1 if words["P"] > 0 else self.system])
            adds = self.steps and self.dialect == "fanuc"
            system.update({axis: self.mm(axis, words[axis]) + (system[axis] if adds else 0.0) for axis in AXES if axis in words})
        elif 52 in others or 92 in others:
            for axis in set(words) & set(AXES):
                value = self.mm(axis, words[axis])
                self.fanuc.local[axis] = 0.0
                self.shift[axis] = value if 52 in others else self.at[axis] - (self.fanuc.origin() or self.work[self.system])[axis] - value
        elif motions == [5] and self.dialect == "marlin" and not set(words) - {"F"}:
            pass
        elif motions and motions[0] >= 73 and motions[0] != 80:
            self.level = self.at["Z"] if self.cycle is None else self.level
            point = re.search(r"P(\S+)", text)
            late = self.dialect == "fanuc" and point and "." not in point[1]
            self.cycle = {"code": motions[0], "Z": self.mm("Z", words["Z"]), "R": self.mm("Z", words["R"]), "Q": self.mm("Z", words.get("Q", 0.0)),
                          "P": words.get("P", 0.0) / (1000.0 if late else 1.0)}
            if words.get("L", words.get("K", 1.0)) > 0.0:
                self.hole(words)
        else:
            self.move(motions, words, has_axes)

    def move(self, motions, words, has_axes):
        if 80 in motions or motions:
            self.motion = next((code for code in motions if code != 80), self.before_cycle if self.dialect == "fanuc" else None)
            self.cycle, self.before_cycle = None, self.motion
        if self.cycle is not None and has_axes:
            if has_axes - {"X", "Y"}:
                raise NotUnderstood("a hole's other words")
            self.hole(words)
        elif has_axes and self.motion is None:
            raise NotUnderstood("no motion")
        elif has_axes and self.motion in (2, 3):
            self.arc(self.motion, words)
        elif has_axes:
            rapid = self.motion == 0 and self.dialect != "marlin"
            self.go("rapid" if rapid else "line", self.target(words))


def random_program(numbers, dialect):
    """Lines that the dialect has; in every second program there is a foreign one."""
    def near(size=20.0):
        return f"{numbers.uniform(-size, size):.3f}"

    def some(least, most):
        return f"{numbers.uniform(least, most):.2f}"
    rows = ["%", "O1000 (TEST)"] if dialect == "fanuc" else []
    rows += ["G21 G90 G17 G94", f"G0 X{near()} Y{near()} Z{some(1, 9)}"]
    lines = [lambda: f"G0 X{near()} Y{near()}", lambda: f"G1 X{near()} Y{near()} F{some(100, 3000)}", lambda: f"G1 Z{near(9)} F{some(100, 3000)}",
             lambda: f"X{near()}", lambda: f"X{near()} Y{near()} Z{near(5)}", lambda: f"G{numbers.choice((2, 3))} X{near()} Y{near()} R90 F{some(100, 3000)}",
             lambda: "G90", lambda: "G91", lambda: "M3 S500", lambda: "M8", lambda: "M5", lambda: "(a comment)", lambda: f"G92 X{near()}"]
    if dialect != "marlin":
        hole = lambda: (f"G90 G{numbers.choice((98, 99))} " + numbers.choice(("G81", f"G82 P{numbers.choice(('0.25', '1.'))}", "G83 Q1.5", "G73 Q1.5")) +
                        f" X{near()} Y{near()} Z-{some(1, 6)} R{some(1, 4)} F{some(50, 500)}\nX{near()} Y{near()}\nG80")
        lines += [hole, lambda: f"G4 P{some(0.1, 2)}", lambda: f"G1 X{near()} A{near(90)} F{some(100, 900)}", lambda: f"G1 A{near(90)} F{some(100, 900)}",
                  lambda: f"G10 L2 P{numbers.choice((1, 2))} X{near()} Z{near()}", lambda: "G55", lambda: "G54", lambda: "G20", lambda: "G21",
                  lambda: f"G28 Z{near()}", lambda: f"G80\nG1 X{near()} F{some(100, 900)}"]
    if dialect in ("linuxcnc", "fanuc"):
        lines += [lambda: f"G52 X{near()}"]
    if dialect == "fanuc":
        lines += [lambda: f"U{near()}", lambda: f"G1 W{near()} F200.", lambda: "G28 U0 W0", lambda: f"G4 X{some(0.1, 2)}",
                  lambda: f"G4 P{numbers.randint(1, 2000)}", lambda: "G0 G91 G28 Z0\nG90", lambda: "T1 M6", lambda: f"G80\nZ{near()}",
                  lambda: f"G90 G98 G83 X{near()} Z-3. R1. Q2. P{numbers.randint(1, 900)} F90.\nG80",
                  lambda: f"G90 G98 G81 X{near()} Y{near()} Z-3. R1. F90. {numbers.choice('LK')}0\nX{near()}\nG80"]
        shape = lambda: f"G90 G0 X{near()} Y{near()}\nG1 X{near()} F600.\nG2 X{near()} Y{near()} R90.\nG91 G1 Y{near()}\nG90"
        lines += [lambda: f"G10 L20 P{numbers.randint(1, 3)} X{near()} Z{near()}", lambda: f"G91 G10 L{numbers.choice((2, 20))} P1 Y{near()}\nG90",
                  lambda: f"G54.1 P{numbers.randint(1, 3)}", lambda: f"G{numbers.randint(110, 112)}", lambda: f"G154 P{numbers.randint(1, 3)} G0 X{near()}", lambda: f"G90 G52 X{near()} Y{near()}",
                  lambda: "G90 G52 X0 Y0 Z0", lambda: "G69", lambda: "G50", lambda: "G50.1 X0 Y0",
                  lambda: f"G68 X{near()} Y{near()} R{near(180)}\n{shape()}\nG69\n{shape()}", lambda: f"G90 G68 R{near(180)}\n{shape()}\nG69",
                  lambda: f"G51 X{near()} Y{near()} P{some(0.2, 4)}\n{shape()}\nG50\n{shape()}", lambda: f"G51 P1.5\nG68 X1. Y2. R30.\n{shape()}\nG69\nG50",
                  lambda: f"G90 G51.1 {numbers.choice('XY')}{near()}\n{shape()}\nG50.1 X0 Y0\n{shape()}", lambda: f"G68 X0 Y0 R45.\n{hole()}\nG69"]
    if dialect == "marlin":
        lines += [lambda: f"G4 P{numbers.randint(1, 2000)}", lambda: f"G4 S{some(0.1, 2)}", lambda: "G28 Z P0 T140", lambda: "G28 X0", lambda: "G28",
                  lambda: "G5", lambda: "M104 S200", lambda: "M83", lambda: f"G1 X{near()} E1.5 F{some(100, 3000)}", lambda: "G92 E0"]
    for _ in range(numbers.randint(3, 12)):
        rows += numbers.choice(lines)().split("\n")
    if numbers.random() < 0.5:
        foreign = FOREIGN + {"fanuc": OF_LATHES, "marlin": OF_PRINTERS}.get(dialect, ())
        rows[numbers.randint(4 if dialect == "fanuc" else 2, len(rows)):0] = numbers.choice(foreign).split("\n")
    return rows + ["M30" if dialect != "marlin" else "M2"]


def accepted(tool, folder, rows, dialect, ignore):
    """(moves, dwells), or the sentence of the refusal."""
    (folder / "part.ngc").write_text("\n".join(rows) + "\n", encoding="ascii")
    options = ",".join(filter(None, (ignore, "E" if dialect == "marlin" else None, "M31" if ignore else None)))
    call = subprocess.run([tool, "plan", "part.ngc", "-m", "m.toml", "--dialect", dialect, "--elements", "e.json", "--quiet", "--no-advice"] +
                          (["--ignore", options] if options else []), cwd=folder, capture_output=True, text=True, check=False)
    if call.returncode != 0:
        return call.stderr.strip()
    document = json.loads((folder / "e.json").read_text(encoding="utf-8"))
    moves = []
    for element in document["elements"]:
        way = [b - a for a, b in zip(element["from"], element["to"])]
        space = math.hypot(*way[:3])
        if element["type"] == "arc":
            space = math.hypot(math.dist(element["from"][:2], element["centre"][:2]) * element["angle"], way[2])
        if space + abs(way[3]) > 1e-9:
            counted = space if space > 0.0 else abs(way[3])
            moves.append(("rapid" if element.get("rapid") else element["type"], tuple(element["to"]), space,
                          None if element.get("rapid") else counted / element["feed_mm_s"]))
    return moves, [dwell["seconds"] for dwell in document.get("dwells", [])]


def difference(mine, theirs):
    """What differs first; empty: nothing."""
    for i, (one, other) in enumerate(zip(mine[0], theirs[0])):
        time = 0.0 if one[3] is None or other[3] is None else abs(one[3] - other[3]) / max(other[3], 0.01)
        if one[0] != other[0] or math.dist(one[1], other[1]) > NEAR or abs(one[2] - other[2]) > 1e-3 or time > 1e-3:
            return f"move {i}: {one}, of the reader {other}"
    if len(mine[0]) != len(theirs[0]):
        return f"{len(mine[0])} moves, of the reader {len(theirs[0])}"
    if len(mine[1]) != len(theirs[1]) or any(abs(a - b) > NEAR for a, b in zip(mine[1], theirs[1])):
        return f"dwells {mine[1]}, of the reader {theirs[1]}"
    return ""


def judged(tool, folder, dialect, seed):
    """(what is wrong, whether the reader understands the program, whether the tool takes it)"""
    numbers = random.Random(f"{seed} {dialect}")
    rows, ignore = random_program(numbers, dialect), numbers.choice(IGNORED)
    reader = Reader(dialect)
    try:
        for row in rows:
            reader.line(row)
        expected = (reader.moves, reader.dwells)
    except NotUnderstood as why:
        expected = str(why)
    result = accepted(tool, folder, rows, dialect, ignore)
    taken, known = not isinstance(result, str), not isinstance(expected, str)
    wrong = "" if not taken else f"taken, but: {expected}" if not known else difference(result, expected)
    listing = "\n".join(f"  {row}" for row in rows)
    return (f"seed {seed}, {dialect}, --ignore {ignore}: {wrong}\n{listing}" if wrong else ""), known, taken, result


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("tool")
    parser.add_argument("--programs", type=int, default=60)
    parser.add_argument("--seed", type=int, default=20261130)
    parser.add_argument("--verbose", action="store_true")
    arguments = parser.parse_args()
    tool, wrong = str(pathlib.Path(arguments.tool).resolve()), 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "m.toml").write_text(MACHINE, encoding="ascii")
        for dialect in DIALECTS:
            understood = taken = 0
            for seed in range(arguments.seed, arguments.seed + arguments.programs):
                problem, known, is_taken, result = judged(tool, folder, dialect, seed)
                understood += known
                taken += known and is_taken
                if problem:
                    wrong += 1
                    print(problem)
                elif arguments.verbose and known and not is_taken:
                    print(f"seed {seed}, {dialect}: {result}")
            print(f"{dialect}: {arguments.programs} programs, {understood} understood, {taken} of these taken, seeds from {arguments.seed}")
            wrong += taken < LEAST_TAKEN * understood or understood == 0
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
