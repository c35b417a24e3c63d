# SPDX-License-Identifier: MIT
# For scripts in the guest, `. /guest.sh`: the simulated chips from outside, as the machine that is wired to them.
# A LINE is a name (X_STEP) or CHIP:OFFSET (aux:3). Every function fails with a message where there is no such line.
# shellcheck shell=dash

# Names of the lines of `cnc`, from offset 0; '-' has none. `aux` has 8 lines without names.
cnc_lines='X_STEP X_DIR Y_STEP Y_DIR Z_STEP Z_DIR ENABLE SPINDLE ESTOP X_LIMIT Y_LIMIT Z_LIMIT X_HOME Y_HOME Z_HOME PROBE
    FAULT DOOR HOLD RESUME X2_STEP X2_DIR Y2_STEP Y2_DIR A_STEP A_DIR B_STEP B_DIR C_STEP C_DIR COOLANT -'

# chip_path NAME: the device of the chip, /dev/gpiochipN.
chip_path() {
    echo "/dev/$(cat "/sys/kernel/config/gpio-sim/$1/bank0/chip_name")"
}

# line_folder LINE: the folder of sysfs where gpio-sim lets the line be driven and read.
line_folder() {
    local chip=cnc offset=0 name folder
    case $1 in
        *:*) chip=${1%:*} offset=${1#*:} ;;
        *)
            for name in $cnc_lines; do
                if [ "$name" = "$1" ]; then break; fi
                offset=$((offset + 1))
            done
            ;;
    esac
    folder=/sys/kernel/config/gpio-sim/$chip
    folder=/sys/devices/platform/$(cat "$folder/dev_name")/$(cat "$folder/bank0/chip_name")/sim_gpio$offset
    if [ ! -d "$folder" ]; then
        echo "there is no line $1" >&2
        return 1
    fi
    echo "$folder"
}

# pull LINE up|down: drives an input. An output keeps its level and takes this one when it is released.
pull() {
    local folder
    folder=$(line_folder "$1") && echo "pull-$2" >"$folder/pull"
}

# level LINE: 0 or 1, what a meter would show, of an output as of an input.
level() {
    local folder
    folder=$(line_folder "$1") && cat "$folder/value"
}

# wait_for_line LINE VALUE SECONDS: until the line has the level; fails where it has not within SECONDS (a whole number).
wait_for_line() {
    local folder tries
    folder=$(line_folder "$1") || return 1
    tries=$(($3 * 100))
    while [ "$(cat "$folder/value")" != "$2" ]; do
        tries=$((tries - 1))
        if [ "$tries" -le 0 ]; then
            echo "$1 is not $2 within $3 s" >&2
            return 1
        fi
        usleep 10000
    done
}

# make_chip NAME LINES [NAMES]: a chip with that many lines, of which the first have names.
make_chip() {
    local chip=/sys/kernel/config/gpio-sim/$1 offset=0 name
    mkdir -p "$chip/bank0"
    echo "$2" >"$chip/bank0/num_lines"
    echo "$1" >"$chip/bank0/label"
    for name in $3; do
        if [ "$name" != - ]; then
            mkdir "$chip/bank0/line$offset"
            echo "$name" >"$chip/bank0/line$offset/name"
        fi
        offset=$((offset + 1))
    done
    echo 1 >"$chip/live"
}

# line_table NAME LINES [NAMES]: rows number,chip,offset,name; the number is that of the trace's events.
line_table() {
    local base offset=0 name
    base=$(sed -n "s/^$(cat "/sys/kernel/config/gpio-sim/$1/bank0/chip_name"): GPIOs \([0-9]*\)-.*/\1/p" /sys/kernel/debug/gpio)
    if [ -z "$base" ]; then return 1; fi
    # shellcheck disable=SC2086 # one name, one parameter
    set -- "$1" "$2" $3
    while [ "$offset" -lt "$2" ]; do
        name=${3-}
        echo "$((base + offset)),$1,$offset,${name#-}"
        offset=$((offset + 1))
        if [ $# -gt 2 ]; then
            local chip=$1 lines=$2
            shift 3
            set -- "$chip" "$lines" "$@"
        fi
    done
}
