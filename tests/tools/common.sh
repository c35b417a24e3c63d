# SPDX-License-Identifier: MIT
# What the scripts of the repository's tests share: the repository's root as working directory, and how a test is skipped.
# shellcheck shell=bash
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

# skip REASON: ctest reports the test as skipped.
skip() {
    echo "SKIPPED: $1"
    exit 77
}

# need PROGRAM...: without one of them the test cannot run.
need() {
    local program
    for program in "$@"; do
        if ! command -v "$program" >/dev/null; then skip "$program is not installed"; fi
    done
}

# sources FOLDER...: the C++ files below, without what is built.
sources() {
    find "$@" \( -name '*.hpp' -o -name '*.cpp' \) -not -path './build/*' | sort
}
