#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What g++ and clang make of one source plans the same motion, to the bit, in every scalar and planner: two_compilers.sh TOOL OTHER_TOOL.
# The test programs are clang's; this is what makes their word count for the tool that ships.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

tools=("$(realpath "$1")" "$(realpath "$2")")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# same OPTION...: the segments of both.
same() {
    local i
    for i in 0 1; do
        "${tools[i]}" plan "$@" --segments "$scratch/$i.csv" >"$scratch/$i.log" 2>&1 || {
            cat "$scratch/$i.log"
            echo "${tools[i]} plan $*: failed"
            exit 1
        }
    done
    if [[ $(wc -l <"$scratch/0.csv") -lt 10 ]] || ! cmp "$scratch/0.csv" "$scratch/1.csv"; then
        echo "${tools[*]}: other segments for: $*"
        exit 1
    fi
    echo "$(wc -l <"$scratch/0.csv") segments the same: $*"
}

for scalar in fixed double float; do
    same examples/path61.csv -m examples/three_axis.toml --scalar $scalar
done
for scalar in fixed double; do # float has too few digits for a jerk limit
    same examples/path61.csv -m examples/jerk_limited.toml --scalar $scalar
done
for curve in g2-bezier catmull-rom catmull-rom-modified bspline polyline bspline-interpolation ferguson; do
    same examples/star.csv -m examples/three_axis.toml --curve $curve
done
same examples/path61.csv -m examples/jerk_limited.toml --jerk-scalar float
