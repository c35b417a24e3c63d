#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The two commands of whoever takes no preset, with a compiler: no error and no warning.
source "$(dirname "${BASH_SOURCE[0]}")/../tools/common.sh"

need "$1" make
build=build/plain/$1
mkdir -p "$build"
log=$build/log
complain() { grep --extended-regexp --context=8 '(warning|error|Error):?' "$log" | tail -n 60; exit 1; }
CXX=$1 cmake -S . -B "$build" >"$log" 2>&1 || complain
cmake --build "$build" --parallel "$(nproc)" >>"$log" 2>&1 || complain
if grep --quiet --ignore-case 'warning' "$log"; then complain; fi
