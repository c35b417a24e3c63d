# SPDX-License-Identifier: MIT
# What a program said, for scripts that compare it: what is missing is an error, and never equal to something else that is missing.
# shellcheck shell=bash

# said COUNT PATTERN TEXT: the lines of TEXT that the extended expression matches; there have to be COUNT of them.
said() {
    local lines
    lines=$(grep -E -e "$2" <<<"$3" || true)
    if [[ -z $lines ]] || (($(wc -l <<<"$lines") != $1)); then
        echo "$1 lines like '$2' were to be in:" >&2
        echo "$3" >&2
        return 1
    fi
    echo "$lines"
}

# number_said PATTERN TEXT: the number that the first group of the extended expression matches, in one line of TEXT.
number_said() {
    local line
    line=$(said 1 "$1" "$2") || return 1
    [[ $line =~ $1 ]] && echo "${BASH_REMATCH[1]}"
}
