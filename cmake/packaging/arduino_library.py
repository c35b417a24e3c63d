#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The core as a library for Arduino: arduino_library.py FOLDER. Put the folder that it makes, FOLDER/splinefeed, into `libraries` of the sketchbook.

An Arduino library is compiled as a whole, from `src`, which is its include path as well. The sketch cannot define anything for it, so
the capacities are those of the options: --axes 3 --degree 5 is what a program in G-code with three axes needs.
"""
import argparse
import pathlib
import re
import shutil

ROOT = pathlib.Path(__file__).resolve().parents[2]

PROPERTIES = """name=splinefeed
version={version}
author=the splinefeed authors
maintainer=the splinefeed authors
sentence=Waypoints, lines, arcs and G-code become smooth motion within the limits of every axis.
paragraph=G2 curves, jerk-limited feed planning, step pulses: without heap, exceptions and floating point. Needs C++20.
category=Device Control
url=https://github.com/splinefeed/splinefeed
architectures=*
includes=splinefeed.h
"""

HEADER = """// SPDX-License-Identifier: MIT
// The Arduino IDE wants a header in this folder.
#pragma once

#include "splinefeed/splinefeed.hpp"
"""


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("folder", type=pathlib.Path)
    options.add_argument("--axes", type=int, default=3, choices=range(1, 7), help="largest number of axes (default 3)")
    options.add_argument("--degree", type=int, default=5, choices=range(3, 10), help="largest degree of a segment (default 5)")
    wanted = options.parse_args()
    library = wanted.folder / "splinefeed"
    if library.exists():
        options.error(f"{library} exists already")
    shutil.copytree(ROOT / "firmware_core/splinefeed", library / "src/splinefeed")
    shutil.copytree(ROOT / "examples/arduino", library / "examples")
    shutil.copy(ROOT / "LICENSE", library)
    version = re.search(r"VERSION (\d+\.\d+\.\d+)", (ROOT / "CMakeLists.txt").read_text())[1]
    (library / "library.properties").write_text(PROPERTIES.format(version=version))
    (library / "src/splinefeed.h").write_text(HEADER)
    capacity = library / "src/splinefeed/base/capacity.hpp"
    text = capacity.read_text()
    for name, value in (("SPLINEFEED_MAX_AXES", wanted.axes), ("SPLINEFEED_MAX_DEGREE", wanted.degree)):
        text, times = re.subn(rf"(#define {name}) \d+", rf"\1 {value}", text)
        assert times == 1, name
    capacity.write_text(text)


if __name__ == "__main__":
    main()
