#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""bCNC operates a served machine, by TCP and by a pseudo terminal, and the reference firmware in QEMU: bcnc_runs.py TOOL IMAGE, in a network of its own
(bcnc.sh). Each step says in which state the machine must be, and where it must stand. What bCNC is told goes by the web page that it has for pendants."""
import json
import math
import os
import pathlib
import re
import select
import socket
import subprocess
import sys
import tempfile
import threading
import time
import urllib.error
import urllib.parse
import urllib.request

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent / "serve"), str(HERE.parent / "firmware")]
from board_in_qemu import Board, plugins_refused  # noqa: E402
from sender import Failed, Server  # noqa: E402

MACHINE = str(HERE.parent / "serve/machine.toml")
PAGE = "http://127.0.0.1:31081"
INI = """[bCNC]
checkinterval = 0
[Connection]
port = {port}
openserial = 1
pendant = 1
pendantport = 31081
controller = GRBL1
"""


def require(holds, what):
    if not holds:
        raise Failed(what)


class Bcnc:
    def __init__(self, folder, port, step_mm=0.0):
        self.folder, self.step_mm = pathlib.Path(folder), step_mm
        (self.folder / ".bCNC").write_text(INI.format(port=port))
        self.start("Idle$")

    def start(self, state):
        environment = dict(os.environ, HOME=str(self.folder), DISPLAY=":91", LC_ALL="C.UTF-8")
        self.log = open(self.folder / "bcnc.log", "ab")
        self.process = subprocess.Popen(["/usr/bin/python3", "/usr/share/bcnc/bCNC/__main__.py"], env=environment, stdin=subprocess.DEVNULL,
                                        stdout=self.log, stderr=self.log)
        self.in_state(state, 120)

    def state(self):
        """What its page says; before it has one: that it is not connected."""
        try:
            return json.load(urllib.request.urlopen(PAGE + "/state", timeout=5))
        except (urllib.error.URLError, ConnectionError, TimeoutError):
            return {"state": "none"}

    def send(self, **words):
        urllib.request.urlopen(f"{PAGE}/send?{urllib.parse.urlencode(words)}", timeout=5).read()

    def until(self, holds, what, seconds=20):
        until = time.monotonic() + seconds
        while not holds():
            require(time.monotonic() < until, f"{what}: not within {seconds} s, {self.state()}")
            time.sleep(0.02)

    def in_state(self, pattern, seconds=20):
        self.until(lambda: re.match(pattern, self.state()["state"]), f"never {pattern}", seconds)

    def place(self):
        state = self.state()
        return [float(state["m" + axis]) for axis in "xyz"]

    def standing(self):
        time.sleep(0.6)  # two statuses
        place = self.place()
        time.sleep(0.6)
        require(self.place() == place, f"it moves from {place} to {self.place()}")
        return place

    def stands_at(self, *place):
        at = self.standing()
        require(all(abs(a - b) <= self.step_mm for a, b in zip(at, place)), f"it stands at {at}, not at {place}")

    def go(self, x, y):
        self.send(gcode=f"G90 G0 X{x} Y{y}")
        self.until(lambda: self.place()[:2] == [x, y] and self.state()["state"] == "Idle", f"never at {x}, {y}")

    def run(self, text):
        """Loads a program, and presses run."""
        program = self.folder / "part.nc"
        program.write_text(text)
        self.lines = text.count("\n")
        self.send(cmd=f"LOAD {program}")
        time.sleep(1.0 + len(text) / 1e5)  # it says nowhere when it has read it
        self.send(cmd="RUN")

    def ended(self, seconds):
        """Behind each job it holds and resets."""
        self.until(lambda: f"[{self.lines + 2}]  Completed: 100%" in self.state()["msg"], "the program is not sent", seconds)
        time.sleep(3.0)
        self.in_state("Idle$")

    def end(self):
        self.process.kill()
        self.process.wait()
        self.log.close()


def circle(count):
    places = [(round(150 + 20 * math.cos(n / 400), 3), round(100 + 20 * math.sin(n / 400), 3)) for n in range(count)]
    return "G21 G90\n" + "".join(f"G1 X{x:.3f} Y{y:.3f} F6000\n" for x, y in places), [*places[-1], 0.0]


def home(bcnc):
    bcnc.go(12, 7)
    bcnc.send(cmd="HOME")
    bcnc.in_state("Home")
    bcnc.in_state("Idle$")
    bcnc.stands_at(0, 0, 0)


def jog(bcnc):
    """To its end, and cancelled."""
    bcnc.send(gcode="$J=G91 X20.5 F100000")
    bcnc.until(lambda: bcnc.place() == [20.5, 0, 0], "no jog")
    bcnc.in_state("Idle$")
    bcnc.send(gcode="$J=G91 X200 F3000")
    bcnc.in_state("Jog")
    time.sleep(0.5)
    bcnc.send(cmd="SENDHEX 85")
    bcnc.in_state("Idle$")
    require(25 < bcnc.standing()[0] < 120, f"the jog was cancelled at {bcnc.place()}")


def short(bcnc):
    """300 lines; hold, resume, override."""
    text, end = circle(300)
    bcnc.go(300, 0)
    bcnc.run(text)
    bcnc.in_state("Run")
    time.sleep(0.3)
    bcnc.send(cmd="FEEDHOLD")
    bcnc.in_state("Hold:0")
    require(150 < bcnc.standing()[0] < 300, f"held at {bcnc.place()}")
    bcnc.send(cmd="RESUME")
    bcnc.in_state("Run")
    for _ in range(2):
        bcnc.send(cmd="SENDHEX 92")
    bcnc.until(lambda: bcnc.state()["OvFeed"] == 80, "no override")
    bcnc.ended(60)
    bcnc.stands_at(*end)


def long(bcnc):
    """20,000 lines."""
    text, end = circle(20000)
    bcnc.run(text)
    bcnc.in_state("Run", 60)
    begun = time.monotonic()
    bcnc.ended(180)
    print(f"  streamed: {time.monotonic() - begun:.1f} s")
    bcnc.stands_at(*end)


def wrong(bcnc):
    """An error behind a move: the machine is held, and stop resets it where it stands."""
    bcnc.go(10, 100)
    bcnc.run("G90\nG1 X50 F3000\nX60\nG999\nX70\nX80\n")
    bcnc.until(lambda: bcnc.state()["state"] == "error:20" or bcnc.state()["state"].startswith("Hold"), "no error is shown")
    bcnc.in_state("Hold:0")
    place = bcnc.standing()
    require(10 <= place[0] < 60 and place[1:] == [100, 0], f"held at {place}")
    bcnc.send(cmd="STOP")
    bcnc.in_state("Idle$")
    time.sleep(3.0)
    bcnc.stands_at(*place)


def probe(bcnc):
    """It finds nothing."""
    bcnc.go(10, 100)
    bcnc.send(gcode="G38.2 Z-5 F600")
    bcnc.in_state("ALARM:5|Alarm")
    bcnc.stands_at(10, 100, -5)
    bcnc.send(cmd="UNLOCK")
    bcnc.in_state("Idle$")


def reset(bcnc):
    """While it runs."""
    before = bcnc.place()[1:]
    bcnc.send(gcode="G90 G1 X200 F6000")
    bcnc.in_state("Run")
    time.sleep(0.4)
    bcnc.send(cmd="RESET")
    bcnc.in_state("Idle$")
    x, *others = bcnc.standing()
    require(20 < x < 190 and others == before, f"at {x}, {others}")


def away(bcnc):
    """It is killed in the middle, and comes back."""
    bcnc.go(10, 100)
    bcnc.send(gcode="G90 G1 X100 F1200")
    bcnc.in_state("Run")
    time.sleep(0.5)
    bcnc.end()
    bcnc.start("Hold:0")
    require(11 < bcnc.standing()[0] < 99, f"held at {bcnc.place()}")
    bcnc.send(cmd="RESUME")
    bcnc.in_state("Idle$")
    bcnc.stands_at(100, 100, -5)


def carried(uart):
    """The port of TCP that leads to a board's line."""
    listener = socket.create_server(("127.0.0.1", 0))

    def carry():
        peer, _ = listener.accept()
        while True:
            for line in select.select([peer, uart], [], [])[0]:
                data = line.recv(4096)
                if not data:
                    return
                (uart if line is peer else peer).sendall(data)

    threading.Thread(target=carry, daemon=True).start()
    return listener.getsockname()[1]


def operate(folder, port, steps, **board):
    bcnc = Bcnc(folder, port, **board)
    try:
        for step in steps:
            try:
                step(bcnc)
            except Failed as failure:
                raise Failed(f"{step.__name__} by {port}: {failure}") from failure
            print(f"{step.__name__} by {port.split(':')[0]}: passed", flush=True)
    finally:
        bcnc.end()


def served(tool, folder):
    server = Server(tool, folder, machine=MACHINE)
    try:
        operate(folder, f"socket://127.0.0.1:{server.port}", (home, jog, short, long, wrong, probe, reset, away))
        operate(folder, os.path.realpath(server.pty), (home, jog, short, wrong, probe, reset, away))
        status, told = server.end()
        require(status == 0 and told == "", f"the server ends with {status}: {told}")
    finally:
        server.process.kill()


def on_board(image, folder):
    """In real time. It has no switches and no probe, and a line that does not say who has gone."""
    if refused := plugins_refused():
        print(f"without the firmware: {refused}")
        return
    board = Board(image, folder, "lm3s6965evb", clock="shift=4,sleep=on")
    try:
        operate(folder, f"socket://127.0.0.1:{carried(board.uart)}", (jog, short, wrong, reset), step_mm=0.0125)
    finally:
        board.close()


def main():
    tool, image = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        screen = subprocess.Popen(["Xvfb", ":91", "-nolisten", "tcp"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            on_board(image, folder)
            served(tool, folder)
        except Failed as failure:
            print(failure)
            print((pathlib.Path(folder) / "bcnc.log").read_text()[-3000:])
            return 1
        finally:
            screen.kill()
    return 0


if __name__ == "__main__":
    sys.exit(main())
