#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What the tests rest on notices what it is there to notice: programs that crash, print nothing, or are not there.
#   harness.sh CATCH2_PROGRAM     any of the test executables
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
source tests/tools/said.sh

program=$(realpath "$1")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# fails WHAT COMMAND...: the command has to end with an error.
fails() {
    local what=$1
    shift
    if "$@" >"$scratch/told" 2>&1; then
        cat "$scratch/told"
        echo "not noticed: $what"
        exit 1
    fi
    echo "noticed: $what"
}

# tests FUNCTION_BODY: a program that lists its tests, or runs the one that it is told, as a script.
tests() {
    # shellcheck disable=SC2016 # $1 is the script's own
    printf '#!/bin/bash\nif [[ $1 == --list-tags ]]; then\n%s\nfi\n%s\n' "$1" "${2-}" >"$scratch/tests"
    chmod +x "$scratch/tests"
}
list() { cmake -DPROGRAM="$scratch/tests" -DPREFIX=area -DFILE="$scratch/CTestTestfile.cmake" -P cmake/list_tests.cmake; }

fails "a filter that no test matches" "$program" "no test is called so"
# shellcheck disable=SC2016 # $$ is the script's own
tests 'echo; echo "  1  [#one]"; kill -SEGV $$'
fails "a program that crashes while it lists its tests" list
tests 'echo; echo "  1  [#one]"; echo "  1  [two]"; exit 1'
fails "a program that ends while it lists its tests" list
tests 'exit 0'
fails "a program without tests" list

tests 'echo; echo "  2  [#one]"; exit 1' 'echo "SKIPPED: no reason"; echo "All tests passed (1 assertion in 2 test cases)"'
list
ctest --test-dir "$scratch" >"$scratch/told"
said 1 'area/one .*\*\*\*Skipped' "$(<"$scratch/told")"
ctest --test-dir "$scratch" --verbose | awk -f tests/tools/ctest_output.awk >"$scratch/told"
said 1 'NOT TESTED' "$(<"$scratch/told")"
said 2 'SKIPPED: no reason' "$(<"$scratch/told")"
said 1 '^    area/one$' "$(<"$scratch/told")"
tests 'echo; echo "  2  [#one]"; exit 1' 'echo "SKIPPED: a part"; echo "test cases: 2 | 1 passed | 1 failed"; exit 1'
list
fails "a test that fails and skips a part" ctest --test-dir "$scratch"
said 1 '0% tests passed, 1 tests failed out of 1' "$(<"$scratch/told")"

fails "a line that is missing" said 1 '^hash 0x' 'segments 0x12'
fails "a line too many" said 1 '^hash 0x' $'hash 0x1\nhash 0x2'
fails "a number that is missing" number_said '^stack used ([0-9]+) ' 'stack used  bytes'
[[ $(number_said '^stack used ([0-9]+) ' 'stack used 12 bytes') == 12 ]]
