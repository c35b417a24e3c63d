#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds another preset and runs its tests: preset.sh PRESET COMPILER [--if-long].
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

if [[ ${3-} == --if-long && ${SPLINEFEED_LONG:-0} != 1 ]]; then skip "takes 5 minutes: ./check --long"; fi

preset=$1
need "$2"
# Sanitizers take several times as long: but with --long the core alone, its tests and the fuzzer of the pulse train, in Fixed, whose integers may
# overflow, where a test is made in every scalar; and nothing that takes ten seconds then.
less=()
host=ON
if [[ $preset == asan && ${SPLINEFEED_LONG:-0} != 1 ]]; then
    slow='long straight lines|no node can be faster, braking apart|straight moves take the time of the trapezoid'
    slow+='|the work per cell does not depend|axes that turn round included|cells of wandering curves'
    less=(--exclude-regex " - (double|float)$|$slow")
    host=OFF
fi
cmake --preset "$preset" -DSPLINEFEED_HOST=$host
cmake --build --preset "$preset"
ctest --preset "$preset" --parallel "$(nproc)" "${less[@]}"
