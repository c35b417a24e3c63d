#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The reference firmware on an emulated board, by its serial line: firmware_run.py TOOL IMAGE BOARD

What its pins did is compared with the edges that the tool writes for the same waypoints and the same machine. Time is the
emulator's: how fast the host is decides only whether the machine waits for a line that comes late. SPLINEFEED_LONG=1 adds a noisy
helix of 2000 waypoints and ten runs of one program."""
import functools
import hashlib
import operator
import os
import re
import sys
import tempfile
import time

from board_in_qemu import Board, BoardFailed, ENABLE, ESTOP, KINDS, LIMIT, STEP, WAIT_S, plugins_refused
from planned import (AXES, LINES, STEPS_PER_MM, Plan, arc, check, counts_after, counts_at, noisy_helix, of_axis, spiral, steps_of,
                     waypoints)


class Bench:
    def __init__(self, tool, image, machine, folder):
        self.tool, self.folder = tool, folder
        self.board = Board(image, folder, machine)
        self.board.wait_for(r"\[boot " + image.rsplit("firmware_", 1)[1].removesuffix(".elf") + "]")
        self.changes, self.up = [], [0, 0, 0]  # since the last program, and the directions then

    def stands_at(self):
        state, position, _ = self.board.status()
        return state, tuple(round(v * s) for v, s in zip(position, STEPS_PER_MM))

    def levels(self):
        """Every change since the last new_steps()."""
        self.changes += self.board.pin_levels()
        return self.changes

    def steps_so_far(self):
        steps, self.next_up = steps_of([(*LINES[change.pin], change.level) for change in self.levels() if change.pin in LINES], self.up)
        return steps

    def new_steps(self):
        steps = self.steps_so_far()
        self.up, self.changes = self.next_up, []
        return steps

    def plan(self, rows):
        return Plan(self.tool, self.folder, rows, self.board.kind)

    def begin(self, rows):
        self.new_steps()
        self.board.command("at " + ",".join(rows[0].split(",")[:3]))

    def event(self, name):
        return self.board.wait_for(rf"\[{name}[ \]]")[0]

    def finished_as(self, plan, what):
        """The pins did what was planned, and the board knows it."""
        _, between = self.board.wait_for(r"\[done ", f"the end of {what}")
        steps = self.new_steps()
        counts = counts_after(plan.start, steps)
        check(counts == plan.end, f"{what}: steps to {counts}, planned were {plan.end}")
        check(self.stands_at() == ("idle", plan.end), f"{what}: the board says {self.stands_at()}")
        for axis in range(3):
            check(of_axis(axis, steps) == of_axis(axis, plan.steps), f"{what}: other steps of {AXES[axis]}")
        return between


def acknowledged(bench, rows, what):
    """A program, line by line, each after the answer to the one before. On a busy host a line may come so late that the machine has to
    wait for it, and says so; in_time() and cost_run.py show that the planner keeps up."""
    bench.begin(rows)
    for row in rows + ["end"]:
        bench.board.command(row)
    plan = bench.plan(rows)
    between = bench.finished_as(plan, what)
    others = [line for line in between if line.startswith("[") and not re.match(r"\[(underrun|late) ", line)]
    check(not others, f"{what}: {others}")
    bench.board.command("0,0,0", "error: .*stands")  # not where the machine is
    return f"{what}: {len(rows)} waypoints, {len(plan.steps)} steps, as planned"


def first_program(bench):
    """A short one, when all directions are down: its plan, and what the pins did."""
    rows = arc()
    bench.begin(rows)
    for row in rows + ["end"]:
        bench.board.command(row)
    bench.board.wait_for(r"\[done ")
    changes = [change for change in bench.levels() if change.pin in LINES]
    bench.new_steps()
    return bench.plan(rows), changes


def lateness(changes):
    """By how much edges are away from evenly spaced ticks, and what these last. QEMU's are short: 20 ppm on the STM32F405, where a
    clock lasts whole nanoseconds, 400 ppm on the LM3S6965, whose timer counts one clock less."""
    first, last = changes[0], changes[-1]
    period = (last.ns - first.ns) / (last.tick - first.tick)
    return max(abs(change.ns - first.ns - (change.tick - first.tick) * period) for change in changes), period


def in_time(bench):
    """Each edge in the tick that the tool planned, and the ticks evenly in the machine's time."""
    plan, changes = first_program(bench)
    tick_ns = bench.board.kind.tick_ns
    begin = changes[0].tick * tick_ns - plan.edges[0][0]
    edges = sorted((change.tick * tick_ns - begin, *LINES[change.pin], change.level) for change in changes)
    wrong = [pair for pair in zip(edges, plan.edges) if pair[0] != pair[1]]
    check(len(edges) == len(plan.edges) and not wrong, f"{len(edges)} edges, planned {len(plan.edges)}; {len(wrong)} others than planned: {wrong[:3]}")
    late_ns, period_ns = lateness(changes)
    check(abs(period_ns / tick_ns - 1) < 1e-3 and late_ns < tick_ns / 20, f"ticks of {period_ns:.1f} ns, edges up to {late_ns:.0f} ns off")
    return f"{len(edges)} edges, each in its tick of {period_ns:.1f} ns, at most {late_ns:.0f} ns off"


def repeated(tool, image, machine):
    """New machines make the same edges at the same times, in ticks from the first: bytes of the host come at other times in each run, and
    shift an interrupt by an instruction."""
    logs = set()
    for _ in range(10):
        with tempfile.TemporaryDirectory() as folder:
            bench = Bench(tool, image, machine, folder)
            try:
                _, changes = first_program(bench)
            finally:
                bench.board.close()
        text = "".join(f"{change.tick - changes[0].tick} {change.pin} {change.level}\n" for change in changes)
        logs.add(hashlib.md5(text.encode()).hexdigest())
    check(len(logs) == 1, f"ten runs, {len(logs)} logs")
    return f"ten runs, the same {len(changes)} edges in the same ticks: {logs.pop()}"


def flooded(bench, obey_xoff):
    rows = spiral()[100:]
    bench.begin(rows)
    bench.board.command(rows[0])
    if obey_xoff:
        bench.board.send("!")
    bench.board.flood(rows[1:] + ["end"], obey_xoff)
    plan = bench.plan(rows)
    between = bench.finished_as(plan, "the spiral")
    check(between.count("ok") == len(rows), f"{between.count('ok')} answers to {len(rows)} lines: {between[-5:]}")
    return f"{len(rows)} lines without waiting, XOFF {'obeyed' if obey_xoff else 'ignored'}, all steps"


def starved(bench):
    """A part of the path, at once, so that a busy host is not the reason; then nothing, and then the rest."""
    rows = waypoints("examples/path61.csv")[:30]
    bench.begin(rows)
    bench.board.flood(rows[:22], obey_xoff=False)
    bench.event("underrun")
    state, at = bench.stands_at()
    check(state == "waiting", f"after the under-run the board is {state}")
    before = counts_after(counts_at(rows[0]), bench.steps_so_far())
    check(before == at, f"in the under-run the board made steps to {before} and says {at}")
    for row in rows[22:] + ["end"]:
        bench.board.command(row)
    bench.finished_as(bench.plan(rows), "path61 with an under-run")
    return f"under-run: stood at {at}, then all steps"


SENT = 30  # waypoints: no more than a board takes before it moves
MOVED = 500  # steps


def under_way(bench, rows):
    """A slow program, halted on its way. All of its waypoints are known before it moves, however slowly a busy host brings them."""
    bench.begin(rows)
    board = bench.board
    board.command("feed 40")
    board.command(rows[0])
    board.send("!")
    for row in rows[1:SENT]:
        board.command(row)
    bench.levels()
    board.halt_after(2 * MOVED)
    board.uart.sendall(b"~")
    end = time.monotonic() + WAIT_S
    while not board.halted():
        check(time.monotonic() < end, f"it does not move, but says {board.lines[-3:]}")
        board.take(0.01)
    board.lines = []


def switched_off(bench):
    """The emergency stop: the tick that reads it disables the drives, and no pulse begins in it or later; nothing moves until reset, and
    the position is known."""
    rows = waypoints("examples/path61.csv")
    start = counts_at(rows[0])
    under_way(bench, rows)
    bench.board.press(ESTOP, True)
    bench.event("estop")
    levels = bench.levels()
    tick, = [change.tick for change in levels if change.pin == ESTOP]
    off = [change.tick for change in levels if change.pin == ENABLE and not change.level]
    check(off == [tick], f"the drives are disabled in ticks {off}, the emergency stop was read in {tick}")
    pulses = [change for change in levels if change.pin in STEP and change.level and change.tick >= tick]
    check(not pulses, f"pulses began after tick {tick}, in which the emergency stop was read: {pulses[:3]}")
    steps = bench.new_steps()
    bench.board.command(rows[SENT], "error: .*reset")
    stopped_ms = bench.board.status()[2]
    while bench.board.status()[2] < stopped_ms + 500:
        pass
    check(not bench.new_steps(), "it moved after the emergency stop")
    check(bench.stands_at() == ("estop", counts_after(start, steps)), f"the board says {bench.stands_at()}")
    bench.board.press(ESTOP, False)
    bench.board.command("reset")
    state, at = bench.stands_at()
    check(state == "idle", f"after reset the board is {state}")

    home = [f"{at[0] / 80:.6f},{at[1] / 80:.6f},{at[2] / 400:.6f}", "50,70,0", rows[0]]
    for row in home:
        bench.board.command(row)
    bench.board.command("end")
    _, _ = bench.board.wait_for(r"\[done ")
    check(bench.stands_at()[1] == start, "it does not come back")
    return f"e-stop at {at}, and back without a lost step"


def limited(bench):
    """A limit switch: the machine slows down along the path, and stands; it may move off the switch."""
    rows = waypoints("examples/path61.csv")
    start = counts_at(rows[0])
    under_way(bench, rows)
    before = len(bench.steps_so_far())
    bench.board.press(LIMIT, True)
    bench.event("limit")
    steps = bench.new_steps()
    check(len(steps) > before + 10, "it did not slow down, but stopped at once")
    state, at = bench.stands_at()
    check((state, at) == ("limit", counts_after(start, steps)), f"the board says {state} {at}")
    # On the path: the steps are those of the plan, as far as it went.
    plan = bench.plan(rows)
    for axis in range(3):
        here = of_axis(axis, steps)
        check(here == of_axis(axis, plan.steps)[:len(here)], f"left the path on {AXES[axis]}")
    bench.board.command("reset")
    for row in (f"{at[0] / 80:.6f},{at[1] / 80:.6f},{at[2] / 400:.6f}", rows[0]):
        bench.board.command(row)
    bench.board.command("end")
    bench.board.press(LIMIT, False)  # the motion has left it; one that stays pressed ends it again
    bench.event("done")
    return f"limit switch at {at}, on the path, and off the switch"


def summed(line):
    """With its checksum."""
    return f"{line}*{functools.reduce(operator.xor, line.encode()):02x}"


def steered(bench):
    """Hold, resume, override, abort; lines that are wrong."""
    rows = waypoints("examples/path61.csv")
    under_way(bench, rows)
    bench.board.send("!")
    bench.event("held")
    check(bench.stands_at()[0] == "waiting", "it does not wait after a hold")
    bench.board.command("feed 120")
    bench.board.send("~")
    whole = rows[:SENT + 4]
    for row in whole[SENT:] + ["end"]:
        bench.board.command(row)
    bench.finished_as(bench.plan(whole), "path61, held and faster")
    bench.board.command("feed 100")

    under_way(bench, rows)
    bench.board.command("12,13", "error: a waypoint is")
    bench.event("held")
    bench.board.command(rows[SENT], "error: the program is broken")
    # The rest of the file that was under way: nothing of it becomes another program.
    bench.board.send("".join(row + "\n" for row in rows[SENT + 1:SENT + 4]) + rows[SENT + 4] + "\x18")
    bench.event("aborted")
    bench.board.command(rows[0], "error: the machine stands elsewhere")
    bench.board.send("\x18")
    bench.event("aborted")
    for line, answer in {"": "ok", "# comment": "ok", "x,y,z": "ok", "jump": "error: known are", "feed 201": "error: feed",
                         "1" * 101: "error: a line has", "reset": "error: reset is", "end": "error: ",
                         summed("at 1,2,3"): "ok", "at 1,2,4" + summed("at 1,2,3")[-3:]: "error: the checksum"}.items():
        bench.board.command(line, answer)
    check(bench.stands_at() == ("idle", (80, 160, 1200)), f"after at 1,2,3 it stands at {bench.stands_at()}")
    return "hold, resume, override, abort, wrong lines"


def bitten(bench):
    """The main loop hangs: the watchdog resets, and nothing moves any more. A host cannot do that to a moving board."""
    under_way(bench, waypoints("examples/path61.csv"))
    bench.board.command("stall", "error: stall is")
    bench.board.send("!")
    bench.event("held")
    bench.board.command("stall")
    bench.board.wait_for(r"\[boot ")
    bench.new_steps()
    bench.board.command("memory")
    check(not bench.new_steps(), "it moved after the reset")
    return "watchdog"


def main():
    tool, image, machine = sys.argv[1:]
    if machine not in KINDS:
        sys.exit(f"{machine}: board_in_qemu.py does not say how its pins are seen; it knows {', '.join(KINDS)}")
    if refused := plugins_refused():
        print(f"SKIPPED: {refused}")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(tool, image, machine, folder)
        try:
            print(in_time(bench))
            print(acknowledged(bench, waypoints("examples/path61.csv"), "path61"))
            print(flooded(bench, obey_xoff=True))
            print(flooded(bench, obey_xoff=False))
            print(starved(bench))
            print(switched_off(bench))
            print(limited(bench))
            print(steered(bench))
            if os.environ.get("SPLINEFEED_LONG") == "1":
                print(acknowledged(bench, noisy_helix(2000), "noisy helix"))
                print(repeated(tool, image, machine))
            bench.board.send("memory\n")
            print(bench.board.wait_for(r"\[stack ")[0])
            print(bitten(bench) if bench.board.kind.watchdog else "QEMU has no watchdog for this board")
        except BoardFailed as problem:
            print(f"{machine}: {problem}")
            return 1
        finally:
            bench.board.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
