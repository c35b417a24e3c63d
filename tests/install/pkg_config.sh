#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# pkg-config finds the installed core, also where its folder was moved: pkg_config.sh BUILD_DIRECTORY.
source "$(dirname "${BASH_SOURCE[0]}")/../tools/common.sh"

need pkg-config
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cmake --install "$1" --prefix "$scratch/prefix" >/dev/null
mv "$scratch/prefix" "$scratch/moved"
PKG_CONFIG_PATH=$(dirname "$(find "$scratch/moved" -name splinefeed.pc)")
export PKG_CONFIG_PATH
pkg-config --print-errors --exists 'splinefeed >= 0.1'
read -ra flags < <(pkg-config --cflags splinefeed)
read -ra libraries < <(pkg-config --libs splinefeed)
echo "${flags[@]}" "${libraries[@]}"
for compiler in g++ clang++; do
    "$compiler" -Wall -Wextra -Werror "${flags[@]}" tests/install/core.cpp "${libraries[@]}" -o "$scratch/program"
    output=$("$scratch/program")
    echo "$compiler: $output"
    [[ $output == "10000 counts" ]]
done
