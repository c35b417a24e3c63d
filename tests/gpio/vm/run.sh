#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# One test in the virtual machine: run.sh CACHE_DIR OUT_DIR GUEST_SCRIPT FILE...
#
# GUEST_SCRIPT (busybox sh; `. /guest.sh` gives it chip_path, pull, level, wait_for_line) runs in /test as root, beside the
# FILEs, which are found in PATH, and with the libraries that ldd names for them (LD_LIBRARY_PATH and RUNPATH count; a program may
# be linked statically). OUT_DIR is emptied; then it holds what the script left in /out, trace.txt (gpio_value and
# gpio_direction, clock mono), lines.csv (number in the trace, chip, offset, name), console.log and `status`. Status: the
# script's own; 77 as prepare.sh; 99 where the bed did not work, the trace was too long for its buffer (about a million events), or
# the guest took longer than GPIO_VM_SECONDS (default 120), with the end of the console.
# GPIO_VM_TIME=virtual: the guest's clock counts its instructions (500 a us) and leaps over sleep, so that instants do not depend
# on what else the host does; takes two seconds more to start. For timing; the default, `real`, is for everything else.
# Paths are absolute or from the repository's root.
source "$(dirname "${BASH_SOURCE[0]}")/../../tools/common.sh"

if (($# < 3)); then
    echo "usage: run.sh CACHE_DIR OUT_DIR GUEST_SCRIPT FILE..." >&2
    exit 2
fi
cache=$(realpath --canonicalize-missing "$1")
out=$(realpath --canonicalize-missing "$2")
script=$3
tests/gpio/vm/prepare.sh "$cache" || exit # 77 is passed on

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work"/root/{test,lib,lib64}

# put FILE FOLDER: names are flat, so that two different files of one name are a mistake.
put() {
    local target=$work/root/$2/${1##*/}
    if [[ -e $target ]] && ! cmp --quiet "$1" "$target"; then
        echo "two files are called ${1##*/}" >&2
        exit 2
    fi
    cp --dereference "$1" "$target"
}
for file in "$script" "${@:4}"; do
    put "$file" test
    if [[ $(head -c 4 "$file" | tr -d '\0') != $'\x7fELF' ]]; then continue; fi
    libraries=$(ldd "$file" 2>&1 || true)
    if grep 'not found' <<<"$libraries" >&2; then
        echo "$file lacks a library" >&2
        exit 2
    fi
    while read -r library; do put "$library" lib; done < <(sed -n 's#.* => \(/[^ ]*\) .*#\1#p' <<<"$libraries")
    while read -r loader; do put "$loader" lib64; done < <(sed -n 's#^\s*\(/lib64/[^ ]*\) .*#\1#p' <<<"$libraries")
done
echo "${script##*/}" >"$work/root/script"
cp tests/gpio/vm/guest.sh "$work/root/guest.sh"
install --mode=755 tests/gpio/vm/init.sh "$work/root/init"
{
    cat "$cache/ready/base.cpio"
    (cd "$work/root" && find . | cpio --quiet -o -H newc -R 0:0)
} >"$work/initramfs"

rm -rf "$out"
mkdir -p "$out"
console=$out/console.log
# fail WHAT: the bed did not work.
fail() {
    tail -n 30 "$console" >&2 || true
    echo "the virtual machine: $1" >&2
    exit 99
}
seconds=${GPIO_VM_SECONDS:-120}
clock=()
case ${GPIO_VM_TIME:-real} in
    real) ;;
    virtual) clock=(-icount 'shift=1,sleep=off') ;;
    *)
        echo "GPIO_VM_TIME is real or virtual" >&2
        exit 2
        ;;
esac
# One processor: irq_sim's loop is not made for a second one, and the trace has one order.
status=0
timeout --kill-after=5 "$seconds" qemu-system-x86_64 -accel tcg -smp 1 -m 512 -display none -nodefaults -no-reboot \
    -kernel "$cache/ready/vmlinux" -initrd "$work/initramfs" \
    -append 'console=ttyS0 quiet panic=-1 rdinit=/init mitigations=off cryptomgr.notests' \
    -chardev "file,id=console,path=$console" -serial chardev:console \
    -device virtio-serial-pci -chardev "file,id=out,path=$work/out.tar" -device virtserialport,chardev=out,name=out \
    "${clock[@]}" </dev/null || status=$?
case $status in
    0) ;;
    124 | 137) fail "not finished after $seconds s" ;;
    *) fail "QEMU ended with status $status" ;;
esac
if ! tar -x -f "$work/out.tar" -C "$out" --no-same-owner 2>"$work/tar.log" || [[ ! -s $out/status ]]; then
    fail "it ended before the results were out"
fi
status=$(<"$out/status")
if ((status != 0)); then tail -n 30 "$console" >&2; fi
exit "$status"
