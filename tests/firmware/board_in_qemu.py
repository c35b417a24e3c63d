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


STEP, DIRECTION, ENABLE = (0, 1, 2), (4, 5, 6), 7  # pins of the axes; those of all boards


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


class Pl061Pins:
    """The pins of a board with PL061 ports: of the port that has switched the drives on."""
    options = ["-trace", "pl061_set_output"]

    def __init__(self, enable_pin):
        self.enable_pin = enable_pin
        self.port = None
        self.before = []

    def changes(self, lines):
        """[(pin, level, None)]: QEMU does not say when."""
        found = (re.match(r"pl061_set_output (\S+) setting output (\d+) to (\d)$", line) for line in lines)
        changes = [(m[1], int(m[2]), int(m[3])) for m in found if m]
        if self.port is None:
            self.before += changes
            self.port = next((port for port, pin, _ in self.before if pin == self.enable_pin), None)
            changes = self.before
        return [(pin, level, None) for port, pin, level in changes if port == self.port]


class Stm32Pins:
    """Those of port C of an STM32F4, which QEMU does not have: it tells of each access to the missing device. The firmware sets all
    step and direction lines at once, in each tick, so that these accesses count the ticks."""
    options = ["-d", "unimp"]
    lines = sum(1 << pin for pin in STEP + DIRECTION)

    def __init__(self, _):
        self.level = self.ticks = 0

    def changes(self, lines):
        """[(pin, level, tick)]"""
        changes = []
        for line in lines:
            m = re.match(r"GPIOC: unimplemented device write \(size 4, offset 0x018, value 0x(\w+)\)", line)
            if m:
                clear, high = divmod(int(m[1], 16), 0x10000)
                self.ticks += (clear | high) & self.lines == self.lines
                level = self.level & ~clear | high
                changes += [(pin, level >> pin & 1, self.ticks) for pin in range(16) if (level ^ self.level) >> pin & 1]
                self.level = level
        return changes


class Nrf51Pins:
    """Those of an nRF51. The firmware writes all levels in each tick, so that these writes count the ticks."""
    options = ["-trace", "nrf51_gpio_write"]
    pin = dict(zip((1, 2, 3, 21, 22, 23, 20), (*STEP, *DIRECTION, ENABLE)))

    def __init__(self, _):
        self.level = self.ticks = 0

    def changes(self, lines):
        """[(pin, level, tick)], with the pins' numbers of the other boards"""
        changes = []
        for line in lines:
            m = re.match(r"nrf51_gpio_write offset 0x(504|508|50c) value 0x(\w+)", line)
            if m:
                value = int(m[2], 16)
                level = {"504": value, "508": self.level | value, "50c": self.level & ~value}[m[1]]
                self.ticks += m[1] == "504"
                changes += [(number, level >> pin & 1, self.ticks) for pin, number in self.pin.items() if (level ^ self.level) >> pin & 1]
                self.level = level
        return changes


class NoPins:
    """Of a board whose pins QEMU does not show, or that this file does not know."""
    options = []

    def __init__(self, _):
        pass

    def changes(self, _):
        return []


class Kind:
    """A board that QEMU has. `window` and `scalar` are those of its image; `shift`: an instruction takes 2^shift ns; `slow`: its machine
    has segments of 8 ms and ticks of 200 us, as machine.hpp makes it, and a window that is shorter than the tool's shortest: it makes
    the same steps in the same order, but not at the same time."""

    def __init__(self, window, scalar, shift, pins, *, buttons=False, watchdog=False, slow=False):
        self.window, self.scalar, self.shift, self.pins, self.slow = window, scalar, shift, pins, slow
        self.tick_ns = 200_000 if slow else 50_000
        self.buttons, self.watchdog = buttons, watchdog


KINDS = {"lm3s6965evb": Kind(20, "fixed", 4, Pl061Pins, buttons=True, watchdog=True),
         "netduinoplus2": Kind(64, "float", 3, Stm32Pins),
         "microbit": Kind(16, "float", 6, Nrf51Pins, slow=True)}
UNKNOWN = Kind(20, "fixed", 4, NoPins)  # any other: its serial line can be talked to


class Board:
    """The emulator runs as fast as the host can, by a clock of its own that counts instructions. So nothing here may depend on the
    host's time; the board is waited for. `clock`: how its clock goes, if otherwise."""

    def __init__(self, image, folder, machine, qemu_options=(), clock=""):
        trace_path = os.path.join(folder, "pins.txt")
        serial, monitor = os.path.join(folder, "uart"), os.path.join(folder, "qmp")
        for path in (trace_path, serial, monitor):
            if os.path.exists(path):
                os.remove(path)
        self.kind = KINDS.get(machine, UNKNOWN)
        self.pins = self.kind.pins(ENABLE)
        self.qemu = subprocess.Popen(
            ["qemu-system-arm", "-M", machine, "-display", "none", "-icount", clock or f"shift={self.kind.shift},sleep=off",
             "-chardev", f"socket,id=uart,path={serial},server=on,wait=on", "-serial", "chardev:uart",
             "-qmp", f"unix:{monitor},server=on,wait=off", "-monitor", "none",
             *self.kind.pins.options, "-D", trace_path, *qemu_options, "-kernel", image])
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
        """(pin, level, tick or None) of the changes since the last call, in order."""
        self.trace_rest += self.trace.read()
        *lines, self.trace_rest = self.trace_rest.split("\n")
        return self.pins.changes(lines)
