/* SPDX-License-Identifier: MIT
 * tp_answers.c: settings that motmod makes, and questions that it asks. */
#include "tp_module.h"

int tpSetCycleTime(TP_STRUCT *tp, double secs) {
    if (tp == 0 || !(secs > 0.0)) return TP_ERR_FAIL;
    tp->cycleTime = secs;
    return TP_ERR_OK;
}

int tpSetVmax(TP_STRUCT *tp, double vmax, double ini_maxvel) {
    if (tp == 0 || !(vmax > 0.0) || !(ini_maxvel > 0.0)) return TP_ERR_FAIL;
    tp->vMax = vmax;
    tp->ini_maxvel = ini_maxvel;
    return TP_ERR_OK;
}

/* The slider of the largest velocity: at any time, for moves that are queued, too. */
int tpSetVlimit(TP_STRUCT *tp, double limit) {
    if (tp == 0) return TP_ERR_FAIL;
    tp->vLimit = limit < 0.0 ? 0.0 : limit;
    return TP_ERR_OK;
}

int tpSetAmax(TP_STRUCT *tp, double amax) {
    if (tp == 0 || !(amax > 0.0)) return TP_ERR_FAIL;
    tp->aMax = amax;
    return TP_ERR_OK;
}

int tpSetId(TP_STRUCT *tp, int id) {
    if (tp == 0 || !MOTION_ID_VALID(id)) return TP_ERR_FAIL;
    tp->nextId = id;
    return TP_ERR_OK;
}

int tpSetTermCond(TP_STRUCT *tp, int cond, double tolerance) {
    if (tp == 0 || cond < TC_TERM_COND_STOP || cond > TC_TERM_COND_TANGENT) return TP_ERR_FAIL;
    tp->termCond = cond;
    tp->tolerance = tolerance;
    return TP_ERR_OK;
}

int tpSetPos(TP_STRUCT *tp, EmcPose const *const pos) {
    if (tp == 0) return TP_ERR_FAIL;
    for (int k = 0; k < tpc_axes; ++k) {
        if (!isfinite(tp_coordinate(pos, k))) return TP_ERR_FAIL;
    }
    tp->currentPos = tp->goalPos = *pos;
    tp_state_position(tp);
    return TP_ERR_OK;
}

int tpPause(TP_STRUCT *tp) {
    if (tp == 0) return TP_ERR_FAIL;
    tp->pausing = 1;
    return TP_ERR_OK;
}

int tpResume(TP_STRUCT *tp) {
    if (tp == 0) return TP_ERR_FAIL;
    tp->pausing = 0;
    return TP_ERR_OK;
}

int tpAbort(TP_STRUCT *tp) {
    if (tp == 0) return TP_ERR_FAIL;
    if (!tp->aborting) {
        tp->pausing = 1;
        tp->aborting = 1;
    }
    tp_aborted();
    tp_clear_io(tp);
    return TP_ERR_OK;
}

int tpGetPos(TP_STRUCT const *const tp, EmcPose *const pos) {
    if (tp == 0) return TP_ERR_FAIL;
    *pos = tp->currentPos;
    return TP_ERR_OK;
}

int tpGetExecId(TP_STRUCT *tp) { return tp == 0 ? TP_ERR_FAIL : tp->execId; }
struct state_tag_t tpGetExecTag(TP_STRUCT *const tp) { return tp->execTag; }
int tpIsDone(TP_STRUCT *const tp) { return tp == 0 ? 0 : tp->done; }
int tpQueueDepth(TP_STRUCT *const tp) { return tp == 0 ? 0 : tp->depth; }
int tpActiveDepth(TP_STRUCT *const tp) { return tp == 0 ? 0 : tp->activeDepth; }
int tpGetMotionType(TP_STRUCT *const tp) { return tp->motionType; }

int tpSetSpindleSync(TP_STRUCT *const tp, int spindle, double sync, int mode) {
    if (tp == 0) return TP_ERR_FAIL;
    tp->synchronized = sync == 0.0 ? TC_SYNC_NONE : mode ? TC_SYNC_VELOCITY : TC_SYNC_POSITION;
    tp->uu_per_rev = sync;
    tp->spindle.spindle_num = spindle;
    return TP_ERR_OK;
}

int tpSetAout(TP_STRUCT *const tp, unsigned char index, double start, double end) {
    (void)end;
    if (tp == 0 || index >= EMCMOT_MAX_AIO) return TP_ERR_FAIL;
    tp->syncdio.anychanged = 1;
    tp->syncdio.aio_mask |= 1ULL << index;
    tp->syncdio.aios[index] = start;
    return TP_ERR_OK;
}

int tpSetDout(TP_STRUCT *const tp, int index, unsigned char start, unsigned char end) {
    (void)end;
    if (tp == 0 || index < 0 || index >= EMCMOT_MAX_DIO) return TP_ERR_FAIL;
    tp->syncdio.anychanged = 1;
    tp->syncdio.dio_mask |= 1ULL << index;
    tp->syncdio.dios[index] = start > 0 ? 1 : -1;
    return TP_ERR_OK;
}

/* Asked in every period until the machine stands, while the adaptive feed is negative, and then positive: no message. */
int tpSetRunDir(TP_STRUCT *const tp, tc_direction_t dir) {
    if (tp == 0 || (dir != TC_DIR_FORWARD && dir != TC_DIR_REVERSE) || tp_moves(tp)) return TP_ERR_FAIL;
    tp->reverse_run = dir;
    return TP_ERR_OK;
}

/* motmod asks this of &tp->queue, which is not used here. */
int tcqFull(TC_QUEUE_STRUCT const *const unused) {
    (void)unused;
    return tp_queued() >= tpc_capacity - tpc_kept - 48U;
}

EXPORT_SYMBOL(tpAbort);
EXPORT_SYMBOL(tpActiveDepth);
EXPORT_SYMBOL(tpGetExecId);
EXPORT_SYMBOL(tpGetExecTag);
EXPORT_SYMBOL(tpGetMotionType);
EXPORT_SYMBOL(tpGetPos);
EXPORT_SYMBOL(tpIsDone);
EXPORT_SYMBOL(tpPause);
EXPORT_SYMBOL(tpQueueDepth);
EXPORT_SYMBOL(tpResume);
EXPORT_SYMBOL(tpSetAmax);
EXPORT_SYMBOL(tpSetAout);
EXPORT_SYMBOL(tpSetCycleTime);
EXPORT_SYMBOL(tpSetDout);
EXPORT_SYMBOL(tpSetId);
EXPORT_SYMBOL(tpSetPos);
EXPORT_SYMBOL(tpSetRunDir);
EXPORT_SYMBOL(tpSetSpindleSync);
EXPORT_SYMBOL(tpSetTermCond);
EXPORT_SYMBOL(tpSetVlimit);
EXPORT_SYMBOL(tpSetVmax);
EXPORT_SYMBOL(tcqFull);
