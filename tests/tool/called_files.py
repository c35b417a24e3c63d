#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Whether a subprogram is the same in a file of its own as in the program: random programs in two dialects, with their subprograms in the program,
and with some of them in files beside it and in two folders. Moves, dwells and events must be equal, but for their lines: those of a file have
the line of the program that called it.

    called_files.py TOOL [--programs 12] [--seed N]"""
import argparse
import json
import pathlib
import random
import subprocess
import sys
import tempfile

FOLDERS = ("main", "one", "two")  # in the order of search
LINES = {"line_number", "line"}


class Program:
    """Subprograms of random lines; each calls only those behind it, so that there is an end."""

    def __init__(self, seed, fanuc):
        self.random, self.fanuc = random.Random(seed), fanuc
        self.names = self.random.sample(range(1, 9999), 4) if fanuc else ["a-b", "hole", "grid_2", "77"]
        self.subs = {name: self.begin(name) + self.body(k + 1) + self.end(name) for k, name in enumerate(self.names)}
        self.main = ["G21 G90 G0 F900", *self.body(0, 5), *(self.call(name) for name in self.names), "G90 G0 X0 Y0"]

    def begin(self, name):
        return [f"O{name:04}"] if self.fanuc else [f"o<{name}> sub"]

    def end(self, name):
        return ["M99"] if self.fanuc else [f"o<{name}> endsub"]

    def call(self, name):
        if not self.fanuc:
            return f"o<{name}> call [{self.random.randint(1, 9)}]"
        return self.random.choice((f"M98 P{name} L{self.random.randint(1, 2)}", f"G65 P{name} A{self.random.randint(1, 9)}.", f"G91 X1. M98 P{name}"))

    def body(self, first, lines=4):
        out = []
        for k in range(lines):
            x, y = (self.random.randint(-20, 20) for _ in "xy")
            out += self.random.choice((
                [f"G90 G1 X{x}. Y{y}."], [f"G91 G0 X{x}. Y{y}."], ["G90 G1 X[#100 + 1]", "#100=[#100 + 2]"] if k else ["#100=3"], ["G4 P1", "M8"],
                ["WHILE [#101 LT 2] DO1", "G91 G1 Y1.", "#101=[#101 + 1]", "END1", "#101=0"] if self.fanuc else
                ["M73", "o5 repeat [2]", "G91 G1 X1.", "o5 endrepeat"],
                [self.call(self.random.choice(self.names[first:]))] if first < len(self.names) else ["(nothing)"]))
        return ["#100=1", "#101=0", *out]

    def texts(self, in_files):
        """The program with the other subprograms, and its files."""
        inside = [line for name in self.names if name not in in_files for line in self.subs[name]]
        before = [] if self.fanuc or self.random.random() < 0.5 else inside
        files = {}
        for name, folder in in_files.items():
            shown = self.random.choice((f"O{name:04}.nc", f"O{name:05}.nc")) if self.fanuc else f"{name}.ngc"
            files[folder, shown] = "\n".join(["(no part of it)", *self.subs[name], *([] if self.fanuc else ["G0 X777"]), ""])
            for later in FOLDERS[FOLDERS.index(folder) + 1:]:
                files[later, shown] = "\n".join([*self.begin(name), "G0 X888.", *self.end(name), ""])
        return "\n".join([*before, *self.main, "M30", *([] if before else inside), ""]), files


def without_lines(value):
    if isinstance(value, dict):
        return {key: without_lines(part) for key, part in value.items() if key not in LINES}
    return [without_lines(part) for part in value] if isinstance(value, list) else value


def lines_of(value):
    parts = value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
    own = {value[key] for key in LINES if key in value} if isinstance(value, dict) else set()
    return own.union(*(lines_of(part) for part in parts))


def planned(tool, folder, text, files, fanuc):
    for name in FOLDERS:
        (folder / name).mkdir(parents=True)
    for (where, name), lines in files.items():
        (folder / where / name).write_text(lines)
    (folder / "main" / "part.ngc").write_text(text)
    call = subprocess.run([tool, "plan", "main/part.ngc", "--dialect", "fanuc" if fanuc else "linuxcnc", "--subprograms", "one:two", "--quiet",
                           "--elements", "-"], cwd=folder, capture_output=True, text=True, check=False)
    if call.returncode:
        raise AssertionError(call.stderr)
    return json.loads(call.stdout)


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("tool", type=lambda path: str(pathlib.Path(path).resolve()))
    arguments.add_argument("--programs", type=int, default=12)
    arguments.add_argument("--seed", type=int, default=random.randrange(10**6))
    arguments = arguments.parse_args()
    wrong = moves = 0
    for seed in range(arguments.seed, arguments.seed + arguments.programs):
        program = Program(seed, seed % 2 == 0)
        in_files = {name: program.random.choice(FOLDERS) for name in program.random.sample(program.names, program.random.randint(1, 4))}
        with tempfile.TemporaryDirectory() as top:
            try:
                whole, parts = (planned(arguments.tool, pathlib.Path(top) / str(k), *program.texts(these), program.fanuc)
                                for k, these in enumerate(({}, in_files)))
            except AssertionError as error:
                wrong += 1
                print(f"seed {seed}: {error}")
                continue
        moves += len(whole["elements"])
        lines = program.texts(in_files)[0].count("\n")
        if without_lines(whole) != without_lines(parts) or max(lines_of(parts)) > lines:
            wrong += 1
            print(f"seed {seed}: the motion is another one, or a line is none of the program")
    print(f"{arguments.programs} programs, {moves} moves, {wrong} wrong")
    return 1 if wrong or moves == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
