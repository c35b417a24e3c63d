#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""`splinefeed serve` on three simulated Modbus drives, each a process: target_runs.py TOOL [CASE...].

What the drives record decides: where their shafts stand at the end, and that none moves when nothing was asked for. Stops, faults and homing are stories of tests/live/shaft_stories.txt.
"""
import json
import math
import os
import pathlib
import signal
import subprocess
import sys
import time

from sender import Failed, Sender, ServedDrives, run_cases

STEPS = 320.0


def require(true, what):
    if not true:
        raise Failed(what)


def unlocked(drives, *options):
    """A sender of a new server, whose machine may move; the drives were never told where they stand."""
    drives.serve(*options)
    sender = Sender(drives.server)
    require(sender.line() == "" and sender.line().startswith("Grbl 1.1"), "no greeting")
    if sender.report().startswith("<Alarm"):
        require("unlock" in sender.line(), "it does not say how to unlock it")
        sender.send(b"$X\n")
        require("Unlocked" in sender.line() and sender.line() == "ok", "it stays locked")
    return sender


def say(sender, line):
    """The answer to a line; what is said before it in brackets does not count."""
    sender.send(line + b"\n")
    while True:
        answer = sender.line()
        if not answer.startswith(("[", "<")):
            return answer


def await_line(sender, begin):
    while not sender.line().startswith(begin):
        pass


def go(sender, line):
    require(say(sender, line) == "ok", line)
    sender.until("Idle")
    return sender.place()


def underway(sender, mm):
    """Once x is beyond mm, either way."""
    until = time.monotonic() + 20.0
    begin = sender.place()[0]
    while abs(sender.place()[0] - begin) < mm:
        if time.monotonic() > until:
            raise Failed("it does not move")
        time.sleep(0.01)


def motion(drives):
    """MDI, jogs, a streamed program with a dwell, overrides: each ends where it was told, to the count."""
    sender = unlocked(drives)
    require(go(sender, b"G0 X10 Y5 Z-2.5") == [10.0, 5.0, -2.5], "MDI")
    require(go(sender, b"$J=G91 X-4 F3000") == [6.0, 5.0, -2.5], "a jog")
    for _ in range(4):
        require(say(sender, b"$J=G91 Y0.5 F600") == "ok", "a jog behind a jog")
    sender.until("Idle")
    require(sender.place() == [6.0, 7.0, -2.5], "four jogs")
    sender.send(b"G1 X60 F3000\n")
    require(sender.line() == "ok", "no answer")
    underway(sender, 5.0)
    drives.server.process.send_signal(signal.SIGUSR1)
    sender.until("Hold:0")
    require(10.0 < sender.place()[0] < 59.0, "SIGUSR1 does not hold it")
    sender.send(b"~")
    sender.until("Idle")
    require(sender.place() == [60.0, 7.0, -2.5], "it does not go on behind SIGUSR1")
    lines = [b"G1 F5000\n"] + [b"X%.3fY%.3f\n" % (40 + 20 * math.cos(n / 50), 40 + 20 * math.sin(n / 50)) for n in range(600)] + \
            [b"G4 P0.1\n", b"G0 X0 Y0 Z0\n"]
    sender.send(b"".join(lines))
    for line in lines:
        require(sender.line() == "ok", line)
    sender.until("Run")
    sender.send(b"\x91\x91")
    sender.until("Idle")
    require(sender.place() == [0.0, 0.0, 0.0], "the program")
    sender.close()
    drives.end()
    require(drives.counts() == [0, 0, 0], f"the shafts stand at {drives.counts()}")


def again(drives):
    """Where the machine stands is read from the drives, not from a file that says otherwise."""
    state = os.path.join(drives.folder, "state.json")
    sender = unlocked(drives, "--state", state)
    go(sender, b"G0 X12 Y3")
    sender.close()
    drives.end(keep=True)
    kept = json.loads(pathlib.Path(state).read_text())
    require(kept["position_mm"] == [12.0, 3.0, 0.0], kept)
    kept["position_mm"] = [50.0, 50.0, 0.0]
    pathlib.Path(state).write_text(json.dumps(kept))
    drives.serve("--state", state)
    sender = Sender(drives.server)
    require(sender.report().startswith("<Idle") and sender.place() == [12.0, 3.0, 0.0], "it stands elsewhere, or is locked")
    sender.text = b""
    go(sender, b"G0 X0 Y0")
    require(say(sender, b"$SLP") == "ok" and sender.report().startswith("<Sleep"), "it does not sleep")
    time.sleep(0.3)
    sender.send(b"\x18")
    await_line(sender, "[MSG:'$H'")
    require(say(sender, b"$X") == "ok", "it stays locked")
    require(go(sender, b"G0 X1") == [1.0, 0.0, 0.0], "it does not wake up")
    sender.send(b"G1 X50 F3000\n")
    underway(sender, 2.0)
    drives.end(signals=1)
    stood = json.loads(pathlib.Path(state).read_text())["position_mm"]
    require(2.0 < stood[0] < 49.0, f"the state file says {stood}")
    require([round(at * STEPS) for at in stood] == drives.counts(), f"the state file says {stood}, the shafts stand at {drives.counts()}")


def faults(drives):
    """What a drive reports, and a drive that is lost, are alarms; a reset resets the fault, and the place is read anew."""
    sender = unlocked(drives)
    go(sender, b"G1 X20 F3000")
    sender.send(b"G0 X120\n")  # faster than this drive's shaft may turn
    require(sender.line() == "ok", "no answer")
    await_line(sender, "ALARM:17")
    told = sender.line()
    require("code 3" in told and "axis x" in told, f"it says {told}")
    require(say(sender, b"$X") == "error:9", "it is unlocked while the fault lasts")
    sender.send(b"\x18")
    await_line(sender, "[MSG:'$H'")
    place = sender.place()
    require(20.0 < place[0] < 60.0, f"it stands at {place}")
    require(say(sender, b"$X") == "ok", "it stays locked")
    require(go(sender, b"G1 X10 F3000") == [10.0, 0.0, 0.0], "it does not move behind the fault")
    drives.drives[1].process.send_signal(signal.SIGSTOP)
    sender.send(b"G1 X80 F1000\n")
    await_line(sender, "ALARM:17")
    told = sender.line()
    require("drive of y" in told, f"it says {told}")
    drives.drives[1].process.send_signal(signal.SIGCONT)
    sender.send(b"\x18")
    await_line(sender, "[MSG:'$H'")
    require(say(sender, b"$X") == "ok" and go(sender, b"G1 X0 F3000") == [0.0, 0.0, 0.0], "it does not move with the drive that came back")
    sender.close()
    drives.end()
    require(drives.counts() == [0, 0, 0], f"the shafts stand at {drives.counts()}")


def dead_drive(drives):
    """A drive that dies in motion: a sentence within a second, an alarm, and the end says that it may still move."""
    sender = unlocked(drives)
    sender.send(b"G1 X200 Y50 F3000\n")
    underway(sender, 10.0)
    drives.drives[1].process.kill()
    begun = time.monotonic()
    await_line(sender, "[MSG:No answer from y")
    require(time.monotonic() - begun < 1.0, f"it is said after {time.monotonic() - begun:.2f} s")
    await_line(sender, "ALARM:17")
    status, told = drives.server.end()
    require(status == 1 and "did not confirm its stop and may still move" in told, f"exit status {status}: {told}")


def others(drives):
    """Who comes second is refused, and told who is first; with its end that is over."""
    program = pathlib.Path(drives.folder, "line.csv")
    program.write_text("0,0,0\n5,0,0\n")
    commands = (["run", str(program), "-m", drives.machine, "--target", "modbus"], ["link", "-m", drives.machine, "--target", "modbus", "--seconds", "0.1"],
                ["serve", "-m", drives.machine, "--target", "modbus", "--tcp", "127.0.0.1:0"])
    sender = unlocked(drives)
    go(sender, b"G0 X2")
    for command in commands:
        refused = subprocess.run([drives.tool, *command], capture_output=True, text=True, timeout=20)
        named = f"splinefeed serve (process {drives.server.process.pid}) uses it; end that first"
        require(refused.returncode == 1 and named in refused.stderr, f"{command[0]}: {refused.returncode}: {refused.stderr}")
    require(sender.report().startswith("<Idle"), "it was disturbed")
    sender.close()
    drives.server.process.kill()  # it says nothing, and leaves nothing behind
    drives.server.process.wait()
    require(subprocess.run([drives.tool, *commands[1]], capture_output=True, timeout=20).returncode == 0, "link is still refused")


CASES = {case.__name__: case for case in (motion, again, faults, dead_drive, others)}
DRIVES = {"faults": {"extra": ["--max-velocity", "26000"]}}  # of simulated drives


# Drives that follow target positions: their profiles, with keys of their addresses, and what of the cases they are for.
PROFILES = {"lexium32m": ("&ramp=1e6", ("motion",)), "leadshine-pr": ("", ("motion",))}


def case_of(whole):
    """The case NAME or NAME@PROFILE, on drives of its own."""
    name, _, profile = whole.partition("@")
    how = dict(DRIVES.get(name, {}))
    if profile:
        how |= {"profile": profile, "keys": f"profile={profile}{PROFILES[profile][0]}"}

    def run(tool, folder):
        with ServedDrives(tool, folder, **how) as drives:
            CASES[name](drives)

    return run


def main():
    names = sys.argv[2:] or [*CASES, *(f"{case}@{profile}" for profile, (_, cases) in PROFILES.items() for case in cases)]
    return run_cases({name: case_of(name) for name in names}, sys.argv[1], names)


if __name__ == "__main__":
    sys.exit(main())
