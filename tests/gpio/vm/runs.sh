#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs on a real GPIO chip in the virtual machine, a served machine, and all that can go wrong: runs.sh BUILD_DIRECTORY. With the build's
# libgpiod; with SPLINEFEED_LONG=1 in a second machine with libgpiod 2, too.
source "$(dirname "${BASH_SOURCE[0]}")/../../tools/common.sh"

build=$1
vm=tests/gpio/vm
cache=build/gpio-vm
second=build/gpio-libgpiod2
need g++ python3
# Not through a pipe: grep would end it early, and ldd fail.
if [[ $(ldd "$build/bin/splinefeed") != *libgpiod* ]]; then skip "this build has no libgpiod"; fi
$vm/prepare.sh $cache || exit # 77 is passed on
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Fast and coarse, 800 steps/s an axis: an emulated processor has not too much to do.
sed 's/^steps_per_mm.*/steps_per_mm = 4/; s/^\(max_velocity_mm_s\|max_feed_mm_s\) .*/\1 = 200/; s/^max_acceleration_mm_s2.*/max_acceleration_mm_s2 = 3000/' \
    examples/three_axis.toml >"$work/machine.toml"
sed 's/^name = "x"/&\ntravel_mm = [-10, 90]/' "$work/machine.toml" >"$work/short.toml"
# Coolant and an output of a program, on lines beside those of the map.
{
    cat "$work/machine.toml"
    printf '[lines]\nchip = "/dev/gpiochip0"\n[coolant.flood]\nline = "COOLANT"\n'
    printf '[[output]]\nnumber = 3\nline = "SPINDLE"\nactive = "low"\n'
} >"$work/outputs.toml"
{
    cat "$work/machine.toml"
    printf '[lines]\nchip = "/dev/gpiochip0"\n[spindle]\nmax_rpm = 1000\nspin_up_s = 0.2\nenable = { line = "DOOR" }\n'
    printf 'at_speed = { line = "RESUME" }\n'
} >"$work/spindle.toml"
printf 'G21 G90 G64\nG1 X10 F3000\nS500 M3\nX30\nM5\nX40\nM2\n' >"$work/spindle.ngc"
printf 'G21 G90 G64\nM8\nG1 X20 F3000\nM62 P3\nX40 Y5\nM63 P3\nX60\nM9\nX80\nM2\n' >"$work/outputs.ngc"
cp $vm/lines.toml examples/{square,star,path61}.csv "$work"
printf 'x,y,z\n10,0,0\n70,40,10\n10,0,0\n' >"$work/there.csv"
touch "$work/all"
status=77
if [[ ${SPLINEFEED_LONG:-0} == 1 ]]; then
    status=0
    $vm/libgpiod2.sh $second || status=$?
else
    echo "the machine with libgpiod 2 is a part of ./check --long"
fi
programs=("$build/bin/splinefeed")
if ((status == 0)); then
    # The same program: only hal/gpio knows which libgpiod there is.
    mkdir "$work/objects" "$work/second"
    for source in hal/splinefeed/hal/gpio/*.cpp; do
        if [[ $source != *pins_v1.cpp ]]; then
            g++ -std=c++20 -O2 -DNDEBUG -ffp-contract=off -Ihal -Ifirmware_core -isystem $second/include -c "$source" \
                -o "$work/objects/$(basename "$source").o"
        fi
    done
    libraries=("$build"/host_sim/libsplinefeed_host.a "$work"/objects/*.o "$build"/hal/libsplinefeed_hal_modbus.a
        "$build"/hal/libsplinefeed_hal_rt.a
        "$build"/firmware_core/libsplinefeed_core.a)
    g++ -o "$work/second/splinefeed" "$build"/host_sim/CMakeFiles/splinefeed_tool.dir/cli/main.cpp.o "${libraries[@]}" -L$second/lib \
        -Wl,-rpath,"$PWD/$second/lib" -lgpiod -lmodbus -lfmt -ltomlplusplus -lpthread
    programs+=("$work/second/splinefeed")
elif ((status != 77)); then
    exit "$status"
fi
files=("$work"/{machine,short,lines,outputs,spindle}.toml "$work"/*.{csv,ngc})
export GPIO_VM_TIME=virtual GPIO_VM_SECONDS=600 # time of the machine; a limit in time of a busy host
$vm/run.sh $cache "$work/first" $vm/runs_guest.sh "${programs[0]}" "${files[@]}" "$work/all" &
first=$!
served=0 # what failed there does not end the others
$vm/run.sh $cache "$work/served" $vm/serve_guest.sh "${programs[0]}" "$work"/{outputs,lines}.toml || served=$?
if ((served == 0)); then python3 $vm/serve_judge.py "$work/served" || served=$?; fi
if ((${#programs[@]} > 1)); then
    $vm/run.sh $cache "$work/second/out" $vm/runs_guest.sh "${programs[1]}" "${files[@]}"
    ldd "${programs[1]}" | grep libgpiod
    python3 $vm/runs_judge.py "$work/second/out"
fi
wait $first
ldd "${programs[0]}" | grep libgpiod
cat "$work/first/link.txt"
python3 $vm/runs_judge.py "$work/first"
exit $served
