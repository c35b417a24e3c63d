// SPDX-License-Identifier: MIT
//
// For which scalars the core is compiled: for all three, but those that the build leaves out (SPLINEFEED_SCALARS): a
// firmware compiles what it computes in.
#pragma once

#include "splinefeed/number/scalar.hpp"

#ifdef SPLINEFEED_WITHOUT_DOUBLE
#define SPLINEFEED_IF_DOUBLE(...)
#else
#define SPLINEFEED_IF_DOUBLE(...) __VA_ARGS__
#endif
#ifdef SPLINEFEED_WITHOUT_FLOAT
#define SPLINEFEED_IF_FLOAT(...)
#else
#define SPLINEFEED_IF_FLOAT(...) __VA_ARGS__
#endif
#ifdef SPLINEFEED_WITHOUT_FIXED
#define SPLINEFEED_IF_FIXED(...)
#else
#define SPLINEFEED_IF_FIXED(...) __VA_ARGS__
#endif

/// define(S) for each scalar S.
#define SPLINEFEED_EACH_SCALAR(define)                                                                                 \
    SPLINEFEED_IF_DOUBLE(define(double)) SPLINEFEED_IF_FLOAT(define(float)) SPLINEFEED_IF_FIXED(define(Fixed))

/// The class template for each scalar.
#define SPLINEFEED_INSTANTIATE_CLASS(name)                                                                             \
    SPLINEFEED_IF_DOUBLE(template class name<double>;)                                                                 \
    SPLINEFEED_IF_FLOAT(template class name<float>;) SPLINEFEED_IF_FIXED(template class name<Fixed>;)

/// define(S, X) for each scalar S, with each X in which a motion of such cells is sampled.
#define SPLINEFEED_EACH_SAMPLED(define)                                                                                \
    SPLINEFEED_IF_DOUBLE(define(double, double))                                                                       \
    SPLINEFEED_IF_FLOAT(define(float, float))                                                                          \
    SPLINEFEED_IF_FIXED(define(Fixed, Fixed) SPLINEFEED_IF_DOUBLE(define(Fixed, double)))

/// define(R) for each R in which the plan with a jerk limit computes: always float, on a chip the quicker one.
#define SPLINEFEED_EACH_JERK_REAL(define) SPLINEFEED_IF_DOUBLE(define(double)) define(float)

/// define(S, R) for each scalar S that such a plan can have, with each R.
#define SPLINEFEED_EACH_JERK_PLAN(define)                                                                              \
    SPLINEFEED_IF_DOUBLE(define(double, double) define(double, float))                                                 \
    SPLINEFEED_IF_FIXED(SPLINEFEED_IF_DOUBLE(define(Fixed, double)) define(Fixed, float))
