# SPDX-License-Identifier: MIT
"""The motion of a drive with the register map splinefeed-pvt, written from docs/reference/pvt_map.md alone: ring, rate, instants.

Time is the drive's own, in s. It is not stepped: between two events (a row of the record, the end of a segment, an instant that
was asked for, the watchdog) the rate sigma is one of four laws in closed form. So it does not matter when `advance` is called."""
import collections
import math

DISABLED, STANDING, RUNNING, STOPPING, HELD, FAULT, HOMING = range(7)
WATCHDOG_FAULT = 2
TICKS_PER_S = 8_000_000
BRAKING = 1e6  # of a quick stop, counts/s^2
HOMING_S = 0.05
NEVER = math.inf
TINY = 1e-9  # s: what is left of a segment beyond that is rounding

Segment = collections.namedtuple("Segment", "number ticks rest ends")  # ends: (position in 2^-16, velocity in 2^-24) an axis


class Motion:
    """From standing to standing; ring and laws of one drive."""

    def __init__(self, axes):
        self.now = 0.0
        self.state = DISABLED
        self.fault = 0
        self.stop_reserve = 0.1  # the next start's or resume's
        self.reserve = 0.1
        self.watchdog = 0.0
        self.last_valid = 0.0
        self.start_at = self.hold_at = self.resume_at = self.homed_at = NEVER
        self.ring = collections.deque()
        self.ring_ticks = 0
        self.marks = 0
        self.next = self.executed = 0
        self.progress = 0.0  # of the first segment in the ring, s of its own time
        self.sigma = 0.0
        self.base = [(0, 0.0)] * axes  # where the first segment begins: 2^-16 counts, counts/s
        self.brake = None  # of a quick stop: when, and place and velocity of each axis
        self.rows = []
        self.log = []

    # The ring

    def take(self, segments):
        for segment in segments:
            self.ring.append(segment)
            self.ring_ticks += segment.ticks
            self.marks += segment.rest
            self.next = (segment.number + 1) % 2**32

    def drop_from(self, number):
        while self.ring and (self.ring[-1].number - number) % 2**32 < 2**31:
            segment = self.ring.pop()
            self.ring_ticks -= segment.ticks
            self.marks -= segment.rest
            self.next = segment.number

    def lose_ring(self):
        """The ring is lost: the next segment begins where the axes stand."""
        self.base = [(round(q * 65536), 0.0) for q in self.places()]
        self.ring.clear()
        self.ring_ticks = self.marks = 0
        self.progress = self.sigma = 0.0
        self.next = self.executed
        self.start_at = self.hold_at = self.resume_at = NEVER

    def left(self):
        """R: what the segments in the ring take at full rate, s."""
        return max(0.0, self.ring_ticks / TICKS_PER_S - self.progress)

    def bound(self):
        """The rate that the end of the ring allows."""
        return 1.0 if self.marks else min(1.0, math.sqrt(self.left() / self.reserve))

    # Instants

    def start(self, at):
        self.start_at = max(at, self.now)

    def hold(self, at):
        if self.state == HELD:
            self.resume_at = NEVER
        elif self.state == RUNNING:
            self.hold_at = max(at, self.now)

    def resume(self, at):
        self.resume_at = max(at, self.now)

    def home(self):
        self.state = HOMING
        self.homed_at = self.now + HOMING_S

    def quick_stop(self):
        if self.brake:
            return
        where = [(*pair,) for pair in zip(self.places(), self.speeds())]
        moving = any(speed for _, speed in where)
        self.lose_ring()
        if moving:
            self.brake = (self.now, where)
            self.state = STOPPING
        elif self.state not in (DISABLED, FAULT):
            self.state = STANDING
        self.homed_at = NEVER

    # Where the axes are

    def cubic(self):
        """u and, for every axis, p0, v0, p1 - p0, v1 of the segment that is executed; counts, and counts per its duration."""
        segment = self.ring[0]
        duration = segment.ticks / TICKS_PER_S
        return self.progress / duration, duration, [
            (p0 / 65536, v0 * duration, (p1 - p0) / 65536, v1 / 2**24) for (p0, v0), (p1, v1) in zip(self.base, segment.ends)]

    def places(self):
        if self.brake:
            begun, where = self.brake
            return [q + v * t - math.copysign(BRAKING, v) * t * t / 2
                    for q, v in where for t in [min(self.now - begun, abs(v) / BRAKING)]]
        if not self.ring or self.progress == 0.0:
            return [p / 65536 for p, _ in self.base]
        u, _, axes = self.cubic()
        return [p0 + (((v0 + v1 - 2 * way) * u + 3 * way - 2 * v0 - v1) * u + v0) * u for p0, v0, way, v1 in axes]

    def speeds(self):
        """Counts/s."""
        if self.sigma == 0.0 or not self.ring:
            return [0.0] * len(self.base)
        u, duration, axes = self.cubic()
        return [self.sigma / duration * ((3 * (v0 + v1 - 2 * way) * u + 2 * (3 * way - 2 * v0 - v1)) * u + v0)
                for _, v0, way, v1 in axes]

    # Time

    def advance(self, until):
        """Everything up to this instant."""
        while True:
            watched = self.last_valid + self.watchdog if self.watchdog and self.state in (RUNNING, HOMING) else NEVER
            row = len(self.rows) / 1000
            braked = max(abs(v) for _, v in self.brake[1]) / BRAKING + self.brake[0] if self.brake else NEVER
            at = min(until, row, watched, self.start_at, self.hold_at, self.resume_at, self.homed_at, braked)
            self.run(at - self.now)
            self.now = max(self.now, at)
            if at == row:
                self.rows.append(self.places())
            elif at >= until:
                return
            elif at == braked:
                self.base = [(round(q * 65536), 0.0) for q in self.places()]
                self.brake = None
                self.state = STANDING if self.state == STOPPING else self.state
            elif at == self.homed_at:
                self.homed_at = NEVER
                self.base = [(0, 0.0)] * len(self.base)
                self.state = STANDING
            elif at == watched:
                self.expire()
            else:
                self.instant(at)

    def expire(self):
        self.fault = WATCHDOG_FAULT
        if self.state == HOMING:
            self.lose_ring()
            self.homed_at = NEVER
            self.state = FAULT
        else:
            self.hold_at = NEVER
            self.state = STOPPING

    def instant(self, at):
        """A start, hold or resume that was asked for."""
        if at == self.hold_at:
            self.hold_at = NEVER
            if self.state == RUNNING:
                self.state = STOPPING
            return
        self.reserve = self.stop_reserve
        self.fault = 0
        self.sigma = self.bound() if at == self.start_at else 0.0
        self.start_at = self.resume_at = NEVER
        self.state = RUNNING
        if not self.ring:
            self.stand(HELD)

    def stand(self, state):
        self.sigma = 0.0
        self.state = state
        self.hold_at = NEVER

    def run(self, span):
        """The ring, for so long at most; state may become STANDING or HELD on the way."""
        while span > 0 and self.state in (RUNNING, STOPPING) and self.ring:
            law, lasts = self.law()
            rest = max(0.0, self.ring[0].ticks / TICKS_PER_S - self.progress)
            ends = self.time_for(law, rest)
            step = min(span, lasts, ends)
            self.now += step
            span -= step
            if step == ends:
                self.follow(law, step)
                self.end_segment()
                continue
            self.progress += self.follow(law, step)
            if step == lasts and law == "fall":
                if self.ring[0].ticks / TICKS_PER_S - self.progress < TINY:
                    self.end_segment()
                if self.state == STOPPING:
                    self.stand(HELD)

    def law(self):
        """How sigma goes on from here, and for how long."""
        reserve, left, sigma = self.reserve, self.left(), self.sigma
        at_bound = not self.marks and sigma >= math.sqrt(left / reserve) - 1e-12
        if at_bound and left < reserve + 1e-12:
            return "bound", NEVER
        if self.state == STOPPING:
            return "fall", 2 * reserve * sigma
        if sigma >= 1.0:
            return "full", NEVER if self.marks else left - reserve
        lasts = 2 * reserve * (1 - sigma)
        if not self.marks:
            lasts = min(lasts, reserve * (math.sqrt(2 * sigma**2 + 2 * left / reserve) - 2 * sigma))
        return "rise", max(lasts, 1e-12)

    def time_for(self, law, way):
        """When so much of the segments' time has gone by."""
        reserve, sigma = self.reserve, self.sigma
        if law == "full":
            return way
        if law == "bound":
            left = self.left()
            return 2 * math.sqrt(reserve) * (math.sqrt(left) - math.sqrt(max(0.0, left - way)))
        if law == "rise":
            return 2 * reserve * (math.sqrt(sigma**2 + way / reserve) - sigma)
        inside = sigma**2 - way / reserve
        return 2 * reserve * (sigma - math.sqrt(inside)) if inside >= 0 else NEVER

    def follow(self, law, span):
        """Sets sigma to where it is then; the segments' time that goes by."""
        reserve, sigma = self.reserve, self.sigma
        if law == "full":
            return span
        if law == "bound":
            left = self.left()
            then = max(0.0, math.sqrt(left) - span / (2 * math.sqrt(reserve)))
            self.sigma = then / math.sqrt(reserve)
            return left - then * then
        slope = (1 if law == "rise" else -1) / (2 * reserve)
        self.sigma = min(1.0, max(0.0, sigma + slope * span))
        return (sigma + self.sigma) / 2 * span

    def end_segment(self):
        segment = self.ring.popleft()
        self.ring_ticks -= segment.ticks
        self.marks -= segment.rest
        self.progress = 0.0
        self.base = [(p, v / 2**24 * TICKS_PER_S / segment.ticks) for p, v in segment.ends]
        self.executed = (segment.number + 1) % 2**32
        self.log.append((segment, self.now))
        if segment.rest and not self.ring:
            self.stand(STANDING)
        elif segment.rest:
            self.sigma = min(self.sigma, self.bound())
        elif not self.ring:
            self.stand(HELD)
