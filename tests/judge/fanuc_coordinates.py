# SPDX-License-Identifier: MIT
"""Coordinates of Fanuc's and Haas' controls for the reader of other_meaning.py, by complex numbers and in G17: G52, G54.1, G154, G10, G68, G51 and
G51.1 with their ends. It may understand more than the tool takes."""
import cmath
import math

WORDS = {50, 50.1, 51, 51.1, 52, 54.1, 68, 69, 154, *range(110, 130)}
AXES = "XYZA"


class Unclear(Exception):
    pass


class Coordinates:
    def __init__(self):
        self.further, self.system = {}, None
        self.local = dict.fromkeys(AXES, 0.0)
        self.angle, self.about = 0.0, 0j
        self.factor, self.held = 1.0, dict.fromkeys("XYZ", 0.0)
        self.mirrors = {}

    def applies(self):
        return self.angle != 0.0 or self.factor != 1.0 or bool(self.mirrors)

    def placed(self, point):
        """From the program to its work system."""
        out = {axis: 2.0 * self.mirrors[axis] - value if axis in self.mirrors else value for axis, value in point.items()}
        for axis in "XYZ":
            out[axis] = self.held[axis] + self.factor * (out[axis] - self.held[axis])
        if self.angle != 0.0:
            turned = self.about + (complex(out["X"], out["Y"]) - self.about) * cmath.exp(1j * math.radians(self.angle))
            out["X"], out["Y"] = turned.real, turned.imag
        return {axis: value + self.local[axis] for axis, value in out.items()}

    def programmed(self, point):
        """And back."""
        out = {axis: value - self.local[axis] for axis, value in point.items()}
        if self.angle != 0.0:
            turned = self.about + (complex(out["X"], out["Y"]) - self.about) * cmath.exp(-1j * math.radians(self.angle))
            out["X"], out["Y"] = turned.real, turned.imag
        for axis in "XYZ":
            out[axis] = self.held[axis] + (out[axis] - self.held[axis]) / self.factor
        return {axis: 2.0 * self.mirrors[axis] - value if axis in self.mirrors else value for axis, value in out.items()}

    def origin(self):
        return None if self.system is None else self.further.setdefault(self.system, dict.fromkeys(AXES, 0.0))

    def read(self, codes, words, stated, program, text):
        """`stated`: the words of axes in mm. Takes the words of `codes` out of `words`. `program`: where the tool stands in the program."""
        if not codes:
            return
        if 69 in codes:
            self.angle = 0.0
        if 50 in codes:
            if self.angle != 0.0:
                raise Unclear(text)
            self.factor = 1.0
        for code in set(codes) & {54.1, 154}:
            number = words.pop("P", 0.0)
            if number != int(number) or not 1 <= number <= (48 if code == 54.1 else 99):
                raise Unclear(text)
            self.system = int(number)
        for code in set(codes) & set(range(110, 130)):
            self.system = int(code) - 109
        taking = set(codes) & {50.1, 51, 51.1, 52, 68}
        if len(taking) > 1:
            raise Unclear(text)
        for axis in AXES:
            if taking:
                words.pop(axis, None)
        centre = complex(stated.get("X", program["X"]), stated.get("Y", program["Y"]))
        if 50.1 in codes:
            self.mirrors = {axis: place for axis, place in self.mirrors.items() if axis not in stated}
        elif 51.1 in codes:
            self.mirrors |= stated
        elif 52 in codes:
            self.local |= stated
        elif 51 in codes:
            if "." not in text.split("P")[1] or self.applies():
                raise Unclear(text)
            self.factor, self.held = words.pop("P"), {axis: stated.get(axis, program[axis]) for axis in "XYZ"}
        elif 68 in codes:
            if "R" not in words or (self.angle != 0.0 and "X" not in stated):
                raise Unclear(text)
            held = complex(self.held["X"], self.held["Y"])
            self.angle, self.about = words.pop("R"), held + self.factor * (centre - held)
