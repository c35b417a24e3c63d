#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The reference firmware of one board: holds nothing forbidden, fits, and does in QEMU what it should:
# firmware_proof.sh CPU BUILD_DIRECTORY_OF_THE_HOST BOARD MACHINE_OF_QEMU
source "$(dirname "${BASH_SOURCE[0]}")/../tools/common.sh"
need python3
source tests/arm/proof.sh "$@"

image=$build/bin/firmware_$3.elf
forbids_all "$image"
python3 tests/firmware/firmware_run.py "$host/bin/splinefeed" "$image" "$4"
