# SPDX-License-Identifier: MIT
"""A board of examples/firmware in QEMU: its UART, its inputs, and every level that its pins took."""
import json
import mmap
import os
import re
import select
import socket
import struct
import subprocess
import time
from typing import NamedTuple

XON, XOFF = b"\x11", b"\x13"
WAIT_S = 300  # for an answer, on a host that is busy


STEP, DIRECTION, ENABLE, ESTOP, LIMIT = (0, 1, 2), (4, 5, 6), 7, 8, 9  # pins, by the same numbers on all boards


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


def plugins_refused():
    """Why the tests' plugins cannot be used here, or None: they know one version of QEMU."""
    version = subprocess.run(["qemu-system-arm", "--version"], check=True, capture_output=True, text=True).stdout
    return None if "version 7.2" in version else "the plugins are for QEMU 7.2, this is " + version.splitlines()[0]


def built_plugin(name, folder):
    """tests/firmware/NAME_plugin.c, compiled."""
    plugin = f"{folder}/{name}.so"
    subprocess.run(["gcc", "-shared", "-fPIC", "-O2", "-Wall", "-Wextra", "-Werror", "-o", plugin,
                    f"tests/firmware/{name}_plugin.c"], check=True)
    return plugin


class Change(NamedTuple):
    """Of the level of a pin: of an output when it changed, of an input when the firmware first read it."""
    pin: int
    level: int
    tick: int  # how many times the firmware had read its inputs
    ns: int  # the machine's time


class Contact(NamedTuple):
    """Of an input to ground."""
    port: int
    bit: int
    opens: bool  # when it is pressed


class Kind:
    """A board that QEMU has. `window` and `scalar` are those of its image; `shift`: an instruction takes 2^shift ns; `slow`: its machine
    has segments of 8 ms and ticks of 200 us, as machine.hpp makes it. `ports`: what pins_plugin.c puts into it, first the port whose
    inputs the firmware reads in each tick; `outputs`: {(port, bit): pin}; `contacts`: {pin: Contact}."""

    exact, reads_late = False, 0

    def __init__(self, window, scalar, shift, ports, outputs, contacts, *, watchdog=False, slow=False):
        self.window, self.scalar, self.shift, self.watchdog, self.slow = window, scalar, shift, watchdog, slow
        self.tick_ns = 200_000 if slow else 50_000
        self.ports, self.contacts = ports, contacts
        self.pins = outputs | {(contact.port, contact.bit): pin for pin, contact in contacts.items()}


OUTPUTS = (*STEP, *DIRECTION, ENABLE)
KINDS = {"lm3s6965evb": Kind(20, "fixed", 4, ("pl061=40025000", "pl061=40024000", "pl061=40007000"), {(2, pin): pin for pin in OUTPUTS},
                             {ESTOP: Contact(0, 1, False), LIMIT: Contact(1, 0, False)}, watchdog=True),
         "netduinoplus2": Kind(64, "float", 3, ("stm32=40020400", "stm32=40020800"), {(1, pin): pin for pin in OUTPUTS},
                               {ESTOP: Contact(0, 0, True), LIMIT: Contact(0, 1, True)}),
         "microbit": Kind(10, "float", 6, ("nrf51=50000000",), {(0, bit): pin for bit, pin in zip((1, 2, 3, 21, 22, 23, 20), OUTPUTS)},
                          {ESTOP: Contact(0, 17, False), LIMIT: Contact(0, 26, False)}, slow=True)}
UNKNOWN = Kind(20, "fixed", 4, (), {}, {})  # any other: its serial line can be talked to


class Board:
    """The emulator runs as fast as the host can, by a clock of its own that counts instructions. So nothing here may depend on the
    host's time; the board is waited for. `clock`: how its clock goes, if otherwise."""

    def __init__(self, image, folder, machine, qemu_options=(), clock=""):
        self.kind = KINDS.get(machine, UNKNOWN)
        log_path, contacts_path = os.path.join(folder, "pins.txt"), os.path.join(folder, "contacts")
        serial, monitor = os.path.join(folder, "uart"), os.path.join(folder, "qmp")
        for path in (serial, monitor):
            if os.path.exists(path):
                os.remove(path)
        with open(log_path, "w", encoding="ascii"):
            pass  # QEMU listens before the plugin opens it
        with open(contacts_path, "wb+") as file:
            file.truncate(28)
            self.contacts = mmap.mmap(file.fileno(), 28)
        self.halts = False
        for pin in self.kind.contacts:
            self.press(pin, False)
        pins = []
        if self.kind.ports:
            pins = ["-plugin", ",".join([built_plugin("pins", folder), f"log={log_path}", f"contacts={contacts_path}", *self.kind.ports])]
        self.qemu = subprocess.Popen(
            ["qemu-system-arm", "-M", machine, "-display", "none", "-icount", clock or f"shift={self.kind.shift},sleep=off",
             "-chardev", f"socket,id=uart,path={serial},server=on,wait=on", "-serial", "chardev:uart",
             "-qmp", f"unix:{monitor},server=on,wait=off", "-monitor", "none", *pins, *qemu_options, "-kernel", image])
        self.uart = connected(serial)
        self.log, self.log_rest, self.log_lines = open(log_path, encoding="ascii"), "", 0
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
        self.log.close()

    def ask_monitor(self, command, **arguments):
        self.monitor.write(json.dumps({"execute": command, "arguments": arguments}) + "\n")
        self.monitor.flush()
        while True:
            answer = json.loads(self.monitor.readline())
            if "return" in answer:
                return answer["return"]
            if "error" in answer:
                raise BoardFailed(f"{command}: {answer['error']['desc']}")

    def press(self, pin, down):
        """The contact of an input; what no firmware reads in time is lost."""
        contact = self.kind.contacts[pin]
        closed, = struct.unpack_from("=I", self.contacts, 4 * contact.port)
        bit = 1 << contact.bit
        struct.pack_into("=I", self.contacts, 4 * contact.port, closed & ~bit if down == contact.opens else closed | bit)
        self.go_on()

    def send(self, text):
        self.uart.sendall(text.encode())
        self.go_on()

    def transmit(self, data):
        """Bytes to its UART. What halts stays halted, and has them at this instant of the machine's time."""
        self.uart.sendall(data)
        if self.halts:  # what answers also fills the UART's FIFO
            self.halted()
            self.halted()

    def receive(self, seconds):
        """What it has said, if it says something within that time."""
        if not select.select([self.uart], [], [], seconds)[0]:
            return b""
        data = self.uart.recv(65536)
        if not data:
            raise BoardFailed("QEMU has ended")
        return data

    def reset(self):
        self.ask_monitor("system_reset")

    def halt_after(self, changes):
        """The machine halts when its pins have changed so often from now on. What the host does next, it then does at that instant of the
        machine's time, however busy the host is."""
        self.go_on()
        struct.pack_into("=I", self.contacts, 16, self.log_lines + changes)
        self.halts = True

    def tick(self):
        """How many times the firmware has read its inputs."""
        return struct.unpack_from("=I", self.contacts, 24)[0]

    def run_ticks(self, count, take):
        """Lets it run for so many ticks of the machine, and halts it: until the next send() nothing happens there. `take` receives what it
        says meanwhile: QEMU waits, and answers no command, while some 200 bytes are not received."""
        struct.pack_into("=I", self.contacts, 20, self.tick() + count)
        self.go_on()
        self.halts = True
        while struct.unpack_from("=I", self.contacts, 20)[0] != 0:
            take(0.001)
        while take(0.0) or not self.halted():
            pass

    def halted(self):
        return not self.ask_monitor("query-status")["running"]

    def go_on(self):
        """If it halted or was to halt."""
        if self.halts:
            struct.pack_into("=I", self.contacts, 16, 0)
            self.halts = False
            self.ask_monitor("cont")

    def take(self, seconds):
        """Takes what the board says within that time, at once if something is there."""
        data = self.receive(seconds)
        if not data:
            return False
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
        """Sends all lines without waiting for an answer to any. `obey_xoff`: the board holds its motion, which is resumed when it has asked
        to pause; until then each part is received before the next one is sent, because a full board would not read the "~"."""
        data = "".join(line + "\n" for line in lines).encode()
        if obey_xoff:
            answers, before = [], self.pauses
            while self.pauses == before:
                if not data:
                    raise BoardFailed("the board never asked to pause")
                self.send(data[:16].decode() + "?")
                data = data[16:]
                answers += self.wait_for("<")[1]
            self.lines = answers + self.lines
            self.send("~")
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
        """The changes since the last call, in order."""
        self.log_rest += self.log.read()
        *lines, self.log_rest = self.log_rest.split("\n")
        self.log_lines += len(lines)
        changes = []
        for line in lines:
            ns, tick, port, bit, level = map(int, line.split(" "))
            if (port, bit) in self.kind.pins:
                changes.append(Change(self.kind.pins[port, bit], level, tick, ns))
        return changes
