#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What happens to a served machine when its senders do what they should not: serve_runs.py TOOL [CASE...].

A page of the web, a second sender, one that goes, floods, or does not read, signals, the state file, the console; and a program that is streamed by
counting characters, beside `run` of the same file.
"""
import json
import math
import os
import pathlib
import pty
import re
import select
import socket
import struct
import subprocess
import sys
import threading
import time

from sender import Failed, Sender, Server, run_cases

MACHINE = str(pathlib.Path(__file__).resolve().parent / "machine.toml")


def require(true, what):
    if not true:
        raise Failed(what)


def started(tool, folder, *options):
    return Server(tool, folder, *options, machine=MACHINE)


def greeted(server, kind="tcp"):
    sender = Sender(server, kind)
    require(sender.line() == "" and sender.line() == "Grbl 1.1h ['$' for help]", "no greeting")
    return sender


def page(tool, folder):
    """What a browser sends for a page of the web; ~ and ! are in its addresses."""
    server = started(tool, folder)
    body = b"\n$X\n$J=G91X7F6000\nG0X9\n"
    for request in (
            b"POST / HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 30\r\n\r\n" + body,
            b"POST /~! HTTP/1.1\r\nHost: evil.example:2300\r\nOrigin: http://evil.example\r\n\r\n" + body,
            b"GET /?gcode=G0X9 HTTP/1.0\r\n\r\n" + body,
            b"OPTIONS * HTTP/1.1\r\nHost: localhost\r\n\r\n" + body,
            b"g1x9f6000 / HTTP/1.1\r\nHost: evil.example:2300\r\n\r\n" + body,  # a page may choose its method
            b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n" + body,
            b"\r\nPOST / HTTP/1.1\r\n\r\n" + body,
            b"Host: 127.0.0.1\r\n" + body,
            b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03" + bytes(range(1, 200)) + body):
        for cut in (len(request), 3):
            sender = greeted(server)
            sender.send(request[:cut])
            time.sleep(0.05)
            try:
                sender.send(request[cut:])
                until = time.monotonic() + 5
                while time.monotonic() < until:
                    sender.read(0.1)
                raise Failed(f"not closed behind {request[:40]!r}")
            except (OSError, Failed) as failure:
                require("not closed" not in str(failure), failure)
            require(b"error" not in sender.text and b"Jog" not in sender.text, f"answered: {sender.text!r}")
            sender.close()
    sender = greeted(server)
    require(sender.place() == [0.0, 0.0, 0.0], "a page has moved the machine")
    require(sender.report().startswith("<Idle"), "not idle")
    sender.close()
    status, told = server.end()
    require(status == 0 and told.count("nothing of it was executed") >= 18, told)


def second(tool, folder):
    """Another sender is refused while one has the machine, and may have it from one that is silent."""
    server = started(tool, folder)
    first = greeted(server)
    other = Sender(server)
    require(re.match(r"\[MSG:Busy: 127\.0\.0\.1:\d+ has the machine\]", other.line()), "no word for the second")
    other.send(b"G0X9\n?$X\n~")
    require(not other.read(0.3) and first.place() == [0.0, 0.0, 0.0], "the second was answered, or has moved the machine")
    terminal = Sender(server, "pty")
    require(terminal.line().startswith("[MSG:Busy: "), "no word for the terminal")
    terminal.send(b"G0X9\n")
    time.sleep(0.2)
    require(first.place() == [0.0, 0.0, 0.0], "the second has moved the machine")
    terminal.close()
    first.send(b"G1X4F60\n")
    time.sleep(3.3)
    require(Sender(server).line().startswith("[MSG:Busy: "), "who is silent while the machine moves has lost it")
    time.sleep(1.2)
    heir = greeted(server)
    require(heir.place()[0] == 4.0, "the first one's move was cut")
    heir.send(b"G1X5F6000\n")
    require(heir.line() == "ok", "no answer")
    heir.until("Idle")
    require(heir.place()[0] == 5.0, "not there")
    heir.close()
    require(server.end()[0] == 0, "the end")


def gone(tool, folder):
    """A sender that goes in the middle: a program is held on its path, a jog ends; the next one goes on."""
    server = started(tool, folder)
    for _ in range(3):  # in and out between two looks at the terminal
        descriptor = os.open(server.pty, os.O_RDWR | os.O_NOCTTY)
        os.write(descriptor, b"G1 F6000 X33")
        os.close(descriptor)
        time.sleep(0.3)
    sender = greeted(server, "pty")
    sender.send(b"\n")
    require(sender.line() == "ok" and sender.until("Idle") and sender.place() == [0.0, 0.0, 0.0], "half a line of one that had gone was executed")
    sender.close()
    time.sleep(0.3)
    for kind in ("tcp", "reset", "pty"):
        sender = greeted(server, "pty" if kind == "pty" else "tcp")
        sender.send(b"G90 G1 X100 F6000\nX0\n")
        time.sleep(0.4)
        require(sender.report().startswith("<Run"), "it does not run")
        if kind == "reset":
            sender.socket.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        sender.close()
        time.sleep(0.6)
        sender = greeted(server, "pty" if kind == "pty" else "tcp")
        require(sender.line().startswith("[MSG:Held: "), "it does not say that it is held")
        held = sender.until("Hold:0")
        place = sender.place()
        require(5.0 < place[0] < 99.0, held)
        time.sleep(0.3)
        require(sender.place() == place, "it moves while it is held")
        sender.send(b"~")
        sender.until("Idle")
        require(sender.place() == [0.0, 0.0, 0.0], "not at the end of the program")
        sender.send(b"$J=G91X200F3000\n")
        time.sleep(0.4)
        sender.close()
        time.sleep(0.5)
        sender = greeted(server, "pty" if kind == "pty" else "tcp")
        require(sender.report().startswith("<Idle"), "the jog has not ended")
        require(5.0 < sender.place()[0] < 60.0, "the jog went on")
        sender.send(b"G0X0\n")
        sender.until("Idle")
        sender.close()
        time.sleep(0.3)
    require(server.end()[0] == 0, "the end")


def flood(tool, folder):
    """A sender that sends without counting, and one that does not read: a stop acts all the same."""
    server = started(tool, folder)
    sender = greeted(server)
    count = 15000  # more would not fit, and be an alarm
    program = b"".join(b"G1 X%d F6000\n" % (10 + n % 2) for n in range(count))
    sender.socket.setblocking(False)
    sent, until = 0, time.monotonic() + 20
    while sent < len(program) and time.monotonic() < until:
        try:
            sent += sender.socket.send(program[sent:sent + 65536])
        except BlockingIOError:
            sender.read(0.01)
    require(sent == len(program), f"it reads no more behind {sent} bytes")
    sender.send(b"!")
    begun = time.monotonic()
    sender.until("Hold:0", 5)
    require(time.monotonic() - begun < 1.0, "the hold waited")
    sender.send(b"\x18")
    sender.text = b""
    sender.until("Idle")
    sender.close()
    deaf = greeted(server)
    for _ in range(3000):
        try:
            deaf.send(b"$$\n$#\n" * 20)
        except OSError:
            break
    time.sleep(1)
    deaf.close()
    time.sleep(0.5)
    sender = greeted(server)
    sender.send(b"\x18")  # it may have sent more than what fits: alarm 22
    sender.until("Idle")
    sender.send(b"G1X290F600\n")
    threading.Thread(target=pour, args=(sender.socket,), daemon=True).start()
    time.sleep(0.5)
    begun = time.monotonic()
    require(server.end()[0] == 0, "the end")
    require(time.monotonic() - begun < 2.0, "a flood keeps a signal from acting")


def pour(connection):
    """Bytes that do nothing, as many as go."""
    connection.setblocking(True)
    try:
        while True:
            connection.sendall(b"\xff" * 65536)
    except OSError:
        pass


def stream(tool, folder, count=20000):
    """Characters are counted, as many as the status promises: as fast as `run` of the same file, every line answered."""
    lines = [b"G1X%.4fY%.4fF6000\n" % (150 + 20 * math.cos(n / 400), 100 + 20 * math.sin(n / 400)) for n in range(count)]
    program = pathlib.Path(folder, "part.nc")
    program.write_bytes(b"".join(lines))
    said = subprocess.run([tool, "run", str(program), "--dialect", "grbl", "-m", MACHINE, "--summary", "json", "--no-advice"], check=True,
                          capture_output=True, text=True).stdout
    wanted = json.loads(said)["cycle_time_s"]
    server = started(tool, folder)
    sender = greeted(server)
    window = int(re.search(r"Bf:\d+,(\d+)", sender.report()).group(1)) - 8
    batch, unanswered, at, answers = [], 0, 0, 0
    begun = time.monotonic()
    polled = begun
    while answers < len(lines):
        while at < len(lines) and unanswered + len(lines[at]) < window:
            batch.append(lines[at])
            unanswered += len(lines[at])
            at += 1
        sender.send(b"".join(batch))
        batch.clear()
        if time.monotonic() - polled > 0.2:
            polled = time.monotonic()
            sender.send(b"?")
        sender.read(0.05)
        while b"\n" in sender.text:
            line = sender.line()
            require(line == "ok" or line.startswith("<"), line)
            if line == "ok":
                unanswered -= len(lines[answers])
                answers += 1
    sender.until("Idle")
    took = time.monotonic() - begun
    sender.close()
    require(server.end()[0] == 0, "the end")
    print(f"streamed: {took:.3f} s, run: {wanted:.3f} s")
    # Besides: the first 8000 lines are read before it begins, a pause of the input, the last status.
    require(took < 1.01 * wanted + 0.4, f"{took:.3f} s instead of {wanted:.3f} s")


def signals(tool, folder):
    """The first SIGINT brakes on the path, the second stops at once; then it ends, and the state file knows where it stands."""
    state = os.path.join(folder, "state.json")
    for count in (1, 2):
        server = started(tool, folder, "--state", state)
        sender = greeted(server)
        sender.send(b"$X\n$H\nG10 L2 P1 X1\nG92 Y2\nG1 X90 F6000\n")
        time.sleep(1.2)
        require(sender.report().startswith("<Run"), "it does not run")
        require(json.loads(pathlib.Path(state).read_text())["position_mm"][0] is None, "the state file does not know that it moves")
        status, told = server.end(count)
        require(status == 0, told)
        kept = json.loads(pathlib.Path(state).read_text())
        require(5 < kept["position_mm"][0] < 90 and kept["position_mm"][1] == 0.0, kept)
        sender.close()
        server = started(tool, folder, "--state", state)
        sender = greeted(server)
        require(abs(sender.place()[0] - kept["position_mm"][0]) < 0.001, "it stands elsewhere")
        sender.send(b"$X\n$H\n")
        sender.until("Home")
        time.sleep(0.2)  # it begins when the file is on the disk, and takes half a second
        require(json.loads(pathlib.Path(state).read_text())["position_mm"] == [None] * 3, "the state file does not know that it homes")
        sender.until("Idle")
        time.sleep(0.1)
        require(json.loads(pathlib.Path(state).read_text())["position_mm"] == [0.0] * 3, "the state file does not know that it has homed")
        sender.text = b""
        sender.send(b"$#\n")
        require(sender.line() == "[G54:1.000,0.000,0.000]", "the offsets are lost")
        sender.close()
        require(server.end()[0] == 0, "the end")


def console(tool, folder):
    """Words and lines at the server's own terminal."""
    master, slave = pty.openpty()
    process = subprocess.Popen([tool, "serve", "-m", MACHINE, "--tcp", "127.0.0.1:0"], stdin=slave, stdout=slave, stderr=slave)
    os.close(slave)
    said = b""

    def expect(text, seconds=10):
        nonlocal said
        until = time.monotonic() + seconds
        while text not in said:
            if time.monotonic() > until:
                raise Failed(f"no {text!r} in {said!r}")
            if select.select([master], [], [], 0.1)[0]:
                said += os.read(master, 4096)
        said = said[said.index(text) + len(text):]

    expect(b"type help")
    os.write(master, b"help\n")
    expect(b"jog       AXIS MM")
    os.write(master, b"jog x 20 3000\n")
    expect(b"ok")
    time.sleep(0.8)
    os.write(master, b"status\n")
    expect(b"<Idle|MPos:20.000,0.000,0.000")
    os.write(master, b"jog q\n")
    expect(b"write: jog AXIS MM")
    os.write(master, b"G1 X10\n")
    expect(b"error:22")
    os.write(master, b"G1 X300 F1000\n")
    time.sleep(0.4)
    os.write(master, b"hold\n")
    time.sleep(0.3)
    os.write(master, b"status\n")
    expect(b"<Hold:0|")
    os.write(master, b"reset\n")
    expect(b"Grbl 1.1h")
    os.write(master, b"quit\n")
    require(process.wait(timeout=10) == 0, "the end")


CASES = {case.__name__: case for case in (page, second, gone, flood, stream, signals, console)}


if __name__ == "__main__":
    sys.exit(run_cases(CASES, sys.argv[1], sys.argv[2:]))
