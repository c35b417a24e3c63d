#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The reference firmware copied into a project of its own, as docs/how-to/port_to_a_board.md says, which adds a clean copy of this
# repository: its images are made, and no others.
source "$(dirname "${BASH_SOURCE[0]}")/../tools/common.sh"
need arm-none-eabi-g++

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/splinefeed"
git ls-files -z --cached --others --exclude-standard CMakeLists.txt cmake firmware_core hal |
    xargs --null cp --parents --target-directory="$scratch/splinefeed"
cp -r examples/firmware "$scratch/firmware"
cat >"$scratch/CMakeLists.txt" <<'PROJECT'
cmake_minimum_required(VERSION 3.22)
project(my_machine LANGUAGES CXX)
set(SPLINEFEED_MAX_AXES 3)
set(SPLINEFEED_MAX_DEGREE 5)
add_subdirectory(splinefeed)
add_subdirectory(firmware)
PROJECT
without=$(grep -v '^#' tests/arm/unused_quintic_sources.txt | paste -sd '|')
cd "$scratch" || exit
cmake -G Ninja -B build -DCMAKE_TOOLCHAIN_FILE=splinefeed/cmake/arm-none-eabi.cmake -DCMAKE_BUILD_TYPE=Release \
    -DSPLINEFEED_CPU=cortex-m3 -DSPLINEFEED_CORE_WITHOUT="$without"
cmake --build build
arm-none-eabi-size build/firmware/{firmware,drive}_lm3s6965.elf
