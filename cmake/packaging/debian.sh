#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Debian's packages of this repository, for this system: debian.sh [FOLDER], by default build/deb.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

# LinuxCNC's planner where its headers are.
linuxcnc=()
if [[ -e /usr/include/linuxcnc/tp.h ]]; then linuxcnc=(-DSPLINEFEED_LINUXCNC=ON -DSPLINEFEED_LINUXCNC_MODULES:STRING=lib/linuxcnc/modules); fi
folder=$(realpath --canonicalize-missing "${1:-build/deb}")
cmake --preset release -B build/deb -DCMAKE_INSTALL_PREFIX=/usr -DSPLINEFEED_PACKAGES=ON -DSPLINEFEED_TESTS=OFF -DSPLINEFEED_BENCHMARKS=OFF \
    -DSPLINEFEED_BITS=OFF "${linuxcnc[@]}"
cmake --build build/deb
(umask 022 && cpack --config build/deb/CPackConfig.cmake -B "$folder")
