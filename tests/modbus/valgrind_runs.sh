#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs on simulated drives, the tool and the drives each under valgrind: no invalid access, no leak. valgrind_runs.sh BUILD
source "$(dirname "${BASH_SOURCE[0]}")/../tools/common.sh"

need valgrind /usr/bin/python3

tool=$1/bin/splinefeed
under="valgrind --quiet --error-exitcode=99 --leak-check=full --errors-for-leak-kinds=definite --fair-sched=yes"
# Nobody keeps time under valgrind, so the tolerance is no figure of the path; what was executed is judged as ever.
/usr/bin/python3 tests/modbus/three_drives.py "$tool" examples/path61.csv examples/three_axis.toml --tolerance-mm 1 --slow --under "$under"
/usr/bin/python3 tests/modbus/faulted_runs.py "$tool" --runs 12 --jobs 2 --under "$under" --later 2
