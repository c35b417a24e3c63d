#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the planner in a page, and tries it in a browser beside the tool: page.sh TOOL PAGE_DIRECTORY (which bundle.sh has filled)
source "$(dirname "${BASH_SOURCE[0]}")/../tools/common.sh"

need em++ node zopfli
cmake --preset web >build/web.log
cmake --build --preset web >>build/web.log || { tail -20 build/web.log; exit 1; }
page=build/web/bin/splinefeed.html
size=$(stat --format=%s "$page")
echo "$page has $size bytes"
if ((size > 1500000)); then
    echo "$page has more than 1500000 bytes" >&2
    exit 1
fi
node tests/web/page.mjs "$1" "$2" "$page"
