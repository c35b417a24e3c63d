# SPDX-License-Identifier: MIT
"""A sender at the serial line of a board in QEMU, in the machine's time."""
import os
import pathlib
import select
import sys
import time

from board_in_qemu import WAIT_S

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "serve"))
from sender import Failed, Sender  # noqa: E402


class BoardSender(Sender):
    """As tests/serve has it. Between two lines of a case the board may run on as far as the host lets it, but a wait is exact, and at its
    end the board halts until something is sent."""

    def __init__(self, board):
        self.board, self.socket, self.text = board, None, b""
        self.ms = 1_000_000 // board.kind.tick_ns  # ticks

    def send(self, data):
        self.board.uart.sendall(data)
        if self.board.halts:  # what answers also fills the UART's FIFO: a byte that acts at once comes at this instant of the machine's time
            self.board.halted()
            self.board.halted()
        self.board.go_on()

    def take(self, seconds):
        """Whether something has come."""
        if not select.select([self.board.uart], [], [], seconds)[0]:
            return False
        part = os.read(self.board.uart.fileno(), 65536)
        if not part:
            raise Failed("QEMU has ended")
        self.text += part
        return True

    def read(self, seconds):
        if self.take(0.0):
            return True
        self.board.go_on()
        return self.take(max(seconds, 0.0))

    def line(self, seconds=20.0):
        return super().line(seconds)

    def wait_ms(self, ms):
        self.board.run_ticks(ms * self.ms, self.take)

    def until(self, state, seconds=30.0):
        until = time.monotonic() + seconds
        while (report := self.report())[1:].split("|")[0] not in state.split("|"):
            if time.monotonic() > until:
                raise Failed(f"never {state}: {report}")
            self.wait_ms(10)
        return report

    def close(self):
        pass
