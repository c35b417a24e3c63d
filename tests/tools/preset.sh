#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds another preset and runs its tests: preset.sh PRESET COMPILER [many]. With `many`, random tests run all of their rounds.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

need "$2"
cmake --preset "$1"
cmake --build --preset "$1"
SPLINEFEED_LONG=$([[ ${3-} == many ]] && echo 1 || echo 0) ctest --preset "$1" --parallel "$((2 * $(nproc)))"
