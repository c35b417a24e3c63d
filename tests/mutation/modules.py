# SPDX-License-Identifier: MIT
"""Modules: sources whose mutants have to be noticed, by which test programs."""
import dataclasses
import pathlib

CORE = "firmware_core/splinefeed"


@dataclasses.dataclass
class Module:
    name: str
    sources: tuple  # patterns, below the root
    tests: tuple  # (program, filter of Catch2), the quickest first
    host: bool = False  # whether the tests need the simulated machine and drives
    surveyed: bool = False  # whether survivors.txt has all of its survivors: then another one is an error

    def files(self, root):
        return sorted(str(path.relative_to(root)) for pattern in self.sources for path in pathlib.Path(root).glob(pattern))


MODULES = (
    Module("feed plan", tuple(f"{CORE}/s3_feed_plan/{room}/*.cpp" for room in ("limits", "steering", "acceleration")),
           (("feed_plan_tests", "~[jerk]"), ("stream_tests", "~[jerk],[starvation]")), surveyed=True),
    Module("optimal plan", (f"{CORE}/s3_feed_plan/jerk/*.cpp",),
           (("feed_plan_tests", "[jerk]"), ("stream_tests", "[jerk],[starvation],[urgent]")), surveyed=True),
    Module("segment stream", (f"{CORE}/s4_segment_stream/*.cpp",), (("stream_tests", "~[jerk]"), ("stream_tests", "[jerk]~[steering],a pause by*,an override of a long*")), surveyed=True),
    Module("pulse train", (f"{CORE}/s5_pulse_train/*.cpp",), (("pulse_tests", ""),), surveyed=True),
    Module("ports", ("hal/splinefeed/hal/modbus/*/*.cpp", "hal/splinefeed/hal/*.cpp", "hal/splinefeed/hal/rt/motion_clock.cpp"),
           (("hal_tests", ""), ("drive_tests", "Blocks on*,Segment track*,Cyclic*,Target frames*"), ("ports_tests", ""), ("modbus_tests", "")), host=True, surveyed=True),
)
