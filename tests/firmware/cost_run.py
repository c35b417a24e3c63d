#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What the reference firmware costs on an emulated board, in instructions and bytes: cost_run.py IMAGE BOARD [PROGRAM]

PROGRAM: waypoints, or for an image that senders operate G-code. As it stands here: examples/path61.csv, and operated_run.PROGRAM."""
import pathlib
import re
import select
import subprocess
import sys
import tempfile

from board_in_qemu import Board, BoardFailed, built_plugin, plugins_refused
from operated_run import PROGRAM
from planned import waypoints

# The interrupt is the first one.
OF_WAYPOINTS = {"tick": "firmware::on_tick()", "next": "Trajectory<.*>::next(", "plan": "firmware::Motion::plan()"}
OPERATED = {"tick": "firmware::on_tick()", "round": "splinefeed::Controller::next("}


def ranges(image):
    """{name: BEGIN:END} of the functions, from the image's symbols: those of the controller, or of the motion of waypoints."""
    names = subprocess.run(["arm-none-eabi-nm", "-SC", image], check=True, capture_output=True, text=True).stdout
    functions, found = OPERATED if OPERATED["round"] in names else OF_WAYPOINTS, {}
    for line in names.splitlines():
        address, size, _, name = line.split(" ", 3) if line.count(" ") >= 3 else ("", "", "", "")
        for key, wanted in functions.items():
            if address and re.search(re.escape(wanted).replace(r"<\.\*>", "<.*>"), name):
                found[key] = f"{int(address, 16):x}:{int(address, 16) + int(size, 16):x}"
    if found.keys() != functions.keys():
        raise BoardFailed(f"the image has {sorted(found)}, not {sorted(functions)}")
    return {key: found[key] for key in functions}


def of_waypoints(board, rows):
    board.wait_for(r"\[boot ")
    board.command("at " + rows[0])
    board.flood(rows + ["end"], obey_xoff=False)  # the host's pace changes nothing
    finish(board)
    board.send("memory\n")
    print(board.wait_for(r"\[stack ")[0])


def operated(board, lines):
    """All lines fit into the board's buffer, and wait there behind M0. One question at a time: with more QEMU and the test would wait for
    each other."""
    board.wait_for("Grbl ")
    for text, state in (("".join(f"{line}\n" for line in ["M0", *lines]), "<Hold:0|"), ("~", "<Idle|")):
        board.send(text + "?")
        while not board.wait_for("<")[0].startswith(state):
            board.send("?")


def finish(board):
    """Waits for the end. Meanwhile questions come as fast as the line takes them: the longest interrupt is one that receives a byte and sends
    one, and with so many of them each run meets it."""
    lines = []
    while not any(line.startswith("[done ") for line in lines):
        if select.select([], [board.uart], [], 0.0)[1]:
            board.uart.send(b"?" * 64)
        board.take(0.01)
        lines, board.lines = board.lines, []
        if refused := [line for line in lines if line.startswith("error")]:
            raise BoardFailed(f"the program was refused: {refused}")


def main():
    image, machine = sys.argv[1:3]
    program = pathlib.Path(sys.argv[3]) if len(sys.argv) > 3 else None
    if refused := plugins_refused():
        print(f"SKIPPED: {refused}")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        log = f"{folder}/cost.txt"
        places = ranges(image)
        options = ",".join([built_plugin("cost", folder), f"log={log}"] + [f"{name}={place}" for name, place in places.items()])
        board = Board(image, folder, machine, ["-plugin", options])
        try:
            if "round" in places:
                operated(board, program.read_text().splitlines() if program else PROGRAM)
            else:
                of_waypoints(board, waypoints(program or "examples/path61.csv"))
            board.ask_monitor("quit")
            board.qemu.wait()
            with open(log, encoding="ascii") as costs:
                *lines, late = costs.read().splitlines()
                for line in lines:
                    name, calls, mean, first, later = line.split()
                    print(f"cost {name} {mean} longest {max(int(first), int(later))} calls {calls}")
                print(f"cost {late} instructions")
        except BoardFailed as problem:
            print(f"{machine}: {problem}")
            return 1
        finally:
            board.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
