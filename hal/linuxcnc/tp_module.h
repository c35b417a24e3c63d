/* SPDX-License-Identifier: MIT
 * tp_module.h: what the C sources of the module share: its parameters, its figures in HAL, and poses. */
#ifndef SPLINEFEED_TP_MODULE_H
#define SPLINEFEED_TP_MODULE_H

#include "rtapi.h"
#include "rtapi_math.h"
#include "rtapi_string.h"
#include "hal.h"
#include "motion.h"
#include "motion_types.h"
#include "tp.h"

#include "tp_core.h"

/* From 2.10 on, three functions have the jerk limit along a move as a parameter. */
#ifdef SPLINEFEED_TP_JERK
#define TP_JERK_PARAMETER , double ini_maxjerk
#define TP_JERK_UNUSED (void)ini_maxjerk
#else
#define TP_JERK_PARAMETER
#define TP_JERK_UNUSED (void)0
#endif

/* module.c */
/* The planned axes, their jerk limits and units. */
void module_axes(struct tpc_machine *machine);
/* The same, and their limits of this moment. @param jerk_elsewhere of axes without a jerk limit of their own; 0: none */
void module_limits(struct tpc_machine *machine, double period_s, double (*velocity)(int), double (*acceleration)(int),
                   double jerk_elsewhere);
int module_has_axis(int k); /* k: a place in X Y Z A B C U V W */
/* Tolerances of G64. @param programmed its P in machine units, 0: it has none. @param speed of the move, units/s */
void module_tolerance(double programmed, double speed, double (*acceleration)(int), struct tpc_move *move);
void module_create(struct tpc_machine *machine);
/* What a period with moves took. */
void module_count(long long ns);

/* splinefeed_tp.c */
void tp_clear_io(TP_STRUCT *tp);
void tp_state_position(TP_STRUCT *tp); /* the core forgets its moves, and is at currentPos */
unsigned tp_queued(void);
int tp_moves(const TP_STRUCT *tp); /* or waits for the spindle */
void tp_aborted(void); /* task knows of an error */

/* tp_feed.c */
/* The feed of a move, units/s. */
double tp_feed(int canon, double vel, double max_vel, const struct state_tag_t *tag, double mm_per_unit);
/* Writes the overrides of feeds and rapids. rapid: the move under way is one; turns: factor of the feeds. */
void tp_override(const emcmot_status_t *status, int rapid, double turns, struct tpc_input *in);

/* tp_show.c */
void tp_show_rest(TP_STRUCT *tp, emcmot_status_t *status);
void tp_show_speed(const TP_STRUCT *tp, emcmot_status_t *status, double speed); /* of this period, units/s */

/* tp_spindle.c */
/* Whether the spindle has passed its index since move `id` has waited for it. A hold counts before that, and not behind it. */
int tp_index_passed(TP_STRUCT *tp, emcmot_status_t *status, int spindle, int id);
void tp_forget_index(TP_STRUCT *tp, emcmot_status_t *status); /* no move waits for one any more */
void tp_tell_spindle(const spindle_status_t *spindle);        /* to the core */
/* Turns it back, `back` times as fast; and again, to what it did before. turn: 1 or 2, see tpc_output.reverses */
void tp_reverse(spindle_status_t *spindle, double back, int turn);

/* tp_arc.c */
/* The angle of an arc from its start to its end about the unit normal n; a and b: its ends from its centre. */
double tp_sweep(const double *a, const double *b, const double *n, int turn);

static inline double *tp_part(EmcPose *p, int k) {
    double *const all[] = {&p->tran.x, &p->tran.y, &p->tran.z, &p->a, &p->b, &p->c, &p->u, &p->v, &p->w};
    return all[k];
}

static inline double tp_coordinate(const EmcPose *p, int k) {
    const double *const all[] = {&p->tran.x, &p->tran.y, &p->tran.z, &p->a, &p->b, &p->c, &p->u, &p->v, &p->w};
    return *all[k];
}

static inline void tp_to_array(const EmcPose *p, double *values) {
    for (int k = 0; k < tpc_axes; ++k) values[k] = tp_coordinate(p, k);
}

#endif
