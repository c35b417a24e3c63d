# SPDX-License-Identifier: MIT
"""A sender at the serial line of an emulated board, in the machine's time."""
import pathlib
import sys
import time

import board_in_node
import board_in_qemu
from board_in_qemu import KINDS, WAIT_S, plugins_refused

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "serve"))
from sender import Failed, Sender  # noqa: E402


# {machine: (its board, why it cannot be had here)}
EMULATED = (dict.fromkeys(KINDS, (board_in_qemu.Board, plugins_refused)) |
            dict.fromkeys(("pico", "pico-usb"), (board_in_node.Board, board_in_node.refused)))
SLICE_MS = 20


class BoardSender(Sender):
    """As tests/serve has it. The board runs only while something is waited for, and then in slices: however busy the host is, it passes
    no more of the machine's time than a slice without taking what was sent."""
    PATIENCE_S = WAIT_S

    def __init__(self, board):
        self.board, self.text = board, b""
        self.ms = 1_000_000 // board.kind.tick_ns  # ticks

    def send(self, data):
        self.board.transmit(data)

    def begin(self, lines):
        """A program that begins when the board has received all of it, however late a busy host sends it: at M0 it waits for that."""
        self.send("".join(f"{line}\n" for line in ["M0", *lines]).encode())
        self.until("Hold:0")
        if not (line := self.line()).startswith("[MSG:Program paused"):
            raise Failed(f"at M0 it said {line!r}")
        self.send(b"~")

    def take(self, seconds):
        """Whether something has come."""
        part = self.board.receive(seconds)
        self.text += part
        return bool(part)

    def read(self, seconds):
        if self.take(0.0):
            return True
        until = time.monotonic() + seconds
        had, ms = len(self.text), 5
        while len(self.text) == had and time.monotonic() < until:
            self.board.run_ticks(ms * self.ms, self.take)
            ms = min(2 * ms, SLICE_MS)
        return len(self.text) > had

    def wait_ms(self, ms):
        for part in range(0, ms, SLICE_MS):
            self.board.run_ticks(min(SLICE_MS, ms - part) * self.ms, self.take)

    def until(self, state, seconds=WAIT_S):
        until = time.monotonic() + seconds
        while (report := self.report())[1:].split("|")[0] not in state.split("|"):
            if time.monotonic() > until:
                raise Failed(f"never {state}: {report}")
            self.wait_ms(10)
        return report
