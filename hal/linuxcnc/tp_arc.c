/* SPDX-License-Identifier: MIT
 * tp_arc.c: what an arc of LinuxCNC means. */
#include "tp_module.h"

double tp_sweep(const double *a, const double *b, const double *n, int turn) {
    double a_n = 0.0, b_n = 0.0, cosine = 0.0, sine = 0.0;
    for (int k = 0; k < 3; ++k) {
        a_n += a[k] * n[k];
        b_n += b[k] * n[k];
    }
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        cosine += (a[k] - a_n * n[k]) * (b[k] - b_n * n[k]);
        sine += n[k] * ((a[i] - a_n * n[i]) * (b[j] - b_n * n[j]) - (a[j] - a_n * n[j]) * (b[i] - b_n * n[i]));
    }
    const double whole = 2.0 * M_PI, same = 1e-6;
    double angle = atan2(sine, cosine);
    if (turn >= 0) { /* counterclockwise, and so many whole turns more */
        if (angle < same) angle += whole;
        return angle + turn * whole;
    }
    if (angle > -same) angle -= whole;
    return angle + (turn + 1) * whole;
}
