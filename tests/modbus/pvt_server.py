#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A drive with the register map splinefeed-pvt on pymodbus, written from docs/reference/pvt_map.md alone.

pvt_server.py [--axes N] [--ring N] [--clock-us START] [--record TRACE.csv] [--record-segments SEGMENTS.csv] [--spoil WHAT]

Listens on a free port of the loopback, prints it, runs until SIGTERM, and then writes its records: those of `splinefeed drive`.
--spoil: a mistake that a test has to find. Its shafts follow exactly."""
import argparse
import asyncio
import logging
import random
import struct
import sys
import time
import zlib

from pymodbus.pdu import ModbusExceptions
from pymodbus.register_read_message import ReadWriteMultipleRegistersRequest, ReadWriteMultipleRegistersResponse

from pvt_motion import DISABLED, FAULT, HELD, HOMING, NEVER, RUNNING, STANDING, STOPPING, TICKS_PER_S, Motion, Segment
from pymodbus_server import Read, Refused, Write, answered, serve

IDENTITY, CONFIGURATION, STATUS, BLOCK = 0x0000, 0x0010, 0x0020, 0x0100
CHECKSUM, SESSION, GAP, NO_ROOM, MALFORMED, NOT_NOW = range(1, 7)
ENABLE, DISABLE, BEGIN, START, HOLD, RESUME, QUICK_STOP, END, FAULT_RESET, HOME, PRESET_POSITION = range(1, 12)
WITHOUT_SESSION = (ENABLE, DISABLE, BEGIN, QUICK_STOP, FAULT_RESET)
ALLOWED = {
    ENABLE: (DISABLED, STANDING), DISABLE: (DISABLED, STANDING, HELD), BEGIN: (STANDING, HELD), START: (STANDING,),
    HOLD: (RUNNING, STOPPING, HELD), RESUME: (HELD,), QUICK_STOP: range(7), END: (RUNNING, STOPPING, HELD),
    FAULT_RESET: (DISABLED, FAULT), HOME: (STANDING,), PRESET_POSITION: (STANDING,)}
REST_MARK = 0x80000000
FEW_SEGMENTS = 250  # with --spoil few it takes no more while it runs
LATE_SEGMENTS = 80  # with --spoil late it stops so far behind where it is told to; 1 ms each


def words(data):
    return list(struct.unpack(f">{len(data) // 2}H", data))


def signed(value, bits):
    return value - (1 << bits) if value >> (bits - 1) else value


class PvtDrive:
    """The registers of one drive."""

    def __init__(self, axes, ring, clock_us, spoil):
        self.axes, self.capacity, self.clock_us, self.spoil = axes, ring, clock_us, spoil
        self.began = time.monotonic()
        self.boot = random.randrange(1, 2**32)
        self.motion = Motion(axes)
        self.configuration = [0, 100, 0, 0]
        self.session = None
        self.nonce = self.refused = self.refusals = self.last_command = 0

    def read(self, address, count):
        self.motion.advance(time.monotonic() - self.began)
        for begin, table in ((IDENTITY, self.identity), (CONFIGURATION, lambda: self.configuration), (STATUS, self.status)):
            content = table()
            if begin <= address and address + count <= begin + len(content):
                return content[address - begin:address - begin + count]
        raise Refused(ModbusExceptions.IllegalAddress)

    def write(self, address, values):
        self.motion.advance(time.monotonic() - self.began)
        if address == BLOCK:
            if len(values) < 11 or len(values) != 11 + values[6] * (2 + 6 * self.axes):
                raise Refused(ModbusExceptions.IllegalValue)
            self.block(struct.pack(f">{len(values)}H", *values))
        elif CONFIGURATION <= address and address + len(values) <= CONFIGURATION + 4:
            self.configure(address - CONFIGURATION, values)
        else:
            raise Refused(ModbusExceptions.IllegalAddress)

    def identity(self):
        return words(struct.pack(">4HIIHI", 0x5346, 1, self.axes, self.capacity, TICKS_PER_S, self.boot, 0x1234, 0x12345678))

    def configure(self, first, values):
        then = list(self.configuration)
        then[first:first + len(values)] = values
        if not 1 <= then[1] <= 10000:
            raise Refused(ModbusExceptions.IllegalValue)
        self.configuration = then
        self.motion.watchdog = then[0] / 1000
        self.motion.stop_reserve = then[1] / 1000

    def clock(self):
        return (int(self.motion.now * 1e6) + self.clock_us) % 2**32

    def free(self):
        most = FEW_SEGMENTS if self.spoil == "few" and self.motion.state == RUNNING else self.capacity
        return max(0, most - len(self.motion.ring))

    def status(self):
        motion = self.motion
        data = struct.pack(
            ">4H2I4H2I", self.nonce, motion.state, motion.fault, 0, motion.next, motion.executed,
            self.free(), self.refused, self.refusals, self.last_command, self.clock(), self.boot)
        for place in motion.places():
            data += struct.pack(">2i", round(place), 0)
        return words(data + struct.pack(">I", zlib.crc32(data) ^ (self.spoil == "crc")))

    # A block

    def block(self, data):
        self.nonce, session, command, counter, argument, count, first, checksum = struct.unpack(">4HIHII", data[:22])
        try:
            self.refused = 0
            self.take(data, session, command, counter, argument, count, first, checksum)
        except Refused as why:
            self.refused = why.args[0]
            self.refusals = (self.refusals + 1) % 2**16

    def take(self, data, session, command, counter, argument, count, first, checksum):
        if zlib.crc32(data[:18] + data[22:]) != checksum:
            raise Refused(CHECKSUM)
        mine = session == self.session
        if mine:
            self.motion.last_valid = self.motion.now
        elif not (command == BEGIN or (count == 0 and command in WITHOUT_SESSION)):
            raise Refused(SESSION)
        segments = self.segments(data[22:], first, count)
        ahead = (counter - self.last_command) % 2**16
        if command and (1 <= ahead <= 32767 if mine else ahead != 0):
            self.command(command, session, argument, segments)
            self.last_command = counter
            if command == PRESET_POSITION:
                return
        if segments and session != self.session:  # a begin that came late
            raise Refused(SESSION)
        if segments:
            self.append(segments)

    def segments(self, data, first, count):
        size = 4 + 12 * self.axes
        result = []
        for i in range(count):
            fields = [int.from_bytes(data[at:at + 6], "big", signed=True)
                      for at in range(i * size + 4, (i + 1) * size, 6)]
            duration = struct.unpack_from(">I", data, i * size)[0]
            if self.spoil == "count":
                fields[0] += 65536
            result.append(Segment((first + i) % 2**32, duration & ~REST_MARK, duration >= REST_MARK,
                                  list(zip(fields[0::2], fields[1::2]))))
        return result

    def append(self, segments):
        motion = self.motion
        if signed((segments[0].number - motion.next) % 2**32, 32) > 0:
            raise Refused(GAP)
        new = [segment for segment in segments if signed((segment.number - motion.next) % 2**32, 32) >= 0]
        if len(new) > self.capacity - len(motion.ring):
            raise Refused(NO_ROOM)
        for segment in new:
            if not 800 <= segment.ticks <= 80_000_000 or (segment.rest and any(v for _, v in segment.ends)):
                raise Refused(MALFORMED)
        if new and motion.state in (DISABLED, FAULT, HOMING):
            raise Refused(NOT_NOW)
        motion.take(new)

    # Commands

    def instant(self, argument):
        """A time of the clock as one of the motion."""
        return self.motion.now + signed((argument - self.clock()) % 2**32, 32) / 1e6

    def command(self, command, session, argument, segments):
        motion = self.motion
        idle = not motion.ring and motion.start_at == NEVER
        if motion.state not in ALLOWED.get(command, ()) or (command in (HOME, PRESET_POSITION) and not idle):
            raise Refused(NOT_NOW)
        if command == ENABLE:
            motion.state = STANDING
        elif command in (DISABLE, QUICK_STOP):
            self.session = None
            if command == QUICK_STOP:
                motion.quick_stop()
            else:
                motion.lose_ring()
                motion.state = DISABLED
        elif command == BEGIN:
            motion.lose_ring()
            self.session, motion.state, motion.fault = session, STANDING, 0
            motion.next = motion.executed = argument
            motion.last_valid = motion.now
        elif command == START:
            motion.start(self.instant(argument))
        elif command == HOLD:
            motion.hold(self.instant(argument) + (LATE_SEGMENTS / 1000 if self.spoil == "late" else 0))
        elif command == RESUME:
            motion.resume(self.instant(argument))
        elif command == END:
            self.end(argument + (LATE_SEGMENTS if self.spoil == "late" else 0))
        elif command == FAULT_RESET:
            motion.state, motion.fault = DISABLED, 0
        elif command == HOME:
            motion.home()
        else:
            if len(segments) != 1:
                raise Refused(MALFORMED)
            motion.base = [(position, 0.0) for position, _ in segments[0].ends]

    def end(self, number):
        motion = self.motion
        kept = [s for i, s in enumerate(motion.ring)
                if signed((s.number - number) % 2**32, 32) < 0 or (i == 0 and motion.progress > 0)]
        left = sum(s.ticks for s in kept) / TICKS_PER_S - motion.progress
        if left < motion.sigma**2 * motion.reserve and not any(s.rest for s in kept):
            raise Refused(NOT_NOW)
        if len(kept) < len(motion.ring):
            motion.drop_from(motion.ring[len(kept)].number)

    # Records

    def write_records(self, trace, segments):
        axes = range(self.axes)
        if trace:
            with open(trace, "w", encoding="ascii") as file:
                file.write(f"# t = 0 is CLOCK_MONOTONIC {self.began:.9f} s\n")
                file.write("t," + ",".join(f"a{k}" for k in axes) + "\n")
                for i, row in enumerate(self.motion.rows):
                    if self.spoil == "shaft" and row[0] > 1000:
                        row[0] += 1
                    file.write(f"{i / 1000:.3f}," + ",".join(f"{place:.10f}" for place in row) + "\n")
        if segments:
            with open(segments, "w", encoding="ascii") as file:
                file.write("sequence,duration_ticks," + ",".join(f"a{k}_end,a{k}_v_end" for k in axes) + ",t_end\n")
                for segment, t in self.motion.log + (self.motion.log[-1:] if self.spoil == "twice" else []):
                    ends = ",".join(f"{p},{v}" for p, v in segment.ends)
                    file.write(f"{segment.number},{segment.ticks},{ends},{t:.9f}\n")


class Exchange(ReadWriteMultipleRegistersRequest):
    def execute(self, context):
        def answer():
            if self.write_byte_count != 2 * self.write_count:
                raise Refused(ModbusExceptions.IllegalValue)
            context.read(self.read_address, self.read_count)  # may be refused, and then nothing is changed
            context.write(self.write_address, self.write_registers)
            return ReadWriteMultipleRegistersResponse(context.read(self.read_address, self.read_count))
        return answered(self, answer)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--axes", type=int, default=1)
    parser.add_argument("--ring", type=int, default=512)
    parser.add_argument("--clock-us", type=int, default=None, help="of its clock at power-up; without it: any")
    parser.add_argument("--record", default="")
    parser.add_argument("--record-segments", default="")
    parser.add_argument("--spoil", choices=["", "crc", "count", "few", "late", "shaft", "twice"], default="")
    options = parser.parse_args()
    logging.disable(logging.CRITICAL)
    clock_us = random.randrange(2**32) if options.clock_us is None else options.clock_us
    drive = PvtDrive(options.axes, options.ring, clock_us, options.spoil)
    asyncio.run(serve(drive, (Read, Write, Exchange), f"{drive.axes} axes"))
    drive.motion.advance(time.monotonic() - drive.began)
    drive.write_records(options.record, options.record_segments)
    return 0


if __name__ == "__main__":
    sys.exit(main())
