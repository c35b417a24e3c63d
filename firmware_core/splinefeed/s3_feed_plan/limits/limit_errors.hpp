// SPDX-License-Identifier: MIT
// LimitError: what is wrong with the numbers of a machine.
#pragma once

#include "splinefeed/base/status.hpp"

namespace splinefeed {

/// `describe` gives the sentence for it.
enum class LimitError : std::uint8_t {
    none,
    // A number outside its range (machine_numbers.hpp).
    feed_out_of_range,
    centripetal_out_of_range,
    chord_error_out_of_range,
    sample_period_out_of_range,
    velocity_out_of_range,
    acceleration_out_of_range,
    braking_out_of_range,
    jerk_out_of_range,
    steps_out_of_range,
    travel_end_zone_out_of_range,
    travel_end_velocity_out_of_range,
    // Numbers that do not fit together.
    axes_out_of_range,
    segments_per_sample_invalid,
    travel_end_incomplete,
    counts_out_of_range,
    jerk_in_float,
    period_too_short,
};

/// One sentence: what is wrong, and which values are right.
[[nodiscard]] const char* describe(LimitError error) noexcept;

} // namespace splinefeed
