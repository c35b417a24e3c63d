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

# at_most_hex NAME LIMIT: a value that the program says in 16 digits to the base 16
at_most_hex() {
    local line
    line=$(said 1 "^$1 +0x" "$output")
    if ((${line##* } > $2)); then
        echo "$1 is $((${line##* })), at most $2 was to be"
        exit 1
    fi
}
at_most_hex 'bytes of RAM' 2048
if [[ $cpu == cortex-m4f ]]; then at_most_hex 'cost of all' 431000; fi
