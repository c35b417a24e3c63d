# SPDX-License-Identifier: MIT
# In the guest: runs of splinefeed on the simulated chips, and what can go wrong with them. Judged by runs_judge.py.
# shellcheck shell=dash
. /guest.sh
set -e
chip=$(chip_path cnc)
target="gpio://label=cnc?map=lines.toml"
machine=machine.toml

# begin NAME PROGRAM OPTION...: a run in the background; its trace begins here. Its process is $run.
begin() {
    name=$1
    program=$2
    shift 2
    echo "$name"
    echo "scenario $name" >/sys/kernel/tracing/trace_marker
    ./splinefeed run "$program" -m $machine --target "$target" --edges "/out/$name.edges" --segments "/out/$name.segments" \
        --summary json --quiet "$@" >"/out/$name.json" 2>"/out/$name.err" &
    run=$!
}

# ends: waits for it; its status.
ends() {
    local status=0
    wait "$run" || status=$?
    echo "$status" >"/out/$name.status"
}

# moving: until the run that was begun has made steps for a moment.
moving() {
    wait_for_line ENABLE 0 5
    usleep "${1-500000}"
}

./splinefeed link --target "$target" -m machine.toml --seconds 0.5 >/out/link.txt

begin path61 path61.csv
ends

# Switches.
begin limit there.csv
moving
pull X_LIMIT up
ends
pull X_LIMIT down
begin estop there.csv
moving
pull ESTOP up
ends
begin estop_at_once there.csv
ends
pull ESTOP down
begin probe there.csv --probe
moving
pull PROBE up
ends
pull PROBE down

# The process stands still for 0.2 s: motors that stop so have lost their place.
begin stalled there.csv
moving
kill -STOP $run
usleep 200000
kill -CONT $run
ends
# Where the map tolerates it the run goes on when its user resumes it. Meanwhile an input moves more often than the kernel keeps (16 times a line).
sed 's/^\[thread\]/[thread]\nstall_ms = 1000/' lines.toml >patient.toml
target="gpio://$chip?map=patient.toml"
begin stands_still there.csv
moving
kill -STOP $run
for i in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15; do
    pull PROBE up
    pull PROBE down
done
pull PROBE up
usleep 200000
kill -CONT $run # holds the motion
usleep 100000
kill -USR2 $run
ends
target="gpio://$chip?map=lines.toml"
pull PROBE down

# The user: hold and go on; an end; and what ends a program from outside.
begin steering there.csv
moving
kill -USR1 $run
usleep 500000
kill -USR2 $run
ends
begin sigterm there.csv
moving
kill -TERM $run
ends
begin sigsegv there.csv
moving
kill -SEGV $run
ends
begin sigkill there.csv
moving
kill -KILL $run
ends

# A program that switches lines; and an e-stop while they are on.
machine=chips.toml
sed "s|/dev/gpiochip0|$chip|" outputs.toml >chips.toml
begin outputs outputs.ngc
ends
begin outputs_held outputs.ngc
wait_for_line COOLANT 1 5
wait_for_line SPINDLE 0 5
kill -USR1 $run
usleep 300000
level SPINDLE >/out/held_output
level COOLANT >/out/held_coolant
kill -USR2 $run
ends
begin outputs_estop outputs.ngc
wait_for_line COOLANT 1 5
wait_for_line SPINDLE 0 5
pull ESTOP up
ends
pull ESTOP down
# A spindle on lines: it is at speed later than its time says; an e-stop while it turns.
sed "s|/dev/gpiochip0|$chip|" spindle.toml >chips.toml
begin spindle_lines spindle.ngc
wait_for_line DOOR 1 5
usleep 500000
pull RESUME up
ends
begin spindle_estop spindle.ngc
wait_for_line DOOR 1 5
usleep 400000
pull ESTOP up
ends
pull ESTOP down
pull RESUME down
machine=machine.toml

# What is the same with any libgpiod.
if [ -e all ]; then
    for program in square star; do
        begin $program $program.csv
        ends
    done
    # The other engine; another process that wants the processor all the time.
    sed 's/^\[path\]/[step]\nengine = "fixed-rate"\ntick_us = 50\n[path]/' machine.toml >fixed.toml
    machine=fixed.toml
    begin fixed there.csv
    ends
    machine=machine.toml
    # A line of another chip.
    sed "s|^direction = 5|direction = { chip = \"$(chip_path aux)\", offset = 3 }|" lines.toml >two.toml
    target="gpio://$chip?map=two.toml"
    begin two_chips there.csv
    ends
    target="gpio://$chip?map=lines.toml"
    while :; do :; done &
    busy=$!
    begin busy there.csv
    ends
    kill $busy

    pull X_LIMIT up
    begin limit_at_once there.csv
    ends
    pull X_LIMIT down
    begin drive_fault there.csv
    moving
    pull FAULT up
    ends
    pull FAULT down
    begin probe_nothing there.csv --probe
    ends
    machine=short.toml
    begin home_nothing there.csv --home
    ends
    machine=machine.toml

    # The switch of the x axis, as it is when the carriage comes by: it acts, it is left, it acts again, slowly.
    begin home there.csv --home
    moving 300000
    pull X_HOME up
    wait_for_line X_DIR 1 5
    usleep 50000
    pull X_HOME down
    wait_for_line X_DIR 0 5
    usleep 300000
    echo "switch" >/sys/kernel/tracing/trace_marker
    pull X_HOME up
    wait_for_line X_DIR 1 5
    usleep 50000
    pull X_HOME down
    ends
fi

# Lines that are not to be had.
begin holder there.csv
moving
status=0
./splinefeed link --target "$target" -m machine.toml 2>/out/line_busy.err || status=$?
echo $status >/out/line_busy.status
ends
for wrong in name offset chip label; do
    cp lines.toml wrong.toml
    case $wrong in
        name) sed -i 's/"X_STEP"/"X_STEPP"/' wrong.toml ;;
        offset) sed -i 's/offset = 3/offset = 7/' wrong.toml ;;
    esac
    case $wrong in
        chip) target="gpio:///dev/gpiochip7?map=wrong.toml" ;;
        label) target="gpio://label=none?map=wrong.toml" ;;
        *) target="gpio://$chip?map=wrong.toml" ;;
    esac
    begin wrong_$wrong there.csv
    ends
done
target="gpio://$chip?map=lines.toml"

# Last: the chip is gone.
begin chip_vanishes there.csv
moving
echo 0 >/sys/kernel/config/gpio-sim/cnc/live
status=0
wait $run || status=$?
echo $status >/out/chip_vanishes.status
