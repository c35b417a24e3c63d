#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Moves within a tolerance on one microcontroller: the host's Bezier points, bit for bit, no double, no heap, and what a corner,
# a joint and a point of a chain cost in instructions: blend_proof.sh CPU BUILD_DIRECTORY_OF_THE_HOST. QEMU counts instructions,
# no cycles: the same every time.
source "$(dirname "${BASH_SOURCE[0]}")/../tools/common.sh"
source tests/tools/said.sh
source tests/arm/build.sh

cpu=$1
host=$2
need arm-none-eabi-g++ qemu-system-arm
# The state takes more RAM than the board of the Cortex-M0 has; a Cortex-M3 executes the same instructions.
board=$(board_of "${cpu/%m0/m3}")

build=build/arm-$cpu
build_images "$cpu" "$build"
image=$build/bin/blended_path.elf

symbols=$(arm-none-eabi-nm "$image" | awk '$2 != "A" { print $3 }')
if grep -E 'malloc|^_Zn[wa]|^__cxa_|[uU]nwind|df[23x]$|^__aeabi_(c?d[^i]|[fiul]+2d$)' <<<"$symbols"; then
    echo "the image holds what firmware must not have"
    exit 1
fi
arm-none-eabi-size "$image"
output=$(timeout 120 qemu-system-arm -M "$board" -icount shift=4,sleep=off -nographic -monitor none -serial none \
    -chardev stdio,id=host -semihosting-config enable=on,target=native,chardev=host -kernel "$image")
echo "$output"
here=$(said 3 '^hash of [a-z_]+ +0x' "$output")
there=$(said 3 '^hash of [a-z_]+ +0x' "$("$host/bin/blended_path")")
if ! diff <(echo "$here") <(echo "$there"); then
    echo "the host's path is another one"
    exit 1
fi

# at_most NAME INSTRUCTIONS
at_most() {
    local took
    took=$(number_said "^cost $1 ([0-9]+) " "$output")
    if ((took > $2)); then
        echo "$1 takes $took instructions, at most $2 were to be"
        exit 1
    fi
}
if [[ $cpu == cortex-m4f ]]; then
    at_most corner 45000
    at_most joint 280000
    at_most chained_point 365000
fi
