# SPDX-License-Identifier: MIT
# In the guest: a sender operates a served machine on the simulated chip, while people and switches act on it. Judged by serve_judge.py.
# shellcheck shell=dash disable=SC2016 # $ begins an order of grbl
. /guest.sh
set -e
sed "s|/dev/gpiochip0|$(chip_path cnc)|" outputs.toml >machine.toml
./splinefeed serve -m machine.toml --target "gpio://label=cnc?map=lines.toml" --tcp 127.0.0.1:2300 --state /out/state.json >/out/serve.out 2>/out/serve.err &
server=$!
usleep 500000
until grep -q 2300 /out/serve.out; do usleep 50000; done
mkfifo /tmp/orders
nc 127.0.0.1 2300 </tmp/orders >/out/said &
exec 3>/tmp/orders
heard=0 # lines of /out/said

# sends BYTES: as printf has them; what acts at once.
sends() {
    # shellcheck disable=SC2059 # that is what it is for
    printf "$1" >&3
}

# hears PATTERN: the next line that matches is there within 20 s.
hears() {
    local tries=400 at # each a process or two, which cost an emulated processor more than the machine does
    until at=$(tail -n "+$((heard + 1))" /out/said | grep -n -m 1 "$1"); do
        tries=$((tries - 1))
        if [ $tries -le 0 ]; then
            echo "$1 is never heard; at last:"
            tail -n 5 /out/said
            return 1
        fi
        usleep 50000
    done
    heard=$((heard + ${at%%:*}))
}

# order LINE: is answered by ok.
order() {
    sends "$1\n"
    hears '^ok'
}

# mark WORDS: in the trace.
mark() { echo "$*" >/sys/kernel/tracing/trace_marker; }

# rests STATE NAME: once the machine is in STATE the trace has where it says that it stands.
rests() {
    local tries=100 status=
    until [ "${status%%|*}" = "<$1" ]; do
        tries=$((tries - 1))
        if [ $tries -le 0 ]; then
            echo "$2: never $1: $status"
            return 1
        fi
        usleep 100000
        sends '?'
        hears '^<'
        status=$(sed -n "${heard}p" /out/said)
    done
    usleep 100000
    status=${status#*MPos:}
    mark "place $2 ${status%%|*}"
}

# under_way LINE: a motion, and 0.4 s of it.
under_way() {
    order "$1"
    usleep 400000
}

# unlocked: behind an alarm.
unlocked() {
    sends '\030'
    hears '^Grbl'
    order '$X'
}

hears '^Grbl'
order '$X' # nothing if it is not locked
order 'G21 G90 G64 F3000'
for line in 'G1 X10' 'X20 Y10' 'Z-2.5' 'G2 X30 Y20 R10' 'G1 X25.25 Y0.75' 'G0 X10 Y5 Z0'; do order "$line"; done
rests Idle program

under_way '$J=G91 X60 F3000'
sends '\205'
rests Idle jog_cancelled
order '$J=G91 X-2.25 F600'
rests Idle jog

under_way 'G90 G1 X80 Y20 F3000'
sends '!'
rests Hold:0 held
usleep 300000
mark resume
sends '~'
rests Idle resumed

order M8
level COOLANT >/out/coolant
under_way 'G1 X10'
sends '\030'
hears '^Grbl'
rests Idle reset
level COOLANT >>/out/coolant

# The switch of the x axis, as it is when the carriage comes by: it acts, it is left, it acts again, slowly.
sends '$H\n'
usleep 600000
pull X_HOME up
wait_for_line X_DIR 1 5
usleep 50000
pull X_HOME down
wait_for_line X_DIR 0 5
usleep 300000
mark switch
pull X_HOME up
wait_for_line X_DIR 1 5
usleep 50000
pull X_HOME down
hears '^ok'
rests Idle homed

sends 'G21 G91 G38.2 X20 F600\n' # is answered when it is over
usleep 500000
mark touch
pull PROBE up
hears '^.PRB:'
mark "touched $(sed -n "${heard}s/.PRB:\(.*\):1.*/\1/p" /out/said)"
pull PROBE down
rests Idle probed

for input in X_LIMIT FAULT; do
    order 'G90 G0 X10'
    rests Idle "before_$input"
    under_way 'G1 X80 F3000'
    pull $input up
    hears '^ALARM:'
    rests Alarm "at_$input"
    pull $input down
    usleep 100000
    unlocked
done
sed -n 's/^\(ALARM:[0-9]*\).*/\1/p' /out/said | tr '\n' ' ' >/out/alarms

under_way 'G90 G1 X5 F3000'
pull ESTOP up
mark estop # behind it: to pull takes processes, and those take longer than the port does
hears '^ALARM:10'
level ENABLE >/out/enable
usleep 300000
mark estop_over
pull ESTOP down
usleep 100000
unlocked
rests Idle behind_estop
order 'G91 G1 X3.5 Y-1 F3000'
rests Idle at_last

# Last: the chip is gone.
under_way 'G91 G1 X40 F3000'
mark gone
echo 0 >/sys/kernel/config/gpio-sim/cnc/live
hears '^ALARM:'
usleep 200000
kill -TERM $server
status=0
wait $server || status=$?
echo $status >/out/served
