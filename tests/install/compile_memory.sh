#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# How many compilers run at once on computers with little memory, and that others are left alone.
source "$(dirname "${BASH_SOURCE[0]}")/../tools/common.sh"

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
# at_once MEMORY_MB: as ninja's files have it; nothing where there is no bound.
at_once() {
    cmake -S . -B "$scratch/$1" -G Ninja -DSPLINEFEED_HOST=OFF -DSPLINEFEED_TESTS=OFF -DSPLINEFEED_MEMORY_MB="$1" >"$scratch/log" || cat "$scratch/log"
    if grep --quiet 'pool = compilers' "$scratch/$1/build.ninja"; then sed -n '/^pool compilers/,/depth/s/ *depth = //p' "$scratch/$1/CMakeFiles/rules.ninja"; fi
}
for case in 450:1 1900:1 9000000:; do
    if [[ $(at_once "${case%:*}") != "${case#*:}" ]]; then
        echo "${case%:*} MB: $(at_once "${case%:*}") compilers at once, not ${case#*:}"
        exit 1
    fi
done
echo "as many compilers as there is room for"
