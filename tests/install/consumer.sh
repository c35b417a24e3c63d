#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The installed package serves a project outside of this repository: consumer.sh BUILD_DIRECTORY.
source "$(dirname "${BASH_SOURCE[0]}")/../tools/common.sh"

build=$1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cmake --install "$build" --prefix "$scratch/prefix"
cmake -G Ninja -S tests/install -B "$scratch/build" -DCMAKE_PREFIX_PATH="$scratch/prefix"
cmake --build "$scratch/build"
output=$("$scratch/build/consumer")
echo "$output"
[[ $output == "idle after 10000 counts" ]]
