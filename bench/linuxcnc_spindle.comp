component linuxcnc_spindle "A simulated spindle with an encoder, for bench/linuxcnc_tp.py: SPDX-License-Identifier: MIT";
pin in float speed "asked for, revolutions a second";
pin out float revs "what the encoder has counted since the index, revolutions";
pin out float turns "the same without the encoder's steps";
pin out float speed_in "as the encoder measures it, revolutions a second";
pin io bit index_enable;
pin out bit at_speed;
param rw float wobble = 0 "part of the speed, to both sides";
param rw float wobble_hz = 2;
param rw float load = 0 "part of the speed that is lost from load_at revolutions behind the index on";
param rw float load_at = 11;
param rw float counts = 0 "of the encoder in a revolution; 0: it has no steps";
param rw float acceleration = 100 "revolutions/s^2";
variable double now;
variable double angle;
variable double from;
variable double phase;
variable double measured;
function _ fp;
option singleton yes;
license "GPL";
;;
#include "rtapi_math.h"
FUNCTION(_) {
    const double most = acceleration * fperiod;
    const double asked = from != 0.0 && fabs(angle - from) > load_at ? speed * (1.0 - load) : speed;
    now += fmin(fmax(asked - now, -most), most);
    phase += 2.0 * M_PI * wobble_hz * fperiod;
    const double step = now * (1.0 + wobble * sin(phase)) * fperiod;
    const double before = angle;
    angle += step;
    if (index_enable && floor(angle) != floor(before)) {
        from = step < 0.0 ? floor(before) : floor(angle);
        index_enable = 0;
    }
    turns = angle - from;
    revs = counts > 0.0 ? floor(turns * counts) / counts : turns;
    measured += 0.05 * (step / fperiod - measured); /* as an encoder filters it */
    speed_in = measured;
    at_speed = fabs(now - asked) < 0.01 * fabs(asked);
}
