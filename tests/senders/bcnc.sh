#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Debian's bCNC, a sender of G-code, on a screen that nobody sees, operates a served machine by TCP and by a pseudo terminal, and the reference firmware of
# the LM3S6965 in QEMU: bcnc.sh TOOL.
# Its web page listens on all addresses without a password: a network of its own has no others.
source "$(dirname "${BASH_SOURCE[0]}")/../tools/common.sh"

source tests/arm/build.sh

need bCNC Xvfb unshare ip /usr/bin/python3 arm-none-eabi-g++ qemu-system-arm
if ! unshare --user --map-root-user --net true 2>/dev/null; then skip "there are no unprivileged name spaces"; fi
build_images cortex-m3 build/arm-cortex-m3
# shellcheck disable=SC2016 # for that shell
exec unshare --user --map-root-user --net bash -c 'ip link set lo up && exec /usr/bin/python3 -B tests/senders/bcnc_runs.py "$@"' bcnc "$(realpath "$1")" \
    build/arm-cortex-m3/bin/firmware_lm3s6965.elf
