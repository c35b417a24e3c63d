// SPDX-License-Identifier: MIT
// Everything of the core that a program needs to turn a stream of waypoints, moves or G-code into feed segments, and
// feed segments into steps. It does not include the curves that need all points at once (splines/), nor surfaces.
#pragma once

#include "splinefeed/base/language.hpp"

// Waypoints to curves.
#include "splinefeed/s1_curve/bspline_curve.hpp"
#include "splinefeed/s1_curve/catmull_rom.hpp"
#include "splinefeed/s1_curve/catmull_rom_modified.hpp"
#include "splinefeed/s1_curve/g2_bezier.hpp"
#include "splinefeed/s1_curve/g2_spline.hpp"
#include "splinefeed/s1_curve/polyline.hpp"
#include "splinefeed/s1_curve/smoothed_curve.hpp"

// G-code to lines, arcs and events.
#include "splinefeed/s0_program/cycles/spline_points.hpp"
#include "splinefeed/s0_program/expression.hpp"
#include "splinefeed/s0_program/interpreter.hpp"
#include "splinefeed/s0_program/text/numbered_parameters.hpp"

// Lines and arcs to curves within a tolerance.
#include "splinefeed/s1_blended_path/tolerance_path.hpp"

// Curves to feed segments, within the machine's limits.
#include "splinefeed/acceleration_planner.hpp"
#include "splinefeed/jerk_planner.hpp"
#include "splinefeed/trajectory.hpp"

// Feed segments to an interrupt or another thread, and to edges of step and direction lines.
#include "splinefeed/s4_segment_stream/segment_ring.hpp"
#include "splinefeed/s5_pulse_train/pulse_train.hpp"
