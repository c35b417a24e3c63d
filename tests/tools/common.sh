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

# npm_packages SOURCE FOLDER: installs what the lock file in SOURCE has into FOLDER, unless it is there; one test at a time.
npm_packages() {
    mkdir -p "$2"
    {
        flock 9
        if cmp --silent "$1/package-lock.json" "$2/installed.json" && [[ -d $2/node_modules ]]; then return 0; fi
        cp "$1/package.json" "$1/package-lock.json" "$1/.npmrc" "$2"
        if ! (cd "$2" && npm ci --ignore-scripts --loglevel=error) >"$2/npm.txt" 2>&1; then
            if grep -qE 'EAI_AGAIN|ENOTFOUND|ECONNREFUSED|ETIMEDOUT|network' "$2/npm.txt"; then skip "npm has no network"; fi
            cat "$2/npm.txt"
            exit 1
        fi
        cp "$1/package-lock.json" "$2/installed.json"
    } 9>"$2/lock"
}

# sources FOLDER...: the C++ files below, without what is built.
sources() {
    find "$@" \( -name '*.hpp' -o -name '*.cpp' \) -not -path './build/*' | sort
}
