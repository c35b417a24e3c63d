#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The cases of tests/controller/conformance.txt, by TCP and by a pseudo terminal: conformance.py TOOL [--modbus].

--modbus: by TCP, on three simulated Modbus drives, without the cases that need a probe or outputs.

Each case begins with a reset machine: a new server for each would take longer. What only a machine in virtual time can do is left out, with the
cases that need it; a wait that is too long on a busy host changes no answer of the others.
"""
import codecs
import contextlib
import fnmatch
import pathlib
import re
import sys
import tempfile
import time

from sender import Failed, Sender, ServedDrives, Server

HERE = pathlib.Path(__file__).resolve().parent
VIRTUAL = {"machine", "told", "way", "connect", "disconnect", "times"}
def cases(without, of=None):
    """(name, lines) of the cases that need neither a machine in virtual time nor anything of `without`; of those that need something of `of`."""
    name, needs, lines = None, set(), []

    def runs():
        return name and not needs & without and (of is None or needs & of) and not any(command in VIRTUAL for _, command, _ in lines)

    for number, line in enumerate((HERE.parent / "controller/conformance.txt").read_text().splitlines(), 1):
        if not line or line.startswith("#"):
            continue
        command, _, rest = line.partition(" ")
        if command == "case":
            if runs():
                yield name, lines
            name, needs, lines = rest, set(), []
        elif command == "needs":
            needs = set(rest.split())
        else:
            lines.append((number, command, rest))
    if runs():
        yield name, lines


def take(sender, command, rest):
    if command == ">":
        sender.send(codecs.escape_decode(rest.encode())[0])
    elif command == "<":
        line = sender.line()
        pattern = re.sub(r"[\[\]?]", lambda found: f"[{found.group()}]", rest)
        if not fnmatch.fnmatchcase(line, pattern):
            raise Failed(f"it said: {line}")
    elif command == "wait":
        sender.wait_ms(int(rest))
    elif command == "until":
        sender.until(rest)
    elif command == "at":
        place = sender.place()
        if any(abs(a - float(b)) > 0.0015 for a, b in zip(place, rest.split())):
            raise Failed(f"it stands at {place}")


class CaseSender(Sender):
    def wait_ms(self, ms):
        until = time.monotonic() + ms / 1000.0
        while time.monotonic() < until:
            self.read(until - time.monotonic())


def begin(sender):
    """As it is switched on: at 0, with the numbers of its file."""
    sender.send(b"\x18")
    sender.wait_ms(100)
    sender.text = b""
    lines = b"\n$X\n$10=3\n$13=0\n$RST=#\nG53G0Z0\nG53G0X0Y0\nG4P0.01\nM9\n"
    sender.send(lines)
    answers = 0
    while answers < lines.count(b"\n"):
        answers += re.match("ok|error:", sender.line()) is not None
    sender.until("Idle")
    sender.send(b"\x18")
    sender.wait_ms(60)
    sender.text = b""


@contextlib.contextmanager
def served(tool, folder, kind):
    """A server with its machine."""
    if kind != "modbus":
        yield Server(tool, folder, machine=str(HERE / "machine.toml"))
        return
    with ServedDrives(tool, folder) as drives:
        drives.serve()
        yield drives.server


def main():
    tool, modbus = sys.argv[1], "--modbus" in sys.argv[2:]
    without = {"clock", "probe", "outputs"} if modbus else {"clock"}
    run, failed = 0, 0
    for kind in ("modbus",) if modbus else ("tcp", "pty"):
        with tempfile.TemporaryDirectory() as folder, served(tool, folder, kind) as server:
            sender = CaseSender(server, "pty" if kind == "pty" else "tcp")
            for name, lines in cases(without):
                run += 1
                at = 0
                try:
                    begin(sender)
                    for at, command, rest in lines:
                        take(sender, command, rest)
                    sender.wait_ms(150)
                    if sender.text:
                        raise Failed(f"more is said: {sender.text!r}")
                except Failed as failure:
                    failed += 1
                    print(f"{kind}: {name}, line {at}: {failure}", flush=True)
            sender.close()
            status, told = server.end()
            if status != 0 or told:
                failed += 1
                print(f"{kind}: the server ends with {status}: {told}")
    print(f"{run} cases, {failed} failed")
    return 1 if failed or run < (45 if modbus else 80) else 0


if __name__ == "__main__":
    sys.exit(main())
