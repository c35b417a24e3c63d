#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The pulse train on one microcontroller: the host's steps and edges, bit for bit, nothing forbidden, and what it costs in
# instructions: pulse_proof.sh CPU BUILD_DIRECTORY_OF_THE_HOST. QEMU counts instructions, no cycles: the same every time.
source "$(dirname "${BASH_SOURCE[0]}")/../tools/common.sh"
source tests/tools/said.sh
source tests/arm/build.sh

cpu=$1
host=$2
need arm-none-eabi-g++ qemu-system-arm
# The code of a Cortex-M0 runs on a Cortex-M3, too; the board of the former has no SysTick.
board=$(board_of "${cpu/%m0/m3}")

build=build/arm-$cpu
build_images "$cpu" "$build"
image=$build/bin/pulse_train.elf

symbols=$(arm-none-eabi-nm "$image" | awk '$2 != "A" { print $3 }')
if grep -E 'malloc|^_Zn[wa]|^__cxa_|[uU]nwind|df[23x]$|^__aeabi_(c?d[^i]|[fiul]+2d$)' <<<"$symbols"; then
    echo "the image holds what firmware must not have"
    exit 1
fi
# 64 bit divisions say where an axis stands before the first segment; none is on the way of a step or an edge.
pulse_train=splinefeed/s5_pulse_train
for source in crossing monotone_parts step_dir_sequencer; do
    # A tree that was built before may keep the object of a source that is gone.
    test -f firmware_core/$pulse_train/$source.cpp
    undefined=$(arm-none-eabi-nm -u "$build/firmware_core/CMakeFiles/splinefeed_core.dir/$pulse_train/$source.cpp.obj")
    if grep ldivmod <<<"$undefined"; then
        echo "$source divides numbers of 64 bits"
        exit 1
    fi
done
output=$(timeout 60 qemu-system-arm -M "$board" -icount shift=10,sleep=off -nographic -monitor none -serial none \
    -chardev stdio,id=host -semihosting-config enable=on,target=native,chardev=host -kernel "$image")
echo "$output"
here=$(said 3 '^hash of [a-z]+ +0x' "$output")
there=$(said 3 '^hash of [a-z]+ +0x' "$("$host/bin/pulse_train")")
if ! diff <(echo "$here") <(echo "$there"); then
    echo "the host steps otherwise"
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
    at_most dda_tick 60
    at_most interval_step 150
fi
