#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# CNCjs, a sender of G-code from npm, operates a served machine by a pseudo terminal: cncjs.sh BUILD_DIRECTORY.
source "$(dirname "${BASH_SOURCE[0]}")/../tools/common.sh"

need node npm
folder=$1/cncjs
mkdir -p "$folder"
if ! cmp --silent tests/senders/package-lock.json "$folder/installed.json" || [[ ! -d $folder/node_modules ]]; then
    cp tests/senders/package.json tests/senders/package-lock.json tests/senders/.npmrc "$folder"
    if ! (cd "$folder" && npm ci --ignore-scripts --silent) >"$folder/npm.txt" 2>&1; then
        if grep -qE 'EAI_AGAIN|ENOTFOUND|ECONNREFUSED|ETIMEDOUT|network' "$folder/npm.txt"; then skip "npm has no network"; fi
        cat "$folder/npm.txt"
        exit 1
    fi
    cp tests/senders/package-lock.json "$folder/installed.json"
fi
exec tests/senders/cncjs_runs.mjs "$folder" "$1/bin/splinefeed"
