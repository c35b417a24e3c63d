#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Where the moves of a program end, by a reader that shares no line with the interpreter.

It knows what posts write: lines, arcs, holes, units, steps, offsets, reference points, and the commands of printers. Whatever else may move the
machine is NotUnderstood. Machine coordinates, from rest at 0, with all offsets and stored points 0."""
import re

WORD = re.compile(r"([A-Z])\s*([-+]?(?:\d+\.?\d*|\.\d+))")
AXES = "XYZ"
PRINTERS = ("marlin", "klipper")
FREE = {17, 18, 19, 20, 21, 40, 49, 50, 54, 61, 64, 69, 80, 90, 91, 91.1, 94, 97, 98, 99}  # modes that this reader knows, or that move nothing
WITH_AXES = (10, 11, 26, 28, 29, 30)  # where they are left out their axis words go along
MOTIONS = (0, 1, 2, 3, 73, 81, 82, 83)
HOLES = MOTIONS[4:]
PECK_CLEARANCE_MM = 0.254


class NotUnderstood(Exception):
    pass


def without_comments(line):
    """Text in brackets and behind a semicolon is none."""
    return re.sub(r"\([^)]*(\)|$)", "", line if line.find("(") >= 0 and line.find("(") < line.find(";") else line.split(";")[0]).split(";")[0]


class Reader:
    """`moves`: each end in X, Y, Z, in order; a whole circle ends where it begins."""

    def __init__(self, dialect, ignored=()):
        self.dialect, self.ignored, self.moves, self.ended = dialect, set(ignored), [], False
        self.at, self.shift, self.factor = dict.fromkeys(AXES, 0.0), dict.fromkeys(AXES, 0.0), 1.0
        self.motion = self.before = None if dialect in ("linuxcnc", "fanuc") else 0
        self.steps, self.to_r, self.plane = False, dialect == "linuxcnc", 17
        self.hole, self.level = None, 0.0

    def read(self, text):
        for row in text.upper().splitlines():
            if not self.ended:
                self.line(without_comments(row).strip().removeprefix("/"), row)
        return self.moves

    def line(self, row, whole):
        first = row.split(" ")[0]
        if row in ("", "%") or re.fullmatch(r"O\d+", row) or first in self.ignored or (first[0] in "$?!~" and "$" in self.ignored):
            return
        if row == "$H":
            self.go(dict.fromkeys(AXES, 0.0))
            return
        words = WORD.findall(row)
        if self.dialect in PRINTERS:
            words = words[1:] if words and words[0][0] == "N" else words
            if words and words[0][0] in "MTP":  # a command of its own
                self.ended = words[0] in (("M", "2"), ("M", "02"))
                return
        elif WORD.sub("", row).strip() or re.match("[A-Z]{3}|[A-Z]_", row):
            raise NotUnderstood(whole)
        codes = [float(number) for letter, number in words if letter == "G" and f"G{number}" not in self.ignored]
        if not codes and any(letter == "G" and float(number) in WITH_AXES for letter, number in words):
            return
        for letter, number in words:
            if letter == "M" and float(number) in (97, 98, 99, 66):
                raise NotUnderstood(whole)
            self.ended = self.ended or (letter == "M" and float(number) in (2, 30))
        values = {letter: float(number) for letter, number in words if letter not in "GM"}
        if codes == [28] and self.dialect in PRINTERS:
            values |= {axis: 0.0 for axis in AXES if re.search(axis + r"(?![-+.\d])", row)}
        if set(codes) - FREE - set(MOTIONS) - {4, 28, 53, 92}:
            raise NotUnderstood(whole)
        self.block(codes, values)

    def block(self, codes, values):
        self.factor = 25.4 if 20 in codes else 1.0 if 21 in codes else self.factor
        self.steps = 91 in codes or (self.steps and 90 not in codes)
        self.to_r = 99 in codes or (self.to_r and 98 not in codes)
        self.plane = next((code for code in codes if code in (17, 18, 19)), self.plane)
        motion = next((code for code in codes if code in MOTIONS), None)
        if 4 in codes:
            return
        if 28 in codes:
            self.reference(motion, values)
        elif 92 in codes:
            self.shift |= {axis: self.at[axis] - values[axis] * self.factor for axis in AXES if axis in values}
        else:
            self.select(motion, 80 in codes)
            self.move(values, 53 in codes)

    def select(self, motion, ends_holes):
        if ends_holes:
            self.hole, self.motion = None, self.before if self.dialect == "fanuc" else None
        if motion is not None:
            self.motion = motion
        if self.motion not in HOLES:
            self.hole, self.before = None, self.motion

    def go(self, end):
        if any(abs(end[axis] - self.at[axis]) > 1e-7 for axis in AXES):
            self.moves.append(tuple(end[axis] for axis in AXES))
        self.at = dict(end)

    def target(self, values, machine=False):
        end = dict(self.at)
        for axis, step in zip(AXES, "UVW"):
            if axis in values:
                end[axis] = values[axis] * self.factor + (0.0 if machine else self.at[axis] if self.steps else self.shift[axis])
            elif step in values and self.dialect == "fanuc":
                end[axis] += values[step] * self.factor
        return end

    def reference(self, motion, values):
        axes = [axis for axis, step in zip(AXES, "UVW") if axis in values or (step in values and self.dialect == "fanuc")] or list(AXES)
        if self.dialect in PRINTERS:
            self.shift |= dict.fromkeys(axes, 0.0)
        else:
            self.select(motion, False)
            self.go(self.target(values))
        self.go(self.at | dict.fromkeys(axes, 0.0))

    def move(self, values, machine):
        has_axes = set(values) & set(AXES + ("UVW" if self.dialect == "fanuc" else ""))
        is_arc = self.motion in (2, 3)
        if not has_axes and not (is_arc and set(values) & set("IJK")):
            return
        if self.motion is None or set(values) & set("ABC"):
            raise NotUnderstood("no motion, or other axes")
        if self.motion in HOLES:
            self.drill(values)
            return
        end = self.target(values, machine)
        if is_arc and end == self.at:
            self.moves.append(tuple(end[axis] for axis in AXES))
        self.go(end)

    def drill(self, values):
        if self.steps or self.plane != 17 or values.get("L", values.get("K", 1.0)) != 1.0:
            raise NotUnderstood("holes by steps")
        if self.hole is None:
            self.hole, self.level = {}, self.at["Z"]
        self.hole |= {letter: values[letter] * self.factor for letter in "ZRQ" if letter in values}
        pecks = self.motion in (73, 83)
        if not {"Z", "R"} <= set(self.hole) or (pecks and self.hole.get("Q", 0.0) <= 0.0):
            raise NotUnderstood("a hole without its words")
        clear, bottom = self.hole["R"] + self.shift["Z"], self.hole["Z"] + self.shift["Z"]
        if self.level < clear:
            self.go(self.at | {"Z": clear})
        up = clear if self.to_r or self.level < clear else self.level
        over = self.target({axis: values[axis] for axis in "XY" if axis in values})
        self.go(over | {"Z": max(self.at["Z"], up)})
        self.go(over | {"Z": clear})
        depth = clear - self.hole.get("Q", 0.0) if pecks else bottom
        while depth > bottom:
            self.go(over | {"Z": depth})
            if self.motion == 83:
                self.go(over | {"Z": clear})
            self.go(over | {"Z": depth + PECK_CLEARANCE_MM})
            depth -= self.hole["Q"]
        self.go(over | {"Z": bottom})
        self.go(over | {"Z": up})


def program_ends(text, dialect, ignored=()):
    """The end of each move. Raises NotUnderstood."""
    return Reader(dialect, ignored).read(text)
