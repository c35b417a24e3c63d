#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The spindle and an input of `splinefeed serve` on three simulated Modbus drives: target_outputs.py TOOL [CASE...].

The inverter and the module are pymodbus's. Exit status 77: skipped, with the reason (no pymodbus)."""
import contextlib
import pathlib
import signal
import sys
import time

from sender import ServedDrives, run_cases
from target_runs import await_line, require, say, underway, unlocked
from case_runs import pymodbus_missing
from input_runs import Module
from spindle_runs import Vfd


@contextlib.contextmanager
def with_spindle(drives):
    """The inverter of the machine's spindle."""
    vfd = Vfd(drives.folder, 2000.0)
    try:
        text = pathlib.Path(drives.machine).read_text().replace("[spindle]\n", f'[spindle]\nvfd = "{vfd.address}?profile=vfd-delta-ms300"\n')
        pathlib.Path(drives.machine).write_text(text)
        yield vfd
    finally:
        vfd.process.kill()
        vfd.process.wait()


def silent_spindle(drives):
    """An inverter that is silent in the cut: an alarm, and the server's end says that the spindle may still turn, whatever came between."""
    with with_spindle(drives) as vfd:
        for resets in (False, True):
            sender = unlocked(drives)
            require(say(sender, b"M3 S6000") == "ok", "M3")
            sender.send(b"G91 G1 X50 F600\n")
            underway(sender, 1.0)
            vfd.process.send_signal(signal.SIGSTOP)
            await_line(sender, "ALARM:14")
            sender.until("Alarm")
            if resets:
                sender.send(b"\x18")
                time.sleep(2.5)
            sender.close()
            status, told = drives.server.end()
            require(status == 1 and "the spindle did not confirm that it stands and may still turn" in told, f"exit status {status}: {told}")
            vfd.process.send_signal(signal.SIGCONT)
            time.sleep(1.0)


def spindle(drives):
    """M3 is answered when the spindle has its speed; a reset and the server's end stop it; M0 and M6 wait for the operator."""
    with with_spindle(drives) as vfd:
        sender = unlocked(drives)
        begun = time.monotonic()
        require(say(sender, b"M3 S9000") == "ok" and 0.05 < time.monotonic() - begun < 5.0, "M3")
        require(abs(vfd.rows()[-1][1] - 150.0) < 3.0, f"it turns at {vfd.rows()[-1]}")
        sender.send(b"G1 X50 F3000\n")
        underway(sender, 5.0)
        sender.send(b"\x18")
        await_line(sender, "Grbl 1.1")
        time.sleep(0.5)
        require(vfd.rows()[-1][1] < 1.0, "it turns behind a reset")
        require(say(sender, b"M3 S6000") == "ok" and say(sender, b"M0") == "ok", "M3, M0")
        require(sender.report().startswith("<Hold:0"), "M0 does not hold")
        sender.send(b"~G0 X0\nM6 T1\n")
        sender.until("Tool")
        sender.send(b"~")
        sender.until("Idle")
        sender.send(b"M3 S6000\n")
        time.sleep(0.5)
        sender.close()
        drives.end()
        time.sleep(0.3)
        require(vfd.rows()[-1][1] < 1.0, "it turns behind the end")


def inputs(drives):
    """M66 waits for an input of a module, and answers when it has come or its time is over; a reset ends the wait."""
    module = Module(drives.folder)
    try:
        text = pathlib.Path(drives.machine).read_text()
        pathlib.Path(drives.machine).write_text(
            text + f'[[module]]\nname = "io"\naddress = "{module.address}"\n[[input]]\nnumber = 2\nmodule = "io"\ninput = 2\n')
        sender = unlocked(drives)
        sender.send(b"G1 X2 F3000\nM66 P2 L3 Q20\nG1 X4\n")
        require(sender.line() == "ok", "no answer")
        time.sleep(1.0)
        require(sender.report().startswith("<Run") and sender.place()[0] == 2.0, "it does not wait")
        for switched in (b"\xa0", b"!", b"~", b"\x84", b"~"):  # coolant, hold, door: no answers
            sender.send(switched)
            time.sleep(0.3)
            require(sender.place()[0] == 2.0 and not sender.text, f"{switched} ends the wait: {sender.text}")
        module.turn(2)
        require(sender.line() == "ok" and sender.line() == "ok" and sender.until("Idle") and sender.place()[0] == 4.0, "it does not go on")
        begun = time.monotonic()
        require(say(sender, b"M66 P2 L4 Q0.5") == "ok" and 0.4 < time.monotonic() - begun < 3.0, "the time-out")
        sender.until("Hold:0")
        sender.send(b"~")
        sender.send(b"M66 P2 L4 Q20\nG1 X9\n")
        time.sleep(0.3)
        sender.send(b"\x18")
        await_line(sender, "Grbl 1.1")
        require(say(sender, b"M3 S100") == "ok" and sender.place()[0] == 4.0, "a reset does not end the wait")
        sender.send(b"M66 P1 L3 Q20\n")
        require("M66: there is no input" in sender.line() and sender.line() == "ok", "an input that the machine does not have")
        sender.until("Hold:0")
        sender.send(b"\x18")
        sender.close()
        drives.end()
    finally:
        module.process.kill()
        module.process.wait()


def on_drives(case):
    def run(tool, folder):
        with ServedDrives(tool, folder) as drives:
            case(drives)

    return run


def main():
    if why := pymodbus_missing():
        print(f"SKIPPED: {why}")
        return 77
    return run_cases({case.__name__: on_drives(case) for case in (spindle, silent_spindle, inputs)}, sys.argv[1], sys.argv[2:])


if __name__ == "__main__":
    sys.exit(main())
