#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The threads of the buses under the thread sanitizer: tests of the link, of the drives and of GPIO lines, and runs with faults.
source "$(dirname "${BASH_SOURCE[0]}")/../tools/common.sh"

need clang++ /usr/bin/python3

cmake --preset tsan
cmake --build --preset tsan --target splinefeed modbus_tests drive_tests gpio_tests
export TSAN_OPTIONS="exitcode=66 second_deadlock_stack=1"
build=build/tsan
"$build"/bin/modbus_tests
"$build"/bin/drive_tests
"$build"/bin/gpio_tests
/usr/bin/python3 tests/modbus/three_drives.py "$build"/bin/splinefeed examples/path61.csv examples/three_axis.toml --tolerance-mm 1 --slow
/usr/bin/python3 tests/modbus/faulted_runs.py "$build"/bin/splinefeed --runs 12 --jobs 2
