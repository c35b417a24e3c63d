#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# add_subdirectory of a clean copy of this repository, with the capacities of a small machine and without some of what the program does
# not use. What degree 3 cannot have is compiled all the same, without a warning.
source "$(dirname "${BASH_SOURCE[0]}")/../tools/common.sh"

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/splinefeed"
git ls-files -z --cached --others --exclude-standard CMakeLists.txt cmake firmware_core hal |
    xargs --null cp --parents --target-directory="$scratch/splinefeed"
cp tests/install/core.cpp "$scratch"
cat >"$scratch/CMakeLists.txt" <<'PROJECT'
cmake_minimum_required(VERSION 3.22)
project(firmware LANGUAGES CXX)
set(SPLINEFEED_UNITY_BUILD ON)
set(SPLINEFEED_MAX_AXES 3)
set(SPLINEFEED_MAX_DEGREE 3)
set(SPLINEFEED_SCALARS Fixed)
set(SPLINEFEED_WERROR ON)
set(SPLINEFEED_CORE_WITHOUT "/splines/ferguson|/surfaces/|/jerk_|/s5_pulse_train/")
add_subdirectory(splinefeed)
add_executable(program core.cpp)
target_link_libraries(program PRIVATE splinefeed::core)
target_compile_options(program PRIVATE -Wall -Wextra -Wpedantic -Werror)
PROJECT
cmake -G Ninja -S "$scratch" -B "$scratch/build" -DCMAKE_BUILD_TYPE=Debug
cmake --build "$scratch/build" --target program
output=$("$scratch/build/program")
echo "$output"
[[ $output == "10000 counts" ]]
