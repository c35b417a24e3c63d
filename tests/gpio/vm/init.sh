#!/bin/busybox sh
# SPDX-License-Identifier: MIT
# First process of the guest: chips, trace, the test's script, and everything that it left through a virtio port to the host.
# What fails before `status` is written is seen by the host as a bed that did not work.
# shellcheck shell=dash
set -e
/bin/busybox --install -s /bin
mount -t devtmpfs dev /dev
mount -t proc proc /proc
mount -t sysfs sysfs /sys
while read -r module; do insmod "/modules/$module.ko"; done </modules/order
mount -t configfs configfs /sys/kernel/config
mount -t debugfs debugfs /sys/kernel/debug
if [ ! -e /sys/kernel/tracing/trace ]; then mount -t tracefs tracefs /sys/kernel/tracing; fi
hostname guest
ip link set lo up

. /guest.sh
make_chip cnc 32 "$cnc_lines"
make_chip aux 8
{
    echo number,chip,offset,name
    line_table cnc 32 "$cnc_lines"
    line_table aux 8
} >/out/lines.csv

trace=/sys/kernel/tracing
echo mono >$trace/trace_clock
echo 32768 >$trace/buffer_size_kb
echo 1 >$trace/events/gpio/gpio_value/enable
echo 1 >$trace/events/gpio/gpio_direction/enable
echo >$trace/trace

cd /test
export PATH="$PATH:/test"
status=0
sh "$(cat /script)" || status=$?

echo 0 >$trace/tracing_on
cat $trace/trace >/out/trace.txt
grep -E '^(overrun|dropped events):' $trace/per_cpu/cpu0/stats >/tmp/lost
if grep -qv ': 0$' /tmp/lost; then
    cat /tmp/lost
    echo "the trace's buffer was too small"
    reboot -f
fi
echo $status >/out/status
tar -c -C /out . >/dev/vport0p1
reboot -f
