#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# All of the core in one header: a program of two sources, with both compilers, without a warning.
source "$(dirname "${BASH_SOURCE[0]}")/../tools/common.sh"

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir -p "$scratch/splinefeed"
cmake/packaging/single_header.py "$scratch/splinefeed/splinefeed.hpp"
if grep -n '#include "' "$scratch/splinefeed/splinefeed.hpp"; then
    echo "the header is not the only one"
    exit 1
fi
printf '#define SPLINEFEED_IMPLEMENTATION\n#include <splinefeed/splinefeed.hpp>\n' >"$scratch/core.cpp"
for compiler in g++ clang++; do
    need "$compiler"
    "$compiler" -std=c++20 -ffp-contract=off -Wall -Wextra -Werror -I"$scratch" \
        "$scratch/core.cpp" tests/install/core.cpp -o "$scratch/program"
    output=$("$scratch/program")
    echo "$compiler: $output"
    [[ $output == "10000 counts" ]]
done
