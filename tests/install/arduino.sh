#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The core as an Arduino library: Debian's arduino-builder compiles all of it and its example for a Cortex-M4F, and the sketch takes its
# axes where it says.
source "$(dirname "${BASH_SOURCE[0]}")/../tools/common.sh"

need arduino-builder arm-none-eabi-g++ qemu-system-arm
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cmake/packaging/arduino_library.py "$scratch/libraries" --degree 3

board=$scratch/hardware/splinefeed/arm
core=$board/cores/bare
mkdir -p "$core" "$scratch/build"
cp tests/install/arduino/{boards,platform}.txt "$board"
cp tests/install/arduino/{Arduino.h,main.cpp} "$core"
# The start-up code of the link proof. A sketch has objects that are built before main: the image gets a place for their constructors.
cp examples/firmware/memory.cpp tests/arm/target/{startup,semihosting}.cpp tests/arm/target/*.hpp tests/arm/{platform,write_number}.hpp "$core"
sed -e '/^ASSERT/d' \
    -e 's/^ *\.init_array : .*/.init_array : { first_constructor = .; KEEP(*(.init_array .init_array.*)) last_constructor = .; } > ROM/' \
    tests/arm/target/memory_map.ld >"$core/memory_map.ld"
grep --quiet first_constructor "$core/memory_map.ld"

arduino-builder -compile -hardware /usr/share/arduino-builder -hardware "$scratch/hardware" -tools /usr/bin \
    -libraries "$scratch/libraries" -fqbn splinefeed:arm:bare -build-path "$scratch/build" -warnings all \
    "$scratch/libraries/splinefeed/examples/step_dir/step_dir.ino"
said=$(timeout 1200 qemu-system-arm -M mps2-an386 -nographic -monitor none -serial none -chardev stdio,id=host \
    -semihosting-config enable=on,target=native,chardev=host -kernel "$scratch/build/step_dir.ino.elf")
echo "$said"
# 20, 10 and -5 mm, 80 steps a mm.
grep --line-regexp --fixed-strings -- ' 1600 800 -400' <<<"$said"
