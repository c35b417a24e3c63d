#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A frequency inverter on pymodbus with the registers of Delta's MS300 (2000H command, 2001H frequency, 2101H state, 2103H output
frequency), written from the maker's tables, not from the profile.

vfd_server.py [--ramp HZ_S] [--record TRACE.csv]

Listens on a free port of the loopback, prints it, and runs until SIGTERM. The record grows while it runs, a row each millisecond or so:
CLOCK_MONOTONIC, output frequency with the sign of the direction, and 1, -1 or 0 as it was told last."""
import argparse
import asyncio
import logging
import sys
import time

from pymodbus.pdu import ModbusExceptions
from pymodbus.register_write_message import WriteSingleRegisterRequest, WriteSingleRegisterResponse

from pymodbus_server import Read, Refused, Write, answered, serve

COMMAND, FREQUENCY, STATE, OUTPUT = 0x2000, 0x2001, 0x2101, 0x2103
STOP, RUN = 1, 2
FORWARD, REVERSE = 1, 2


class Vfd:
    def __init__(self, ramp_hz_s, record):
        self.ramp_hz_s = ramp_hz_s
        self.record = open(record, "w", encoding="ascii", buffering=1)
        self.direction = 0
        self.frequency_hz = self.output_hz = 0.0
        self.now = time.monotonic()

    def advance(self):
        now = time.monotonic()
        most = self.ramp_hz_s * (now - self.now)
        wanted = self.direction * self.frequency_hz
        self.output_hz += max(-most, min(most, wanted - self.output_hz))
        self.now = now
        self.record.write(f"{now:.6f},{self.output_hz:.3f},{self.direction}\n")

    def read(self, address, count):
        self.advance()
        running = 3 if self.direction else 1 if self.output_hz else 0
        table = {STATE: running, OUTPUT: round(100 * abs(self.output_hz))}
        if any(register not in table for register in range(address, address + count)):
            raise Refused(ModbusExceptions.IllegalAddress)
        return [table[register] for register in range(address, address + count)]

    def write(self, address, values):
        self.advance()
        for register, value in enumerate(values, address):
            if register == COMMAND:
                self.command(value)
            elif register == FREQUENCY:
                self.frequency_hz = value / 100
            else:
                raise Refused(ModbusExceptions.IllegalAddress)
        self.advance()

    def command(self, word):
        if word & 3 == STOP:
            self.direction = 0
        elif word & 3 == RUN:
            self.direction = {FORWARD: 1, REVERSE: -1}.get(word >> 4 & 3, self.direction)


class WriteOne(WriteSingleRegisterRequest):
    def execute(self, context):
        def answer():
            context.write(self.address, [self.value])
            return WriteSingleRegisterResponse(self.address, self.value)
        return answered(self, answer)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--ramp", type=float, default=400.0)
    parser.add_argument("--record", required=True)
    options = parser.parse_args()
    logging.disable(logging.CRITICAL)
    vfd = Vfd(options.ramp, options.record)
    asyncio.run(serve(vfd, (Read, WriteOne, Write), "a VFD", vfd.advance))
    return 0


if __name__ == "__main__":
    sys.exit(main())
