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

# Each block's cost stands below its text, the sum below all of them.
all=0
blocks=0
whole_nurbs=0
while read -r cost text; do
    figure "$text" "$cost"
    all=$((all + cost))
    blocks=$((blocks + 1))
    if [[ $text == G5.3 ]]; then whole_nurbs=$((cost)); fi
done < <(awk '/^cost +0x/ { print $2, text } { text = $0 }' <<<"$output")
figure mean "all / blocks"
figure mean_without_nurbs "(all - whole_nurbs) / (blocks - 1)"
figure ram "$(said 1 '^bytes of RAM +0x' "$output" | awk '{ print $NF }')"
stack_of '' "$output"
