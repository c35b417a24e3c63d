#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The two commands of whoever takes no preset, with a compiler: no error and no warning. `look`: the compiler only looks at the sources of
# what ships, and writes nothing.
source "$(dirname "${BASH_SOURCE[0]}")/../tools/common.sh"

need "$1" make python3
build=build/plain/$1
mkdir -p "$build"
log=$build/log
complain() { grep --extended-regexp --context=8 '(warning|error|Error):?' "$log" | tail -n 60; exit 1; }
CXX=$1 cmake -S . -B "$build" >"$log" 2>&1 || complain
if [[ ${2-} == look ]]; then # tests have precompiled headers, which do not exist
    make -C "$build" -f host_sim/CMakeFiles/splinefeed_host.dir/build.make host_sim/{page_template,shipped_profile_texts}.cpp >>"$log" 2>&1 || complain
    python3 -c '
import json, sys
for entry in json.load(open(sys.argv[1] + "/compile_commands.json")):
    if "cmake_pch" not in entry["command"]:
        print("cd", entry["directory"], "&&", entry["command"], "-fsyntax-only", end="\0")' "$build" |
        xargs --null --max-procs="$(nproc)" --max-args=1 bash -c >>"$log" 2>&1 || complain
else
    cmake --build "$build" --parallel "$(nproc)" >>"$log" 2>&1 || complain
fi
if grep --quiet --ignore-case 'warning' "$log"; then complain; fi
