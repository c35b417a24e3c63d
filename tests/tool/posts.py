#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Programs in the style of CAM systems, slicers and senders: what the tool makes of each.

posts/expected.txt has a line for each run: the file and its options, a bar, and what comes of it: the number of moves, of dwells and
events, where the last move ends and the box of all ends; or the sentence of the refusal. --write writes what comes, to be read before it is kept.

A second reader, tests/judge/program_ends.py, says where each move ends, of most programs; it has to be there.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "judge"))
from program_ends import NotUnderstood, program_ends  # noqa: E402

FOLDER = pathlib.Path(__file__).resolve().parent / "posts"
TABLE = FOLDER / "expected.txt"
NEAR_MM = 1e-6
LEAST_READ = 55  # runs that the second reader understands


def judged(arguments, places):
    """What differs from the second reader; None: it does not understand the program."""
    options = dict(zip(arguments, [*arguments[1:], ""]))
    if "--increments" in options:
        return None
    rows = [row for row in (FOLDER / arguments[0]).read_text().splitlines() if not ("--block-delete" in options and row.startswith("/"))]
    try:
        ends = program_ends("\n".join(rows), options.get("--dialect", "linuxcnc"),
                            [word.rstrip("*") for word in options.get("--ignore", "").split(",")])
    except NotUnderstood:
        return None
    for number, (end, place) in enumerate(zip(ends, places), 1):
        if any(abs(a - b) > NEAR_MM for a, b in zip(end, place)):
            return f"move {number} ends at {place}, and should at {end}"
    return "" if len(ends) == len(places) else f"{len(places)} moves, and should have {len(ends)}"


def outcome(tool, arguments):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "elements.json"
        call = subprocess.run([tool, "plan", *arguments, "--elements", str(path), "--quiet"], cwd=FOLDER, capture_output=True, text=True,
                              check=False)
        if call.returncode != 0:
            return call.stderr.strip().splitlines()[-1], None
        document = json.loads(path.read_text())
    places = [element["to"] for element in document["elements"]]
    text = [", ".join(f"{value:.3f}".rstrip("0").rstrip(".").replace("-0", "0", 1 if abs(value) < 0.0005 else 0) for value in place)
            for place in (places[-1], map(min, zip(*places)), map(max, zip(*places)))]
    return (f"{len(places)} moves, {len(document.get('dwells', []))} dwells, {len(document.get('events', []))} events, end {text[0]}, "
            f"box {text[1]} to {text[2]}"), judged(arguments, places)


def main():
    write = "--write" in sys.argv
    tool = str(pathlib.Path([word for word in sys.argv[1:] if word != "--write"][0]).resolve())
    lines = TABLE.read_text().splitlines()
    named = set()
    wrong = read = 0
    out = []
    for line in lines:
        if line.startswith("#") or not line:
            out.append(line)
            continue
        run, _, expected = line.partition(" | ")
        named.add(run.split()[0])
        seen, difference = outcome(tool, run.split())
        read += difference is not None
        if difference:
            wrong += 1
            print(f"{run}\n  {difference}")
        out.append(f"{run} | {seen}")
        if seen != expected:
            wrong += 1
            print(f"{run}\n  expected: {expected}\n  comes:    {seen}")
    missing = {path.name for path in FOLDER.iterdir()} - named - {TABLE.name}
    if missing:
        print(f"not in {TABLE.name}: {', '.join(sorted(missing))}")
    if write:
        TABLE.write_text("\n".join(out) + "\n")
    print(f"{len(named)} programs, {read} runs read by the second reader, {wrong} wrong")
    sys.exit(1 if (wrong or missing or read < LEAST_READ) and not write else 0)


if __name__ == "__main__":
    main()
