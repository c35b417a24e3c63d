#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The bed proves itself: selftest.sh BUILD_DIRECTORY. Every edge that a program makes is in the trace, with libgpiod 1.6 and with
# 2; an input that is pulled gives its edges; the edges of a plan, played in the guest, are found to be the plan's; and a guest
# that fails, hangs or panics is no success.
source "$(dirname "${BASH_SOURCE[0]}")/../../tools/common.sh"

tool=$1/bin/splinefeed
vm=tests/gpio/vm
cache=build/gpio-vm
second=build/gpio-libgpiod2
need g++ python3
python3 $vm/trace_edges_test.py
$vm/prepare.sh $cache || exit # 77 is passed on
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# The same source against every libgpiod that is to be had.
compile() { g++ -std=c++20 -O1 $vm/toggle.cpp "$@" -lgpiod; }
programs=()
if [[ -e /usr/include/gpiod.h ]]; then
    compile -o "$work/toggle_host"
    programs+=("$work/toggle_host")
fi
status=0
$vm/libgpiod2.sh $second || status=$?
if ((status == 0)); then
    compile -o "$work/toggle_2" -isystem $second/include -L$second/lib -Wl,-rpath,"$PWD/$second/lib"
    programs+=("$work/toggle_2")
elif ((status != 77)); then
    exit "$status"
fi
if ((${#programs[@]} == 0)); then skip "no libgpiod to test with"; fi

cat >"$work/functions.sh" <<'GUEST'
. /guest.sh
set -ex
for toggle in ./toggle_*; do
    $toggle set "$(chip_path cnc)" 0 2000
    # An input: its first level is low, and what the reader is told comes from the pull alone.
    $toggle wait "$(chip_path cnc)" 15 4 10 >/out/edges &
    while ! grep -qs ready /out/edges; do usleep 10000; done
    for to in up down up down; do pull PROBE $to; usleep 20000; done
    wait $!
    [ "$(echo $(cat /out/edges))" = 'ready rises falls rises falls' ]
    # A line without a name on the other chip; an output as a meter sees it, from another process.
    $toggle set "$(chip_path aux)" 3 1
    $toggle wait "$(chip_path aux)" 7 1 5 >/tmp/aux &
    while ! grep -qs ready /tmp/aux; do usleep 10000; done
    pull aux:7 up
    wait $!
    pull aux:7 down
    rm /tmp/aux /out/edges
    (sleep 1; pull FAULT up) &
    wait_for_line FAULT 1 5
    pull FAULT down
    wait
done
if wait_for_line ENABLE 1 1 || level NO_SUCH_LINE; then exit 1; fi
chip_path cnc >/out/path
GUEST

echo "== functions, on ${#programs[@]} libraries"
$vm/run.sh $cache "$work/out" "$work/functions.sh" "${programs[@]}"
[[ $(<"$work/out/path") == /dev/gpiochip[01] ]]
edges=$((2000 * ${#programs[@]}))
python3 - "$work/out" $edges $vm <<'PYTHON'
import sys
out, meant = sys.argv[1], int(sys.argv[2])
sys.path.insert(0, sys.argv[3])
from trace_edges import follow, line_edges, read_lines, read_trace
edges = line_edges(read_trace(out + "/trace.txt"), read_lines(out + "/lines.csv"))
print(f"{len(edges)} of {meant} edges seen; high {follow(edges, 'x').step_length_us} us and low {follow(edges, 'x').step_space_us} us at least")
sys.exit(len(edges) != meant or {edge[1:3] for edge in edges} != {("x", "step")} or follow(edges, "x").up + follow(edges, "x").down != meant // 2)
PYTHON

echo "== the edges of a plan"
sed 's/^steps_per_mm.*/steps_per_mm = 20/' examples/three_axis.toml >"$work/machine.toml"
"$tool" plan examples/path61.csv -m "$work/machine.toml" --edges "$work/plan.csv" >"$work/plan.log"
# Offsets as the guest's chip has them.
sed '1d; s/x,step/0/; s/x,dir/1/; s/y,step/2/; s/y,dir/3/; s/z,step/4/; s/z,dir/5/' "$work/plan.csv" >"$work/play.csv"
cat >"$work/play.sh" <<'GUEST'
. /guest.sh
set -e
./toggle_* play "$(chip_path cnc)" play.csv
GUEST
GPIO_VM_TIME=virtual $vm/run.sh $cache "$work/out" "$work/play.sh" "${programs[-1]}" "$work/play.csv"
against() { $vm/trace_edges.py "$work/out/trace.txt" --lines "$work/out/lines.csv" --against "$1"; }
against "$work/plan.csv" | tee "$work/told"
# Virtual time does not depend on the host: 0.08 ms were measured, 50 us of them the timer slack of a common process.
late=$(sed -n 's/.* \([0-9]*\) us (worst)$/\1/p' "$work/told")
if ((late > 1000)); then
    echo "virtual time is late by $late us"
    exit 1
fi
# One edge less, or a row of one axis as another's: to be seen.
sed '50d' "$work/plan.csv" >"$work/less.csv"
sed '50s/,[xyz],/,a,/' "$work/plan.csv" >"$work/other.csv"
for wrong in less other; do
    if against "$work/$wrong.csv" >"$work/told"; then
        echo "a plan that is another one ($wrong) was not noticed"
        exit 1
    fi
    sed -n '/: /s/^/    seen: /p' "$work/told"
done

# fails STATUS REASON LINE_OF_GUEST [SECONDS]: what the run is to end with, and what it says.
fails() {
    local status=0
    echo "$3" >"$work/fails.sh"
    GPIO_VM_SECONDS=${4-60} $vm/run.sh $cache "$work/out" "$work/fails.sh" "${programs[-1]}" 2>"$work/told" || status=$?
    if ((status != $1)) || ! grep --quiet "$2" "$work/told"; then
        cat "$work/told"
        echo "'$3' ends with status $status instead of $1 ($2)"
        exit 1
    fi
    echo "    '$3': status $status, $2"
}
echo "== guests that fail"
fails 3 'cannot go on' 'echo cannot go on; exit 3'
fails 99 'not finished after 12 s' 'while :; do sleep 1; done' 12
fails 99 'it ended before' 'echo c >/proc/sysrq-trigger'
fails 99 'buffer was too small' 'echo 64 >/sys/kernel/tracing/buffer_size_kb; ./toggle_* set /dev/gpiochip0 0 20000'
