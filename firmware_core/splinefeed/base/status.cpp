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
    case Error::jerk_not_supported:
        return "max_jerk_mm_s3 is not supported yet: the feed plan is acceleration-limited; remove the key";
    case Error::centripetal_out_of_range: return "centripetal_mm_s2 must lie between 0.1 and 1000000";
    case Error::chord_error_out_of_range: return "chord_error_mm must lie between 0.000001 and 1";
    case Error::sample_period_out_of_range: return "sample_period_us must be a whole number from 50 to 100000";
    case Error::period_too_short:
        return "the sample period is too short for the acceleration: rounding would use a quarter of the limit; "
               "use a longer sample_period_us, a higher acceleration or a finer scalar";
    case Error::steps_out_of_range: return "steps_per_mm must lie between 0.001 and 1000000";
    case Error::corner_angle_out_of_range: return "the corner angle must lie between 0 and 180 degrees";
    case Error::tension_out_of_range: return "the tension must lie between 0 and 10";
    case Error::tangent_out_of_range: return "each component of an end tangent must lie between -100 and 100";
    case Error::too_few_waypoints: return "a path needs two different waypoints, a closed one three";
    case Error::degree_out_of_range: return "a Bezier segment has degree 1 to 9";
    case Error::gap_in_curve: return "each segment must start where the one before it ends";
    case Error::window_too_small: return "the feed plan needs a window of at least 16 cells";
    }
    return "unknown error";
}

} // namespace splinefeed
