# SPDX-License-Identifier: MIT
# What the proofs on one microcontroller have in common: PROOF.sh CPU BUILD_DIRECTORY_OF_THE_HOST. To be sourced with "$@", from
# the root of the repository; builds the images. Sets cpu, host and build. What it measures is left for tests/arm/budgets.py in
# BUILD_DIRECTORY_OF_THE_HOST/budgets/PROOF-CPU.txt; `proof` is the script's name where it says no other.
# shellcheck shell=bash
source tests/tools/said.sh
source tests/arm/build.sh

cpu=$1
host=$2
need arm-none-eabi-g++ qemu-system-arm
build=build/arm-$cpu
proof=${proof:-$(basename "$0" _proof.sh)}
figures=$host/budgets/$proof-$cpu.txt
mkdir -p "$host/budgets"
: >"$figures"
build_images "$cpu" "$build"

# Heap, exceptions, C++ run-time.
forbidden='malloc|calloc|realloc|^free$|^_Zn[wa]|^_Zd[la]|^__cxa_|^__gxx_|[uU]nwind|^abort$|^__aeabi_atexit$'
# Arithmetic in double. The plan with a jerk limit has some of it: for straight moves in closed form, and a dozen operations a cell.
doubles='^__aeabi_(c?d[^i]|[fiul]+2d$)|df[23x]$|^__(float|extend|fix|trunc).*df'

# figure NAME VALUE: one that the budget bounds
figure() {
    echo "$1 $(($2))" >>"$figures"
}

# costs OUTPUT: each line "cost NAME INSTRUCTIONS ..." is a figure, and so is the longest call that it tells of
costs() {
    sed -nE -e 's/^cost ([a-z_]+) ([0-9]+).*(most|longest call|longest) ([0-9]+).*/\1 \2\n\1.longest \4/p;t' \
        -e 's/^cost ([a-z_]+) ([0-9]+) .*/\1 \2/p' <<<"$1" >>"$figures"
}

# stack_of NAME OUTPUT: how much of the stack was used, which was painted before
stack_of() {
    figure "$1stack" "$(number_said '^stack used ([0-9]+) ' "$2")"
}

# forbids_all IMAGE [MORE]: it holds nothing of that, nor what the extended expression MORE matches; an image whose jerk is limited
# may compute in double. Absolute symbols (type A) are no code. Its flash: code, constants, and what variables begin with.
forbids_all() {
    local symbols
    symbols=$(arm-none-eabi-nm "$1" | awk '$2 != "A" { print $3 }')
    local never="$forbidden${2:+|$2}"
    if [[ $1 != *_jerk.elf && $1 != */stage_costs.elf ]]; then never+="|$doubles"; fi
    if grep -E "$never" <<<"$symbols"; then
        echo "the image holds what firmware must not have"
        exit 1
    fi
    arm-none-eabi-size "$1"
    figure "$(basename "$1" .elf).flash" "$(arm-none-eabi-size "$1" | awk 'NR == 2 { print $1 + $2 }')"
}

# run IMAGE [OPTION...]: what it says on the board of its processor, or on the one that `board` names.
run() {
    timeout 1200 qemu-system-arm -M "${board:-$(board_of "$cpu")}" "${@:2}" -nographic -monitor none -serial none \
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
