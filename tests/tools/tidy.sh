#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# clang-tidy finds nothing in the code that ships: tidy.sh BUILD_DIRECTORY.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

need clang-tidy
build=$1
checks=()
if [[ ${SPLINEFEED_LONG:-0} == 1 ]]; then checks=(--checks='clang-analyzer-*'); fi
sources firmware_core hal host_sim | grep '\.cpp$' |
    xargs --max-procs="$(nproc)" --max-args=1 clang-tidy -p "$build" --quiet "${checks[@]}" --warnings-as-errors='*'
