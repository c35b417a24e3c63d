# SPDX-License-Identifier: MIT
# What the proofs on one microcontroller have in common: PROOF.sh CPU BUILD_DIRECTORY_OF_THE_HOST. To be sourced with "$@", from
# the root of the repository; builds the images. Sets cpu, host and build.
# shellcheck shell=bash
source tests/tools/said.sh
source tests/arm/build.sh

cpu=$1
host=$2
need arm-none-eabi-g++ qemu-system-arm
build=build/arm-$cpu
build_images "$cpu" "$build"

# Heap, exceptions, C++ run-time, arithmetic in double.
forbidden='malloc|calloc|realloc|^free$|^_Zn[wa]|^_Zd[la]|^__cxa_|^__gxx_|[uU]nwind|^abort$|^__aeabi_atexit$'
forbidden+='|^__aeabi_(c?d[^i]|[fiul]+2d$)|df[23x]$|^__(float|extend|fix|trunc).*df'

# forbids_all IMAGE [MORE]: it holds nothing of that, nor what the extended expression MORE matches. Absolute symbols (type A)
# are no code.
forbids_all() {
    local symbols
    symbols=$(arm-none-eabi-nm "$1" | awk '$2 != "A" { print $3 }')
    if grep -E "$forbidden${2:+|$2}" <<<"$symbols"; then
        echo "the image holds what firmware must not have"
        exit 1
    fi
    arm-none-eabi-size "$1"
}

# run IMAGE [OPTION...]: what it says on the board of its processor, or on the one that `board` names.
run() {
    timeout 120 qemu-system-arm -M "${board:-$(board_of "$cpu")}" "${@:2}" -nographic -monitor none -serial none \
        -chardev stdio,id=host -semihosting-config enable=on,target=native,chardev=host -kernel "$1"
}

# as_host COUNT PATTERN OUTPUT PROGRAM: these lines of the output are those of the host's program.
as_host() {
    local here there
    here=$(said "$1" "$2" "$3")
    there=$(said "$1" "$2" "$("$host/bin/$4")")
    if ! diff <(echo "$here") <(echo "$there"); then
        echo "the host says otherwise"
        exit 1
    fi
}

# at_most NAME INSTRUCTIONS OUTPUT: what it says that a piece costs
at_most() {
    local took
    took=$(number_said "^cost $1 ([0-9]+) " "$3")
    if ((took > $2)); then
        echo "$1 takes $took instructions, at most $2 were to be"
        exit 1
    fi
}
