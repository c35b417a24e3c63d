#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds another preset and runs its tests: preset.sh PRESET COMPILER [--if-long].
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

if [[ ${3-} == --if-long && ${SPLINEFEED_LONG:-0} != 1 ]]; then skip "takes 5 minutes: ./check --long"; fi

preset=$1
need "$2"
cmake --preset "$preset"
cmake --build --preset "$preset"
ctest --preset "$preset" --parallel "$(nproc)"
