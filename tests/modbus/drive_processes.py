# SPDX-License-Identifier: MIT
"""Simulated drives as processes, and what they recorded."""
import atexit
import contextlib
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time

UNITS = 3 << 30  # of a feed segment, in a count
TICKS_PER_S = 8e6
FIRST_SEQUENCE = 1  # of a run; 0: positions are not the machine's yet


def started(command, **options):
    """A process that does not outlive this one, whatever fails."""
    process = subprocess.Popen(command, **options)
    atexit.register(process.kill)
    return process


class DriveProcess:
    """A program that plays a drive: it prints where it listens, and ends and writes its records at SIGTERM."""

    def __init__(self, command, folder, index, axes):
        self.name = os.path.join(folder, f"drive{index}")
        self.axes = axes
        command = [*command, "--axes", str(axes), "--record", self.name + ".csv"]
        with open(self.name + ".err", "w", encoding="utf-8") as errors:
            self.process = started(command, stdout=subprocess.PIPE, stderr=errors, text=True, cwd=folder)
        self.line = self.process.stdout.readline()

    def tcp_address(self, keys="unit=1"):
        return "modbus-" + self.line.split("listening on ")[1].split(",")[0] + "?" + keys

    def stop(self):
        """Nothing, or what it said when its exit status is not 0."""
        self.process.send_signal(signal.SIGTERM)
        if (status := self.process.wait(timeout=60)) == 0:
            return []
        with open(self.name + ".err", encoding="utf-8") as errors:
            return [f"{self.name}: exit status {status}: {errors.read()}"]

    def shaft_rows(self):
        """[t, a0, a1, ...] a row; t in s of its own time."""
        return numbers(self.name + ".csv")

    def start_s(self):
        """CLOCK_MONOTONIC where its time is 0."""
        with open(self.name + ".csv", encoding="ascii") as file:
            for row in file:
                if row.startswith("# t = 0 is CLOCK_MONOTONIC"):
                    return float(row.split()[-2])
        raise ValueError("the record does not say when it begins")

    def executed(self):
        """[sequence, duration_ticks, a0_end, a0_v_end, ..., t_end] a row, as texts."""
        return fields(self.name + "_segments.csv")


class Drive(DriveProcess):
    """`splinefeed drive`, on a port of its own or on a serial line."""

    def __init__(self, tool, folder, index, axes, listen="tcp://127.0.0.1:0", faults="", profile="", position=0, under=(),
                 extra=()):
        """under: what runs the tool, a command; extra: options of the drive."""
        command = [*under, tool, "drive", "--listen", listen, *extra]
        command += ["--profile", profile] if profile else \
                   ["--record-segments", os.path.join(folder, f"drive{index}_segments.csv")]
        if position:
            command += ["--position", str(position)]
        if faults:
            command += ["--faults", faults]
        super().__init__(command, folder, index, axes)


class PymodbusDrive(DriveProcess):
    """pvt_server.py: one that others could have made from the document of the map."""

    def __init__(self, folder, index, axes, options=()):
        server = os.path.join(os.path.dirname(os.path.abspath(__file__)), "pvt_server.py")
        segments = os.path.join(folder, f"drive{index}_segments.csv")
        super().__init__([sys.executable, server, "--record-segments", segments, *options], folder, index, axes)


def machine_text(axes, drives, head=""):
    """A machine file: `axes` a list of (name, keys), `drives` one address each."""
    text = head
    for (name, keys), drive in zip(axes, drives):
        text += f"[[axis]]\nname = \"{name}\"\ndrive = \"{drive}\"\n{keys}"
    return text


def write(folder, name, text):
    with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
        file.write(text)


def write_machine(folder, axes, drives, head, profile=""):
    """machine.toml: a drive an axis, each with this profile and what stands behind it; "" is splinefeed-pvt."""
    keys = f"profile={profile}" if profile else "unit=1"
    write(folder, "machine.toml", machine_text(axes, [drive.tcp_address(keys) for drive in drives], head))


def numbers(path):
    with open(path, encoding="ascii") as file:
        return [[float(x) for x in row.split(",")] for row in file if row[0].isdigit()]


def fields(path):
    with open(path, encoding="ascii") as file:
        return [row.strip().split(",") for row in file if row[0].isdigit()]


def nearest(value, divisor):
    return (2 * value + divisor) // (2 * divisor)


def sequence_problems(executed, plan, axes, done, who):
    """What a drive executed against the plan's segments (rows of --segments): by number, each once, as planned.

    axes: which of the machine's axes the drive has."""
    if [int(row[0]) for row in executed] != list(range(FIRST_SEQUENCE, FIRST_SEQUENCE + len(executed))):
        return [f"{who}: sequence numbers are missing, twice or out of order"]
    if len(executed) > len(plan) or (done and len(executed) < len(plan)):
        return [f"{who} executed {len(executed)} of {len(plan)}"]
    for row, segment in zip(executed, plan):
        ticks = int(segment[1])
        if abs(int(row[1]) - ticks) > ticks // 4000 + 1:
            return [f"{who}, {row[0]}: a duration of {row[1]} ticks, not {ticks}"]
        for j, axis in enumerate(axes):
            end = nearest(int(segment[3 + 4 * axis]), UNITS >> 16)
            velocity = nearest(int(segment[5 + 4 * axis]), UNITS >> 24)
            if (int(row[2 + 2 * j]), int(row[3 + 2 * j])) != (end, velocity):
                return [f"{who}, {row[0]}: {row} is not the plan's {segment}"]
    return []


def wait_for(path, seconds=5.0):
    until = time.monotonic() + seconds
    while not os.path.exists(path):
        if time.monotonic() > until:
            raise OSError(f"{path} does not come")
        time.sleep(0.02)


@contextlib.contextmanager
def serial_cable(ends):
    """Two devices of these names: what is written to the one is read from the other."""
    with subprocess.Popen(["socat", *[f"pty,raw,echo=0,link={end}" for end in ends]]) as process:
        try:
            for end in ends:
                wait_for(end)
            yield
        finally:
            process.terminate()


@contextlib.contextmanager
def folder_with_cables(wire, count):
    """A folder, and in it the ends (ours, the drive's) of a cable a drive; none of them where the wire is not rtu."""
    with tempfile.TemporaryDirectory(prefix="splinefeed-drives-") as folder, contextlib.ExitStack() as cables:
        ends = [[os.path.join(folder, f"{side}{k}") for side in "AB"] for k in range(count if wire == "rtu" else 0)]
        for pair in ends:
            cables.enter_context(serial_cable(pair))
        yield folder, ends


def missing_for(wire):
    """Why runs on this wire have to be skipped, or nothing."""
    lacks = wire == "rtu" and shutil.which("socat") is None
    return "SKIPPED: there is no socat, which lays a serial cable between two processes" if lacks else ""
