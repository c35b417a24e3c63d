#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# LinuxCNC with splinefeed_tp.so, headless and simulated: limits, ends and steering, at 1 ms and 0.25 ms, with and without a jerk limit, with planning starved in
# a tenth of the periods. Single step. Reverse run. Threads and taps that follow a spindle.
source "$(dirname "${BASH_SOURCE[0]}")/../tools/common.sh"

need linuxcnc unshare setpriv /usr/bin/python3
if [[ ! -e /usr/include/linuxcnc/tp.h ]]; then skip "there are no headers of LinuxCNC (Debian: apt-get install linuxcnc-uspace-dev)"; fi
if ! unshare --user --map-root-user --mount --ipc --net --pid --fork true 2>/dev/null; then skip "there are no unprivileged name spaces"; fi
if ! /usr/bin/python3 -c 'import numpy' 2>/dev/null; then skip "there is no numpy (Debian: apt-get install python3-numpy)"; fi

build=build/linuxcnc
cmake -G Ninja -B "$build" -DSPLINEFEED_LINUXCNC=ON -DSPLINEFEED_HOST=OFF -DSPLINEFEED_TESTS=OFF -DSPLINEFEED_UNITY_BUILD=OFF \
    -DSPLINEFEED_WERROR=ON >"$build.log"
cmake --build "$build" --target splinefeed_tp >>"$build.log" || { tail -20 "$build.log"; exit 1; }
bench() { /usr/bin/python3 bench/linuxcnc_tp.py tests/linuxcnc/program.ngc --check "$@"; }
bench --planner stock,module
bench --planner stock,module --inch
bench --planner module --period 250
bench --planner stock,module --mode G64
bench --planner module --mode G64 --parameters tolerance_um=50
/usr/bin/python3 bench/linuxcnc_tp.py tests/linuxcnc/refused.ngc --check --planner module --set AXIS_Z.MAX_VELOCITY=200000 --set AXIS_Z.MAX_ACCELERATION=20000000
/usr/bin/python3 bench/linuxcnc_tp.py tests/linuxcnc/refused.ngc --check --planner module --set AXIS_X.MAX_ACCELERATION=0.05 \
    --refused "max_acceleration_mm_s2 must lie between 0.1 and 1000000"
/usr/bin/python3 bench/linuxcnc_spindle.py --planner module --check 20 --inch
/usr/bin/python3 bench/linuxcnc_spindle.py --planner module --check 20 --jerk 30000 --steer 4
for jerk in 0 30000; do
    /usr/bin/python3 bench/linuxcnc_tp.py tests/linuxcnc/indexer.ngc --check --planner module --indexer --jerk "$jerk"
    /usr/bin/python3 bench/linuxcnc_tp.py tests/linuxcnc/steps.ngc --check --planner module --step --jerk "$jerk"
    /usr/bin/python3 bench/linuxcnc_tp.py tests/linuxcnc/back.ngc --check --planner module --back --jerk "$jerk"
    bench --planner module --jerk "$jerk" --steer 1 --runs 3 --starve 10
done
