#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# ./run and ./check on a system that has nothing but git: a Debian root made by debootstrap from this machine's mirror.
#   tests/tools/fresh_debian.sh [SUITE]      as root; a quarter of an hour and 4 GB
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

if [[ -e /fresh_debian ]]; then skip "this is the fresh system itself"; fi
if ((EUID != 0)); then skip "needs root"; fi
need debootstrap git
suite=${1:-bookworm}
# shellcheck disable=SC2016 # $(REPO_URI) is for apt to expand
mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Label: Debian' | head -n 1)
if [[ -z $mirror ]]; then skip "no Debian mirror is configured"; fi

root=$(mktemp -d)
chmod 755 "$root" # as any "/": who is not root passes through it
mount_points=(proc sys dev)
clean_up() {
    for point in "${mount_points[@]}"; do umount --recursive --lazy "$root/$point" || true; done
    rm -rf --one-file-system "$root"
}
debootstrap --variant=minbase --include=git,ca-certificates "$suite" "$root" "$mirror"
for point in "${mount_points[@]}"; do
    mount --rbind "/$point" "$root/$point"
    mount --make-rslave "$root/$point"
done
trap clean_up EXIT

# How this machine reaches its mirror: proxy settings of apt and of the environment, certificates, names.
cp --recursive --no-clobber /etc/apt/apt.conf.d/. "$root/etc/apt/apt.conf.d/"
cp /etc/resolv.conf /etc/hosts "$root/etc/"
touch "$root/fresh_debian"

# What this machine's ccache holds need not be compiled again; the compilers and all headers are the fresh system's own, and a file that is
# missing there or another one is none of the cache's.
cache=$(ccache --get-config cache_dir 2>/dev/null || true)
if [[ -d $cache ]]; then
    mkdir "$root/ccache"
    mount --bind "$cache" "$root/ccache"
    mount_points+=(ccache)
    export CCACHE_DIR=/ccache
fi

git clone --quiet . "$root/splinefeed"
# ./check --long yields to what keeps time; of this system's own tests some keep time, too.
for job in run check; do
    echo "== ./$job"
    time chrt --other 0 chroot "$root" env --unset=SPLINEFEED_LONG LC_ALL=C /splinefeed/$job
done
