#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Makes every picture of the docs from data: make.py BUILD_DIRECTORY, or compares them with what is there: make.py --check BUILD_DIRECTORY.

What late.svg, linuxcnc_corner.svg and broken_link.svg show was measured: files beside them have the measurements. Numbers may differ by a tenth of a unit of the drawing. report.png is made by
chromium, motion.png and those of examples/python by matplotlib. Their fonts differ from machine to machine: they are made, and not compared."""
import os
import pathlib
import re
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
TOLERANCE = 0.11


def drawn(script, *arguments):
    return subprocess.run([sys.executable, HERE / script, *arguments], cwd=ROOT, check=True, capture_output=True, text=True).stdout


def pictures(tool):
    """(name, drawing) of each."""
    yield "curves.svg", drawn("curves.py", tool)
    yield "binding.svg", drawn("binding.py", "--tool", tool, "--machine", "examples/jerk_limited.toml", "--end", "2.6",
                               "examples/butterfly.json")
    yield "tolerance.svg", drawn("tolerance.py", tool)
    yield "late.svg", drawn("late.py", "docs/pictures/late.json")
    yield "linuxcnc_corner.svg", drawn("linuxcnc_corner.py", "docs/pictures/linuxcnc_corner.json")
    yield "broken_link.svg", drawn("tutorials.py", "broken_link", "docs/pictures/broken_link.json")
    for name in ("first_path", "steered", "edges", "windows"):
        yield f"{name}.svg", drawn("tutorials.py", name, tool)
    yield "linuxcnc_times.svg", drawn("linuxcnc_times.py", "hal/linuxcnc/README.md")


def same(made, there):
    """Equal, but for numbers that differ by no more than the tolerance."""
    number = re.compile(r"-?\d+\.?\d*")
    if number.sub("#", made) != number.sub("#", there):
        return False
    return all(abs(float(a) - float(b)) <= TOLERANCE for a, b in zip(number.findall(made), number.findall(there)))


def main():
    check = "--check" in sys.argv[1:]
    build = pathlib.Path([a for a in sys.argv[1:] if a != "--check"][0]).resolve()
    stale, names = [], set()
    for name, made in pictures(build / "bin" / "splinefeed"):
        names.add(name)
        file = HERE / name
        if not check:
            file.write_text(made)
        elif not file.exists() or not same(made, file.read_text()):
            stale.append(f"docs/pictures/{name} is not what is drawn today; docs/pictures/make.py {sys.argv[-1]} makes it anew")
    if not check:
        subprocess.run([HERE / "report.mjs", build], check=False)
        for example in [HERE / "motion.py", *sorted((ROOT / "examples/python").glob("*.py"))]:
            subprocess.run([sys.executable, example, HERE / f"{example.stem}.png"], check=False,
                           env=dict(os.environ, PYTHONPATH=str(build / "python"), MPLBACKEND="Agg"))
    stale += [f"docs/pictures/{file.name}: nothing makes it" for file in HERE.glob("*.svg") if file.name not in names]
    print("\n".join(stale) or f"{len(names)} pictures: {'as drawn today' if check else 'made'}")
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main())
