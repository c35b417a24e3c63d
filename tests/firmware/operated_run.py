#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The reference firmware that senders operate, on an emulated board: operated_run.py TOOL IMAGE BOARD

The cases of tests/controller/conformance.txt, each on a board that was reset; what the pins do with a program, against the edges that the
tool writes for it; stops and inputs in motion. Time is the emulator's."""
import csv
import os
import pathlib
import re
import subprocess
import sys
import tempfile

from board_in_qemu import Board, BoardFailed, ENABLE, ESTOP, KINDS, LIMIT, STEP, plugins_refused
from operated_board import BoardSender
from planned import AXES, LINES, MACHINE, STEPS_PER_MM, check, counts_after, of_axis, steps_of

from conformance import cases, take  # of tests/serve, which operated_board has made known
from sender import Failed

# The board has no home switches, no probe and no outputs, steps of 12.5 um, and numbers of its own.
WITHOUT = {"names", "home", "probe", "outputs", "fine", "numbers"}
TAKES_MEMORY = {"expressions", "points"}
SMALL = {"lm3s6965"}  # has no memory for those
GREETING = "Grbl 1.1h ['$' for help]"
NUMBERS = """$0=50 $1=255 $2=0 $3=0 $4=0 $5=0 $6=0 $10=3 $11=0.010 $12=0.002 $13=0 $20=1 $21=1 $22=0 $23=0 $24=0.000 $25=0.000 $26=0 $27=0.000
$30=1000.000 $31=0.000 $32=0 $100=80.000 $101=80.000 $102=400.000 $110=6000.000 $111=6000.000 $112=1200.000
$120=1000.000 $121=1000.000 $122=200.000 $130=300.000 $131=200.000 $132=80.000 ok""".split()
# Corners, an arc, a chain of short lines, a reversal.
PROGRAM = ["G21 G90 G64 P0.02", "G1 X20 F3000", "Y10", "G2 X30 Y20 I10 J0", "G1 X32 Y15 Z-1",
           *(f"X{32 + 0.5 * i:.3f} Y{15 + 0.04 * i * i:.3f}" for i in range(1, 25)), "G61 X40 Z-3 F1200", "G0 X5 Y5", "Z0"]
POINTS = ["G21 G90 G64 P0.02 G5.5 X10 Y6 Z-1 F1800", *(f"X{10 + 3 * i} Y{6 + i % 3} Z{-1 - 0.1 * i:.1f}" for i in range(1, 25)), "G80"]


class Bench:
    def __init__(self, tool, image, machine, folder):
        self.tool, self.folder = tool, folder
        self.board = Board(image, folder, machine)
        self.sender = BoardSender(self.board)
        self.name = image.rsplit("firmware_", 1)[1].removesuffix(".elf")
        self.expect("[MSG:The board has started: *", "", GREETING)

    def expect(self, *lines):
        for line in lines:
            said = self.sender.line()
            check(said == line if not line.endswith("*") else said.startswith(line[:-1]), f"it said {said!r}, not {line!r}")

    def ask(self, text, *lines):
        self.sender.send(text.encode())
        self.expect(*lines)

    def reset(self):
        """As it is switched on."""
        self.sender.wait_ms(1)  # halts it: one that waits for its line to be read answers no command
        self.board.ask_monitor("system_reset")
        self.sender.wait_ms(20)
        self.sender.text = b""
        self.board.pin_levels()

    def levels(self):
        return self.board.pin_levels()

    def counts(self):
        """Where it says that it stands, in steps."""
        return tuple(round(mm * per) for mm, per in zip(self.sender.place(), STEPS_PER_MM))


def steps_made(levels, up=(0, 0, 0)):
    return steps_of([(*LINES[change.pin], change.level) for change in levels if change.pin in LINES], up)[0]


def conforms(bench):
    """On the board with more memory the cases that need it: the other code of the boards is the same."""
    small = bench.name in SMALL
    run, failed = 0, []
    for name, lines in cases(WITHOUT | TAKES_MEMORY, None) if small else cases(WITHOUT, TAKES_MEMORY):
        run, at = run + 1, 0
        try:
            bench.reset()
            for at, command, rest in lines:
                take(bench.sender, command, rest)
            bench.sender.wait_ms(60)
            check(not bench.sender.text, f"more is said: {bench.sender.text!r}")
        except (Failed, BoardFailed) as failure:
            failed.append(f"{name}, line {at}: {failure}")
    check(run >= (50 if small else 12) and not failed, f"{run} cases, failed: {failed}")
    return f"{run} cases of the list"


def streams_points(bench):
    return travels(bench, POINTS)


def tells_its_numbers(bench):
    bench.reset()
    bench.ask("$$\n", *NUMBERS)
    bench.ask("$I\n", f"[VER:1.1h.*:splinefeed * {bench.name}]"[:10] + "*", "[OPT:V,100,1024]", "ok")
    bench.ask("$110=5000\n", "[MSG:$110 is max_velocity_mm_s in the machine file]", "error:53")
    bench.ask("$H\n$HY\n", "[MSG:No home of X, Y, Z: the machine has no switch for it]", "error:5", "[MSG:No home of Y: the machine has no switch for it]", "error:5")
    if bench.name in SMALL:
        bench.ask("G5.5 X1 F100\n", "[MSG:Error: 1:1 this controller has no memory for curves through points*", "error:20")
        bench.ask("~#1=5\n", "[MSG:Error: 2:1 parameters and expressions are not built in here*", "error:20")
    else:
        bench.ask("#200=1\n#201=1\n", "ok", "[MSG:Error: 2 the parameter cannot be stored*", "error:20")
        bench.ask("~#<name>=1\n", "[MSG:Error: 3 the parameter cannot be stored*", "error:20")
    return "its settings, which nothing changes"


def planned_steps(bench, lines):
    """What the tool makes of the program, on the machine of the same numbers."""
    program, edges = f"{bench.folder}/program.ngc", f"{bench.folder}/edges.csv"
    pathlib.Path(program).write_text("\n".join([*lines, "M2", ""]))
    subprocess.run([bench.tool, "run", program, "-m", MACHINE, "--dialect", "grbl", "--window", str(bench.board.kind.window), "--scalar",
                    bench.board.kind.scalar, "--edges", edges], check=True, capture_output=True)
    with open(edges, encoding="utf-8") as rows:
        levels = [(AXES.index(row["axis"]), row["line"], int(row["value"])) for row in csv.DictReader(rows)]
    return steps_of(levels, [0, 0, 0])[0]


def travels(bench, lines=PROGRAM):
    """A program: the steps of each axis are those of the tool's plan."""
    bench.reset()
    bench.sender.begin(lines)
    bench.expect(*["ok"] * (1 + len(lines)))
    bench.sender.until("Idle")
    steps, planned = steps_made(bench.levels()), planned_steps(bench, lines)
    check(bench.counts() == counts_after((0, 0, 0), steps), f"it says {bench.counts()}, its pins went to {counts_after((0, 0, 0), steps)}")
    for axis in range(3):
        check(of_axis(axis, steps) == of_axis(axis, planned), f"other steps of {AXES[axis]}: {len(of_axis(axis, steps))}, "
                                                              f"planned {len(of_axis(axis, planned))}")
    return f"a program of {len(lines)} lines, {len(steps)} steps, as planned"


def reset_at_rest(bench):
    """A reset stops nothing there, so neither does a second one at its heels."""
    bench.reset()
    bench.sender.send(b"\x18\x18")
    bench.sender.wait_ms(50)
    check(b"ALARM" not in bench.sender.text and GREETING.encode() in bench.sender.text, f"two resets at rest: {bench.sender.text!r}")
    return "two resets at rest"


def under_way(bench):
    bench.reset()
    bench.sender.begin(["G1 X200 F6000"])
    bench.expect("ok", "ok")
    bench.sender.wait_ms(500)


def switched_off(bench):
    """The tick that reads the emergency stop disables the drives; no pulse begins in it or later."""
    under_way(bench)
    bench.board.press(ESTOP, True)
    bench.expect("ALARM:10", "[MSG:emergency stop*")
    levels = bench.levels()
    tick, = [change.tick for change in levels if change.pin == ESTOP]
    off = [change.tick for change in levels if change.pin == ENABLE and not change.level and change.tick > 100]
    check(off == [tick], f"the drives are disabled in ticks {off}, the emergency stop was read in {tick}")
    late = [change for change in levels if change.pin in STEP and change.level and change.tick >= tick]
    check(not late, f"pulses after tick {tick}: {late[:3]}")
    at = bench.counts()
    check(at == counts_after((0, 0, 0), steps_made(levels)), f"it says {at}")
    bench.ask("$X\n", "[MSG:*", "error:50")
    bench.board.press(ESTOP, False)
    bench.sender.wait_ms(5)
    bench.ask("\x18", "", GREETING, "[MSG:'$H'|'$X' to unlock]")
    bench.ask("$X\nG0 X0\n", "[MSG:Caution: Unlocked]", "ok", "ok")
    bench.sender.until("Idle")
    check(bench.counts() == (0, 0, 0), "it does not come back")
    check(counts_after(at, steps_made(bench.levels(), (1, 0, 0))) == (0, 0, 0), "it comes back by other steps")
    return f"emergency stop at {at}, and back without a lost step"


def limited(bench):
    """A limit switch: the machine stops along the path, and may be jogged off it."""
    under_way(bench)
    before = len(steps_made(bench.levels()))
    bench.board.press(LIMIT, True)
    bench.expect("ALARM:1", "[MSG:a limit switch is active*")
    after = steps_made(bench.levels(), (1, 0, 0))
    check(10 < len(after) < 2 * 64 * 8, f"{len(after)} steps behind the switch")
    at = bench.counts()
    check(at == (before + len(after), 0, 0), f"it says {at}, its pins made {before} and {len(after)} steps")
    bench.ask("\x18", "", GREETING, "[MSG:'$H'|'$X' to unlock]")
    bench.ask("$X\n$J=G91 X-5 F600\n", "[MSG:Caution: Unlocked]", "ok", "ok")
    check("|Pn:XYZ" in bench.sender.report(), "the status does not show the switch")
    bench.board.press(LIMIT, False)
    bench.sender.until("Idle")
    check(bench.counts() == (at[0] - 400, 0, 0), f"it jogged to {bench.counts()}")
    return f"limit switch at {at}, {len(after)} steps on the path, and off it"


def stops(bench):
    """Bytes that stop, behind lines that wait: when the machine begins to slow down, and when it stands."""
    said = []
    for byte in "\x85", "\x18", "!":
        bench.reset()
        if byte == "\x85":
            bench.sender.send(b"$J=X200 F6000\n")
        else:
            bench.sender.begin(["G1 X200 F6000", *(f"X{199 - i % 2}.5" for i in range(100))])
        bench.sender.wait_ms(700)
        bench.levels()
        sent = bench.board.tick()
        bench.sender.send(byte.encode("latin-1"))
        bench.sender.wait_ms(900)
        pulses = [change.tick for change in bench.levels() if change.pin == STEP[0] and change.level and change.tick >= sent]
        slower = next((a for a, b in zip(pulses, pulses[1:]) if b - a > 3), sent)
        check(pulses[-1] - sent < 800 * bench.sender.ms, f"behind {byte!r} it moves for {(pulses[-1] - sent) / bench.sender.ms:.1f} ms")
        said.append(f"{byte!r}: slower after {(slower - sent) / 20:.1f} ms, stands after {(pulses[-1] - sent) / 20:.1f} ms")
        at = bench.counts()
        bench.sender.wait_ms(200)
        check(bench.counts() == at, f"behind {byte!r} it still moves: {bench.sender.report()} {bench.sender.text}")
    return "; ".join(said)


def main():
    tool, image, machine = sys.argv[1:]
    if machine not in KINDS:
        sys.exit(f"{machine}: board_in_qemu.py does not say how its pins are seen; it knows {', '.join(KINDS)}")
    if refused := plugins_refused():
        print(f"SKIPPED: {refused}")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(os.path.abspath(tool), image, machine, folder)
        try:
            tests = [tells_its_numbers, travels, reset_at_rest, switched_off, limited, stops, conforms]
            for test in tests + ([] if bench.name in SMALL else [streams_points]):
                print(test(bench), flush=True)
        except (BoardFailed, Failed) as problem:
            print(f"{machine}: {problem}")
            return 1
        finally:
            bench.board.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
