// SPDX-License-Identifier: MIT
// What each curve method costs a waypoint, three axes, double unless it says otherwise; the time given is that of one
// waypoint. `solve_natural_cubic` is the interpolation alone: control points of a G2 cubic through all points.
#include "raster.hpp"

#include "splinefeed/s1_curve/bspline_curve.hpp"
#include "splinefeed/s1_curve/catmull_rom.hpp"
#include "splinefeed/s1_curve/catmull_rom_modified.hpp"
#include "splinefeed/s1_curve/g2_spline.hpp"
#include "splinefeed/s1_curve/polyline.hpp"

#include <benchmark/benchmark.h>
