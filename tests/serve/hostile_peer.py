#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What comes to a server's port that is no sender, or no good one, and what a host does to a server: hostile_peer.py TOOL [CASE...].

A page of the web, peers that drip, flood or fall silent, a standard error that nobody reads, signals, a kill, and the state file behind it. All of it
on this computer alone, bounded in number and time.
"""
import ctypes
import fcntl
import json
import os
import pathlib
import re
import select
import shutil
import signal
import socket
import subprocess
import sys
import time

from sender import Failed, Sender, Server, run_cases

MACHINE = str(pathlib.Path(__file__).resolve().parent / "machine.toml")
ORDERS = b"\n~$X\n~G0X9\n$J=G91X7F6000\n~"
STUN = b"\x00\x0a\x00\x01\x00\x48\x21\x12\xa4\x42abcdefghijkl\x00\x06\x00\x0a~\n$X\nG0X99:wxyz"
NO_SENDERS = {
    "STUN": STUN,
    "STUN, longer": b"\x00\x5c" + STUN[2:],
    "TLS": b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03" + bytes(range(256)),
    "DTLS": b"\x16\xfe\xfd\x00\x00\x00\x00\x00\x00\x00\x0a" + bytes(range(256)),
    "telnet": b"\xff\xfb\x1f\xff\xfb\x20\xff\xfb\x18",
    "HTTP": b"POST /~! HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 30\r\n\r\n",
    "WebSocket": b"GET / HTTP/1.1\r\nHost: a\r\nConnection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Key: fn8~!\r\n\r\n",
    "HTTP/2": b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n\x00\x00",
    "UTF-8": "(смена инструмента, с охлаждением)".encode(),
    "1 MB": b"x" * (1 << 20),
}


def require(true, what):
    if not true:
        raise Failed(what)


def started(tool, folder, *options, machine=MACHINE, **streams):
    return Server(tool, folder, *options, machine=machine, **streams)


def greeted(server):
    sender = Sender(server)
    require(sender.line() == "" and sender.line() == "Grbl 1.1h ['$' for help]", "no greeting")
    return sender


def running(server, way=b"G1 X290 F1200\n"):
    sender = greeted(server)
    sender.send(way)
    sender.until("Run")
    return sender


def knock(server, data, seconds=5.0):
    """What a peer is answered that sends this; the server has to close the connection."""
    with socket.create_connection(("127.0.0.1", server.port)) as peer:
        peer.settimeout(seconds)
        answer = b""
        try:
            peer.sendall(data)
            while part := peer.recv(4096):
                answer += part
        except socket.timeout as late:
            raise Failed(f"not closed behind {data[:20]!r}") from late
        except OSError:
            pass  # closed with bytes unread
    return answer


def end(server):
    status, told = server.end()
    require(status == 0, f"exit status {status}: {told}")
    return told


def no_sender(tool, folder):
    """Nothing of it moves a held machine, whether another sender is there or not."""
    server = started(tool, folder)
    sender = running(server)
    time.sleep(0.3)
    sender.close()
    time.sleep(0.5)
    for there in (False, True):
        if there:
            sender = greeted(server)
            sender.line()
        for name, data in NO_SENDERS.items():
            answer = knock(server, data + ORDERS)
            require(not re.search(rb"ok|error|<|Jog", answer), f"{name} was answered: {answer!r}")
        if not there:
            sender = greeted(server)
            require(sender.line().startswith("[MSG:Held: "), "it is not held any more")
            place = sender.place()
            sender.close()
    require(sender.report().startswith("<Hold:0") and sender.place() == place, f"it was moved from {place}: {sender.report()}")
    sender.close()
    require(end(server).count("nothing of it was executed") == 2 * len(NO_SENDERS), "the log does not say so")


def drip(tool, folder):
    """A byte each 10 ms: the line of a sender is executed, what is none is closed, and nobody waits for either."""
    server = started(tool, folder)
    sender = greeted(server)
    drips = [(Sender(server), STUN), (Sender(server), NO_SENDERS["HTTP"])]
    closed = set()
    for k in range(40):
        for other, data in drips:
            try:
                other.send(data[k:k + 1])
                while other.read(0):
                    pass
            except (OSError, Failed):
                closed.add(data)
        sender.send((b"G1 X5 F6000 (slowly)\n" + b"?" * 40)[k:k + 1])
        time.sleep(0.01)
    require(len(closed) == 2, "what is no sender was not closed")
    sender.until("Idle")
    require(sender.place()[0] == 5.0 and b"ok" in sender.text, "the line was not executed")
    sender.close()
    end(server)


def anybody(tool, folder):
    """Who is refused stops the machine all the same, and does nothing else; a letter stops nothing."""
    server = started(tool, folder)
    sender = running(server)
    other = Sender(server)
    other.line()
    other.send(b"$I\n")
    other.send("\n(фДх)\nG0X9\n$X\n~".encode())  # 0x84 and 0x85 are in it
    time.sleep(0.3)
    require(sender.report().startswith("<Run"), "text has stopped it, or it did not run")
    for stop, state in ((b"!", "Hold:0"), (b"\x84", "Door:0")):
        other.send(stop)
        sender.until(state, 2)
        place = sender.place()
        other.send(b"~\x81")
        time.sleep(0.3)
        require(sender.place() == place and sender.report().startswith("<" + state), "who is refused has resumed")
        sender.send(b"~")
        sender.until("Run", 5)
    other.send(b"\x18")
    sender.until("Idle", 2)
    sender.send(b"$J=G91X-50F1200\n")
    sender.until("Jog", 2)
    other.send(b"\x85")
    sender.until("Idle", 1)
    sender.close()
    other.close()
    end(server)


def silent(tool, folder):
    """Who is silent for 3 s loses a machine that is held, not one that moves; the heir finds it held."""
    server = started(tool, folder)
    sender = running(server, b"G1 X290 F600\n")
    time.sleep(3.3)
    heir = Sender(server)
    require(heir.line().startswith("[MSG:Busy: "), "it moves, and was given away")
    heir.send(b"!")
    time.sleep(0.5)
    heir.close()
    heir = greeted(server)
    require(heir.line().startswith("[MSG:Held: ") and heir.report().startswith("<Hold:0"), "it is not held")
    heir.close()
    sender.close()
    end(server)


def unread(tool, folder):
    """1,000 connections in a row, and nobody reads what is told of them: the machine obeys, and so does the server."""
    ends = os.pipe()
    fcntl.fcntl(ends[1], fcntl.F_SETPIPE_SZ, 4096)
    server = started(tool, folder, stderr=ends[1])
    os.close(ends[1])
    sender = running(server, b"G1 X290 F600\n")
    slowest = 0.0
    for k in range(1000):
        knock(server, b"\x16\x03")
        if k % 50 == 0:
            begun = time.monotonic()
            sender.report()
            slowest = max(slowest, time.monotonic() - begun)
    require(slowest < 1.0, f"the status came after {slowest:.1f} s")
    descriptors = len(os.listdir(f"/proc/{server.process.pid}/fd"))
    require(descriptors < 40, f"{descriptors} descriptors are open")
    sender.send(b"!")
    sender.until("Hold:0", 1)
    read = b""
    while b" messages were dropped here" not in read and select.select([ends[0]], [], [], 5)[0]:
        read += os.read(ends[0], 4096)
    require(b" messages were dropped here" in read, "nobody is told that messages were dropped")
    for _ in range(100):
        knock(server, b"\x16\x03")
    server.process.send_signal(signal.SIGINT)
    require(server.process.wait(timeout=5) == 0, "the end")
    sender.close()
    os.close(ends[0])


def state_of(server):
    return pathlib.Path(f"/proc/{server.process.pid}/stat").read_text().rsplit(")", 1)[1].split()[0]


def signals(tool, folder):
    """SIGTSTP holds the machine, and then the process stops; SIGCONT behind it, or behind SIGSTOP, leaves the machine held."""
    server = started(tool, folder)
    sender = running(server)
    time.sleep(0.3)
    for stop in (signal.SIGTSTP, signal.SIGSTOP):
        server.process.send_signal(stop)
        until = time.monotonic() + 3
        while state_of(server) != "T" and time.monotonic() < until:
            time.sleep(0.01)
        require(state_of(server) == "T", f"the process does not stop: {stop}")
        time.sleep(0.2)
        server.process.send_signal(signal.SIGCONT)
        sender.until("Hold:0", 3)
        place = sender.place()
        time.sleep(0.3)
        require(sender.place() == place, "it moves")
        server.process.send_signal(signal.SIGUSR2)
        sender.until("Run", 2)
    server.process.send_signal(signal.SIGTSTP)
    server.process.send_signal(signal.SIGINT)
    sender.close()
    require("the process stops: until it continues nobody watches" in end(server), "nobody is told")


def killed(tool, folder):
    """A state file is of one machine, one target and one process, and knows no place behind a kill."""
    state = os.path.join(folder, "state.json")
    server = started(tool, folder, "--state", state)
    sender = running(server)
    time.sleep(0.2)
    kept = json.loads(pathlib.Path(state).read_text())
    require(kept["position_mm"] == [None] * 3 and (kept.get("machine"), kept.get("target")) == ("test", "sim"), kept)
    pathlib.Path(folder, "part.nc").write_text("G1 X1 F600\n")
    run = [tool, "run", os.path.join(folder, "part.nc"), "-m", MACHINE, "--state", state, "--quiet"]
    said = subprocess.run(run, capture_output=True, text=True, check=False, timeout=30)
    require(said.returncode == 2 and f"serve (process {server.process.pid}) keeps its state there" in said.stderr, said)
    server.process.kill()
    server.process.communicate()
    sender.close()
    server = started(tool, folder, "--state", state)
    sender = Sender(server)
    require(sender.report().startswith("<Alarm"), "it takes a place for known")
    sender.send(b"$X\n$H\n")
    sender.until("Idle")
    sender.close()
    end(server)
    kept = json.loads(pathlib.Path(state).read_text())
    require(kept["position_mm"] == [0.0] * 3, kept)
    kept["target"] = "modbus"
    text = json.dumps(kept)
    pathlib.Path(state).write_text(text)
    for command in (run, [tool, "serve", "-m", MACHINE, "--tcp", "127.0.0.1:0", "--state", state]):
        said = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False, timeout=30)
        require(said.returncode == 2 and "on --target modbus, not of " in said.stderr and said.stderr.count("\n") == 1, said)
    require(pathlib.Path(state).read_text() == text, "a simulation has written the machine's state")


def unwritable(tool, folder):
    """A state that can no longer be written ends the server: a machine that moves brakes first, and one that stands does not begin."""
    for moves in (True, False):
        kept = os.path.join(folder, f"kept{moves}")
        os.mkdir(kept)
        server = started(tool, folder, "--state", os.path.join(kept, "state.json"))
        sender = running(server, b"G1 X20 F6000\nG10 L2 P1 X1\nG1 X290 F1200\n") if moves else greeted(server)
        shutil.rmtree(kept)
        if not moves:
            sender.send(b"G1 X9 F600\n")
        told = server.process.communicate(timeout=10)[1]
        require(server.process.returncode == 2 and "state.json: cannot be written: " in told, told)
        try:
            while sender.read(1):
                pass
        except Failed:
            pass  # it is closed
        said = b"Grbl 1.1h" if moves else b"state.json: cannot be written"
        require(said in sender.text, f"the machine was not reset, or its sender not told: {sender.text}")
        sender.close()


def dead_link(tool, folder):
    """A link that is taken down: the machine is held, and given away. In a name space of its own."""
    clone_newuser, clone_newnet = 0x10000000, 0x40000000
    if os.geteuid() != 0:
        clone_newnet |= clone_newuser
    if not os.path.exists("/sbin/ip") or ctypes.CDLL(None, use_errno=True).unshare(clone_newnet) != 0:
        print("dead_link: not run: no name space of networks can be made here, or there is no ip (Debian: iproute2)")
        return
    subprocess.run(["/sbin/ip", "link", "set", "lo", "up"], check=True)
    server = started(tool, folder)
    sender = running(server, b"G1 X290 F600\n")
    subprocess.run(["/sbin/ip", "link", "set", "lo", "down"], check=True)
    time.sleep(5)
    subprocess.run(["/sbin/ip", "link", "set", "lo", "up"], check=True)
    heir = greeted(server)
    require(heir.line().startswith("[MSG:Held: ") and heir.report().startswith("<Hold:0"), "it is not held")
    place = heir.place()[0]
    require(place < 65.0, f"it went on to {place}: for longer than 4 s")
    sender.close()
    heir.close()
    end(server)


CASES = {case.__name__: case for case in (no_sender, drip, anybody, silent, unread, signals, killed, unwritable, dead_link)}


if __name__ == "__main__":
    sys.exit(run_cases(CASES, os.path.abspath(sys.argv[1]), sys.argv[2:]))
