#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Programs on many machines, planned by a cluster of Dask: a table of cycle times, and of what limits each.

sweep.py MACHINE.toml PROGRAM... --vary KEY=LOW:HIGH:COUNT... [--csv TABLE.csv] [--scheduler ADDRESS] [--dialect NAME]

KEY is as `splinefeed plan --set` has it; `axis.*.` means each axis. Each combination of the values is a machine. Without --scheduler
this computer's processors do it. Workers need the module, but neither the machine nor the programs as files.
"""
from __future__ import annotations

import argparse
import csv
import itertools
import pathlib
import sys
from collections.abc import Iterator
from typing import NamedTuple, Union

import numpy as np
from distributed import as_completed, Client, Future

import splinefeed

Row = dict[str, Union[str, float]]
OF_A_PLAN = ["time_s", "optimum_time_s", "limit", "share", "stopped", "error"]


class Variation(NamedTuple):
    """Values of a key."""

    key: str
    values: list[float]

    @classmethod
    def parse(cls, text: str) -> Variation:
        """KEY=LOW:HIGH:COUNT."""
        key, _, span = text.partition("=")
        try:
            low, high, count = span.split(":")
            return cls(key, [float(value) for value in np.linspace(float(low), float(high), int(count))])
        except ValueError:
            raise argparse.ArgumentTypeError(f"'{text}' must be KEY=LOW:HIGH:COUNT") from None


def machines_of(file: str, variations: list[Variation]) -> Iterator[tuple[Row, splinefeed.Machine]]:
    """Each combination of values, and the machine that has them."""
    axes = splinefeed.Machine.from_toml(file).axes
    for values in itertools.product(*(one.values for one in variations)):
        settings: dict[str, float] = {}
        for (key, _), value in zip(variations, values):
            settings.update({f"axis.{axis}.{key[7:]}": value for axis in axes} if key.startswith("axis.*.") else {key: value})
        yield dict(zip((one.key for one in variations), values)), splinefeed.Machine.from_toml(file, set=settings)


def planned(program: str, machine: splinefeed.Machine, dialect: str | None) -> Row:
    """What the table says of one plan. What cannot be planned is a row, too."""
    try:
        motion = splinefeed.plan_gcode(program, machine, dialect=dialect)
    except splinefeed.Error as error:
        return {"error": str(error)}
    limits, counts = np.unique(motion.binding, return_counts=True)
    most = int(np.argmax(counts))
    optimum = motion.summary["optimum_time_s"]
    return {"time_s": motion.time, "optimum_time_s": "" if optimum is None else optimum, "limit": str(limits[most]),
            "share": round(counts[most] / counts.sum(), 3), "stopped": motion.stopped}


def text_of(program: str) -> str:
    """A program as a task of its own: it goes to each worker once, and a worker that dies does not lose it."""
    return program


def rows_of(client: Client, machines: list[tuple[Row, splinefeed.Machine]], programs: dict[str, str], dialect: str | None) -> Iterator[Row]:
    """The rows, as they become known. What a worker had when it died is planned by another one."""
    keys: dict[Future, Row] = {}
    for name, program in programs.items():
        text = client.submit(text_of, program)
        for values, machine in machines:
            keys[client.submit(planned, text, machine, dialect, pure=False)] = {"program": name, **values}
    for future, row in as_completed(list(keys), with_results=True):
        yield {**keys.pop(future), **row}


def main() -> None:
    """Reads the arguments, writes the table and how far it is."""
    reader = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    reader.add_argument("machine")
    reader.add_argument("program", nargs="+")
    reader.add_argument("--vary", action="append", type=Variation.parse, required=True, metavar="KEY=LOW:HIGH:COUNT")
    reader.add_argument("--csv", default="-", metavar="TABLE.csv")
    reader.add_argument("--scheduler", metavar="ADDRESS")
    reader.add_argument("--dialect")
    given = reader.parse_args()
    try:
        machines = list(machines_of(given.machine, given.vary))
        programs = {name: pathlib.Path(name).read_text(encoding="utf-8") + "\n" for name in given.program}
    except (splinefeed.Error, OSError, UnicodeError) as error:
        reader.error(str(error))
    total = len(programs) * len(machines)
    with open(given.csv, "w", newline="", encoding="utf-8") if given.csv != "-" else sys.stdout as out, Client(given.scheduler) as client:
        table = csv.DictWriter(out, ["program", *(one.key for one in given.vary), *OF_A_PLAN])
        table.writeheader()
        for done, row in enumerate(rows_of(client, machines, programs, given.dialect), 1):
            table.writerow(row)
            out.flush()
            print(f"\r{done} of {total}", end="" if done < total else "\n", file=sys.stderr, flush=True)


if __name__ == "__main__":
    main()
