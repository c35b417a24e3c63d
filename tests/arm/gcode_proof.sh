#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The G-code interpreter on one microcontroller: the host's items, bit for bit, nothing forbidden, its size, and what a
# block costs in instructions: gcode_proof.sh CPU BUILD_DIRECTORY_OF_THE_HOST.
source "$(dirname "${BASH_SOURCE[0]}")/../tools/common.sh"
source tests/tools/said.sh
source tests/arm/build.sh

cpu=$1
host=$2
need arm-none-eabi-g++ qemu-system-arm
board=$(board_of "${cpu/%m0/m3}")

build=build/arm-$cpu
build_images "$cpu" "$build"
image=$build/bin/gcode_program.elf

symbols=$(arm-none-eabi-nm "$image" | awk '$2 != "A" { print $3 }')
if grep -E 'malloc|^_Zn[wa]|^__cxa_|[uU]nwind|df[23x]$|^__aeabi_(c?d[^i]|[fiul]+2[fd]$)' <<<"$symbols"; then
    echo "the image holds what firmware must not have"
    exit 1
fi
arm-none-eabi-size "$image"
output=$(timeout 60 qemu-system-arm -M "$board" -icount shift=10,sleep=off -nographic -monitor none -serial none \
    -chardev stdio,id=host -semihosting-config enable=on,target=native,chardev=host -kernel "$image")
echo "$output"
here=$(said 2 '^(items|hash) +0x' "$output")
there=$(said 2 '^(items|hash) +0x' "$("$host/bin/gcode_program")")
if ! diff <(echo "$here") <(echo "$there"); then
    echo "the host interprets otherwise"
    exit 1
fi
