#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The G-code interpreter on one microcontroller: the host's items, bit for bit, nothing forbidden, its size, and what a
# block costs in instructions: gcode_proof.sh CPU BUILD_DIRECTORY_OF_THE_HOST.
source "$(dirname "${BASH_SOURCE[0]}")/../tools/common.sh"
source tests/arm/proof.sh "$@"

image=$build/bin/gcode_program.elf
forbids_all "$image" '^__aeabi_[iul]+2f$'
# The code of a Cortex-M0 runs on a Cortex-M3, too; the board of the former has no SysTick.
board=$(board_of "${cpu/%m0/m3}")
output=$(run "$image" -icount shift=10,sleep=off)
echo "$output"
as_host 2 '^(items|hash) +0x' "$output" gcode_program
