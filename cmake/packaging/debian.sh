#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Debian's packages of this repository: debian.sh [FOLDER [ARCHITECTURE]], by default in build/deb and for this system. For another one, as arm64, by
# Debian's cross compiler (crossbuild-essential-arm64), the libraries of that architecture beside this one's, and qemu-user; without the Python module.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

# LinuxCNC's planner where its headers are.
linuxcnc=()
if [[ -e /usr/include/linuxcnc/tp.h ]]; then linuxcnc=(-DSPLINEFEED_LINUXCNC=ON -DSPLINEFEED_LINUXCNC_MODULES:STRING=lib/linuxcnc/modules); fi
own=$(dpkg --print-architecture)
architecture=${2:-$own}
build=build/deb
cross=()
if [[ $architecture != "$own" ]]; then
    build=build/deb-$architecture
    triple=$(dpkg-architecture --host-arch "$architecture" --query DEB_HOST_GNU_TYPE 2>/dev/null)
    export DEB_HOST_ARCH=$architecture PKG_CONFIG_LIBDIR=/usr/lib/$triple/pkgconfig:/usr/share/pkgconfig
    for needed in "$triple-g++" "qemu-${triple%%-*}"; do
        if ! command -v "$needed" >/dev/null; then
            echo "packages for $architecture need $needed: apt-get install crossbuild-essential-$architecture qemu-user" >&2
            exit 2
        fi
    done
    linuxcnc=()
    cross=(-DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR="${triple%%-*}" -DCMAKE_CXX_COMPILER="$triple-g++" -DCMAKE_LIBRARY_ARCHITECTURE="$triple"
        -DCMAKE_CROSSCOMPILING_EMULATOR="qemu-${triple%%-*}" -DCPACK_DEBIAN_PACKAGE_ARCHITECTURE="$architecture" -DSPLINEFEED_PYTHON=OFF)
fi
folder=$(realpath --canonicalize-missing "${1:-$build}")
cmake --preset release -B "$build" -DCMAKE_INSTALL_PREFIX=/usr -DSPLINEFEED_PACKAGES=ON -DSPLINEFEED_TESTS=OFF -DSPLINEFEED_BENCHMARKS=OFF \
    -DSPLINEFEED_BITS=OFF "${linuxcnc[@]}" "${cross[@]}"
cmake --build "$build"
(umask 022 && cpack --config "$build/CPackConfig.cmake" -B "$folder")
