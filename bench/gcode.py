#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Cycle times of programs in G-code, beside those of LinuxCNC, as a table in Markdown.

  bench/gcode.py FOLDER [--build build/release] [--judge CHECK_PATH.PY] [--jerk 30000] [--period 250] [--scalar double] [--only NAME ...]

FOLDER has the programs that are named below. Each is run in three path modes: its own G64 P is replaced by G64 P0.01, by G64 P0.05
and by G61. The machine has 100 mm/s and 1000 mm/s^2 on each axis (degrees on a). A printer's E is its axis a, and heaters and fans
are left out, as in the programs that LinuxCNC was given. --judge runs the judge on every trace: it prints the largest distance from
the programmed path, the stops that were missed and the largest use of a limit.

LinuxCNC's times were measured with LinuxCNC 2.9 (linuxcnc-uspace of Debian) on the same programs, in its simulated machine with the
same limits, acceleration-limited; version 2.9 has no jerk limit.
"""
import argparse
import json
import pathlib
import re
import subprocess
import sys
import tempfile

LINUXCNC_S = {  # P0.01, P0.05, G61
    "arcs_pocket.ngc": (15.53, 15.34, 14.60),
    "contour_pocket.ngc": (16.58, 16.17, 101.25),
    "corners.ngc": (12.74, 12.60, 13.05),
    "drill_cycles.ngc": (17.78, 17.80, 17.61),
    "engraving.ngc": (28.27, 26.50, 30.94),
    "modes.ngc": (5.94, 5.72, 6.04),
    "offsets_inch.ngc": (12.43, 12.39, 11.56),
    "raster_surface.ngc": (9.41, 8.85, 41.22),
    "splines_g5.ngc": (5.97, 5.72, 5.88),
    "vase_prusa.gcode": (50.83, 46.74, 49.17),
    "wrap_a.ngc": (22.25, 22.22, 28.39),
}
MODES = (("P 0.01", 0.01), ("P 0.05", 0.05), ("G61", None))
PRINTER = re.compile(r"^\s*(M10[4-9]|M140|M190|M8[2-4]|M117|G28|M20[1-5]|M73|M115|T\d)\b", re.I)


def machine_text(axes, jerk, period):
    text = f"sample_period_us = {period}\n\n[path]\nmax_feed_mm_s = 100\n"
    for axis in axes:
        text += f'\n[[axis]]\nname = "{axis}"\nmax_velocity_mm_s = 100\nmax_acceleration_mm_s2 = 1000\nsteps_per_mm = 320\n'
        text += f"max_jerk_mm_s3 = {jerk}\n" if jerk else ""
        text += 'kind = "rotary"\n' if axis == "a" else ""
    return text


def without_printer(text):
    """A printer's program for a control of machines: E becomes A, heaters and fans go."""
    rows = []
    for row in text.split("\n"):
        row = row.split(";")[0].strip()
        rows.append("" if PRINTER.match(row) else re.sub(r"\bE(?=[-+.\d])", "A", row))
    return "\n".join(rows)


def in_mode(text, tolerance):
    inch = "G20" in text and "G21" not in text.split("G64")[0]
    word = "G61" if tolerance is None else f"G64 P{tolerance / 25.4 if inch else tolerance:.6f}"
    changed, count = re.subn(r"G64\s*P\s*[\d.]+" + (r"(\s*Q\s*[\d.]+)?" if tolerance is None else ""), word, text, flags=re.I)
    return changed if count else word + "\n" + changed


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--build", type=pathlib.Path, default=pathlib.Path("build/release"))
    parser.add_argument("--judge", type=pathlib.Path)
    parser.add_argument("--jerk", type=float, help="mm/s^3 of each axis")
    parser.add_argument("--scalar", default="fixed")
    parser.add_argument("--period", type=int, default=250, help="sample_period_us")
    parser.add_argument("--only", nargs="*")
    options = parser.parse_args()
    tool = options.build / "bin" / "splinefeed"
    tool = tool if tool.exists() else options.build / "tool" / "bin" / "splinefeed"
    alone = options.jerk is not None  # LinuxCNC 2.9 has no jerk limit
    print("| program | " + " | ".join(name if alone else f"{name} | LinuxCNC | less" for name, _ in MODES) + " |")
    print("|---|" + ("---:|" if alone else "---:|---:|---:|") * len(MODES))
    sums = [[0.0, 0.0, 0.0, 0] for _ in MODES]  # what is less, ours, theirs, how many
    bad = []
    with tempfile.TemporaryDirectory() as folder:
        at = pathlib.Path(folder)
        for name, theirs in LINUXCNC_S.items():
            if options.only and name.split(".")[0] not in options.only:
                continue
            text = (options.folder / name).read_text(errors="replace")
            text = without_printer(text) if name.endswith(".gcode") else text
            axes = "xyza" if re.search(r"^[^(;]*\bA[-+.\d]", text, re.M) else "xyz"
            (at / "machine.toml").write_text(machine_text(axes, options.jerk, options.period))
            cells = []
            for k, (_, tolerance) in enumerate(MODES):
                (at / "program.ngc").write_text(in_mode(text, tolerance))
                command = [tool, "run", at / "program.ngc", "-m", at / "machine.toml", "--summary", "json", "--quiet", "--scalar",
                           options.scalar, "--trace", at / "t.csv", "--elements", at / "e.json"]
                run = subprocess.run(command, capture_output=True, text=True)
                if run.returncode != 0:
                    bad.append(f"{name} {MODES[k][0]}: {run.stderr.strip()}")
                    cells.append("-" if alone else f"- | {theirs[k]:.2f} | - ")
                    continue
                took = json.loads(run.stdout)["cycle_time_s"]
                less = 1.0 - took / theirs[k]
                sums[k] = [x + y for x, y in zip(sums[k], (less, took, theirs[k], 1))]
                cells.append(f"{took:.2f}" if alone else f"{took:.2f} | {theirs[k]:.2f} | {100 * less:.1f} %")
                if options.judge:
                    bad += judge(options, at, f"{name} {MODES[k][0]}", tolerance)
            print(f"| {name} | " + " | ".join(cells) + " |", flush=True)
    if alone:
        return report(bad)
    print("| sum | " + " | ".join(f"{ours:.2f} | {other:.2f} | {100 - 100 * ours / max(other, 1.0):.1f} %" for _, ours, other, _ in sums) + " |")
    print("| mean | " + " | ".join(f"| | {100 * less / max(n, 1):.1f} %" for less, _, _, n in sums) + " |")
    return report(bad)


def report(bad):
    for line in bad:
        print(line, file=sys.stderr)
    return 1 if bad else 0


def judge(options, at, name, tolerance):
    command = [options.judge, "--elements", at / "e.json", "--trace", at / "t.csv", "--vmax", "100", "--amax", "1000"]
    run = subprocess.run([str(x) for x in command], capture_output=True, text=True)
    if run.returncode != 0:
        return [f"{name}: the judge failed: {run.stderr.strip()[-200:]}"]
    found = json.loads(run.stdout)
    programmed = max([e["tolerance_mm"] for e in json.loads((at / "e.json").read_text())["elements"] if not e.get("rapid")] + [0.0])
    uses = {key: value for key, value in found.items() if key.startswith("use.") and isinstance(value, float)}
    worst = max(uses, key=uses.get, default="")
    problems = []
    if found["path_error_feed_mm"] > programmed + 0.001:
        problems.append(f"{found['path_error_feed_mm']:.5f} mm from the path at line {found['path_error_line']}")
    for key in ("corner_error_mm", "coverage_mm"):
        if found[key] > max(programmed, 0.1) + 0.001: # a corner of rapids has 0.1
            problems.append(f"{key} {found[key]:.5f}")
    if found["stops.missed"]:
        problems.append(f"stops missed: {found['stops.missed_lines']}")
    if found["dwell.shortest"] < 0.999:
        problems.append(f"a dwell is {found['dwell.shortest']:.3f} of what was programmed")
    if uses and uses[worst] > 1.0001:
        problems.append(f"{worst} {uses[worst]:.5f}")
    if found.get("feed.over", 0) > 1.0001:
        problems.append(f"feed.over {found['feed.over']:.4f}")
    return [f"{name}: {', '.join(problems)}"] if problems else []


if __name__ == "__main__":
    sys.exit(main())
