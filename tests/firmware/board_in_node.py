# SPDX-License-Identifier: MIT
"""A Raspberry Pi Pico in rp2040js (pico/board.mjs), with what tests ask of a board in QEMU. Its time stands still but while it is run: nothing depends on the host's."""
import json
import os
import pathlib
import subprocess

from board_in_qemu import BoardFailed, Change, DIRECTION, ENABLE, ESTOP, LIMIT, STEP

DRIVER = pathlib.Path(__file__).resolve().parent / "pico"
GPIO = 100  # GPIO n is pin 100 + n, where all boards have no number for it
TICK_NS = 40_000  # of its motion
PINS = dict(zip((2, 3, 4, 5, 6, 7, 8, 10, 11), (*STEP, *DIRECTION, ENABLE, ESTOP, LIMIT)))
GPIOS = {pin: gpio for gpio, pin in PINS.items()}
OPENS = {ESTOP, LIMIT, GPIO + 12, GPIO + 13}  # contacts to ground that open when they are pressed; all other ones close


class Kind:
    """As that of a board in QEMU."""
    window, scalar, slow, watchdog, tick_ns = 64, "fixed", False, True, TICK_NS
    exact = True    # its edges come when they were planned
    reads_late = 6  # ticks: it reads its inputs each fifth one
    contacts = tuple(OPENS) + (GPIO + 14,)


class Board:
    """`machine`: "pico", whose sender is at UART0, or "pico-usb". `seed`: of what the RAM holds when it is switched on, and of what a power
    cut leaves in the flash."""

    def __init__(self, image, _folder=None, machine="pico", seed=1):
        self.kind = Kind()
        self.node = subprocess.Popen(["node", DRIVER / "board.mjs", image, str(seed)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.ns, self.said, self.changes, self.answer, self.by_usb = 0, b"", [], {}, False
        for pin in self.kind.contacts:
            self.press(pin, False)
        self.by_usb = machine == "pico-usb"
        if self.by_usb:
            self.ask("usb_attach")

    def close(self):
        self.node.stdin.close()
        self.node.wait()
        self.node.stdout.close()

    def ask(self, action, **arguments):
        """A request to board.mjs; what came since the last one is kept."""
        try:
            self.node.stdin.write(json.dumps({"do": action, **arguments}) + "\n")
            self.node.stdin.flush()
            self.answer = json.loads(self.node.stdout.readline())
        except (BrokenPipeError, json.JSONDecodeError) as problem:
            raise BoardFailed("the emulator has ended") from problem
        if "error" in self.answer:
            raise BoardFailed(self.answer["error"])
        self.ns = self.answer["ns"]
        self.said += self.answer["usb" if self.by_usb else "said"].encode("latin-1")
        self.changes += [Change(PINS.get(gpio, GPIO + gpio), level, ns // TICK_NS, ns) for ns, gpio, level in self.answer["edges"]]

    def transmit(self, data):
        """Bytes from its sender, at this instant of its time."""
        self.ask("usb_send" if self.by_usb else "send", text=data.decode("latin-1"))

    def receive(self, _seconds=0.0):
        """What its sender has heard since the last call."""
        said, self.said = self.said, b""
        return said

    def press(self, pin, down):
        """The contact of an input. The change is of this instant; the firmware reads it later."""
        is_open = down == (pin in OPENS)  # then the pull-up decides
        self.ask("contact", pin=GPIOS.get(pin, pin - GPIO), level=None if is_open else 0)
        self.changes.append(Change(pin, int(is_open), self.tick(), self.ns))

    def tick(self):
        return self.ns // TICK_NS

    def run_ticks(self, count, take=None):
        """`take` receives what it says meanwhile."""
        self.ask("run", ns=count * TICK_NS)
        if take:
            take(0.0)

    def halt_after(self, changes):
        """run_ticks() ends when its outputs have changed so often from now on."""
        self.ask("halt_at_edges", count=changes)

    def go_on(self):
        self.ask("go_on")

    def reset(self):
        """As it is switched on for the first time."""
        self.ask("as_delivered")

    def pin_levels(self):
        """The changes since the last call, in order."""
        changes, self.changes = self.changes, []
        return changes


def refused():
    """Why it cannot be had here, or None."""
    folder = pathlib.Path(os.environ.get("SPLINEFEED_PICO", DRIVER.parents[2] / "build/release/pico"))
    return None if (folder / "node_modules/rp2040js").is_dir() else f"there is no rp2040js in {folder} (pico_emulator)"
