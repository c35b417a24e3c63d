// SPDX-License-Identifier: MIT
// The machines of the corpus. Their limits are made at compile time, as a chip's firmware makes them.
#pragma once

#include "splinefeed/s3_feed_plan/limits/motion_limits.hpp"

namespace bits {

/// Three axes that differ, one of them with a braking limit of its own and end zones.
constexpr splinefeed::MachineSettings uneven_machine() {
    splinefeed::MachineSettings settings;
    settings.axis[0].max_acceleration_mm_s2 = 1200.0;
    settings.axis[0].max_braking_mm_s2 = 1700.0;
    settings.axis[1].travel_low_mm = -500.0;
    settings.axis[1].travel_high_mm = 500.0;
    settings.axis[1].travel_end_zone_mm = 460.0;
    settings.axis[1].travel_end_velocity_mm_s = 35.0;
    settings.axis[2].max_velocity_mm_s = 40.0;
    settings.axis[2].max_acceleration_mm_s2 = 500.0;
    settings.axis[2].steps_per_mm = 400.0;
    settings.centripetal_mm_s2 = 800.0;
    settings.chord_error_mm = 0.002;
    return settings;
}

constexpr splinefeed::MachineSettings jerk_limited_machine() {
    splinefeed::MachineSettings settings = uneven_machine();
    settings.axis[0].max_braking_mm_s2 = 0.0;
    settings.axis[0].max_jerk_mm_s3 = 80000.0;
    settings.axis[1].max_jerk_mm_s3 = 60000.0;
    settings.axis[2].max_jerk_mm_s3 = 40000.0;
    return settings;
}

template <splinefeed::Scalar S>
inline constexpr auto uneven_limits = splinefeed::MotionLimits<S>::make(uneven_machine());
template <splinefeed::Scalar S>
inline constexpr auto jerk_limits = splinefeed::MotionLimits<S>::make(jerk_limited_machine());

} // namespace bits
