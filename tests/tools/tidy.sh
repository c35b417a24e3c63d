#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# clang-tidy finds nothing in the code that ships: tidy.sh BUILD_DIRECTORY. What the last commits changed, which takes a minute
# or two; with --long all of it, which takes several, and the analyzer.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

need clang-tidy
# Every source as it is compiled alone.
build=$1/tidy
cmake --preset release -B "$build" -DSPLINEFEED_UNITY_BUILD=OFF >/dev/null
checks=()
if [[ ${SPLINEFEED_LONG:-0} == 1 ]]; then checks=(--checks='clang-analyzer-*'); fi

# A header is seen by the source of its name.
changed() {
    if [[ ${SPLINEFEED_LONG:-0} != 1 ]] && git rev-parse --git-dir >/dev/null 2>&1; then
        { git log -5 --name-only --format= && git diff --name-only HEAD; } | sed 's/\.hpp$/.cpp/' | sort -u
    else
        sources firmware_core hal host_sim
    fi
}
# What this build leaves out, such as the source for another version of a library, has no headers here.
built=$(sed -n "s|^ *\"file\": \"$PWD/\(.*\)\",\{0,1\}$|\1|p" "$build/compile_commands.json" | sort -u)
[[ -n $built ]] # else nothing would be looked at
comm -12 <(changed) <(sources firmware_core hal host_sim) | comm -12 - <(echo "$built") | grep '\.cpp$' |
    xargs --no-run-if-empty --max-procs="$(nproc)" --max-args=1 \
        clang-tidy -p "$build" --quiet "${checks[@]}" --warnings-as-errors='*'
