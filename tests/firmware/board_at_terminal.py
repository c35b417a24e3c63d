#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""An emulated board whose serial line is a pseudo terminal: board_at_terminal.py IMAGE BOARD LINK. It says "ready", and when its input ends the counts to which
the pulses of its pins lead.

Its time goes on while its sender talks, and stands still HEARD_MS behind the last byte. So nothing depends on how long a busy host lets that sender wait."""
import os
import select
import sys
import tempfile
import tty

from operated_board import EMULATED, SLICE_MS, BoardSender
from planned import LINES, counts_after, steps_of

HEARD_MS = 800  # a jog ends behind 1000 ms of silence


def main():
    image, machine, link = sys.argv[1:]
    board_of, refused = EMULATED[machine]
    if why := refused():
        print(why)
        return 77
    master, slave = os.openpty()  # which stays open: its other end does not see a sender go, as a wire does not
    tty.setraw(slave)
    os.set_blocking(master, False)
    os.symlink(os.ttyname(slave), link)
    with tempfile.TemporaryDirectory() as folder:
        board = board_of(image, folder, machine)
        try:
            sender, left = BoardSender(board), HEARD_MS
            print("ready", flush=True)
            while True:
                heard, free, _ = select.select([master, sys.stdin], [master] if sender.text else [], [], 0.0 if left > 0 else None)
                if sys.stdin in heard:
                    break
                if master in heard:
                    sender.send(os.read(master, 4096))
                    left = HEARD_MS
                if left > 0:
                    sender.wait_ms(SLICE_MS)
                    left -= SLICE_MS
                if free:
                    sender.text = sender.text[os.write(master, sender.text):]
            steps = steps_of([(*LINES[change.pin], change.level) for change in board.pin_levels() if change.pin in LINES], (0, 0, 0))[0]
            print(*counts_after((0, 0, 0), steps))
        finally:
            board.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
