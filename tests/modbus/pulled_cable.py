#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A program through three simulated drives, those of which that are "far" behind a switch, in a network name space. The cable
behind the switch is pulled for a while, silently: nothing is reset or refused, nothing arrives. Or our cable loses, delays and
reorders frames. The run must go on where it was, on the path.

pulled_cable.py TOOL PROGRAM MACHINE [--far 1|3] [--away-s S | --netem "loss 3% delay 2ms 1ms"] [--tolerance-mm T]

Exit status 77: skipped, with the reason (no root, no ip from iproute2, a kernel without name spaces or netem)."""
import argparse
import ipaddress
import os
import shutil
import subprocess
import sys
import tempfile
import threading
import time

from drive_processes import Drive
from real_time import exit_status
from recorded_path import machine_file, run_and_judge

PULLED_AT_S = 1.5


def ip(*words):
    """Nothing, or why it cannot be done."""
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    return "" if done.returncode == 0 else f"{' '.join(words)}: {done.stderr.strip()}"


class Cable:
    """From here (address .1) over a switch to a name space (address .2)."""

    def __init__(self):
        number = os.getpid() % 32768  # as many pairs of names, and networks of four addresses in 198.18/15, which is for tests
        self.space, self.switch = f"sf{number}", f"sfs{number}"
        self.near, self.port, self.behind, self.far = (f"sf{end}{number}" for end in "npbf")
        net = ipaddress.IPv4Address("198.18.0.0") + 4 * number
        self.here, self.there = str(net + 1), str(net + 2)

    def __enter__(self):
        self.missing = ""
        for words in (f"netns add {self.space}", f"netns add {self.switch}",
                      f"-n {self.switch} link add sfbridge type bridge",
                      f"link add {self.near} type veth peer name {self.port} netns {self.switch}",
                      f"-n {self.switch} link add {self.behind} type veth peer name {self.far} netns {self.space}",
                      f"-n {self.switch} link set {self.port} master sfbridge up",
                      f"-n {self.switch} link set {self.behind} master sfbridge up",
                      f"-n {self.switch} link set sfbridge up",
                      f"address add {self.here}/30 dev {self.near}", f"link set {self.near} up",
                      f"-n {self.space} address add {self.there}/30 dev {self.far}",
                      f"-n {self.space} link set lo up", f"-n {self.space} link set {self.far} up"):
            self.missing = self.missing or ip("ip", *words.split())
        return self

    def __exit__(self, *_):
        for space in (self.space, self.switch):  # and with them what is in them
            ip("ip", "netns", "del", space)

    def connected(self):
        shown = subprocess.run(["ip", "netns", "exec", self.space, "ss", "-Htn", "state", "established"],
                               capture_output=True, text=True, check=False)
        return shown.returncode != 0 or shown.stdout.strip() != ""

    def pull_later(self, seconds):
        """PULLED_AT_S after a drive behind the switch has been connected: a busy host begins late."""
        for _ in range(600):
            if self.connected():
                break
            time.sleep(0.05)
        time.sleep(PULLED_AT_S)
        self.pull(seconds)

    def pull(self, seconds):
        for state in ("down", "up"):
            if why := ip("ip", "-n", self.switch, "link", "set", self.behind, state):
                print(why)
            if state == "down":
                time.sleep(seconds)

    def disturb(self, how):
        """Both ways. Nothing, or why not."""
        return ip("tc", "qdisc", "add", "dev", self.near, "root", "netem", *how.split()) or \
            ip("tc", "-n", self.space, "qdisc", "add", "dev", self.far, "root", "netem", *how.split())


def run(options, cable, tolerance_mm, asked):
    with tempfile.TemporaryDirectory(prefix="splinefeed-cable-") as folder:
        far = [k >= 3 - options.far for k in range(3)]
        drives = [Drive(options.tool, folder, k, 1, listen=f"tcp://{cable.there if far[k] else '127.0.0.1'}:0",
                        under=["ip", "netns", "exec", cable.space] if far[k] else [], extra=["--allow-remote"])
                  for k in range(3)]
        machine, steps = machine_file(options.machine, folder, [drive.tcp_address() for drive in drives])
        puller = threading.Thread(target=cable.pull_later, args=[options.away_s])
        if options.away_s:
            puller.start()
        name = f"{options.far} of 3 drives far, " + (f"pulled for {options.away_s} s" if options.away_s else options.netem)
        try:
            return run_and_judge(name, tolerance_mm, asked, [options.tool, "run", options.program, "-m", machine], folder,
                                 steps, drives)
        finally:
            if options.away_s:
                puller.join()


def main():
    parser = argparse.ArgumentParser()
    for name in ("tool", "program", "machine"):
        parser.add_argument(name, type=os.path.abspath)
    parser.add_argument("--far", type=int, choices=[1, 3], default=1)
    parser.add_argument("--away-s", type=float, default=0.0)
    parser.add_argument("--netem", default="")
    parser.add_argument("--tolerance-mm", type=float, default=0.006)
    options = parser.parse_args()
    if os.geteuid() != 0 or shutil.which("ip") is None or shutil.which("tc") is None:
        print("SKIPPED: needs root, and ip and tc (Debian: iproute2), to lay a cable into a network name space")
        return 77
    with Cable() as cable:
        why = cable.missing or (cable.disturb(options.netem) if options.netem else "")
        if why:
            print(f"SKIPPED: this host does not let us: {why}")
            return 77
        return exit_status(lambda: run(options, cable, options.tolerance_mm, (1, 1) if options.away_s else (0, 0)))


if __name__ == "__main__":
    sys.exit(main())
