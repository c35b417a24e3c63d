// SPDX-License-Identifier: MIT
#include "splinefeed/base/status.hpp"

#include "splinefeed/base/sentence_table.hpp"

namespace splinefeed {

namespace {

constexpr Sentence<Error> sentences[] = {
    {Error::none, "no error"},
    {Error::axes_out_of_range, axes_sentence},
    {Error::position_out_of_range, "a position must be a finite number within +-1048576 mm"},
    {Error::move_too_long, "two successive waypoints must be at most 65536 mm apart, in float 512 mm"},
    {Error::counts_out_of_range, "position times steps_per_mm must stay within +-2147483647 counts"},
    {Error::tension_out_of_range, "the tension must lie between 0 and 10"},
    {Error::factor_out_of_range,
     "the factor of a modified Catmull-Rom curve must lie between 0 and 2, a constant one between 0 and 1048576"},
    {Error::tangent_out_of_range, "each component of an end tangent must lie between -100 and 100"},
    {Error::too_few_waypoints, "a path needs two different waypoints, a closed one three"},
    {Error::degree_out_of_range, "a Bezier segment has degree 1 to 9"},
    {Error::gap_in_curve, "each segment must start where the one before it ends"},
    {Error::arc_invalid,
     "an arc needs a radius above 0.1 um that is the same at both ends within 1/16, and at most 10000 turns"},
    {Error::curve_invalid, "a Bezier move has degree 1 to 5, is at most 65 m long, and has a direction at both ends"},
    {Error::tolerance_out_of_range, "a tolerance is 0 to 100 mm"},
    {Error::no_room, "the curve is full of waypoints: make segments, and push the waypoint again"},
    {Error::input_finished, "a curve takes no waypoints after finish()"},
    {Error::window_too_small,
     "the window is too small: a feed plan needs at least 10 cells, a jerk plan 16 of its own"},
    {Error::planner_unsuited, "these limits need another planner: AccelerationPlanner without max_jerk_mm_s3, "
                              "JerkPlanner with it"},
    {Error::axes_differ, "the curve and the machine must have the same number of axes"},
    {Error::start_elsewhere, "a new program must begin where the machine stands"},
    {Error::still_moving, "a new program can start only when the machine is at rest"},
    {Error::too_few_points, "there are too few points for the method and its degree"},
    {Error::coincident_points, "two successive points are the same, or too near beside the largest coordinate or "
                               "derivative; merge them, or use uniform parameters"},
    {Error::storage_too_small, "the storage given is smaller than the method needs for these points"},
    {Error::beta1_not_positive, "beta1 (bias) must be greater than 0"},
    {Error::beta1_out_of_range,
     "a beta1 (bias) for all joints must lie between 1/8 and 8, and so that the curve settles: beta1^3 + 1 at most 2 "
     "beta1^2 + 2 beta1 + beta2 / 2 (without tension 0.382 to 2.618)"},
    {Error::beta2_out_of_range, "beta2 (tension) must be a finite number; for interpolation 0 to 1000"},
    {Error::closed_chain_overlaps,
     "a closed chain needs polygons of degree 2 order + 1 at least (5 for G2), or its joints overlap"},
    {Error::lambda_not_positive, "lambda must be greater than 0"},
    {Error::lambda_or_mu_out_of_range,
     "lambda must lie between 2^-20 and 2^20 and mu between -2^60 and 2^60, in fixed-point numbers lambda between 1/16 "
     "and 16 and mu between -65536 and 65536"},
    {Error::curvature_sign_invalid, "a curvature sign must be 1 or -1"},
    {Error::system_singular,
     "the system of equations is singular for these points and parameters; change a parameter or a point"},
    {Error::schoenberg_whitney,
     "the knots do not suit the parameters of the points (Schoenberg-Whitney); use averaged knots"},
    {Error::knots_invalid, "knots must not decrease, nor repeat more than degree + 1 times"},
    {Error::knot_rule_unsuited,
     "this knot rule does not fit the curve: 'params' and 'midpoints' are for closed curves, 'params' also for degree "
     "3 with end tangents or degree 1 without; 'average_tangents' needs end tangents and degree 2"},
    {Error::parameters_invalid, "parameters must increase strictly within the domain"},
    {Error::even_degree_closed, "a closed curve of even degree through an even number of points cannot have its knots "
                                "at the points; put them between"},
    {Error::tangent_vanishes, "the tangent vanishes at a joint: its direction is undefined"},
    {Error::result_out_of_range, "the result is beyond the range of the numbers it is computed with"},
    {Error::step_times_out_of_range, "step_length_us and step_space_us must lie between 0.125 and 1000, "
                                     "direction_setup_us and direction_hold_us between 0 and 1000"},
    {Error::step_tick_out_of_range, "tick_us must be a multiple of 0.25 from 0.25 to 1000"},
    {Error::step_rate_too_high, "the axis steps faster than step_length_us and step_space_us allow; a lower velocity, "
                                "fewer steps or shorter pulses"},
    {Error::direction_change_too_long, "a change of direction takes too long for this acceleration; shorter "
                                       "direction_setup_us and direction_hold_us, or a lower acceleration"},
};

static_assert(has_all(sentences, Error::direction_change_too_long));

} // namespace

const char* describe(Error error) noexcept {
    return sentence_of(sentences, error);
}

} // namespace splinefeed
