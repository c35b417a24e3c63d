# SPDX-License-Identifier: MIT
# Builds the images of a microcontroller. To be sourced.
# shellcheck shell=bash

# build_images CPU BUILD_DIRECTORY
build_images() {
    local without=
    # One of the three, whose floating point unit makes it the quickest to compile for, builds all of the core.
    if [[ $1 != cortex-m4f && ${SPLINEFEED_LONG:-0} != 1 ]]; then
        without=$(grep -v '^#' tests/arm/unused_sources.txt | paste -sd '|')
    fi
    cmake --preset arm -B "$2" -DSPLINEFEED_CPU="$1" -DSPLINEFEED_CORE_WITHOUT="$without"
    cmake --build "$2"
}
