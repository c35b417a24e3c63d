#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The reference firmware that senders operate, on an emulated board: operated_run.py TOOL IMAGE BOARD

The cases of tests/controller/conformance.txt, each on a board that was reset; what the pins do with a program, against the edges that the
tool writes for it; stops and inputs in motion. Time is the emulator's."""
import csv
import itertools
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

from board_in_qemu import BoardFailed, ENABLE, ESTOP, LIMIT, STEP
from operated_board import BoardSender, EMULATED
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
# What the Pico has otherwise.
OWN_NUMBERS = {"rp2040": {"$0": "2", "$110": "75000.000", "$111": "75000.000", "$112": "15000.000"}}
MACHINES = {"rp2040": "examples/firmware/pico.toml"}
# Corners, an arc, a chain of short lines, a reversal.
PROGRAM = ["G21 G90 G64 P0.02", "G1 X20 F3000", "Y10", "G2 X30 Y20 I10 J0", "G1 X32 Y15 Z-1",
           *(f"X{32 + 0.5 * i:.3f} Y{15 + 0.04 * i * i:.3f}" for i in range(1, 25)), "G61 X40 Z-3 F1200", "G0 X5 Y5", "Z0"]
# Lines of a millimetre at 50 mm/s, which the Pico's planner keeps up with; shorter ones it travels more slowly.
MILLIMETRES = ["G21 G90 G64 P0.02", "G1 X20 F3000", "Y10", "G2 X30 Y20 I10 J0", "G1 X32 Y15 Z-1",
               *(f"X{32 + 0.9 * i:.3f} Y{15 + 8 * math.sin(0.05 * i):.3f}" for i in range(1, 40)), "G1 X100 Z-3 F1200", "G0 X5 Y5", "Z0"]
POINTS = ["G21 G90 G64 P0.02 G5.5 X10 Y6 Z-1 F1800", *(f"X{10 + 3 * i} Y{6 + i % 3} Z{-1 - 0.1 * i:.1f}" for i in range(1, 25)), "G80"]


class Bench:
    def __init__(self, tool, image, machine, folder):
        self.tool, self.folder = tool, folder
        self.board = EMULATED[machine][0](image, folder, machine)
        self.sender = BoardSender(self.board)
        self.name = image.rsplit("firmware_", 1)[1].removesuffix(".elf")
        self.by_usb = machine == "pico-usb"  # that the board has started was said by the UART
        self.expect(*([] if self.by_usb else ["[MSG:The board has started: *"]), "", GREETING)

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
        self.board.reset()
        self.sender.text = b""
        for _ in range(50):
            self.sender.wait_ms(20)
            if self.sender.text.endswith(f"{GREETING}\r\n".encode()):
                break
        else:
            raise Failed(f"switched on, it said {self.sender.text!r}")
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
    own = OWN_NUMBERS.get(bench.name, {})
    bench.ask("$$\n", *(f"{key}={own[key]}" if (key := line.split("=")[0]) in own else line for line in NUMBERS))
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


def planned_edges(bench, lines):
    """What the tool makes of the program, on the machine of the same numbers."""
    program, edges = f"{bench.folder}/program.ngc", f"{bench.folder}/edges.csv"
    pathlib.Path(program).write_text("\n".join([*lines, "M2", ""]))
    subprocess.run([bench.tool, "run", program, "-m", MACHINES.get(bench.name, MACHINE), "--dialect", "grbl", "--window", str(bench.board.kind.window), "--scalar",
                    bench.board.kind.scalar, "--edges", edges], check=True, capture_output=True)
    with open(edges, encoding="utf-8") as rows:
        return [(int(row["t_ns"]), AXES.index(row["axis"]), row["line"], int(row["value"])) for row in csv.DictReader(rows)]


def check_instants(levels, planned):
    """A board whose edges come from a coprocessor makes them when they were planned, from the first one on."""
    made = [(change.ns, *LINES[change.pin], change.level) for change in levels if change.pin in LINES]
    for axis, line in itertools.product(range(3), ("step", "dir")):
        ours, theirs = ([(ns, level) for ns, *edge, level in edges if edge == [axis, line]] for edges in (made, planned))
        check([level for _, level in ours] == [level for _, level in theirs], f"other levels of {AXES[axis]} {line}")
        off = max(abs((a - made[0][0]) - (b - planned[0][0])) for (a, _), (b, _) in zip(ours, theirs))
        check(off <= 8, f"an edge of {AXES[axis]} {line} is {off} ns from its plan")


def travels(bench, lines=PROGRAM, exact=False):
    """A program: the steps of each axis are those of the tool's plan."""
    bench.reset()
    bench.sender.begin(lines)
    bench.expect(*["ok"] * (1 + len(lines)))
    bench.sender.until("Idle")
    levels, edges = bench.levels(), planned_edges(bench, lines)
    steps, planned = steps_made(levels), steps_of([edge[1:] for edge in edges], [0, 0, 0])[0]
    check(bench.counts() == counts_after((0, 0, 0), steps), f"it says {bench.counts()}, its pins went to {counts_after((0, 0, 0), steps)}")
    for axis in range(3):
        check(of_axis(axis, steps) == of_axis(axis, planned), f"other steps of {AXES[axis]}: {len(of_axis(axis, steps))}, "
                                                              f"planned {len(of_axis(axis, planned))}")
    if exact:
        check_instants(levels, edges)
    return f"a program of {len(lines)} lines, {len(steps)} steps, as planned{', to 8 ns' if exact else ''}"


def travels_exactly(bench):
    return travels(bench, MILLIMETRES, exact=True)


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
    """The tick that reads the emergency stop disables the drives; no pulse begins in it or later. The Pico reads it each 200 us."""
    under_way(bench)
    bench.board.press(ESTOP, True)
    bench.expect("ALARM:10", "[MSG:emergency stop*")
    levels = bench.levels()
    tick, = [change.tick for change in levels if change.pin == ESTOP]
    off = [change for change in levels if change.pin == ENABLE and not change.level and change.tick > 100]
    latest = tick + bench.board.kind.reads_late
    check(len(off) == 1 and tick <= off[0].tick <= latest, f"the drives are disabled by {off}, the emergency stop came in tick {tick}")
    late = [change for change in levels if change.pin in STEP and change.level and (change.tick, change.ns) >= (off[0].tick, off[0].ns)]
    check(not late, f"pulses behind {off[0]}: {late[:3]}")
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


def unplugged(bench):
    """The cable is pulled in motion: the machine stands on the path, and whoever comes next goes on from there."""
    under_way(bench)
    bench.board.ask("usb_detach")
    bench.sender.wait_ms(600)
    made = len(steps_made(bench.levels()))
    bench.sender.wait_ms(200)
    check(not steps_made(bench.levels(), (1, 0, 0)), "without its sender it goes on")
    bench.board.ask("usb_attach")
    bench.sender.wait_ms(100)
    held = f"{GREETING}\r\n[MSG:Held: '~' goes on, a reset ends the program]\r\n"
    check(bench.sender.text.endswith(held.encode()), f"plugged in again, it said {bench.sender.text!r}")
    bench.sender.text = b""
    check(bench.sender.report().startswith("<Hold:0|"), "it is not held")
    check(bench.counts() == (made, 0, 0), f"it says {bench.counts()}, its pins made {made} steps")
    bench.sender.send(b"~")
    bench.sender.until("Idle")
    check(made + len(steps_made(bench.levels(), (1, 0, 0))) == 200 * STEPS_PER_MM[0], "it does not go on to the end")
    return f"a cable that was pulled: held behind {made} steps, and on to the end"


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
        slower = next((a for a, b in zip(pulses, pulses[1:]) if (b - a) * bench.board.kind.tick_ns > 190_000), sent)
        check(pulses[-1] - sent < 800 * bench.sender.ms, f"behind {byte!r} it moves for {(pulses[-1] - sent) / bench.sender.ms:.1f} ms")
        said.append(f"{byte!r}: slower after {(slower - sent) / bench.sender.ms:.1f} ms, stands after {(pulses[-1] - sent) / bench.sender.ms:.1f} ms")
        at = bench.counts()
        bench.sender.wait_ms(200)
        check(bench.counts() == at, f"behind {byte!r} it still moves: {bench.sender.report()} {bench.sender.text}")
    return "; ".join(said)


def main():
    tool, image, machine = sys.argv[1:]
    if machine not in EMULATED:
        sys.exit(f"{machine}: board_in_qemu.py does not say how its pins are seen; it knows {', '.join(EMULATED)}")
    if why := EMULATED[machine][1]():
        print(f"SKIPPED: {why}")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(os.path.abspath(tool), image, machine, folder)
        try:
            tests = [tells_its_numbers, travels, reset_at_rest, switched_off, limited, stops, conforms]
            tests += [] if bench.name in SMALL else [streams_points]
            tests += [travels_exactly] if bench.board.kind.exact else []
            for test in [travels, unplugged] if bench.by_usb else tests:
                print(test(bench), flush=True)
        except (BoardFailed, Failed) as problem:
            print(f"{machine}: {problem}")
            return 1
        finally:
            bench.board.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
