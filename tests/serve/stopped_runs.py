#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Stops by wire at random times: stopped_runs.py TOOL [--runs N] [--long-runs N] [--seed S] [--modbus].

The served machine moves along a line in x and y. At a random time it is stopped in one of these ways. Until it stands the status is asked for; the time from
the first byte, or signal, to the first status at standstill is what is shown. On-path stops end on the line, and nothing moves after. --modbus: three simulated
drives; what their shafts do is in their records.
"""
import argparse
import contextlib
import os
import pathlib
import random
import re
import signal
import socket
import statistics
import struct
import sys
import tempfile
import time

from sender import Failed, Sender, ServedDrives, Server

MACHINE = str(pathlib.Path(__file__).resolve().parent / "machine.toml")
LONGEST_S = {False: 0.5, True: 1.0}  # on a busy host: 20 ms, or 400 ms of motion that drives hold, 100 ms of braking, what the host takes
BESIDE_MM = {False: 0.003, True: 0.01}  # of the line, where it is said in counts of drives


def standing(sender):
    """The place, once it stands."""
    until = time.monotonic() + 10
    while time.monotonic() < until:
        report = sender.report()
        if re.match(r"<(Hold:0|Door:0|Idle|Alarm)\|", report) and "|FS:0," in report:
            return [float(number) for number in re.search(r"MPos:([^|]*)", report).group(1).split(",")]
    raise Failed("it does not stand")


def take_again(server, sender, way):
    """Who looks where it stands: another sender, if this one has gone."""
    if way not in ("close", "reset"):
        return sender
    if way == "reset":
        sender.socket.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
    sender.close()
    return Sender(server)


WAYS = {"!": b"!", "0x18": b"\x18", "0x18 twice": b"\x18", "0x19": b"\x19", "0x84": b"\x84", "0x85": b"\x85", "SIGUSR1": b"", "close": b"", "reset": b""}


def stop(server, way, dice, modbus):
    sender = Sender(server)
    sender.send(b"\x18")
    time.sleep(0.05)
    sender.send(b"$X\nG90G53G0X10Y10\n")
    sender.until("Idle")
    sender.send(b"$J=X290Y150F6000\n" if way == "0x85" else b"G1X290Y150F6000\n")
    while sender.place()[0] < 10.5:
        time.sleep(0.01)
    time.sleep(dice.uniform(0.1, 1.6))
    begun = time.monotonic()
    if way == "SIGUSR1":
        server.process.send_signal(signal.SIGUSR1)
    elif WAYS[way]:
        sender.send(WAYS[way])
    if way == "0x18 twice":
        time.sleep(0.01)
        sender.send(b"\x18")
    sender = take_again(server, sender, way)
    place = standing(sender)
    took = time.monotonic() - begun
    beside = abs((place[1] - 10) - (place[0] - 10) * 0.5)
    if beside > BESIDE_MM[modbus] and way != "0x18 twice":
        raise Failed(f"{way}: {beside} mm beside the line, at {place}")
    if not 10.0 < place[0] < 290.0 or took > LONGEST_S[modbus]:
        raise Failed(f"{way}: at {place} after {took:.3f} s")
    time.sleep(0.15)
    place = sender.place() if modbus else place  # that of the shafts becomes that of the path's end
    time.sleep(0.15)
    if sender.place() != place:
        raise Failed(f"{way}: it moves after it stood")
    sender.send(b"\x18")
    time.sleep(0.05)
    sender.close()
    time.sleep(0.02)
    return took


@contextlib.contextmanager
def served(tool, folder, modbus):
    """A server with its machine."""
    if not modbus:
        yield Server(tool, folder, machine=MACHINE)
        return
    with ServedDrives(tool, folder) as drives:
        drives.serve()
        yield drives.server


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("tool")
    parser.add_argument("--runs", type=int, default=27)
    parser.add_argument("--long-runs", type=int, default=300)
    parser.add_argument("--seed", type=int, default=random.randrange(1 << 30))
    parser.add_argument("--modbus", action="store_true")
    given = parser.parse_args()
    runs = given.long_runs if os.environ.get("SPLINEFEED_LONG") == "1" else given.runs
    dice = random.Random(given.seed)
    times = {way: [] for way in WAYS}
    with tempfile.TemporaryDirectory() as folder, served(given.tool, folder, given.modbus) as server:
        try:
            for run in range(runs):
                way = list(WAYS)[run % len(WAYS)]
                times[way].append(stop(server, way, dice, given.modbus))
        except Failed as failure:
            print(f"seed {given.seed}: {failure}")
            return 1
        finally:
            server.end()
    for way, took in ((way, took) for way, took in times.items() if took):
        print(f"{way:<12} {len(took):3} stops, median {1000 * statistics.median(took):4.0f} ms, at most {1000 * max(took):4.0f} ms")
    return 0


if __name__ == "__main__":
    sys.exit(main())
