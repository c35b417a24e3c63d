#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds another preset and runs its tests: preset.sh PRESET COMPILER [--if-long].
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

if [[ ${3-} == --if-long && ${SPLINEFEED_LONG:-0} != 1 ]]; then skip "takes 5 minutes: ./check --long"; fi

preset=$1
need "$2"
cmake --preset "$preset"
cmake --build --preset "$preset"
# Sanitizers take several times as long: but with --long, of what is tested in every scalar Fixed alone, whose integers may
# overflow, and nothing that waits for a pipe to fill or runs whole tool paths.
less=()
if [[ $preset == asan && ${SPLINEFEED_LONG:-0} != 1 ]]; then
    less=(--exclude-regex ' - (double|float)$|A pipe moves the machine|the examples become tool paths')
fi
ctest --preset "$preset" --parallel "$(nproc)" "${less[@]}"
