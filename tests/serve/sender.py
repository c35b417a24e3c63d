#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A server of the tool and a sender that is connected to it, for tests."""
import os
import pathlib
import re
import select
import signal
import socket
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "modbus"))
from drive_processes import Drive, started  # noqa: E402


class Failed(Exception):
    pass


class Server:
    """`splinefeed serve` with a TCP port and a pseudo terminal."""

    def __init__(self, tool, folder, *options, machine, stderr=subprocess.PIPE):
        self.pty = os.path.join(folder, "machine_pty")
        self.process = started([tool, "serve", "-m", machine, "--tcp", "127.0.0.1:0", "--pty", self.pty, *options],
                               stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=stderr, text=True)
        self.port = int(self.process.stdout.readline().rsplit(":", 1)[1])
        self.process.stdout.readline()

    def end(self, signals=1):
        """Its exit status, and what it has told."""
        for _ in range(signals):
            self.process.send_signal(signal.SIGINT)
        told = self.process.communicate(timeout=30)[1]
        return self.process.returncode, told


class ServedDrives:
    """Three simulated Modbus drives, and a server of the machine that they move: machine.toml with their addresses."""

    def __init__(self, tool, folder, keys="unit=1", profile="", extra=()):
        self.tool, self.folder, self.server = os.path.abspath(tool), folder, None
        self.drives = [Drive(self.tool, folder, k, 1, profile=profile, extra=extra) for k in range(3)]
        text = (HERE / "machine.toml").read_text()
        for name, drive in zip("xyz", self.drives):
            text = text.replace(f'name = "{name}"\n', f'name = "{name}"\ndrive = "{drive.tcp_address(keys)}"\n')
        self.machine = os.path.join(folder, "drives.toml")
        pathlib.Path(self.machine).write_text(text)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.server and self.server.process.poll() is None:
            self.server.process.kill()
        for drive in self.drives:
            if drive.process.poll() is None:
                drive.process.kill()

    def serve(self, *options):
        self.server = Server(self.tool, self.folder, "--target", "modbus", *options, machine=self.machine)

    def end(self, keep=False, signals=1):
        """Ends the server, which must end well, and the drives, if they are not kept."""
        status, told = self.server.end(signals)
        told = [line for line in told.splitlines() if not line.startswith("splinefeed: note: ")]
        problems = [] if keep else [problem for drive in self.drives for problem in drive.stop()]
        if status != 0 or told or problems:
            raise Failed(f"exit status {status}: {told} {problems}")

    def counts(self):
        """Where the shafts stand at the end of their records."""
        return [round(drive.shaft_rows()[-1][1]) for drive in self.drives]


class Sender:
    PATIENCE_S = 10.0

    def __init__(self, server, kind="tcp"):
        if kind == "tcp":
            self.socket = socket.create_connection(("127.0.0.1", server.port))
            self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)  # else a second byte waits for an answer to the first
            self.descriptor = self.socket.fileno()
        else:
            self.socket = None
            self.descriptor = os.open(server.pty, os.O_RDWR | os.O_NOCTTY)
        self.text = b""

    def send(self, data):
        os.write(self.descriptor, data)

    def read(self, seconds):
        """Whether something has come."""
        if not select.select([self.descriptor], [], [], max(seconds, 0.0))[0]:
            return False
        try:
            part = os.read(self.descriptor, 65536)
        except OSError:
            part = b""
        if not part:
            raise Failed("the server has closed the connection")
        self.text += part
        return True

    def line(self):
        """The next one, without its end."""
        until = time.monotonic() + self.PATIENCE_S
        while b"\n" not in self.text:
            if time.monotonic() > until or not self.read(until - time.monotonic()):
                raise Failed(f"nothing more is said: {self.text!r}")
        line, self.text = self.text.split(b"\n", 1)
        if not line.endswith(b"\r"):
            raise Failed(f"a line ends without a return: {line!r}")
        return line[:-1].decode()

    def report(self):
        """The status; what else is said meanwhile stays to be read."""
        kept, until = self.text, time.monotonic() + self.PATIENCE_S
        self.text = b""
        self.send(b"?")
        while time.monotonic() < until:
            found = re.search(rb"<[^>]*>\r\n", self.text)
            if found:
                self.text = kept + self.text[:found.start()] + self.text[found.end():]
                return found.group().decode().strip()
            self.read(0.1)
        raise Failed("no status comes")

    def until(self, state, seconds=60.0):
        until = time.monotonic() + seconds
        while True:
            report = self.report()
            if report[1:].split("|")[0] in state.split("|"):
                return report
            if time.monotonic() > until:
                raise Failed(f"never {state}: {report}")
            time.sleep(0.02)

    def place(self):
        return [float(number) for number in re.search(r"Pos:([^|>]*)", self.report()).group(1).split(",")]

    def close(self):
        if self.socket:
            self.socket.close()
        else:
            os.close(self.descriptor)


def run_cases(cases, tool, names):
    """Runs the cases of these names, or all, each in a folder of its own; the exit status."""
    failed = 0
    for name in names or cases:
        with tempfile.TemporaryDirectory() as folder:
            try:
                cases[name](tool, folder)
                print(f"{name}: passed", flush=True)
            except (Failed, OSError, subprocess.SubprocessError) as failure:
                failed += 1
                print(f"{name}: {type(failure).__name__}: {failure}", flush=True)
    return 1 if failed else 0
