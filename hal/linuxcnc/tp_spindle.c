/* SPDX-License-Identifier: MIT
 * tp_spindle.c: the spindle that moves follow: its index, and what it has turned. */
#include "tp_module.h"

static int awaited = -1; /* spindle whose index a move waits for */

void tp_forget_index(TP_STRUCT *tp, emcmot_status_t *status) {
    if (awaited != -1) status->spindle_status[awaited].spindle_index_enable = 0;
    tp->spindle.waiting_for_index = MOTION_INVALID_ID;
    awaited = -1;
}

int tp_index_passed(TP_STRUCT *tp, emcmot_status_t *status, int spindle, int id) {
    if (awaited != -1 && !status->spindle_status[awaited].spindle_index_enable) {
        tp_forget_index(tp, status);
        return 1;
    }
    if (awaited == -1 && !tp->pausing && status->net_feed_scale > 0.0) {
        awaited = spindle;
        tp->spindle.waiting_for_index = id;
        status->spindle_status[awaited].spindle_index_enable = 1;
    }
    return 0;
}

/* motion.h says that the speed is in revolutions a minute; motmod copies HAL's pin, which has them a second. */
void tp_tell_spindle(const spindle_status_t *spindle) {
    const double turns = spindle->spindleRevs;
    tpc_spindle(spindle->direction < 0 ? -turns : turns, fabs(spindle->spindleSpeedIn));
}

/* Its direction stays what the program says, so its turns are counted down on the way back. */
void tp_reverse(spindle_status_t *spindle, double back, int turn) { spindle->speed *= turn == 1 ? -back : -1.0 / back; }
