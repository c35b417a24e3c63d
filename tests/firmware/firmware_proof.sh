#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The reference firmware of one board, or its Modbus drive: holds nothing forbidden, fits, and does in QEMU what it should:
# firmware_proof.sh CPU BUILD_DIRECTORY_OF_THE_HOST BOARD MACHINE_OF_QEMU|not-run [drive]
source "$(dirname "${BASH_SOURCE[0]}")/../tools/common.sh"
need python3
source tests/arm/proof.sh "$@"

name=${5:-firmware}_$3
interrupt=main
run=firmware_run
planless=0
if [[ $name == drive_* ]]; then
    interrupt=drive/drive_main
    run=drive_run
    planless=1
fi
image=$build/bin/$name.elf
forbids_all "$image"
# The interrupt divides nothing: its code is all in one source.
if arm-none-eabi-nm -u "$build/examples/firmware/CMakeFiles/$name.dir/$interrupt.cpp.obj" | grep -E '__.*(div|mod)'; then
    echo "the interrupt divides"
    exit 1
fi
# The deepest call of the main loop, the interrupt on top of it, and what the processor saves for that. No call by an address is in
# the interrupt, or this would fail. Soft float is in libgcc: no bound is known for its functions.
scalar=Fixed
frame=32
if [[ $cpu == cortex-m4f ]]; then
    scalar=float
    frame=104
fi
if [[ $cpu != cortex-m0 ]]; then
    bytes=$frame
    for root in '' _ZN8firmware7on_tickEv; do
        bound=$(find "$build/firmware_core" "$build/examples/firmware/CMakeFiles/$name.dir" -name '*.ci' \
            -exec awk -v scalar=$scalar -v smooth=0 -v planless=$planless -v root=$root -f tests/arm/stack.awk {} +)
        echo "$bound"
        bytes=$((bytes + $(number_said '^stack bound ([0-9]+) ' "$bound")))
    done
    room=$((0x$(arm-none-eabi-nm "$image" | awk '$3 == "stack_top" { print $1 }') - 0x$(arm-none-eabi-nm "$image" | awk '$3 == "stack_bottom" { print $1 }')))
    echo "stack $bytes of $room, at most"
    if ((bytes > room)); then
        echo "the stack could overflow"
        exit 1
    fi
fi
if [[ $4 != not-run ]]; then
    python3 "tests/firmware/$run.py" "$host/bin/splinefeed" "$image" "$4"
fi
