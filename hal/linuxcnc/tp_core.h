/* SPDX-License-Identifier: MIT
 * tp_core.h: the motion core as the C side of the module sees it. Plain types: LinuxCNC's headers are C, and declare
 * other things when they see C++. Lengths in the machine's units (mm or inches, degrees), times in seconds.
 *
 * All of it but tpc_create() is called in the servo thread. Nothing takes memory, waits or locks. */
#ifndef SPLINEFEED_TP_CORE_H
#define SPLINEFEED_TP_CORE_H

#ifdef __cplusplus
extern "C" {
#endif

enum { tpc_axes = 9, tpc_capacity = 2048, /* X Y Z A B C U V W; moves in the queue, a power of two, */
       tpc_kept = 512 };                  /* and of those behind the machine, for the way back */

/* What the core takes of an axis at most, mm/s, mm/s^2, mm/s^3; degrees where it is rotary. */
#define TPC_MOST_VELOCITY 9999.999
#define TPC_MOST_ACCELERATION 999999.9
#define TPC_MOST_JERK 999999999.0
/* The largest tolerance, mm. A corner is rounded within half of its moves, whatever the tolerance. */
#define TPC_MOST_TOLERANCE 99.999

struct tpc_machine {
    int axes;                  /* that are planned, the first three are X Y Z */
    int axis[tpc_axes];        /* their places in X Y Z A B C U V W */
    double velocity[tpc_axes]; /* in the order of `axis` */
    double acceleration[tpc_axes];
    double jerk[tpc_axes]; /* 0: none */
    double mm_per_unit;    /* of the axes that are not rotary: 1 or 25.4 */
    double period_s;       /* of the servo thread */
};

enum tpc_mode { TPC_CONTINUOUS, TPC_EXACT_PATH, TPC_EXACT_STOP };

struct tpc_move {
    int arc; /* 0: a line */
    enum tpc_mode mode;
    int stands_before; /* the machine waits at its start until tpc_input.may_begin */
    int stops;         /* and stands at its end, whatever the mode */
    int probes;        /* few segments are ready while it runs */
    int rapid;         /* as fast as the axes can, whatever `feed` says */
    double to[tpc_axes];
    double centre[3], normal[3], sweep_rad;
    double tolerance, feed;
    double joins; /* the tolerance where short lines become one curve; 0: its usual part of `tolerance` */
    double pitch; /* of a line that follows the spindle: units a revolution; 0: it does not. It begins at rest, after may_begin,
                     unless another one is before it that does not stop */
    int taps; /* it follows the spindle to its end and back to where it began: the next move begins there */
};

struct tpc_input {
    double ratio;    /* of the programmed feed, 0 to 2; 0 stops */
    double rapids;   /* of the largest speed of rapids, 1/128 to 1 */
    double max_feed; /* 0 stops; a large number: none */
    int hold, abort, may_begin;
    int steps; /* single step: each move stands at its end, whatever its mode, also where it was planned to go on */
    int backward; /* along the path so far: it brakes, and turns where it stands */
};

struct tpc_output {
    double position[tpc_axes];
    double to_go[tpc_axes]; /* to the end of the move under way */
    double left, speed;     /* the straight way there, and the speed: of X Y Z; where those stand of U V W; where all of
                               these stand of A B C */
    unsigned first, pushed, last; /* sequence numbers: the move under way, the next one that is planned, one behind the
                                     newest. Nothing is queued where first == last, and then the machine stands. */
    int in_step; /* single step, and the machine does not stand at the end of a move */
    int back_over; /* it stands where the way back ends: nothing more is kept, or the path began there */
    int waits;                    /* the machine stands before move `pushed`, until may_begin */
    int complete;                 /* it has come to the end of the newest move, and stands; for one period */
    int reverses; /* for one period: 1: the spindle is to turn back, at the end of a tap; 2: as before, at its start */
    const char *error;            /* why the moves are not travelled: it brakes on its path and forgets them; for one
                                     period. 0: nothing is wrong */
};

struct tpc_figures {
    unsigned busy;   /* calls of the planner whose share of a period was not enough */
    unsigned urgent; /* segments of an old plan, because a new one was late: the machine slowed down */
    unsigned late;   /* periods without a segment in motion: never */
};

struct tpc_settings {
    long long (*now_ns)(void); /* a clock */
    double share;              /* of a period that planning may take */
    int ahead;                 /* segments that are ready */
    double idle_s;             /* without a new move: then the path ends with a stop */
};

/* Once, before anything else. Of the machine the axes, units and period count. */
void tpc_create(const struct tpc_settings *settings, const struct tpc_machine *machine);
/* States the position, and forgets all moves. */
void tpc_set(const double *position);
/* Whether the next tpc_run() begins a path: then tpc_begin() comes before, with the limits of this moment. */
int tpc_begins(void);
void tpc_begin(const struct tpc_machine *machine);
/* Queues a move from where the last one ends. 0; or -1: it has no length and is left out; or the core's error. */
int tpc_add(const struct tpc_move *move);
const char *tpc_reason(int error);
/* What the spindle has turned since its index, and its speed: before each period in which a move follows it. */
void tpc_spindle(double turns, double turns_per_s);
/* A servo period. */
void tpc_run(const struct tpc_input *input, struct tpc_output *output);
void tpc_tell(struct tpc_figures *figures);

#ifdef __cplusplus
}
#endif
#endif
