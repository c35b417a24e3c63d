#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The pipeline on one microcontroller: links without a library, holds nothing forbidden, fits, and plans what the host
# plans, on a stack that cannot overflow: link_proof.sh CPU BUILD_DIRECTORY_OF_THE_HOST.
source "$(dirname "${BASH_SOURCE[0]}")/../tools/common.sh"
source tests/arm/proof.sh "$@"

programs=(pipeline_fixed pipeline_fixed_jerk)
if [[ $cpu == cortex-m4f ]]; then programs+=(pipeline_float); fi
for program in "${programs[@]}"; do
    image=$build/bin/$program.elf
    echo "== $program on $cpu"
    forbids_all "$image"
    # The board of the Cortex-M0 has 16 KB of RAM: what needs more runs on a Cortex-M3, which executes the same instructions.
    board=$(board_of "$cpu")
    if [[ $cpu == cortex-m0 && $program == *_jerk ]]; then board=$(board_of cortex-m3); fi
    output=$(run "$image")
    echo "$output"
    as_host 2 '^(segments|hash) +0x' "$output" "$program"
    stack_of "$program." "$output"
    while read -r _ part bytes; do
        figure "$program.$part" "$bytes"
    done < <(grep '^bytes: ' <<<"$output")
    scalar=Fixed
    if [[ $program == *float* ]]; then scalar=float; fi
    jerk=0
    if [[ $program == *_jerk ]]; then jerk=1; fi
    bound=$(find "$build/firmware_core" "$build"/tests/arm/CMakeFiles/{"$program",pipeline_platform}.dir -name '*.ci' \
        -exec awk -v scalar=$scalar -v jerk=$jerk -f tests/arm/stack.awk {} +)
    echo "$bound"
    bytes=$(number_said '^stack bound ([0-9]+) ' "$bound")
    figure "$program.stack_bound" "$bytes"
    room=$(number_said '^stack used .* of ([0-9]+) ' "$output")
    if ((bytes > room)); then
        echo "the stack could overflow"
        exit 1
    fi
done
