#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The pipeline on one microcontroller: links without a library, holds nothing forbidden, fits, and plans what the host
# plans, on a stack that cannot overflow: link_proof.sh CPU BUILD_DIRECTORY_OF_THE_HOST.
source "$(dirname "${BASH_SOURCE[0]}")/../tools/common.sh"

cpu=$1
host=$2
need arm-none-eabi-g++ qemu-system-arm
case $cpu in
    cortex-m0) board=microbit ;;
    cortex-m3) board=mps2-an385 ;;
    cortex-m4f) board=mps2-an386 ;;
esac

build=build/arm-$cpu
cmake --preset arm -B "$build" -DSPLINEFEED_CPU="$cpu"
cmake --build "$build"

# Heap, exceptions, C++ run-time, arithmetic in double. Absolute symbols (type A) are no code.
forbidden='malloc|calloc|realloc|^free$|^_Zn[wa]|^_Zd[la]|^__cxa_|^__gxx_|[uU]nwind|^abort$|^__aeabi_atexit$'
forbidden+='|^__aeabi_(c?d[^i]|[fiul]+2d$)|df[23x]$|^__(float|extend|fix|trunc).*df'
# The board of the Cortex-M0 has 16 KB of RAM: what needs more runs on a Cortex-M3, which executes the same instructions.
run() {
    local on=$board
    if [[ $cpu == cortex-m0 && $1 == *_jerk.elf ]]; then on=mps2-an385; fi
    timeout 60 qemu-system-arm -M "$on" -nographic -monitor none -serial none -chardev stdio,id=host \
        -semihosting-config enable=on,target=native,chardev=host -kernel "$1"
}

for image in "$build"/bin/pipeline_*.elf; do
    program=$(basename "$image" .elf)
    echo "== $program on $cpu"
    if arm-none-eabi-nm "$image" | awk '$2 != "A" { print $3 }' | grep -E "$forbidden"; then
        echo "the image holds what firmware must not have"
        exit 1
    fi
    arm-none-eabi-size "$image"
    output=$(run "$image")
    echo "$output"
    if ! diff <(grep -E '^(segments|hash)' <<<"$output") <("$host/bin/$program" | grep -E '^(segments|hash)'); then
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
    bytes=$(sed -n 's/^stack bound \([0-9]*\) .*/\1/p' <<<"$bound")
    room=$(sed -n 's/^stack used .* of \([0-9]*\) .*/\1/p' <<<"$output")
    if ((bytes > room)); then
        echo "the stack could overflow"
        exit 1
    fi
done
