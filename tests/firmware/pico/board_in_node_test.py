#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The emulated Pico as a process, with self_test.cpp in it: board_in_node_test.py IMAGE"""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from board_in_node import Board, GPIO, TICK_NS  # noqa: E402
from board_in_qemu import BoardFailed, ESTOP  # noqa: E402

MS = 1_000_000 // TICK_NS


def check(is_it, must_be):
    if is_it != must_be:
        sys.exit(f"it is {is_it!r}, not {must_be!r}")


def main():
    board = Board(sys.argv[1], seed=5)
    board.run_ticks(5 * MS)
    check((board.tick(), board.receive(), board.receive()), (5 * MS, b"hello\n", b""))
    board.transmit(b"a\xff")
    check(board.receive(), b"")  # its time stands still
    heard = []
    board.run_ticks(MS, lambda _seconds: heard.append(board.receive()))
    check(heard, [b"a\xff"])

    board.pin_levels()
    board.press(ESTOP, True)  # it opens: GPIO9 goes high behind its pull-up
    board.run_ticks(MS)
    pressed, *changes = board.pin_levels()
    check((pressed.pin, pressed.level, pressed.ns), (ESTOP, 1, 6_000_000))
    shown, = [change for change in changes if change.pin == GPIO + 9]
    check((shown.level, 0 < shown.ns - pressed.ns < 250_000, shown.tick), (1, True, shown.ns // TICK_NS))

    board.halt_after(1)
    board.run_ticks(MS)
    check((len(board.pin_levels()) in (1, 2), board.tick() < 8 * MS), (True, True))  # two pins may change at once
    board.go_on()
    board.ask("cut_after", steps=0)
    board.ask("power_off")
    off = board.ns
    board.run_ticks(MS)
    check(board.ns, off)
    board.reset()
    board.run_ticks(5 * MS)
    check(board.receive(), b"hello\n")
    try:
        board.ask("no such request")
        sys.exit("a request that there is none is answered")
    except BoardFailed:
        pass
    board.close()
    check(board.node.returncode, 0)
    print("the Pico as a process: its line, its contacts, its time")


if __name__ == "__main__":
    main()
