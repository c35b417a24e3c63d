#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What each stage of the pipeline costs on one microcontroller, and that it plans there what the host plans, bit for bit, and
# what it planned before (tests/arm/hashes.txt): stages_proof.sh CPU BUILD_DIRECTORY_OF_THE_HOST. QEMU counts instructions, no
# cycles: the same every time.
source "$(dirname "${BASH_SOURCE[0]}")/../tools/common.sh"
source tests/arm/proof.sh "$@"

image=$build/bin/stage_costs.elf
forbids_all "$image"
# The windows take more RAM than the board of the Cortex-M0 has; a Cortex-M3 executes the same instructions.
board=$(board_of "${cpu/%m0/m3}")
output=$(run "$image" -icount shift=4,sleep=off)
echo "$output"
as_host 4 '^(jerk )?(segments|hash) +0x' "$output" stage_costs
if ! diff <(said 4 '^(jerk )?(segments|hash) +0x' "$output") <(grep '^stage_costs ' tests/arm/hashes.txt | cut -d ' ' -f 2-); then
    echo "another motion than tests/arm/hashes.txt has: if that is meant, change the file and say why"
    exit 1
fi
costs "$output"
