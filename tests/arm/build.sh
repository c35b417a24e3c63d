# SPDX-License-Identifier: MIT
# Builds the images of a microcontroller. To be sourced.
# shellcheck shell=bash

# board_of CPU: QEMU's board with that processor
board_of() {
    case $1 in
        cortex-m0) echo microbit ;;
        cortex-m3) echo mps2-an385 ;;
        cortex-m4f) echo mps2-an386 ;;
        *) return 1 ;;
    esac
}

# build_images CPU BUILD_DIRECTORY
build_images() {
    local without=
    # One of the three, whose floating point unit makes it the quickest to compile for, builds all of the core.
    if [[ $1 != cortex-m4f && ${SPLINEFEED_LONG:-0} != 1 ]]; then
        without=$(grep -v '^#' tests/arm/unused_sources.txt | paste -sd '|')
    fi
    # One at a time: what keeps time is another run of ctest.
    mkdir -p "$2"
    {
        flock 9
        cmake --preset arm -B "$2" -DSPLINEFEED_CPU="$1" -DSPLINEFEED_CORE_WITHOUT="$without"
        cmake --build "$2"
    } 9>"$2/lock"
}
