#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Programs that wait for inputs (M66) and switch coils of an I/O module that is not ours (module_server.py, on pymodbus), with a simulated
drive for the axes: the machine stands until the input answers, what follows is read with the answer, and whatever ends a run makes
the coils safe.

input_runs.py TOOL [CASE...]

Exit status 77: skipped, with the reason (no pymodbus)."""
import os
import signal
import sys
import time

from case_runs import pymodbus_missing, run_cases
from peer_runs import Peer, PeerRun

WAITS_MM = 20.0  # where the first M66 is
FLOOD, LAMP, CLAMP = 0, 1, 2  # coils; the clamp is safe when it is on
PART, DOOR = 2, 3  # inputs of the module, P of M66, too
PROGRAM = """G21 G90 G61
M8
G1 X10 F3000
M62 P1
X20
M66 P2 L3 Q20
X[20+10*#5399]
M63 P1
M66 P2 L4 Q0.5
Y[5*#5399]
M66 P2 L0
O1 if [#5399 EQ 1]
X50
O1 endif
M9
M66 P3 L1 Q20
M66 P3 L2 Q20
M30
"""
MACHINE = """[path]
max_feed_mm_s = 100
[[module]]
name = "io"
address = "{module}"
[coolant]
flood = {{ module = "io", coil = 0 }}
[[output]]
number = 1
module = "io"
coil = 1
[[output]]
number = 2
module = "io"
coil = {clamp}
safe = "on"
[[input]]
number = 2
module = "io"
input = 2
[[input]]
number = 3
module = "io"
input = 3
"""
class Module(Peer):
    def __init__(self, folder):
        self.record, self.inputs = os.path.join(folder, "coils.csv"), os.path.join(folder, "inputs")
        super().__init__("module_server.py", "--inputs", self.inputs, "--record", self.record)
        self.address += "?unit=1"

    def turn(self, *on):
        """These inputs are on, and no others. Written aside: it is read at any time."""
        with open(self.inputs + ".new", "w", encoding="ascii") as file:
            file.write(" ".join(str(number) for number in on))
        os.replace(self.inputs + ".new", self.inputs)

    def rows(self):
        """[instant, coil 0, coil 1, ...]"""
        with open(self.record, encoding="ascii") as file:
            return [[float(x) for x in row.split(",")] for row in file if row.endswith("\n")]

    def coils(self):
        rows = self.rows()
        return rows[-1][1:4] if rows else []


class Run(PeerRun):
    """One run of the program. wait: what is done while it waits for its first input, a function of the run."""

    def __init__(self, tool, folder, wait=None, program=PROGRAM, clamp=CLAMP):
        module = Module(folder)
        super().__init__(tool, folder, module, MACHINE.format(module=module.address, clamp=clamp), program, wait)
        self.coils = module.coils()

    def due(self):
        """The lamp is on at x = 10 mm: a second later the machine stands."""
        while self.peer.coils()[1:2] != [1.0]:
            time.sleep(0.02)
        time.sleep(1.0)

    def turn(self, *on):
        self.times.append(time.monotonic())
        self.peer.turn(*on)

    # What is wrong

    def safe_at_end(self):
        return [] if self.coils == [0.0, 0.0, 1.0] else [f"in the end the coils are {self.coils}"]

    def ends_at(self, x_mm, y_mm):
        last = self.axes[-1]
        return [] if abs(last[1] - x_mm) + abs(last[2] - y_mm) < 0.01 else [f"it ends at {last}"]

    def waits_until(self, instant):
        """Before it, nothing goes beyond the place of the first M66."""
        return [f"at {row[0] - instant:.3f} s before the input it is at x = {row[1]:.3f} mm" for row in self.axes
                if row[0] < instant and row[1] > WAITS_MM + 0.01][:1]

    def did_not_move(self):
        return ["the axes moved"] if any(abs(row[1]) + abs(row[2]) > 1e-6 for row in self.axes) else []


def whole(tool, folder):
    """The input rises; another wait is timed out; a condition and a place depend on the answers; the last waits end the program."""
    def inputs(run):
        run.turn(PART)
        time.sleep(3.5)
        run.turn(PART, DOOR)
        time.sleep(1.0)
        run.turn(PART)
    run = Run(tool, folder, inputs)
    problems = run.expect(0) + run.safe_at_end() + run.ends_at(50, -5) + run.waits_until(run.times[0])
    if len(run.times) < 3 or run.ended < run.times[-1]:
        problems.append("it did not wait for the last input")
    lamp = [row[0] for row in run.peer.rows() if row[2]]
    if not lamp or not any(abs(row[1] - 10) < 1.5 for row in run.axes if abs(row[0] - lamp[0]) < 0.002):
        problems.append("the lamp was not switched at x = 10 mm")
    return problems


def held(tool, folder):
    """A feed hold while it waits: the answer comes, and nothing moves before the user goes on."""
    def hold(run):
        run.process.send_signal(signal.SIGUSR1)
        time.sleep(0.3)
        run.peer.turn(PART)
        time.sleep(1.0)
        run.turn(PART)
        run.process.send_signal(signal.SIGUSR2)
        time.sleep(3.5)
        run.peer.turn(PART, DOOR)
        time.sleep(1.0)
        run.peer.turn()
    run = Run(tool, folder, hold)
    return run.expect(0) + run.safe_at_end() + run.ends_at(50, -5) + run.waits_until(run.times[0])


def prompt(run):
    took_s, late_s = run.ended - run.times[0], run.host.longest_s
    if took_s >= 2.0 and late_s >= 0.05:
        print(f"not judged: it ended {took_s:.1f} s after the signal; this host stood still for {1000 * late_s:.0f} ms")
        return []
    return [] if took_s < 2.0 else [f"it ended {took_s:.1f} s after the signal"]


def interrupted(tool, folder):
    run = Run(tool, folder, lambda run: run.tell(signal.SIGINT))
    return run.expect(1, "all drives were held on the path") + run.safe_at_end() + run.ends_at(WAITS_MM, 0) + prompt(run)


def twice(tool, folder):
    def stop(run):
        run.tell(signal.SIGTERM)
        time.sleep(0.02)
        run.process.send_signal(signal.SIGTERM)
    run = Run(tool, folder, stop)
    return run.expect(1, "interrupted") + run.safe_at_end() + run.ends_at(WAITS_MM, 0) + prompt(run)


def lost(tool, folder):
    """The module is gone while the program waits for it."""
    run = Run(tool, folder, lambda run: run.peer.process.kill())
    return (run.expect(1, "its module does not answer", "all drives were held on the path", "did not confirm its last level") +
            run.ends_at(WAITS_MM, 0))


def cut(tool, folder):
    """The module is gone while the machine moves: a feed hold."""
    run = Run(tool, folder, lambda run: run.peer.process.kill(), "G21 G90 G61\nM62 P1\nG1 X300 F1200\nM63 P1\nM30\n")
    problems = run.expect(1, "its module does not answer", "all drives were held on the path")
    return problems + ([] if 20 < run.axes[-1][1] < 100 else [f"it ends at {run.axes[-1]}"])


def missing_input(tool, folder):
    run = Run(tool, folder, program="G1 X10 F1200\nM66 P2 L3 Q1\nX20\nM66 P9 L3 Q1\nM30\n")
    return run.expect(2, "part.ngc:4", "the machine file has no input 9; name its line in [[input]] with number = 9") + run.did_not_move()


def analog(tool, folder):
    run = Run(tool, folder, program="G1 X10 F1200\nM66 E0 L0\nM30\n")
    return run.expect(2, "part.ngc:2", "M66 E reads an analog input") + run.did_not_move()


def missing_coil(tool, folder):
    run = Run(tool, folder, clamp=8)
    return run.expect(1, "output 2 (coil 8 of module io", "illegal address") + run.did_not_move()


def endless(tool, folder):
    """A program without an end, until an input says so: what is read before the run does not hang. It has no move behind its stops."""
    run = Run(tool, folder, lambda run: run.turn(PART),
              "M62 P1\nM66 P2 L0\nO1 while [#5399 EQ 0]\nM66 P2 L0\nO1 endwhile\nM63 P1\nM66 P2 L4 Q0.2\nM66 P3 L4 Q1\n")
    return run.expect(0) + run.safe_at_end() + run.did_not_move()


def main():
    cases = (whole, held, interrupted, twice, lost, cut, missing_input, analog, missing_coil, endless)
    return run_cases(os.path.abspath(sys.argv[1]), cases, sys.argv[2:], pymodbus_missing())


if __name__ == "__main__":
    sys.exit(main())
