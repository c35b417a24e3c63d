// SPDX-License-Identifier: MIT
#include "splinefeed/base/status.hpp"

namespace splinefeed {

const char* describe(Error error) noexcept {
    switch (error) {
    case Error::none: return "no error";
    case Error::axes_out_of_range: return "a machine has one to six axes";
    case Error::position_out_of_range: return "a position must be a finite number within +-1048576 mm";
    case Error::move_too_long: return "two successive waypoints must be at most 65536 mm apart, in float 512 mm";
    case Error::counts_out_of_range: return "position times steps_per_mm must stay within +-2147483647 counts";
    case Error::feed_out_of_range: return "a feed must lie between 0.001 and 10000 mm/s";
    case Error::velocity_out_of_range: return "max_velocity_mm_s must lie between 0.001 and 10000";
    case Error::acceleration_out_of_range: return "max_acceleration_mm_s2 must lie between 0.1 and 1000000";
    case Error::braking_out_of_range: return "max_braking_mm_s2 must lie between 0.1 and 1000000";
    case Error::travel_end_out_of_range:
        return "travel_end_zone_mm must lie between 0.001 and 1000000 with travel limits that increase, and "
               "travel_end_velocity_mm_s between 0.001 and 10000";
    case Error::jerk_out_of_range:
        return "max_jerk_mm_s3 is out of range: 1 to 1e9, or no such key for an axis without a jerk limit";
    case Error::jerk_in_float:
        return "float has too few digits for a jerk limit; --scalar fixed or double, or no max_jerk_mm_s3";
    case Error::centripetal_out_of_range: return "centripetal_mm_s2 must lie between 0.1 and 1000000";
    case Error::chord_error_out_of_range: return "chord_error_mm must lie between 0.000001 and 1";
    case Error::speed_limit_out_of_range: return "a limit of the speed is out of its range; speed_limits has them";
    case Error::sample_period_out_of_range: return "sample_period_us must be a whole number from 50 to 100000";
    case Error::segments_per_sample_invalid:
        return "segments_per_sample must be 0 to 8 and divide the sample period into whole eighths of a us";
    case Error::period_too_short:
        return "the sample period is too short for the acceleration: rounding would use a quarter of the limit; "
               "use a longer sample_period_us, a higher acceleration or a finer scalar";
    case Error::steps_out_of_range: return "steps_per_mm must lie between 0.001 and 1000000";
    case Error::corner_angle_out_of_range: return "the corner angle must lie between 0 and 180 degrees";
    case Error::tension_out_of_range: return "the tension must lie between 0 and 10";
    case Error::factor_out_of_range:
        return "the factor of a modified Catmull-Rom curve must lie between 0 and 2, a constant one between 0 and "
               "1048576";
    case Error::tangent_out_of_range: return "each component of an end tangent must lie between -100 and 100";
    case Error::too_few_waypoints: return "a path needs two different waypoints, a closed one three";
    case Error::degree_out_of_range: return "a Bezier segment has degree 1 to 9";
    case Error::gap_in_curve: return "each segment must start where the one before it ends";
    case Error::arc_invalid:
        return "an arc needs a radius above 0.1 um that is the same at both ends within 1/16, and at most 10000 turns";
    case Error::curve_invalid:
        return "a Bezier move has degree 1 to 5, is at most 65 m long, and has a direction at both ends";
    case Error::tolerance_out_of_range: return "a tolerance is 0 to 100 mm";
    case Error::no_room: return "the curve is full of waypoints: make segments, and push the waypoint again";
    case Error::input_finished: return "a curve takes no waypoints after finish()";
    case Error::window_too_small:
        return "the window is too small: a feed plan needs at least 10 cells, a smooth plan 12 and a jerk plan 16 of "
               "their own";
    case Error::planner_unsuited:
        return "these limits need another planner: AccelerationPlanner without max_jerk_mm_s3, with it BoundedPlanner "
               "(bounded) or OptimalPlanner (optimal)";
    case Error::axes_differ: return "the curve and the machine must have the same number of axes";
    case Error::start_elsewhere: return "a new program must begin where the machine stands";
    case Error::still_moving: return "a new program can start only when the machine is at rest";
    case Error::too_few_points: return "there are too few points for the method and its degree";
    case Error::coincident_points:
        return "two successive points are the same, or too near beside the largest coordinate or derivative; merge "
               "them, or use uniform parameters";
    case Error::storage_too_small: return "the storage given is smaller than the method needs for these points";
    case Error::beta1_not_positive: return "beta1 (bias) must be greater than 0";
    case Error::beta1_out_of_range:
        return "a beta1 (bias) for all joints must lie between 1/8 and 8, and so that the curve settles: beta1^3 + 1 "
               "at "
               "most 2 beta1^2 + 2 beta1 + beta2 / 2 (without tension 0.382 to 2.618)";
    case Error::beta2_out_of_range: return "beta2 (tension) must be a finite number; for interpolation 0 to 1000";
    case Error::closed_chain_overlaps:
        return "a closed chain needs polygons of degree 2 order + 1 at least (5 for G2), or its joints overlap";
    case Error::lambda_not_positive: return "lambda must be greater than 0";
    case Error::lambda_or_mu_out_of_range:
        return "lambda must lie between 2^-20 and 2^20 and mu between -2^60 and 2^60, in fixed-point numbers lambda "
               "between 1/16 and 16 and mu between -65536 and 65536";
    case Error::curvature_sign_invalid: return "a curvature sign must be 1 or -1";
    case Error::system_singular:
        return "the system of equations is singular for these points and parameters; change a parameter or a point";
    case Error::schoenberg_whitney:
        return "the knots do not suit the parameters of the points (Schoenberg-Whitney); use averaged knots";
    case Error::knots_invalid: return "knots must not decrease, nor repeat more than degree + 1 times";
    case Error::knot_rule_unsuited:
        return "this knot rule does not fit the curve: 'params' and 'midpoints' are for closed curves, 'params' also "
               "for "
               "degree 3 with end tangents or degree 1 without; 'average_tangents' needs end tangents and degree 2";
    case Error::parameters_invalid: return "parameters must increase strictly within the domain";
    case Error::even_degree_closed:
        return "a closed curve of even degree through an even number of points cannot have its knots at the points; "
               "put them between";
    case Error::tangent_vanishes: return "the tangent vanishes at a joint: its direction is undefined";
    case Error::result_out_of_range: return "the result is beyond the range of the numbers it is computed with";
    case Error::step_times_out_of_range:
        return "step_length_us and step_space_us must lie between 0.125 and 1000, direction_setup_us and "
               "direction_hold_us between 0 "
               "and "
               "1000";
    case Error::step_tick_out_of_range: return "tick_us must be a multiple of 0.25 from 0.25 to 1000";
    case Error::step_rate_too_high:
        return "the axis steps faster than step_length_us and step_space_us allow; a lower velocity, fewer steps or "
               "shorter pulses";
    case Error::direction_change_too_long:
        return "a change of direction takes too long for this acceleration; shorter direction_setup_us and "
               "direction_hold_us, or a lower acceleration";
    default: return describe_program_error(error);
    }
}

} // namespace splinefeed
