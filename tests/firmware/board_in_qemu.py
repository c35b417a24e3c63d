# SPDX-License-Identifier: MIT
"""A board of examples/firmware in QEMU: its UART, its buttons, and every level that its pins took."""
import json
import os
import re
import select
import socket
import subprocess
import time

XON, XOFF = b"\x11", b"\x13"
WAIT_S = 60  # for an answer, on a host that is busy


class BoardFailed(Exception):
    """What the board did is not what it was to do."""


def connected(path):
    """A socket that QEMU listens on."""
    line = socket.socket(socket.AF_UNIX)
    for _ in range(200):
        try:
            line.connect(path)
            return line
        except (FileNotFoundError, ConnectionRefusedError):
            time.sleep(0.05)
    raise BoardFailed("QEMU does not listen")


class Board:
    """The emulator runs as fast as the host can, by a clock of its own: an instruction takes 16 ns. So nothing here may depend on
    the host's time; the board is waited for."""

    def __init__(self, image, folder, machine, qemu_options=()):
        trace_path = os.path.join(folder, "pins.txt")
        serial, monitor = os.path.join(folder, "uart"), os.path.join(folder, "qmp")
        for path in (trace_path, serial, monitor):
            if os.path.exists(path):
                os.remove(path)
        self.qemu = subprocess.Popen(
            ["qemu-system-arm", "-M", machine, "-display", "none", "-icount", "shift=4,sleep=off",
             "-chardev", f"socket,id=uart,path={serial},server=on,wait=on", "-serial", "chardev:uart",
             "-qmp", f"unix:{monitor},server=on,wait=off", "-monitor", "none",
             "-D", trace_path, *qemu_options, "-kernel", image])
        self.uart = connected(serial)
        self.trace, self.trace_rest = open(trace_path, encoding="ascii", errors="replace"), ""
        self.received = b""
        self.lines = []
        self.paused = False
        self.pauses = 0
        self.monitor = connected(monitor).makefile("rw")
        json.loads(self.monitor.readline())
        self.ask_monitor("qmp_capabilities")

    def close(self):
        self.qemu.kill()
        self.qemu.wait()
        self.trace.close()

    def ask_monitor(self, command, **arguments):
        self.monitor.write(json.dumps({"execute": command, "arguments": arguments}) + "\n")
        self.monitor.flush()
        while True:
            answer = json.loads(self.monitor.readline())
            if "return" in answer:
                return answer["return"]
            if "error" in answer:
                raise BoardFailed(f"{command}: {answer['error']['desc']}")

    def key(self, name, down):
        """A button of the board, which QEMU takes from the keyboard."""
        self.ask_monitor("input-send-event", events=[
            {"type": "key", "data": {"down": down, "key": {"type": "qcode", "data": name}}}])

    def send(self, text):
        self.uart.sendall(text.encode())

    def take(self, seconds):
        """Takes what the board says within that time, at once if something is there."""
        if not select.select([self.uart], [], [], seconds)[0]:
            return False
        data = self.uart.recv(4096)
        if not data:
            raise BoardFailed("QEMU has ended")
        for control in re.findall(rb"[\x11\x13]", data):
            self.paused = control == XOFF
            self.pauses += self.paused
        self.received += data.replace(XON, b"").replace(XOFF, b"")
        *lines, self.received = self.received.split(b"\n")
        self.lines += [line.decode() for line in lines]
        return True

    def wait_for(self, pattern, what=None):
        """The next line that matches; those before it are dropped and given back, too."""
        before = []
        end = time.monotonic() + WAIT_S
        while time.monotonic() < end:
            while self.lines:
                line = self.lines.pop(0)
                if re.match(pattern, line):
                    return line, before
                before.append(line)
            self.take(0.2)
        raise BoardFailed(f"{what or pattern} did not come, but {before[-20:]}")

    def command(self, text, answer="ok"):
        """Sends a line and waits for its answer; an event may come before it."""
        self.send(text + "\n")
        line, _ = self.wait_for("ok|error: ", f"the answer to {text!r}")
        if not re.match(answer, line):
            raise BoardFailed(f"{text!r} was answered by {line!r}, not by {answer!r}")
        return line

    def flood(self, lines, obey_xoff):
        """Sends all lines without waiting for an answer to any."""
        data = "".join(line + "\n" for line in lines).encode()
        while data:
            writable = select.select([], [self.uart], [], 0.0)[1] and not (obey_xoff and self.paused)
            if writable:
                data = data[self.uart.send(data[:16 if obey_xoff else 4096]):]
            self.take(0.0 if writable else 0.05)

    def status(self):
        """(state, position, milliseconds since the start)"""
        self.send("?")
        line, _ = self.wait_for("<")
        found = re.match(r"<(\w+) (\S+) ring (\d+) late (\d+) ms (\d+)>", line)
        return found[1], tuple(float(v) for v in found[2].split(",")), int(found[5])

    def pin_levels(self):
        """(port, pin, level) of the changes since the last call, in order."""
        self.trace_rest += self.trace.read()
        *lines, self.trace_rest = self.trace_rest.split("\n")
        found = (re.match(r"pl061_set_output (\S+) setting output (\d+) to (\d)$", line) for line in lines)
        return [(m[1], int(m[2]), int(m[3])) for m in found if m]
