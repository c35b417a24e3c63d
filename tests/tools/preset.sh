#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds another preset and runs its tests: preset.sh PRESET COMPILER. Compilers are compared: no test is longer with --long.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

need "$2"
cmake --preset "$1"
cmake --build --preset "$1"
SPLINEFEED_LONG=0 ctest --preset "$1" --parallel "$((2 * $(nproc)))"
