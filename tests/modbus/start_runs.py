#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Where a run begins, however the one before ended, on simulated drives that are processes: a machine that stands elsewhere than its program
begins is moved there or the run is refused, and the guide that continues a program (docs/how-to) does what it says.

start_runs.py TOOL [CASE...]"""
import os
import re
import signal
import subprocess
import sys
import tempfile
import time

from drive_processes import Drive, write, write_machine

STEPS = 320
AXIS = f"max_velocity_mm_s = 100\nmax_acceleration_mm_s2 = 1000\nsteps_per_mm = {STEPS}\n"
HEAD = "[path]\nmax_feed_mm_s = 100\n"
GUIDE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../docs/how-to/resume_after_an_emergency_stop.md")
NEAR_MM = 0.02
KEEPS_HOMED = ("cia402-kinco", "leadshine-pr")


class Machine:
    """Axes x and y, a drive each; problems says what was not as it must be."""

    def __init__(self, tool, folder, profile="", axis=AXIS, **drive):
        self.tool, self.folder, self.profile, self.axis, self.options = tool, folder, profile, axis, drive
        self.problems = []
        self.drives = []
        self.power_on()

    def power_on(self):
        for drive in self.drives:
            self.problems += drive.stop()
        self.drives = [Drive(self.tool, self.folder, k, 1, profile=self.profile, **self.options) for k in range(2)]
        self.describe(self.axis)

    def describe(self, axis):
        ramp = "" if self.profile == "cia402-index" else "&ramp=1.28e6"
        write_machine(self.folder, [("x", axis), ("y", axis)], self.drives, HEAD, self.profile and self.profile + ramp)

    def write(self, name, text):
        write(self.folder, name, text)

    def points(self, name, *xs):
        self.write(name, "x,y,feed\n" + "".join(f"{x},{x / 4},20\n" for x in xs))

    def run(self, arguments, signals=(), status=0, says=""):
        """signals: (seconds, signal) each. Returns what it said."""
        process = subprocess.Popen([self.tool, "run", *arguments.split(), "-m", "machine.toml", "--target", "modbus", "--summary", "json"],
                                   cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        for after_s, number in signals:
            time.sleep(after_s)
            process.send_signal(number)
        error = process.communicate(timeout=60)[1]
        if process.returncode != status or not re.search(says, error):
            self.problems.append(f"run {arguments}: exit status {process.returncode} (expected {status}, '{says}'): {error}")
        return error

    def place(self):
        """Of x, as a further run is told it. [mm]"""
        self.write("far.csv", "x,y\n9000,9000\n9001,9000\n")
        said = re.search(r"stands at x=(\S+)", self.run("far.csv", status=2, says="the program begins at x=9000"))
        return float(said[1]) if said else None

    def expect(self, place_mm, what):
        at = self.place()
        if at is None or abs(at - place_mm) > NEAR_MM:
            self.problems.append(f"{what}: x stands at {at}, not {place_mm}")

    def stop(self):
        for drive in self.drives:
            self.problems += drive.stop()
        return self.problems


STOP = ((1.5, signal.SIGINT),)
STOP_TWICE = ((1.5, signal.SIGINT), (0.02, signal.SIGTERM))


def stopped_pvt(machine):
    machine.points("part.csv", 0, 10, 20, 30, 40)
    machine.points("rest.csv", 20, 30, 40)
    for signals in (STOP, STOP_TWICE):
        machine.run("part.csv --start here --curve polyline", signals, 1, "the machine stands at")
        machine.run("rest.csv", status=2, says=r"the machine stands at x=\S+ y=\S+ mm, and the program begins at x=20.0000 y=5.0000 mm; add "
                                               "--start move, .*--start here")
        machine.run("rest.csv --start move")
        machine.expect(40.0, "--start move")
    machine.run("part.csv", status=2, says="x=40.0000 y=10.0000 mm, and the program begins at x=0.0000 y=0.0000 mm")
    machine.run("part.csv --start here")
    machine.expect(40.0, "--start here")
    machine.run("rest.csv --start move", ((0.7, signal.SIGINT),), 1, "held on the path; the machine stands at x=[23]")


def gcode(machine):
    machine.write("to20.ngc", "G0 X20\nM2\n")
    machine.write("back.ngc", "G0 X5\nM2\n")
    machine.points("on.csv", 20, 40)
    machine.run("to20.ngc --state s.json")
    machine.run("on.csv --start move")
    machine.run("back.ngc --state s.json", status=2, says="stands at x=40.0000 y=10.0000 mm, and the program begins at x=20.0000 y=0.0000 mm")
    machine.run("back.ngc")
    machine.expect(5.0, "G0 without a state")
    machine.run("to20.ngc --position 7,0", status=2, says="the machine stands at x=5.0000 y=10.0000 mm, and the program begins at x=7.0000")
    machine.run("to20.ngc --position 7,0 --start here")
    machine.expect(20.0, "G0 behind --position and --start here")


def powered_anew(machine):
    machine.points("part.csv", 0, 10)
    for _ in range(2):
        machine.run("part.csv", says="nobody knows where x, y stands: the run begins as if it stood where the program does")
        machine.run("part.csv", status=2, says="stands at x=10.0000")
        machine.power_on()
    machine.run("part.csv --start move", status=2, says="--start move: nobody knows where x, y stands; add --home")
    machine.run("part.csv --home", ((3.0, signal.SIGINT),), 1, "homing")
    machine.run("part.csv --start move", status=2, says="nobody knows where x, y stands")


def homed(machine):
    machine.points("part.csv", 5, 10)
    machine.run("part.csv --home")
    if machine.profile and machine.profile not in KEEPS_HOMED:
        machine.run("part.csv", says="nobody knows where x, y stands")
    else:
        machine.expect(10.0, "--home goes to where the program begins")
        machine.run("part.csv", status=2, says="x=10.0000 y=2.5000 mm, and the program begins at x=5.0000 y=1.2500")
        machine.run("part.csv --start move")
        machine.expect(10.0, "--start move")


def guide(machine):
    """The blocks of the guide, in order, behind a run that a drive's fault ended."""
    machine.write("fast.csv", "x,y,feed\n0,0,90\n40,0,90\n")
    machine.run("fast.csv", status=1, says="it is in fault, code 3 on axis x: .*--reset")
    machine.describe(AXIS.replace("= 100", "= 50"))  # the cause is removed
    with open(GUIDE, encoding="utf-8") as file:
        blocks = re.findall(r"```sh\n(.*?)```", file.read(), re.S)
    os.symlink(machine.tool, os.path.join(machine.folder, "splinefeed"))
    environment = {**os.environ, "PATH": machine.folder + ":" + os.environ["PATH"]}
    for block in blocks:
        if "--start move" in block:
            machine.run("part.csv --start move", STOP, 1, "held on the path")
        if "--reset" in block:
            machine.run("rest.csv", status=1, says="it is in fault, code 3 on axis x: .*--reset")
        done = subprocess.run(["sh", "-e", "-c", block], cwd=machine.folder, env=environment, capture_output=True, text=True, timeout=60,
                              check=False)
        if done.returncode != 0:
            machine.problems.append(f"{block}: {done.stderr}")
    machine.expect(40.0, "the guide's last run")
    if len(blocks) != 3:
        machine.problems.append("the guide has other blocks than this test knows")


# name: what is done, and options of the Machine
CASES = {
    "stopped_pvt": (stopped_pvt, {}),
    "gcode": (gcode, {}),
    "powered_anew": (powered_anew, {"position": 40000000}),
    "guide": (guide, {"extra": ("--max-velocity", str(60 * STEPS))}),
}
for NAME in ("", "cia402-index", "cia402-kinco", "leadshine-pr", "oriental-az"):
    CASES[f"homed {NAME or 'splinefeed-pvt'}"] = (homed, {"profile": NAME, "position": 2000})


def main():
    tool = os.path.abspath(sys.argv[1])
    problems = []
    for name in sys.argv[2:] or CASES:
        with tempfile.TemporaryDirectory(prefix="splinefeed-start-") as folder:
            act, options = CASES[name]
            machine = Machine(tool, folder, **options)
            act(machine)
            problems += [f"{name}: {problem}" for problem in machine.stop()]
    for problem in problems:
        print(problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
