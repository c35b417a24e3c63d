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

# expressions FILE: its lines as one regular expression
expressions() {
    grep -v '^#' "$1" | paste -sd '|'
}

# build_images CPU BUILD_DIRECTORY
build_images() {
    local without='' quintic_without='' scalars='double;float;Fixed' quintic_scalars='double;float;Fixed'
    # Those that senders operate with curves through points have all sources of the core; the others what their images use.
    if [[ ${SPLINEFEED_LONG:-0} != 1 ]]; then
        without=$(expressions tests/arm/unused_sources.txt)
        scalars='float;Fixed'
        quintic_scalars=$scalars
        if [[ $1 != cortex-m4f ]]; then quintic_scalars=Fixed; fi
        if [[ $1 == cortex-m3 ]]; then
            quintic_without=$(expressions tests/arm/unused_quintic_sources.txt)
            scalars=Fixed
        fi
    fi
    # One at a time: what keeps time is another run of ctest.
    mkdir -p "$2"
    {
        flock 9
        cmake --preset arm -B "$2" -DSPLINEFEED_CPU="$1" -DSPLINEFEED_CORE_WITHOUT="$without" \
            -DSPLINEFEED_QUINTIC_WITHOUT="$quintic_without" -DSPLINEFEED_SCALARS="$scalars" -DSPLINEFEED_QUINTIC_SCALARS="$quintic_scalars"
        cmake --build "$2"
    } 9>"$2/lock"
}
