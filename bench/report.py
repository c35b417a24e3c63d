#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What a report costs: bench/report.py BUILD_DIRECTORY [BLOCKS]: for some programs the time of planning, the time that the report adds, and the size of its
page; with chromium and the packages of the test report_bundle also the time until the page's first picture and until all of it, of a frame while it turns, and from a turn of the wheel to its frame, over the strips and over the picture."""
import json
import pathlib
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[1]
EXAMPLES = ROOT / "examples"
THREE, JERK = EXAMPLES / "three_axis.toml", EXAMPLES / "jerk_limited.toml"


def measured(tool, arguments, page):
    """Seconds without and with the report, the planning time and the summary."""
    took = []
    for report in ([], ["--report", page]):
        begin = time.perf_counter()
        out = subprocess.run([tool, "plan", *arguments, "--quiet", "--no-advice", "--summary", "json", *report], capture_output=True, check=True, text=True)
        took.append(time.perf_counter() - begin)
    return *took, json.loads(out.stdout)


def opened(packages, page):
    """Its times in a browser, as columns."""
    out = subprocess.run([ROOT / "bench" / "open_page.mjs", packages, page], capture_output=True, check=False, text=True)
    if out.returncode == 77:
        return "  " + out.stdout.strip()
    first, whole, frame, strips, picture = map(float, out.stdout.split())
    return f"{first:>9.2f} s{whole:>7.2f} s{frame:>7.0f} ms{strips:>10.0f} ms{picture:>8.0f} ms"


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    tool, blocks = build / "bin" / "splinefeed", sys.argv[2] if len(sys.argv) > 2 else "1000000"
    with tempfile.TemporaryDirectory() as folder:
        rings = pathlib.Path(folder, "rings.gcode")
        with open(rings, "w", encoding="ascii") as file:
            subprocess.run([ROOT / "bench" / "slicer.py", blocks], stdout=file, check=True)
        page = pathlib.Path(folder, "page.html")
        print(f"{'program':<16}{'motion':>12}{'planning':>12}{'run':>12}{'report adds':>13}{'page':>12}{'memory':>12}{'picture':>11}{'all':>9}{'turns':>10}{'wheel: strips':>13}{'picture':>11}")
        for program, machine, *more in (
            (EXAMPLES / "path61.csv", THREE),
            (EXAMPLES / "bracket.ngc", THREE),
            (EXAMPLES / "butterfly.json", JERK),
            (EXAMPLES / "raster3d.csv", THREE),
            (rings, THREE, "--dialect", "marlin", "--ignore", "E", "--scalar", "double"),
        ):
            without, with_report, summary = measured(tool, [program, "-m", machine, *more], page)
            print(f"{program.name:<16}{summary['cycle_time_s']:>10.1f} s{summary['planning_time_s']:>10.2f} s{without:>10.2f} s"
                  f"{with_report - without:>11.2f} s{page.stat().st_size / 1e6:>9.2f} MB{summary['peak_rss_bytes'] / 1e6:>9.0f} MB{opened(build / 'report_page', page)}", flush=True)


if __name__ == "__main__":
    main()
