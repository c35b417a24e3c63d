#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds another preset and runs its tests: preset.sh PRESET COMPILER [--if-long].
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

if [[ ${3-} == --if-long && ${SPLINEFEED_LONG:-0} != 1 ]]; then skip "takes 5 minutes: ./check --long"; fi

preset=$1
need "$2"
# Sanitizers take several times as long: but with --long, of what is tested in every scalar Fixed alone, whose integers may
# overflow, nothing that waits for a pipe to fill, and neither whole programs nor the golden cases of the curves; what reads
# files has its fuzzers.
less=()
left_out=
if [[ $preset == asan && ${SPLINEFEED_LONG:-0} != 1 ]]; then
    less=(--exclude-regex ' - (double|float)$|the examples become tool paths')
    left_out='tool;methods'
fi
cmake --preset "$preset" -DSPLINEFEED_AREAS_LEFT_OUT="$left_out"
cmake --build --preset "$preset"
ctest --preset "$preset" --parallel "$(nproc)" "${less[@]}"
