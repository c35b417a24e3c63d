#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Packages for arm64, as a Raspberry Pi has it, made on this processor: debian_arm64.sh TOOL. A bare Debian with Debian's cross compilers makes them,
# installs them, and what its tool plans in qemu-user is what TOOL plans, bit for bit. As root.
source "$(dirname "${BASH_SOURCE[0]}")/../tools/common.sh"
source tests/install/bare_debian.sh

scratch=$(mktemp -d)
bare_debian "$scratch"
mkdir "$root/source"
git ls-files -z | tar --create --null --files-from=- | tar --extract -C "$root/source"
in_root "dpkg --add-architecture arm64
apt-get update --quiet=2
apt-get install --quiet=2 --no-install-recommends crossbuild-essential-arm64 cmake ninja-build pkg-config qemu-user libboost-dev libcli11-dev nlohmann-json3-dev \
    libfmt-dev:arm64 libgpiod-dev:arm64 libmodbus-dev:arm64 libtomlplusplus-dev:arm64 >/dev/null
cd /source && cmake/packaging/debian.sh /packages arm64 >/work/log 2>&1 || { tail -n 30 /work/log; exit 1; }
ls -l /packages
apt-get install --quiet=2 --no-install-recommends /packages/splinefeed_*_arm64.deb /packages/libsplinefeed-dev_*_arm64.deb >/dev/null"
plan=(plan examples/star.csv -m examples/jerk_limited.toml --trace)
in_root "cd /source && file -L /usr/bin/splinefeed | grep aarch64 && qemu-aarch64 /usr/bin/splinefeed ${plan[*]} /work/trace.csv | grep 'cycle time'"
"$1" "${plan[@]}" "$scratch/trace.csv" >/dev/null
cmp "$scratch/trace.csv" "$root/work/trace.csv"
echo "made, installed, and its plan is this processor's, bit for bit"
