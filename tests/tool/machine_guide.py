#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""From another controller's file and a program of a CAM system to a plan: machine_guide.py TOOL.

The guide is asked at a pseudo terminal, as people see it; a second reader, in this file, follows the programs of --try."""
import json
import os
import pathlib
import pty
import re
import select
import subprocess
import sys
import tempfile
import time
import tomllib

TOOL = str(pathlib.Path(sys.argv[1]).resolve())
HERE = pathlib.Path(__file__).resolve().parent
SOURCES = HERE.parent / "convert"
SETTINGS = "".join(f"${key}={value}\n" for key, value in {
    100: 250, 101: 250, 102: 400, 110: 8000, 111: 8000, 112: 2000, 120: 500, 121: 500, 122: 200, 130: 780, 131: 790, 132: 80, 20: 1}.items())
failures = []


def check(holds, what):
    if not holds:
        failures.append(what)
        print(f"wrong: {what}")


def run(folder, *words, status=0, **more):
    done = subprocess.run([TOOL, *words], cwd=folder, capture_output=True, text=True, timeout=60, stdin=subprocess.DEVNULL, check=False, **more)
    check(done.returncode == status, f"{' '.join(words)}: status {done.returncode}: {done.stdout[:300]}{done.stderr[:300]}")
    return done


def at_terminal(folder, words, answers):
    """What a person sees who types one answer for each question; None: Ctrl-D."""
    child, terminal = pty.fork()
    if child == 0:
        os.chdir(folder)
        os.execv(TOOL, [TOOL, *words])
    seen, left, end = "", list(answers), time.monotonic() + 60
    asked = 0
    while time.monotonic() < end:
        if select.select([terminal], [], [], 0.2)[0]:
            try:
                piece = os.read(terminal, 4096).decode()
            except OSError:
                break
            if not piece:
                break
            seen += piece
        if seen.count("(Enter: ") > asked and seen.endswith(") ") and left:
            asked = seen.count("(Enter: ")
            answer = left.pop(0)
            os.write(terminal, b"\x04" if answer is None else answer.encode() + b"\n")
    _, status = os.waitpid(child, 0)
    os.close(terminal)
    return seen, os.waitstatus_to_exitcode(status), left


def a_cam_file_on_a_grbl_machine(folder):
    """One question: where the part's zero is."""
    (folder / "settings.txt").write_text(SETTINGS)
    run(folder, "machine", "settings.txt", "-o", "router.toml")
    part = str(HERE / "posts/fusion_grbl.nc")
    said = run(folder, "check", part, "--dialect", "grbl", "-m", "router.toml", status=1).stdout
    check("\n1 problem\n" in said, f"a CAM file on grbl's machine: {said}")
    example = re.search(r"add (--zero=\S+)", said)
    check(example is not None, f"no example of --zero: {said}")
    for command in ("check", "plan", "run"):
        run(folder, command, part, "--dialect", "grbl", "-m", "router.toml", example[1])
    summary = json.loads(run(folder, "plan", part, "--dialect", "grbl", "-m", "router.toml", example[1], "--summary", "json").stdout)
    check(summary["travel_mm"]["x"] == [-780, 0] and summary["zero_mm"]["z"] < 0, f"the summary: {summary}")


def the_guide(folder):
    (folder / "m503.txt").write_text((SOURCES / "m503.txt").read_text())
    seen, status, left = at_terminal(folder, ["machine", "m503.txt", "-o", "asked.toml"], ["0", "0 235", "", "-1, 250", "30"])
    check(status == 0 and not left, f"the guide: status {status}, not asked for: {left}: {seen}")
    check("'0': it must be two numbers" in seen, f"a wrong answer is explained: {seen}")
    made = tomllib.loads((folder / "asked.toml").read_text())
    x, y, z = made["axis"]
    check(x["travel_mm"] == [0, 235] and "travel_mm" not in y and z["travel_mm"] == [-1, 250], f"the answers: {made}")
    check(x["max_jerk_mm_s3"] == 30 * x["max_acceleration_mm_s2"] and z["max_jerk_mm_s3"] == 30 * z["max_acceleration_mm_s2"], f"the jerk: {made}")
    # The same from a file of answers.
    (folder / "answers.toml").write_text("x.travel_mm = [0, 235]\nz.travel_mm = [-1, 250]\njerk_per_acceleration = 30\n")
    done = run(folder, "machine", "m503.txt", "--answers", "answers.toml", "-o", "answered.toml")
    check((folder / "answered.toml").read_text() == (folder / "asked.toml").read_text(), "answers of a file are those of a terminal")
    check(done.stderr.count("does not say") == 1, f"what is not answered is said: {done.stderr}")
    # Nobody is asked behind Ctrl-D, nor without a terminal: the file is made, and each missing thing is a line.
    seen, status, _ = at_terminal(folder, ["machine", "m503.txt", "-o", "ended.toml"], [None])
    check(status == 0 and seen.count("does not say") == 4, f"Ctrl-D: {status}: {seen}")
    done = run(folder, "machine", "m503.txt", "-o", "silent.toml")
    check(done.stderr.count("splinefeed: note: m503.txt does not say ") == 4, f"without a terminal: {done.stderr}")
    check((folder / "silent.toml").read_text() == (folder / "ended.toml").read_text(), "both leave out the same")


def units_are_asked(folder):
    text = "".join(line for line in (SOURCES / "gantry.ini").read_text().splitlines(True) if "LINEAR_UNITS" not in line)
    (folder / "gantry.ini").write_text(text)
    check("does not say units: mm" in run(folder, "machine", "gantry.ini", "-o", "mm.toml").stderr, "units are missing")
    (folder / "units.toml").write_text('units = "inch"\n')
    run(folder, "machine", "gantry.ini", "--answers", "units.toml", "-o", "inch.toml")
    mm, inch = (tomllib.loads((folder / name).read_text())["axis"][0] for name in ("mm.toml", "inch.toml"))
    check(abs(inch["max_velocity_mm_s"] - 25.4 * mm["max_velocity_mm_s"]) < 1e-6, f"inches: {mm}, {inch}")
    check(abs(inch["steps_per_mm"] * 25.4 - mm["steps_per_mm"]) < 1e-3, f"steps of inches: {mm}, {inch}")


def a_doubt(folder):
    (folder / "fast.toml").write_text("[path]\nmax_feed_mm_s = 100\n[[axis]]\nname = 'x'\nmax_velocity_mm_s = 8000\nmax_acceleration_mm_s2 = 500\n")
    said = run(folder, "machine", "--check", "fast.toml").stdout.splitlines()
    check(said == ["fast.toml: nothing is wrong; its axes are x",
                   "fast.toml: warning: max_velocity_mm_s of x is 8000: is that mm/min? Then it is 133.333333"], f"a doubt: {said}")
    (folder / "part.csv").write_text("x\n0\n10\n")
    told = run(folder, "plan", "part.csv", "-m", "fast.toml", "--no-advice").stderr
    check("note: max_velocity_mm_s of x is 8000: is that mm/min? Then it is 133.333333" in told, f"a doubt of plan: {told}")


def trials(folder):
    """Every move of a trial lies within a tenth of the travel's ends, and each round ends where it began."""
    (folder / "settings.txt").write_text(SETTINGS)
    run(folder, "machine", "settings.txt", "-o", "router.toml")
    for controller, ignore in (("grbl", ""), ("linuxcnc", ""), ("klipper", "SET_VELOCITY_LIMIT"), ("marlin", "M201,M204")):
        for axis, low, high, most in (("x", -780, 0, 8000), ("z", -80, 0, 2000)):
            words = ["machine", "router.toml", "--try", axis, "--for", controller, "-o", "try.gcode"]
            run(folder, *words)
            text = (folder / "try.gcode").read_text()
            moves = [(float(a), float(b)) for a, b in re.findall(rf"^(?:G53 )?G1 {axis.upper()}(\S+) F(\S+)$", text, re.MULTILINE)]
            rounds = 1 if controller in ("grbl", "linuxcnc") else 7
            check(len(moves) == rounds * 42, f"{controller} {axis}: {len(moves)} moves")
            margin = 0.1 * (high - low) - 0.001
            check(all(low + margin <= place <= high - margin and 0 < feed <= most for place, feed in moves), f"{controller} {axis}: {moves}")
            check(all(moves[k][0] == moves[0][0] for k in range(len(moves)) if k % 42 in (0, 41)), f"{controller} {axis}: where rounds end")
            check(text.count("G4 P3") == rounds, f"{controller} {axis}: pauses")
            wanted = [round(factor * (500 if axis == "x" else 200)) for factor in (0.5, 0.7, 1, 1.4, 2, 2.8, 4)]
            pattern = {"grbl": rf"\$12{'xyz'.index(axis)}=(\d+)", "linuxcnc": rf"ini\.{axis}\.max_acceleration (\d+)",
                       "klipper": r"ACCEL=(\d+)", "marlin": rf"M201 {axis.upper()}(\d+)"}[controller]
            found = [int(value) for value in re.findall(pattern, text)]
            check(found == wanted + ([wanted[2]] if rounds == 7 else []), f"{controller} {axis}: {found}")
            dialect = [*(["--ignore", ignore] if ignore else [])]
            run(folder, "check", "try.gcode", "--dialect", controller, "-m", "router.toml", *dialect)


with tempfile.TemporaryDirectory(prefix="splinefeed_machine_guide_") as scratch:
    for story in (a_cam_file_on_a_grbl_machine, the_guide, units_are_asked, a_doubt, trials):
        inner = pathlib.Path(scratch) / story.__name__
        inner.mkdir()
        story(inner)
print(f"{len(failures)} of the stories' checks failed" if failures else "all stories are as told")
sys.exit(1 if failures else 0)
