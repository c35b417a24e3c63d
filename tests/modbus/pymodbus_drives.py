#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A program through drives that were made from docs/reference/pvt_map.md alone, on pymodbus (pvt_server.py): `splinefeed link`, then
`splinefeed run`, judged by what those drives recorded. And with drives that make a mistake, which has to be found.

pymodbus_drives.py TOOL PROGRAM MACHINE [--drives 1|3] [--tolerance-mm T]

Exit status 77: skipped, with the reason (no pymodbus; a host that does not keep time)."""
import argparse
import os
import signal
import subprocess
import sys
import tempfile
import threading

from drive_processes import PymodbusDrive
from real_time import exit_status
from recorded_path import machine_file, run_and_judge


# What has to be said of each mistake; anything else would be another one.
NAMED = {
    "count": "is not the plan's",
    "shaft": "they end 1.0",
    "twice": "sequence numbers are missing, twice or out of order",
    "crc": "the checksum of its status is always wrong",
}


def started(folder, count, spoils=("", "", "")):
    """So many drives with three axes in all, and the address of each axis. Their clocks overflow on the way."""
    options = [["--clock-us", str(2**32 - 3_000_000), "--spoil", spoil] for spoil in spoils]
    drives = [PymodbusDrive(folder, k, 3 // count, options[k]) for k in range(count)]
    return drives, [f"{drive.tcp_address()}&axis={k}" for drive in drives for k in range(drive.axes)]


def link(options, folder):
    drives, _ = started(folder, 1)
    called = subprocess.run([options.tool, "link", "--target", drives[0].tcp_address(), "--seconds", "1"], capture_output=True,
                            text=True, timeout=60, check=False)
    drives[0].stop()
    print(called.stdout)
    if called.returncode != 0:
        return [f"link: exit status {called.returncode}: {called.stderr}"]
    expected = ["splinefeed-pvt version 1, 3 axes, ring of 512 segments", "high word first, as it must be", "lost: 0 of"]
    return [f"link does not say: {text}" for text in expected if text not in called.stdout]


def run(options, folder, program, spoils=("", "", ""), away_s=0.0, tolerance_mm=None):
    drives, addresses = started(folder, options.drives, spoils)
    machine, steps = machine_file(options.machine, folder, addresses)
    name = f"{options.drives} on pymodbus" + (f", with mistakes ({' '.join(spoils)})" if any(spoils) else "")
    if away_s:
        name += f", one away for {away_s} s"
        stopped = drives[-1].process
        for at, what in ((2.0, signal.SIGSTOP), (2.0 + away_s, signal.SIGCONT)):
            threading.Timer(at, stopped.send_signal, [what]).start()
    return run_and_judge(name, tolerance_mm or options.tolerance_mm, (1, 1) if away_s else (0, 0),
                         [options.tool, "run", program, "-m", machine], folder, steps, drives)


def main():
    parser = argparse.ArgumentParser()
    for name in ("tool", "program", "machine"):
        parser.add_argument(name, type=os.path.abspath)
    parser.add_argument("--drives", type=int, choices=[1, 3], default=1)
    parser.add_argument("--tolerance-mm", type=float, default=0.003)
    options = parser.parse_args()
    try:
        import pymodbus.server.async_io  # noqa: F401
        import serial_asyncio  # noqa: F401
    except ImportError as missing:
        print(f"SKIPPED: {missing} (Debian: apt-get install python3-pymodbus python3-serial-asyncio)")
        return 77
    return exit_status(lambda: all_runs(options))


def all_runs(options):
    with tempfile.TemporaryDirectory(prefix="splinefeed-pymodbus-") as folder:
        problems = link(options, folder) + run(options, folder, options.program)
        problems += run(options, folder, options.program, away_s=1.0)
        if options.drives == 3:
            # The last one is away and had less than the others, and the first one stops late: 80 ms off the path, but all
            # go on from where they stand, each to its end.
            problems += run(options, folder, options.program, ("late", "", "few"), 1.0, tolerance_mm=20)
        short = os.path.join(folder, "short.csv")
        with open(short, "w", encoding="ascii") as file:
            file.write("x,y,z\n0,0,0\n5,1,0\n9,7,3\n")
        problems += run(options, folder, short)
        for spoil, expected in NAMED.items():
            found = run(options, folder, short, [spoil] * 3)
            print(f"mistake {spoil}, found:", *found[:2], sep="\n    ")
            if not any(expected in str(text) for text in found):
                problems.append(f"drives make a mistake ({spoil}), and nobody says that {expected!r}; found: {found}")
    return problems


if __name__ == "__main__":
    sys.exit(main())
