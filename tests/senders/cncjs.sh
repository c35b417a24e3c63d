#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# CNCjs, a sender of G-code from npm, operates a served machine by a pseudo terminal, and the reference firmware of the LM3S6965 in QEMU: cncjs.sh BUILD_DIRECTORY.
source "$(dirname "${BASH_SOURCE[0]}")/../tools/common.sh"

source tests/arm/build.sh

need node npm python3 arm-none-eabi-g++ qemu-system-arm
folder=$1/cncjs
npm_packages tests/senders "$folder"
build_images cortex-m3 build/arm-cortex-m3
exec tests/senders/cncjs_runs.mjs "$folder" "$1/bin/splinefeed" build/arm-cortex-m3/bin/firmware_lm3s6965.elf
