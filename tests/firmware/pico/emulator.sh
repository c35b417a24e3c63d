#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The emulated Pico keeps time as the chip does, and a UF2 file is what its ELF is: emulator.sh BUILD_DIRECTORY. Leaves the packages in BUILD_DIRECTORY/pico.
source "$(dirname "${BASH_SOURCE[0]}")/../../tools/common.sh"

need node npm python3 arm-none-eabi-g++
npm_packages tests/firmware/pico "$1/pico"
export SPLINEFEED_PICO=$1/pico

image=$SPLINEFEED_PICO/self_test
arm-none-eabi-g++ -std=c++20 -O2 -ffreestanding -mcpu=cortex-m0plus -mthumb -Wall -Wextra -Werror -fno-exceptions -fno-rtti -nostdlib \
    -T tests/firmware/pico/self_test.ld -o "$image.elf" tests/firmware/pico/self_test.cpp examples/firmware/rp2040/boot2.cpp
# As uf2_file() of examples/firmware/CMakeLists.txt
arm-none-eabi-objcopy -O binary "$image.elf" "$image.bin"
arm-none-eabi-gcc -c "-DIMAGE=\"$image.bin\"" examples/firmware/rp2040/uf2.S -o "$image.o"
arm-none-eabi-objcopy -O binary -j .uf2 --set-section-flags .uf2=alloc "$image.o" "$image.uf2"

python3 tests/firmware/pico/uf2_test.py "$image.elf" "$image.uf2"
node tests/firmware/pico/emulator_test.mjs "$image.elf" "$image.uf2"
node tests/firmware/pico/processor_test.mjs
python3 tests/firmware/pico/board_in_node_test.py "$image.elf"
