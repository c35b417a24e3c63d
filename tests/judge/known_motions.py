# SPDX-License-Identifier: MIT
"""Random motions from rest to rest whose time is known: of each axis a chain of ramps between velocities that are mostly its limit, with the axis' largest acceleration and,
where it has a limit, jerk.

A path that such a motion travels can be travelled in its time. A planner that takes longer is not at its best; how much shorter the least
time is, is not known. Each axis ramps or cruises at its limit nearly all the time, so it is seldom much.

Every instant at which a jerk, or without its limit an acceleration, changes is a whole number of ticks. So velocities and places are integers times jerk tick^3 / 6 or
acceleration tick^2 / 2, sums are exact, and no piece takes less than a tick. Between these instants each axis is a cubic or a parabola in time: the path is a Bezier segment."""
import json
import math
import random

from planning import Case, Setting

FULL_SHARE = 0.97  # of the time in which some axis is at a limit: a motion with less is drawn again
LEAST_SPEED = 0.05  # of some axis' limit, but at both ends: below it the path has nearly a cusp
AXES = (2, 2, 2, 3, 3, 4, 5, 6)  # how many: the forms with most words have few
GCODE_TOLERANCE_MM = 0.01
SHORTEST_MM = 0.0005  # of a piece: the last digit of what a file or a Fixed says of a shorter one turns its direction
FORMS = ("curve", "elements", "g5")


def polygon_mm(points):
    return sum(math.dist(a, b) for a, b in zip(points, points[1:]))


class AxisMotion:
    """The phases of one axis: how many ticks, and the sign of its jerk. Before `fill` it does not know how long it cruises."""

    def __init__(self, numbers, first, last):
        """first, last: it moves in the first and in the last tick."""
        self.jerk_ticks = self.drawn_jerk_ticks(numbers)
        self.ramp_ticks = numbers.randint(max(12, self.jerk_ticks), 60)  # from rest to its limit with the full acceleration
        self.limit = self.jerk_ticks * self.ramp_ticks  # in jerk tick^2
        self.levels = self.drawn_levels(numbers)
        self.weights = [numbers.expovariate(1.0) * (1.0 if abs(level) == self.limit else 0.05) for level in self.levels]
        self.weights[0] = 0.0 if first or numbers.random() < 0.6 else 0.3 * self.weights[1]
        self.weights[-1] = 0.0 if last or numbers.random() < 0.6 else 0.3 * self.weights[1]

    @staticmethod
    def drawn_jerk_ticks(numbers):
        return numbers.randint(3, 15)

    def drawn_dip(self, numbers):
        """By how much a limit is left for a moment, without the full acceleration."""
        return numbers.randint(2, self.jerk_ticks - 1) ** 2

    def drawn_levels(self, numbers):
        """Velocities, each of which a ramp with the largest jerk leaves for the next; from 0 to 0."""
        n, full = self.jerk_ticks, self.limit
        levels = [0, numbers.choice((-full, full))]
        for _ in range(numbers.randint(0, 4)):
            now, kind = levels[-1], numbers.random()
            if kind < 0.25 and abs(now) == full:  # slower for a moment
                levels += [now - int(math.copysign(self.drawn_dip(numbers), now)), now]
            elif kind < 0.8 or abs(now) != full:
                levels.append(-full if now > 0 else full)
            else:
                part = n * numbers.randint(-self.ramp_ticks, self.ramp_ticks)
                if abs(part - now) >= n * n and (part == 0 or abs(part) >= n * n):
                    levels.append(part)
        return levels if levels[-1] == 0 else [*levels, 0]

    def ramp(self, change):
        n, size, sign = self.jerk_ticks, abs(change), 1 if change > 0 else -1
        ticks = min(n, math.isqrt(size))
        if ticks * (size // ticks) != size:
            raise ValueError(f"no ramp of whole ticks changes the velocity by {size}")
        return [(ticks, sign), (size // ticks - ticks, 0), (ticks, -sign)]

    def ramps(self):
        return [self.ramp(after - before) for before, after in zip(self.levels, self.levels[1:])]

    def least_ticks(self):
        return sum(ticks for ramp in self.ramps() for ticks, _ in ramp)

    def fill(self, ticks):
        """[(ticks, sign of the jerk)] of so many ticks: what the ramps leave is cruised by weight."""
        spare, cruises, so_far, spent = ticks - self.least_ticks(), [], 0.0, 0
        for weight in self.weights:
            so_far += weight
            cruises.append(round(spare * so_far / sum(self.weights)) - spent)
            spent += cruises[-1]
        phases = []
        for cruise, ramp in zip(cruises, [*self.ramps(), []]):
            phases += [(cruise, 0), *ramp]
        self.phases = [phase for phase in phases if phase[0] > 0]

    def breaks(self):
        at, found = 0, {0}
        for ticks, _ in self.phases:
            at += ticks
            found.add(at)
        return found

    def pieces(self, instants):
        """Between these instants, in units of jerk tick^3 / 6: four control points, and what it begins with (twice the velocity, acceleration, jerk)."""
        jerks = [sign for ticks, sign in self.phases for _ in range(ticks)]
        p, v, a, found = 0, 0, 0, []
        for start, end in zip(instants, instants[1:]):
            t, j = end - start, jerks[start]
            points = (p, p + v * t, p + 2 * v * t + a * t * t, p + 3 * v * t + 3 * a * t * t + j * t**3)
            found.append((points, (v, a, j)))
            p, v, a = points[3], v + 2 * a * t + j * t * t, a + j * t
        if v or a:
            raise ValueError("the axis does not end at rest")
        return found

    def at_limit(self, piece):
        _, (v, a, j) = piece
        return bool(j or a or abs(v) == 2 * self.limit)

    def speed(self, piece, t):
        """As a share of the limit, t ticks behind the start of the piece."""
        _, (v, a, j) = piece
        return abs(v + 2 * a * t + j * t * t) / (2 * self.limit)


class AxisMotionWithoutJerk(AxisMotion):
    """The same whose phases have the sign of its acceleration: a jerk that takes one tick, which counts for none."""

    @staticmethod
    def drawn_jerk_ticks(numbers):
        return 1

    def drawn_dip(self, numbers):
        return numbers.randint(1, self.limit - 1)

    def ramp(self, change):
        return [(abs(change), 1 if change > 0 else -1)]

    def pieces(self, instants):
        """In units of acceleration tick^2 / 2: three control points."""
        signs = [sign for ticks, sign in self.phases for _ in range(ticks)]
        p, v, found = 0, 0, []
        for start, end in zip(instants, instants[1:]):
            t, a = end - start, signs[start]
            points = (p, p + v * t, p + 2 * v * t + a * t * t)
            found.append((points, (2 * v, a, 0)))
            p, v = points[2], v + a * t
        if v:
            raise ValueError("the axis does not end at rest")
        return found


class KnownMotion:
    """Limits of each axis (velocity, acceleration, jerk or None in mm and s), `seconds`, and `control_points` of each piece in mm."""

    def __init__(self, seed, axes=0, jerk=True):
        numbers = random.Random(f"known motion {seed}{'' if jerk else ' without jerk'}")
        self.seed, self.kind = seed, AxisMotion if jerk else AxisMotionWithoutJerk
        count = axes or numbers.choice(AXES)
        while not self.drawn(numbers, count):
            pass

    def drawn(self, numbers, count):
        """Whether it is one that is wanted."""
        first, last = numbers.randrange(count), numbers.randrange(count)
        axes = [self.kind(numbers, i == first, i == last) for i in range(count)]
        ticks = int(max(axis.least_ticks() for axis in axes) * numbers.uniform(1.05, 1.5)) + 1
        for axis in axes:
            axis.fill(ticks)
        instants = sorted(set().union(*(axis.breaks() for axis in axes)))
        pieces = [axis.pieces(instants) for axis in axes]
        if not self.travels(axes, instants, pieces):
            return False
        tick_s = numbers.uniform(0.0015, 0.004)
        self.seconds, self.piece_seconds = ticks * tick_s, [tick_s * (end - start) for start, end in zip(instants, instants[1:])]
        self.limits, units = [], []
        for axis in axes:
            velocity = 10 ** numbers.uniform(1.3, 2.6)
            acceleration = velocity / (axis.ramp_ticks * tick_s)
            limits = (velocity, acceleration, acceleration / (axis.jerk_ticks * tick_s))
            self.limits.append(limits if self.kind is AxisMotion else (velocity, acceleration, None))
            units.append(limits[2] * tick_s**3 / 6.0 if self.kind is AxisMotion else acceleration * tick_s**2 / 2.0)
        points = [zip(*(piece[0] for piece in row)) for row in zip(*pieces)]
        self.control_points = [[[unit * place for unit, place in zip(units, point)] for point in row] for row in points]
        return min(polygon_mm(points) for points in self.control_points) >= SHORTEST_MM

    @staticmethod
    def travels(axes, instants, pieces):
        """Whether some axis is at a limit nearly all the time, and the path stands nowhere but at its ends."""
        ticks = [end - start for start, end in zip(instants, instants[1:])]
        rows = list(zip(*pieces))
        full = sum(t for t, row in zip(ticks, rows) if any(axis.at_limit(piece) for axis, piece in zip(axes, row)))
        speeds = [max(axis.speed(piece, t * part / 8) for axis, piece in zip(axes, row)) for t, row in zip(ticks, rows) for part in range(8)]
        moving = [i for i, speed in enumerate(speeds) if speed >= LEAST_SPEED]
        return full >= FULL_SHARE * instants[-1] and min(speeds[moving[0]:moving[-1] + 1]) >= LEAST_SPEED

    def feed(self):
        """More than the limits of the axes allow together."""
        return math.ceil(1.01 * math.hypot(*(velocity for velocity, _, _ in self.limits)))

    def straight(self, index):
        """The pieces at rest: their direction is that of the jerk."""
        return index in (0, len(self.control_points) - 1)

    def curve(self):
        """A cubic or parabola at rest would have no tangent there: as a line it has."""
        pieces = [[points[0], points[-1]] if self.straight(i) else points for i, points in enumerate(self.control_points)]
        return json.dumps({"method": "bezier", "input": {"segments": [{"control_points": points} for points in pieces]}})

    def elements(self):
        """None where more axes move than the control points of an element have."""
        if len(self.limits) > 3:
            return None
        found = []
        for i, points in enumerate(self.control_points):
            points = [[*point, 0.0][:3] for point in points]
            line = self.straight(i)
            element = {"type": "line" if line else "bezier", "from": points[0], "to": points[-1], "tolerance_mm": 0}
            found.append(element if line else {**element, "control_points": points})
        return json.dumps({"elements": found})

    def g5(self):
        """None but for x and y, and cubics: G-code has no other cubic splines."""
        if len(self.limits) != 2 or self.kind is not AxisMotion:
            return None
        text = f"G21 G17 G90 G94 G64 P{GCODE_TOLERANCE_MM} F{60 * self.feed()}\n"
        for i, (start, near, far, end) in enumerate(self.control_points):
            to = "X{:.7f} Y{:.7f}".format(*end)
            if self.straight(i):
                text += f"G1 {to}\n"
            else:
                legs = [near[0] - start[0], near[1] - start[1], far[0] - end[0], far[1] - end[1]]
                text += "G5 {} I{:.7f} J{:.7f} P{:.7f} Q{:.7f}\n".format(to, *legs)
        return text + "M2\n"

    def write(self, folder):
        """{form: its program}, where there is one."""
        programs = {}
        for form, text, suffix in zip(FORMS, (self.curve(), self.elements(), self.g5()), (".curve.json", ".json", ".ngc")):
            if text:
                programs[form] = folder / f"known{self.seed}{suffix}"
                programs[form].write_text(text, encoding="ascii")
        return programs

    def setting(self):
        return Setting(tuple(self.limits), self.feed())

    def cases(self, folder):
        return {form: Case(program, self.setting()) for form, program in self.write(folder).items()}
