#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The reference firmware of the Raspberry Pi Pico: holds nothing forbidden, fits, is in its UF2 file, and does in the emulator what it should, by UART0
# and by USB: firmware.sh BUILD_DIRECTORY_OF_THE_HOST
source "$(dirname "${BASH_SOURCE[0]}")/../../tools/common.sh"

need node npm python3
npm_packages tests/firmware/pico "$1/pico"
export SPLINEFEED_PICO=$1/pico
proof=pico
source tests/arm/proof.sh cortex-m0 "$1"

image=$build/bin/firmware_rp2040.elf
forbids_all "$image"
python3 tests/firmware/pico/uf2_test.py "$image" "$build/bin/firmware_pico.uf2"
for line in pico pico-usb; do
    python3 tests/firmware/operated_run.py "$host/bin/splinefeed" "$image" $line
done
