#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# LinuxCNC's own tests that start a machine, and its programs of circular arcs, with its planner and with splinefeed_tp.so.
#
#   tests/linuxcnc/upstream.sh [TREE]
#
# TREE: a source tree of LinuxCNC 2.10, built to run in place; else what LINUXCNC_TREE names. hal/linuxcnc/README.md says how to get one.
source "$(dirname "${BASH_SOURCE[0]}")/../tools/common.sh"

tree=${1:-${LINUXCNC_TREE:-}}
if [[ -z $tree ]]; then skip "no source tree of LinuxCNC is given (LINUXCNC_TREE)"; fi
if [[ ! -e $tree/rtlib/motmod.so ]]; then skip "$tree is not built to run in place"; fi
need unshare setpriv /usr/bin/python3 nc
if ! /usr/bin/python3 -c 'import numpy' 2>/dev/null; then skip "there is no numpy (Debian: apt-get install python3-numpy)"; fi
if ! unshare --user --map-root-user --mount --ipc --net --pid --fork true 2>/dev/null; then skip "there are no unprivileged name spaces"; fi

build=build/linuxcnc_upstream
cmake -G Ninja -B "$build" -DSPLINEFEED_LINUXCNC=ON -DSPLINEFEED_HOST=OFF -DSPLINEFEED_TESTS=OFF -DSPLINEFEED_UNITY_BUILD=OFF \
    -DSPLINEFEED_LINUXCNC_SOURCE="$tree" >"$build.log"
cmake --build "$build" --target splinefeed_tp >>"$build.log" || { tail -20 "$build.log"; exit 1; }
module=$build/linuxcnc/splinefeed_tp.so
failed=0
/usr/bin/python3 tests/linuxcnc/upstream.py "$tree" "$module" || failed=1
/usr/bin/python3 tests/linuxcnc/upstream_programs.py "$tree" "$module" --lines 200 --slower 6 || failed=1
exit "$failed"
