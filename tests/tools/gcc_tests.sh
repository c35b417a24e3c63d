#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# All test programs by g++ with assertions, each source of a test compiled alone; random tests run all of their rounds.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

need g++
build=build/gcc-tests
cmake --preset dev -B $build -DCMAKE_CXX_FLAGS_DEBUG=-O2
cmake --build $build
SPLINEFEED_LONG=1 ctest --test-dir $build --timeout 7200 --output-on-failure --parallel "$((2 * $(nproc)))"
