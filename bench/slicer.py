#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""A printer's program on standard output: layers of a ring, as many blocks as are asked for.

    bench/slicer.py 1000000 | build/release/bin/splinefeed plan - --format gcode --dialect marlin --ignore E \\
        -m examples/three_axis.toml --scalar double --quiet --summary json

The planning time and the memory of the process are in the summary (planning_time_s, peak_rss_bytes)."""
import argparse
import math
import sys


def blocks(count):
    """Rings of lines that turn by 3 degrees, each with a wave in its radius, one above the other."""
    layer = 0
    while True:
        for step in range(121):
            if count == 0:
                return
            count -= 1
            angle = math.radians(3.0 * step)
            radius = 20.0 + 2.0 * math.sin(3.0 * angle + 0.1 * layer)
            place = f"X{100.0 + radius * math.cos(angle):.3f} Y{100.0 + radius * math.sin(angle):.3f}"
            yield f"G1 {place} E0.0321\n" if step else f"G1 {place} Z{0.2 + 0.2 * layer:.1f}\n"
        layer += 1


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("blocks", type=int)
    options = parser.parse_args()
    sys.stdout.write("G21\nG90\nM83\nG92 E0\nG1 F6000\n")
    for block in blocks(options.blocks):
        sys.stdout.write(block)


if __name__ == "__main__":
    main()
