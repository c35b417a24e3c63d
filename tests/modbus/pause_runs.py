#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Programs that wait for their user, on a simulated drive: the axes stand at the place of M0, M1 and M6 until the user goes on, by a
signal or by Enter on the terminal, and a run that waits can be ended.

pause_runs.py TOOL"""
import os
import pty
import signal
import subprocess
import sys
import time

from case_runs import run_cases
from drive_processes import Drive, write, write_machine

STEPS = 320
PROGRAM = """G21 G90 G64
G1 X20 F3000
(MSG,a message does not hide the stop)
M0
X40
M1
T3 M6
X60
M2
"""
AXIS = f"max_velocity_mm_s = 100\nmax_acceleration_mm_s2 = 1000\nsteps_per_mm = {STEPS}\n"
WAITS_S = 1.0


class Run:
    """answers: for each question a function of the run, in order."""

    def __init__(self, tool, folder, answers, terminal=False, options=()):
        self.drive = Drive(tool, folder, 0, 1)
        write_machine(folder, [("x", AXIS)], [self.drive], "[path]\nmax_feed_mm_s = 100\n")
        write(folder, "part.ngc", PROGRAM)
        self.keyboard, screen = pty.openpty() if terminal else (None, subprocess.DEVNULL)
        self.process = subprocess.Popen([tool, "run", "part.ngc", "-m", "machine.toml", "--target", "modbus", *options], cwd=folder,
                                        stdin=screen, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        self.questions = []
        self.errors = ""
        for line in self.process.stderr:
            self.errors += line
            if "to go on" in line:
                self.questions.append(line)
                time.sleep(WAITS_S)
                if len(self.questions) <= len(answers):
                    answers[len(self.questions) - 1](self)
        self.status = self.process.wait(timeout=60)
        self.drive.stop()
        self.x = [row[1] / STEPS for row in self.drive.shaft_rows()]

    def go_on(self):
        self.process.send_signal(signal.SIGUSR2)

    def enter(self):
        os.write(self.keyboard, b"\n")

    def end(self):
        self.process.send_signal(signal.SIGTERM)

    def stands_ms(self, mm):
        """Rows of the record are milliseconds."""
        return sum(1 for x in self.x if abs(x - mm) < 0.01)

    def expect(self, status, ends_mm, stands, *questions):
        problems = [] if self.status == status else [f"exit status {self.status}: {self.errors}"]
        if abs(self.x[-1] - ends_mm) > 0.01:
            problems.append(f"it ends at {self.x[-1]:.3f} mm")
        problems += [f"it stands at {mm} mm for {self.stands_ms(mm)} ms" for mm in stands if self.stands_ms(mm) < 900 * WAITS_S]
        if len(questions) != len(self.questions) or any(a not in b for a, b in zip(questions, self.questions)):
            problems.append(f"it asks {self.questions}")
        return problems


def by_signal(tool, folder):
    run = Run(tool, folder, [Run.go_on, Run.go_on])
    return run.expect(0, 60, [20, 40], "line 4: M0; to go on kill -USR2 ", "line 7: M6, change to tool 3; to go on kill -USR2 ")


def optional(tool, folder):
    run = Run(tool, folder, [Run.go_on, Run.go_on, Run.go_on], options=["--optional-stop"])
    return run.expect(0, 60, [20, 40], "line 4: M0;", "line 6: M1;", "line 7: M6, change to tool 3;")


def by_enter(tool, folder):
    run = Run(tool, folder, [Run.enter, Run.enter], terminal=True)
    return run.expect(0, 60, [20, 40], "line 4: M0; to go on press Enter, or kill -USR2 ", "line 7: M6,")


def ended(tool, folder):
    run = Run(tool, folder, [Run.go_on, Run.end])
    return run.expect(1, 40, [20, 40], "line 4: M0;", "line 7: M6,")


def main():
    cases = (by_signal, optional, by_enter, ended)
    return run_cases(os.path.abspath(sys.argv[1]), cases, sys.argv[2:])


if __name__ == "__main__":
    sys.exit(main())
