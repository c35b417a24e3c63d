/* SPDX-License-Identifier: MIT
 * tp_feed.c: the feed of a move, and the overrides of this moment. */
#include "tp_module.h"

/* Task limits the feed of an arc to less than the axes allow, sqrt(0.87 a r). Where it has done so, what the program says
 * is in the tag. */
double tp_feed(int canon, double vel, double max_vel, const struct state_tag_t *tag, double mm_per_unit) {
    const unsigned long flags = tag->packed_flags;
    if (canon == EMC_MOTION_TYPE_TRAVERSE || vel < max_vel * (1.0 - 1e-9) || !(flags >> GM_FLAG_FEED_UPM & 1) ||
        (flags >> GM_FLAG_FEED_INVERSE_TIME & 1)) {
        return vel;
    }
    const double mm = flags >> GM_FLAG_UNITS & 1 ? 25.4 : 1.0; /* of the program's unit */
    const double asked = (double)tag->fields_float[GM_FIELD_FLOAT_FEED] * mm / mm_per_unit / 60.0;
    return asked > vel ? asked : vel;
}

/* motmod has multiplied the override of the kind of move that was under way, feed or rapid, with what both have in common:
 * adaptive feed and feed hold. That is kept while the override is 0. */
void tp_override(const emcmot_status_t *status, int rapid, double turns, struct tpc_input *in) {
    static double common = 1.0;
    const double least = 1.0 / 128.0;
    const int scaled = (status->enables_queued & FS_ENABLED) != 0;
    const double feeds = scaled ? status->feed_scale : 1.0, rapids = scaled ? status->rapid_scale : 1.0;
    const double own = status->motionType == EMC_MOTION_TYPE_TRAVERSE ? rapids : feeds;
    if (own > 0.0) common = status->net_feed_scale / own;
    in->rapids = rapids * common;
    in->ratio = feeds * common * turns;
    if (rapid) in->ratio = fmax(in->ratio, least); /* it goes on, and the feed behind it stops where it begins */
    if (!(status->net_feed_scale > 0.0)) in->ratio = 0.0;
}
