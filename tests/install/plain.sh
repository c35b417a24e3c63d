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
options=()
if [[ ${2-} == look ]]; then options=(-DSPLINEFEED_PRECOMPILE=ON); fi # headers of libraries are read once; nothing is warned of in them
CXX=$1 cmake -S . -B "$build" "${options[@]}" >"$log" 2>&1 || complain
# look_at PATTERN [OPTION]: compiles the sources of what ships whose names match, as a build would, with that option.
look_at() {
    python3 -c '
import json, re, sys
build, pattern, option = sys.argv[1:]
for entry in json.load(open(build + "/compile_commands.json")):
    if re.search(pattern, entry["file"]) and not entry["directory"].startswith(build + "/tests"):
        print("cd", entry["directory"], "&&", entry["command"], option, end="\0")' "$PWD/$build" "$1" "${2-}" |
        xargs --null --max-procs="$(nproc)" --max-args=1 bash -c >>"$log" 2>&1 || complain
}
if [[ ${2-} == look ]]; then
    make -C "$build" -f host_sim/CMakeFiles/splinefeed_host.dir/build.make host_sim/{page_template,shipped_profile_texts}.cpp >>"$log" 2>&1 || complain
    look_at '/cmake_pch[.]'
    look_at '/(?!cmake_pch[.])[^/]*$' -fsyntax-only
else
    cmake --build "$build" --parallel "$(nproc)" >>"$log" 2>&1 || complain
fi
if grep --quiet --ignore-case 'warning' "$log"; then complain; fi
