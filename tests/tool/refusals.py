#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What the tool says of wrong input, as data: refusals.py TOOL [--write] [FILE...], FILEs of tests/tool/refusals/.

Each line of such a file begins with what it is:

    # TEXT        a comment
    file NAME     a file of the rows below; its lines follow, each as "| LINE"
    $ COMMAND     what the rows below run, with splinefeed before it
    - LINE        the row has its last named file without this line; these lines together stand there once
    + LINE        and with this one in their place, or at its end
    > LINE        what it says, on one line, with exit status 2 ("1> LINE": 1); "..." is any text. It ends the row.

--write puts what the tool says now in the place of lines that differ: look at them before you commit them."""
import concurrent.futures
import itertools
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent / "refusals"
LONGEST = 270  # characters of a sentence: three lines of a terminal


def edited(name, lines, edits):
    """The lines of a file with the edits of a row."""
    out, at, i = list(lines), len(lines), 0
    while i < len(edits):
        gone = [line for sign, line in itertools.takewhile(lambda edit: edit[0] == "-", edits[i:])]
        new = [line for sign, line in itertools.takewhile(lambda edit: edit[0] == "+", edits[i + len(gone):])]
        if gone:
            places = [k for k in range(len(out)) if out[k:k + len(gone)] == gone]
            if len(places) != 1:
                raise ValueError(f"{name} has {len(places)} times {gone}")
            at = places[0]
        out[at:at + len(gone)] = new
        i += len(gone) + len(new)
    return out


class Row:
    def __init__(self, number, command, files, last, edits):
        self.number, self.command, self.expected, self.status = number, command, "", 2
        self.files = dict(files)
        if edits:
            self.files[last] = edited(last, files[last], edits)

    def said(self, tool):
        """(exit status, what it says)"""
        with tempfile.TemporaryDirectory(prefix="splinefeed_refusals_") as folder:
            for name, lines in self.files.items():
                (pathlib.Path(folder) / name).write_text("".join(line + "\n" for line in lines))
            done = subprocess.run(f"'{tool}' {self.command}", shell=True, cwd=folder, capture_output=True, text=True,
                                  stdin=subprocess.DEVNULL, timeout=60, check=False)
            left = sorted(set(p.name for p in pathlib.Path(folder).iterdir()) - set(self.files))
        return done.returncode, done.stdout + done.stderr + (f"and left {', '.join(left)}\n" if left else "")


def rows_of(path):
    files, edits, rows, last, command = {}, [], [], "", ""
    for number, line in enumerate(path.read_text().split("\n"), 1):
        head, _, rest = line.partition(" ")
        if head == "file":
            last = rest
            files[last] = []
        elif head == "|":
            files[last].append(rest)
        elif head == "$":
            command = rest
        elif head in ("-", "+"):
            edits.append((head, rest))
        elif head in (">", "1>"):
            row = Row(number, command, files, last, edits)
            row.expected, row.status = rest, 1 if head == "1>" else 2
            rows.append(row)
            edits = []
        elif line and head != "#":
            raise ValueError(f"line {number}: '{head}' begins no line of this kind")
    if edits or not rows:
        raise ValueError(f"{path.name} has no row, or its last one has no sentence")
    return rows


def pattern_of(line):
    return re.compile(re.escape(line).replace(re.escape("..."), ".*") + r"\n")


def main():
    arguments = [a for a in sys.argv[1:] if a != "--write"]
    tool = pathlib.Path(arguments[0]).resolve()
    paths = [HERE / name for name in arguments[1:]] or sorted(HERE.glob("*.txt"))
    rows = failed = 0
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        for path in paths:
            cases, lines = rows_of(path), path.read_text().split("\n")
            for row, (status, text) in zip(cases, pool.map(lambda row: row.said(tool), cases)):
                rows += 1
                if status == row.status and pattern_of(row.expected).fullmatch(text) and len(text) <= LONGEST:
                    continue
                failed += 1
                print(f"{path.name}:{row.number}: {row.command}\n  expected {row.status}: {row.expected}\n  it said {status}: {text.rstrip()}")
                lines[row.number - 1] = f"{'1' if status == 1 else ''}> {text.rstrip()}"
            if "--write" in sys.argv:
                path.write_text("\n".join(lines))
    print(f"{rows - failed} of {rows} rows are as expected")
    return 0 if rows > 0 and failed == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
