#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# libgpiod 2 beside the one of the host: libgpiod2.sh PREFIX. Headers in PREFIX/include, libraries in PREFIX/lib, pkg-config's
# file in PREFIX/lib/pkgconfig, the package's version in PREFIX/version. Nothing is installed. Status 77: not to be had, and why.
# From the host's own release where that has version 2 (Debian 13), else from its backports, which link with its compiler.
source "$(dirname "${BASH_SOURCE[0]}")/../../tools/common.sh"
source tests/gpio/vm/apt.sh

prefix=$(realpath --canonicalize-missing "$1")
need apt-get dpkg-deb flock
mkdir -p "$(dirname "$prefix")"
exec 9>"$prefix.lock"
flock 9
if [[ -e $prefix/version ]]; then exit 0; fi

rm -rf "$prefix".?????? # of one that was broken off
scratch=$(mktemp -d "$prefix.XXXXXX")
trap 'rm -rf "$scratch"' EXIT
# shellcheck source=/dev/null
suite=$(source /etc/os-release && echo "${VERSION_CODENAME-}-backports")

# download: the newest package for compiling that apt knows now, and the libraries that it names.
download() {
    local version names
    version=$(field libgpiod-dev Version)
    if [[ $version != 2.* ]]; then return 1; fi
    names=(libgpiod-dev)
    mapfile -t -O 1 names < <(depends "libgpiod-dev=$version" libgpiod)
    fetch "$scratch/debs" "${names[@]/%/=$version}"
}
if ! download; then
    if ! own_apt "$scratch/apt" "$suite" || ! download; then skip "no libgpiod 2 in this release, nor in $suite"; fi
fi

for package in "$scratch"/debs/*.deb; do dpkg-deb --extract "$package" "$scratch/unpacked"; done
result=$scratch/result
mkdir "$result"
mv "$scratch/unpacked/usr/include" "$result/include"
mv "$scratch"/unpacked/usr/lib/*-linux-gnu* "$result/lib"
sed -i "s#^prefix=.*#prefix=$prefix#; s#^libdir=.*#libdir=$prefix/lib#; s#^includedir=.*#includedir=$prefix/include#" \
    "$result"/lib/pkgconfig/*.pc
dpkg-deb --field "$scratch"/debs/libgpiod-dev*.deb Version >"$result/version"
rm -rf "$prefix"
mv "$result" "$prefix"
