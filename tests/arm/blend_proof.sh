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
if [[ $cpu == cortex-m4f ]]; then
    at_most corner 40300 "$output"
    at_most joint 199000 "$output"
    at_most chained_point 253500 "$output"
fi
