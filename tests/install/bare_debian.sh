# SPDX-License-Identifier: MIT
# A bare Debian of the suite of this one, to install in. To be sourced behind common.sh.
# shellcheck shell=bash

# bare_debian FOLDER: below FOLDER, which is removed when the script ends; $root is where. Skips the test where it cannot be made.
bare_debian() {
    if ((EUID != 0)); then skip "needs root"; fi
    need debootstrap dpkg-shlibdeps
    local mirror suite
    # shellcheck disable=SC2016 # $(REPO_URI) is for apt to expand
    mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Label: Debian' | head -n 1)
    if [[ -z $mirror ]]; then skip "no Debian mirror is configured"; fi
    # shellcheck source=/dev/null
    suite=$(source /etc/os-release && echo "$VERSION_CODENAME")
    bare_folder=$1
    root=$1/root
    trap remove_bare_debian EXIT
    debootstrap --variant=minbase --include=ca-certificates "$suite" "$root" "$mirror" >"$1/log" 2>&1 || { tail -n 30 "$1/log"; exit 1; }
    mount -t proc proc "$root/proc"
    mount --bind /dev "$root/dev"
    cp --recursive --no-clobber /etc/apt/apt.conf.d/. "$root/etc/apt/apt.conf.d/"
    cp /etc/resolv.conf /etc/hosts "$root/etc/"
    mkdir "$root/packages" "$root/work"
}

remove_bare_debian() {
    local point
    for point in proc dev; do umount --lazy "$root/$point" 2>/dev/null || true; done
    rm -rf --one-file-system "$bare_folder"
}

# in_root COMMANDS: there, as bash has them; the first error ends them.
in_root() { chroot "$root" env LC_ALL=C HOME=/root DEBIAN_FRONTEND=noninteractive bash -ec "$1"; }
