// SPDX-License-Identifier: MIT
// Interpolation of n points in 3-D, all known, and evaluation of the curve; against SISL where it is installed (Debian:
// libsisl-dev). items_per_second counts points.
#include "splinefeed/splines/bspline_basis.hpp"
#include "splinefeed/splines/bspline_interpolation.hpp"
#include "splinefeed/splines/spline_parameters.hpp"

#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#ifdef SPLINEFEED_HAS_SISL
#include <sisl.h>
#endif
