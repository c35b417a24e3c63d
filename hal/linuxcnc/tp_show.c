/* SPDX-License-Identifier: MIT
 * tp_show.c: what screens see of a machine that stands, and of its speed. */
#include "tp_module.h"

#include <string.h>

void tp_show_rest(TP_STRUCT *tp, emcmot_status_t *status) {
    status->distance_to_go = 0.0;
    status->enables_queued = status->enables_new;
    status->requested_vel = 0.0;
    status->current_vel = 0.0;
#ifdef SPLINEFEED_TP_JERK
    status->current_acc = status->current_jerk = 0.0;
#endif
    status->spindleSync = 0;
    memset(&status->dtg, 0, sizeof status->dtg);
    tp->motionType = 0;
    tp->activeDepth = tp->depth = 0;
    tp->execId = 0;
}

/* 2.10 shows the acceleration and the jerk along the path, too. */
void tp_show_speed(const TP_STRUCT *tp, emcmot_status_t *status, double speed) {
#ifdef SPLINEFEED_TP_JERK
    const double acceleration = (speed - status->current_vel) / tp->cycleTime;
    status->current_jerk = (acceleration - status->current_acc) / tp->cycleTime;
    status->current_acc = acceleration;
#else
    (void)tp;
#endif
    status->current_vel = speed;
}
