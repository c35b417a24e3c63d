#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""An I/O module on pymodbus: eight coils and eight discrete inputs, functions 01, 02 and 05.

module_server.py --inputs FILE --record CHANGES.csv

Listens on a free port of the loopback, prints it, and runs until SIGTERM. The numbers in FILE, read each millisecond, are the inputs that
are on. The record gets a row whenever a coil changes: CLOCK_MONOTONIC, and the eight coils as 0 or 1."""
import argparse
import asyncio
import logging
import sys
import time

from pymodbus.bit_read_message import ReadCoilsRequest, ReadCoilsResponse, ReadDiscreteInputsRequest, ReadDiscreteInputsResponse
from pymodbus.bit_write_message import WriteSingleCoilRequest, WriteSingleCoilResponse
from pymodbus.pdu import ModbusExceptions

from pymodbus_server import Refused, answered, serve

BITS = 8


class Module:
    def __init__(self, inputs, record):
        self.file = inputs
        self.record = open(record, "w", encoding="ascii", buffering=1)
        self.coils = [True] + [False] * (BITS - 1)  # as somebody left them
        self.inputs = [False] * BITS

    def look(self):
        try:
            with open(self.file, encoding="ascii") as file:
                on = [int(number) for number in file.read().split()]
        except OSError:
            on = []
        self.inputs = [number in on for number in range(BITS)]

    def bits(self, table, address, count):
        if address + count > BITS:
            raise Refused(ModbusExceptions.IllegalAddress)
        return table[address:address + count]

    def write(self, address, on):
        self.bits(self.coils, address, 1)
        self.coils[address] = bool(on)
        self.record.write(",".join([f"{time.monotonic():.6f}", *(str(int(coil)) for coil in self.coils)]) + "\n")


class ReadCoils(ReadCoilsRequest):
    def execute(self, context):
        return answered(self, lambda: ReadCoilsResponse(context.bits(context.coils, self.address, self.count)))


class ReadInputs(ReadDiscreteInputsRequest):
    def execute(self, context):
        return answered(self, lambda: ReadDiscreteInputsResponse(context.bits(context.inputs, self.address, self.count)))


class WriteCoil(WriteSingleCoilRequest):
    def execute(self, context):
        def answer():
            context.write(self.address, self.value)
            return WriteSingleCoilResponse(self.address, self.value)
        return answered(self, answer)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--inputs", required=True)
    parser.add_argument("--record", required=True)
    options = parser.parse_args()
    logging.disable(logging.CRITICAL)
    module = Module(options.inputs, options.record)
    asyncio.run(serve(module, (ReadCoils, ReadInputs, WriteCoil), "an I/O module", module.look))
    return 0


if __name__ == "__main__":
    sys.exit(main())
