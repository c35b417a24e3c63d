#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The pipeline on one microcontroller: links without a library, holds nothing forbidden, fits, and plans what the host
# plans, on a stack that cannot overflow: link_proof.sh CPU BUILD_DIRECTORY_OF_THE_HOST.
source "$(dirname "${BASH_SOURCE[0]}")/../tools/common.sh"
source tests/tools/said.sh
source tests/arm/build.sh

cpu=$1
host=$2
need arm-none-eabi-g++ qemu-system-arm
board=$(board_of "$cpu")

build=build/arm-$cpu
build_images "$cpu" "$build"

# Heap, exceptions, C++ run-time, arithmetic in double. Absolute symbols (type A) are no code.
forbidden='malloc|calloc|realloc|^free$|^_Zn[wa]|^_Zd[la]|^__cxa_|^__gxx_|[uU]nwind|^abort$|^__aeabi_atexit$'
forbidden+='|^__aeabi_(c?d[^i]|[fiul]+2d$)|df[23x]$|^__(float|extend|fix|trunc).*df'
# The board of the Cortex-M0 has 16 KB of RAM: what needs more runs on a Cortex-M3, which executes the same instructions.
run() {
    local on=$board
    if [[ $cpu == cortex-m0 && $1 == *_jerk.elf ]]; then on=$(board_of cortex-m3); fi
    timeout 60 qemu-system-arm -M "$on" -nographic -monitor none -serial none -chardev stdio,id=host \
        -semihosting-config enable=on,target=native,chardev=host -kernel "$1"
}

programs=(pipeline_fixed pipeline_fixed_jerk)
if [[ $cpu == cortex-m4f ]]; then programs+=(pipeline_float); fi
for program in "${programs[@]}"; do
    image=$build/bin/$program.elf
    echo "== $program on $cpu"
    symbols=$(arm-none-eabi-nm "$image" | awk '$2 != "A" { print $3 }')
    if grep -E "$forbidden" <<<"$symbols"; then
        echo "the image holds what firmware must not have"
        exit 1
    fi
    arm-none-eabi-size "$image"
    output=$(run "$image")
    echo "$output"
    here=$(said 2 '^(segments|hash) +0x' "$output")
    there=$(said 2 '^(segments|hash) +0x' "$("$host/bin/$program")")
    if ! diff <(echo "$here") <(echo "$there"); then
        echo "the host plans another motion"
        exit 1
    fi
    scalar=Fixed
    if [[ $program == *float* ]]; then scalar=float; fi
    smooth=0
    if [[ $program == *_jerk ]]; then smooth=1; fi
    bound=$(find "$build/firmware_core" "$build"/tests/arm/CMakeFiles/{"$program",pipeline_platform}.dir -name '*.ci' \
        -exec awk -v scalar=$scalar -v smooth=$smooth -f tests/arm/stack.awk {} +)
    echo "$bound"
    bytes=$(number_said '^stack bound ([0-9]+) ' "$bound")
    room=$(number_said '^stack used .* of ([0-9]+) ' "$output")
    if ((bytes > room)); then
        echo "the stack could overflow"
        exit 1
    fi
done
