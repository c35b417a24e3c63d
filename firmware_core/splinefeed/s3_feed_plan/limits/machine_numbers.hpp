// SPDX-License-Identifier: MIT
// The numbers of a machine file: the keys and ranges that its reader, MotionLimits and the errors share.
#pragma once

#include "splinefeed/s3_feed_plan/limits/limit_errors.hpp"
#include "splinefeed/s3_feed_plan/limits/machine_settings.hpp"

namespace splinefeed {

/// What a machine without the key has.
enum class WithoutKey : std::uint8_t {
    refused, ///< each machine states it
    usual,   ///< what MachineSettings begins with
    none     ///< no such limit, which the member tells by 0
};

/// A number of the settings, as machine files name it.
template <class Settings, class T = double>
struct MachineNumber {
    const char* key;
    T Settings::*value;
    T low;
    T high;
    const char* unit;
    WithoutKey without;
    LimitError error;     ///< of a value outside `low` to `high`
    const char* sentence; ///< for the error

    [[nodiscard]] constexpr bool accepts(const Settings& settings) const noexcept {
        const T number = settings.*value;
        return (number >= low && number <= high) || (without == WithoutKey::none && number == T{}); // not NaN
    }
};

/// In [path].
inline constexpr MachineNumber<MachineSettings> path_numbers[] = {
    {"max_feed_mm_s", &MachineSettings::max_feed_mm_s, 0.001, 1e4, "mm/s", WithoutKey::refused,
     LimitError::feed_out_of_range, "max_feed_mm_s must lie between 0.001 and 10000"},
    {"centripetal_mm_s2", &MachineSettings::centripetal_mm_s2, 0.1, 1e6, "mm/s^2", WithoutKey::none,
     LimitError::centripetal_out_of_range, "centripetal_mm_s2 must lie between 0.1 and 1000000"},
    {"chord_error_mm", &MachineSettings::chord_error_mm, 1e-6, 1.0, "mm", WithoutKey::none,
     LimitError::chord_error_out_of_range, "chord_error_mm must lie between 0.000001 and 1"},
};

inline constexpr MachineNumber<MachineSettings, int> sample_period{"sample_period_us",
                                                                   &MachineSettings::sample_period_us,
                                                                   50,
                                                                   100'000,
                                                                   "us",
                                                                   WithoutKey::usual,
                                                                   LimitError::sample_period_out_of_range,
                                                                   "sample_period_us must lie between 50 and 100000"};

/// In [[axis]].
inline constexpr MachineNumber<AxisSettings> axis_numbers[] = {
    {"max_velocity_mm_s", &AxisSettings::max_velocity_mm_s, 0.001, 1e4, "mm/s", WithoutKey::refused,
     LimitError::velocity_out_of_range, "max_velocity_mm_s must lie between 0.001 and 10000"},
    {"max_acceleration_mm_s2", &AxisSettings::max_acceleration_mm_s2, 0.1, 1e6, "mm/s^2", WithoutKey::refused,
     LimitError::acceleration_out_of_range, "max_acceleration_mm_s2 must lie between 0.1 and 1000000"},
    {"max_braking_mm_s2", &AxisSettings::max_braking_mm_s2, 0.1, 1e6, "mm/s^2", WithoutKey::none,
     LimitError::braking_out_of_range, "max_braking_mm_s2 must lie between 0.1 and 1000000"},
    {"max_jerk_mm_s3", &AxisSettings::max_jerk_mm_s3, 1.0, 1e9, "mm/s^3", WithoutKey::none,
     LimitError::jerk_out_of_range, "max_jerk_mm_s3 must lie between 1 and 1000000000; without it there is no limit"},
    {"steps_per_mm", &AxisSettings::steps_per_mm, 0.001, 1e6, "counts per mm", WithoutKey::usual,
     LimitError::steps_out_of_range, "steps_per_mm must lie between 0.001 and 1000000"},
    {"travel_end_zone_mm", &AxisSettings::travel_end_zone_mm, 0.001, 1e6, "mm", WithoutKey::none,
     LimitError::travel_end_zone_out_of_range, "travel_end_zone_mm must lie between 0.001 and 1000000"},
    {"travel_end_velocity_mm_s", &AxisSettings::travel_end_velocity_mm_s, 0.001, 1e4, "mm/s", WithoutKey::none,
     LimitError::travel_end_velocity_out_of_range, "travel_end_velocity_mm_s must lie between 0.001 and 10000"},
};

} // namespace splinefeed
