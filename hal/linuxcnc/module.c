/* SPDX-License-Identifier: MIT
 * module.c: the module's parameters, and what its periods took, as parameters in HAL. */
#include "tp_module.h"

#include "rtapi_app.h"

#include <string.h>

MODULE_LICENSE("GPL"); /* as a whole: it is compiled with LinuxCNC's headers; these sources are MIT */
MODULE_DESCRIPTION("splinefeed as LinuxCNC's trajectory planner");

static const char letters[] = "XYZABCUVW";

static char *axes = "XYZ";
RTAPI_MP_STRING(axes, "the axes that move, as in [TRAJ]COORDINATES: letters of XYZABCUVW");
static int jerk[tpc_axes];
RTAPI_MP_ARRAY_INT(jerk, tpc_axes, "jerk limits in the order of axes, units/s^3; one for all; 0: none");
static int inch = 0;
RTAPI_MP_INT(inch, "1: the machine's unit is the inch");
static int tolerance_um = 0;
RTAPI_MP_INT(tolerance_um, "tolerance of G64 without P, micrometres; 0: corners as fast as they can be");
static const double least_um = 50.0; /* then; and of curves of short lines */
static int share = 10;
RTAPI_MP_INT(share, "part of a servo period that planning may take, per cent, 1 to 90");
static int ahead = 0;
RTAPI_MP_INT(ahead, "segments that are ready, 3 to 64; 0: 8, with a jerk limit 40; a hold takes effect behind them");
static int idle_ms = 10;
RTAPI_MP_INT(idle_ms, "no new move for so long: the path ends with a stop");
static int starve = 0;
RTAPI_MP_INT(starve, "for tests: planning gets no time in so many of a hundred periods");

enum { bins = 13 }; /* below 1, 2, 4 ... 2048 us, and the others */
struct figures {
    hal_float_t max_us, mean_us;
    hal_u32_t urgent, late, busy, below[bins];
};
static struct figures *figures;
static long long periods, sum_ns;
static int component;
static unsigned chance;

static int place_of(char letter) {
    const char *found = strchr(letters, letter >= 'a' ? letter - 'a' + 'A' : letter);
    return letter != 0 && found != 0 ? (int)(found - letters) : -1;
}

int module_has_axis(int k) {
    for (const char *a = axes; *a != 0; ++a) {
        if (place_of(*a) == k) return 1;
    }
    return 0;
}

static int first_axis(void) { return place_of(axes[0]) < 3 ? place_of(axes[0]) : 0; }

/* Of a corner that need not slow down: more is of no use, and a slow corner stays sharp. The parabola of LinuxCNC's planner at half of
 * an acceleration is off by 0.35 v^2 / a at a right angle, and by more at a sharper one. */
static double as_fast_as_can_be(double speed, double (*acceleration)(int)) {
    double softest = acceleration(first_axis());
    for (int k = 0; k < tpc_axes; ++k) {
        if (module_has_axis(k)) softest = fmin(softest, acceleration(k));
    }
    return softest > 0.0 ? 2.0 * speed * speed / softest : 0.0;
}

void module_tolerance(double programmed, double speed, double (*acceleration)(int), struct tpc_move *move) {
    const double mm = inch ? 25.4 : 1.0;
    const int free = !(programmed > 0.0) && tolerance_um == 0;
    const double least = (tolerance_um > 0 ? tolerance_um : least_um) * 1e-3 / mm;
    const double wanted = free ? fmax(least, as_fast_as_can_be(speed, acceleration)) : programmed > 0.0 ? programmed : least;
    move->tolerance = fmin(wanted, TPC_MOST_TOLERANCE / mm);
    move->joins = free ? least : 0.0; /* short lines keep their shape */
}

static int has_jerk(void) {
    for (int i = 0; i < tpc_axes; ++i) {
        if (jerk[i] > 0) return 1;
    }
    return 0;
}

/* Of the i-th of axes. One number alone is for all. */
static int jerk_of(int i) {
    for (int k = 1; k < tpc_axes; ++k) {
        if (jerk[k] > 0) return jerk[i];
    }
    return jerk[0];
}

void module_axes(struct tpc_machine *machine) {
    machine->axes = 0;
    for (int k = 0; k < tpc_axes; ++k) {
        if (k >= 3 && !module_has_axis(k)) continue;
        double limit = 0.0;
        for (int i = 0; axes[i] != 0; ++i) {
            if (place_of(axes[i]) == k) limit = jerk_of(i);
        }
        machine->jerk[machine->axes] = limit;
        machine->axis[machine->axes++] = k;
    }
    machine->mm_per_unit = inch ? 25.4 : 1.0;
}

/* A limit above what the core takes is that. It is said once, in the unit of the INI file. */
static double clamped(double value, double most, int axis, const char *key, double *said) {
    const double units = axis >= 3 && axis <= 5 ? most : most / (inch ? 25.4 : 1.0);
    if (!(value > units)) return value;
    if (*said != value) {
        rtapi_print("splinefeed_tp: [AXIS_%c]%s is %g: the planner takes at most %g\n", letters[axis], key, value, units);
        *said = value;
    }
    return units;
}

/* One of X Y Z that the machine does not have never moves: it gets the limits of the first. */
void module_limits(struct tpc_machine *machine, double period_s, double (*velocity)(int), double (*acceleration)(int),
                   double jerk_elsewhere) {
    static double said[tpc_axes][3];
    const int first = first_axis();
    module_axes(machine);
    machine->period_s = period_s;
    for (int k = 0; k < machine->axes; ++k) {
        const int axis = k >= 3 || module_has_axis(k) ? machine->axis[k] : first;
        double *const of = said[axis];
        machine->velocity[k] = clamped(velocity(axis), TPC_MOST_VELOCITY, axis, "MAX_VELOCITY", &of[0]);
        machine->acceleration[k] = clamped(acceleration(axis), TPC_MOST_ACCELERATION, axis, "MAX_ACCELERATION", &of[1]);
        const double jerk_of_axis = machine->jerk[axis < 3 ? axis : k];
        machine->jerk[k] = clamped(jerk_of_axis > 0.0 ? jerk_of_axis : jerk_elsewhere, TPC_MOST_JERK, axis, "MAX_JERK", &of[2]);
    }
}

/* A starved period looks at a clock that jumps. */
static int looks;
static long long clock_ns(void) {
    const int starved = ++looks > 1 && chance % 100U < (unsigned)starve;
    return rtapi_get_time() + (starved ? 1000000000LL : 0LL);
}

void module_create(struct tpc_machine *machine) {
    const struct tpc_settings settings = {clock_ns, share * 0.01, ahead > 0 ? ahead : has_jerk() ? 40 : 8, idle_ms * 1e-3};
    memset(machine, 0, sizeof *machine);
    module_axes(machine);
    tpc_create(&settings, machine);
}

void module_count(long long ns) {
    looks = 0;
    chance = (chance * 1103515245U + 12345U) & 0x7fffffffU;
    struct tpc_figures core;
    tpc_tell(&core);
    const double us = (double)ns * 1e-3;
    sum_ns += ns;
    ++periods;
    if (us > figures->max_us) figures->max_us = us;
    figures->mean_us = (double)sum_ns * 1e-3 / (double)periods;
    figures->urgent = core.urgent;
    figures->late = core.late;
    figures->busy = core.busy;
    int bin = 0;
    while (bin < bins - 1 && us >= (double)(1 << bin)) ++bin;
    ++figures->below[bin];
}

static int export_figures(void) {
    figures = hal_malloc(sizeof *figures);
    if (figures == 0) return -1;
    memset(figures, 0, sizeof *figures);
    int failed = hal_param_float_newf(HAL_RO, &figures->max_us, component, "splinefeed-tp.max-us") != 0 ||
                 hal_param_float_newf(HAL_RO, &figures->mean_us, component, "splinefeed-tp.mean-us") != 0 ||
                 hal_param_u32_newf(HAL_RO, &figures->urgent, component, "splinefeed-tp.urgent") != 0 ||
                 hal_param_u32_newf(HAL_RO, &figures->late, component, "splinefeed-tp.late") != 0 ||
                 hal_param_u32_newf(HAL_RO, &figures->busy, component, "splinefeed-tp.busy") != 0;
    for (int bin = 0; bin < bins - 1 && !failed; ++bin) {
        failed = hal_param_u32_newf(HAL_RO, &figures->below[bin], component, "splinefeed-tp.below-%04d-us", 1 << bin) != 0;
    }
    return failed ||
           hal_param_u32_newf(HAL_RO, &figures->below[bins - 1], component, "splinefeed-tp.above-2048-us") != 0;
}

/* What is wrong with the parameters; 0: nothing. */
static const char *wrong(void) {
    if (axes == 0 || axes[0] == 0 || strlen(axes) > tpc_axes) return "axes must name one to nine axes";
    for (const char *a = axes; *a != 0; ++a) {
        if (place_of(*a) < 0 || strchr(a + 1, *a) != 0 || strchr(a + 1, *a ^ 32) != 0) return "axes must be letters of XYZABCUVW, each once";
    }
    if (!module_has_axis(0) && !module_has_axis(1) && !module_has_axis(2)) return "axes must name X, Y or Z";
    for (int i = 0; i < tpc_axes; ++i) {
        if (jerk[i] < 0) return "jerk must not be negative";
        if (jerk[i] > 0 && i >= (int)strlen(axes)) return "jerk must not have more numbers than axes has letters";
    }
    if (inch != 0 && inch != 1) return "inch must be 0 or 1";
    if (tolerance_um < 0 || tolerance_um > 99999) return "tolerance_um must be 0 to 99999";
    if (share < 1 || share > 90) return "share must be 1 to 90";
    if (ahead != 0 && (ahead < 3 || ahead > 64)) return "ahead must be 3 to 64, or 0";
    if (idle_ms < 1 || idle_ms > 10000) return "idle_ms must be 1 to 10000";
    return starve < 0 || starve > 100 ? "starve must be 0 to 100" : 0;
}

int rtapi_app_main(void) {
    const char *reason = wrong();
    if (reason != 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "splinefeed_tp: %s\n", reason);
        return -1;
    }
    component = hal_init("splinefeed_tp");
    if (component < 0) return component;
    if (export_figures() != 0) {
        hal_exit(component);
        return -1;
    }
    return hal_ready(component);
}

void rtapi_app_exit(void) { hal_exit(component); }
