// SPDX-License-Identifier: MIT
// MachineSettings: the numbers of a machine file, not yet checked; MotionLimits::make checks them.
#pragma once

#include "splinefeed/base/capacity.hpp"

#include <cstdint>

namespace splinefeed {

/// A path that leaves the travel by no more than this keeps it: what arcs and inches are rounded to. [mm]
inline constexpr int travel_allowances_a_mm = 1'000'000;
inline constexpr double travel_allowance_mm = 1.0 / travel_allowances_a_mm;

/// One axis, as the machine file states it.
struct AxisSettings {
    double max_velocity_mm_s = 100.0;
    double max_acceleration_mm_s2 = 1000.0;
    double max_jerk_mm_s3 = 0.0; ///< 0: acceleration-limited
    double steps_per_mm = 1000.0;
    double max_braking_mm_s2 = 0.0; ///< acceleration against the velocity; 0: max_acceleration_mm_s2
    bool rotary = false;            ///< the unit is degrees where the names say mm; the feed does not count this axis
    double travel_low_mm = 0.0;     ///< only used with an end zone
    double travel_high_mm = 0.0;
    double travel_end_zone_mm = 0.0;       ///< length of the zone at each end of the travel where another velocity
                                           ///< limit applies; 0: none
    double travel_end_velocity_mm_s = 0.0; ///< velocity limit in that zone

    [[nodiscard]] constexpr double braking_mm_s2() const noexcept {
        return max_braking_mm_s2 == 0.0 ? max_acceleration_mm_s2 : max_braking_mm_s2;
    }
    [[nodiscard]] constexpr double smaller_acceleration_mm_s2() const noexcept {
        return braking_mm_s2() < max_acceleration_mm_s2 ? braking_mm_s2() : max_acceleration_mm_s2;
    }
    [[nodiscard]] constexpr double larger_acceleration_mm_s2() const noexcept {
        return braking_mm_s2() > max_acceleration_mm_s2 ? braking_mm_s2() : max_acceleration_mm_s2;
    }
};

/// A machine as its file states it. Zero means "no such limit" for the optional ones.
struct MachineSettings {
    int axes = 3;
    PerAxis<AxisSettings> axis{};
    double max_feed_mm_s = 100.0;
    double max_turning_deg_s = 0.0; ///< the same for moves without a programmed feed of rotary axes alone; 0: that
    double centripetal_mm_s2 = 0.0;
    double chord_error_mm = 0.0;
    int sample_period_us = 1000;
    /// 1 to 8, each a whole number of ticks of 1/8 us. 0: chosen so that the smoothing of the path stays below 0.35 um
    int segments_per_sample = 0;
};

/// What limits a move without a programmed feed where rotary axes move alone.
constexpr double max_turning_deg_s(const MachineSettings& machine) noexcept {
    return machine.max_turning_deg_s > machine.max_feed_mm_s ? machine.max_turning_deg_s : machine.max_feed_mm_s;
}

namespace detail {

/// The root of a number, by Newton's steps from above; `most` if that is less.
constexpr double root_up_to(double most, double number) noexcept {
    double root = most;
    for (int step = 0; step < 64 && number < most * most; ++step) {
        root = 0.5 * (root + number / root);
    }
    return root;
}

} // namespace detail

/// The machine with no more acceleration than its jerk limits let an axis reach. To reach `a`, the speed changes by
/// a^2 / (2 J), and to end it by as much again: that lies between -V and V. A higher limit
/// would cut samples into more segments, and cells into shorter ones, than the motion needs.
constexpr MachineSettings within_jerk(MachineSettings machine) noexcept {
    for (const unsigned k : indices(machine.axes)) {
        AxisSettings& axis = machine.axis[k];
        if (const double jerk = axis.max_jerk_mm_s3; jerk > 0.0) {
            axis.max_acceleration_mm_s2 =
                detail::root_up_to(axis.max_acceleration_mm_s2, 2.0 * jerk * axis.max_velocity_mm_s);
            axis.max_braking_mm_s2 = detail::root_up_to(axis.max_braking_mm_s2, 2.0 * jerk * axis.max_velocity_mm_s);
        }
    }
    return machine;
}

/// What all axes of a machine have together.
struct AxisTotals {
    double acceleration_sq = 0.0; ///< sum of squares
    double softest = 1e9;         ///< smallest acceleration
    double turning_sq = 0.0;      ///< sum of squares of the rotary axes' velocities
    double smoothest = 0.0;       ///< smallest jerk; 0: none is limited
    int rotary = 0;
};

constexpr AxisTotals axis_totals(const MachineSettings& settings) noexcept {
    AxisTotals totals;
    for (const unsigned k : indices(settings.axes)) {
        const AxisSettings& axis = settings.axis[k];
        const double acceleration = axis.smaller_acceleration_mm_s2();
        totals.acceleration_sq += axis.larger_acceleration_mm_s2() * axis.larger_acceleration_mm_s2();
        totals.turning_sq += axis.rotary ? axis.max_velocity_mm_s * axis.max_velocity_mm_s : 0.0;
        totals.rotary += axis.rotary ? 1 : 0;
        totals.softest = acceleration < totals.softest ? acceleration : totals.softest;
        if (axis.max_jerk_mm_s3 > 0.0 && !(totals.smoothest > 0.0 && totals.smoothest < axis.max_jerk_mm_s3)) {
            totals.smoothest = axis.max_jerk_mm_s3;
        }
    }
    return totals;
}

} // namespace splinefeed
