#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A client of the register map splinefeed-pvt, written from docs/reference/pvt_map.md alone: pvt_client.py PORT.

Enables, begins, sends a few segments, starts, and prints where the axes end; exits with 0 if that is where the segments end.
"""
import random
import struct
import sys
import time
import zlib

from pymodbus.client import ModbusTcpClient

IDENTITY, CONFIGURATION, STATUS, BLOCK = 0x0000, 0x0010, 0x0020, 0x0100
ENABLE, BEGIN, START = 1, 3, 4
STANDING = 1
REST = 0x80000000


def words(data):
    return list(struct.unpack(">%dH" % (len(data) // 2), data))


class Drive:
    def __init__(self, port):
        self.client = ModbusTcpClient("127.0.0.1", port=port)
        assert self.client.connect()
        identity = self.read(IDENTITY, 11)
        magic, version, self.axes, self.ring, self.ticks, self.boot, check16, check32 = struct.unpack(">4HIIHI", identity)
        assert (magic, version, check16, check32) == (0x5346, 1, 0x1234, 0x12345678), identity
        assert self.ticks == 8000000
        self.session = random.randrange(1, 65536)
        self.nonce = 0
        self.counter = self.status()["last_command"]

    def read(self, address, count):
        reply = self.client.read_holding_registers(address, count)
        assert not reply.isError(), reply
        return struct.pack(">%dH" % count, *reply.registers)

    def decode(self, data):
        assert struct.unpack(">I", data[-4:])[0] == zlib.crc32(data[:-4]), "checksum of the status"
        names = ("nonce state fault fault_axis next executed free refused refusals last_command clock boot").split()
        status = dict(zip(names, struct.unpack(">4HII4HII", data[:32])))
        assert status["boot"] == self.boot
        axes = struct.unpack(">%di" % (2 * self.axes), data[32:-4])
        status["position"], status["following_error"] = axes[0::2], axes[1::2]
        return status

    def status(self):
        return self.decode(self.read(STATUS, 18 + 4 * self.axes))

    def exchange(self, command=0, argument=0, first=0, segments=(), with_23=False):
        self.nonce = (self.nonce + 1) % 65536
        if command:
            self.counter = (self.counter + 1) % 65536
        head = struct.pack(">4HIHI", self.nonce, self.session, command, self.counter, argument, len(segments), first)
        body = b""
        for duration, ends in segments:
            body += struct.pack(">I", duration)
            for position, velocity in ends:
                body += position.to_bytes(6, "big", signed=True) + velocity.to_bytes(6, "big", signed=True)
        block = words(head + struct.pack(">I", zlib.crc32(head + body)) + body)
        if with_23:
            reply = self.client.readwrite_registers(
                read_address=STATUS, read_count=18 + 4 * self.axes, write_address=BLOCK, write_registers=block)
            assert not reply.isError(), reply
            status = self.decode(struct.pack(">%dH" % len(reply.registers), *reply.registers))
        else:
            reply = self.client.write_registers(BLOCK, block)
            assert not reply.isError(), reply
            status = self.status()
        assert status["nonce"] == self.nonce
        assert status["refused"] == 0, status
        return status


def main():
    drive = Drive(int(sys.argv[1]))
    reply = drive.client.write_registers(CONFIGURATION, [1000, 50, 0, 0])
    assert not reply.isError(), reply
    drive.exchange(ENABLE)
    status = drive.exchange(BEGIN, 7)
    start = status["position"]
    # Each axis goes there and stands: (3 u^2 - 2 u^3) in two halves of 20 ms, 1.5 times its mean speed in the middle.
    way = [100 * (k + 1) * (-1) ** k for k in range(drive.axes)]
    middle = [((s << 16) + (w << 15), w * 3 << 22) for s, w in zip(start, way)]
    end = [((s + w) << 16, 0) for s, w in zip(start, way)]
    status = drive.exchange(0, 0, 7, [(160000, middle)], with_23=True)
    assert status["next"] == 8, status
    status = drive.exchange(0, 0, 7, [(160000, middle), (160000 | REST, end)])  # the first for the second time
    assert (status["next"], status["executed"]) == (9, 7), status
    drive.exchange(START, (status["clock"] + 50000) % 2**32, with_23=True)
    for _ in range(500):
        status = drive.exchange(with_23=True)
        assert status["fault"] == 0, status
        if status["executed"] == 9:
            break
        time.sleep(0.005)
    assert (status["executed"], status["state"]) == (9, STANDING), status
    print("executed", status["executed"], "end", *status["position"])
    return 0 if list(status["position"]) == [s + w for s, w in zip(start, way)] else 1


if __name__ == "__main__":
    sys.exit(main())
