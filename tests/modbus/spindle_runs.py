#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Programs with a spindle behind a frequency inverter that is not ours (vfd_server.py, on pymodbus), and a simulated drive for the axes:
nothing is cut before the spindle has its speed, a feed hold keeps it, and whatever ends a run ends the spindle for good.

spindle_runs.py TOOL

Exit status 77: skipped, with the reason (no pymodbus)."""
import os
import signal
import subprocess
import sys
import time

from case_runs import pymodbus_missing, run_cases
from drive_processes import Drive
from peer_runs import RUN, Peer, PeerRun, write_peer_machine

SLOW_HZ, FAST_HZ = 200.0, 300.0  # S12000 and S18000 at 60 rpm a Hz
BEGIN_MM, CHANGE_MM, END_MM = 10.0, 40.0, 60.0
PROGRAM = """G21 G90 G61
G0 X10 Y0
S12000 M3
G1 X20 Y5 F600
X40 Y-3
S18000
X60
M5
G0 Y10
M30
"""
MACHINE = """[path]
max_feed_mm_s = 100
[spindle]
max_rpm = 24000
at_speed_timeout_s = {timeout}
vfd = "{vfd}?profile=vfd-delta-ms300"
"""
class Vfd(Peer):
    def __init__(self, folder, ramp_hz_s):
        self.trace = os.path.join(folder, "vfd.csv")
        super().__init__("vfd_server.py", "--ramp", str(ramp_hz_s), "--record", self.trace)

    def rows(self):
        """[instant, output in Hz, direction it was told]"""
        with open(self.trace, encoding="ascii") as file:
            return [[float(x) for x in row.split(",")] for row in file if row.count(",") == 2 and row.endswith("\n")]


class Run(PeerRun):
    """One run of the program. cut: what is done to it on the first part of the cut, a function of the run."""

    def __init__(self, tool, folder, cut=None, ramp_hz_s=400.0, timeout_s=10.0, faults=""):
        vfd = Vfd(folder, ramp_hz_s)
        self.head = MACHINE.format(vfd=vfd.address, timeout=timeout_s)
        super().__init__(tool, folder, vfd, self.head, PROGRAM, cut, faults)
        self.spindle = vfd.rows()

    def due(self):
        """What the drives have to execute while the spindle comes to its speed takes less than half a second."""
        while not any(row[1] > 0.99 * SLOW_HZ for row in self.peer.rows()[-1:]):
            time.sleep(0.02)
        time.sleep(1.2)

    # What is wrong

    def cuts_too_early(self):
        """The axes move where the program cuts, and the spindle has not the speed of that place."""
        problems, j = [], 0
        for before, after in zip(self.axes, self.axes[1:]):
            cutting = BEGIN_MM + 0.01 < after[1] < END_MM - 0.01
            if not cutting or abs(after[1] - before[1]) + abs(after[2] - before[2]) < 1e-4:
                continue
            while j + 1 < len(self.spindle) and self.spindle[j + 1][0] < after[0]:
                j += 1
            wanted = SLOW_HZ if after[1] < CHANGE_MM - 0.01 else FAST_HZ if after[1] > CHANGE_MM + 0.01 else SLOW_HZ
            if self.spindle[j][1] < 0.97 * wanted:
                problems.append(f"at x = {after[1]:.3f} mm the spindle has {self.spindle[j][1]:.1f} Hz, not {wanted}")
        return problems[:3]

    def turns(self):
        """Spans in which the inverter was told to turn."""
        told = [row[2] != 0 for row in self.spindle]
        return sum(1 for a, b in zip([False] + told, told) if b and not a)

    def ends_for_good(self):
        """It was told to turn once, and in the end not any more."""
        problems = [] if self.turns() == 1 else [f"the spindle was started {self.turns()} times"]
        return problems + ([] if self.spindle[-1][2] == 0 else ["the spindle is still told to turn"])

    def stops_between(self, low_mm, high_mm):
        worst = max(row[1] for row in self.axes)
        return [] if low_mm <= worst <= high_mm else [f"the machine stops at x = {worst:.3f} mm"]

    def stops_in_the_cut(self):
        return self.stops_between(BEGIN_MM + 1, CHANGE_MM - 1)


def whole(tool, folder):
    run = Run(tool, folder)
    at_end = run.axes[-1]
    problems = run.expect(0) + run.cuts_too_early() + run.ends_for_good()
    if abs(at_end[1] - END_MM) + abs(at_end[2] - 10) > 0.01:
        problems.append(f"it ends at {at_end}")
    return problems + ([] if abs(max(row[1] for row in run.spindle) - FAST_HZ) < 0.1 else ["it never had its speed"])


def held(tool, folder):
    """The feed is held on the way: the spindle goes on."""
    def hold(run):
        run.tell(signal.SIGUSR1)
        time.sleep(1.5)
        run.tell(signal.SIGUSR2)
    run = Run(tool, folder, hold)
    still = [b[0] for a, b in zip(run.axes, run.axes[1:]) if BEGIN_MM + 0.5 < b[1] < END_MM - 0.5 and
             abs(a[1] - b[1]) + abs(a[2] - b[2]) < 1e-6 and abs(b[1] - CHANGE_MM) > 0.5]
    problems = run.expect(0) + run.cuts_too_early() + run.ends_for_good()
    if len(still) < 500:
        problems.append("the feed was not held")
    return problems + [f"in the hold the spindle has {hz} Hz" for t, hz, _ in run.spindle
                       if still and still[0] < t < still[-1] and hz < 0.97 * SLOW_HZ][:1]


def interrupted(tool, folder):
    run = Run(tool, folder, lambda run: run.tell(signal.SIGTERM))
    return (run.expect(1, "all drives were held on the path") + run.cuts_too_early() + run.ends_for_good() +
            run.stops_in_the_cut())


def twice(tool, folder):
    def both(run):
        run.tell(signal.SIGTERM)
        time.sleep(0.05)
        run.tell(signal.SIGTERM)
    run = Run(tool, folder, both)
    return run.expect(1, "interrupted twice") + run.ends_for_good() + run.stops_in_the_cut()


def drive_fault(tool, folder):
    """The drive of the axes loses its power: the spindle is off at once."""
    run = Run(tool, folder, faults="power-cycle@3.5")
    return run.expect(1) + run.ends_for_good() + run.stops_in_the_cut()


def lost(tool, folder):
    """The inverter is gone while it turns: a feed hold, and nobody knows what the spindle does."""
    run = Run(tool, folder, lambda run: run.peer.process.kill())
    return (run.expect(1, "the VFD does not answer", "all drives were held on the path",
                       "the spindle did not confirm that it stands and may still turn") + run.stops_in_the_cut())


def silent(tool, folder):
    """The inverter does not answer for 2 s, and then again: the spindle is stopped, and not started again."""
    def pause(run):
        run.peer.process.send_signal(signal.SIGSTOP)
        time.sleep(2.0)
        run.peer.process.send_signal(signal.SIGCONT)
    run = Run(tool, folder, pause)
    return run.expect(1, "the VFD does not answer") + run.ends_for_good() + run.stops_in_the_cut()


def too_slow(tool, folder):
    run = Run(tool, folder, ramp_hz_s=50.0, timeout_s=1.5)
    return (run.expect(1, "the spindle has not reached its speed in") + run.ends_for_good() + run.stops_between(BEGIN_MM - 0.01, BEGIN_MM + 0.01))


def absent(tool, folder):
    """Nobody answers where the inverter should be: nothing moves."""
    run = Run(tool, folder)
    again = Drive(tool, folder, 1, 2)
    write_peer_machine(folder, run.head, again)
    called = subprocess.run([tool, *RUN], cwd=folder, capture_output=True, text=True, timeout=60, check=False)
    again.stop()
    problems = [] if called.returncode == 1 else [f"exit status {called.returncode}: {called.stderr}"]
    if run.peer.address not in called.stderr:
        problems.append(f"it does not name the inverter: {called.stderr}")
    if any(abs(row[1]) + abs(row[2]) > 1e-6 for row in again.shaft_rows()):
        problems.append("the axes moved")
    return problems


def main():
    cases = (whole, held, interrupted, twice, drive_fault, lost, silent, too_slow, absent)
    return run_cases(os.path.abspath(sys.argv[1]), cases, sys.argv[2:], pymodbus_missing())


if __name__ == "__main__":
    sys.exit(main())
