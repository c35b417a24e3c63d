#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Moves within a tolerance on one microcontroller: the host's Bezier points, bit for bit, nothing forbidden, and what a corner,
# a joint and a point of a chain cost in instructions: blend_proof.sh CPU BUILD_DIRECTORY_OF_THE_HOST. QEMU counts instructions,
# no cycles: the same every time.
source "$(dirname "${BASH_SOURCE[0]}")/../tools/common.sh"
source tests/arm/proof.sh "$@"

image=$build/bin/blended_path.elf
forbids_all "$image"
# The state takes more RAM than the board of the Cortex-M0 has; a Cortex-M3 executes the same instructions.
board=$(board_of "${cpu/%m0/m3}")
output=$(run "$image" -icount shift=4,sleep=off)
echo "$output"
as_host 3 '^hash of [a-z_]+ +0x' "$output" blended_path
costs "$output"
stack_of '' "$output"
figure state "$(number_said '^state ([0-9]+) bytes' "$output")"
core=$build/tests/arm/CMakeFiles/splinefeed_core_quintic.dir/__/__/firmware_core/splinefeed
bound=$(find "$core"/{s1_blended_path,s1_curve} "$build"/tests/arm/CMakeFiles/{blended_path,pipeline_platform}.dir -name '*.ci' \
    -exec awk -v scalar=Fixed -v jerk=none -f tests/arm/stack.awk {} +)
echo "$bound"
bytes=$(number_said '^stack bound ([0-9]+) ' "$bound")
figure stack_bound "$bytes"
room=$(number_said '^stack used .* of ([0-9]+) ' "$output")
if ((bytes > room)); then
    echo "the stack could overflow"
    exit 1
fi
