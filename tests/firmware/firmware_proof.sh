#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The reference firmware of one board, or its Modbus drive: holds nothing forbidden, fits, and does in QEMU what it should:
# firmware_proof.sh CPU BUILD_DIRECTORY_OF_THE_HOST BOARD MACHINE_OF_QEMU|not-run [drive]
source "$(dirname "${BASH_SOURCE[0]}")/../tools/common.sh"
need python3
proof=${5:-firmware}
source tests/arm/proof.sh "$@"

# What is operated by senders has the core of degree 5; the nRF51 takes waypoints.
name=${proof}_$3
core=$build/firmware_core/CMakeFiles/splinefeed_core.dir
jerk=0
operated=0
if [[ $proof == drive ]]; then
    interrupt=drive/drive_main
    run=drive_run
    jerk=none
elif [[ $cpu == cortex-m0 ]]; then
    interrupt=waypoints/waypoint_main
    run=firmware_run
else
    interrupt=controller/controller_main
    run=operated_run
    core=$build/tests/arm/CMakeFiles/splinefeed_core_quintic.dir
    operated=1
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
    has() { if arm-none-eabi-nm "$image" | grep "$1" >/dev/null; then echo 1; else echo 0; fi; }
    points=$(has SplinePoints)
    values=$(has 10Expression)
    extends=$(has 10FanucWords)
    bytes=$frame
    for root in '' _ZN8firmware7on_tickEv; do
        bound=$(find "$core" "$build/examples/firmware/CMakeFiles/$name.dir" -name '*.ci' \
            -exec awk -v scalar=$scalar -v jerk=$jerk -v operated=$operated -v points="$points" -v values="$values" -v extends="$extends" -v root=$root -f tests/arm/stack.awk {} +)
        echo "$bound"
        bytes=$((bytes + $(number_said '^stack bound ([0-9]+) ' "$bound")))
    done
    room=$((0x$(arm-none-eabi-nm "$image" | awk '$3 == "stack_top" { print $1 }') - 0x$(arm-none-eabi-nm "$image" | awk '$3 == "stack_bottom" { print $1 }')))
    echo "stack $bytes of $room, at most"
    figure stack_bound "$bytes"
    if ((bytes > room)); then
        echo "the stack could overflow"
        exit 1
    fi
fi
read -r data bss < <(arm-none-eabi-size "$image" | awk 'NR == 2 { print $2, $3 }')
stack=$(arm-none-eabi-nm "$image" | awk '/ stack_(top|bottom)$/ { print "0x" $1 }' | sort -r | paste -sd -)
figure firmware.flash "$(awk -v name="$name.flash" '$1 == name { print $2 }' "$figures")"
figure ram "data + bss - ($stack)"
if [[ $4 == not-run ]]; then exit 0; fi
ran=0
python3 "tests/firmware/$run.py" "$host/bin/splinefeed" "$image" "$4" || ran=$?
if [[ $proof == drive || $ran != 0 && $ran != 77 ]]; then exit $ran; fi
status=0
output=$(python3 tests/firmware/cost_run.py "$image" "$4") || status=$?
echo "$output"
case $status in
    0) costs "$output" ;;
    77) printf '%s skipped\n' tick tick.longest late next.longest >>"$figures" ;;
    *) exit 1 ;;
esac
exit $ran
