#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# docs/pictures/linuxcnc.png: LinuxCNC's screen axis, in a virtual display, while splinefeed_tp.so moves its simulated machine: linuxcnc.sh MODULE. It
# needs linuxcnc-uspace, xvfb and imagemagick, and name spaces of its own (as root, or where users may have them).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
module=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/tmp"
cp -r /usr/lib/linuxcnc/modules "$work/modules"
cp "$module" "$work/modules/splinefeed_tp.so"
cp -r /usr/share/doc/linuxcnc/examples/sample-configs/sim "$work/tmp/sim"
sed '/^T1 M6/d' examples/bracket.ngc >"$work/tmp/bracket.ngc"
sed -i 's|^\[TRAJ\]|[TRAJ]\nTPMOD = splinefeed_tp axes=XYZ jerk=30000|' "$work/tmp/sim/axis/axis_mm.ini"
cat >"$work/tmp/operator.py" <<'PY'
import subprocess, time
import linuxcnc
command = linuxcnc.command()
for state in (linuxcnc.STATE_ESTOP_RESET, linuxcnc.STATE_ON):
    command.state(state)
    command.wait_complete()
command.mode(linuxcnc.MODE_MANUAL)
command.wait_complete()
command.home(-1)
time.sleep(8)
command.mode(linuxcnc.MODE_MDI)
command.wait_complete()
command.mdi("G10 L2 P1 X60 Y60 Z30")
command.wait_complete()
subprocess.run(["axis-remote", "/tmp/bracket.ngc"], check=True)
time.sleep(3)
command.mode(linuxcnc.MODE_AUTO)
command.wait_complete()
command.auto(linuxcnc.AUTO_RUN, 0)
time.sleep(12)
PY
cat >"$work/inside.sh" <<'IN'
set -e
cd /
mount --bind "$1/modules" /usr/lib/linuxcnc/modules
mount --rbind "$1/tmp" /tmp
/usr/bin/python3 -c 'import fcntl, socket, struct
fcntl.ioctl(socket.socket(), 0x8914, struct.pack("16sh14x", b"lo", 0x1 | 0x40))'
export HOME=/tmp PATH=/usr/sbin:/usr/bin:/sbin:/bin DISPLAY=:7 LIBGL_ALWAYS_SOFTWARE=1
cd /tmp/sim/axis
chown -R 65534:65534 /tmp/.
exec setpriv --reuid=65534 --regid=65534 --clear-groups --no-new-privs bash -c '
    Xvfb :7 -screen 0 738x752x24 +extension GLX &
    sleep 2
    linuxcnc -r axis_mm.ini > /tmp/log 2>&1 &
    sleep 15
    python3 /tmp/operator.py
    import -window root -colors 64 /tmp/linuxcnc.png'
IN
chmod -R a+rX "$work"
spaces=(--mount --ipc --net --pid --fork --mount-proc --kill-child)
if ((EUID != 0)); then spaces+=(--user --map-root-user); fi
timeout 120 unshare "${spaces[@]}" bash "$work/inside.sh" "$work"
cp "$work/tmp/linuxcnc.png" docs/pictures/linuxcnc.png
