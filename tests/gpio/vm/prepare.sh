#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The virtual machine with simulated GPIO chips, made once: prepare.sh CACHE_DIR. Status 77: cannot be made here, and why.
#
# The kernel is Debian's as it is, unpacked and not installed; gpio-sim, which Debian leaves out, is built beside it from
# Debian's source of the same version. CACHE_DIR/ready then holds vmlinux, base.cpio and `version`. It is made anew when apt
# offers another kernel, or when compiler, busybox or these scripts are others; a preparation that broke off is never ready.
source "$(dirname "${BASH_SOURCE[0]}")/../../tools/common.sh"
source tests/gpio/vm/apt.sh

cache=$(realpath --canonicalize-missing "$1")
need qemu-system-x86_64 busybox cpio apt-get dpkg-deb make gcc strip xz flock python3
if [[ $(dpkg --print-architecture) != amd64 ]]; then skip "the kernel's modules are built for amd64 alone"; fi
if ldd "$(command -v busybox)" >/dev/null 2>&1; then skip "busybox needs libraries: busybox-static is the package"; fi

mkdir -p "$cache"
exec 9>"$cache/lock"
flock 9
key=$({
    kernels | head -n 1 # nothing where apt has no index: then what there is at the time is taken
    gcc --version | head -n 1
    busybox | head -n 1
    cat tests/gpio/vm/{apt,prepare}.sh
} | sha256sum | cut -c 1-16)
if [[ -e $cache/$key/version && $(readlink "$cache/ready") == "$key" ]]; then exit 0; fi

scratch=$(mktemp -d "$cache/scratch.XXXXXX")
trap 'rm -rf "$scratch"' EXIT
debs=$scratch/debs
unpacked=$scratch/unpacked

# download: the packages of the newest kernel of which all can be had. A mirror may lack what an index lists: the small ones say so soon.
download() {
    local version kbuild
    while read -r release version kbuild; do
        echo "Kernel $version, release $release, with $kbuild"
        rm -rf "$debs"
        if fetch "$debs" "linux-headers-$release=$version" "linux-headers-${release%-amd64}-common=$version" "$kbuild" &&
            fetch "$debs" "linux-image-$release=$version" "linux-source-$(cut -d . -f 1-2 <<<"$version")=$version"; then return 0; fi
    done < <(kernels)
    return 1
}
# The mirror drops old versions: where the host's index is stale or missing, one of our own says what there is now.
if ! download; then
    if ! own_apt "$scratch/apt" || ! download; then skip "there is no kernel of which image, headers, kbuild and source can be downloaded"; fi
fi

mkdir -p "$unpacked"
for package in "$debs"/linux-{headers,kbuild,source}*.deb; do dpkg-deb --extract "$package" "$unpacked"; done
dpkg-deb --fsys-tarfile "$debs"/linux-image*.deb |
    tar -x -C "$unpacked" --wildcards './boot/vmlinuz*' './*/kernel/fs/configfs/*' './*/kernel/drivers/virtio/*' './*/virtio_console.*'

# The kernel's own decompressor takes seconds of emulated time: the payload of the image (its place is in the boot protocol's
# header) is an ELF file that QEMU starts by its PVH entry.
python3 - "$unpacked"/boot/vmlinuz* "$scratch/vmlinux" <<'PYTHON'
import lzma, struct, sys
image = open(sys.argv[1], "rb").read()
offset, length = struct.unpack_from("<II", image, 0x248)
start = (image[0x1F1] + 1) * 512 + offset
kernel = lzma.LZMADecompressor().decompress(image[start : start + length])
if kernel[:4] != b"\x7fELF":
    sys.exit("the payload of the kernel's image is no ELF file")
open(sys.argv[2], "wb").write(kernel)
PYTHON

# The two modules. A module may not touch a descriptor itself: generic_handle_irq is the door that is exported.
build=$scratch/build
mkdir "$build"
tar -I 'xz --decompress --threads=2' --occurrence=1 -x -f "$unpacked"/usr/src/linux-source-*.tar.xz -C "$build" --transform 's#.*/##' \
    --wildcards 'linux-source-*/drivers/gpio/gpio-sim.c' 'linux-source-*/drivers/gpio/gpiolib.h' 'linux-source-*/kernel/irq/irq_sim.c'
sed -i 's/handle_simple_irq(irq_to_desc(\(.*\)));/generic_handle_irq(\1);/; $a #include <linux/module.h>\nMODULE_LICENSE("GPL");' \
    "$build/irq_sim.c"
if ! grep --quiet 'generic_handle_irq(' "$build/irq_sim.c"; then
    echo "irq_sim.c of this kernel is not what prepare.sh knows"
    exit 1
fi
echo 'obj-m := irq_sim.o gpio-sim.o' >"$build/Makefile"
headers=$unpacked/usr/src/linux-headers-$release
sed -i "s#/usr/src/#$unpacked/usr/src/#" "$headers/Makefile"
make --silent -j 2 -C "$headers" M="$build" modules

# The root file system: one program, and the modules in the order in which they are loaded. run.sh adds the rest.
root=$scratch/root
mkdir -p "$root"/{bin,lib,lib64,modules,proc,sys,dev,out,tmp}
cp "$(command -v busybox)" "$root/bin/busybox"
for module in virtio_ring virtio virtio_pci_modern_dev virtio_pci_legacy_dev virtio_pci virtio_console configfs irq_sim gpio-sim; do
    file=$(find "$unpacked/lib/modules" "$build" \( -name "$module.ko" -o -name "$module.ko.xz" \))
    if [[ -z $file ]]; then continue; fi # built in; what is missing indeed fails in the guest
    if [[ $file == *.xz ]]; then xz --decompress "$file"; fi
    strip --strip-debug -o "$root/modules/$module.ko" "${file%.xz}"
    echo "$module" >>"$root/modules/order"
done
result=$scratch/result
mkdir "$result"
(cd "$root" && find . | sort | cpio --quiet -o -H newc -R 0:0) >"$result/base.cpio"
mv "$scratch/vmlinux" "$result/"
dpkg-deb --field "$debs"/linux-image*.deb Package Version >"$result/version"

rm -rf "${cache:?}/$key"
mv "$result" "$cache/$key"
ln --symbolic "$key" "$scratch/ready"
mv --no-target-directory "$scratch/ready" "$cache/ready"
find "$cache" -mindepth 1 -maxdepth 1 -type d -not -name "$key" -not -path "$scratch" -exec rm -rf {} +
