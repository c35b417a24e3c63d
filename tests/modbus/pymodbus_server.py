# SPDX-License-Identifier: MIT
"""Registers of a device of ours behind pymodbus: its functions, refusals and the life of the server.

A device has read(address, count) and write(address, values), which raise Refused with a Modbus exception code."""
import asyncio
import signal

from pymodbus.datastore import ModbusServerContext
from pymodbus.pdu import ModbusExceptions
from pymodbus.register_read_message import ReadHoldingRegistersRequest, ReadHoldingRegistersResponse
from pymodbus.register_write_message import WriteMultipleRegistersRequest, WriteMultipleRegistersResponse
from pymodbus.server.async_io import ModbusTcpServer


class Refused(Exception):
    pass


def answered(request, answer):
    """What answer() returns, or the exception that it was refused with."""
    try:
        return answer()
    except Refused as why:
        return request.doException(why.args[0])


class Read(ReadHoldingRegistersRequest):
    def execute(self, context):
        return answered(self, lambda: ReadHoldingRegistersResponse(context.read(self.address, self.count)))


class Write(WriteMultipleRegistersRequest):
    def execute(self, context):
        def answer():
            if self.byte_count != 2 * self.count:
                raise Refused(ModbusExceptions.IllegalValue)
            context.write(self.address, self.values)
            return WriteMultipleRegistersResponse(self.address, self.count)
        return answered(self, answer)


async def serve(device, functions, name, each_ms=None):
    """Listens on a free port of the loopback, prints it with the name, and runs until SIGTERM; calls each_ms() about every millisecond."""
    server = ModbusTcpServer(ModbusServerContext(slaves=device, single=True), address=("127.0.0.1", 0))
    # No other function: exception 1. (`register` only adds to pymodbus's own.)
    server.decoder._ServerDecoder__lookup = {request.function_code: request for request in functions}
    task = asyncio.create_task(server.serve_forever())
    await server.serving
    port = server.server.sockets[0].getsockname()[1]
    print(f"listening on tcp://127.0.0.1:{port}, {name}, pymodbus", flush=True)
    stopped = asyncio.Event()
    asyncio.get_running_loop().add_signal_handler(signal.SIGTERM, stopped.set)
    while each_ms and not stopped.is_set():
        each_ms()
        await asyncio.sleep(0.001)
    await stopped.wait()
    task.cancel()
