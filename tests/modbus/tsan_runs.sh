#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Threads under the thread sanitizer: the ring between two of them, steering from another one, tests of the link, of the drives and of
# GPIO lines, runs with faults, and a served machine on drives.
source "$(dirname "${BASH_SOURCE[0]}")/../tools/common.sh"

need clang++ /usr/bin/python3

cmake --preset tsan
cmake --build --preset tsan --target splinefeed base_tests firmware_tests modbus_tests drive_tests gpio_tests serve_tests
export TSAN_OPTIONS="exitcode=66 second_deadlock_stack=1"
build=build/tsan
"$build"/bin/base_tests "[ring]"
"$build"/bin/firmware_tests "[steering]"
"$build"/bin/modbus_tests
"$build"/bin/drive_tests
"$build"/bin/gpio_tests
"$build"/bin/serve_tests
/usr/bin/python3 tests/modbus/three_drives.py "$build"/bin/splinefeed examples/path61.csv examples/three_axis.toml --tolerance-mm 1 --slow
/usr/bin/python3 tests/modbus/faulted_runs.py "$build"/bin/splinefeed --runs 12 --jobs 2
/usr/bin/python3 tests/serve/target_runs.py "$build"/bin/splinefeed
