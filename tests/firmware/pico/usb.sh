#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The Pico's serial port by USB, in the emulator: usb.sh BUILD_DIRECTORY. The packages are in BUILD_DIRECTORY/pico.
source "$(dirname "${BASH_SOURCE[0]}")/../../tools/common.sh"

need node npm arm-none-eabi-g++
npm_packages tests/firmware/pico "$1/pico"
export SPLINEFEED_PICO=$PWD/$1/pico
if [[ $1 == /* ]]; then SPLINEFEED_PICO=$1/pico; fi

image=$SPLINEFEED_PICO/usb_echo.elf
arm-none-eabi-g++ -std=c++20 -Os -mcpu=cortex-m0plus -mthumb -Wall -Wextra -Wconversion -Wshadow -Werror -fno-exceptions -fno-rtti -fno-threadsafe-statics \
    -fno-tree-loop-distribute-patterns -nostdlib -Iexamples/firmware -Ifirmware_core -T tests/firmware/pico/self_test.ld -o "$image" \
    tests/firmware/pico/usb_echo.cpp examples/firmware/rp2040/{usb_serial,boot2}.cpp examples/firmware/memory.cpp -lgcc
node tests/firmware/pico/usb_test.mjs "$image"
