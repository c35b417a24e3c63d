#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How runs on simulated drives end, and what the state file then says: the truth, or that the place is not known.

run_ends.py TOOL

A row of CASES is a run, what ends it, and the state behind it: "true", where the shafts stand; "old", as before; "unknown". What is
unknown is refused by the next run until --position. No shaft brakes harder than the machine file says, nor moves after the exit."""
import json
import os
import signal
import subprocess
import sys
import tempfile
import time

from drive_processes import Drive, write, write_machine
from real_time import HostWatch

STILL_COUNTS = 0.5  # the shaft of a simulated drive comes to its target ever more slowly
STEPS = 320
LIMIT = 500.0
AXIS = f"max_velocity_mm_s = 80\nmax_acceleration_mm_s2 = {LIMIT:.0f}\nsteps_per_mm = {STEPS}\n"
OLD = 1.5  # where the state says that x and y stand
LONG = "G1 F4800 X400 Y300\n"

# name: profiles, options, input, what is done to (run, drives), exit status, state, words of the message
CASES = {
    "killed": (("", "cia402-index"), "", LONG, "kill", -9, "unknown", ""),
    "a signal": (("", "cia402-index"), "", LONG, "term", 1, "true", "interrupted: all drives were held on the path"),
    "output full": (("", "cia402-index"), "--segments /dev/full", LONG, "", 2, "true",
                    "on another disk; the machine stands at"),
    "trace full": (("",), "--trace /dev/full", "G1 F4800\n" + "X400\nX0\n" * 4, "", 2, "true",
                   "on another disk; the machine stands at"),
    "reader gone": (("",), "--segments -", LONG, "close", 2, "true", "; the machine stands at"),
    "reader asleep": (("",), "--segments -", "G1 F4800\n" + "X400\nX0\n" * 4, "asleep", 1, "true", "reader does not read was given up"),
    "no drive at the set-up": (("",), "", None, "lose", 1, "old", "nothing was moved"),
    "homing interrupted": (("", "cia402-index"), "--home", LONG, "term", 1, "unknown", "is not known"),
    "waypoints": (("",), "", "1.5,1.5\n4.5,5.5\n", "", 0, "true", ""),
}


def start(tool, folder, name, drives, profile, options, text):
    write_machine(folder, [("x", AXIS), ("y", AXIS)], drives, "[path]\nmax_feed_mm_s = 80\n", profile)
    program = "part.csv" if name == "waypoints" else "part.ngc"
    write(folder, program, text or "")
    write(folder, "zero.ngc", "G4 P0.01\n")
    subprocess.run([tool, "run", "zero.ngc", "-m", "machine.toml", "--state", "state.json", "--position", f"{OLD},{OLD}", "--quiet"],
                   cwd=folder, check=True, stdout=subprocess.DEVNULL)
    with open(os.path.join(folder, "state.json"), "r+", encoding="utf-8") as file:
        text_of_drives = file.read().replace('"target": "sim"', '"target": "modbus"')  # a simulation has no drives
        file.seek(0)
        file.write(text_of_drives)
    command = [tool, "run", program if text else "-", "-m", "machine.toml", "--target", "modbus", "--state", "state.json",
               "--quiet", *options.split()]
    if not text:
        command += ["--format", "gcode"]
    return subprocess.Popen(command, cwd=folder, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE)


def act(what, run, drives):
    """Returns what it said."""
    if what == "lose":
        time.sleep(1.0)
        drives[0].process.kill()
        time.sleep(0.2)
        return run.communicate(LONG.encode(), timeout=60)[1].decode()
    if what:
        time.sleep(5.5 if what == "asleep" else 2.0)
    if what == "close":
        run.stdout.close()
        said = run.stderr.read().decode()
        run.wait(timeout=30)
        return said
    if what:
        run.send_signal(signal.SIGKILL if what == "kill" else signal.SIGTERM)
        run.wait(timeout=30)  # nobody reads its output
    return run.communicate(timeout=60)[1].decode()


def hardest(rows, ms):
    """mm/s^2 between stretches of some ms: a record has a row a millisecond, and cyclic drives go from one target to the next."""
    place = [row[1] / STEPS for row in rows]
    v = [(b - a) / ms * 1e3 for a, b in zip(place, place[ms:])]
    return max((abs(b - a) / ms * 1e3 for a, b in zip(v, v[ms:])), default=0.0)


def judge(folder, tool, state, drives, problems):
    with open(os.path.join(folder, "state.json"), encoding="utf-8") as file:
        kept = json.load(file)["position_mm"]
    expected = {"old": [OLD, OLD], "unknown": [None, None]}.get(state)
    if state == "true":
        shafts = [drive.shaft_rows()[-1][1] / STEPS for drive in drives]
        if None in kept or max(abs(a - b) for a, b in zip(kept, shafts)) > 2.0 / STEPS + 1e-4:
            problems.append(f"the shafts stand at {shafts}, and the state says {kept}")
    elif kept != expected:
        problems.append(f"the state says {kept}, not {expected}")
    again = [tool, "plan", "zero.ngc", "-m", "machine.toml", "--state", "state.json", "--quiet"]
    told = subprocess.run(again, cwd=folder, capture_output=True, text=True, check=False)
    if state == "unknown":
        if told.returncode != 2 or "where x, y stand is not known: " not in told.stderr or "--position" not in told.stderr:
            problems.append(f"the next run is not refused: {told.returncode} {told.stderr}")
        told = subprocess.run([*again, "--position", "0,0"], cwd=folder, capture_output=True, text=True, check=False)
    if told.returncode != 0:
        problems.append(f"no next run: {told.stderr}")


def one(tool, name, profile):
    _, options, text, what, status, state, words = CASES[name]
    problems = []
    with tempfile.TemporaryDirectory(prefix="splinefeed-ends-") as folder:
        at = 200_000 if "--home" in options else round(OLD * STEPS)
        drives = [Drive(tool, folder, k, 1, profile=profile, position=at) for k in range(2)]
        run = start(tool, folder, name, drives, profile, options, text)
        said = act(what, run, drives)
        ended = time.monotonic()
        time.sleep(0.6)
        for drive in drives if what != "lose" else drives[1:]:
            problems += drive.stop()
            rows = drive.shaft_rows()
            at_exit = min(range(len(rows)), key=lambda i: abs(drive.start_s() + rows[i][0] - ended - 0.004))
            moved = rows[-1][1] - rows[at_exit][1]
            if what != "kill" and abs(moved) >= STILL_COUNTS:
                problems.append(f"a shaft moved by {moved} counts after the exit")
            most = hardest(rows, 50 if profile else 8)
            if "--home" not in options and what != "kill" and most > 1.5 * LIMIT:
                problems.append(f"a shaft was accelerated by {most:.0f} mm/s^2 of {LIMIT:.0f}")
        if run.returncode != status or words not in said:
            problems.append(f"exit status {run.returncode}: {said}")
        judge(folder, tool, state, drives, problems)
    return [f"{name}, {profile or 'splinefeed-pvt'}: {problem}" for problem in problems]


def judged(tool, name, profile):
    """Once more, twice at most, where this host kept nobody's time: it stood still, or the signal came before the first motion."""
    for left in (2, 1, 0):
        with HostWatch() as watch:
            problems = one(tool, name, profile)
        early = any("before anything was moved" in problem for problem in problems)
        if not problems or left == 0 or not (early or watch.longest_s > 0.01):
            return problems
    return problems


def main():
    tool = os.path.abspath(sys.argv[1])
    chosen = sys.argv[2:] or list(CASES)
    problems = [problem for name in chosen for profile in CASES[name][0] for problem in judged(tool, name, profile)]
    for problem in problems:
        print(problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
