# SPDX-License-Identifier: MIT
"""Runs of a program on one simulated drive, for x and y, and a device on Modbus that is not ours: a server on pymodbus."""
import os
import subprocess
import sys
import threading
import time

from drive_processes import Drive, machine_text, write
from real_time import HostWatch

STEPS = 320
AXIS = f"max_velocity_mm_s = 100\nmax_acceleration_mm_s2 = 1000\nsteps_per_mm = {STEPS}\n"
RUN = ("run", "part.ngc", "-m", "machine.toml", "--target", "modbus")


class Peer:
    def __init__(self, script, *options):
        server = os.path.join(os.path.dirname(os.path.abspath(__file__)), script)
        self.process = subprocess.Popen([sys.executable, server, *options], stdout=subprocess.PIPE, text=True)
        self.address = "modbus-" + self.process.stdout.readline().split("listening on ")[1].split(",")[0]


def write_peer_machine(folder, head, drive):
    addresses = [f"{drive.tcp_address()}&axis={k}" for k in range(2)]
    write(folder, "machine.toml", machine_text([(name, AXIS) for name in "xy"], addresses, head))


class PeerRun:
    """One run. head: of its machine file; cause: what is done on its way, a function of the run, when due() returns."""

    def __init__(self, tool, folder, peer, head, program, cause=None, faults=""):
        self.peer = peer
        self.drive = Drive(tool, folder, 0, 2, faults=faults)
        self.times = []
        write_peer_machine(folder, head, self.drive)
        write(folder, "part.ngc", program)
        self.process = subprocess.Popen([tool, *RUN], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        if cause:
            threading.Thread(target=lambda: (self.due(), cause(self)), daemon=True).start()
        with HostWatch() as self.host:
            self.output, self.errors = self.process.communicate(timeout=100)
        self.ended = time.monotonic()
        time.sleep(0.3)
        peer.process.kill()
        peer.process.wait()
        self.drive.stop()
        begin = self.drive.start_s()
        self.axes = [[begin + row[0], row[1] / STEPS, row[2] / STEPS] for row in self.drive.shaft_rows()]

    def tell(self, what):
        self.times.append(time.monotonic())
        self.process.send_signal(what)

    def expect(self, status, *texts):
        problems = [] if self.process.returncode == status else [f"exit status {self.process.returncode}: {self.errors}"]
        return problems + [f"it does not say {text!r}: {self.errors}" for text in texts if text not in self.errors]
