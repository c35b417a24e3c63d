/* SPDX-License-Identifier: MIT
 * splinefeed_tp.c: LinuxCNC's trajectory planner ([TRAJ] TPMOD = splinefeed_tp) on splinefeed's core: the functions that
 * motmod calls. The module as a whole is GPL, because it is compiled with LinuxCNC's headers.
 *
 * All of them but tpMotFunctions, tpMotData and tpCreate are called in the servo thread: moves in one HAL function,
 * tpRunCycle in another one behind it. */
#include "tp_module.h"

#include <string.h>

/* ------------------------------------------------------------------ what motmod hands over */
static emcmot_status_t *status;
static emcmot_config_t *config;
static void (*dio_write)(int, char);
static void (*aio_write)(int, double);
static void (*set_rotary_unlock)(int, int);
static int (*is_rotary_unlocked)(int);
static double (*velocity_limit)(int);
static double (*acceleration_limit)(int);

void tpMotFunctions(void (*dio)(int, char), void (*aio)(int, double), void (*unlock)(int, int), int (*unlocked)(int),
                    double (*vel)(int), double (*acc)(int)) {
    dio_write = dio;
    aio_write = aio;
    set_rotary_unlock = unlock;
    is_rotary_unlocked = unlocked;
    velocity_limit = vel;
    acceleration_limit = acc;
}

void tpMotData(emcmot_status_t *s, emcmot_config_t *c) {
    status = s;
    config = c;
}

/* ------------------------------------------------------------------ state */
/* What the screens and the outputs need of a move; its place in the queue is that of the core. */
struct told {
    EmcPose end;
    double vel;
    double pitch; /* of a move that follows the spindle's position */
    double back;  /* how much faster it turns back from a tap; 0: no tap */
    int id, canon, indexer, synced, rapid;
    unsigned char enables;
    char atspeed;
    struct state_tag_t tag;
};
static struct told told[tpc_capacity];
static syncdio_t io[tpc_capacity];
static struct tpc_output out; /* of the last period */
static unsigned begun;        /* moves before it have written their outputs */
static int locking = -1;      /* joint of an indexer that is to be locked before anything else moves */
static struct tpc_machine machine;
static int feeds_synced;      /* whether the newest move with a feed follows the spindle's speed */
static int failed;            /* the core gave up the queue, and task does not know yet: no move is taken */

static void read_limits(double period_s) {
#ifdef SPLINEFEED_TP_JERK
    const double jerk = status->planner_type == 1 ? status->jerk : 0.0;
#else
    const double jerk = 0.0;
#endif
    module_limits(&machine, period_s, velocity_limit, acceleration_limit, jerk);
}

/* ------------------------------------------------------------------ ends and beginnings */
void tp_clear_io(TP_STRUCT *tp) { memset(&tp->syncdio, 0, sizeof tp->syncdio); }

unsigned tp_queued(void) { return out.last - out.first; }
int tp_moves(const TP_STRUCT *tp) {
    return status->current_vel > 0.0 || MOTION_ID_VALID(tp->spindle.waiting_for_atspeed) || MOTION_ID_VALID(tp->spindle.waiting_for_index);
}

/* An error that is not one of a new move: an abort, and task ends its program at this flag. Until it does, moves that it has
 * sent meanwhile are refused, because they would begin elsewhere. */
static void give_up(TP_STRUCT *tp, const char *reason) {
    rtapi_print_msg(RTAPI_MSG_ERR, "splinefeed_tp: %s\n", reason);
    tpAbort(tp);
    failed = 1;
    status->motionFlag |= EMCMOT_MOTION_ERROR_BIT;
}

void tp_aborted(void) { failed = 0; }

/* Nothing is queued, and the machine stands. */
static void all_over(TP_STRUCT *tp) {
    tp->goalPos = tp->currentPos;
    tp->done = 1;
    if (tp->aborting) tp->reverse_run = TC_DIR_FORWARD;
    tp->aborting = 0;
    tp->pausing = 0;
    begun = out.last;
    locking = -1;
    tp_show_rest(tp, status);
}

void tp_state_position(TP_STRUCT *tp) {
    double position[tpc_axes];
    tp_to_array(&tp->currentPos, position);
    tpc_set(position);
    out.first = out.pushed = out.last;
    out.waits = failed = 0;
}

int tpClear(TP_STRUCT *tp) {
    tp_state_position(tp);
    all_over(tp);
    tp->nextId = 0;
    memset(&tp->execTag, 0, sizeof tp->execTag);
    tp->termCond = TC_TERM_COND_PARABOLIC;
    tp->tolerance = 0.0;
    tp->reverse_run = TC_DIR_FORWARD;
    tp->synchronized = 0;
    tp->uu_per_rev = 0.0;
    tp->spindle.waiting_for_atspeed = MOTION_INVALID_ID;
    tp_forget_index(tp, status);
    status->motionFlag |= EMCMOT_MOTION_INPOS_BIT;
    tp_clear_io(tp);
    return TP_ERR_OK;
}

int tpCreate(TP_STRUCT *tp, int size, int id) {
    (void)id;
    if (tp == 0 || size <= 0 || status == 0 || config == 0) return TP_ERR_FAIL;
    memset(tp, 0, sizeof *tp);
    memset(told, 0, sizeof told); /* its pages are there before the first period */
    memset(io, 0, sizeof io);
    memset(&out, 0, sizeof out);
    begun = 0;
    tp->queueSize = size;
    module_create(&machine);
    return tpClear(tp);
}

/* ------------------------------------------------------------------ new moves */
static int refused(TP_STRUCT *tp, const EmcPose *end) {
    if (tp == 0 || tp->aborting || failed || out.last - out.first >= tpc_capacity) return TP_ERR_FAIL;
    for (int k = 0; k < tpc_axes; ++k) {
        if (!module_has_axis(k) && fabs(tp_coordinate(end, k) - tp_coordinate(&tp->goalPos, k)) > 1e-9) {
            rtapi_print_msg(RTAPI_MSG_ERR, "splinefeed_tp: axis %c moves, but the module's parameter axes does not name it\n",
                            "XYZABCUVW"[k]);
            return TP_ERR_INVALID;
        }
    }
    return TP_ERR_OK;
}

struct new_move { /* what tpAddLine and tpAddCircle have in common */
    int canon, indexer;
    double vel, max_vel;
    unsigned char enables;
    char atspeed;
    struct state_tag_t *tag;
    double back; /* of a tap */
};

/* Moves that follow the spindle's speed have the feed of this speed, 1/s. Their override makes it that of the true one. */
static const double nominal_per_s = 1000.0;

/* Whether the machine has to stand before a move: until the spindle has its speed, or an indexer is unlocked or locked.
 * And where moves begin or end to follow the spindle, because there is one override for all feeds. Moves that follow its
 * position begin at its index, but behind another one of theirs. */
static int stands_before(const struct new_move *from, int rapid, int synced, double pitch) {
    const int empty = out.first == out.last;
    const struct told *newest = &told[(out.last - 1) % tpc_capacity];
    const int behind_indexer = locking != -1 || (!empty && newest->indexer != -1);
    const int changes = pitch > 0.0 ? empty || !(newest->pitch > 0.0) || newest->back > 0.0 || newest->synced != synced
                                    : !empty && !rapid && (synced != 0) != feeds_synced;
    return from->atspeed || from->indexer != -1 || behind_indexer || changes;
}

static int append(TP_STRUCT *tp, const EmcPose *end, struct tpc_move *move, const struct new_move *from) {
    const int synced = tp->synchronized != TC_SYNC_NONE ? tp->spindle.spindle_num + 1 : 0;
    move->pitch = tp->synchronized == TC_SYNC_POSITION ? fabs(tp->uu_per_rev) : 0.0;
    move->feed = synced && !(move->pitch > 0.0)
                     ? tp->uu_per_rev * nominal_per_s
                     : tp_feed(from->canon, from->vel, from->max_vel, from->tag, machine.mm_per_unit);
    move->mode = tp->termCond == TC_TERM_COND_STOP    ? TPC_EXACT_STOP
                 : tp->termCond == TC_TERM_COND_EXACT ? TPC_EXACT_PATH
                                                      : TPC_CONTINUOUS;
    if (move->mode == TPC_CONTINUOUS) module_tolerance(tp->tolerance, from->vel, acceleration_limit, move);
    move->rapid = from->canon == EMC_MOTION_TYPE_TRAVERSE && !synced;
    move->stands_before = stands_before(from, move->rapid, synced, move->pitch);
    move->stops = from->indexer != -1;
    move->probes = from->canon == EMC_MOTION_TYPE_PROBING;
    tp_to_array(end, move->to);
    const int error = tpc_add(move);
    if (error == -1) return TP_ERR_ZERO_LENGTH;
    if (error != 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "splinefeed_tp: move %d: %s\n", tp->nextId, tpc_reason(error));
        return TP_ERR_INVALID;
    }
    struct told *q = &told[out.last % tpc_capacity];
    q->end = move->taps ? tp->goalPos : *end; /* a tap ends where it begins */
    q->vel = from->vel;
    q->id = tp->nextId;
    q->canon = from->canon;
    q->indexer = from->indexer;
    q->synced = synced;
    q->pitch = move->pitch;
    q->back = from->back;
    q->rapid = move->rapid;
    if (!q->rapid && !(q->pitch > 0.0)) feeds_synced = synced != 0;
    q->enables = from->enables;
    q->atspeed = from->atspeed;
    q->tag = *from->tag;
    io[out.last % tpc_capacity] = tp->syncdio;
    ++out.last;
    tp->goalPos = q->end;
    tp->nextId = q->id + 1;
    tp->done = 0;
    tp->depth = (int)(out.last - out.first);
    tp_clear_io(tp);
    return TP_ERR_OK;
}

int tpAddLine(TP_STRUCT *tp, EmcPose end, int canon, double vel, double max_vel, double acc TP_JERK_PARAMETER,
              unsigned char enables, char atspeed, int indexer, struct state_tag_t tag) {
    (void)acc;
    TP_JERK_UNUSED;
    const int error = refused(tp, &end);
    if (error != TP_ERR_OK) return error;
    struct tpc_move move;
    memset(&move, 0, sizeof move);
    const struct new_move from = {canon, indexer, vel, max_vel, enables, atspeed, &tag, 0.0};
    return append(tp, &end, &move, &from);
}

int tpAddCircle(TP_STRUCT *tp, EmcPose end, PmCartesian centre, PmCartesian normal, int turn, int canon, double vel,
                double max_vel, double acc TP_JERK_PARAMETER, unsigned char enables, char atspeed, struct state_tag_t tag) {
    (void)acc;
    TP_JERK_UNUSED;
    const int error = refused(tp, &end);
    if (error != TP_ERR_OK) return error;
    const double length = sqrt(normal.x * normal.x + normal.y * normal.y + normal.z * normal.z);
    if (!(length > 0.0)) return TP_ERR_GEOM;
    if (tp->synchronized == TC_SYNC_POSITION) {
        rtapi_print_msg(RTAPI_MSG_ERR, "splinefeed_tp: an arc cannot follow the spindle's position\n");
        return TP_ERR_INVALID;
    }
    struct tpc_move move;
    memset(&move, 0, sizeof move);
    move.arc = 1;
    const double n[3] = {normal.x / length, normal.y / length, normal.z / length};
    const double c[3] = {centre.x, centre.y, centre.z};
    double a[3], b[3];
    for (int k = 0; k < 3; ++k) {
        move.normal[k] = n[k];
        move.centre[k] = c[k];
        a[k] = tp_coordinate(&tp->goalPos, k) - c[k];
        b[k] = tp_coordinate(&end, k) - c[k];
    }
    move.sweep_rad = tp_sweep(a, b, n, turn);
    const struct new_move from = {canon, -1, vel, max_vel, enables, atspeed, &tag, 0.0};
    return append(tp, &end, &move, &from);
}

int tpAddRigidTap(TP_STRUCT *tp, EmcPose end, double vel, double max_vel, double acc TP_JERK_PARAMETER,
                  unsigned char enables, double scale, struct state_tag_t tag) {
    (void)acc;
    TP_JERK_UNUSED;
    const int error = refused(tp, &end);
    if (error != TP_ERR_OK) return error;
    if (tp->synchronized != TC_SYNC_POSITION) return TP_ERR_INVALID;
    struct tpc_move move;
    memset(&move, 0, sizeof move);
    move.taps = 1;
    const struct new_move from = {EMC_MOTION_TYPE_FEED, -1, vel, max_vel, enables, 1, &tag, scale > 0.0 ? scale : 1.0};
    return append(tp, &end, &move, &from);
}

/* ------------------------------------------------------------------ a servo period */
static void write_io(const syncdio_t *change) {
    if (!change->anychanged) return;
    for (int i = 0; i < config->numDIO; ++i) {
        if ((change->dio_mask >> i) & 1) dio_write(i, change->dios[i] > 0);
    }
    for (int i = 0; i < config->numAIO; ++i) {
        if ((change->aio_mask >> i) & 1) aio_write(i, change->aios[i]);
    }
}

/* Nothing else moves until the indexer is locked. */
static void lock_indexer(void) {
    if (locking == -1) return;
    set_rotary_unlock(locking, 0);
    if (!is_rotary_unlocked(locking)) locking = -1;
}

/* Moves that begin write their outputs, those that are over lock their indexers. */
static void begin_moves(unsigned before) {
    for (unsigned n = before; (int)(out.first - n) > 0; ++n) { /* on the way back it is before */
        if (told[n % tpc_capacity].indexer != -1) locking = told[n % tpc_capacity].indexer;
    }
    lock_indexer();
    const unsigned behind = out.first == out.last ? out.first : out.first + 1;
    const int moves = out.first == out.last || out.pushed != out.first; /* it does not wait for the spindle */
    for (; moves && (int)(behind - begun) > 0; ++begun) write_io(&io[begun % tpc_capacity]);
}

/* Whether the move that waits at standstill may begin. */
static int may_begin(TP_STRUCT *tp) {
    if (!out.waits || locking != -1 || tp->reverse_run != TC_DIR_FORWARD) return 0;
    const struct told *q = &told[out.pushed % tpc_capacity];
    if (q->atspeed || q->pitch > 0.0) {
        for (int s = 0; s < config->numSpindles; ++s) {
            if (!status->spindle_status[s].at_speed) {
                tp->spindle.waiting_for_atspeed = q->id;
                return 0;
            }
        }
    }
    tp->spindle.waiting_for_atspeed = MOTION_INVALID_ID;
    if (q->indexer != -1) {
        set_rotary_unlock(q->indexer, 1);
        if (!is_rotary_unlocked(q->indexer)) return 0;
    }
    return q->pitch > 0.0 ? tp_index_passed(tp, status, q->synced - 1, q->id) : 1;
}

static void show_move(TP_STRUCT *tp) {
    const struct told *q = &told[out.first % tpc_capacity];
    tp->depth = (int)(out.last - out.first);
    tp->activeDepth = (int)(out.pushed - out.first);
    if (!out.in_step || tp->execId == 0) tp->execId = q->id; /* where it changes, motmod ends a single step */
    tp->execTag = q->tag;
    tp->motionType = q->canon;
    status->enables_queued = q->enables;
    status->requested_vel = q->vel * status->net_feed_scale;
    tp_show_speed(tp, status, out.speed);
    status->spindleSync = q->synced;
    for (int k = 0; k < tpc_axes; ++k) *tp_part(&status->dtg, k) = out.to_go[k];
    status->distance_to_go = out.left; /* straight; on an arc it is more */
}

static void override(struct tpc_input *in) {
    const int moves = out.first != out.last;
    unsigned n = out.first; /* the move with a feed that is under way, or the next one */
    for (int i = 0; i < 64 && moves && n + 1 != out.last && told[n % tpc_capacity].rapid; ++i) ++n;
    const int synced = moves && !(told[n % tpc_capacity].pitch > 0.0) ? told[n % tpc_capacity].synced : 0;
    const double turns = synced ? fabs(status->spindle_status[synced - 1].spindleSpeedIn) / nominal_per_s : 1.0;
    tp_override(status, moves && told[out.first % tpc_capacity].rapid, turns, in);
}

static void run(TP_STRUCT *tp) {
    status->tcqlen = (int)(out.last - out.first);
    if (tpc_begins() && !tp->aborting) {
        read_limits(tp->cycleTime);
        tpc_begin(&machine);
    }
    const unsigned before = out.first;
    const int was_back_over = out.back_over;
    struct tpc_input in = {.hold = tp->pausing, .abort = tp->aborting, .steps = status->stepping};
    in.max_feed = tp->vLimit > 0.0 ? tp->vLimit : 0.0;
    override(&in);
    in.may_begin = may_begin(tp);
    in.backward = tp->reverse_run != TC_DIR_FORWARD;
    const int synced = told[out.first % tpc_capacity].synced;
    if (synced) tp_tell_spindle(&status->spindle_status[synced - 1]);
    tpc_run(&in, &out);
    if (out.reverses && synced) tp_reverse(&status->spindle_status[synced - 1], told[before % tpc_capacity].back, out.reverses);
    for (int k = 0; k < machine.axes; ++k) {
        if (module_has_axis(machine.axis[k])) *tp_part(&tp->currentPos, machine.axis[k]) = out.position[machine.axis[k]];
    }
    if (out.error != 0) give_up(tp, out.error);
    if (out.back_over && !was_back_over) rtapi_print_msg(RTAPI_MSG_ERR, "splinefeed_tp: the way back ends here\n");
    if (tp->aborting) {
        tp_forget_index(tp, status);
        begun = out.last; /* what has not begun writes nothing, and an indexer stays as it is */
        locking = -1;
    }
    begin_moves(tp->aborting ? out.first : before);
    if (out.complete) tp->currentPos = told[(out.last - 1) % tpc_capacity].end; /* to the last digit */
    if (tp_queued() != 0) {
        show_move(tp);
    } else if (locking == -1) {
        all_over(tp);
    } else {
        tp_show_rest(tp, status);
        tp->depth = tp->activeDepth = 1; /* it is not over before that */
    }
}

int tpRunCycle(TP_STRUCT *tp, long period) {
    (void)period;
    const long long start = rtapi_get_time();
    const int busy = out.first != out.last;
    run(tp);
    if (busy) module_count(rtapi_get_time() - start);
    return TP_ERR_OK;
}

EXPORT_SYMBOL(tpMotFunctions);
EXPORT_SYMBOL(tpMotData);
EXPORT_SYMBOL(tpAddCircle);
EXPORT_SYMBOL(tpAddLine);
EXPORT_SYMBOL(tpAddRigidTap);
EXPORT_SYMBOL(tpClear);
EXPORT_SYMBOL(tpCreate);
EXPORT_SYMBOL(tpRunCycle);
