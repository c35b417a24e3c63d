#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The pulse train on one microcontroller: the host's steps and edges, bit for bit, nothing forbidden, and what it costs in
# instructions: pulse_proof.sh CPU BUILD_DIRECTORY_OF_THE_HOST. QEMU counts instructions, no cycles: the same every time.
source "$(dirname "${BASH_SOURCE[0]}")/../tools/common.sh"
source tests/arm/proof.sh "$@"

image=$build/bin/pulse_train.elf
forbids_all "$image"
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
# The code of a Cortex-M0 runs on a Cortex-M3, too; the board of the former has no SysTick.
board=$(board_of "${cpu/%m0/m3}")
output=$(run "$image" -icount shift=10,sleep=off)
echo "$output"
as_host 3 '^hash of [a-z]+ +0x' "$output" pulse_train
costs "$output"
