#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What a compiler says of mistakes that it can see: an older C++, and a machine with a number that cannot be.
source "$(dirname "${BASH_SOURCE[0]}")/../tools/common.sh"

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cat >"$scratch/machine.cpp" <<'CODE'
#include <splinefeed/splinefeed.hpp>
constexpr splinefeed::MachineSettings machine{.axes = 1, .axis = {{{.max_velocity_mm_s = VELOCITY}}}};
constexpr auto limits = splinefeed::MotionLimits<double>::make(machine);
static_assert(splinefeed::no_error<limits.error()>());
CODE
# errors COMPILER OPTION...: what it says.
errors() { "$1" -fsyntax-only -Ifirmware_core -Ihal "${@:2}" "$scratch/machine.cpp" 2>&1 || true; }
for compiler in g++ clang++; do
    need "$compiler"
    if [[ $(errors "$compiler" -std=c++20 -DVELOCITY=100) ]]; then
        errors "$compiler" -std=c++20 -DVELOCITY=100
        exit 1
    fi
    errors "$compiler" -std=c++20 -DVELOCITY=-100 | tee "$scratch/said" | grep 'no_error.*velocity_out_of_range'
    errors "$compiler" -std=c++17 -DVELOCITY=100 >"$scratch/said"
    if [[ $(grep --count 'error: ' "$scratch/said") != 1 ]] || ! grep 'splinefeed needs C++20: compile with -std=c++20' "$scratch/said"; then
        head -n 20 "$scratch/said"
        echo "$compiler: not one sentence about C++17"
        exit 1
    fi
done
